"""Where a cycle turns before its rim: where loading first reaches a depth or a load (physics 13)."""

import math

from gradhesion.core.curve.levels import EXACTLY, at_level
from gradhesion.core.curve.trace import END, LANDING, START
from gradhesion.core.curve.values import Curve, coordinate_of, depth_and_load, place_of
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import end_of
from gradhesion.core.types import Floats, Integers


@leaf
def value_at(curve: Curve, y: float) -> float:
    """Return what a curve prescribes at a radius within its table."""
    i, t = place_of(curve.table, y)
    depth, load = depth_and_load(curve, i, t)
    return coordinate_of(curve, depth, load)


@kernel
def turning_radius(
    measured: Curve, target: float, trace: Floats, visited: Integers, visits: int, branches: Floats, count: int
) -> float:
    """Return where loading first reaches a target of depth or load, inf if it does not within the table.

    `measured` is the curve with that depth or load prescribed, and `branches` the trace of it, with `count` branches:
    where it is what the cycle prescribes, the `trace` of loading itself, whose `visits` branches are `visited`. A
    target that is passed within a jump is reached where the jump ends.
    """
    first, end = 0, end_of(measured.table)
    for v in range(visits):
        low, high = trace[LANDING, visited[v]], min(trace[END, visited[v]], end)
        if value_at(measured, low) >= target:
            return low
        while first < count and branches[END, first] <= low:
            first += 1
        b = first
        while b < count and branches[START, b] < high:
            top = min(high, branches[END, b])
            if value_at(measured, top) >= target:
                return at_level(measured, target, max(low, branches[START, b]), top, EXACTLY)
            b += 1
    return math.inf


@leaf
def _lower_bound(k: float, m: float, B: float, crest: float, mean: float, by_load: bool, y: float) -> float:
    """Return what the depth, or `by_load` the load, at y is not below, in the units of table/layout.py.

    The curve is B y^m of the gradient exponent k, less waves and stretch, which are at most crest y^((1-k)/2) + mean.
    """
    share = (1.0 + k) / (1.0 + k + m) if by_load else 0.0
    bound = B * y**m * (1.0 - share) - crest * y ** (0.5 * (1.0 - k)) - mean
    return bound * y ** (1.0 + k) if by_load else bound


@kernel
def turning_reach(k: float, m: float, B: float, crest: float, mean: float, target: float, by_load: bool) -> float:
    """Return a radius, a percent more than needed, from which on depth or load surely exceed a target >= 0."""
    low, high = 0.0, 1.0
    for _ in range(300):
        y = high if low == 0.0 else math.sqrt(low * high)
        if _lower_bound(k, m, B, crest, mean, by_load, y) > target:
            low = 1e-3 * y if low == 0.0 else low
            high = y
        elif low == 0.0:
            high = 2.0 * y
        else:
            low = y
        if low > 0.0 and high < 1.01 * low:
            break
    return high
