"""From the numbers of general scenes to their results: one curve at a time, with all its rims.

Sensitivities are read off the trace, or the notes of a long cycle, that the energy comes from; without them `sense` is
`NoSense`, for which nothing of them is compiled.
"""

import math
from collections.abc import Callable
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.contact.disc import disc_limits, is_one_disc
from gradhesion.core.curve.arches import is_one_cosine
from gradhesion.core.curve.branches import ARRIVAL
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Series, coordinate, curve_at, state
from gradhesion.core.curve.general_energy import energies_in
from gradhesion.core.curve.general_folds import MOST_CELLS, Search, room
from gradhesion.core.face import depth_at, window
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.path.general import depth_at_full_contact, walk
from gradhesion.core.path.general_long import FEW, LONGEST_WALK, REGULAR, Middle, Tasks, middle_of, stride
from gradhesion.core.path.loading import highest_depth, jumps_in_to, loading_to
from gradhesion.core.path.pieces import notes_for
from gradhesion.core.path.ties import is_close_to_a_jump
from gradhesion.core.path.unloading import jumps_out_from, unloading_from
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.results import (
    CONTACT,
    DEEPEST,
    OUTERMOST,
    TURNED,
    Cycle,
    Results,
    part_of,
    put,
    wants_folds,
    wants_force,
    wants_losses,
)
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, LOADING_NOT_ONE_DISC, NO_VALUE
from gradhesion.core.pull_off.general import deepest_wave
from gradhesion.core.pull_off.rims import lowest_loads
from gradhesion.core.scene.scene import Scene, put_cycle, put_pull_off, refuse
from gradhesion.core.sensitivities.general_slopes import NOTES, put_energy, put_noted, put_rest, sensed_by, slopes_of
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.types import Floats, Truths
from gradhesion.core.waves.general_jump import LONG

_STATIONS: Final = 64
"""Places within the jump-in that a curve has room for."""


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


@kernel()
def _walked(
    basis: Basis, curve: Series, scene: Scene, bounds: tuple[float, float], rims: Floats, chosen: Truths, own: AnySense
) -> bool:
    """Solve the chosen rims of a curve, shape (rims,), in wavelengths, on one trace; return whether it could be walked.

    All folds stand between the two x of `bounds`.
    """
    results = scene.results
    slots = results.slots
    losses, turned = wants_losses(slots), slots[TURNED] > 0
    furthest = 0.0
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
        close = is_close_to_a_jump(basis, curve, count, trace, tangency, x, level, turned)
        flags = (close, is_one_disc(basis, curve, limits, x))
        cycle = Cycle(loaded, jumps, unloaded, jumps_back, last, highest)
        put_rim(basis, curve, scene, (x, 0.0), cycle, flags, i)
        if x == math.inf:  # the last branch has no end, and loading arrives on it
            put(results, OUTERMOST, i, TWO_PI * scene.length * trace[ARRIVAL, count - 1])
        put_energy(basis, curve, own, slopes, x, part_of(own.energy, loaded, unloaded), i)
    return True


@kernel()
def _strode(
    basis: Basis,
    curve: Series,
    scene: Scene,
    first: float,
    middle: Middle,
    rim: tuple[float, float],
    i: int,
    own: AnySense,
) -> bool:
    """Solve rim number i of a long curve, x and its rounding error; return whether its waves could be summed.

    No fold stands before x = `first`.
    """
    slots = scene.results.slots
    tasks = Tasks(wants_losses(slots), curve.alpha > 0.0, slots[CONTACT] >= 0, slots[TURNED] > 0)
    notes = notes_for(NOTES if own.energy > 0 else NONE)
    done, up, down, close, one_disc, waves, x = stride(basis, curve, first, middle, rim, tasks, notes)
    if not done:
        return False
    depth = -1.0
    if down.waves + down.left > 0.0:
        _, _, _, depth, _ = state(basis, curve, down.left, down.waves)
    cycle = Cycle(up.loss, up.jumps, down.loss, down.jumps, depth, up.level)
    put_rim(basis, curve, scene, (x, waves), cycle, (close, one_disc), i)
    if x == math.inf:
        put(scene.results, OUTERMOST, i, TWO_PI * scene.length * (up.waves + up.left))
    put_noted(basis, curve, own, middle.cut, notes, (x, waves), part_of(own.energy, up.loss, down.loss), i)
    return True


