"""The pull-off force: the lowest load over all contact radii up to the rim.

Since -z (S0 - S1) <= C z^c (1 + 2.1/z^2) for every k, the load nowhere lies below a parabola in X = z^((3+k)/2),

    load >= X [ b X/(3+k) - 1 - C g (1 + 2.1/z^2) ]

So the search starts at the parabola's lowest point and goes outwards, arch by arch, until the parabola is higher than
the best trough found: only two or three troughs of a thousand are computed. Beyond some 10^7 waves the lowest trough
is one of a few about that point, or before the rim, to all digits of its load; there places are whole waves and a part,
which alone has a phase.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.cosine import Cosine, load, wave
from gradhesion.core.curve.cosine_folds import fold_of_arch, survey_arch
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.pull_off.lowest_two import Lowest, lower
from gradhesion.core.struve.arches import inner_edge
from gradhesion.core.struve.pair import pair_above
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Table

FURTHEST: Final = 2.0**25
"""Waves from which on a double does not resolve the phase of a place well enough."""
_ABOUT: Final = 4.0
"""Waves on either side that are searched there: beyond, troughs are higher by the square of that part of all waves."""
_STEPS: Final = 60
_SURE: Final = 1e-9
"""Newton's step, in waves, whose square is lost in rounding."""
_WORTH: Final = 1.0 + 4.0 * 2.0**-52
"""A trough that is not deeper by this factor is none: doubles do not resolve it."""


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
def _better(table: Table, curve: Cosine, i: int, x_rim: float, best: Lowest) -> Lowest:
    """Return the lowest load so far, its place, and the second lowest, arch i taken in."""
    x = _trough(table, curve, i)
    return lower(best, load(table, curve, x), x) if 0.0 < x < x_rim else best


@kernel(contract=True)
def _load_far(table: Table, curve: Cosine, whole: float, x: float) -> tuple[float, float, float]:
    """Return the load at whole + x, z > 40, with D of its level and dD/dz."""
    b, g, _ = curve
    k = table.k
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    s0, s1, d0, _ = pair_above(table, x, z, power)
    pull = 0.5 * (3.0 + k) * power
    value = z / (power * power) * (b * z / (3.0 + k) + g * (s0 - s1) - power)
    return value, b * z + g * (s0 + z * d0) - pull, b + g * (2.0 * d0 + z * (s1 - s0)) + 0.5 * (1.0 + k) * pull / z


@kernel()
def _trough_far(table: Table, curve: Cosine, whole: float, low: float, high: float) -> tuple[float, float]:
    """Return the load of the trough between two places, beyond `whole` waves, and its place; 0 if there is none."""
    x = 0.5 * (low + high)
    if not (_load_far(table, curve, whole, low)[1] < 0.0 < _load_far(table, curve, whole, high)[1]):
        return 0.0, x
    for _ in range(_STEPS):
        value, d, rate = _load_far(table, curve, whole, x)
        step = -d / (TWO_PI * rate)
        if abs(step) < _SURE:
            return value, x
        if d < 0.0:
            low = x
        else:
            high = x
        x = x + step if low < x + step < high else 0.5 * (low + high)
    return _load_far(table, curve, whole, x)[0], x


@kernel()
def _lowest_about(table: Table, curve: Cosine, start: float, x_rim: float, x_rim_low: float) -> Lowest:
    """Do what `lowest_load` does beyond `FURTHEST` waves, where the parabola is lowest at `start`, the rim at most."""
    whole = np.floor(start) - _ABOUT
    rim = (x_rim - whole) + x_rim_low
    end = min(rim, 2.0 * _ABOUT)
    best = (0.0, 0.0, 0.0)
    if rim == end:
        best = lower(best, _load_far(table, curve, whole, rim)[0], x_rim)
    centre = table.phase / TWO_PI + 1.0  # where D is largest; before it the load has its trough
    while centre - 0.5 < end:
        value, x = _trough_far(table, curve, whole, centre - 0.5, min(centre, end))
        best = lower(best, value, whole + x)
        centre += 1.0
    return best


@kernel()
def lowest_load(table: Table, curve: Cosine, x_rim: float, x_rim_low: float) -> Lowest:
    """Return the lowest reduced load over (0, x_rim], its x, and the second lowest trough (or 0)."""
    b, g, _ = curve
    k = table.k
    chi = g * table.amplitude
    lowest = 0.5 * (3.0 + k) * (1.0 + chi) / b  # X and z where the parabola is lowest
    z = lowest ** (2.0 / (3.0 + k))
    z_rim = TWO_PI * x_rim
    if min(z, z_rim) > TWO_PI * FURTHEST:
        best = _lowest_about(table, curve, min(z / TWO_PI, x_rim), x_rim, x_rim_low)
        # so few waves fold only where they are lost in rounding
        return best if best[0] < 0.0 else (_floor(b, chi, k, lowest, z), z / TWO_PI, 0.0)
    start = max(0, int((min(z, z_rim) - table.phase) / math.pi + 0.5))
    best = (0.0, 0.0, 0.0)
    if x_rim < math.inf:
        at_rim = load_at_rim(table, curve, x_rim, x_rim_low)
        if at_rim < 0.0:
            best = (at_rim, x_rim, 0.0)
    # on an arch nothing is lower than the parabola's lowest point over it: at the near edge, or between the edges
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
