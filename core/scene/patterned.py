"""Punches on an interface whose toughness varies with the radius: one curve at a time, with all its rims.

The loops of scene/general.py; each wave is walked, to the last fold.
"""

import math
from typing import Any

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.disc import disc_limits, is_one_disc
from gradhesion.core.curve.branches import ARRIVAL
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Patterned, coordinate
from gradhesion.core.curve.general_folds import Search, room
from gradhesion.core.curve.patterned import are_too_many, patterned_curve, window
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.path.general import walk
from gradhesion.core.path.loading import highest_depth, loading_to
from gradhesion.core.path.ties import is_close_to_a_jump
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.curves import GeneralCurves, Patterns
from gradhesion.core.problem.results import (
    CONTACT,
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
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.pull_off.general import deepest_wave
from gradhesion.core.pull_off.patterned import lowest_loads
from gradhesion.core.scene.general import put_rim
from gradhesion.core.scene.scene import Scene, put_pull_off, refuse
from gradhesion.core.sensitivities.patterned_slopes import put_energy, put_forces
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.types import Floats, Harmonics, Table, Truths


@kernel()
def _walked(
    basis: Basis,
    curve: Patterned,
    scene: Scene,
    bounds: tuple[float, float],
    rims: Floats,
    chosen: Truths,
    sense: AnySense,
    number: int,
) -> bool:
    """Solve the chosen rims of a curve, shape (rims,), in its wavelengths, on one trace; return whether that was done.

    The curve is number `number` of those whose sensitivities are found.
    """
    slots = scene.results.slots
    losses, furthest = wants_losses(slots), 0.0
    for i in range(rims.size):
        if chosen[i]:
            furthest = max(furthest, rims[i])
    count, trace, tangency = walk(basis, curve, bounds, furthest, losses)
    if count < 0:
        return False
    limits = disc_limits(basis, curve, count, trace, furthest) if slots[CONTACT] >= 0 else (math.inf, math.inf)
    for i in range(rims.size):
        if not chosen[i]:
            continue
        x = rims[i]
        level = coordinate(basis, curve, x) if x < math.inf else math.inf
        loaded, jumps = loading_to(basis, curve, count, trace, x, losses)
        if count > 0 and trace[ARRIVAL, 0] == 0.0:  # without adhesion at the centre contact grows from a point
            jumps -= 1.0
        unloaded, jumps_back, last = unloading_from(basis, curve, count, trace, x, level, losses)
        close = is_close_to_a_jump(basis, curve, count, trace, tangency, x, level, slots[TURNED] > 0)
        cycle = Cycle(loaded, jumps, unloaded, jumps_back, last, highest_depth(count, trace, x, level))
        put_rim(basis, curve, scene, (x, 0.0), cycle, (close, is_one_disc(basis, curve, limits, x)), i)
        if x == math.inf:
            put(scene.results, OUTERMOST, i, TWO_PI * scene.length * trace[ARRIVAL, count - 1])
        if sense.energy > 0:
            energy = part_of(sense.energy, loaded, unloaded)
            put_energy(basis, curve, sense, (math.log(scene.length), number), (count, trace), x, energy, i)
    return True


@kernel()
def _refuse_waves(results: Results, i: int) -> None:
    """Give rim number i no value: too many waves stand before it."""
    refuse(results, i)
    results.status[i] |= TOO_MANY_WAVES


@kernel()
def _cycles(basis: Basis, curve: Patterned, scene: Scene, rims: Floats, sense: AnySense, number: int) -> None:
    """Follow the cycles of a curve up to all its rims a_max/R that are not refused, of shape (rims,)."""
    bounds = window(basis, curve)
    places, together, alone = np.empty(rims.size), np.zeros(rims.size, np.bool_), np.zeros(rims.size, np.bool_)
    for i in range(rims.size):
        if scene.results.status[i] & NO_VALUE:
            continue
        places[i] = rims[i] / scene.wavelength
        together[i] = not are_too_many(basis, bounds[0], min(places[i], bounds[1]))
        if not together[i]:
            _refuse_waves(scene.results, i)
    if not together.any() or _walked(basis, curve, scene, bounds, places, together, sense, number):
        return
    for i in range(rims.size):  # too many folds up to the largest of them
        if together[i]:
            alone[i] = True
            if not _walked(basis, curve, scene, bounds, places, alone, sense, number):
                _refuse_waves(scene.results, i)
            alone[i] = False


@kernel()
def _pull_offs(
    basis: Basis, curve: Patterned, scene: Scene, force: float, rims: Floats, work: Search, deepest: float
) -> None:
    """Find the pull-off of a curve for all its rims a_max/R that are not refused; `force` is the unit of its load."""
    results = scene.results
    places, lows, found = np.empty(rims.size), np.empty(rims.size), np.empty((rims.size, 3))
    for i in range(rims.size):
        places[i] = math.nan if results.status[i] & NO_VALUE else rims[i] / scene.wavelength
        lows[i] = fma(-places[i], scene.wavelength, rims[i]) / scene.wavelength if places[i] < math.inf else 0.0
    lowest_loads(basis, curve, places, lows, work, deepest, found)
    for i in range(rims.size):
        if results.status[i] & NO_VALUE:
            continue
        lowest, place, second = found[i, 0], found[i, 1], found[i, 2]
        if math.isnan(lowest):
            _refuse_waves(results, i)
        elif not lowest < 0.0:  # no adhesion within the rim
            lowest, place = 0.0, math.nan
        put_pull_off(results, force, scene.wavelength, rims[i], (lowest, place, second), i)


@kernel()
def solve_scenes(
    table: Table,
    cosine_bins: Any,
    series: Harmonics,
    curves: GeneralCurves,
    patterns: Patterns,
    results: Results,
    sense: AnySense,
) -> None:
    """Solve the curves of one gradient exponent on patterned interfaces, each for all its rims.

    The table, the cosine bins and the series are what their profiles are computed from (`Basis` of curve/general.py).
    Values go to `results` in the shape (results, curves, rims), flags, int16, in (curves, rims).
    """
    work, deepest = room(), deepest_wave(table, series) if wants_force(results.slots) else 0.0
    for i in curves.numbers:
        rims = curves.rims[i if curves.rims.shape[0] > 1 else 0]
        own = Results(results.slots, results.out[:, i], results.status[i])
        valid, pattern, finest, curve, units = patterned_curve(table, cosine_bins, series, curves, patterns, i)
        basis, (unit, length, depth) = Basis(table, pattern, finest), units
        for rim in range(rims.size):
            if not (valid and 0.0 < rims[rim] <= patterns.limit[i]):
                refuse(own, rim)
        if not valid:
            continue
        scene = Scene(unit, length, TWO_PI * length * length, depth, own)
        if wants_force(own.slots):
            trough = deepest if basis.cosine_bins.gain > 0.0 else 0.0
            _pull_offs(basis, curve, scene, force_unit(table.k, length, depth), rims, work, trough)
        if wants_folds(own.slots):
            _cycles(basis, curve, scene, rims, sense, i)
        put_forces(basis, curve, sense, i, units, rims, own)
