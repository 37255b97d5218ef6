"""Where cycles of curves of any profile turn: where loading first reaches a depth, or a load."""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.dispatch import face_of
from gradhesion.core.compiler.jit import NO, NONE, kernel
from gradhesion.core.contact.disc import is_surely_open
from gradhesion.core.contact.least import least_opening
from gradhesion.core.curve.branches import START, START_DEPTH, Trace
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Made, Series, coordinate, curve_at, rims_of
from gradhesion.core.curve.general_folds import MOST_CELLS, MOST_FOLDS, room
from gradhesion.core.face import is_always_one_disc, measured_by, reach, window
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.path.general import is_at_a_fold, walk
from gradhesion.core.path.general_middle import FEW, LONGEST_WALK, REGULAR, middle_of
from gradhesion.core.path.ties import rim_is_close
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.turning.corners import Place, corners_of, first_reached, last_corner
from gradhesion.core.turning.general_far import turn_far
from gradhesion.core.turning.turns import Turns
from gradhesion.core.types import Floats, Truths

_TRIALS: Final = 12
"""Times that a trace is made longer: a jump may land beyond where the target is surely exceeded."""
_LONGER: Final = 1.5


@kernel()
def is_first_contact(k: float, curve: Series, target: float) -> bool:
    """Return whether a depth is that of the first contact, 0, as far as anybody can tell: against that of the punch."""
    B, m, _, _, _ = curve
    return abs(target) <= CLOSE * B ** (-0.5 * (1.0 - k) / (m - 0.5 * (1.0 - k)))


@kernel()
def is_one_disc(basis: Basis, curve: Series, count: int, trace: Trace, furthest: float, x: float, rim: float) -> bool:
    """Return whether the contact that turns at x is one disc, out to the rim of the punch.

    Loading has not tested the contacts beyond x, so that every trough counts up to where the depth surely exceeds that
    at x: waves of several lengths have deeper ones behind shallow ones. The trace knows all folds up to `furthest`.
    """
    if is_always_one_disc(basis, curve) or x > window(basis, curve)[1]:  # from there on the coordinate rises
        return True
    by_depth = measured_by(curve, NO)
    end = min(rim, reach(basis, by_depth, coordinate(basis, by_depth, x)))
    if not x < end:
        return True
    if end <= furthest:
        lowest = coordinate(basis, curve, end)
        for branch in range(count):
            if x < trace[START, branch] < end:
                lowest = min(lowest, trace[START_DEPTH, branch])
        if is_surely_open(basis, curve, x, coordinate(basis, curve, x) - lowest):
            return True
    return least_opening(basis, curve, x, end) >= 0.0


@kernel()
def turn_walked(
    basis: Basis,
    curve: Series,
    bounds: tuple[float, float],
    turns: Turns,
    reaches: Floats,
    chosen: Truths,
    passed: Truths,
) -> bool:
    """Find the places where the chosen rims of a curve turn, on one trace; return whether it could be walked.

    All folds stand between the two x of `bounds`. Places are in wavelengths, targets in units of the curve. Each rim
    turns within `reaches`, or these are moved outwards; what is found is no longer chosen, and `passed` says whether a
    jump has passed the target. All are of shape (rims,).
    """
    rims, targets, by_load, check, places, flags = turns
    search = Place(room(), np.empty(MOST_FOLDS), 0.0, last_corner(basis, curve, by_load))
    for _ in range(_TRIALS):
        furthest, left = 0.0, False
        for i in range(rims.size):
            if chosen[i]:
                furthest = max(furthest, min(rims[i], reaches[i]))
        count, trace, _ = walk(basis, curve, bounds, furthest, NO)
        if count < 0 or furthest == math.inf:
            return False
        corners, number = corners_of(basis, curve, by_load, count, trace, furthest, search)
        for i in range(rims.size):
            if not chosen[i]:
                continue
            found, x, close, jumped = first_reached(basis, curve, by_load, corners, number, targets[i], 0.0)
            if not found and furthest < rims[i]:
                reaches[i] *= _LONGER
                left = True
                continue
            chosen[i] = False
            places[i], passed[i] = min(x, rims[i]), jumped
            if not x < rims[i]:
                level = coordinate(basis, curve, rims[i]) if rims[i] < math.inf else math.inf
                close = close or rim_is_close(basis, curve, count, trace, rims[i], level)
            elif check and not is_one_disc(basis, curve, count, trace, furthest, x, rims[i]):
                flags[i] |= LOADING_NOT_ONE_DISC
            if close:
                flags[i] |= CLOSE_TO_A_JUMP
        if not left:
            return True
    return False


@kernel()
def _turn_one_far(
    basis: Basis, curve: Series, bounds: tuple[float, float], turns: Turns, surely: float, i: int
) -> tuple[bool, float, int, bool]:
    """Find where rim number i of a long curve turns, as far as is known within x = `surely`.

    Returns
    -------
    Whether that could be done, x, its flags, and whether a jump has passed the target.
    """
    first, last = bounds
    rim, way = turns.rims[i], (turns.by_load, turns.targets[i], last_corner(basis, curve, turns.by_load))
    for _ in range(_TRIALS):
        furthest = min(rim, surely)
        middle = middle_of(basis, curve, first, min(furthest, last), 0.0)
        if middle.kind != REGULAR:
            return False, rim, 0, False
        done, here, whole = turn_far(basis, curve, way, first, middle, furthest)
        if not done:
            return False, rim, 0, False
        found, x, close, jumped = here
        flags = CLOSE_TO_A_JUMP if close else 0
        if found and whole + x < rim:
            if turns.check:
                empty = np.empty((1, 0))
                if not is_one_disc(basis, curve, NONE, empty, 0.0, whole + x, rim):
                    flags |= LOADING_NOT_ONE_DISC
            return True, whole + x, flags, jumped
        if furthest >= rim:
            if rim < math.inf and is_at_a_fold(basis, curve, rim, 0.0):
                flags |= CLOSE_TO_A_JUMP
            return True, rim, flags, False
        surely *= _LONGER
    return False, rim, 0, False


