"""The pull-off force of any profile: the lowest load over all contact radii up to the rim.

The waves of the load, z w1, are for every k within z^c times

    C sum h_n n^c (1 + 2.1/(n z)^2)   and   max(-wave of their leading term) + 2.53 C sum h_n n^(c-1)/z

and, for z small, within sum h_n n z T0(0)/(2+k). So the load lies nowhere below

    X [ B m/(1+k+m) z^(m-c) - 1 - chi(z) ],   X = z^((3+k)/2)

with a chi that falls as z grows. The search starts where this is lowest and goes outwards cell by cell on both sides,
skipping cells that cannot contain anything lower than the best trough found. The bound is too low by some parts in a
hundred, which may be many waves: of those the lowest is found by bisection (waves/lowest.py). Beyond ~10^7 waves the
lowest trough is next to where the bound of the leading term is lowest, or next to the rim, to all digits of its load.

Places are whole waves and a part (harmonics/series.py) from some 10^7 of the shortest waves on: one double of a place x
is off by up to e = x eps/2, and its load by (2 pi n e)^2/2 of a wave of harmonic n, 4e-14 of the 24th at 3e7 waves.
"""

import math
from typing import Any, Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.arches import is_one_cosine, one_cosine
from gradhesion.core.curve.cells import MOST
from gradhesion.core.curve.general import Basis, Series, coordinate, slope, state
from gradhesion.core.curve.general_folds import MOST_CELLS, Search, cell_width, folds_of_cell
from gradhesion.core.harmonics.cosine_bins import integral_at_zero
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.pull_off import cosine as pull_off
from gradhesion.core.pull_off.lowest_two import Lowest, lower
from gradhesion.core.types import Floats, Harmonics, Table
from gradhesion.core.waves.general import NEAREST, cut_of, falls_at_cut, room_for_waves
from gradhesion.core.waves.lowest import lowest_of_waves

Terms: TypeAlias = tuple[float, float, float, float, float]
"""The result of `chi_terms`."""
_EXCESS: Final = 2.1
_REMAINDER: Final = 2.53
WORTH: Final = 1.0 + 4.0 * 2.0**-52
_SAMPLES: Final = 16
"""Samples for each wave of the shortest harmonic."""
_HALVINGS: Final = 60
_ROUNDING: Final = 1e-14
_BLOCK: Final = 0.9
INWARDS: Final = 0.3
"""Longest cell over the distance of its outer end from zero contact."""
_CENTRE: Final = 1e-100
"""x that is zero contact."""
_FAR: Final = 64.0
"""Waves from which on there may be many in question."""
_ABOUT: Final = 8.0
"""Waves on either side of where the floor is lowest. Beyond, troughs are higher by the square of their part in all."""
_MANY: Final = 32.0
"""Waves in question of which the lowest is searched for by their number."""


@kernel()
def _wave_of_load(table: Table, series: Harmonics, u: float) -> tuple[float, float]:
    """Return sum n^c [-cos_n sin(n z - phi) - sin_n cos(n z - phi)] at z = 2 pi u, and its slope."""
    c = 0.5 * (1.0 - table.k)
    value, rate = 0.0, 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        sine, cosine = sine_cosine_of_turns(n * u)
        s = (sine * table.cos_phase - cosine * table.sin_phase) / table.amplitude
        t = (cosine * table.cos_phase + sine * table.sin_phase) / table.amplitude
        value -= n**c * (series[i, 1] * s + series[i, 2] * t)
        rate -= n ** (c + 1.0) * (series[i, 1] * t - series[i, 2] * s)
    return value, rate


