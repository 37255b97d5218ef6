"""Close decisions: those of a cycle that a change of 1e-10 of their terms would turn into others."""

import math

from gradhesion.core.curve.folds import CLOSE
from gradhesion.core.curve.trace import CLOSE_PAIR, END, END_LEVEL, LANDING, START, START_LEVEL
from gradhesion.core.curve.values import Curve, bin_of, place_of, slope_in, terms_at
from gradhesion.core.cycle.path import started_within
from gradhesion.core.cycle.turning import value_at
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import HALF, end_of
from gradhesion.core.types import Floats, Integers


@leaf
def _are_close(curve: Curve, one: float, other: float, y: float) -> bool:
    """Return whether two values of what is prescribed differ by less than CLOSE of the terms of the one at y."""
    return abs(one - other) <= CLOSE * terms_at(curve, bin_of(curve.table, y))


@kernel
def rim_is_tied(curve: Curve, rim: float) -> bool:
    """Return whether a rim, or where a cycle turns, is next to a fold."""
    i, t = place_of(curve.table, min(rim, end_of(curve.table)))
    D, D1, _, _ = slope_in(curve, i, t)  # the distance of the fold by a step of Newton's method
    return rim <= end_of(curve.table) and abs(D) * curve.table.nodes[HALF, i] <= 2.0 * CLOSE * rim * abs(D1)


@leaf
def _pair_is_close(rim: float, trace: Floats, count: int) -> bool:
    """Return whether two folds within a rim are about to be born or to meet."""
    return count > 0 and trace[CLOSE_PAIR, 0] <= rim and trace[CLOSE_PAIR, 0] < math.inf


@kernel
def loading_is_tied(curve: Curve, end: float, at_rim: bool, trace: Floats, count: int) -> bool:
    """Return whether it is close which branches exist, or which of them reach higher than those before.

    Loading ends at its rim, which cuts its branch short, or where it turns.
    """
    tied, highest, j = _pair_is_close(end, trace, count), 0.0, 0
    while j < count and not tied and trace[START, j] <= end:
        top, y = trace[END_LEVEL, j], min(trace[END, j], end)
        if at_rim and y == end:
            top = value_at(curve, end)
        tied = top < math.inf and _are_close(curve, top, highest, y)
        highest = max(highest, top)
        j += 1
    return tied


@kernel
def unloading_is_tied(curve: Curve, rim: float, trace: Floats, count: int) -> bool:
    """Return whether it is close which branches exist, or which of them unloading jumps to.

    It goes inwards from `rim`, or where the cycle turns, and jumps to branches that start lower than all further out.
    `curve` is that of opening, whose branches are the first `count` columns of `trace`.
    """
    tied, level, y = _pair_is_close(rim, trace, count), value_at(curve, rim), rim
    j = started_within(trace, count, rim) - 1
    if j >= 0 and trace[END, j] >= rim:
        level, y = trace[START_LEVEL, j], trace[START, j]
        j -= 1
    while j >= 0 and y > 0.0 and not tied:
        tied = level < math.inf and _are_close(curve, trace[START_LEVEL, j], level, y)
        if trace[START_LEVEL, j] < level:
            level, y = trace[START_LEVEL, j], trace[START, j]
        j -= 1
    return tied


@kernel
def target_is_tied(
    measured: Curve,
    target: float,
    rim: float,
    trace: Floats,
    visited: Integers,
    visits: int,
    branches: Floats,
    count: int,
) -> bool:
    """Return whether the depth or load at which a cycle turns is close to one that decides where.

    That is the top of a branch of `measured`, or where a jump of loading begins or lands. Arguments are those of
    `turning_radius`.
    """
    tied = False
    for v in range(visits):
        for y in (trace[LANDING, visited[v]], trace[END, visited[v]]):
            if trace[LANDING, visited[v]] <= rim and y < math.inf:
                tied = tied or _are_close(measured, value_at(measured, y), target, y)
    for j in range(count):
        if branches[START, j] <= rim and branches[END, j] < math.inf:
            tied = tied or _are_close(measured, branches[END_LEVEL, j], target, branches[END, j])
    return tied
