"""The branches of a curve: the parts on which depth rises with the radius, where the contact is stable.

They are kept in a *trace*, an array of one column a branch with the rows named here: the two folds that bound the
branch, how loading arrives on it, where unloading goes from its start, and what it loses from there to the end of
contact. One row more is room for the nodes of curve/cosine_energy.py and the waves of waves/cosine_sum.py, one is for
waves that are not walked, and the first column of another one has the innermost place at which a pair of folds is about
to be born (path/ties.py).
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, YES, constant, kernel
from gradhesion.core.curve.at_once import find_zeros, guess_zeros
from gradhesion.core.curve.cosine import Cosine, depth, slope
from gradhesion.core.curve.cosine_folds import (
    CLOSE,
    LAST_STEP_OF_DEPTH,
    edge_of,
    find_zero,
    guess_zero,
    half_wave,
    survey_between,
)
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import LANES, Lanes, eight, lane_of, with_lane
from gradhesion.core.struve.layout import SWITCH
from gradhesion.core.types import Floats, Table

START, START_DEPTH, END, END_DEPTH = 0, 1, 2, 3
ARRIVAL, LOADING_LOSS, LOADING_JUMPS = 4, 5, 6
NEXT, LANDING = 7, 8
"""Where unloading goes from the start of a branch: the next branch that it visits, -1 for none, and where it lands."""
UNLOADING_LOSS, UNLOADING_JUMPS, LAST_DEPTH, CALLER = 9, 10, 11, 12
WORK, RUN = 13, 14
GAP, RUN_FIRST, RUN_LAST, RUN_LANDING = 0, 1, 2, 3
RUN_BEFORE, RUN_AFTER, RUN_LOWEST, RUN_LEAST = 4, 5, 6, 7
"""The row RUN: the first branch beyond waves that were not walked, the first and the last of these waves
that loading leaves, and where it lands among them (0 if on the way from one wave to the next); the wave of the last
branch before the gap, that of the first one after it, and the one of them or between that starts lowest; the least
opening outside the ends of the waves of the gap (contact/waves.py), NaN if it is not known for all of them."""
TANGENCY = 15
HIGHEST, LOADING_IS_CLOSE, UNLOADING_IS_CLOSE = 16, 17, 18
"""The highest depth up to the end of a branch, 0 at least, whether a decision of loading was close up to there, and
whether one of unloading is from the start of the branch on (path/ties.py)."""
ROWS = 19
Trace: TypeAlias = Floats
"""A trace, of shape (ROWS, branches or more): places in wavelengths, depths in s l^c, energies in 2 pi l^2 dgamma."""
Waiting: TypeAlias = tuple[int, Lanes, Lanes, Lanes, Lanes]
"""Folds not yet in the trace: their number, arches, 1 where a branch starts and -1 where one ends, and the brackets."""
NOWHERE: Final = constant(-1)
"""The branch of no contact."""
UNKNOWN: Final = -1.0
"""Unloading jumps of a branch that unloading has not visited yet."""
_STEPS: Final = 100
_LAST_STEP: Final = 1e-2
"""Over the length on which the slope changes: a step of the fourth order leaves some 1e-8 of that."""
_LAST_ENDLESS_STEP: Final = 1e-3
"""The same of the third order, beyond the last fold."""


@kernel()
def branch_within(count: int, trace: Trace, x: float) -> int:
    """Return the last branch that starts within x, -1 if none does."""
    low, high = -1, count
    while high - low > 1:
        middle = (low + high) // 2
        if trace[START, middle] <= x:
            low = middle
        else:
            high = middle
    return low


@kernel()
def ends(trace: Trace, branch: int) -> tuple[float, float, float, float]:
    """Return the place and depth of a branch's start, and those of its end."""
    return trace[START, branch], trace[START_DEPTH, branch], trace[END, branch], trace[END_DEPTH, branch]


@kernel()
def find_depth(table: Table, curve: Cosine, target: float, branch: tuple[float, float, float, float]) -> float:
    """Return where a branch meets a depth between those of its two ends (Householder, kept in the bracket)."""
    level = 0.5 * (1.0 - table.k)
    low, low_depth, high, high_depth = branch
    endless = high == math.inf
    if endless:
        b, _, _ = curve
        step = min(0.25 + 0.25 * low, 1e-9 * low + math.sqrt(2.0 * max(0.0, target - low_depth) / b) / TWO_PI)
        high = low + step
        high_depth = depth(table, curve, high)
        while high_depth <= target:
            low, low_depth = high, high_depth
            step *= 2.0
            high += step
            high_depth = depth(table, curve, high)
    # a half wave of a cosine has both its ends level, as the branch has
    share = (target - low_depth) / (high_depth - low_depth)
    if not 0.0 < share < 1.0:
        return low if share <= 0.0 else high
    x = low + (high - low) * half_wave(share)
    x = x if low < x < high else 0.5 * (low + high)
    for _ in range(_STEPS):
        d, d1, d2, rest = slope(table, curve, level, x)
        rest -= target
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        square, bend = d * d, rest * d1
        if endless:
            if abs(bend) > square:  # that of the last waves, which does not apply far beyond them
                bend = 0.0
            step = -rest * d / (square - 0.5 * bend)
        else:
            step = -rest * (square - 0.5 * bend) / (d * (square - bend) + rest * rest * d2 / 6.0)
        x += step / TWO_PI
        # the loss is stationary at the place of landing: its error is the square of the remaining step
        enough = _LAST_ENDLESS_STEP if endless else _LAST_STEP
        if low <= x <= high and abs(step) * (abs(d1) + abs(d)) < enough * abs(d):
            return x
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
    return x