@kernel()
def deepest_wave(table: Table, series: Harmonics) -> float:
    """Return the highest crest of -z^(1-c) w1/C's leading term."""
    samples = int(_SAMPLES * highest_harmonic(series))
    values = np.empty(samples)
    deepest, bends = 0.0, 0.0
    for j in range(samples):
        values[j], _ = _wave_of_load(table, series, j / samples)
        deepest = max(deepest, values[j])
    for i in range(series.shape[0]):
        bends += math.hypot(series[i, 1], series[i, 2]) * series[i, 0] ** (2.5 - 0.5 * table.k)
    # a crest is higher than its sample by this at most
    highest = deepest - 0.5 * (math.pi / max(1, samples)) ** 2 * bends
    for j in range(samples):
        if values[j] >= max(highest, values[j - 1], values[(j + 1) % samples]):
            low, high = (j - 1.0) / samples, (j + 1.0) / samples
            for _ in range(_HALVINGS):
                middle = 0.5 * (low + high)
                value, rate = _wave_of_load(table, series, middle)
                deepest = max(deepest, value)
                if rate > 0.0:
                    low = middle
                else:
                    high = middle
    return deepest * (1.0 + _ROUNDING)


@kernel()
def chi_terms(table: Table, series: Harmonics, gain: float, deepest: float) -> Terms:
    """Return the terms of the bounds: h n^c, h n^(c-2), the deepest wave, h n^(c-1), and that of small z.

    `deepest` is what `deepest_wave` returns.
    """
    c = 0.5 * (1.0 - table.k)
    first, second, third = 0.0, 0.0, 0.0
    near = 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        h = gain * math.hypot(series[i, 1], series[i, 2])
        first += table.amplitude * h * n**c
        second += _EXCESS * table.amplitude * h * n ** (c - 2.0)
        third += _REMAINDER * table.amplitude * h * n ** (c - 1.0)
        near += h * n * integral_at_zero(table.k) / (2.0 + table.k)
    return first, second, gain * table.amplitude * deepest, third, near


@kernel()
def chi_at(terms: Terms, z: float) -> float:
    """Return a bound of the waves over z^c that holds from z on outwards."""
    first, second, deepest, third, _ = terms
    return min(first + second / (z * z), deepest + third / z)


@kernel()
def floor_between(bend: float, power: float, k: float, chi: float, low: float, high: float) -> float:
    """Return the lowest of X [bend z^power - 1 - chi] for z in low .. high: X = z^e falls and then rises."""
    e = 0.5 * (3.0 + k)
    lowest = ((1.0 + chi) * e / (bend * (power + e))) ** (1.0 / power)
    z = min(max(lowest, low), high)
    return z**e * (bend * z**power - 1.0 - chi)


@kernel()
def whole_waves(series: Harmonics, x: float) -> float:
    """Return the whole waves of a place x that is given by them and a part, 0 where one double is enough."""
    return np.floor(x) if x >= NEAREST and highest_harmonic(series) * x > pull_off.FURTHEST else 0.0


@kernel()
def load_at_rim(basis: Basis, curve: Series, x: float, x_low: float) -> float:
    """Return the load at x + x_low, where x_low is the rounding error of x."""
    whole = whole_waves(basis.series, x)
    if whole > 0.0:
        _, _, _, _, load = state(basis, curve, (x - whole) + x_low, whole)
        return load
    _, _, _, _, load = state(basis, curve, x, 0.0)
    _, _, rate = slope(basis, curve, x, 0.0)
    return load + rate * (TWO_PI * x_low)


@kernel()
def better(
    basis: Basis, curve: Series, low: float, high: float, work: Search, cell_zeros: Floats, best: Lowest, whole: float
) -> Lowest:
    """Return the lowest load so far, its place, and the second lowest, a cell taken in, `whole` waves further out."""
    if whole == 0.0:
        whole = whole_waves(basis.series, low)
        low, high = low - whole, high - whole
    at_low, _, _ = slope(basis, curve, low, whole)
    found, _, _ = folds_of_cell(basis, curve, low, high, at_low, work, cell_zeros, whole)
    falling = at_low < 0.0
    for i in range(found):
        if falling:
            best = lower(best, coordinate(basis, curve, cell_zeros[i], whole), whole + cell_zeros[i])
        falling = not falling
    return best


