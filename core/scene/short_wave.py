"""The leading form of short waves: from the numbers of scenes to their results, one curve with all its rims at a time.

The path is that of path/loading.py and path/unloading.py, by the functions of core/face.py; each wave is walked.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.branches import ARRIVAL, END_DEPTH, HIGHEST, ROWS, UNKNOWN, UNLOADING_JUMPS, Trace
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, coordinate, curve_of
from gradhesion.core.curve.general_branches import fill_branches
from gradhesion.core.curve.short_wave import SMALLEST, ShortWave, folds_within, waves_of
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.loading import highest_depth, load_up, loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.curves import Curves, is_in_range
from gradhesion.core.problem.results import OUTERMOST, Results, put, put_all, wants_folds, wants_force
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.pull_off.general import deepest_wave
from gradhesion.core.pull_off.short_wave import lowest_load
from gradhesion.core.scene.cosine import refuse
from gradhesion.core.scene.scene import Scene
from gradhesion.core.struve.current import ready
from gradhesion.core.types import Floats, Harmonics

_ROOM: Final = 16
"""Floats that a jump has room for (core/face.py)."""


@kernel()
def walk(basis: Basis, curve: ShortWave, furthest: float) -> tuple[int, Trace]:
    """Return the branches that begin within x = `furthest`, with the cycle on them; their number first, -1 if too many.

    The last one ends at `furthest` if no fold ends it before.
    """
    folds, rises, zeros = folds_within(basis, curve, furthest)
    trace = np.empty((ROWS, max(_ROOM, folds // 2 + 2)))
    if folds < 0:
        return -1, trace
    count = fill_branches(basis, curve, zeros, folds, rises, furthest, trace, 0.0)
    trace[UNLOADING_JUMPS, :count] = UNKNOWN
    load_up(basis, curve, count, trace, furthest, YES)
    highest = 0.0
    for branch in range(count):
        highest = max(highest, trace[END_DEPTH, branch])
        trace[HIGHEST, branch] = highest
    return count, trace


@kernel()
def _solve_curve(basis: Basis, curve: ShortWave, scene: Scene, unit: float, deepest: float, rims: Floats) -> None:
    """Solve a curve for all its rims a_max/R, of shape (rims,).

    `unit` is that of load in 1.5 pi R dgamma, `deepest` is max(-S).
    """
    results = scene.results
    force, folds = wants_force(results.slots), wants_folds(results.slots)
    furthest = rims.max() / scene.wavelength
    count, trace = -1, np.empty((ROWS, 0))
    if folds:
        count, trace = walk(basis, curve, furthest)
    shared = count >= 0 or rims.size == 1  # else a rim with fewer waves may still have its own
    for i in range(rims.size):
        x = rims[i] / scene.wavelength
        sound = SMALLEST < x < 1.0 / SMALLEST or x == math.inf
        lowest = place = loss = loss_back = loading = unloading = highest = last = math.nan
        if force and sound:
            lowest, place = lowest_load(basis, curve, curve.gain * deepest, x)
        if folds and sound and not shared:
            count, trace = walk(basis, curve, x)
        if folds and sound and count >= 0:
            level = coordinate(basis, curve, x) if x < math.inf else math.inf
            loss, loading = loading_to(basis, curve, count, trace, x, YES)
            loss_back, unloading, last = unloading_from(basis, curve, count, trace, x, level, YES)
            highest = highest_depth(count, trace, x, level)
            if loss + loss_back < 0.0:  # no cycle gains energy: the contact is no larger than a wave, out of range here
                loss = loss_back = loading = unloading = highest = last = math.nan
        fine = (loss + loss_back >= 0.0 or not folds) and (lowest < 0.0 or not force)
        results.status[i] = 0 if fine else NO_VALUE
        values = (
            -unit * lowest,
            place * scene.wavelength if place < x else rims[i],
            scene.energy * (loss + loss_back),
            loading,
            unloading,
            scene.depth * highest,
            scene.depth * last,
            scene.energy * loss,
            scene.energy * loss_back,
        )
        put_all(results, i, values)
        if folds:
            put(results, OUTERMOST, i, trace[ARRIVAL, count - 1] * scene.wavelength if count > 0 else math.nan)


@kernel()
def solve_curves(curves: Curves, harmonics: Harmonics, exponent: float, factors: Floats, results: Results) -> None:
    """Solve some curves, each for all its rims; lambda and A are those of the longest wave.

    The harmonics are rows (n, cos, sin) of the series, the exponent is the power m, and the factors, of shape
    (exponents,), those of depth (problem/shape.py). Values go to `results` in the shape (results, curves, rims), flags
    in (curves, rims).
    """
    tables, which, index, stiffness, wavelengths, amplitudes, rims = curves
    smooth = np.zeros((0, 3))
    deepest, before = 0.0, -1
    for j in range(index.size):
        i = index[j]
        table = tables[ready(tables, which[j])]
        if which[j] != before:
            before, deepest = which[j], table.amplitude * deepest_wave(table, harmonics)
        stretch = math.sqrt(2.0 ** (1.0 + table.k) * math.pi / stiffness[i])  # s = sqrt(2^(1+k) pi dgamma/M)
        wavelength, amplitude = wavelengths[i], amplitudes[i]
        wavy = amplitude > 0.0
        mean, rows = waves_of(table, harmonics if wavy else smooth)
        basis = Basis(table, mean, rows)
        exact, length, depth = curve_of(table.k, exponent, factors[which[j]], stretch, wavelength, amplitude, 0.0)
        curve = ShortWave(exact.bend, exponent, exact.gain, 1.0, 0.0)
        own = Results(results.slots, results.out[:, i], results.status[i])
        if not (is_in_range(stretch, wavelength, amplitude) and 0.0 < curve.bend < math.inf and curve.gain < math.inf):
            refuse(own)
            continue
        row = rims[i if rims.shape[0] > 1 else 0]
        scene = Scene(wavelength, length, TWO_PI * length * length, depth, own)
        _solve_curve(basis, curve, scene, force_unit(table.k, length, depth), deepest if wavy else 0.0, row)
