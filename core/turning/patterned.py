"""Where cycles of a curve on a patterned interface turn: where loading first reaches a depth, or a load.

As turning/general.py and turning/corners.py; every branch is walked.
"""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.contact.disc import is_surely_open
from gradhesion.core.contact.least import least_opening
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, START, START_DEPTH, Trace, ends
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, coordinate
from gradhesion.core.curve.general_branches import find_level
from gradhesion.core.curve.general_folds import MOST_FOLDS
from gradhesion.core.curve.patterned import Patterned, are_too_many, folds_up_to, patterned_curve, window
from gradhesion.core.face import is_always_one_disc, size_at
from gradhesion.core.path.patterned import walk
from gradhesion.core.path.ties import rim_is_close
from gradhesion.core.problem.curves import GeneralCurves, Patterns
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.turning.corners import Found
from gradhesion.core.turning.general import is_first_contact
from gradhesion.core.turning.general_reach import WAVES, envelope_at
from gradhesion.core.turning.turns import Turns
from gradhesion.core.types import Harmonics, Table, Truths

_OUTERMOST: Final = 1e100
_TRIALS: Final = 40
"""Times that a trace is made longer, each by a half: the bound is not rigorous near zero contact."""
_LONGER: Final = 1.5


@kernel()
def _reach(basis: Basis, curve: Patterned, target: float) -> float:
    """Return x from which on the coordinate of a curve exceeds a target, as `reach` of turning/general_reach.py."""
    table, pattern, _ = basis
    pull, height = pattern.most, 0.0
    for i in range(pattern.waves.shape[0]):
        h = pattern.gain * math.hypot(pattern.waves[i, 1], pattern.waves[i, 2])
        pull += WAVES * table.amplitude * h * pattern.waves[i, 0] ** (0.5 * (1.0 - table.k))
        height += h
    low, high = 1e-30, 1.0
    while envelope_at(curve, table.k, pull, height, high) <= target:
        high *= 2.0
        if high > _OUTERMOST:
            return math.inf
    while high > 1.02 * low:
        middle = math.sqrt(low * high)
        if envelope_at(curve, table.k, pull, height, middle) <= target:
            low = middle
        else:
            high = middle
    return high / TWO_PI


@kernel()
def _first_reached(
    basis: Basis, curve: Patterned, measured: Patterned, trace: Trace, count: int, furthest: float, target: float
) -> Found:
    """Return where loading first reaches a target, measured along `measured`, on its way to x = `furthest`."""
    close = NO
    by_load, zeros = measured.beta > 0.0 and curve.alpha > 0.0, np.empty(0)
    last = math.inf
    if by_load:
        zeros = np.empty(MOST_FOLDS)
        last = window(basis, measured)[1]
    for branch in range(count):
        low, end = trace[ARRIVAL, branch], min(trace[END, branch], furthest)
        if not low <= furthest or low == math.inf:
            continue
        value = coordinate(basis, measured, low) if low > 0.0 else 0.0
        if value >= target:
            return True, low, close, True
        found = 0
        if by_load and low < min(end, last):  # depth rises on every branch, and load under its own control
            found, _, _ = folds_up_to(basis, measured, max(low, 1e-30), min(end, last), zeros)
        for i in range(found + 1):
            high = zeros[i] if i < found else end
            there = coordinate(basis, measured, high)
            fold = i < found or trace[END, branch] < furthest
            if fold and abs(there - target) <= CLOSE * size_at(basis, measured, high):
                close = True
            if there >= target:
                return True, find_level(basis, measured, target, (low, value, high, there), 0.0), close, False
            low, value = high, there
    return False, math.inf, close, False


@kernel()
def _is_one_disc(basis: Basis, curve: Patterned, count: int, trace: Trace, last: float, x: float, rim: float) -> bool:
    """Return whether the contact that turns at x is one disc, out to the rim; no fold stands beyond x = `last`."""
    if is_always_one_disc(basis, curve):
        return True
    level = coordinate(basis, curve, x)
    lowest, end = math.inf, math.inf
    for branch in range(count):
        if trace[START, branch] > x:
            lowest = min(lowest, trace[START_DEPTH, branch])
            if trace[END_DEPTH, branch] > level:
                end = find_level(basis, curve, level, ends(trace, branch), 0.0)
                break
    if end < math.inf and is_surely_open(basis, curve, x, level - lowest):
        return True
    if end == math.inf:
        if x > last:  # from here on the coordinate rises
            return True
        end = _reach(basis, curve, level)
    end = min(end, rim)
    return not x < end or least_opening(basis, curve, x, end) >= 0.0


