"""Where the cycles of one cosine wave turn: at a depth, or at a load (physics in docs/theory.md, section 16).

Nothing beyond the place is walked where the lower envelope reaches the target, and no branch before the place where the
upper one does (turning/cosine_reach.py). All scenes of a curve share one trace. Depths that are reached among the waves
of a long curve are searched eight at a time (turning/cosine_at_once.py).
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, ONE, YES, kernel
from gradhesion.core.contact.least import least_opening
from gradhesion.core.curve.branches import END, END_DEPTH, GAP, RUN, START, START_DEPTH, WORK, Trace, ends, find_depth
from gradhesion.core.curve.cosine import Cosine, curve_of, depth, force_unit
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.face import is_always_one_disc
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import LANES, Lanes, eight, lane_of, next_lane
from gradhesion.core.path.cosine import (
    LARGEST,
    MOST_ARCHES,
    extent,
    is_endless_wave,
    is_long,
    is_smooth,
    is_unresolved,
    walk,
)
from gradhesion.core.path.cosine_long import Long, begin_long, ends_folds, open_gap, stride
from gradhesion.core.path.ties import is_within, rim_is_close
from gradhesion.core.problem.curves import Curves, is_in_range
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE
from gradhesion.core.struve.current import ready
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.turning.cosine_at_once import turns_at_once
from gradhesion.core.turning.cosine_reach import reach, reach_outwards
from gradhesion.core.turning.first_reached import (
    Peaks,
    peaks_of,
    turn_at_depth,
    turn_at_load,
)
from gradhesion.core.turning.smooth import has_value, turn_smooth
from gradhesion.core.turning.turns import Turns
from gradhesion.core.types import Floats, Table

_AROUND: Final = 1.25
"""Waves beyond a regular one within which the next branch meets every depth of it."""


class Goal(NamedTuple):
    """One rim of a curve, and what its cycle turns at."""

    rim: float  # x = a_max/lambda
    target: float  # the depth or load, in the units of the curve
    reach: float  # x within which it turns at the rim or before it, as far as the envelopes tell
    wavelength: float  # lambda/R
    by_load: bool  # whether the target is a load
    check: bool  # whether the contact that turns is tested for being one disc


@kernel()
def _is_first_contact(k: float, b: float, target: float) -> bool:
    """Return whether a depth is that of the first contact, 0, as far as anybody can tell."""
    return abs(target) <= CLOSE * (2.0 / b) ** ((1.0 - k) / (3.0 + k))


@kernel()
def _is_vague(table: Table, arches: tuple[float, float], reach: float) -> bool:
    """Return whether folds stand so far out that a double does not resolve the waves on the way of loading."""
    return is_long(table, arches, reach) and min(arches[1], 2.0 * reach) > MOST_ARCHES


@kernel()
def _is_one_disc(table: Table, curve: Cosine, count: int, trace: Trace, x: float, rim: float) -> bool:
    """Return whether the contact that turns at x is one disc, out to the rim of the punch."""
    if is_always_one_disc(table, curve):
        return True
    level = depth(table, curve, x)
    now = count - 1
    while now >= 0 and trace[START, now] > x:
        now -= 1
    gap = trace[RUN, GAP]
    if now >= 0 and (gap == math.inf or now >= gap or x <= trace[END, now]):
        if trace[END, now] == math.inf:
            return True
        lowest = math.inf
        end = min(rim, reach_outwards(table, curve, max(0.0, level), NO))
        for other in range(now + 1, count):
            if other == gap:
                break
            lowest = min(lowest, trace[START_DEPTH, other])
            if trace[END_DEPTH, other] > level:
                end = min(rim, find_depth(table, curve, level, ends(trace, other)))
                z = TWO_PI * x
                if lowest + z * amplitude_power(table, z) >= level:
                    return True
                break
    else:
        end = min(rim, x + _AROUND)
    return not x < end or least_opening(table, curve, x, end) >= 0.0


@kernel()
def _turn_rim(table: Table, curve: Cosine, count: int, trace: Floats, peaks: Peaks, goal: Goal) -> tuple[float, int]:
    """Return x where the cycle of one rim turns, inf for the rim, and its flags.

    The trace has `count` branches, and waves may stand in a gap of it. Under loads `peaks` are those of `peaks_of`.
    """
    rim, target, reach, wavelength, by_load, check = goal
    if by_load:
        x, close = turn_at_load(table, curve, count, trace, peaks, reach, target)
    else:
        x, close = turn_at_depth(table, curve, count, trace, reach, target)
        close = close or _is_first_contact(table.k, curve.bend, target)
    flags = 0
    if not (x < rim and x * wavelength < rim * wavelength):
        x = math.inf
        level = depth(table, curve, rim) if rim < math.inf else math.inf
        close = close or rim_is_close(table, curve, count, trace, rim, level)
    elif check and not _is_one_disc(table, curve, count, trace, x, rim):
        flags |= LOADING_NOT_ONE_DISC
    return x, flags | CLOSE_TO_A_JUMP if close else flags


@kernel()
def _turn_long(table: Table, curve: Cosine, inner: float, goal: Goal, long: Long) -> tuple[float, int]:
    """Return what `_turn_rim` does for a rim of a long curve; within x = `inner` its load is not reached.

    A cycle that turns among the waves of a gap, surely before the rim, needs no branch beyond the gap.
    """
    count = long.shared[0].near
    inside = goal.reach < goal.rim and not ends_folds(table, long.arches, goal.reach)
    if not inside or not open_gap(table, curve, goal.reach, long):
        count = stride(table, curve, goal.reach, long, NO, 1.0)
    trace = long.trace
    peaks = peaks_of(table, curve, count, trace, inner, ONE) if goal.by_load else trace[WORK]
    return _turn_rim(table, curve, count, trace, peaks, goal)


@kernel()
def _turn_eight(
    table: Table,
    curve: Cosine,
    wavelength: float,
    waiting: tuple[int, Lanes, Lanes],
    reaches: Floats,
    turns: Turns,
    long: Long,
) -> None:
    """Turn the rims of a long curve that wait at their depths: at once where these are those of regular waves.

    `waiting` is how many they are, their numbers, and their depths in s l^c; `reaches` are x within which each rim
    turns, of shape (rims,).
    """
    count, indices, targets = waiting
    rims, _, _, check, radii, flags = turns
    shared, trace = long.shared[0], long.trace
    now = shared.last_up
    left, level = (trace[END, now], trace[END_DEPTH, now]) if now >= 0 else (0.0, 0.0)
    places, waves, ends, tops, befores = turns_at_once(table, curve, targets)
    for lane in range(count):
        i, x, target, end = (
            int(lane_of(indices, lane)),
            lane_of(places, lane),
            lane_of(targets, lane),
            lane_of(ends, lane),
        )
        rim = rims[i] / wavelength
        among = x < rim and x * wavelength < rim * wavelength and lane_of(waves, lane) > shared.before + 1.0
        if (
            not among
            or ends_folds(table, long.arches, end)
            or target <= level
            or is_within(table, curve, target - level, left)
        ):
            goal = Goal(rim, target, reaches[i], wavelength, NO, check)
            x, flags[i] = _turn_long(table, curve, 0.0, goal, long)
            radii[i] = min(rims[i], x * wavelength)
            continue
        radii[i] = min(rims[i], x * wavelength)
        apart = min(target - lane_of(befores, lane), lane_of(tops, lane) - target)
        if is_within(table, curve, apart, end) or _is_first_contact(table.k, curve.bend, target):
            flags[i] |= CLOSE_TO_A_JUMP
        if check and not is_always_one_disc(table, curve):
            outer = min(rim, x + _AROUND)
            if least_opening(table, curve, x, outer) < 0.0:
                flags[i] |= LOADING_NOT_ONE_DISC


@kernel()
def _turn_curve(
    table: Table,
    curve: Cosine,
    arches: tuple[float, float],
    wavelength: float,
    unit: float,
    turns: Turns,
    scratch: Trace,
) -> None:
    """Turn a wavy punch, all its rims: they share one trace, or the beginning of a long one.

    `arches` are the first and the last one on which the curve can fold, `unit` is that of depth or of load.
    """
    rims, targets, by_load, check, radii, flags = turns
    b, g, _ = curve
    least, greatest = math.inf, -math.inf
    for i in range(rims.size):
        target = targets[i] / unit
        radii[i], flags[i] = rims[i], 0
        if not has_value(rims[i], target, by_load):
            radii[i], flags[i] = math.nan, NO_VALUE
        elif target < 0.0:  # the first contact is at the depth 0
            radii[i], flags[i] = 0.0, CLOSE_TO_A_JUMP if _is_first_contact(table.k, curve.bend, target) else 0
        else:
            least, greatest = min(least, target), max(greatest, target)
    if greatest < least:
        return
    furthest = 0.0
    reaches = np.zeros(rims.size)
    bound = reach_outwards(table, curve, greatest, by_load)
    for i in range(rims.size):
        if radii[i] > 0.0:
            reaches[i] = min(rims[i] / wavelength, bound)
            if is_long(table, arches, reaches[i]):
                reaches[i] = min(rims[i] / wavelength, reach_outwards(table, curve, targets[i] / unit, by_load))
            if is_unresolved(arches, reaches[i]) or _is_vague(table, arches, reaches[i]):
                radii[i], flags[i], reaches[i] = math.nan, NO_VALUE, 0.0
            elif not is_long(table, arches, reaches[i]):
                furthest = max(furthest, reaches[i])
    inner = reach(table.k, b, 1.0 - g * table.amplitude, least, YES, NO) if by_load else 0.0
    if furthest > 0.0:
        count, trace = walk(table, curve, arches, furthest, scratch, NO)
        peaks = peaks_of(table, curve, count, trace, inner, rims.size) if by_load else reaches
        for i in range(rims.size):
            if reaches[i] > 0.0 and not is_long(table, arches, reaches[i]):
                goal = Goal(rims[i] / wavelength, targets[i] / unit, reaches[i], wavelength, by_load, check)
                x, flags[i] = _turn_rim(table, curve, count, trace, peaks, goal)
                radii[i] = min(rims[i], x * wavelength)
    begun, number, indices, levels = False, NONE, eight(0.0), eight(0.0)
    for i in range(rims.size):
        if reaches[i] > 0.0 and is_long(table, arches, reaches[i]):
            if not begun:
                long = begin_long(table, curve, arches, scratch, NO, 1.0)
                begun = True
            if by_load:
                goal = Goal(rims[i] / wavelength, targets[i] / unit, reaches[i], wavelength, by_load, check)
                x, flags[i] = _turn_long(table, curve, inner, goal, long)
                radii[i] = min(rims[i], x * wavelength)
                continue
            indices, levels = next_lane(indices, number, float(i)), next_lane(levels, number, targets[i] / unit)
            number += 1
            if number == LANES:
                _turn_eight(table, curve, wavelength, (number, indices, levels), reaches, turns, long)
                number = NONE
    if number > 0:
        _turn_eight(table, curve, wavelength, (number, indices, levels), reaches, turns, long)


@kernel()
def turn_curves(curves: Curves, turns: Turns, scratch: Trace) -> None:
    """Find where the cycles of curves turn; their rims are those of `turns`, where also goes what is found."""
    tables, which, index, stiffness, wavelength, amplitude, _ = curves
    rims, targets, by_load, check, radii, flags = turns
    for j in range(index.size):
        i, table = index[j], tables[ready(tables, which[j])]
        k = table.k
        stretch_factor = 2.0 ** (1.0 + k) * math.pi
        row = i if rims.shape[0] > 1 else 0
        stretch = math.sqrt(stretch_factor / stiffness[i])
        if not is_in_range(stretch, wavelength[i], amplitude[i]):
            radii[i, :], flags[i, :] = math.nan, NO_VALUE
            continue
        plain = is_endless_wave(wavelength[i], amplitude[i])
        curve, length, unit = curve_of(k, stretch, wavelength[i], amplitude[i] * wavelength[i])
        arches = (0.0, 0.0)
        if not plain:
            if not (0.0 < curve.bend < LARGEST and curve.gain < LARGEST):
                radii[i, :], flags[i, :] = math.nan, NO_VALUE
                continue
            arches = extent(table, curve)
            plain = is_smooth(arches)
        if by_load:
            unit = force_unit(k, length, unit)
        own = Turns(rims[row], targets[row], by_load, check, radii[i], flags[i])
        if plain:
            turn_smooth(k, stretch, own)
        else:
            _turn_curve(table, curve, arches, wavelength[i], unit, own, scratch)
