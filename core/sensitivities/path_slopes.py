"""The slopes of the energy of a whole cycle: those of its jumps, read off the trace of its curve.

Slopes are kept with the branches, as a trace keeps losses: those of loading up to where it arrives on a branch, and
those of unloading from the start of a branch to the end of contact. So all rims of a curve share them. One row more
than the slopes marks whether those of unloading are there.

The curve is any whose kind has the functions for sensitivities (core/face.py).
"""

import math
from typing import NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    LANDING,
    NEXT,
    NOWHERE,
    RUN,
    RUN_AFTER,
    RUN_BEFORE,
    RUN_FIRST,
    RUN_LANDING,
    RUN_LAST,
    RUN_LOWEST,
    START,
    UNLOADING_JUMPS,
    Trace,
)
from gradhesion.core.face import (
    AnyCurve,
    AnyNear,
    AnyTable,
    add_slopes,
    add_slopes_of_waves,
    add_slopes_to_zero,
    find_place,
    gap_in,
    rim_slope,
    start_of_wave,
    steepness_at,
)
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.unloading import descend, leave_rim, next_lower
from gradhesion.core.problem.results import LOADING_PART, UNLOADING_PART
from gradhesion.core.sensitivities.jump_slopes import DEPTH, SLOPES
from gradhesion.core.sensitivities.wave_slopes import ROOM
from gradhesion.core.types import Floats, Slopes, Work

LOADED, UNLOADED, KNOWN = 0, SLOPES, 2 * SLOPES
ROWS = 2 * SLOPES + 1
"""Rows of the array that goes with a trace."""


class Traced(NamedTuple):
    """A trace with the slopes of energies by the numbers of its curve (sensitivities/jump_slopes.py)."""

    branches: int  # how many the trace has
    trace: Trace  # the branches, of shape (core.curve.branches.ROWS, branches or more)
    final: float  # the last arch on which the curve folds
    slopes: Floats  # those of loading and unloading, a column a branch, and whether the latter are there; two rows more
    # are room for a jump and for its slopes; of shape (ROWS + 2, columns)


@kernel()
def with_slopes(count: int, trace: Floats, final: float) -> Traced:
    """Return a trace of `count` branches with room for its slopes; `final` is the last arch on which it folds."""
    slopes = np.empty((ROWS + 2, max(trace.shape[1], ROOM)))
    slopes[:ROWS] = 0.0
    return Traced(count, trace, final, slopes)


@kernel()
def _enter(
    table: AnyTable, curve: AnyCurve, near: AnyNear, now: int, left: float, x: float, work: Work, total: Slopes
) -> None:
    """Add a jump of loading that leaves branch `now` at x = `left`, or zero contact if it is on none yet (-1)."""
    if now < 0:
        add_slopes_to_zero(table, curve, near, x, NO, total)
    else:
        add_slopes(table, curve, near, left, x, work, total)


@kernel()
def _enter_through(
    table: AnyTable, curve: AnyCurve, near: AnyNear, now: int, left: float, arrival: float, traced: Traced
) -> None:
    """Add loading from branch `now`, left at x = `left`, to x = `arrival` on the first branch after a gap.

    It goes through the waves of the gap if the trace says so.
    """
    _, trace, final, slopes = traced
    work, total = slopes[ROWS], slopes[ROWS + 1, :SLOPES]
    if trace[RUN, RUN_LAST] >= trace[RUN, RUN_FIRST]:
        if trace[RUN, RUN_LANDING] > 0.0:
            _enter(table, curve, near, now, left, trace[RUN, RUN_LANDING], work, total)
        waves = trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST]
        add_slopes_of_waves(table, curve, near, waves, YES, final, work, total)
    else:
        _enter(table, curve, near, now, left, arrival, work, total)


@kernel()
def fill_loading(table: AnyTable, curve: AnyCurve, near: AnyNear, traced: Traced) -> None:
    """Put the slopes of loading to where it arrives on each branch into their rows."""
    count, trace, _, slopes = traced
    work, total = slopes[ROWS], slopes[ROWS + 1, :SLOPES]
    total[:] = 0.0
    now, gap = NOWHERE, gap_in(curve, trace)
    for branch in range(count):
        if trace[ARRIVAL, branch] == math.inf:
            continue
        left = trace[END, now] if now >= 0 else 0.0
        if now < gap and branch == gap:
            _enter_through(table, curve, near, now, left, trace[ARRIVAL, branch], traced)
        else:
            _enter(table, curve, near, now, left, trace[ARRIVAL, branch], work, total)
        slopes[LOADED : LOADED + SLOPES, branch] = total
        now = branch


@kernel()
def _add_loading(table: AnyTable, curve: AnyCurve, near: AnyNear, traced: Traced, rim: float, total: Slopes) -> float:
    """Add the slopes of loading up to a rim x to `total`, of shape (SLOPES,); return that by ln x of the rim."""
    count, trace, _, slopes = traced
    now = count - 1
    while now >= 0 and not trace[ARRIVAL, now] <= rim:
        now -= 1
    left, level = (trace[END, now], trace[END_DEPTH, now]) if now >= 0 else (0.0, 0.0)
    if now >= 0:
        total += slopes[LOADED : LOADED + SLOPES, now]
    if left >= rim:
        return 0.0
    _enter(table, curve, near, now, left, rim, slopes[ROWS], total)
    return float(rim_slope(table, curve, level, rim))


