"""From the numbers of a scene to its results: the kernel that a single scene and a sweep of millions share.

A scene is reduced to its curve (curve/cosine.py) and its rim. Lengths are in R, energies in R^2 dgamma, M in
dgamma/R^(1+k).

Nothing is computed that only a result needs that is not wanted. Sensitivities are read off the trace that the
energy is read off; without them `sense` is `NoSense`, for which nothing of them is compiled. Cycles of more waves than
are walked are left for scene/cosine_long.py, whose kernels take as long to compile as all others of a cycle.
"""

import math

from gradhesion.core.closed import smooth
from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import Trace
from gradhesion.core.curve.cosine import Cosine, curve_of, force_unit
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.path.cosine import (
    LARGEST,
    SMALLEST,
    extent,
    is_endless_wave,
    is_long,
    is_smooth,
    is_unresolved,
    walk,
)
from gradhesion.core.problem.results import (
    DEEPEST,
    ENERGY,
    FORCE,
    LAST,
    LOADED,
    LOADING,
    OUTERMOST,
    RADIUS,
    UNLOADED,
    UNLOADING,
    Results,
    put,
    wants_cycle,
    wants_folds,
    wants_force,
    wants_losses,
)
from gradhesion.core.problem.status import JUMP_IN_TO_RIM, LEFT, NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.pull_off.cosine import lowest_load
from gradhesion.core.scene.cosine_rim import read_rim, slopes_of, walked_to
from gradhesion.core.scene.scene import Scene, put_pull_off
from gradhesion.core.sensitivities.cosine_slopes import put_rest, put_smooth, sensed_by
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.types import Floats, Table


@kernel()
def _solve_smooth(k: float, stretch: float, rims: Floats, results: Results) -> None:
    """Solve a smooth punch of stretch s for all its rims a_max/R, of shape (rims,); many are for scene/smooth.py."""
    slots = results.slots
    jump_in = smooth.smooth_square(k, stretch, smooth.ABSCISSA_OF_JUMP_IN)
    jump_out = smooth.smooth_square(k, stretch, smooth.abscissa_of_jump_out(k))
    for i in range(rims.size):
        rim, abscissa = rims[i], smooth.smooth_abscissa(k, stretch, rims[i])
        if wants_force(slots):
            put(results, FORCE, i, smooth.smooth_force(k, abscissa))
            at_rim = smooth.is_pulled_off_at_rim(k, abscissa)
            if slots[RADIUS] >= 0:
                square = smooth.smooth_square(k, stretch, smooth.abscissa_of_pull_off(k))
                put(results, RADIUS, i, rim if at_rim else math.sqrt(square))
            if at_rim:
                results.status[i] |= PULL_OFF_AT_RIM
        if wants_cycle(slots):
            loaded = smooth.smooth_loading(k, abscissa, rim, jump_in)
            unloaded = smooth.smooth_unloading(k, abscissa, rim, jump_out)
            put(results, ENERGY, i, loaded + unloaded)
            put(results, LOADED, i, loaded)
            put(results, UNLOADED, i, unloaded)
            put(results, LOADING, i, 1.0)
            put(results, UNLOADING, i, smooth.smooth_jumps_out(k))
            square = min(rim * rim, jump_out)
            root = power(math.sqrt(square), 0.5 * (1.0 - k))
            put(results, LAST, i, smooth.smooth_last(k, stretch, square, root))
            put(results, OUTERMOST, i, math.sqrt(jump_in))
        if wants_folds(slots):
            put(results, DEEPEST, i, smooth.smooth_deepest(k, abscissa, rim))
            if smooth.jumps_in_to_rim(abscissa):
                results.status[i] |= JUMP_IN_TO_RIM


@kernel()
def _solve_force(table: Table, curve: Cosine, scale: float, wavelength: float, rims: Floats, results: Results) -> None:
    """Find the pull-off of a wavy punch for all its rims a_max/R, shape (rims,); the free one is that of all beyond it.

    `scale` is the unit of load in 1.5 pi R dgamma.
    """
    free_load, free_x, free_second = 0.0, math.inf, 0.0
    if rims.size > 1:
        free_load, free_x, free_second = lowest_load(table, curve, math.inf, 0.0)
    for i in range(rims.size):
        x = rims[i] / wavelength
        lowest, place, second = free_load, free_x, free_second
        if not (free_load < 0.0 and free_x <= x):
            x_low = fma(-x, wavelength, rims[i]) / wavelength if x < math.inf else 0.0
            lowest, place, second = lowest_load(table, curve, x, x_low)
        put_pull_off(results, scale, wavelength, rims[i], (lowest, place, second), i)


