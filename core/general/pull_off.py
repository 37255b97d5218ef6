"""The pull-off force of any profile: the lowest load over all contact radii up to the rim.

The waves of the load, z w1, are for every k within z^c times

    C sum h_n n^c (1 + 2.1/(n z)^2)   and   max(-wave of their leading term) + 2.53 C sum h_n n^(c-1)/z

and, for z small, within sum h_n n z T0(0)/(2+k). So the load lies nowhere below

    X [ B m/(1+k+m) z^(m-c) - 1 - chi(z) ],   X = z^((3+k)/2)

with a chi that falls as z grows. The search starts where this is lowest and goes outwards cell by cell on both sides,
leaving out what cannot hold anything lower than the best trough found.
"""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core._jit import kernel
from gradhesion.core.general.cells import MOST
from gradhesion.core.general.curve import Basis, Curve, slope, state
from gradhesion.core.general.folds import MOST_CELLS, cell_width, folds_of_cell
from gradhesion.core.struve.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.struve.cosine_bins import integral_at_zero

_EXCESS: Final = 2.1
_REMAINDER: Final = 2.53
_WORTH: Final = 1.0 + 4.0 * 2.0**-52
_SAMPLES: Final = 16
"""Samples for each wave of the shortest harmonic; the crest is higher by (pi/16)^2/2 of each amplitude at most."""
_BLOCK: Final = 0.9
_INWARDS: Final = 0.3
"""Longest cell over the distance of its outer end from zero contact."""
_PHASELESS: Final = 1e12


@kernel()
def deepest_wave(table: Any, series: Any) -> float:
    """Return an upper bound of -z^(1-c) w1/C's leading term, sum n^c [-cos_n sin(n z - phi) - sin_n cos(n z - phi)]."""
    c = 0.5 * (1.0 - table.k)
    cosine_phase, sine_phase = table.cos_phase / table.amplitude, table.sin_phase / table.amplitude
    shortest, amplitudes, bends = 0.0, 0.0, 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        shortest = max(shortest, n)
        h = math.hypot(series[i, 1], series[i, 2]) * n**c
        amplitudes += h
        bends += h * n * n
    samples = int(_SAMPLES * shortest)
    deepest = 0.0
    for j in range(samples):
        total = 0.0
        for i in range(series.shape[0]):
            n = series[i, 0]
            turns = float((int(n) * j) % samples) / samples
            sine, cosine = sine_cosine_of_turns(turns)
            s = sine * cosine_phase - cosine * sine_phase
            total -= n**c * (series[i, 1] * s + series[i, 2] * (cosine * cosine_phase + sine * sine_phase))
        deepest = max(deepest, total)
    return min(amplitudes, deepest + 0.5 * (math.pi / max(1, samples)) ** 2 * bends)


@kernel()
def _chi_terms(table: Any, series: Any, gain: float) -> tuple[float, float, float, float, float]:
    """Return the terms of the bounds: h n^c, h n^(c-2), the deepest wave, h n^(c-1), and that of small z."""
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
    return first, second, gain * table.amplitude * deepest_wave(table, series), third, near


@kernel()
def _chi(terms: tuple[float, float, float, float, float], z: float) -> float:
    """Return a bound of the waves over z^c that holds from z on outwards."""
    first, second, deepest, third, _ = terms
    return min(first + second / (z * z), deepest + third / z)


@kernel()
def _floor(bend: float, power: float, k: float, chi: float, low: float, high: float) -> float:
    """Return the lowest of X [bend z^power - 1 - chi] for z in low .. high: X = z^e falls and then rises."""
    e = 0.5 * (3.0 + k)
    lowest = ((1.0 + chi) * e / (bend * (power + e))) ** (1.0 / power)
    z = min(max(lowest, low), high)
    return z**e * (bend * z**power - 1.0 - chi)


@kernel()
def load_at_rim(basis: Basis, curve: Curve, x: float, x_low: float) -> float:
    """Return the load at x + x_low, where x_low is the rounding error of x."""
    _, _, _, _, load = state(basis, curve, x)
    _, _, rate = slope(basis, curve, x)
    return load + rate * (TWO_PI * x_low)


