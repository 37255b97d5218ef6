"""The leading form of short waves, lambda << a: the curve of any profile with its waves reduced to zeta.

In the units of curve/general.py, with S(z) for C times (5.17) of Jin, Guo & Wan (2013), (5.15) and (5.16) become

    depth(z) = B z^m + g mean - z^c [1 - g S(z)]
    load(z)  = z^(1+k) { B z^m m/(1+k+m) - z^c [1 - g S(z)] }
    S(z)     = C sum n^c [cos_n sin(n z - phi) + sin_n cos(n z - phi)],     mean = sum cos_n,   phi = (1+k) pi/4

One cosine is a series of one. The term g mean is the mean height of the waves, which the printed form drops; the load
has none to this order. The error is of the order lambda/a; the form is not valid where the contact is no larger than a
wave: there depth tends to g mean, not to 0. At k = 1 the depth is exact.

Depth and load have slopes of their own: d load/dz is not z^(1+k) d depth_H/dz, as of every exact curve, but off by
(1+k) z^((1+k)/2) g S, of the order lambda/a. So they belong to no one energy, and depth alone is prescribed here. With
the level q, (1-k)/2 of the depth and (3+k)/2 of the load, the folds of both are where

    z^n D = m B z^(m-c) + g (q S + z S') - q = 0                    n = (1+k)/2
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.general import Basis, Series, level_at, slope
from gradhesion.core.curve.general_folds import Zeros
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Harmonics, Table

MOST_WAVES: Final = 2.0**17
"""Most of the shortest waves that are walked: with more there is no energy; it is that of the envelopes to 1e-5."""
SMALLEST: Final = 1e-100
"""Places from which on, and up to one over which, powers are tabulated with room to spare."""
_INNERMOST: Final = 1e-9
"""z where a search for folds begins that may stand anywhere (k = 1)."""
_OUTERMOST: Final = 1e250
_NARROW: Final = 1e-7
"""Least step in shortest waves: where F and its slope are zero to rounding."""
_MOST_PLACES: Final = 64 * 2**17
"""Most places at which F is evaluated: some ten a wave."""
_SURE: Final = 1e-8
_STEPS: Final = 100
_CLOSE: Final = 0.02
"""Of a bound, by which it may be too wide: a longer search costs less than powers."""


Sizes: TypeAlias = tuple[float, float, float, float]
"""What `sizes_of` returns."""


class ShortWave(Series):
    """The leading form of short waves, of the depth (alpha 1, beta 0) or of the load (0, 1)."""

    __slots__ = ()


@kernel()
def waves_of(table: Table, series: Harmonics) -> tuple[float, Harmonics]:
    """Return what comes after the table of the exponent in the basis of the curve: the mean height over g, and S.

    S has a row (n, sine, cosine) for each row (n, cos, sin) of the series.
    """
    rows, mean = np.empty((series.shape[0], 3)), 0.0
    for i in range(series.shape[0]):
        n, even, odd = series[i, 0], series[i, 1], series[i, 2]
        size = n ** (0.5 * (1.0 - table.k))
        rows[i, 0] = n
        rows[i, 1] = size * (even * table.cos_phase + odd * table.sin_phase)
        rows[i, 2] = size * (odd * table.cos_phase - even * table.sin_phase)
        mean += even
    return mean, rows


@kernel()
def _reached(push: float, power: float, rate: float, target: float) -> tuple[float, float]:
    """Return places, close to one another, before and behind which push z^power + rate z reaches a target > 0."""
    low, high = 0.0, 1.0
    while push * high**power + rate * high < target and high < _OUTERMOST:
        low, high = high, 2.0 * high
    while high - low > _CLOSE * high and high > 1.0 / _OUTERMOST:
        middle = 0.5 * (low + high)
        if push * middle**power + rate * middle < target:
            low = middle
        else:
            high = middle
    return low, high


@kernel()
def sizes_of(basis: Basis, curve: ShortWave) -> Sizes:
    """Return bounds of g times S and its first three derivatives: the sums of the sizes of all waves."""
    height, steepness, bend, third = 0.0, 0.0, 0.0, 0.0
    rows = basis.series
    for i in range(rows.shape[0]):
        n, size = rows[i, 0], curve.gain * math.hypot(rows[i, 1], rows[i, 2])
        height += size
        steepness += n * size
        bend += n * n * size
        third += n * n * n * size
    return height, steepness, bend, third


@kernel()
def window(basis: Basis, curve: ShortWave, sizes: Sizes) -> tuple[float, float]:
    """Return x before which the coordinate has no fold, and x beyond which it has none, inf if they need not end."""
    table, _, rows = basis
    B, m, g, alpha, beta = curve
    q = level_at(table.k, alpha, beta)
    height, steepness, _, _ = sizes
    start = q  # minus F at zero contact, from which its waves differ by (1 + q) z times the bound of the slope of S
    for i in range(rows.shape[0]):
        start -= q * g * rows[i, 2]
    push, power = m * B, m - 0.5 * (1.0 - table.k)
    low = 0.0
    if start != 0.0:
        low, _ = _reached(push, power, (1.0 + q) * steepness, abs(start))
    if height < 1.0 and q > 0.0:
        low = max(low, _reached(push, power, steepness, q * (1.0 - height))[0])
    low = low if low > 0.0 else _INNERMOST
    if steepness > 0.0 and (power < 1.0 or (power == 1.0 and push <= steepness)):
        return low / TWO_PI, math.inf
    _, high = _reached(push, power, -steepness, q * (1.0 + height))
    return low / TWO_PI, high / TWO_PI


@kernel(contract=True)
def _fold_function(basis: Basis, curve: ShortWave, sizes: Sizes, x: float) -> tuple[float, float, float, float]:
    """Return F = z^n D, dF/dz, a bound of its second derivative up to a place further out, and how far that is."""
    table, _, _ = basis
    B, m, _, alpha, beta = curve
    z, n = TWO_PI * x, 0.5 * (1.0 + table.k)
    value, rate, _ = slope(basis, curve, x)
    front, inverse = 1.0 / amplitude_power(table, z), 1.0 / z
    power = m - 1.0 + n
    push = m * B * front * (z if m == 2.0 else z ** (m - 1.0))
    bow, reach = power * abs(power - 1.0) * push * inverse * inverse, z / power
    if power > 2.0:
        bow *= math.e  # (1 + 1/p)^(p-2) is less
    _, _, bend, third = sizes
    bow += (level_at(table.k, alpha, beta) + 2.0) * bend + (z + reach) * third
    return front * value, front * (rate + n * inverse * value), bow, reach


@kernel()
def _refine(basis: Basis, curve: ShortWave, sizes: Sizes, low: float, high: float, share: float, rising: bool) -> float:
    """Return where F, monotone between two places, goes through zero: about at a share of the way (Newton's method)."""
    x = low + (high - low) * share
    enough = _SURE * (high - low)
    for _ in range(_STEPS):
        value, rate, _, _ = _fold_function(basis, curve, sizes, x)
        if (value < 0.0) == rising:
            low = x
        else:
            high = x
        new = x - value / (TWO_PI * rate)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        if abs(new - x) <= enough:  # what is left is its square
            return new
        x = new
    return x


@kernel()
def folds_between(
    basis: Basis, curve: ShortWave, sizes: Sizes, first: float, last: float, zeros: Zeros
) -> tuple[int, bool]:
    """Put all folds between two places into `zeros`, in order; return their number and whether F >= 0 at the first.

    From a place on, F keeps its sign as far as its slope and the bound of its curvature say, and is monotone as far as
    its slope outweighs that. Of two folds closer than `_NARROW` of a wave none may be found.
    """
    count, x = 0, first
    value, rate, bow, reach = _fold_function(basis, curve, sizes, x)
    rises = value >= 0.0
    shortest = 1.0 / max(1.0, highest_harmonic(basis.series))
    for _ in range(_MOST_PLACES):
        if not x < last or count == zeros.size:
            break
        outwards = rate if value >= 0.0 else -rate
        root = math.sqrt(outwards * outwards + 2.0 * bow * abs(value))
        free = (root + outwards) / bow if outwards > 0.0 else 2.0 * abs(value) / (root - outwards)
        step = min(max(free, abs(rate) / bow), reach) / TWO_PI
        beyond = min(x + max(step, _NARROW * min(x, shortest)), last)
        there, rate, bow, reach = _fold_function(basis, curve, sizes, beyond)
        if (there < 0.0) != (value < 0.0):
            zeros[count] = _refine(basis, curve, sizes, x, beyond, value / (value - there), value < 0.0)
            count += 1
        x, value = beyond, there
    return count, rises


@kernel()
def folds_within(basis: Basis, curve: ShortWave, furthest: float) -> tuple[int, bool, Zeros]:
    """Return all folds up to a place, their number first: -1 if too many waves stand there to be walked.

    The second is whether the coordinate rises at zero contact.
    """
    sizes = sizes_of(basis, curve)
    first, last = window(basis, curve, sizes)
    last = min(last, furthest)
    first = min(first, last)
    waves = highest_harmonic(basis.series) * (last - first)
    if not (first > SMALLEST and waves < MOST_WAVES):
        return -1, NO, np.empty(0)
    zeros = np.empty(64 + 8 * int(waves))
    count, rises = folds_between(basis, curve, sizes, first, last, zeros)
    return count, rises, zeros
