"""Energies of jumps of any length: what passes many waves is summed (waves/general_sum.py)."""

from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_energy import Left, drop, energy_from_zero, jump_energy, place_left
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.waves.general import PASSING, Waves, room_for_waves
from gradhesion.core.waves.general_sum import sum_of_waves

LONG: Final = 512.0
"""Waves up to which a jump is integrated panel by panel."""
_INNER: Final = 16.0
"""Radius over wavelength up to which a long jump is integrated panel by panel."""


@kernel()
def _pass(basis: Basis, curve: Series, left: Left, low: float, high: float, whole: float) -> float:
    """Return e outwards from whole + low >= _INNER to whole + high at the coordinate of the place `left`."""
    _, _, series = basis
    begin, end = np.ceil(whole + low), np.floor(whole + high) - 1.0
    inner, outer = begin - 1.0, end + 1.0
    total = drop(basis, curve, left, (whole - inner) + low, 1.0, inner)
    total += drop(basis, curve, left, 0.0, (whole - outer) + high, outer)
    middle, _ = sum_of_waves(basis, curve, Waves(PASSING, 0.0, left, room_for_waves(series)), begin, end, YES)
    return total * TWO_PI * TWO_PI + middle


@kernel()
def jump_between(basis: Basis, curve: Series, start: float, end: float, whole: float) -> float:
    """Return e of a jump from whole + start on the curve to whole + end, both beyond zero contact."""
    _, _, series = basis
    if abs(end - start) <= LONG or series.shape[0] == 0:
        return jump_energy(basis, curve, start, end, whole)
    left = place_left(basis, curve, start, whole)
    low, high = min(start, end), max(start, end)
    total = 0.0
    if whole + low < _INNER:
        total = TWO_PI * TWO_PI * drop(basis, curve, left, whole + low, _INNER, 0.0)
        low = _INNER - whole
    total += _pass(basis, curve, left, low, high, whole)
    return total if end > start else -total


@kernel()
def jump_from_zero(basis: Basis, curve: Series, x: float, level: float, whole: float) -> float:
    """Return e of a jump at Y = level from zero contact to whole + x.

    Unless it ends at the rim, where contact may be pinned, the level is that of the curve there.
    """
    _, _, series = basis
    if whole + x <= LONG or series.shape[0] == 0:
        return energy_from_zero(basis, curve, whole + x, level)
    left = place_left(basis, curve, x, whole, coordinate(basis, curve, x, whole) - level)
    inner = energy_from_zero(basis, curve, _INNER, level)
    return inner + _pass(basis, curve, left, _INNER - whole, x, whole)
