"""One rim of a punch with one cosine wave, read off the trace of its curve: its cycle, and its status."""

import math
from typing import NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.disc import disc_limits, is_one_disc
from gradhesion.core.curve.branches import ARRIVAL, Trace
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.loading import highest_depth, jumps_in_to, loading_to
from gradhesion.core.path.ties import first_close_pair, is_close_to_a_jump
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.results import (
    CONTACT,
    DEEPEST,
    OUTERMOST,
    TURNED,
    Cycle,
    energy_of,
    put,
    wants_cycle,
    wants_losses,
)
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, LOADING_NOT_ONE_DISC
from gradhesion.core.scene.scene import Scene, put_cycle
from gradhesion.core.sensitivities.cosine_slopes import Sensed, put_energy
from gradhesion.core.sensitivities.path_slopes import Traced, fill_loading, with_slopes
from gradhesion.core.sensitivities.wanted import AnySense, if_wanted
from gradhesion.core.types import Floats, Table


class Walked(NamedTuple):
    """A trace with what all rims that are read off it share."""

    branches: int  # how many the trace has
    trace: Trace  # the branches, of shape (ROWS, branches or more): curve/branches.py
    inner: float  # x up to which loading keeps the contact one disc (contact/disc.py), inf for everywhere
    outer: float  # x from which on it does not, inf for nowhere
    tangency: float  # the first x at which a pair of folds is about to be born or to vanish, inf for none


@kernel()
def _cycle_at_rim(table: Table, curve: Cosine, walked: Walked, scene: Scene, x: float, i: int) -> None:
    """Read the cycle of rim number i, at x wavelengths, off a trace, and store it and its flags."""
    count, trace, inner, outer, tangency = walked
    results = scene.results
    losses = wants_losses(results.slots)
    rim_depth = depth(table, curve, x) if x < math.inf else math.inf
    highest = highest_depth(count, trace, x, rim_depth)
    if wants_cycle(results.slots):
        loaded, loading_jumps = loading_to(table, curve, count, trace, x, losses)
        unloaded, unloading_jumps, last = unloading_from(table, curve, count, trace, x, rim_depth, losses)
        put_cycle(scene, Cycle(loaded, loading_jumps, unloaded, unloading_jumps, last, highest), i)
        if is_close_to_a_jump(table, curve, count, trace, tangency, x, rim_depth, results.slots[TURNED] > 0):
            results.status[i] |= CLOSE_TO_A_JUMP
        if x == math.inf:  # the last branch has no end, and loading arrives on it
            put(results, OUTERMOST, i, math.sqrt(TWO_PI * scene.energy) * trace[ARRIVAL, count - 1])
    put(results, DEEPEST, i, scene.depth * highest)
    if jumps_in_to(count, trace, x):
        results.status[i] |= JUMP_IN_TO_RIM
    if not is_one_disc(table, curve, (inner, outer), x):
        results.status[i] |= LOADING_NOT_ONE_DISC


@kernel()
def walked_to(table: Table, curve: Cosine, count: int, trace: Floats, furthest: float, scene: Scene) -> Walked:
    """Return a trace of `count` branches with what its rims up to x = `furthest` share."""
    tangency = first_close_pair(count, trace)
    if scene.results.slots[CONTACT] < 0:
        return Walked(count, trace, math.inf, math.inf, tangency)
    inner, outer = disc_limits(table, curve, count, trace, furthest)
    return Walked(count, trace, inner, outer, tangency)


@if_wanted("sensed")
@kernel()
def slopes_of(table: Table, curve: Cosine, sensed: Sensed, walked: Walked, final: float) -> Traced:
    """Return the slopes that go with a trace, those of loading filled in where those of the energy are wanted.

    `final` is the last arch on which the curve folds.
    """
    slopes = with_slopes(walked.branches, walked.trace, final)
    if sensed.energy:
        fill_loading(table, curve, sensed.near, slopes)
    return slopes


@kernel()
def read_rim(
    table: Table, curve: Cosine, walked: Walked, scene: Scene, x: float, i: int, sensed: AnySense, slopes: AnySense
) -> None:
    """Store what rim number i, at x wavelengths, reads off a trace: its cycle, and its sensitivities if wanted."""
    _cycle_at_rim(table, curve, walked, scene, x, i)
    if sensed.energy:
        energy = energy_of(scene.results, sensed.energy, i) / scene.energy
        put_energy(table, curve, sensed, slopes, x, energy, i)
