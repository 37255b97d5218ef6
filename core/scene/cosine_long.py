"""The rims of a punch with one cosine wave beyond the traced waves (path/cosine_long.py), which scene/cosine.py leaves.

They have a loop over curves of their own: a map without such rims compiles none of it.
"""

import math

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, ONE, kernel
from gradhesion.core.contact.disc import is_one_disc, limits_from
from gradhesion.core.contact.waves import note_run
from gradhesion.core.curve.branches import GAP, NOWHERE, RUN, RUN_FIRST, RUN_LAST, RUN_LEAST, Trace
from gradhesion.core.curve.cosine import Cosine, curve_of
from gradhesion.core.face import is_always_one_disc
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import LANES, Lanes, eight, lane_of, next_lane
from gradhesion.core.path.cosine import extent
from gradhesion.core.path.cosine_long import NEAR_RIM, Long, begin_long, ends_folds, stride
from gradhesion.core.path.cosine_rims import FURTHEST, cycle_among, is_close_among, stand_at_once
from gradhesion.core.path.cosine_waves import is_reported
from gradhesion.core.path.ties import first_close_pair
from gradhesion.core.problem.results import (
    CONTACT,
    DEEPEST,
    TURNED,
    Results,
    put,
    wants_cycle,
    wants_losses,
)
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LEFT, LOADING_NOT_ONE_DISC
from gradhesion.core.scene.cosine import mark_unresolved
from gradhesion.core.scene.cosine_rim import Walked, read_rim, slopes_of, walked_to
from gradhesion.core.scene.scene import Scene, put_cycle
from gradhesion.core.sensitivities.cosine_slopes import sensed_by
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.types import Floats, Table


@kernel()
def _limits_of_beginning(table: Table, curve: Cosine, first: float, last: float, long: Long) -> tuple[float, float]:
    """Return the x between which loading of the beginning ceases to keep the contact one disc, examined once.

    The waves `first` to `last` of the gap, which loading leaves, are examined too, where that serves all rims
    (RUN_LEAST of the trace).
    """
    shared, trace = long.shared[0], long.trace
    near = shared.near
    trace[RUN, GAP], trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST] = near, first, last
    if math.isnan(shared.disc_inner):
        inner, outer = limits_from(table, curve, NONE, near - 1, NOWHERE, near, trace, math.inf)
        shared.disc_inner, shared.disc_outer = inner, outer
    if shared.run_seen == 0 and last >= first:
        note_run(table, curve, np.floor(0.5 * long.arches[1] - NEAR_RIM), trace)
        shared.run_seen = ONE
    return shared.disc_inner, shared.disc_outer


@kernel()
def _walked_beyond(table: Table, curve: Cosine, count: int, long: Long, rim: float, scene: Scene) -> Walked:
    """Return what `walked_to` does for one rim, x = a/lambda; the beginning and the gap are examined once."""
    trace = long.trace
    tangency = first_close_pair(count, trace)
    if scene.results.slots[CONTACT] < 0 or is_always_one_disc(table, curve):
        return Walked(count, trace, math.inf, math.inf, tangency)
    first, last = trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST]
    inner, outer = _limits_of_beginning(table, curve, first, last, long)
    if inner == math.inf:
        shared = long.shared[0]
        near, now = shared.near, shared.last_up
        inner, outer = limits_from(table, curve, near, count, now, count, trace, rim)
    return Walked(count, trace, inner, outer, tangency)


@kernel()
def _follow(table: Table, curve: Cosine, scene: Scene, x: float, i: int, long: Long, sensed: AnySense) -> None:
    """Follow the cycle of rim number i, at x wavelengths, on branches of its own, and store what it reads there."""
    count = stride(table, curve, x, long, wants_losses(scene.results.slots), 1.0)
    walked = _walked_beyond(table, curve, count, long, x, scene)
    slopes = slopes_of(table, curve, sensed, walked, long.arches[1])
    read_rim(table, curve, walked, scene, x, i, sensed, slopes)


@kernel()
def _is_one_disc_among(table: Table, curve: Cosine, x: float, first: float, long: Long, scene: Scene) -> bool:
    """Return whether loading keeps the contact one disc up to a rim among the waves that it enters with `first`."""
    if scene.results.slots[CONTACT] < 0 or is_always_one_disc(table, curve):
        return True
    limits = _limits_of_beginning(table, curve, first, first, long)
    if limits[0] < math.inf:
        return is_one_disc(table, curve, limits, x)
    if long.trace[RUN, RUN_LEAST] < 0.0:
        return False
    count = stride(table, curve, x, long, NO, 1.0)
    walked = _walked_beyond(table, curve, count, long, x, scene)
    return is_one_disc(table, curve, (walked.inner, walked.outer), x)


