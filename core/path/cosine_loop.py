"""The energy lost in a cycle as the loop integral of the load over the depth: an independent check of the sum of jumps.

Jumps pass at fixed depth and contribute nothing, and neither does a part of a branch that is passed both ways. What is
left of a branch that loading climbs from its arrival to `top`, and unloading descends from its landing to its start, is

    int_arrival^top load d(depth) - int_start^landing load d(depth)
        = int_landing^top load d(depth) - int_start^arrival load d(depth),

and of the rim the way down, at fixed radius, from the depth at which loading arrives there to that of equilibrium. With
the units of curve/cosine.py the energy in units of 2 pi l^2 dgamma is 2/(1+k) times the integral. Nothing of
curve/cosine_energy.py is used: not its integrand, not its panels, and no sums of waves.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, LANDING, NEXT, START, START_DEPTH, Trace
from gradhesion.core.curve.cosine import Cosine, depth, load, slope
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.unloading import descend, leave_rim
from gradhesion.core.types import Floats, Table

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(14)
_PANEL: Final = 0.5
"""The longest panel in waves: the integrand has terms of cos 2 z at most."""


@kernel()
def _work(table: Table, curve: Cosine, start: float, end: float) -> float:
    """Return int load d(depth) from x = start to x = end (Gauss; panels grow with their distance from zero)."""
    level = 0.5 * (1.0 - table.k)
    low, high = min(start, end), max(start, end)
    total = 0.0
    while low < high:
        width = min(_PANEL, low) if low > 0.0 else min(_PANEL, high)  # from zero at k = 1 alone, where all is smooth
        step = min(width, high - low)
        for node, weight in zip(_NODES, _WEIGHTS):  # noqa: B905 (numba has no strict)
            x = low + 0.5 * step * (1.0 + node)
            d, _, _, _ = slope(table, curve, level, x)
            total += 0.5 * step * weight * load(table, curve, x) * d
        low = high if step < width else low + step
    return TWO_PI * (total if end >= start else -total)


@kernel()
def _polished(table: Table, curve: Cosine, x: float, target: float, low: float, high: float) -> float:
    """Return a place of landing, which is found to half its digits, to nearly all of them (Newton)."""
    for _ in range(2):
        d, _, _, here = slope(table, curve, 0.5 * (1.0 - table.k), x)
        new = x - (here - target) / d / TWO_PI
        if not low < new < high:
            break
        x = new
    return x


@kernel()
def _excess(table: Table, curve: Cosine, x: float, target: float) -> float:
    """Return the integral from where the depth is `target` to x, where it nearly is."""
    return load(table, curve, x) * (depth(table, curve, x) - target)


@kernel()
def _work_of_cycle(
    table: Table, curve: Cosine, count: int, trace: Trace, rim: float, rim_depth: float, landings: Floats
) -> float:
    """Return the integral over the cycle up to x = `rim`, in units of load and depth.

    `landings` has where unloading lands on each branch, and at what depth (-1: nowhere), of shape (2, branches).
    """
    total, level = 0.0, 0.0
    for branch in range(count):
        start = trace[START, branch]
        if start > rim:
            break
        top, arrival, landing = min(trace[END, branch], rim), trace[ARRIVAL, branch], landings[0, branch]
        climbed, descended = arrival <= rim and arrival < math.inf, landing >= start
        if climbed:
            arrival = _polished(table, curve, arrival, level, start, top)
        if climbed and descended:
            total -= _work(table, curve, start, arrival)
        elif climbed:
            total += _work(table, curve, arrival, top)
        elif descended:
            total -= _work(table, curve, start, landing)
        if climbed:
            total += _excess(table, curve, arrival, level)
            level = trace[END_DEPTH, branch] if trace[END, branch] <= rim else rim_depth
        if descended and landing < top:
            total += _excess(table, curve, landing, landings[1, branch])
            if climbed:
                total += _work(table, curve, landing, top)
    if rim < math.inf and level > rim_depth:  # pinned at the rim, down to equilibrium
        fall = level - rim_depth
        total -= fall * (load(table, curve, rim) + 0.5 * (TWO_PI * rim) ** (1.0 + table.k) * fall)
    return total


@kernel()
def loop_energy(table: Table, curve: Cosine, count: int, trace: Trace, rim: float, rim_depth: float) -> float:
    """Return the reduced energy of a cycle up to the rim, off a trace that loading has walked."""
    landings = np.full((2, count), -1.0)
    now, landing = leave_rim(table, curve, count, trace, rim, rim_depth)
    if now >= 0:
        descend(table, curve, trace, now, NO)
    level = rim_depth
    while now >= 0:
        if landing != rim:
            landing = _polished(table, curve, landing, level, trace[START, now], trace[END, now])
        landings[0, now], landings[1, now] = landing, level
        landing, level = trace[LANDING, now], trace[START_DEPTH, now]
        now = int(trace[NEXT, now])
    return 2.0 / (1.0 + table.k) * _work_of_cycle(table, curve, count, trace, rim, rim_depth, landings)