@kernel()
def _in_question(terms: Terms, curve: Series, k: float, start: float, rim: float, load: float) -> tuple[float, float]:
    """Return places between which the lowest load stands, some load being known: both bounds are lowest at `start`."""
    B, m, _, _, _ = curve
    bend, power = B * m / (1.0 + k + m), m - 0.5 * (1.0 - k)
    inner, low = 0.0, start
    outer, high = rim, start
    if floor_between(bend, power, k, chi_at(terms, _BLOCK * rim), _BLOCK * rim, rim) < load:
        high = rim
    for _ in range(_HALVINGS):
        middle = 0.5 * (inner + low)
        if floor_between(bend, power, k, chi_at(terms, _BLOCK * middle), _BLOCK * middle, middle) < load:
            low = middle
        else:
            inner = middle
        middle = 0.5 * (high + outer) if outer < math.inf else 2.0 * high
        if floor_between(bend, power, k, chi_at(terms, _BLOCK * middle), middle, math.inf) < load:
            high = middle
        else:
            outer = middle
    return inner / TWO_PI, min(outer, rim) / TWO_PI


@kernel()
def _lowest_far(
    basis: Basis, curve: Series, terms: Any, start: float, x_rim: float, x_rim_low: float, best: Lowest, search: Search
) -> tuple[bool, Lowest]:
    """Do what `lowest_load` does where it is one of many waves; return whether it is."""
    table, _, series = basis
    cut = cut_of(table, series)
    wave = np.floor(min(start, x_rim - 1.0) - cut)
    if wave < NEAREST or not falls_at_cut(basis, curve, cut, wave):
        return False, best
    work = room_for_waves(series)
    found, near = lowest_of_waves(basis, curve, cut, wave, wave, best, work)
    if not (found and near[0] < 0.0):
        return False, best
    low, high = _in_question(terms, curve, table.k, TWO_PI * start, TWO_PI * x_rim, near[0])
    last = np.floor(min(high + 1.0, x_rim - cut - 1.0))
    low = np.floor(low - 1.0)
    if low < NEAREST or last - low < _MANY:
        return False, best
    found, best = lowest_of_waves(basis, curve, cut, low, last, best, work)
    if not found:
        return False, best
    if high + 2.0 >= x_rim:  # the rest of a wave before the rim
        whole = last + 1.0
        end = (x_rim - whole) + x_rim_low
        place = cut
        while place < end:
            beyond = min(end, place + cell_width(series, x_rim))
            best = better(basis, curve, place, beyond, search, work[1], best, whole)
            place = beyond
    return True, best


@kernel()
def _lowest_about(basis: Basis, curve: Series, start: float, x_rim: float, x_rim_low: float, search: Search) -> Lowest:
    """Do what `lowest_load` does beyond `FURTHEST` waves, where the bounds are lowest at `start`, the rim at most."""
    _, _, series = basis
    whole = np.floor(start) - _ABOUT
    rim = (x_rim - whole) + x_rim_low
    end = min(rim, 2.0 * _ABOUT)
    best = (0.0, 0.0, 0.0)
    if rim == end:
        best = lower(best, coordinate(basis, curve, rim, whole), x_rim)
    zeros, place = np.empty(MOST), 0.0
    while place < end:
        beyond = min(end, place + cell_width(series, start))
        best = better(basis, curve, place, beyond, search, zeros, best, whole)
        place = beyond
    return best


@kernel()
def innermost(terms: Terms, k: float, more: float, z: float) -> float:
    """Return a bound below the load everywhere up to z: all its parts grow with z; `more` as of `floor_of_cell`."""
    first, second, _, _, near = terms
    c, e = 0.5 * (1.0 - k), 0.5 * (3.0 + k)
    waves = near * z ** (e + 1.0 - c)
    if z > 1.0:
        waves = min(waves, max(near, first * z**e + second))
    return -(z**e) - waves - more * z**e


@kernel()
def floor_of_cell(terms: Terms, curve: Series, k: float, more: float, low: float, high: float) -> float:
    """Return a bound below the load between two z; `more` is by how much the toughness may be above 1."""
    m, c = curve.exponent, 0.5 * (1.0 - k)
    chi = chi_at(terms, low)
    if high < math.inf:
        chi = min(chi, terms[4] * high ** (1.0 - c))
    return floor_between(curve.bend * m / (1.0 + k + m), m - c, k, more + chi, low, high)


