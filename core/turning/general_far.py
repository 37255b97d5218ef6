"""Where a cycle turns on a long curve: before the regular waves that are not traced, on one of them, or beyond."""

import math
from typing import TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, YES, kernel
from gradhesion.core.curve.branches import END, END_DEPTH, ROWS, ends
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.curve.general_branches import Rows, fill_branches, find_level
from gradhesion.core.curve.general_folds import MOST_FOLDS, Zeros, find_folds, room
from gradhesion.core.path.general_long import first_that_reaches, folds_before, last_of_climb
from gradhesion.core.path.general_middle import Middle, places_between
from gradhesion.core.path.loading import load_up
from gradhesion.core.turning.corners import ROWS as CORNER_ROWS
from gradhesion.core.turning.corners import Found, Place, append_corners, corners_of, first_reached
from gradhesion.core.waves.general import UP, Room, branches_of_wave, furthest_end, let_reach, room_for_waves

Way: TypeAlias = tuple[bool, float, float]
"""Whether the load is measured, else the depth; the target; and what `last_corner` returns."""


@kernel()
def _turn_on_piece(
    basis: Basis, curve: Series, way: Way, count: int, rows: Rows, level: float, end: float, search: Place
) -> tuple[Found, float]:
    """Follow loading from a coordinate over some branches; return where it reaches the target, and its last coordinate.

    A branch that ends at x = `end` ends in no fold. The branches are `count`, in the rows of general_branches.py.
    """
    by_load, target, _ = way
    whole = search.whole
    corners, number, close = np.empty((CORNER_ROWS, 16)), 0, NO
    for branch in range(count):
        if rows[END_DEPTH, branch] <= level:
            continue
        begin = find_level(basis, curve, level, ends(rows, branch), whole)
        piece = (begin, rows[END, branch], rows[END, branch] != end)
        corners, number = append_corners(basis, curve, by_load, piece, search, corners, NONE)
        found, x, near, passed = first_reached(basis, curve, by_load, corners, number, target, whole)
        close = close or near
        level = rows[END_DEPTH, branch]
        if found:
            return (True, x, close, passed), level
    return (False, math.inf, close, False), level


@kernel()
def _turn_on_wave(basis: Basis, curve: Series, way: Way, cut: float, wave: float, work: Room, zeros: Zeros) -> Found:
    """Return where loading, come from the wave before, reaches the target on a wave."""
    _, _, rows = work
    _, level, _ = furthest_end(UP, rows[0], branches_of_wave(basis, curve, wave - 1.0, cut, work, rows[0]))
    count = branches_of_wave(basis, curve, wave, cut, work, rows[1])
    let_reach(UP, rows[1], count, level)
    found, _ = _turn_on_piece(
        basis, curve, way, count, rows[1], level, math.inf, Place(work.search, zeros, wave, way[2])
    )
    return found


@kernel()
def _first_of_waves(
    basis: Basis, curve: Series, way: Way, cut: float, low: float, high: float, work: Room, zeros: Zeros
) -> tuple[Found, float]:
    """Return where loading reaches the target on its way from wave to wave, after `low`, up to `high`, and on which.

    What it reaches on a wave rises with the wave.
    """
    found, x, close, passed = _turn_on_wave(basis, curve, way, cut, high, work, zeros)
    if not found:
        return (found, x, close, passed), high
    while high - low > 1.0:
        middle = np.floor(0.5 * (low + high))
        here, place, near, jumped = _turn_on_wave(basis, curve, way, cut, middle, work, zeros)
        if here:
            high, x, close, passed = middle, place, near, jumped
        else:
            low, close = middle, close or near
    return (found, x, close, passed), high


@kernel()
def turn_far(
    basis: Basis, curve: Series, way: Way, first: float, middle: Middle, furthest: float
) -> tuple[bool, Found, float]:
    """Return where loading reaches a target on a long curve up to x = `furthest`; there is no fold before `first`.

    `middle` is what `middle_of` of path/general_middle.py has returned, REGULAR. Returned are whether it could be done,
    what it has found, and the whole waves beyond which the place is given.
    """
    _, _, series = basis
    by_load, target, last = way
    _, until, cut, _, begin, end, _ = middle
    search, zeros = room(), np.empty(MOST_FOLDS)
    nothing = (False, math.inf, False, False)
    count, rises, _ = folds_before(basis, curve, first, middle, search, zeros)
    if count < 0:
        return False, nothing, 0.0
    near = np.empty((ROWS, count // 2 + 2))
    branches = fill_branches(basis, curve, zeros, count, rises, begin + cut, near, 0.0)
    now = load_up(basis, curve, branches, near, math.inf, NO)
    corners, number = corners_of(basis, curve, by_load, branches, near, math.inf, Place(search, zeros, 0.0, last))
    found, x, close, passed = first_reached(basis, curve, by_load, corners, number, target, 0.0)
    if found:
        return True, (found, x, close, passed), 0.0
    level = near[END_DEPTH, now] if now >= 0 else 0.0
    work = room_for_waves(series)
    rows = work[2][0]
    places = places_between(begin, end)
    wave = begin
    while wave <= end:
        wave = first_that_reaches(basis, curve, cut, places, wave, UP, level, work)
        if math.isnan(wave):
            break
        count = branches_of_wave(basis, curve, wave, cut, work, rows)
        let_reach(UP, rows, count, level)
        here, level = _turn_on_piece(basis, curve, way, count, rows, level, math.inf, Place(search, zeros, wave, last))
        close = close or here[2]
        if here[0]:
            return True, (YES, here[1], close, here[3]), wave
        far = last_of_climb(basis, curve, cut, places, wave, UP, work)
        if far != wave:
            here, there = _first_of_waves(basis, curve, way, cut, wave, far, work, zeros)
            close = close or here[2]
            if here[0]:
                return True, (YES, here[1], close, here[3]), there
            _, level, _ = furthest_end(UP, rows, branches_of_wave(basis, curve, far, cut, work, rows))
        wave = far + 1.0
    whole = end + 1.0
    x = furthest - whole
    count, rises, _ = find_folds(basis, curve, cut, min(x, until - whole), search, zeros, whole)
    if count < 0 or rises:
        return False, nothing, 0.0
    outer = np.empty((ROWS, count // 2 + 2))
    branches = fill_branches(basis, curve, zeros, count, rises, x, outer, whole)
    here, _ = _turn_on_piece(basis, curve, way, branches, outer, level, x, Place(search, zeros, whole, last))
    return True, (here[0], here[1], close or here[2], here[3]), whole