@kernel()
def _follow_eight(
    table: Table, curve: Cosine, scene: Scene, waiting: tuple[int, Lanes, Lanes], long: Long, sensed: AnySense
) -> None:
    """Do the same for the rims that wait: at once for those that stand among regular waves, sensitivities apart.

    `waiting` is how many they are, their numbers, and their places x.
    """
    count, indices, places = waiting
    results = scene.results
    losses = wants_losses(results.slots)
    stands = stand_at_once(table, curve, places, losses)
    for lane in range(count):
        i, x = int(lane_of(indices, lane)), lane_of(places, lane)
        among, cycle, first = cycle_among(table, curve, stands, lane, x, long, losses)
        if not among or sensed.energy:
            _follow(table, curve, scene, x, i, long, sensed)
        if not among:
            continue
        if wants_cycle(results.slots):
            put_cycle(scene, cycle, i)
            if is_close_among(table, curve, stands, lane, x, long, results.slots[TURNED] > 0):
                results.status[i] |= CLOSE_TO_A_JUMP
        put(results, DEEPEST, i, scene.depth * cycle.highest)
        if not _is_one_disc_among(table, curve, x, first, long, scene):
            results.status[i] |= LOADING_NOT_ONE_DISC


@kernel()
def _solve_long(
    table: Table,
    curve: Cosine,
    arches: tuple[float, float],
    scene: Scene,
    rims: Floats,
    scratch: Trace,
    sensed: AnySense,
) -> None:
    """Follow the cycle of a wavy punch for its rims that no walk reaches: they share its beginning and its sums.

    Those among regular waves are solved eight at a time. Those beyond the folds, or among the last of them, share all
    of the trace. The arguments, and their shapes, are those of `_solve_cycle` in scene/cosine.py.
    """
    losses, final = wants_losses(scene.results.slots), arches[1]
    long = begin_long(table, curve, arches, scratch, losses, 1.0)
    furthest, told = 0.0, is_reported(table, curve, final)
    number, indices, places = NONE, eight(0.0), eight(math.nan)
    for i in range(rims.size):
        if not scene.results.status[i] & LEFT:
            continue
        x = rims[i] / scene.wavelength
        if told and ends_folds(table, arches, x):
            furthest = max(furthest, x)
        elif ends_folds(table, arches, x) or 2.0 * x > FURTHEST:
            _follow(table, curve, scene, x, i, long, sensed)
        else:
            indices, places = next_lane(indices, number, float(i)), next_lane(places, number, x)
            number += 1
            if number == LANES:
                _follow_eight(table, curve, scene, (number, indices, places), long, sensed)
                number = NONE
    if number > 0:
        _follow_eight(table, curve, scene, (number, indices, places), long, sensed)
    if furthest == 0.0:
        return
    long.trace[RUN, RUN_LEAST] = math.nan  # these examine the waves of their own gap
    count = stride(table, curve, furthest, long, losses, 1.0)
    walked = walked_to(table, curve, count, long.trace, furthest, scene)
    slopes = slopes_of(table, curve, sensed, walked, final)
    for i in range(rims.size):
        x = rims[i] / scene.wavelength
        if scene.results.status[i] & LEFT and ends_folds(table, arches, x):
            read_rim(table, curve, walked, scene, x, i, sensed, slopes)


@kernel()
def solve_left(
    table: Table,
    stretch: float,
    wavelength: float,
    amplitude: float,
    rims: Floats,
    results: Results,
    scratch: Trace,
    sense: AnySense,
) -> None:
    """Follow the cycles of one curve for the rims that `solve_curve` (scene/cosine.py) leaves, with its arguments."""
    curve, length, depth_scale = curve_of(table.k, stretch, wavelength, amplitude * wavelength)
    arches = extent(table, curve)
    scene = Scene(wavelength, length, TWO_PI * length * length, depth_scale, results)
    sensed = sensed_by(table, sense, stretch, wavelength, amplitude)
    _solve_long(table, curve, arches, scene, rims, scratch, sensed)
    for i in range(rims.size):
        results.status[i] &= ~LEFT
    mark_unresolved(wavelength, rims, results)
