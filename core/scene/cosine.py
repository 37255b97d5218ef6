"""From the numbers of a scene to its results: the kernel that a single scene and a sweep of millions share.

A scene is reduced to its curve (curve/cosine.py) and its rim. Lengths are in R, energies in R^2 dgamma, M in
dgamma/R^(1+k).

Nothing is computed that only a result needs for which nobody asked. Sensitivities are read off the trace that the
energy is read off; without them `sense` is an empty tuple, whose length numba knows when it compiles.
"""

import math
from typing import Any

from gradhesion.core.closed import smooth
from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine, curve_of, force_unit
from gradhesion.core.curve.cosine_folds import CLOSE
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
    put,
    wants_cycle,
    wants_folds,
    wants_force,
    wants_losses,
)
from gradhesion.core.problem.status import (
    CLOSE_TO_A_JUMP,
    JUMP_IN_TO_RIM,
    NO_VALUE,
    PULL_OFF_AT_RIM,
)
from gradhesion.core.pull_off.cosine import lowest_load
from gradhesion.core.scene.cosine_long import solve_long
from gradhesion.core.scene.cosine_rim import limits_of, read_rim, slopes_of
from gradhesion.core.sensitivities.cosine_slopes import (
    at_fixed_stiffness,
    beside,
    put_forces,
    put_smooth,
)
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.intrinsics import fma


@kernel()
def _solve_smooth(k: float, stretch: float, rims: Any, slots: Any, out: Any, status: Any) -> None:
    """Solve a smooth punch for all its rims (scene/smooth.py does so for many at once)."""
    jump_in = smooth.smooth_square(k, stretch, smooth.ABSCISSA_OF_JUMP_IN)
    jump_out = smooth.smooth_square(k, stretch, smooth.abscissa_of_jump_out(k))
    for i in range(rims.size):
        rim, abscissa = rims[i], smooth.smooth_abscissa(k, stretch, rims[i])
        if wants_force(slots):
            put(out, slots, FORCE, i, smooth.smooth_force(k, abscissa))
            at_rim = smooth.is_pulled_off_at_rim(k, abscissa)
            if slots[RADIUS] >= 0:
                square = smooth.smooth_square(k, stretch, smooth.abscissa_of_pull_off(k))
                put(out, slots, RADIUS, i, rim if at_rim else math.sqrt(square))
            if at_rim:
                status[i] |= PULL_OFF_AT_RIM
        if wants_cycle(slots):
            loaded = smooth.smooth_loading(k, abscissa, rim, jump_in)
            unloaded = smooth.smooth_unloading(k, abscissa, rim, jump_out)
            put(out, slots, ENERGY, i, loaded + unloaded)
            put(out, slots, LOADED, i, loaded)
            put(out, slots, UNLOADED, i, unloaded)
            put(out, slots, LOADING, i, 1.0)
            put(out, slots, UNLOADING, i, smooth.smooth_jumps_out(k))
            square = min(rim * rim, jump_out)
            root = power(math.sqrt(square), 0.5 * (1.0 - k))
            put(out, slots, LAST, i, smooth.smooth_last(k, stretch, square, root))
            put(out, slots, OUTERMOST, i, math.sqrt(jump_in))
        if wants_folds(slots):
            put(out, slots, DEEPEST, i, smooth.smooth_deepest(k, abscissa, rim))
            if smooth.jumps_in_to_rim(abscissa):
                status[i] |= JUMP_IN_TO_RIM


@kernel()
def _solve_force(
    table: Any, curve: Cosine, scale: float, wavelength: float, rims: Any, slots: Any, out: Any, status: Any
) -> None:
    """Find the pull-off of a wavy punch for all its rims; that without a rim serves all rims beyond its place."""
    free_load, free_x, free_second = 0.0, math.inf, 0.0
    if rims.size > 1:
        free_load, free_x, free_second = lowest_load(table, curve, math.inf, 0.0)
    for i in range(rims.size):
        x = rims[i] / wavelength
        lowest, place, second = free_load, free_x, free_second
        if not (free_load < 0.0 and free_x <= x):
            x_low = fma(-x, wavelength, rims[i]) / wavelength if x < math.inf else 0.0
            lowest, place, second = lowest_load(table, curve, x, x_low)
        if second < lowest * (1.0 - CLOSE):
            status[i] |= CLOSE_TO_A_JUMP
        put(out, slots, FORCE, i, -scale * lowest)
        put(out, slots, RADIUS, i, place * wavelength if place != x else rims[i])
        if place == x:
            status[i] |= PULL_OFF_AT_RIM


