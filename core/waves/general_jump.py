"""Energies of jumps of any length: those over many waves are summed (waves/general_sum.py)."""

from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_energy import Left, drop, energy_from_zero, jump_energy, place_left
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.layout import SWITCH
from gradhesion.core.waves.general import PASSING, Waves, room_for_waves
from gradhesion.core.waves.general_sum import sum_of_waves

LONG: Final = 512.0
"""Waves up to which a jump is integrated panel by panel."""
_INNER: Final = 16.0
"""Radius over wavelength up to which a long jump is integrated panel by panel."""
_FAR: Final = 2.0**25
_RATIO: Final = 16.0
"""Waves from which on a jump from zero contact is cut, and the outer over the inner radius of a part: what rounding
leaves of the coordinate at the outer end is more than all of it where powers of the radius are much smaller."""


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
def near_zero(start: float, end: float, whole: float) -> tuple[float, float, float]:
    """Return two places beyond whole waves, as places alone if one is so near zero contact that it has no whole waves.

    A place at z < 40 is given by x alone (harmonics/series.py).
    """
    if whole > 0.0 and TWO_PI * (whole + min(start, end)) < SWITCH and abs(end - start) <= LONG:
        return whole + start, whole + end, 0.0
    return start, end, whole


@kernel()
def jump_between(basis: Basis, curve: Series, start: float, end: float, whole: float) -> float:
    """Return e of a jump from whole + start on the curve to whole + end, both beyond zero contact."""
    _, _, series = basis
    start, end, whole = near_zero(start, end, whole)
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
    total, low = energy_from_zero(basis, curve, _INNER, level), _INNER
    while whole + x > max(_FAR, _RATIO * low):
        high = _RATIO * low
        left = place_left(basis, curve, 0.0, high, coordinate(basis, curve, 0.0, high) - level)
        total += _pass(basis, curve, left, low, high, 0.0)
        low = high
    left = place_left(basis, curve, x, whole, coordinate(basis, curve, x, whole) - level)
    return total + _pass(basis, curve, left, low - whole, x, whole)