@kernel()
def _leave(table: AnyTable, curve: AnyCurve, near: AnyNear, traced: Traced, now: int) -> None:
    """Put the slopes of unloading from the start of branch `now` into its rows; those of all further in are there."""
    _, trace, _, slopes = traced
    total, work = slopes[ROWS + 1, :SLOPES], slopes[ROWS]
    total[:] = 0.0
    if trace[START, now] > 0.0:
        lower = int(trace[NEXT, now])
        if lower < 0:
            add_slopes_to_zero(table, curve, near, trace[START, now], YES, total)
        else:
            add_slopes(table, curve, near, trace[START, now], trace[LANDING, now], work, total)
            total += slopes[UNLOADED : UNLOADED + SLOPES, lower]
    slopes[UNLOADED : UNLOADED + SLOPES, now] = total
    slopes[KNOWN, now] = 1.0


@kernel()
def _leave_through(table: AnyTable, curve: AnyCurve, near: AnyNear, traced: Traced, gap: int) -> None:
    """Do the same for the first branch after a gap, number `gap`, from which unloading goes on into the gap."""
    _, trace, final, slopes = traced
    before, after, lowest = trace[RUN, RUN_BEFORE], trace[RUN, RUN_AFTER], trace[RUN, RUN_LOWEST]
    total, work = slopes[ROWS + 1, :SLOPES], slopes[ROWS]
    if lowest == before and gap > 0:
        total[:] = slopes[UNLOADED : UNLOADED + SLOPES, gap - 1]
    else:
        total[:] = 0.0
        start, level = start_of_wave(table, curve, lowest)
        lower = next_lower(trace, gap - 1, level)
        if lower >= 0:
            landing = find_place(table, curve, level, trace, lower)
            add_slopes(table, curve, near, start, landing, work, total)
            total += slopes[UNLOADED : UNLOADED + SLOPES, lower]
        else:
            add_slopes_to_zero(table, curve, near, start, YES, total)
    add_slopes_of_waves(table, curve, near, (lowest + 1.0, after), NO, final, work, total)
    slopes[UNLOADED : UNLOADED + SLOPES, gap] = total
    slopes[KNOWN, gap] = 1.0


@kernel()
def _fill_unloading(table: AnyTable, curve: AnyCurve, near: AnyNear, traced: Traced) -> None:
    """Put the slopes of unloading from the start of each branch that it has visited into their rows."""
    count, trace, _, slopes = traced
    gap = gap_in(curve, trace)
    for branch in range(count):
        if trace[UNLOADING_JUMPS, branch] >= 0.0 and slopes[KNOWN, branch] == 0.0:
            if branch == gap and trace[RUN, RUN_LOWEST] != trace[RUN, RUN_AFTER]:
                _leave_through(table, curve, near, traced, branch)
            else:
                _leave(table, curve, near, traced, branch)


@kernel()
def _add_unloading(
    table: AnyTable, curve: AnyCurve, near: AnyNear, traced: Traced, rim: float, rim_depth: float, total: Slopes
) -> float:
    """Add the slopes of unloading from a rim x to `total`, of shape (SLOPES,); return that by ln x of the rim."""
    count, trace, _, slopes = traced
    now, landing = leave_rim(table, curve, count, trace, rim, rim_depth)
    if now >= 0:
        descend(table, curve, trace, now, NO)
        _fill_unloading(table, curve, near, traced)
    if now >= 0 and landing == rim:
        total += slopes[UNLOADED : UNLOADED + SLOPES, now]
        return 0.0
    before = total[DEPTH]
    if now < 0:
        add_slopes_to_zero(table, curve, near, rim, YES, total)
    else:
        add_slopes(table, curve, near, rim, landing, slopes[ROWS], total)
    by_depth = total[DEPTH] - before
    if now >= 0:
        total += slopes[UNLOADED : UNLOADED + SLOPES, now]
    return float(by_depth * steepness_at(table, curve, rim) * TWO_PI * rim)


@kernel()
def energy_slopes(
    table: AnyTable,
    curve: AnyCurve,
    near: AnyNear,
    traced: Traced,
    rim: float,
    rim_depth: float,
    parts: int,
    total: Slopes,
) -> float:
    """Put the slopes of the reduced energy of a rim x into `total`; return that by ln x of the rim.

    They are slopes by the numbers of sensitivities/jump_slopes.py, of shape (SLOPES,), in 2 pi l^2 dgamma, of the parts
    of the cycle that `part_of` (problem/results.py) names. `traced` has the slopes that `fill_loading` has put there
    and those found for other rims; `rim_depth` is what is prescribed at the rim, in s l^c.
    """
    total[:] = 0.0
    by_rim = 0.0
    if parts & LOADING_PART:
        by_rim += _add_loading(table, curve, near, traced, rim, total)
    if parts & UNLOADING_PART:
        by_rim += _add_unloading(table, curve, near, traced, rim, rim_depth, total)
    return by_rim