@kernel()
def _solve_cycle(
    table: Table,
    curve: Cosine,
    arches: tuple[float, float],
    scene: Scene,
    rims: Floats,
    scratch: Trace,
    sensed: AnySense,
) -> bool:
    """Follow the cycle of a wavy punch for its rims a_max/R, of shape (rims,), that a walk reaches, on one trace.

    Return whether there are others. `arches` are the first and the last one on which the curve can fold, `scratch` is
    room for a trace.
    """
    furthest, long = 0.0, False
    for i in range(rims.size):
        x = rims[i] / scene.wavelength
        if is_unresolved(arches, x):
            scene.results.status[i] |= NO_VALUE
        elif is_long(table, arches, x):
            scene.results.status[i] |= LEFT
            long = True
        else:
            furthest = max(furthest, x)
    if furthest > 0.0:
        count, trace = walk(table, curve, arches, furthest, scratch, wants_losses(scene.results.slots))
        walked = walked_to(table, curve, count, trace, furthest, scene)
        slopes = slopes_of(table, curve, sensed, walked, arches[1])
        for i in range(rims.size):
            x = rims[i] / scene.wavelength
            if not is_unresolved(arches, x) and not is_long(table, arches, x):
                read_rim(table, curve, walked, scene, x, i, sensed, slopes)
    return long


@kernel()
def mark_unresolved(wavelength: float, rims: Floats, results: Results) -> None:
    """Give no value to rims a_max/R, shape (rims,), that have none, or whose size over the wavelength has none."""
    status = results.status
    for i in range(rims.size):
        if status[i] & NO_VALUE or not rims[i] / wavelength > SMALLEST or LARGEST < rims[i] / wavelength < math.inf:
            results.out[:, i] = math.nan
            status[i] = NO_VALUE


@kernel()
def refuse(results: Results) -> None:
    """Give no rim of a curve a value."""
    results.out[:, :] = math.nan
    results.status[:] = NO_VALUE


@kernel()
def solve_pull_off(
    table: Table, stretch: float, wavelength: float, amplitude: float, rims: Floats, results: Results
) -> None:
    """Solve a curve as `solve_curve` does where nothing but the pull-off is wanted: no cycle is compiled with it.

    `rims` are a_max/R, of shape (rims,).
    """
    k = table.k
    if is_endless_wave(wavelength, amplitude):
        _solve_smooth(k, stretch, rims, results)
        return
    curve, length, depth_scale = curve_of(k, stretch, wavelength, amplitude * wavelength)
    if not (0.0 < curve.bend < LARGEST and curve.gain < LARGEST):
        refuse(results)
        return
    _solve_force(table, curve, force_unit(k, length, depth_scale), wavelength, rims, results)
    mark_unresolved(wavelength, rims, results)


@kernel()
def solve_curve(
    table: Table,
    stretch: float,
    wavelength: float,
    amplitude: float,
    rims: Floats,
    results: Results,
    scratch: Trace,
    sense: AnySense,
) -> bool:
    """Solve one curve, of s in R^((1+k)/2), lambda/R and A, for its rims a_max/R, of shape (rims,).

    `scratch` is room for a trace, of shape (ROWS, branches).

    Returns
    -------
    Whether the cycles of some rims are left for `solve_left` (scene/cosine_long.py).
    """
    k, slots = table.k, results.slots
    if is_endless_wave(wavelength, amplitude):  # A = 0 among them
        _solve_smooth(k, stretch, rims, results)
        put_smooth(table, stretch, rims, results, sense, scratch)
        return False
    curve, length, depth_scale = curve_of(k, stretch, wavelength, amplitude * wavelength)
    if not (0.0 < curve.bend < LARGEST and curve.gain < LARGEST):  # powers of them would overflow
        refuse(results)
        return False
    left, folds = False, wants_folds(slots)
    arches = extent(table, curve) if folds else (0.0, 0.0)
    if folds and is_smooth(arches):
        _solve_smooth(k, stretch, rims, results)
        put_smooth(table, stretch, rims, results, sense, scratch)
        return False
    sensed = sensed_by(table, sense, stretch, wavelength, amplitude)
    if wants_force(slots):
        _solve_force(table, curve, force_unit(k, length, depth_scale), wavelength, rims, results)
    if folds:
        scene = Scene(wavelength, length, TWO_PI * length * length, depth_scale, results)
        left = _solve_cycle(table, curve, arches, scene, rims, scratch, sensed)
    put_rest(table, curve, sensed, depth_scale, wavelength, rims, results)
    mark_unresolved(wavelength, rims, results)
    return left