@kernel()
def room_for(trace: Trace, columns: float) -> Trace:
    """Return the trace, or a larger one that is still empty."""
    if columns <= trace.shape[1]:
        return trace
    return np.empty((ROWS, int(columns)))


@kernel()
def _put_waiting(
    table: Table, curve: Cosine, furthest: float, trace: Trace, count: int, waiting: Waiting
) -> tuple[int, bool]:
    """Put the folds that wait into the trace; return the number of branches, and whether the last is beyond reach."""
    level = 0.5 * (1.0 - table.k)
    number, arches, signs, lows, highs = waiting
    guesses = guess_zeros(table, curve, level, arches, signs)
    places, bottoms = eight(math.nan), eight(math.nan)
    if TWO_PI * lane_of(lows, number - 1) >= SWITCH:
        places, bottoms = find_zeros(table, curve, level, lows, highs, guesses)
    for lane in range(number):
        x, bottom, rising = lane_of(places, lane), lane_of(bottoms, lane), lane_of(signs, lane) > 0.0
        low, high = lane_of(lows, lane), lane_of(highs, lane)
        if TWO_PI * low < SWITCH or math.isnan(x):
            guess = lane_of(guesses, lane)
            if not low < guess < high:
                i = int(lane_of(arches, lane))
                guess = guess_zero(table, curve, level, i, high, rising != (i % 2 == 0))
            x, bottom = find_zero(table, curve, level, low, high, rising, guess, LAST_STEP_OF_DEPTH)
        if rising:
            if x > furthest:
                return count, YES
            trace[START, count], trace[START_DEPTH, count], trace[UNLOADING_JUMPS, count] = x, bottom, UNKNOWN
        else:
            trace[END, count], trace[END_DEPTH, count] = x, bottom
            count += 1
            if x > furthest:
                return count, YES
    return count, NO


@kernel()
def append_branches(
    table: Table, curve: Cosine, first: int, final: float, furthest: float, trace: Trace, count: int
) -> int:
    """Append the branches that start on arch `first` or later and within `furthest`; return the new count.

    The last branch is complete: it ends at its true fold, or at infinity where no arch up to `final` ends it. Folds
    beyond z = 40 are found eight at a time, each for itself.
    """
    level = 0.5 * (1.0 - table.k)
    inside, beyond = False, False
    if count == 0:
        trace[TANGENCY, 0] = math.inf
    if level == 0.0 and first == 0:  # k = 1: the first branch starts at zero contact, at the depth -1
        trace[START, count], trace[START_DEPTH, count], trace[UNLOADING_JUMPS, count] = 0.0, -1.0, UNKNOWN
        inside = True
    number, arches, signs, lows, highs = NONE, eight(0.0), eight(0.0), eight(0.0), eight(0.0)
    i, outer = first, edge_of(table, curve, level, first)
    while i <= final and not beyond:
        inner, outer = outer, edge_of(table, curve, level, i + 1)
        kind, low, peak, high = survey_between(table, curve, level, i, inner, outer)
        if kind == 0 and peak <= CLOSE:
            trace[TANGENCY, 0] = min(trace[TANGENCY, 0], low)
        rising = kind == 1 or (kind == 2 and i % 2 == 0)
        for j in range(abs(kind)):
            if rising or inside:
                arches, signs = with_lane(arches, number, float(i)), with_lane(signs, number, 1.0 if rising else -1.0)
                lows = with_lane(lows, number, peak if kind == 2 and j == 1 else low)
                highs = with_lane(highs, number, peak if kind == 2 and j == 0 else high)
                number += 1
                if number == LANES:
                    waiting = (number, arches, signs, lows, highs)
                    count, beyond = _put_waiting(table, curve, furthest, trace, count, waiting)
                    number = NONE
            inside = rising
            rising = not rising
        if not inside and high > furthest:
            break
        i += 1
    if number > 0 and not beyond:
        waiting = (number, arches, signs, lows, highs)
        count, beyond = _put_waiting(table, curve, furthest, trace, count, waiting)
    if inside and not beyond:
        trace[END, count] = trace[END_DEPTH, count] = math.inf
        count += 1
    return count