@kernel()
def lowest_of_cells(
    basis: Basis,
    curve: Series,
    terms: Terms,
    more: float,
    way: tuple[float, float],
    best: Lowest,
    cells: int,
    work: Search,
) -> tuple[int, Lowest]:
    """Search the load cell by cell, outwards and inwards, as long as one can hold anything lower than the best trough.

    The curve is that of controlled load, with the bounds of `floor_of_cell`; `way` are the x where the search begins
    and that of the rim. Return 1 if the lowest load is found, 0 if zero contact was reached without that, -1 if the
    cells ran out; and the lowest load.
    """
    k, (start, x_rim) = basis.table.k, way
    zeros, low, left = np.empty(MOST), start, cells
    while low < x_rim and left > 0:
        if floor_of_cell(terms, curve, k, more, TWO_PI * low, math.inf) >= best[0] * WORTH and low > start:
            break
        high = min(x_rim, low + cell_width(basis.series, low))
        best = better(basis, curve, low, high, work, zeros, best, 0.0)
        low = high
        left -= 1
    high = start
    while left > 0 and high > _CENTRE:
        z_high = TWO_PI * high
        if best[0] < 0.0 and innermost(terms, k, more, z_high) >= best[0] * WORTH:
            return 1, best
        low = _BLOCK * high
        if best[0] < 0.0 and floor_of_cell(terms, curve, k, more, TWO_PI * low, z_high) >= best[0] * WORTH:
            high = low
            continue
        low = high - min(cell_width(basis.series, high), INWARDS * high)
        left -= 1
        if not (best[0] < 0.0 and floor_of_cell(terms, curve, k, more, TWO_PI * low, z_high) >= best[0] * WORTH):
            best = better(basis, curve, low, high, work, zeros, best, 0.0)
        high = low
    return 0 if left > 0 else -1, best


@kernel()
def lowest_load(
    basis: Basis, curve: Series, x_rim: float, x_rim_low: float, work: Search, deepest: float
) -> tuple[float, float, float]:
    """Return the lowest reduced load over (0, x_rim], the x where it is met, and the second lowest trough (or 0).

    NaN if there are too many waves to search. `work` is the room of a search for folds, `deepest` the result of
    `deepest_wave`. One cosine on a paraboloid has core/pull_off/cosine.py; the result is the same under any control.
    """
    table, _, series = basis
    B, m, g, _, _ = curve
    if is_one_cosine(series, m) and g > 0.0:
        return pull_off.lowest_load(table, one_cosine(series, curve), x_rim, x_rim_low)
    k = table.k
    c = 0.5 * (1.0 - k)
    controlled = Series(B, m, g, 0.0, 1.0)
    terms = chi_terms(table, series, g, deepest)
    bend, power = B * m / (1.0 + k + m), m - c
    e = 0.5 * (3.0 + k)
    # where the floor of the far field is lowest
    z = ((1.0 + terms[2]) * e / (bend * (power + e))) ** (1.0 / power)
    start = min(z / TWO_PI, x_rim)
    if not (_CENTRE < start < math.inf):
        return math.nan, math.nan, 0.0
    if start > pull_off.FURTHEST and series.shape[0] > 0:
        return _lowest_about(basis, controlled, start, x_rim, x_rim_low, work)
    best = (0.0, 0.0, 0.0)
    if x_rim < math.inf:
        at_rim = load_at_rim(basis, controlled, x_rim, x_rim_low)
        if at_rim < 0.0:
            best = (at_rim, x_rim, 0.0)
    if start > _FAR and series.shape[0] > 1:  # of one harmonic the bound is sharp
        found, lowest = _lowest_far(basis, controlled, terms, start, x_rim, x_rim_low, best, work)
        if found:
            return lowest
    told, best = lowest_of_cells(basis, controlled, terms, 0.0, (start, x_rim), best, MOST_CELLS, work)
    return best if told > 0 else (math.nan, math.nan, 0.0)
