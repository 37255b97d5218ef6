"""The pull-off force: the lowest load over all contact radii up to the rim.

Since -z (S0 - S1) <= C z^c (1 + 2.1/z^2) for every k, the load nowhere lies below a parabola in X = z^((3+k)/2),

    load >= X [ b X/(3+k) - 1 - C g (1 + 2.1/z^2) ]

So the search starts at the parabola's lowest point and goes outwards, arch by arch, until the parabola is higher than
the best trough found: two or three troughs of a thousand are ever looked at.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.cosine import Cosine, load, wave
from gradhesion.core.curve.cosine_folds import fold_of_arch, survey_arch
from gradhesion.core.struve.arches import inner_edge
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Table

PHASELESS: Final = 1e12
"""z from which on the parabola itself is the answer, to 1e-12: a float tells its phase no longer well."""
_WORTH: Final = 1.0 + 4.0 * 2.0**-52
"""A trough that is not deeper by this factor is none: two floats cannot tell them apart."""


@kernel(contract=True)
def _floor(b: float, chi: float, k: float, abscissa: float, z: float) -> float:
    """Return the parabola below the load."""
    return abscissa * (b * abscissa / (3.0 + k) - 1.0 - chi * (1.0 + 2.1 / (z * z)))


@kernel()
def _trough(table: Table, curve: Cosine, i: int) -> float:
    """Return x of the local minimum of the load on arch i, 0 where there is none."""
    level = 0.5 * (3.0 + table.k)
    survey = survey_arch(table, curve, level, i)
    if survey[0] <= 0:
        return 0.0
    x, _ = fold_of_arch(table, curve, level, i, survey, YES, 0.0)
    return x


@kernel(contract=True)
def load_at_rim(table: Table, curve: Cosine, x: float, x_low: float) -> float:
    """Return the load at x + x_low, where x_low is the rounding error of x."""
    b, g, lag = curve
    z, power, s0, s1, v, _, _ = wave(table, lag, x)
    front = z / (power * power)
    value = front * (b * z / (3.0 + table.k) + g * (s0 - s1) - power)
    slope = front / z * (b * z + g * v - 0.5 * (3.0 + table.k) * power)
    return value + slope * (TWO_PI * x_low)


@kernel()
def _better(
    table: Table, curve: Cosine, i: int, x_rim: float, best: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Return the lowest load so far, its place, and the second lowest, arch i taken in."""
    x = _trough(table, curve, i)
    lowest, place, second = best
    if 0.0 < x < x_rim:
        value = load(table, curve, x)
        if value < lowest:
            return value, x, lowest
        return lowest, place, min(second, value)
    return best


@kernel()
def lowest_load(table: Table, curve: Cosine, x_rim: float, x_rim_low: float) -> tuple[float, float, float]:
    """Return the lowest reduced load over (0, x_rim], the x where it is met, and the second lowest trough (or 0)."""
    b, g, _ = curve
    k = table.k
    chi = g * table.amplitude
    lowest = 0.5 * (3.0 + k) * (1.0 + chi) / b  # X and z where the parabola is lowest
    z = lowest ** (2.0 / (3.0 + k))
    z_rim = TWO_PI * x_rim
    if min(z, z_rim) > PHASELESS:
        abscissa = lowest if z <= z_rim else z_rim / amplitude_power(table, z_rim)
        return _floor(b, chi, k, abscissa, z), z / TWO_PI if z < z_rim else x_rim, 0.0
    start = max(0, int((min(z, z_rim) - table.phase) / math.pi + 0.5))
    best = (0.0, 0.0, 0.0)
    if x_rim < math.inf:
        at_rim = load_at_rim(table, curve, x_rim, x_rim_low)
        if at_rim < 0.0:
            best = (at_rim, x_rim, 0.0)
    # an arch holds nothing lower than the parabola's lowest point over it: at the near edge, or between the edges
    i = start
    while True:
        x, abscissa, _ = inner_edge(table, i)
        if x >= x_rim or (i > start and _floor(b, chi, k, max(abscissa, lowest), TWO_PI * x) >= best[0] * _WORTH):
            break
        best = _better(table, curve, i, x_rim, best)
        i += 1
    i = start - 1
    while i >= 0:
        x, abscissa, _ = inner_edge(table, i + 1)
        if _floor(b, chi, k, min(abscissa, lowest), TWO_PI * x) >= best[0] * _WORTH:
            break
        best = _better(table, curve, i, x_rim, best)
        i -= 1
    return best
