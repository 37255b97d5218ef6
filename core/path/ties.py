"""Near-degenerate decisions: those on the path that an error of 1e-12 in an input could change.

Force, energy and depths are continuous in every parameter; the number of jumps and the radius of the pull-off are not.
They change where one decision of the path does: whether a branch reaches higher than the depth of a jump outwards, or
lower than that of a jump inwards, whether the rim lies on a branch, and whether there is a pair of folds at all. Each
is a comparison of two numbers of known size; one that they win or lose by less than CLOSE of that size is close.

The curve is any whose kind has the functions for them (core/face.py). Decisions of loading are noted with the branches
up to which they are made, those of unloading with the branches from which on, so that all rims of a curve read them.

On a long curve (path/cosine_long.py) the branches that are summed are not tested: each is visited, and their
neighbours are a wave apart. The places where loading enters them, and unloading leaves them, are tested.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import NO, NONE, kernel
from gradhesion.core.curve.branches import (
    CALLER,
    END,
    END_DEPTH,
    HIGHEST,
    LOADING_IS_CLOSE,
    START,
    START_DEPTH,
    TANGENCY,
    UNKNOWN,
    UNLOADING_IS_CLOSE,
    Trace,
    branch_within,
)
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.face import AnyCurve, AnyTable, fold_at, most_size_at, size_at
from gradhesion.core.numbers.circle import TWO_PI

PAIR: Final = 8.0 * CLOSE
"""Two folds at a distance w in z have an extremum of w^2/8 of its terms between them."""


@kernel()
def tolerance(table: AnyTable, curve: AnyCurve, x: float) -> float:
    """Return CLOSE times the size of the terms of the coordinate at x."""
    return CLOSE * size_at(table, curve, x)


@kernel()
def is_within(table: AnyTable, curve: AnyCurve, difference: float, x: float) -> bool:
    """Return whether a difference of coordinates is within the tolerance at x, which is seldom worth its power."""
    return difference <= CLOSE * most_size_at(table, curve, x) and difference <= tolerance(table, curve, x)


@kernel()
def first_close_pair(count: int, trace: Trace) -> float:
    """Return the first place at which a pair of folds is about to be born or to vanish, inf without any."""
    first = trace[TANGENCY, 0]
    for branch in range(count):
        place = trace[START, branch]
        if place >= first:
            return first
        width = trace[END, branch] - place
        if branch > 0:
            width = min(width, place - trace[END, branch - 1])
        if place > 0.0 and (TWO_PI * width) ** 2 <= PAIR * min(1.0, TWO_PI * place) ** 2:
            return place
    return first


@kernel()
def note_loading_from(table: AnyTable, curve: AnyCurve, first: int, count: int, trace: Trace, furthest: float) -> None:
    """Do what `note_loading` does from a branch on; the notes of those before it are kept."""
    highest, close = 0.0, 0.0
    if first > 0:
        highest, close = trace[HIGHEST, first - 1], trace[LOADING_IS_CLOSE, first - 1]
    for branch in range(first, count):
        top, end = trace[END_DEPTH, branch], trace[END, branch]
        if end < furthest and is_within(table, curve, abs(top - highest), end):
            close = 1.0
        highest = max(highest, top)
        trace[HIGHEST, branch], trace[LOADING_IS_CLOSE, branch] = highest, close
        trace[UNLOADING_IS_CLOSE, branch] = UNKNOWN


@kernel()
def note_loading(table: AnyTable, curve: AnyCurve, count: int, trace: Trace, furthest: float) -> None:
    """Note the highest coordinate up to the end of each branch, and whether a decision of loading was close before."""
    note_loading_from(table, curve, NONE, count, trace, furthest)


@kernel()
def highest_before(trace: Trace, branch: int) -> float:
    """Return the highest coordinate up to the end of a branch, 0 for none."""
    return trace[HIGHEST, branch] if branch >= 0 else 0.0


@kernel()
def scan_inwards(
    table: AnyTable, curve: AnyCurve, trace: Trace, branch: int, level: float, place: float
) -> tuple[bool, int]:
    """Return whether a branch from `branch` inwards hardly starts below a level, and the first that does, -1 if none.

    The level is that of the curve at `place`.
    """
    nearest = math.inf
    while branch >= 0:
        bottom = trace[START_DEPTH, branch]
        nearest = min(nearest, abs(bottom - level))
        if bottom < level:
            break
        branch -= 1
    return nearest < math.inf and is_within(table, curve, nearest, place), branch


@kernel()
def unloading_is_close(table: AnyTable, curve: AnyCurve, trace: Trace, branch: int) -> bool:
    """Return whether a decision of unloading is close from the start of a branch on."""
    now = branch
    while trace[UNLOADING_IS_CLOSE, now] < 0.0:  # inwards to where it is known, or to a close decision
        if trace[START, now] == 0.0:
            trace[UNLOADING_IS_CLOSE, now] = NO
            break
        close, lower = scan_inwards(table, curve, trace, now - 1, trace[START_DEPTH, now], trace[START, now])
        if close or lower < 0:
            trace[UNLOADING_IS_CLOSE, now] = close
            break
        trace[CALLER, lower] = now
        now = lower
    while now != branch:
        outer = int(trace[CALLER, now])
        trace[UNLOADING_IS_CLOSE, outer] = trace[UNLOADING_IS_CLOSE, now]
        now = outer
    return trace[UNLOADING_IS_CLOSE, branch] > 0.0


@kernel()
def is_at_a_fold(table: AnyTable, curve: AnyCurve, x: float) -> bool:
    """Return whether x is a fold, as far as anybody can tell: by a step of Newton's method."""
    value, rate = fold_at(table, curve, x)
    return abs(value) <= 2.0 * CLOSE * TWO_PI * x * abs(rate)


@kernel()
def rim_is_close(table: AnyTable, curve: AnyCurve, count: int, trace: Trace, rim: float, rim_level: float) -> bool:
    """Return whether the rim stands on a fold, or hardly reaches, or misses, the level of a jump.

    That is all that belongs to the edge of a punch, and not to a cycle that turns there.
    """
    if rim == math.inf:
        return False
    if is_at_a_fold(table, curve, rim):
        return True
    now = branch_within(count, trace, rim)
    if now < 0 or trace[END, now] < rim:
        return False
    return abs(rim_level - highest_before(trace, now - 1)) <= tolerance(table, curve, rim)


@kernel()
def is_close_to_a_jump(
    table: AnyTable,
    curve: AnyCurve,
    count: int,
    trace: Trace,
    tangency: float,
    rim: float,
    rim_level: float,
    turned: bool,
) -> bool:
    """Return whether an error of 1e-12 in an input could change the number of jumps of a cycle up to the rim.

    The branches are `count`, with what `note_loading` has noted; `tangency` is the first place at which a pair of folds
    is about to be born or to vanish, `rim_level` the coordinate at the rim; `turned` tells that this is a place that
    loading surely reaches, and no edge of a punch.
    """
    if tangency <= rim and tangency < math.inf:
        return True
    now = branch_within(count, trace, rim)
    on_branch = now >= 0 and trace[END, now] >= rim
    before = now - 1 if on_branch else now
    if before >= 0 and trace[LOADING_IS_CLOSE, before] > 0.0:
        return True
    if not turned and rim_is_close(table, curve, count, trace, rim, rim_level):
        return True
    if on_branch:
        return unloading_is_close(table, curve, trace, now)
    close, lower = scan_inwards(table, curve, trace, now, rim_level, rim)
    return close or (lower >= 0 and unloading_is_close(table, curve, trace, lower))
