"""The pull-off of the leading form of short waves: its lowest load over all contact radii up to the rim.

The load touches from above, once in every wave,

    X [ B m/(1+k+m) z^(m-c) - 1 - chi ],   X = z^((3+k)/2),   chi = max(-g S)

so that the lowest load stands within a wave or two of where this is lowest. The search goes from there outwards and
inwards, wave by wave of the highest harmonic, as long as one can contain anything lower than the best trough found.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, coordinate
from gradhesion.core.curve.general_folds import Zeros
from gradhesion.core.curve.short_wave import SMALLEST, ShortWave, Sizes, folds_between, sizes_of
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI

_PHASELESS: Final = 1e12
"""z beyond which a double no longer resolves the phase well."""
_SHARP: Final = 1.0 + 1e-13
"""How far below the best trough the parabola must be for a wave to be searched: rounding of chi is less."""
_INNERMOST: Final = 1e-12
"""Of the place where the search begins, down to which it goes on."""
_MOST: Final = 100_000
"""Waves of the highest harmonic that are searched on either side."""
_ROOM: Final = 32
"""Room for the folds of a wave of the highest harmonic."""


@kernel()
def _floor(basis: Basis, curve: ShortWave, chi: float, x: float) -> float:
    """Return the bound that the load touches from above."""
    k, z = basis.table.k, TWO_PI * x
    B, m, _, _, _ = curve
    return z ** (0.5 * (3.0 + k)) * (B * m / (1.0 + k + m) * z ** (m - 0.5 * (1.0 - k)) - 1.0 - chi)


@kernel()
def _lowest_between(
    basis: Basis, by_load: ShortWave, sizes: Sizes, low: float, high: float, zeros: Zeros, best: tuple[float, float]
) -> tuple[float, float]:
    """Return the lowest load so far and its place, the troughs between two places taken in."""
    count, rises = folds_between(basis, by_load, sizes, low, high, zeros)
    for i in range(count):
        if rises == (i % 2 == 1):
            value = coordinate(basis, by_load, zeros[i])
            if value < best[0]:
                best = (value, zeros[i])
    return best


@kernel()
def lowest_load(basis: Basis, curve: ShortWave, chi: float, x_rim: float) -> tuple[float, float]:
    """Return the lowest reduced load over (0, x_rim] and the x where it is met; far out, those of the envelope.

    0 is returned where no load is below zero, NaN where the radii are below those of `SMALLEST`.
    """
    k = basis.table.k
    B, m, g, _, _ = curve
    # its slope is zero where m B z^(m-c) = (3+k)/2 (1 + chi)
    start = min((0.5 * (3.0 + k) * (1.0 + chi) / (m * B)) ** (1.0 / (m - 0.5 * (1.0 - k))) / TWO_PI, x_rim)
    if not start > SMALLEST:
        return math.nan, math.nan
    if not TWO_PI * start <= _PHASELESS:
        return _floor(basis, curve, chi, start), start
    by_load = ShortWave(B, m, g, 0.0, 1.0)
    sizes, zeros, width = sizes_of(basis, by_load), np.empty(_ROOM), 1.0 / max(1.0, highest_harmonic(basis.series))
    best = (min(0.0, coordinate(basis, by_load, x_rim)) if x_rim < math.inf else 0.0, x_rim)
    low, high = max(start - 0.5 * width, 0.5 * start), min(x_rim, start + 0.5 * width)
    best = _lowest_between(basis, by_load, sizes, low, high, zeros, best)
    for _ in range(_MOST):
        if high >= x_rim or _floor(basis, curve, chi, high) >= best[0] * _SHARP:
            break
        beyond = min(x_rim, high + width)
        best = _lowest_between(basis, by_load, sizes, high, beyond, zeros, best)
        high = beyond
    for _ in range(_MOST):
        if low <= _INNERMOST * start or _floor(basis, curve, chi, low) >= best[0] * _SHARP:
            break
        beyond = max(low - width, 0.5 * low)
        best = _lowest_between(basis, by_load, sizes, beyond, low, zeros, best)
        low = beyond
    return best