@kernel()
def _solve_cycle(
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
    """Follow the cycle of a wavy punch for all its rims: those within a walk share one trace."""
    losses = wants_losses(slots)
    final = arches[1]
    furthest, long = 0.0, False
    for i in range(rims.size):
        x = rims[i] / wavelength
        if is_unresolved(arches, x):
            status[i] |= NO_VALUE
        elif is_long(table, arches, x):
            long = True
        else:
            furthest = max(furthest, x)
    if furthest > 0.0:
        count, trace = walk(table, curve, arches, furthest, scratch, losses)
        limits = limits_of(table, curve, count, trace, furthest, slots)
        slopes = slopes_of(table, curve, sense, around, count, trace, final) if len(sense) > 0 else ()
        for i in range(rims.size):
            x = rims[i] / wavelength
            if not is_unresolved(arches, x) and not is_long(table, arches, x):
                read_rim(
                    table, curve, scales, count, trace, limits, x, slots, out, status, i, sense, around, final, slopes
                )
    if long:
        solve_long(table, curve, arches, scales, wavelength, rims, slots, out, status, scratch, sense, around)


@kernel()
def _mark_unresolved(wavelength: float, rims: Any, out: Any, status: Any) -> None:
    """Give no value to rims that have none, or whose size over the wavelength has none."""
    for i in range(rims.size):
        if status[i] & NO_VALUE or not rims[i] / wavelength > SMALLEST or LARGEST < rims[i] / wavelength < math.inf:
            out[:, i] = math.nan
            status[i] = NO_VALUE


@kernel()
def solve_pull_off(
    table: Any,
    stretch: float,
    wavelength: float,
    amplitude: float,
    rims: Any,
    slots: Any,
    out: Any,
    status: Any,
) -> None:
    """Do what `solve_curve` does where nothing but the pull-off is asked for: no cycle is compiled with it."""
    k = table.k
    if is_endless_wave(wavelength, amplitude):
        _solve_smooth(k, stretch, rims, slots, out, status)
        return
    curve, length, depth_scale = curve_of(k, stretch, wavelength, amplitude * wavelength)
    if not (0.0 < curve.bend < LARGEST and curve.gain < LARGEST):
        out[:, :] = math.nan
        status[:] = NO_VALUE
        return
    _solve_force(table, curve, force_unit(k, length, depth_scale), wavelength, rims, slots, out, status)
    _mark_unresolved(wavelength, rims, out, status)


@kernel()
def solve_curve(
    table: Any,
    stretch: float,
    wavelength: float,
    amplitude: float,
    rims: Any,
    slots: Any,
    out: Any,
    status: Any,
    scratch: Any,
    sense: Any,
) -> None:
    """Solve one curve (k, s, lambda, A) for all its rims a_max.

    `sense` is (), or what sensitivities need: the tables of neighbouring exponents, their weights in d/dk, the weight
    of k itself, where sensitivities go (3, COUNT, rims), whether those of force and of energy are asked for, and
    whether the rims are places where cycles turn.
    """
    k = table.k
    if is_endless_wave(wavelength, amplitude):  # A = 0 among them
        _solve_smooth(k, stretch, rims, slots, out, status)
        if len(sense) > 0:
            put_smooth(table, stretch, rims, slots, out, status, sense, scratch)
        return
    curve, length, depth_scale = curve_of(k, stretch, wavelength, amplitude * wavelength)
    if not (0.0 < curve.bend < LARGEST and curve.gain < LARGEST):  # powers of them would overflow
        out[:, :] = math.nan
        status[:] = NO_VALUE
        return
    folds = wants_folds(slots)
    arches = extent(table, curve) if folds else (0.0, 0.0)
    if folds and is_smooth(arches):
        _solve_smooth(k, stretch, rims, slots, out, status)
        if len(sense) > 0:
            put_smooth(table, stretch, rims, slots, out, status, sense, scratch)
        return
    around = beside(table, sense, stretch, wavelength, amplitude) if len(sense) > 0 else ()
    if wants_force(slots):
        _solve_force(table, curve, force_unit(k, length, depth_scale), wavelength, rims, slots, out, status)
    if folds:
        scales = (TWO_PI * length * length, depth_scale)
        _solve_cycle(table, curve, arches, scales, wavelength, rims, slots, out, status, scratch, sense, around)
    if len(sense) > 0:
        if sense[3]:
            put_forces(table, curve, around, depth_scale, wavelength, rims, slots, out, status, sense)
        at_fixed_stiffness(around, sense[2])
    _mark_unresolved(wavelength, rims, out, status)
