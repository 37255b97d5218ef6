"""Where a cycle turns before its rim: where loading first reaches a depth or a load (physics 13)."""

import math

from gradhesion.core.curve.levels import EXACTLY, at_level
from gradhesion.core.curve.trace import END, LANDING, START
from gradhesion.core.curve.values import Curve, coordinate_of, state_in
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import end_of
from gradhesion.core.types import Floats, Integers


@leaf
def value_at(curve: Curve, y: float) -> float:
    """Return what a curve prescribes at a radius; inf beyond its table, where it is on the endless branch."""
    if y > end_of(curve.table):
        return math.inf
    depth, load = state_in(curve, y)
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


@kernel
def turning_reach(k: float, m: float, B: float, crest: float, mean: float, target: float, by_load: bool) -> float:
    """Return a radius, some percent more than needed, from which on depth or load surely exceed a target >= 0.

    The depth is at least B y^m - crest y^((1-k)/2) - mean, in the units of table/layout.py, and the load over y^(1+k)
    at least the same with m/(1+k+m) B. Where that meets the target, B y^(m+q) = crest y^((1-k)/2+q) + mean y^q + target
    with q = 0 or 1+k: approached from above, where none of the three terms is more than a third.
    """
    q, eta = (1.0 + k if by_load else 0.0), 0.5 * (1.0 - k)
    size = B * m / (1.0 + k + m) if by_load else B
    y = max((3.0 * crest / size) ** (1.0 / (m - eta)), (3.0 * mean / size) ** (1.0 / m))
    y = max(y, (3.0 * target / size) ** (1.0 / (m + q)))
    before = math.inf
    while y < 0.99 * before:
        before = y
        y = ((crest * y ** (eta + q) + mean * y**q + target) / size) ** (1.0 / (m + q))
    return before