@kernel()
def _better(
    basis: Basis,
    curve: Curve,
    low: float,
    high: float,
    work: Any,
    cell_zeros: Any,
    best: tuple[float, float, float],
) -> tuple[float, float, float]:
    """Return the lowest load so far, its place, and the second lowest, a cell taken in."""
    lowest, place, second = best
    at_low, _, _ = slope(basis, curve, low)
    found, _, _ = folds_of_cell(basis, curve, low, high, at_low, work, cell_zeros)
    falling = at_low < 0.0
    for i in range(found):
        if falling:
            _, _, _, _, value = state(basis, curve, cell_zeros[i])
            if value < lowest:
                lowest, place, second = value, cell_zeros[i], lowest
            else:
                second = min(second, value)
        falling = not falling
    return lowest, place, second


@kernel()
def lowest_load(basis: Basis, curve: Curve, x_rim: float, x_rim_low: float, work: Any) -> tuple[float, float, float]:
    """Return the lowest reduced load over (0, x_rim], the x where it is met, and the second lowest trough (or 0).

    NaN if there are too many waves to look at.
    """
    table, _, series = basis
    B, m, g, _, _ = curve
    k = table.k
    c = 0.5 * (1.0 - k)
    controlled = (B, m, g, 0.0, 1.0)
    terms = _chi_terms(table, series, g)
    bend, power = B * m / (1.0 + k + m), m - c
    e = 0.5 * (3.0 + k)
    # where the floor of the far field is lowest
    z = ((1.0 + terms[2]) * e / (bend * (power + e))) ** (1.0 / power)
    start = min(z / TWO_PI, x_rim)
    if not (1e-100 < start < math.inf) or (start > _PHASELESS and series.shape[0] > 0):
        return math.nan, math.nan, 0.0
    best = (0.0, 0.0, 0.0)
    if x_rim < math.inf:
        at_rim = load_at_rim(basis, controlled, x_rim, x_rim_low)
        if at_rim < 0.0:
            best = (at_rim, x_rim, 0.0)
    cell_zeros = np.empty(MOST)
    low, left = start, MOST_CELLS
    while low < x_rim and left > 0:
        z_low = TWO_PI * low
        if _floor(bend, power, k, _chi(terms, z_low), z_low, math.inf) >= best[0] * _WORTH and low > start:
            break
        high = min(x_rim, low + cell_width(series, low))
        best = _better(basis, controlled, low, high, work, cell_zeros, best)
        low = high
        left -= 1
    high = start
    while left > 0:
        z_high = TWO_PI * high
        if best[0] < 0.0 and _innermost(terms, c, e, z_high) >= best[0] * _WORTH:
            break
        low = _BLOCK * high
        near = terms[4] * z_high ** (1.0 - c)
        chi = min(near, _chi(terms, TWO_PI * low))
        if best[0] < 0.0 and _floor(bend, power, k, chi, TWO_PI * low, z_high) >= best[0] * _WORTH:
            high = low
            continue
        low = high - min(cell_width(series, high), _INWARDS * high)
        left -= 1
        chi = min(near, _chi(terms, TWO_PI * low))
        if not (best[0] < 0.0 and _floor(bend, power, k, chi, TWO_PI * low, z_high) >= best[0] * _WORTH):
            best = _better(basis, controlled, low, high, work, cell_zeros, best)
        if high < 1e-100:
            return math.nan, math.nan, 0.0
        high = low
    if left == 0:
        return math.nan, math.nan, 0.0
    return best


@kernel()
def _innermost(terms: tuple[float, float, float, float, float], c: float, e: float, z: float) -> float:
    """Return a bound below the load everywhere up to z: both parts grow with z."""
    first, second, _, _, near = terms
    waves = near * z ** (e + 1.0 - c)
    if z > 1.0:
        waves = min(waves, max(near, first * z**e + second))
    return -(z**e) - waves