@kernel()
def _cycles(basis: Basis, curve: Series, scene: Scene, rims: Floats, own: AnySense) -> None:
    """Follow the cycles of a curve up to all its rims that are not refused: those within a walk share one trace.

    `rims` are a_max/R, of shape (rims,).
    """
    series = basis.series
    count = rims.size
    highest = highest_harmonic(series)
    first, last = window(basis, curve)
    places, together, alone = np.empty(count), np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    shared = False
    for i in range(count):
        if not rims[i] > 0.0:
            continue
        x = rims[i] / scene.wavelength
        places[i] = x
        waves = min(x, last) - first
        if series.shape[0] > 0 and LONGEST_WALK < waves < math.inf:
            middle = middle_of(basis, curve, first, min(x, last), 0.0)
            x_low = fma(-x, scene.wavelength, rims[i]) / scene.wavelength if x < math.inf else 0.0
            if middle.kind == REGULAR and _strode(basis, curve, scene, first, middle, (x, x_low), i, own):
                continue
            alone[i] = True
            if middle.kind == FEW and _walked(basis, curve, scene, (first, middle.until), places, alone, own):
                alone[i] = False
                continue
            alone[i] = False
        if not waves * highest < MOST_CELLS:
            refuse(scene.results, i)
        elif waves > LONGEST_WALK:
            alone[i] = True
            if not _walked(basis, curve, scene, (first, last), places, alone, own):
                refuse(scene.results, i)
            alone[i] = False
        else:
            together[i] = shared = True
    if not shared or _walked(basis, curve, scene, (first, last), places, together, own):
        return
    for i in range(count):  # too many folds up to the largest of them
        if together[i]:
            alone[i] = True
            if not _walked(basis, curve, scene, (first, last), places, alone, own):
                refuse(scene.results, i)
            alone[i] = False


@kernel()
def _pull_offs(
    basis: Basis,
    curve: Series,
    force: float,
    wavelength: float,
    rims: Floats,
    results: Results,
    work: Search,
    deepest: float,
) -> None:
    """Find the pull-off of a curve for all its rims a_max/R, of shape (rims,), that are positive.

    `force` is the unit of its load in 1.5 pi R dgamma, `deepest` that of pull_off/general.py, 0 for a smooth punch.
    """
    places, lows, found = np.empty(rims.size), np.empty(rims.size), np.empty((rims.size, 3))
    for i in range(rims.size):
        places[i] = rims[i] / wavelength
        lows[i] = fma(-places[i], wavelength, rims[i]) / wavelength if places[i] < math.inf else 0.0
    lowest_loads(basis, curve, places, lows, work, deepest, found)
    for i in range(rims.size):
        if not rims[i] > 0.0:
            continue
        lowest, place, second = found[i, 0], found[i, 1], found[i, 2]
        if not lowest < 0.0:
            results.status[i] |= NO_VALUE
            lowest = place = math.nan
        put_pull_off(results, force, wavelength, rims[i], (lowest, place, second), i)


def loop_of(*, cycles: bool) -> Callable[..., None]:
    """Return the kernel that solves many scenes; without `cycles` it knows the pull-off alone."""

    @kernel()
    def solve_scenes(basis: Basis, curves: GeneralCurves, results: Results, sense: AnySense) -> None:
        """Solve the curves of one gradient exponent, each for all its rims.

        Values go to `results` in the shape (results, curves, rims), flags in (curves, rims).
        """
        numbers, _, _, stretch, wavelength, amplitude, compliance, rims = curves
        table, _, series = basis
        work, deepest = room(), deepest_wave(table, series) if wants_force(results.slots) else 0.0
        for i in numbers:
            row = rims[i if rims.shape[0] > 1 else 0]
            own = Results(results.slots, results.out[:, i], results.status[i])
            valid, rows, curve, length, unit = curve_at(basis, curves, i)
            waves = Basis(basis.table, basis.cosine_bins, rows)
            for rim in range(row.size):
                if not (valid and row[rim] > 0.0):
                    refuse(own, rim)
            if not valid:
                continue
            sensed = sensed_by(sense, i, stretch[i], wavelength[i], amplitude[i], compliance[i])
            if wants_force(own.slots):
                force, trough = force_unit(table.k, length, unit), deepest if amplitude[i] > 0.0 else 0.0
                _pull_offs(waves, curve, force, wavelength[i], row, own, work, trough)
            if cycles and wants_folds(own.slots):
                scene = Scene(wavelength[i], length, TWO_PI * length * length, unit, own)
                _cycles(waves, curve, scene, row, sensed)
            put_rest(waves, curve, sensed, unit, wavelength[i], row, own)

    return solve_scenes


solve_scenes: Final = loop_of(cycles=True)
solve_pull_offs: Final = loop_of(cycles=False)
"""The same where nothing but the pull-off is wanted."""
