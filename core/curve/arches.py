"""The folds of one cosine on a paraboloid under any control, arch by arch (cosine_folds.py), at a tenth of the cost.

With X = z^((3+k)/2) the folds stand where G(X) = b X + g Q(X) is equal to q, and G is concave or convex on an arch.
Under a load q is one number, and cosine_folds.py applies. A machine has a q that rises from (1-k)/2 to
(3+k)/2. Where an arch has the same number of folds for the q of its inner edge and for that of its outer edge, it has
as many for what lies between, one on each flank, if G has a margin over what q may rise by within the arch: on a flank
G is monotone, concave or convex, and steeper than its chord on one side of a fold, so that G - q goes through zero
once. Where that does not decide, the arch is cut into pieces on which G - q is monotone, or surely not zero.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, kernel
from gradhesion.core.curve.cosine import Cosine, slope, slopes
from gradhesion.core.curve.cosine_folds import CLOSE, fold_of_arch, survey_arch
from gradhesion.core.curve.general import Basis, Series, level_at
from gradhesion.core.curve.general import slope as general_slope
from gradhesion.core.curve.general_folds import Search, Zeros, find_folds, refine
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.arches import inner_edge, summit
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Harmonics, Table

_PIECES: Final = 64
_NARROW: Final = 1e-6
"""Piece over its place below which its folds can hardly be separated."""
_STEPS: Final = 100
_LAST_STEP: Final = 1e-4
"""A cubically convergent step of this size, over the length on which the slope changes, leaves 1e-12 of that."""
_MOST: Final = 64
"""Folds of an arch that there is room for."""


@kernel()
def is_one_cosine(series: Harmonics, m: float) -> bool:
    """Return whether a profile is a paraboloid with a cosine of positive amplitude, its wavelength that of the unit."""
    return m == 2.0 and series.shape[0] == 1 and series[0, 0] == 1.0 and series[0, 1] > 0.0 and series[0, 2] == 0.0


@kernel()
def one_cosine(series: Harmonics, curve: Series) -> Cosine:
    """Return the same curve in the form of core/curve/cosine.py."""
    B, _, g, _, _ = curve
    return Cosine(2.0 * B, g * series[0, 1], 0.0)


@kernel()
def _level(table: Table, curve: Series, x: float) -> float:
    """Return q at x."""
    _, _, _, alpha, beta = curve
    if x == 0.0:
        return 0.5 * (1.0 - table.k)
    power = amplitude_power(table, TWO_PI * x)
    return level_at(table.k, alpha, beta / (power * power))


@kernel()
def _fastest(k: float, curve: Series, low: float, high: float) -> float:
    """Return a bound of dq/d(ln z) = (1+k)^2 alpha t/(alpha + t)^2 between two places: it is largest at t = alpha."""
    _, _, _, alpha, beta = curve
    inner, outer = beta * (TWO_PI * low) ** (1.0 + k), beta * (TWO_PI * high) ** (1.0 + k)
    t = min(max(alpha, inner), outer)
    return (1.0 + k) ** 2 * alpha * t / ((alpha + t) * (alpha + t))


@kernel()
def _line(table: Table, own: Cosine, x: float) -> tuple[float, float, float]:
    """Return X, G and dG/dX at x."""
    n = 0.5 * (1.0 + table.k)
    z = TWO_PI * x
    value, rate, _, _ = slope(table, own, 0.0, x)
    front = 1.0 / amplitude_power(table, z)
    return z * front, front * value, (n * value / z + rate) / (1.0 + n)


@kernel()
def _on_piece(table: Table, curve: Series, own: Cosine, concave: bool, low: float, high: float) -> int:
    """Return how often G - q goes through zero between two places of an arch: 1, 0, or -1 if that is not sure.

    It goes through it once where it is monotone and of different signs, and never where bounds say so.
    """
    k = table.k
    begin, first, first_rate = _line(table, own, low)
    end, last, last_rate = _line(table, own, high)
    least, most = _level(table, curve, low), _level(table, curve, high)
    steepest = _fastest(k, curve, low, high) / (0.5 * (3.0 + k) * begin)
    below, above = first < least, last < most
    rises = (last_rate if concave else first_rate) > steepest
    falls = (first_rate if concave else last_rate) < 0.0
    if rises or falls:
        return 1 if below != above else 0
    if below != above:
        return -1
    # a curve lies on one side of its chord, and on the other one of its tangents
    cross = (last - first + first_rate * begin - last_rate * end) / (first_rate - last_rate)
    bound = first + first_rate * (cross - begin)
    if below and (bound if concave else max(first, last)) < least:
        return 0
    if not below and (min(first, last) if concave else bound) > most:
        return 0
    return -1


@kernel()
def _on_pieces(
    basis: Basis, curve: Series, own: Cosine, i: int, low: float, high: float, work: Search, zeros: Zeros
) -> tuple[int, float]:
    """Put the folds on a part of arch i into `zeros`, piece by piece; return their number and the nearest miss."""
    table, _, _ = basis
    ends = np.empty(_PIECES)
    ends[0] = high
    top, count, tangency = 0, 0, math.inf
    while top >= 0:
        end = ends[top]
        found = _on_piece(table, curve, own, i % 2 == 0, low, end)
        if found < 0 and top + 1 < _PIECES and end - low > _NARROW * end:
            top += 1
            ends[top] = math.sqrt(low * end)
            continue
        if found < 0:
            found, _, place = find_folds(basis, curve, low, end, work, zeros[count:], 0.0)
            tangency = min(tangency, place)
            count += max(0, found)
        elif found == 1:
            value, _, _ = general_slope(basis, curve, low)
            zeros[count], _ = refine(basis, curve, 0.5 * (low + end), low, end, value < 0.0, 0.0)
            count += 1
        low = end
        top -= 1
    return count, tangency


@kernel()
def _continued(zeros: Zeros, count: int) -> float:
    """Return about where the fold after the `count` first ones stands, from every other one of these; 0 if unknown.

    Far out two folds a wave stand in nearly equal distances.
    """
    if count < 4:
        return 0.0
    last, step = zeros[count - 2], zeros[count - 2] - zeros[count - 4]
    if count < 6:
        return last + step
    return last + 2.0 * step - (zeros[count - 4] - zeros[count - 6])


@kernel(contract=True)
def _slopes_of_machine(table: Table, curve: Series, own: Cosine, x: float) -> tuple[float, float, float]:
    """Return D and its first two derivatives with respect to z at x > 0: those at a fixed q, and what q adds."""
    _, _, _, alpha, beta = curve
    k = table.k
    n = 0.5 * (1.0 + k)
    z = TWO_PI * x
    power = amplitude_power(table, z)
    t = beta / (power * power)
    share = t / (alpha + t)
    rate = (1.0 + k) * (1.0 + k) * share * (1.0 - share)  # dq/d(ln z)
    value, slope1, slope2, _, _ = slopes(table, own, 0.5 * (1.0 - k) + (1.0 + k) * share, x)
    fall = rate * power / z
    return value, slope1 - fall, slope2 + fall * (2.0 * n + 1.0 - (1.0 + k) * (1.0 - 2.0 * share)) / z


@kernel()
def _fold_of_machine(
    table: Table, curve: Series, own: Cosine, guess: float, low: float, high: float, rising: bool
) -> tuple[float, float]:
    """Do what `refine` of curve/general_folds.py does for one cosine by a machine (Halley, kept in the bracket)."""
    x = guess if low < guess < high else 0.5 * (low + high)
    rate = 0.0
    for _ in range(_STEPS):
        value, rate, bend = _slopes_of_machine(table, curve, own, x)
        if value == 0.0:
            break
        if (value < 0.0) == rising:
            low = x
        else:
            high = x
        step = -value * rate / (rate * rate - 0.5 * value * bend)
        small = abs(step) * (abs(bend) + abs(rate)) < _LAST_STEP * abs(rate) * min(1.0, TWO_PI * x)
        new = x + step / TWO_PI
        if small and low <= new <= high:
            return new, rate + step * bend
        if not low < new < high:
            new = 0.5 * (low + high)
            if new <= low or new >= high:
                break
        x = new
    return x, rate


@kernel()
def _on_arch_of_machine(
    basis: Basis, curve: Series, own: Cosine, i: int, first: float, zeros: Zeros, count: int
) -> tuple[int, float]:
    """Append the folds of an arch by a machine; return their number, -1 if that is not sure, and the nearest miss."""
    table, _, _ = basis
    k = table.k
    b, g, _ = own
    n = 0.5 * (1.0 + k)
    low, low_abscissa, low_height = inner_edge(table, i)
    high, high_abscissa, high_height = inner_edge(table, i + 1)
    if first > low:
        low = first
        low_abscissa = TWO_PI * first / amplitude_power(table, TWO_PI * first)
    least, most = _level(table, curve, low), _level(table, curve, high)
    one, other = survey_arch(table, own, least, i), survey_arch(table, own, most, i)
    kind = one[0]
    if kind != other[0]:
        return -1, math.inf
    if kind == 0:
        return 0, min(one[2], other[2])
    steepest = _fastest(k, curve, low, high) / ((1.0 + n) * low_abscissa)
    margin = steepest * (high_abscissa - low_abscissa)
    concave = i % 2 == 0
    peak, peak_abscissa, peak_height = summit(table, i)
    if kind == 2 and one[2] != peak:  # too flat for the summit to decide
        return -1, math.inf
    if kind == 2 and other[2] != peak:
        return -1, math.inf
    at_peak = b * peak_abscissa + g * peak_height
    clear = at_peak - most if concave else least - at_peak
    if kind == -1:
        clear = at_peak - (b * low_abscissa + g * low_height)
        if not concave:
            clear = (b * high_abscissa + g * high_height) - at_peak
    if not clear > margin:
        return -1, math.inf
    rising = kind == 1 or (kind == 2 and concave)
    for j in range(abs(kind)):
        begin, end = low, high
        if kind == 2:
            begin, end = (low, peak) if j == 0 else (peak, high)
        guess = _continued(zeros, count + j)
        if not begin < guess < end:
            survey = one if concave else other
            guess, _ = fold_of_arch(table, own, 0.5 * (least + most), i, survey, rising, 0.0)
        x, rate = _fold_of_machine(table, curve, own, guess, begin, end, rising)
        if rising and not rate > (1.0 + n) * steepest:
            return -1, math.inf
        zeros[count + j] = x
        rising = not rising
    return abs(kind), math.inf


@kernel()
def folds_by_arches(
    basis: Basis, curve: Series, first: float, last: float, work: Search, zeros: Zeros
) -> tuple[int, bool, float]:
    """Do what `find_folds` (curve/general_folds.py) does for one cosine on a paraboloid."""
    table, _, series = basis
    _, _, _, alpha, beta = curve
    own = one_cosine(series, curve)
    constant = alpha == 0.0 or beta == 0.0
    level = _level(table, curve, 0.0) if beta == 0.0 else 0.5 * (3.0 + table.k)
    if level == 0.0 or (table.k == 1.0 and not constant):  # the coordinate may rise from zero contact on
        return find_folds(basis, curve, first, last, work, zeros, 0.0)
    count, tangency = NONE, math.inf
    i = max(0, int(2.0 * first - table.phase / math.pi - 0.5))
    edge, _, _ = inner_edge(table, i)
    while edge < last:
        high, _, _ = inner_edge(table, i + 1)
        if count + _MOST > zeros.size:
            return -1, NO, tangency
        begin, found = count, 0
        if constant:
            survey = survey_arch(table, own, level, i)
            kind, place, missing, _ = survey
            if kind == 0 and missing <= CLOSE:
                tangency = min(tangency, place)
            rising = kind == 1 or (kind == 2 and i % 2 == 0)
            found = abs(kind)
            for j in range(found):
                guess = _continued(zeros, count + j)
                zeros[count + j], _ = fold_of_arch(table, own, level, i, survey, rising, guess)
                rising = not rising
        else:
            found, miss = _on_arch_of_machine(basis, curve, own, i, first, zeros, count)
            if miss <= CLOSE:
                tangency = min(tangency, edge)
        if found < 0:
            found, place = _on_pieces(basis, curve, own, i, max(first, edge), min(high, last), work, zeros[count:])
            tangency = min(tangency, place)
        for j in range(found):
            if zeros[begin + j] < last:
                zeros[count] = zeros[begin + j]
                count += 1
        edge = high
        i += 1
    return count, NO, tangency


@kernel()
def folds_between(
    basis: Basis, curve: Series, first: float, last: float, work: Search, zeros: Zeros
) -> tuple[int, bool, float]:
    """Do what `find_folds` (curve/general_folds.py) does, by arches where that is known to miss none."""
    _, _, series = basis
    _, m, _, _, _ = curve
    if is_one_cosine(series, m):
        return folds_by_arches(basis, curve, first, last, work, zeros)
    return find_folds(basis, curve, first, last, work, zeros, 0.0)
