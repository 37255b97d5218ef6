"""One rim of a punch with one cosine wave, read off the trace of its curve: its cycle, and what there is to report."""

import math
from typing import Any

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.disc import disc_limits, is_one_disc
from gradhesion.core.curve.branches import ARRIVAL
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.path.loading import highest_depth, jumps_in_to, loading_to
from gradhesion.core.path.ties import first_close_pair, is_close_to_a_jump
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.results import (
    CONTACT,
    DEEPEST,
    ENERGY,
    LAST,
    LOADED,
    LOADING,
    OUTERMOST,
    TURNED,
    UNLOADED,
    UNLOADING,
    put,
    wants_cycle,
    wants_losses,
)
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, LOADING_NOT_ONE_DISC, NO_VALUE
from gradhesion.core.sensitivities.cosine_slopes import put_energy
from gradhesion.core.sensitivities.path_slopes import fill_loading, slopes_for
from gradhesion.core.struve.circle import TWO_PI


@kernel()
def put_cycle(
    slots: Any,
    scales: Any,
    loading: tuple[float, float],
    unloading: tuple[float, float],
    last: float,
    out: Any,
    status: Any,
    i: int,
) -> None:
    """Put down the cycle of one rim: loss and jumps of loading, and of unloading, and the depth of the last contact."""
    energy_scale, depth_scale = scales
    loaded, loading_jumps = loading
    unloaded, unloading_jumps = unloading
    energy = energy_scale * (loaded + unloaded)
    if not abs(energy) < math.inf:  # an overflow
        energy = math.nan
        status[i] |= NO_VALUE
    put(out, slots, ENERGY, i, energy)
    put(out, slots, LOADED, i, energy_scale * loaded)
    put(out, slots, UNLOADED, i, energy_scale * unloaded)
    put(out, slots, LOADING, i, loading_jumps)
    put(out, slots, UNLOADING, i, unloading_jumps)
    put(out, slots, LAST, i, depth_scale * last)


@kernel()
def _cycle_at_rim(
    table: Any,
    curve: Cosine,
    scales: Any,
    count: int,
    trace: Any,
    limits: tuple[float, float, float],
    x: float,
    slots: Any,
    out: Any,
    status: Any,
    i: int,
) -> None:
    """Read the cycle of one rim off a trace, and what there is to report."""
    energy_scale, depth_scale = scales
    losses = wants_losses(slots)
    inner, outer, tangency = limits
    rim_depth = depth(table, curve, x) if x < math.inf else math.inf
    if wants_cycle(slots):
        loading = loading_to(table, curve, count, trace, x, losses)
        unloaded, unloading_jumps, last = unloading_from(table, curve, count, trace, x, rim_depth, losses)
        put_cycle(slots, scales, loading, (unloaded, unloading_jumps), last, out, status, i)
        if is_close_to_a_jump(table, curve, count, trace, tangency, x, rim_depth, slots[TURNED] > 0):
            status[i] |= CLOSE_TO_A_JUMP
        if x == math.inf:  # the last branch has no end, and loading arrives on it
            put(out, slots, OUTERMOST, i, math.sqrt(TWO_PI * energy_scale) * trace[ARRIVAL, count - 1])
    put(out, slots, DEEPEST, i, depth_scale * highest_depth(count, trace, x, rim_depth))
    if jumps_in_to(count, trace, x):
        status[i] |= JUMP_IN_TO_RIM
    if not is_one_disc(table, curve, (inner, outer), x):
        status[i] |= LOADING_NOT_ONE_DISC


@kernel()
def limits_of(
    table: Any, curve: Cosine, count: int, trace: Any, furthest: float, slots: Any
) -> tuple[float, float, float]:
    """Return the radii between which loading ceases to keep the contact one disc, if that is asked for.

    And the first place at which a pair of folds is about to be born or to vanish; all of it serves all rims.
    """
    tangency = first_close_pair(count, trace)
    if slots[CONTACT] < 0:
        return math.inf, math.inf, tangency
    inner, outer = disc_limits(table, curve, count, trace, furthest)
    return inner, outer, tangency


@kernel()
def slopes_of(table: Any, curve: Cosine, sense: Any, around: Any, count: int, trace: Any, final: float) -> Any:
    """Return the slopes that go with a trace, those of loading filled in, if they are asked for."""
    slopes = slopes_for(trace)
    if sense[4]:
        fill_loading(table, curve, around[0], count, trace, final, slopes)
    return slopes


@kernel()
def read_rim(
    table: Any,
    curve: Cosine,
    scales: Any,
    count: int,
    trace: Any,
    limits: tuple[float, float, float],
    x: float,
    slots: Any,
    out: Any,
    status: Any,
    i: int,
    sense: Any,
    around: Any,
    final: float,
    slopes: Any,
) -> None:
    """Read a rim off a trace: its cycle, and its sensitivities if they are asked for."""
    _cycle_at_rim(table, curve, scales, count, trace, limits, x, slots, out, status, i)
    if len(sense) > 0:  # noqa: SIM102 (numba drops the branch by the length alone)
        if sense[4]:
            energy = out[slots[ENERGY], i]
            put_energy(table, curve, around, scales[0], count, trace, final, slopes, x, energy, sense[2], i)
