"""From the numbers of a general scene to its results: one kernel for one scene."""

import math
from collections.abc import Callable
from typing import Any, Final

import numpy as np

from gradhesion.core._jit import NO, kernel
from gradhesion.core.curve import force_unit
from gradhesion.core.folds import CLOSE
from gradhesion.core.general.curve import Basis, Curve, state
from gradhesion.core.general.folds import MOST_CELLS, room
from gradhesion.core.general.path import depth_at_full_contact, walk
from gradhesion.core.general.pull_off import lowest_load
from gradhesion.core.general.stride import stride
from gradhesion.core.general.waves import highest_harmonic
from gradhesion.core.general.window import first_fold_bound, last_fold_bound
from gradhesion.core.results import (
    CONTACT,
    DEEPEST,
    ENERGY,
    FORCE,
    LAST,
    LOADED,
    LOADING,
    RADIUS,
    UNLOADED,
    UNLOADING,
    put,
    wants_folds,
    wants_force,
    wants_losses,
)
from gradhesion.core.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, LOADING_NOT_ONE_DISC, NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.intrinsics import fma

LONGEST_WALK: Final = 512.0
"""Waves up to which a curve is walked."""


@kernel()
def curve_of(
    k: float,
    exponent: float,
    front: float,
    stretch: float,
    wavelength: float,
    amplitude: float,
    compliance: float,
) -> tuple[Curve, float, float]:
    """Return the curve, l, and the unit of depth; lengths are in R.

    Parameters
    ----------
    k, exponent
        The gradient's, and the punch's.
    front
        G(m/2) G(n)/(2 G(n + m/2)).
    stretch
        s.
    wavelength, amplitude
        lambda and A; A = 0 for a smooth punch.
    compliance
        K/S in units of 1/R^(1+k): 0 under displacement control, inf under load control.
    """
    length = wavelength / TWO_PI
    c = 0.5 * (1.0 - k)
    unit = stretch * length**c
    share = compliance * length ** (1.0 + k)
    alpha, beta = (0.0, 1.0) if share == math.inf else (1.0 / (1.0 + share), share / (1.0 + share))
    return (front * length**exponent / unit, exponent, amplitude * wavelength / unit, alpha, beta), length, unit


@kernel()
def _refuse(slots: Any, out: Any, status: Any, i: int) -> None:
    """Give a scene out of range no value."""
    for row in range(CONTACT):
        put(out, slots, row, i, math.nan)
    status[i] = NO_VALUE


@kernel()
def _cycle(
    basis: Basis,
    curve: Curve,
    length: float,
    unit: float,
    rim: float,
    rim_low: float,
    slots: Any,
    out: Any,
    status: Any,
    i: int,
) -> None:
    """Follow the cycle of a scene up to the rim x = `rim` + `rim_low`."""
    _, _, series = basis
    _, _, _, alpha, _ = curve
    first = first_fold_bound(basis, curve) / TWO_PI
    last = min(rim, last_fold_bound(basis, curve) / TWO_PI)
    tasks = (wants_losses(slots), alpha > 0.0, slots[CONTACT] >= 0)
    nothing = (0.0, 0.0, 0.0, 0.0, 0.0, NO)
    done, loading, unloading, close, one_disc, waves, x = False, nothing, nothing, False, True, 0.0, rim
    if series.shape[0] > 0 and LONGEST_WALK < last - first < math.inf:
        done, loading, unloading, close, one_disc, waves, x = stride(
            basis, curve, first, last, rim, rim_low, tasks, 0.0
        )
    if not done and (last - first) * highest_harmonic(series) < MOST_CELLS:
        done, loading, unloading, close, one_disc, waves, x = walk(basis, curve, first, last, rim, tasks)
    if not done:
        _refuse(slots, out, status, i)
        return
    _, _, level, _, _, _ = loading
    _, _, _, whole, left, _ = unloading
    if close:
        status[i] |= CLOSE_TO_A_JUMP
    if level == 0.0:
        status[i] |= JUMP_IN_TO_RIM
    if not one_disc:
        status[i] |= LOADING_NOT_ONE_DISC
    scale = TWO_PI * length * length
    put(out, slots, ENERGY, i, scale * (loading[0] + unloading[0]))
    put(out, slots, LOADED, i, scale * loading[0])
    put(out, slots, UNLOADED, i, scale * unloading[0])
    put(out, slots, LOADING, i, loading[1])
    put(out, slots, UNLOADING, i, unloading[1])
    if slots[LAST] >= 0:
        depth = -1.0
        if whole + left > 0.0:
            _, _, _, depth, _ = state(basis, curve, left, whole)
        put(out, slots, LAST, i, unit * depth)
    if slots[DEEPEST] >= 0:
        deepest = depth_at_full_contact(basis, curve, x, level, waves) if rim < math.inf else rim
        put(out, slots, DEEPEST, i, unit * deepest)


