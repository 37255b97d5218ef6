"""From the numbers of scenes of any profile to their results: one curve at a time, with all its rims.

The one loop over scenes of every kind of curve but that of one cosine. Without sensitivities `sense` is `NoSense`, for
which nothing of them is compiled.
"""

import math
from collections.abc import Callable
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Series, curve_at, rims_of
from gradhesion.core.curve.general_folds import Search, room
from gradhesion.core.face import window
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.results import Results, wants_folds, wants_force
from gradhesion.core.problem.status import TOO_MANY_WAVES
from gradhesion.core.pull_off.general import deepest_wave
from gradhesion.core.pull_off.rims import lowest_loads
from gradhesion.core.scene.general_rim import is_left, only, refuse_waves, shares_trace, walked
from gradhesion.core.scene.scene import Scene, put_pull_off, refuse
from gradhesion.core.sensitivities.general_slopes import put_rest, sensed_by
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.types import Floats


@kernel()
def _cycles(basis: Basis, curve: Series, scene: Scene, rims: Floats, own: AnySense) -> bool:
    """Follow the cycles of a curve up to its rims a_max/R, of shape (rims,), that share a trace, if not refused.

    Return whether others are left for scene/general_long.py.
    """
    count = rims.size
    bounds = window(basis, curve)
    places, together = np.empty(count), np.zeros(count, np.bool_)
    shared, left = False, False
    for i in range(count):
        if not rims[i] > 0.0 or scene.results.status[i] & TOO_MANY_WAVES:
            continue
        places[i] = rims[i] / scene.wavelength
        if shares_trace(basis, curve, bounds, places[i]):
            together[i] = shared = True
        else:
            left |= is_left(curve, scene.results, i)
    if not shared or walked(basis, curve, scene, bounds, places, together, own):
        return left
    for i in range(count):  # too many folds up to the largest of them
        if together[i] and not walked(basis, curve, scene, bounds, places, only(i, count), own):
            refuse_waves(curve, scene.results, i)
    return left


@kernel()
def _pull_offs(
    basis: Basis, curve: Series, scene: Scene, force: float, rims: Floats, work: Search, deepest: float
) -> None:
    """Find the pull-off of a curve for all its rims a_max/R, of shape (rims,), that are positive.

    `force` is the unit of its load in 1.5 pi R dgamma, `deepest` that of pull_off/general.py, 0 for a smooth punch.
    """
    places, lows, found = np.empty(rims.size), np.empty(rims.size), np.empty((rims.size, 3))
    for i in range(rims.size):
        places[i] = rims[i] / scene.wavelength
        lows[i] = fma(-places[i], scene.wavelength, rims[i]) / scene.wavelength if places[i] < math.inf else 0.0
    lowest_loads(basis, curve, places, lows, work, deepest, found)
    for i in range(rims.size):
        if not rims[i] > 0.0:
            continue
        lowest, place, second = found[i, 0], found[i, 1], found[i, 2]
        if math.isnan(lowest):
            refuse_waves(curve, scene.results, i)
        elif not lowest < 0.0:  # no adhesion within the rim
            lowest, place = 0.0, math.nan
        put_pull_off(scene.results, force, scene.wavelength, rims[i], (lowest, place, second), i)


def loop_of(*, cycles: bool) -> Callable[..., int]:
    """Return the kernel that solves many scenes; without `cycles` it knows the pull-off alone."""

    @kernel()
    def solve_scenes(basis: Basis, curves: GeneralCurves, results: Results, sense: AnySense) -> int:
        """Solve the curves of one gradient exponent, each for its rims; return of how many some rims are left.

        Values go to `results` in the shape (results, curves, rims), flags in (curves, rims).
        """
        left = 0
        work, deepest = room(), deepest_wave(basis.table, basis.series) if wants_force(results.slots) else 0.0
        for i in curves.numbers:
            own = Results(results.slots, results.out[:, i], results.status[i])
            made = curve_at(basis, curves, i)
            rims = rims_of(curves, i)
            for rim in range(rims.size):
                if not (made.valid and rims[rim] > 0.0):
                    refuse(own, rim)
            if not made.valid:
                continue
            waves = Basis(basis.table, made.cosine_bins, made.series)
            curve, length = made.curve, made.length
            sensed = sensed_by(sense, curves, made, i)
            scene = Scene(made.wavelength, length, TWO_PI * length * length, made.depth, own)
            if wants_force(own.slots):
                force = force_unit(basis.table.k, length, made.depth)
                _pull_offs(waves, curve, scene, force, rims, work, deepest if curves.amplitude[i] > 0.0 else 0.0)
            if cycles and wants_folds(own.slots):
                left += _cycles(waves, curve, scene, rims, sensed)
            put_rest(waves, made, sensed, rims, own)
        return left

    return solve_scenes


solve_scenes: Final = loop_of(cycles=True)
solve_pull_offs: Final = loop_of(cycles=False)
"""The same where nothing but the pull-off is wanted."""