@face_of(Series, "gradhesion.core.turning.patterned")
@kernel()
def turn_chosen(basis: Basis, curve: Series, turns: Turns, chosen: Truths, passed: Truths) -> None:
    """Find the places where the chosen rims of a curve turn, and whether a jump has passed the target.

    As of `turn_walked`; places that are not found are left as they are.
    """
    _, _, series = basis
    edges, targets, by_load, _, places, flags = turns
    count = edges.size
    highest = highest_harmonic(series)
    first, last = window(basis, curve)
    measured = measured_by(curve, by_load)
    reaches, alone = np.empty(count), np.zeros(count, np.bool_)
    together, bound = False, 0.0
    for i in range(count):  # that of the largest is for all that are walked together
        if abs(targets[i]) < math.inf:
            bound = max(bound, targets[i])
    bound = reach(basis, measured, bound)
    for i in range(count):
        if not chosen[i]:
            continue
        reaches[i] = bound
        if bound == math.inf or min(edges[i], bound, last) - first > LONGEST_WALK:
            reaches[i] = reach(basis, measured, targets[i])
        waves = min(edges[i], reaches[i], last) - first
        if series.shape[0] > 0 and LONGEST_WALK < waves < math.inf:
            chosen[i] = False
            middle = middle_of(basis, curve, first, min(edges[i], reaches[i], last), 0.0)
            if middle.kind == REGULAR:
                done, x, found, jumped = _turn_one_far(basis, curve, (first, last), turns, reaches[i], i)
                if done:
                    places[i], passed[i] = x, jumped
                    flags[i] |= found
                    continue
            few = middle.kind == FEW
            bounds = (first, middle.until if few else last)
            alone[i] = few or waves * highest < MOST_CELLS
            if alone[i] and not turn_walked(basis, curve, bounds, turns, reaches, alone, passed):
                alone[i], places[i] = False, math.nan
        elif waves * highest < MOST_CELLS:
            together = True
        else:
            chosen[i] = False
    if together and not turn_walked(basis, curve, (first, last), turns, reaches, chosen, passed):
        for i in range(count):  # too many folds up to the furthest of them
            if chosen[i]:
                alone[i], reaches[i] = True, reach(basis, measured, targets[i])
                turn_walked(basis, curve, (first, last), turns, reaches, alone, passed)
                alone[i] = False


@kernel()
def _turn_curve(basis: Basis, made: Made, turns: Turns, passed: Truths) -> None:
    """Find where the cycles of a curve turn, and whether a jump has passed the target, of shape (rims,).

    Lengths of `turns` are in R, loads in 1.5 pi R dgamma.
    """
    rims, targets, by_load, check, radii, flags = turns
    curve, k = made.curve, basis.table.k
    unit = force_unit(k, made.length, made.depth) if by_load else made.depth
    edges, reduced, places = np.empty(rims.size), np.empty(rims.size), np.empty(rims.size)
    chosen = np.zeros(rims.size, np.bool_)
    for i in range(rims.size):
        target = targets[i] / unit
        edges[i], reduced[i], places[i] = rims[i] / made.wavelength, target, math.nan
        if not (rims[i] > 0.0 and abs(target) < math.inf and (target > 0.0 or not by_load)):
            continue
        if not by_load and is_first_contact(k, curve, target):
            flags[i] |= CLOSE_TO_A_JUMP
        if target < 0.0:
            places[i] = 0.0
        else:
            chosen[i] = True
    turn_chosen(basis, curve, Turns(edges, reduced, by_load, check, places, flags), chosen, passed)
    for i in range(rims.size):
        if math.isnan(places[i]):
            radii[i], flags[i] = math.nan, NO_VALUE | (flags[i] & TOO_MANY_WAVES)
        else:
            radii[i] = rims[i] if places[i] == edges[i] else min(rims[i], places[i] * made.wavelength)


@kernel()
def turn_scenes(basis: Basis, curves: GeneralCurves, turns: Turns, passed: Truths) -> None:
    """Find where the cycles of curves of one gradient exponent turn; their rims are those of `turns`.

    What is found goes there, and to `passed`, of shape (curves, rims): whether a jump has passed the target, so that
    the cycle turns beyond it.
    """
    _, targets, by_load, check, radii, flags = turns
    for i in curves.numbers:
        made = curve_at(basis, curves, i)
        if not made.valid:
            radii[i, :], flags[i, :] = math.nan, NO_VALUE
            continue
        row = targets[i if targets.shape[0] > 1 else 0]
        own = Turns(rims_of(curves, i), row, by_load, check, radii[i], flags[i])
        _turn_curve(Basis(basis.table, made.cosine_bins, made.series), made, own, passed[i])
