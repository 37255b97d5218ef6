"""What loading and unloading ask of a curve: that of one cosine, of any profile and control, or of a short wave.

A curve of one cosine (curve/cosine.py) has three numbers and goes with the table of its exponent, a general one
(curve/general.py) has five and goes with its basis, and the leading form of a short wave (curve/short_wave.py) is a
tuple with its wave, which needs no table. Numba knows the length of each when it compiles, and leaves the others out. A
trace has the rows of curve/branches.py for all; its "depths" are the coordinates Y of a general curve.
"""

import math
from typing import Any

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve import short_wave as asymptotic
from gradhesion.core.curve.arches import is_one_cosine
from gradhesion.core.curve.branches import ends, find_depth
from gradhesion.core.curve.cosine import depth_size, most_depth_size
from gradhesion.core.curve.cosine import slope as cosine_slope
from gradhesion.core.curve.cosine_energy import energy_from_zero, jump_energy
from gradhesion.core.curve.general import size, slope, state
from gradhesion.core.curve.general_branches import find_level
from gradhesion.core.curve.one_cosine_energy import jump_of_one_cosine, jump_of_one_cosine_from_zero
from gradhesion.core.curve.short_wave_energy import loss_of_jump
from gradhesion.core.waves.general_jump import jump_between, jump_from_zero


@kernel()
def find_place(table: Any, curve: Any, level: float, trace: Any, branch: int) -> float:
    """Return where a branch meets a coordinate between those of its two ends."""
    if len(curve) == 3:
        return find_depth(table, curve, level, ends(trace, branch))
    if len(curve) == 1:
        start, _, end, _ = ends(trace, branch)
        return asymptotic.find_depth(curve[0], level, start, end)
    return find_level(table, curve, level, ends(trace, branch), 0.0)


@kernel()
def loss_between(table: Any, curve: Any, start: float, end: float, work: Any) -> float:
    """Return what a jump from one place of the curve to another one loses; `work` is room for its nodes."""
    if len(curve) == 3:
        return jump_energy(table, curve, start, end, work)
    if len(curve) == 1:
        return loss_of_jump(curve[0], asymptotic.depth(curve[0], start), start, end)
    if is_one_cosine(table[2], curve[1]) and end > 0.0:
        served, energy = jump_of_one_cosine(table, curve, start, end)
        if served:
            return energy
    return jump_between(table, curve, start, end, 0.0)


@kernel()
def _from_zero(table: Any, curve: Any, x: float, level: float) -> float:
    """Return what the jump from zero contact to x loses at a coordinate of a general curve."""
    if is_one_cosine(table[2], curve[1]):
        served, energy = jump_of_one_cosine_from_zero(table, curve, x, level)
        if served:
            return energy
    return jump_from_zero(table, curve, x, level, 0.0)


@kernel()
def loss_from_zero(table: Any, curve: Any, x: float) -> float:
    """Return what the jump from zero contact to x loses, at the coordinate 0."""
    if len(curve) == 3:
        return energy_from_zero(table, curve, x, 0.0)
    if len(curve) == 1:
        return loss_of_jump(curve[0], 0.0, 0.0, x)
    return _from_zero(table, curve, x, 0.0)


@kernel()
def loss_to_zero(table: Any, curve: Any, x: float, level: float) -> float:
    """Return what the jump-out from x at a coordinate loses, 0 under a dead load: there it has no bound."""
    if len(curve) == 3:
        return -energy_from_zero(table, curve, x, level)
    if len(curve) == 1:
        return loss_of_jump(curve[0], level, x, 0.0)
    if curve[3] == 0.0:
        return 0.0
    return -_from_zero(table, curve, x, level)


@kernel()
def size_at(table: Any, curve: Any, x: float) -> float:
    """Return the size of the terms of the coordinate at x."""
    if len(curve) == 3:
        return depth_size(table, curve, x)
    return size(table, curve, x, 0.0)


@kernel()
def most_size_at(table: Any, curve: Any, x: float) -> float:
    """Return a bound of that size: without a power where there is one."""
    if len(curve) == 3:
        return most_depth_size(table, curve, x)
    return math.inf


@kernel()
def fold_at(table: Any, curve: Any, x: float) -> tuple[float, float]:
    """Return D, whose zeros are folds, and dD/dz at x."""
    if len(curve) == 3:
        value, rate, _, _ = cosine_slope(table, curve, 0.5 * (1.0 - table.k), x)
        return value, rate
    value, rate, _ = slope(table, curve, x, 0.0)
    return value, rate


@kernel()
def depth_at(table: Any, curve: Any, x: float, level: float) -> float:
    """Return the depth at x, where the coordinate is `level`."""
    if len(curve) == 3 or len(curve) == 1:
        return level
    if x == 0.0:  # k = 1: contact begins in a point
        return -1.0
    _, _, _, depth, _ = state(table, curve, x, 0.0)
    return depth
