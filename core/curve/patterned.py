"""A punch on an interface whose toughness varies with the radius: any profile under any control.

In the units of curve/general.py the edge pulls with kappa(z) times the toughness, so that

    depth(z) = B z^m + g z w0 - kappa z^c,     load(z) = z^(1+k) [B z^m m/(1+k+m) + g z w1 - kappa z^c]
    D = m B z^(m-1) + g v - (q kappa + z kappa') z^(-n)

(docs/theory.md): the curve of a series whose waves are g w0 + (1 - kappa) z^(-n) and so on. Its `gain` is 1, and g
stands with the pattern. The unit of length is the wavelength of the profile, or that of the pattern if there is none.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve import general
from gradhesion.core.curve.general import Basis, Made, Patterned, curve_of
from gradhesion.core.curve.general_folds import WAVES, Zeros, cell_width, find_folds, room
from gradhesion.core.curve.window import wave_bounds
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.problem.curves import PatternedCurves, is_in_range
from gradhesion.core.types import Floats, Harmonics

MOST_CELLS: Final = 4_000_000
"""Cells of a search for folds: some seconds."""
_TOGETHER: Final = 250_000
"""Cells of one call."""
_INNERMOST: Final = 1e-30
"""z where a search for folds begins if the coordinate need not fall there."""
_WITHOUT_ADHESION: Final = 1e-60
"""And the least z where it may, if waves outweigh adhesion further out: a tip with a slope, and next to no adhesion."""
_NOISE: Final = 1e-13
"""kappa at zero contact below which D there is no more than rounding, and what it must be where a search begins."""
_OUTERMOST: Final = 1e100
_CLOSE: Final = 1.02
_STEPS: Final = 200
_ELLIPSE: Final = 6.0
"""Sum of the half axes of the ellipse around a cell of half width 1 in which a root of t is smooth: 6^-17 is left."""


class Pattern(NamedTuple):
    """What stands in the second place of the basis of such a curve; the third has one row (n, 0, 0).

    That n is the number of the shortest wave that matters in a unit length: nothing is finer than a wave of it.
    """

    cosine_bins: Any  # what belongs to the harmonics of the profile, harmonics/series.py
    waves: Harmonics  # the harmonics of the profile
    gain: float  # g
    rows: Harmonics  # t - 1 as rows (waves a unit length, cos, sin)
    of_work: bool  # whether kappa is the root of t
    least: float  # a bound below t
    most: float  # a bound over kappa
    steepest: float  # a bound of dkappa/dz


@kernel(contract=True)
def toughness_at(basis: Basis, x: float) -> tuple[float, float, float]:
    """Return kappa and its first two derivatives by z at x."""
    pattern = basis.cosine_bins
    rows = pattern.rows
    value, rate, bend = 1.0, 0.0, 0.0
    for i in range(rows.shape[0]):
        n = rows[i, 0]
        turns = n * x
        sine, cosine = sine_cosine_of_turns(turns)
        shift = TWO_PI * fma(n, x, -turns)
        sine, cosine = sine + shift * cosine, cosine - shift * sine
        wave = rows[i, 1] * cosine + rows[i, 2] * sine
        value += wave
        rate += n * (rows[i, 2] * cosine - rows[i, 1] * sine)
        bend -= n * n * wave
    if not pattern.of_work:
        return value, rate, bend
    root = math.sqrt(max(value, pattern.least))
    half = 0.5 / root
    return root, half * rate, half * (bend - 2.0 * (half * rate) ** 2)


@kernel()
def smooth_part(rows: Harmonics, least: float) -> float:
    """Return how far from the real axis, in units of 1/z, t has no zero: where its waves grow by no more than `least`.

    Re t(z + iy) = t(z) + sum h_n cos(n z - phi_n) (cosh n y - 1).
    """
    highest = max(1e-300, highest_harmonic(rows))
    low, high = 0.0, 700.0 / highest
    for _ in range(_STEPS):
        middle = 0.5 * (low + high)
        if not low < middle < high * (1.0 - 1e-3):
            break
        grown = 0.0
        for i in range(rows.shape[0]):
            grown += math.hypot(rows[i, 1], rows[i, 2]) * (math.cosh(rows[i, 0] * middle) - 1.0)
        if grown < least:
            low = middle
        else:
            high = middle
    return low


@kernel()
def pattern_of(
    cosine_bins: Any, waves: Harmonics, gain: float, pattern: Harmonics, of_work: bool, least: float
) -> tuple[Pattern, Harmonics]:
    """Return the second and the third place of a basis; `pattern` is t - 1 as rows (waves a unit length, cos, sin)."""
    total, slope, bend = 0.0, 0.0, 0.0
    for i in range(pattern.shape[0]):
        n, size = pattern[i, 0], math.hypot(pattern[i, 1], pattern[i, 2])
        total, slope, bend = total + size, slope + n * size, bend + n * n * size
    shortest = max(highest_harmonic(waves), highest_harmonic(pattern))
    most, steepest = 1.0 + total, slope
    if of_work:
        most = math.sqrt(most)
        steepest = 0.5 * slope / math.sqrt(least)
        # a cell between waves of that length is within the ellipse
        shortest = max(shortest, WAVES * TWO_PI * (_ELLIPSE - 1.0 / _ELLIPSE) / (4.0 * smooth_part(pattern, least)))
    rows = np.zeros((1, 3))
    rows[0, 0] = shortest
    return Pattern(cosine_bins, waves, gain, pattern, of_work, least, most, steepest), rows


@general.curve_at.answers(PatternedCurves)
@kernel()
def curve_at(basis: Basis, curves: PatternedCurves, i: int) -> Made:
    """Return it with its pattern."""
    table, cosine_bins, series = basis
    _, exponent, depth_factor, stretch, wavelength, amplitude, compliance, _, patterns = curves
    wavy = amplitude[i] > 0.0 and series.shape[0] > 0
    unit = wavelength[i] if wavy else patterns.wavelength[i]
    rows = patterns.rows.copy()
    for j in range(rows.shape[0]):
        rows[j, 0] *= unit / patterns.wavelength[i]
        rows[j, 1] *= patterns.amplitude[i]
        rows[j, 2] *= patterns.amplitude[i]
    valid = is_in_range(stretch[i], wavelength[i], amplitude[i]) and compliance[i] >= 0.0
    valid = valid and 0.0 < patterns.wavelength[i] < math.inf and abs(patterns.amplitude[i]) < math.inf
    one, length, depth = curve_of(
        table.k, exponent, depth_factor, stretch[i], unit, amplitude[i] if wavy else 0.0, compliance[i]
    )
    valid = valid and 0.0 < one.bend < math.inf and one.gain < math.inf and highest_harmonic(rows) < math.inf
    least = patterns.least[i] if valid else 1.0
    waves = series[: series.shape[0] if wavy else 0]
    pattern, finest = pattern_of(cosine_bins, waves, one.gain, rows, patterns.of_work, least)
    curve = Patterned(one.bend, exponent, 1.0, one.alpha, one.beta)
    return Made(valid, pattern, finest, curve, unit, length, depth)


@general.rims_of.answers(PatternedCurves)
@kernel()
def rims_of(curves: PatternedCurves, i: int) -> Floats:
    """Return them with NaN beyond where the pattern has a wrong sign."""
    rims = curves.rims[i if curves.rims.shape[0] > 1 else 0].copy()
    for rim in range(rims.size):
        if rims[rim] > curves.patterns.limit[i]:
            rims[rim] = math.nan
    return rims


@kernel()
def _surely_falls(basis: Basis, curve: Patterned, level: float, start: float, z: float) -> bool:
    """Return whether D < 0 up to z, kappa being `start` at zero contact: by the slope of kappa."""
    table, pattern, _ = basis
    n = 0.5 * (1.0 + table.k)
    _, _, near, near_slope = wave_bounds(table, pattern.waves, pattern.gain)
    pull = level * start - (level + 1.0) * pattern.steepest * z
    return pull > curve.exponent * curve.bend * z ** (curve.exponent - 1.0 + n) + z**n * (near + near_slope * z)


@kernel()
def window(basis: Basis, curve: Patterned) -> tuple[float, float]:
    """Return x before which the coordinate surely falls, or one below all others, and x beyond which it surely rises.

    The second is inf where folds need not end.
    """
    table, pattern, _ = basis
    B, m, _, alpha, beta = curve
    k = table.k
    start, _, _ = toughness_at(basis, 0.0)
    s, push = m - 1.0 + 0.5 * (1.0 + k), m * B
    innermost = max(_INNERMOST, (_NOISE / push) ** (1.0 / s)) if start < _NOISE else _INNERMOST
    low, level = 1.0, 0.5 * (1.0 - k) if alpha > 0.0 else 0.5 * (3.0 + k)
    least = innermost if start < _NOISE else _WITHOUT_ADHESION
    while low > least and not _surely_falls(basis, curve, level, start, low):
        low *= 0.25
    first = (low if low > least else innermost) / TWO_PI
    level = (0.5 * (1.0 - k) if beta == 0.0 else 0.5 * (3.0 + k)) * pattern.most
    far, correction, _, _ = wave_bounds(table, pattern.waves, pattern.gain)
    far += pattern.steepest
    inner = _INNERMOST
    if far > 0.0:
        if s < 1.0 or (s == 1.0 and push <= far):
            return first, math.inf
        if s > 1.0:
            inner = max(inner, math.exp(min(200.0, math.log(far / push) / (s - 1.0))))
    high = 2.0 * inner
    while not push * high**s > level + far * high + correction / high:
        inner, high = high, 2.0 * high
        if high > _OUTERMOST:
            return first, math.inf
    while high > _CLOSE * inner:
        middle = math.sqrt(inner * high)
        if push * middle**s > level + far * middle + correction / middle:
            high = middle
        else:
            inner = middle
    return first, high / TWO_PI


@kernel()
def are_too_many(basis: Basis, first: float, last: float) -> bool:
    """Return whether there are too many cells to search between two places."""
    return not highest_harmonic(basis.series) * (last - first) < WAVES * MOST_CELLS


@kernel()
def folds_up_to(basis: Basis, curve: Patterned, first: float, last: float, zeros: Zeros) -> tuple[int, bool, float]:
    """Do what `find_folds` (curve/general_folds.py) does, in parts: a root of t has many cells a wave."""
    count, rises, tangency, begin = 0, False, math.inf, first
    work = room()
    while begin < last:
        end = min(last, begin + _TOGETHER * cell_width(basis.series, begin) if begin >= 1.0 else 1.0)
        found, up, place = find_folds(basis, curve, begin, end, work, zeros[count:], 0.0)
        rises, tangency = up if begin == first else rises, min(tangency, place)
        if found < 0:
            return -1, rises, tangency
        count, begin = count + found, end
    return count, rises, tangency
