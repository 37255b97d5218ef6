"""A cycle on a curve of one cosine with many waves: its first and last waves are traced, those in between are summed.

The branches near the beginning and near the rim stand in one trace (curve/branches.py). The run of waves between them
is regular, and what passes it enters as what loading has lost where it arrives beyond it, and as what unloading still
has to lose.

The beginning is shared by all rims, as are the samples of the sums (waves/cosine_running.py): a rim adds the branch on
which it stands and the one before, or less (path/cosine_rims.py). Only where the folds end are the last waves walked.
What a rim gets does not depend on the other rims of its curve.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, YES, kernel
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    GAP,
    LAST_DEPTH,
    LOADING_JUMPS,
    LOADING_LOSS,
    RUN,
    RUN_AFTER,
    RUN_BEFORE,
    RUN_FIRST,
    RUN_LANDING,
    RUN_LAST,
    RUN_LEAST,
    RUN_LOWEST,
    START,
    TANGENCY,
    UNLOADING_JUMPS,
    UNLOADING_LOSS,
    WORK,
    Trace,
    append_branches,
    ends,
    find_depth,
    room_for,
)
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import energy_from_zero, jump_energy
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.cosine import MOST_ARCHES
from gradhesion.core.path.cosine_waves import first_wave_above, is_reported, lowest_wave, put_nominal_branch, wave_of
from gradhesion.core.path.loading import arrive, climb, load_up
from gradhesion.core.path.ties import first_close_pair, note_loading, note_loading_from, scan_inwards, tolerance
from gradhesion.core.path.unloading import descend, leave
from gradhesion.core.types import Floats, Table
from gradhesion.core.waves.cosine import branch_of_wave, fold_of_wave, landing_of_wave
from gradhesion.core.waves.cosine_at_once import Batch, room_for_batch
from gradhesion.core.waves.cosine_running import begin_sums, room_for_sums, sum_up_to
from gradhesion.core.waves.cosine_sum import sum_of_waves

BEGINNING: Final = 9.0
"""Waves walked at the beginning; z > 50 there."""
NEAR_RIM: Final = 10.0
"""Waves walked before the folds end."""
_BEFORE_RIM: Final = 2.5
"""Waves before a rim that its own branch and the one before stand on."""
SHARED: Final = np.dtype(
    [
        ("near", "i8"),  # branches of the beginning
        ("before", "f8"),  # the wave of the last of them
        ("last_up", "i8"),  # the last branch of the beginning that loading arrives on, -1 for none
        ("first_close", "f8"),  # x where a pair of folds, or the way through the gap, is close first; inf for nowhere
        ("entry", "f8"),  # the wave of the gap that loading enters first, NaN as long as it is not found
        ("entry_place", "f8"),  # x where it does
        ("entry_loss", "f8"),  # what it has lost by then, in 2 pi l^2 dgamma
        ("entry_jumps", "f8"),
        ("lowest", "f8"),  # the wave that starts lowest, NaN as long as it is not found
        ("lowest_loss", "f8"),  # what unloading loses from its start to the end of contact
        ("lowest_jumps", "f8"),
        ("lowest_last", "f8"),  # the depth at which contact ends
        ("lowest_branch", "i8"),  # the branch of the beginning on which unloading arrives from there, -1 for none
        ("disc_inner", "f8"),  # x between which loading of the beginning ceases to keep the contact one disc, NaN as
        ("disc_outer", "f8"),  # long as it is not known
        ("run_seen", "i8"),  # whether the contact on the waves of the gap has been examined
    ]
)
"""What all rims of a long curve share, found when a rim first needs it."""


class Long(NamedTuple):
    """A long curve: the results of `begin_long`, and those shared by all its rims."""

    arches: tuple[float, float]  # the first and the last arch on which the curve can fold
    trace: Trace  # the branches of the beginning, and from there on those of one rim; (ROWS, branches):
    # curve/branches.py
    shared: Any  # one record `SHARED`, of shape (1,)
    sums: Any  # the sums over waves outwards and inwards, records of waves/cosine_running.py, of shape (2,)
    room: Batch  # room for a batch of waves (waves/cosine_at_once.py)


@kernel()
def begin_long(
    table: Table, curve: Cosine, arches: tuple[float, float], trace: Floats, losses: bool, reach: float
) -> Long:
    """Walk the first waves of a long curve, `reach` times as many as `BEGINNING`, 1 or 2.

    `arches` are the first and the last one that can fold, `trace` is room for branches, of shape (ROWS, branches); with
    `losses` the energies of jumps are found.
    """
    first, final = arches
    trace = room_for(trace, 4.0 * reach * (BEGINNING + NEAR_RIM))
    shares = np.empty(1, SHARED)
    shared = shares[0]
    shared.entry = shared.lowest = shared.disc_inner = math.nan
    shared.run_seen = NONE
    trace[TANGENCY, 0], trace[RUN, RUN_LEAST] = math.inf, math.nan
    near, before = 0, 0.5 * first
    if first < MOST_ARCHES:
        beginning = (0.5 * first + reach * BEGINNING) + table.phase / TWO_PI
        near = append_branches(table, curve, int(first), final, beginning, trace, NONE)
        before = wave_of(table, trace[START, near - 1]) if near > 0 else before
    shared.near, shared.before, shared.first_close = near, before, first_close_pair(near, trace)
    shared.last_up = load_up(table, curve, near, trace, math.inf, losses)
    note_loading(table, curve, near, trace, math.inf)
    return Long(arches, trace, shares, room_for_sums(), room_for_batch())


@kernel()
def ends_folds(table: Table, arches: tuple[float, float], rim: float) -> bool:
    """Return whether a rim stands among the last waves that fold, or beyond them."""
    return 2.0 * rim - table.phase / math.pi + 3.0 >= arches[1] - 2.0 * (NEAR_RIM - _BEFORE_RIM)


@kernel()
def sum_of_gap(
    table: Table, curve: Cosine, long: Long, first: float, last: float, outwards: bool, running: bool
) -> float:
    """Return the loss of the waves `first` to `last` of the gap, for one rim or from the sums of all rims (running).

    It is in 2 pi l^2 dgamma, of loading (outwards) or unloading.
    """
    final = long.arches[1]
    if not running:
        return sum_of_waves(table, curve, first, last, outwards, final, long.room)
    sums = long.sums[0 if outwards else 1]
    if sums.count < 0:
        begin_sums(table, curve, sums, first, outwards, final)
    return sum_up_to(table, curve, sums, last, outwards, final, long.room)


@kernel()
def entry(table: Table, curve: Cosine, after: float, long: Long, losses: bool) -> tuple[float, float, float, float]:
    """Return the first wave of the gap that loading stands on, x there, and what it has lost and jumped by then.

    It comes from the last branch of the beginning (the place is 0 then), or by one long jump to the first wave that
    ends above the depth, which the wave `after` does.
    """
    shared, trace = long.shared[0], long.trace
    now = shared.last_up
    loss, jumps = (trace[LOADING_LOSS, now], trace[LOADING_JUMPS, now]) if now >= 0 else (0.0, 0.0)
    if 0 <= now == shared.near - 1:
        return shared.before, 0.0, loss, jumps
    if math.isnan(shared.entry):
        left, level = (trace[END, now], trace[END_DEPTH, now]) if now >= 0 else (0.0, 0.0)
        wave, end, top, _, top_before = first_wave_above(table, curve, shared.before, after, level)
        if math.isnan(top):  # the wave is `after` itself
            end, top = fold_of_wave(table, curve, wave, NO)
        close = tolerance(table, curve, end)
        if abs(top - level) <= close or abs(top_before - level) <= close:
            shared.first_close = min(shared.first_close, end)
        x = find_depth(table, curve, level, branch_of_wave(table, curve, wave))
        if losses and now >= 0:
            loss += jump_energy(table, curve, left, x, trace[WORK])
        elif losses:
            loss = energy_from_zero(table, curve, x, 0.0)
        shared.entry, shared.entry_place, shared.entry_loss, shared.entry_jumps = wave, x, loss, jumps + 1.0
    return shared.entry, shared.entry_place, shared.entry_loss, shared.entry_jumps


@kernel()
def _load_through(
    table: Table, curve: Cosine, long: Long, count: int, after: float, rim: float, running: bool, losses: bool
) -> None:
    """Follow loading from the beginning through the gap to the `count` branches up to x = `rim`.

    The wave `after` is the first that has a branch again.
    """
    shared, trace = long.shared[0], long.trace
    near, now = shared.near, shared.last_up
    trace[ARRIVAL, near:count] = math.inf
    trace[RUN, GAP], trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST] = near, 0.0, -1.0
    level = trace[END_DEPTH, now] if now >= 0 else 0.0
    if trace[END_DEPTH, near] > level:
        wave, x, loss, jumps = entry(table, curve, after, long, losses)
        if wave < after:
            trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST], trace[RUN, RUN_LANDING] = wave, after - 1.0, x
            if losses:
                loss += sum_of_gap(table, curve, long, wave, after - 1.0, YES, running)
            x = after - 1.0 + landing_of_wave(table, curve, after - 1.0, YES)
            jumps += after - wave
        arrive(trace, near, x, loss, jumps)
        now = near
    climb(table, curve, now, count, trace, rim, losses)


@kernel()
def leave_lowest(table: Table, curve: Cosine, long: Long, losses: bool) -> None:
    """Find the wave of the gap that starts lowest, and what unloading loses from there on, if that is not known yet."""
    shared, trace = long.shared[0], long.trace
    if not math.isnan(shared.lowest):
        return
    near, before = shared.near, shared.before
    lowest, close = lowest_wave(table, curve, before, max(before, np.floor(0.5 * long.arches[1] - NEAR_RIM)))
    loss, jumps, last, lower = 0.0, 1.0, 0.0, near - 1
    if lowest == before and near > 0:
        descend(table, curve, trace, near - 1, losses)
        loss, jumps, last = (
            trace[UNLOADING_LOSS, near - 1],
            trace[UNLOADING_JUMPS, near - 1],
            trace[LAST_DEPTH, near - 1],
        )
    else:
        start, level = fold_of_wave(table, curve, lowest, YES)
        hardly, lower = scan_inwards(table, curve, trace, near - 1, level, start)
        close = close or hardly
        if lower >= 0:
            descend(table, curve, trace, lower, losses)
            landing = find_depth(table, curve, level, ends(trace, lower))
            loss = jump_energy(table, curve, start, landing, trace[WORK]) if losses else 0.0
            loss, jumps, last = (
                loss + trace[UNLOADING_LOSS, lower],
                1.0 + trace[UNLOADING_JUMPS, lower],
                trace[LAST_DEPTH, lower],
            )
        else:
            loss, last = -energy_from_zero(table, curve, start, level) if losses else 0.0, level
    shared.lowest, shared.lowest_loss, shared.lowest_jumps, shared.lowest_last = lowest, loss, jumps, last
    shared.lowest_branch = lower
    if close:
        shared.first_close = min(shared.first_close, lowest)


@kernel()
def _unload_through(table: Table, curve: Cosine, after: float, long: Long, running: bool, losses: bool) -> None:
    """Give the first branch after the gap, that of the wave `after`, what unloading loses from there into the gap."""
    shared, trace = long.shared[0], long.trace
    leave_lowest(table, curve, long, losses)
    lowest = min(shared.lowest, after)  # starts fall outwards up to the lowest one
    trace[RUN, RUN_BEFORE], trace[RUN, RUN_AFTER], trace[RUN, RUN_LOWEST] = shared.before, after, lowest
    if lowest == after:  # nothing in the gap is lower
        return
    loss = shared.lowest_loss
    if losses:
        loss += sum_of_gap(table, curve, long, lowest + 1.0, after, NO, running)
    leave(trace, shared.near, loss, shared.lowest_jumps + after - lowest, shared.lowest_last)


@kernel()
def stride(table: Table, curve: Cosine, rim: float, long: Long, losses: bool, reach: float) -> int:
    """Put what `begin_long` leaves out into the trace, for a rim x = a/lambda; return the number of branches.

    The trace of a rim for which `ends_folds` holds is valid for all rims before it that do so too, unless the phase is
    not resolved there. A `reach` of up to 2 walks that many times as many waves at either end, and sums those between
    for the rim alone, which measures the accuracy of the sums (scene/cosine_report.py).
    """
    arches, trace, shared = long.arches, long.trace, long.shared[0]
    final, near = arches[1], shared.near
    trace[TANGENCY, 0] = shared.first_close
    running = reach == 1.0 and not ends_folds(table, arches, rim)
    last, waves = 2.0 * rim - table.phase / math.pi + 3.0, _BEFORE_RIM + NEAR_RIM * (reach - 1.0)
    if ends_folds(table, arches, rim):
        last, waves = final, reach * NEAR_RIM
    count, after = near, 0.0
    if is_reported(table, curve, last):
        count = append_branches(table, curve, 2 * int(0.5 * last - waves) - 1, final, rim, trace, near)
        after = wave_of(table, trace[START, near]) if count > near else 0.0
    nominal = count == near
    if nominal:
        after = put_nominal_branch(table, curve, rim, 0.5 * final, trace, near)
        count = near + 1
    _load_through(table, curve, long, count, after, rim, running, losses)
    if nominal and trace[ARRIVAL, near] < math.inf and rim <= 0.5 * final:
        trace[ARRIVAL, near] = trace[START, near]
    _unload_through(table, curve, after, long, running, losses)
    trace[TANGENCY, 0] = min(trace[TANGENCY, 0], shared.first_close)
    note_loading_from(table, curve, near, count, trace, rim)
    return count


@kernel()
def open_gap(table: Table, curve: Cosine, place: float, long: Long) -> bool:
    """Let the gap end at a wave beyond x = `place`, with no branch beyond; return whether loading goes through the gap.

    That is enough for a cycle that surely turns before the place.
    """
    shared, trace = long.shared[0], long.trace
    now = shared.last_up
    after = np.floor(place - table.phase / TWO_PI) + 1.0
    _, top = fold_of_wave(table, curve, after, NO)
    if not top > (trace[END_DEPTH, now] if now >= 0 else 0.0):
        return False
    trace[TANGENCY, 0] = shared.first_close
    wave, x, _, _ = entry(table, curve, after, long, NO)
    trace[RUN, GAP], trace[RUN, RUN_BEFORE], trace[RUN, RUN_AFTER] = shared.near, shared.before, after
    trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST], trace[RUN, RUN_LANDING] = wave, after, x
    return True