@kernel()
def _pull_off(
    basis: Basis,
    curve: Curve,
    scales: tuple[float, float],
    x: float,
    x_low: float,
    rim: float,
    slots: Any,
    out: Any,
    status: Any,
    i: int,
) -> None:
    """Find the pull-off of a scene up to the rim x + x_low; `scales` are those of its load and of its places."""
    force_scale, wavelength = scales
    lowest, place, second = lowest_load(basis, curve, x, x_low, room())
    if not lowest < 0.0:
        status[i] |= NO_VALUE
        lowest = place = math.nan
    elif second < lowest * (1.0 - CLOSE):
        status[i] |= CLOSE_TO_A_JUMP
    put(out, slots, FORCE, i, -force_scale * lowest)
    put(out, slots, RADIUS, i, place * wavelength if place != x else rim)
    if place == x:
        status[i] |= PULL_OFF_AT_RIM


def loop_of(*, cycles: bool) -> Callable[..., None]:
    """Return the kernel that solves many scenes; without `cycles` it knows the pull-off alone."""

    @kernel()
    def solve_scenes(
        table: Any,
        cosines: Any,
        series: Any,
        exponent: float,
        front: float,
        index: Any,
        stretch: Any,
        wavelength: Any,
        amplitude: Any,
        compliance: Any,
        rim: Any,
        slots: Any,
        out: Any,
        status: Any,
    ) -> None:
        """Solve the scenes `index` of one gradient exponent (curve_of tells what their numbers are)."""
        smooth = np.zeros((0, 3))
        for j in range(index.size):
            i = index[j]
            valid = 0.0 < stretch[i] < math.inf and 0.0 < wavelength[i] < math.inf and 0.0 <= amplitude[i] < math.inf
            if not (valid and rim[i] > 0.0 and compliance[i] >= 0.0):
                _refuse(slots, out, status, i)
                continue
            basis = (table, cosines, series if amplitude[i] > 0.0 else smooth)
            curve, length, unit = curve_of(
                table.k, exponent, front, stretch[i], wavelength[i], amplitude[i], compliance[i]
            )
            if not (0.0 < curve[0] < math.inf and 0.0 <= curve[2] < math.inf):
                _refuse(slots, out, status, i)
                continue
            x = rim[i] / wavelength[i]
            x_low = fma(-x, wavelength[i], rim[i]) / wavelength[i] if x < math.inf else 0.0
            if wants_force(slots):
                scales = (force_unit(table.k, length, unit), wavelength[i])
                _pull_off(basis, curve, scales, x, x_low, rim[i], slots, out, status, i)
            if cycles and wants_folds(slots):
                _cycle(basis, curve, length, unit, x, x_low, slots, out, status, i)

    return solve_scenes


solve_scenes: Final = loop_of(cycles=True)
solve_pull_offs: Final = loop_of(cycles=False)
"""The same where nothing but the pull-off is asked for."""