@kernel()
def _turn_curve(basis: Basis, curve: Patterned, units: tuple[float, float], turns: Turns, passed: Truths) -> None:
    """Find where the cycles of a curve turn, and whether a jump has passed the target, of shape (rims,).

    `units` are those of x in R, and of the targets; lengths of `turns` are in R, and rims that are not valid NaN.
    """
    rims, targets, by_load, check, radii, flags = turns
    B, m, g, _, _ = curve
    measured = Patterned(B, m, g, 0.0, 1.0) if by_load else Patterned(B, m, g, 1.0, 0.0)
    bounds, plain = window(basis, curve), Patterned(B, m, g, 1.0, 0.0)
    longest, count, furthest = 0.0, 0, -1.0
    for i in range(rims.size):
        if rims[i] > 0.0 and abs(targets[i]) < math.inf:
            longest = max(longest, min(rims[i] / units[0], _reach(basis, measured, max(0.0, targets[i] / units[1]))))
    trace = np.empty((1, 0))
    for i in range(rims.size):
        target, rim = targets[i] / units[1], rims[i] / units[0]
        if not (rims[i] > 0.0 and abs(target) < math.inf and (target > 0.0 or not by_load)):
            radii[i], flags[i] = math.nan, NO_VALUE
            continue
        if not by_load and is_first_contact(basis.table.k, plain, target):
            flags[i] |= CLOSE_TO_A_JUMP
        if target < 0.0:
            radii[i] = 0.0
            continue
        reach, own = longest, min(rim, _reach(basis, measured, target))
        if are_too_many(basis, bounds[0], min(longest, bounds[1])):
            reach = own
        radii[i] = math.nan
        for _ in range(_TRIALS):
            if reach != furthest:
                count, trace, _ = walk(basis, curve, bounds, reach, NO)
                furthest = reach
            if count < 0 and own < reach:  # too many folds up to where another rim turns
                reach = own
                continue
            if count < 0 or reach == math.inf:
                flags[i] = TOO_MANY_WAVES
                break
            found, x, close, jumped = _first_reached(basis, curve, measured, trace, count, reach, target)
            if not found and reach < rim:
                reach *= _LONGER
                continue
            x, passed[i] = min(x, rim), jumped
            radii[i] = rims[i] if x == rim else min(rims[i], x * units[0])
            if not x < rim:
                level = coordinate(basis, curve, rim) if rim < math.inf else math.inf
                close = close or rim_is_close(basis, curve, count, trace, rim, level)
            elif check and not _is_one_disc(basis, curve, count, trace, bounds[1], x, rim):
                flags[i] |= LOADING_NOT_ONE_DISC
            if close:
                flags[i] |= CLOSE_TO_A_JUMP
            break
        if math.isnan(radii[i]):
            flags[i] = NO_VALUE | (flags[i] & TOO_MANY_WAVES)


@kernel()
def turn_scenes(
    table: Table,
    cosine_bins: Any,
    series: Harmonics,
    curves: GeneralCurves,
    patterns: Patterns,
    turns: Turns,
    passed: Truths,
) -> None:
    """Find where cycles on patterned interfaces turn, of one gradient exponent, as `turn_scenes` (turning/general.py).

    Arguments are those of `solve_scenes` (scene/patterned.py).
    """
    rims, targets, by_load, check, radii, flags = turns
    for j in range(curves.numbers.size):
        i = curves.numbers[j]
        row = i if rims.shape[0] > 1 else 0
        valid, pattern, finest, curve, units = patterned_curve(table, cosine_bins, series, curves, patterns, i)
        basis, (unit, length, depth) = Basis(table, pattern, finest), units
        if not valid:
            radii[i, :], flags[i, :] = math.nan, NO_VALUE
            continue
        edges = np.where(rims[row] <= patterns.limit[i], rims[row], math.nan)
        own = (unit, force_unit(table.k, length, depth) if by_load else depth)
        _turn_curve(basis, curve, own, Turns(edges, targets[row], by_load, check, radii[i], flags[i]), passed[i])
