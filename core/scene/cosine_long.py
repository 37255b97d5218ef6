"""The rims of a punch with one cosine wave that no walk reaches (path/cosine_long.py)."""

import math
from typing import Any

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, kernel
from gradhesion.core.contact.disc import is_one_disc, limits_from
from gradhesion.core.contact.waves import note_run
from gradhesion.core.curve.branches import GAP, NOWHERE, RUN, RUN_FIRST, RUN_LAST, RUN_LEAST
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.face import is_always_one_disc
from gradhesion.core.path.cosine import is_long, is_unresolved
from gradhesion.core.path.cosine_long import (
    DISC_INNER,
    DISC_OUTER,
    LAST_UP,
    NEAR,
    NEAR_RIM,
    RUN_SEEN,
    begin_long,
    ends_folds,
    is_told,
    stride,
)
from gradhesion.core.path.cosine_rims import FURTHEST, cycle_among, is_close_among, stand_at_once
from gradhesion.core.path.ties import first_close_pair
from gradhesion.core.problem.results import (
    CONTACT,
    DEEPEST,
    TURNED,
    put,
    wants_cycle,
    wants_losses,
)
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC
from gradhesion.core.scene.cosine_rim import limits_of, put_cycle, read_rim, slopes_of
from gradhesion.core.struve.lanes import LANES, Lanes, eight, lane_of, next_lane


@kernel()
def _limits_of_beginning(
    table: Any, curve: Cosine, first: float, last: float, trace: Any, long: Any, final: float
) -> tuple[float, float]:
    """Return the radii between which loading of the beginning ceases to keep the contact one disc, looked at once.

    The waves `first` to `last` of the gap, which loading leaves, are looked at too, where that serves all rims
    (RUN_LEAST of the trace).
    """
    shared, _, _ = long
    near = int(shared[NEAR])
    trace[RUN, GAP], trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST] = near, first, last
    if math.isnan(shared[DISC_INNER]):
        inner, outer = limits_from(table, curve, NONE, near - 1, NOWHERE, near, trace, math.inf)
        shared[DISC_INNER], shared[DISC_OUTER] = inner, outer
    if math.isnan(shared[RUN_SEEN]) and last >= first:
        note_run(table, curve, np.floor(0.5 * final - NEAR_RIM), trace)
        shared[RUN_SEEN] = 1.0
    return shared[DISC_INNER], shared[DISC_OUTER]


@kernel()
def _limits_beyond(
    table: Any, curve: Cosine, count: int, trace: Any, long: Any, rim: float, final: float, slots: Any
) -> tuple[float, float, float]:
    """Return what `limits_of` does for one rim; the beginning and the waves of the gap are looked at once."""
    tangency = first_close_pair(count, trace)
    if slots[CONTACT] < 0 or is_always_one_disc(table, curve):
        return math.inf, math.inf, tangency
    first, last = trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST]
    inner, outer = _limits_of_beginning(table, curve, first, last, trace, long, final)
    if inner == math.inf:
        shared, _, _ = long
        near, now = int(shared[NEAR]), int(shared[LAST_UP])
        inner, outer = limits_from(table, curve, near, count, now, count, trace, rim)
    return inner, outer, tangency


@kernel()
def _follow(
    table: Any,
    curve: Cosine,
    arches: tuple[float, float],
    scales: Any,
    x: float,
    slots: Any,
    out: Any,
    status: Any,
    i: int,
    trace: Any,
    long: Any,
    sense: Any,
    around: Any,
) -> None:
    """Follow the cycle of one rim, on branches of its own."""
    losses, final = wants_losses(slots), arches[1]
    count = stride(table, curve, arches, x, trace, long, losses, 1.0)
    limits = _limits_beyond(table, curve, count, trace, long, x, final, slots)
    slopes = slopes_of(table, curve, sense, around, count, trace, final) if len(sense) > 0 else ()
    read_rim(table, curve, scales, count, trace, limits, x, slots, out, status, i, sense, around, final, slopes)


