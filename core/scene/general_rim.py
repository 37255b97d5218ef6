"""The cycles of the rims of one curve of any profile, walked together on one trace.

Sensitivities are read off the trace that the energy comes from. Rims too far out are for scene/general_long.py.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.dispatch import face_of
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.disc import disc_limits, is_one_disc
from gradhesion.core.curve.arches import is_one_cosine
from gradhesion.core.curve.branches import ARRIVAL, Trace
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_energy import energies_in
from gradhesion.core.curve.general_folds import MOST_CELLS
from gradhesion.core.face import depth_at
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.general import depth_at_full_contact, walk
from gradhesion.core.path.general_middle import LONGEST_WALK
from gradhesion.core.path.loading import highest_depth, jumps_in_to, loading_to
from gradhesion.core.path.ties import is_close_to_a_jump
from gradhesion.core.path.unloading import jumps_out_from, unloading_from
from gradhesion.core.problem.results import (
    CONTACT,
    DEEPEST,
    OUTERMOST,
    TURNED,
    Cycle,
    Results,
    part_of,
    put,
    wants_losses,
)
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, LEFT, LOADING_NOT_ONE_DISC
from gradhesion.core.scene.scene import Scene, put_cycle, refuse
from gradhesion.core.sensitivities.general_slopes import put_energy, slopes_of
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.types import Floats, Truths
from gradhesion.core.waves.general_jump import LONG

_OF_PATTERNS: Final = "gradhesion.core.scene.patterned"
_STATIONS: Final = 64
"""Places within the jump-in that a curve has room for."""


@face_of(Series, _OF_PATTERNS)
@kernel()
def refuse_waves(curve: Series, results: Results, i: int) -> None:  # noqa: ARG001
    """Give rim number i no value, since its waves are too many to be followed."""
    refuse(results, i)


@kernel()
def put_rim(
    basis: Basis,
    curve: Series,
    scene: Scene,
    place: tuple[float, float],
    cycle: Cycle,
    flags: tuple[bool, bool],
    i: int,
) -> None:
    """Store the cycle of rim number i, at x beyond some whole waves (`place`), and what there is to report.

    The flags are whether a decision was close, and whether the contact stays one disc as far as was tested.
    """
    close, one_disc = flags
    x, whole = place
    results = scene.results
    if close:
        results.status[i] |= CLOSE_TO_A_JUMP
    if cycle.highest == 0.0:
        results.status[i] |= JUMP_IN_TO_RIM
    if not one_disc:
        results.status[i] |= LOADING_NOT_ONE_DISC
    if put_cycle(scene, cycle, i) and results.slots[DEEPEST] >= 0:
        deepest = depth_at_full_contact(basis, curve, x, cycle.highest, whole) if x < math.inf else x
        put(results, DEEPEST, i, scene.depth * deepest)


@face_of(Series, _OF_PATTERNS)
@kernel()
def cycle_to(
    basis: Basis, curve: Series, count: int, trace: Trace, x: float, level: float, losses: bool, stations: Floats
) -> Cycle:
    """Return the cycle up to a rim at x, read off a trace of `count` branches; `level` is the coordinate there.

    Energies are found where there are to be `losses`. `stations`, of shape (4, any), first all inf, are room for what
    the jump-ins and the jump-outs of all rims share.
    """
    shared = losses and x <= LONG and not is_one_cosine(basis.series, curve.exponent)
    jumps_in = shared and jumps_in_to(count, trace, x)
    jumps_out = shared and curve.alpha > 0.0 and jumps_out_from(count, trace, x, level)
    inwards, outwards = 0.0, 0.0
    if jumps_in or jumps_out:
        levels = (0.0 if jumps_in else level, level if jumps_out else 0.0)
        inwards, outwards = energies_in(basis, curve, x, levels[0], levels[1], stations)
    if jumps_in:
        loaded, jumps = inwards, 1.0
    else:
        loaded, jumps = loading_to(basis, curve, count, trace, x, losses)
    highest = highest_depth(count, trace, x, level)
    if jumps_out:
        unloaded, jumps_back, last = -outwards, 1.0, depth_at(basis, curve, x, level)
    else:
        unloaded, jumps_back, last = unloading_from(basis, curve, count, trace, x, level, losses)
    return Cycle(loaded, jumps, unloaded, jumps_back, last, highest)


@kernel()
def walked(
    basis: Basis, curve: Series, scene: Scene, bounds: tuple[float, float], rims: Floats, chosen: Truths, own: AnySense
) -> bool:
    """Solve the chosen rims of a curve, shape (rims,), in wavelengths, on one trace; return whether it could be walked.

    All folds stand between the two x of `bounds`.
    """
    results = scene.results
    slots = results.slots
    losses, furthest = wants_losses(slots), 0.0
    for i in range(rims.size):
        if chosen[i]:
            furthest = max(furthest, rims[i])
    count, trace, tangency = walk(basis, curve, bounds, furthest, losses)
    if count < 0:
        return False
    stations = np.full((4, _STATIONS), math.inf)
    limits = disc_limits(basis, curve, count, trace, furthest) if slots[CONTACT] >= 0 else (math.inf, math.inf)
    slopes = slopes_of(basis, curve, own, count, trace)
    for i in range(rims.size):
        if not chosen[i]:
            continue
        x = rims[i]
        level = coordinate(basis, curve, x) if x < math.inf else math.inf
        cycle = cycle_to(basis, curve, count, trace, x, level, losses, stations)
        close = is_close_to_a_jump(basis, curve, count, trace, tangency, x, level, slots[TURNED] > 0)
        put_rim(basis, curve, scene, (x, 0.0), cycle, (close, is_one_disc(basis, curve, limits, x)), i)
        if x == math.inf:  # the last branch has no end, and loading arrives on it
            put(results, OUTERMOST, i, TWO_PI * scene.length * trace[ARRIVAL, count - 1])
        put_energy(basis, curve, own, slopes, x, part_of(own.energy, cycle.loaded, cycle.unloaded), i)
    return True


@kernel()
def only(i: int, count: int) -> Truths:
    """Return which of some rims is number i."""
    chosen = np.zeros(count, np.bool_)
    chosen[i] = True
    return chosen


@face_of(Series, _OF_PATTERNS)
@kernel()
def shares_trace(basis: Basis, curve: Series, bounds: tuple[float, float], x: float) -> bool:  # noqa: ARG001
    """Return whether a rim at x is so near that it is to share a trace with others.

    All folds stand between the two x of `bounds`.
    """
    waves = min(x, bounds[1]) - bounds[0]
    return waves <= LONGEST_WALK and waves * highest_harmonic(basis.series) < MOST_CELLS


@face_of(Series, _OF_PATTERNS)
@kernel()
def is_left(curve: Series, results: Results, i: int) -> bool:  # noqa: ARG001
    """Return whether rim number i, which shares no trace, is left for scene/general_long.py; refuse it if it is not."""
    results.status[i] |= LEFT
    return True