@kernel()
def _is_one_disc_among(
    table: Any, curve: Cosine, arches: tuple[float, float], x: float, first: float, trace: Any, long: Any, slots: Any
) -> bool:
    """Return whether loading keeps the contact one disc up to a rim among the waves that it enters with `first`."""
    if slots[CONTACT] < 0 or is_always_one_disc(table, curve):
        return True
    limits = _limits_of_beginning(table, curve, first, first, trace, long, arches[1])
    if limits[0] < math.inf:
        return is_one_disc(table, curve, limits, x)
    if trace[RUN, RUN_LEAST] < 0.0:
        return False
    count = stride(table, curve, arches, x, trace, long, NO, 1.0)
    inner, outer, _ = _limits_beyond(table, curve, count, trace, long, x, arches[1], slots)
    return is_one_disc(table, curve, (inner, outer), x)


@kernel()
def _follow_eight(
    table: Any,
    curve: Cosine,
    arches: tuple[float, float],
    scales: Any,
    waiting: tuple[int, Lanes, Lanes],
    slots: Any,
    out: Any,
    status: Any,
    trace: Any,
    long: Any,
    sense: Any,
    around: Any,
) -> None:
    """Do the same for the rims that wait: at once for those that stand among regular waves, sensitivities apart."""
    count, indices, places = waiting
    _, depth_scale = scales
    losses = wants_losses(slots)
    stands = stand_at_once(table, curve, places, losses)
    for lane in range(count):
        i, x = int(lane_of(indices, lane)), lane_of(places, lane)
        among, loaded, loading_jumps, unloaded, unloading_jumps, last, deepest, first = cycle_among(
            table, curve, stands, lane, x, arches[1], long, trace, losses
        )
        if not among or len(sense) > 0:
            _follow(table, curve, arches, scales, x, slots, out, status, i, trace, long, sense, around)
        if not among:
            continue
        if wants_cycle(slots):
            loading, unloading = (loaded, loading_jumps), (unloaded, unloading_jumps)
            put_cycle(slots, scales, loading, unloading, last, out, status, i)
            if is_close_among(table, curve, stands, lane, x, long, trace, slots[TURNED] > 0):
                status[i] |= CLOSE_TO_A_JUMP
        put(out, slots, DEEPEST, i, depth_scale * deepest)
        if not _is_one_disc_among(table, curve, arches, x, first, trace, long, slots):
            status[i] |= LOADING_NOT_ONE_DISC


@kernel()
def solve_long(
    table: Any,
    curve: Cosine,
    arches: tuple[float, float],
    scales: Any,
    wavelength: float,
    rims: Any,
    slots: Any,
    out: Any,
    status: Any,
    scratch: Any,
    sense: Any,
    around: Any,
) -> None:
    """Follow the cycle of a wavy punch for its rims that no walk reaches: they share its beginning and its sums.

    Those among regular waves are taken eight at a time. Those beyond the folds, or among the last of them, share all of
    the trace.
    """
    losses, final = wants_losses(slots), arches[1]
    trace, long = begin_long(table, curve, arches, scratch, losses, 1.0)
    furthest, told = 0.0, is_told(table, curve, final)
    number, indices, places = NONE, eight(0.0), eight(math.nan)
    for i in range(rims.size):
        x = rims[i] / wavelength
        if is_unresolved(arches, x) or not is_long(table, arches, x):
            continue
        if told and ends_folds(table, arches, x):
            furthest = max(furthest, x)
        elif ends_folds(table, arches, x) or 2.0 * x > FURTHEST:
            _follow(table, curve, arches, scales, x, slots, out, status, i, trace, long, sense, around)
        else:
            indices, places = next_lane(indices, number, float(i)), next_lane(places, number, x)
            number += 1
            if number == LANES:
                waiting = (number, indices, places)
                _follow_eight(table, curve, arches, scales, waiting, slots, out, status, trace, long, sense, around)
                number = NONE
    if number > 0:
        waiting = (number, indices, places)
        _follow_eight(table, curve, arches, scales, waiting, slots, out, status, trace, long, sense, around)
    if furthest == 0.0:
        return
    trace[RUN, RUN_LEAST] = math.nan  # these look at the waves of their own gap
    count = stride(table, curve, arches, furthest, trace, long, losses, 1.0)
    limits = limits_of(table, curve, count, trace, furthest, slots)
    slopes = slopes_of(table, curve, sense, around, count, trace, final) if len(sense) > 0 else ()
    for i in range(rims.size):
        x = rims[i] / wavelength
        if not is_unresolved(arches, x) and is_long(table, arches, x) and ends_folds(table, arches, x):
            read_rim(table, curve, scales, count, trace, limits, x, slots, out, status, i, sense, around, final, slopes)
