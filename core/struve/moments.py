"""The two moments of S0 in the energy of a jump from or to zero contact.

    E2(z) = int_0^z y^(k+3) S0 dy,    W(z) = int_0^z y^(k+2) S0^2 dy

Both are kept divided by z^(k+5), which leaves smooth even functions e and v with

    z e' + (k+5) e = S0/z,    z v' + (k+5) v = (S0/z)^2

Below z = 2 they are power series, below 40 polynomials in bins, and beyond

    E2 = [z^(k+4) S1 - 2 z^(k+3)/(k+3)]/(k+1) + 2 z^(k+2) S0 - 2 (k+2)/(k+1) z^(k+2) S1

while W, which has no closed form, is integrated term by term from the expansion of S0 at large z (large.py): with
n = (1+k)/2, psi = z - phi and G0 = sum gamma_m z^(-1-2m), P0 = sum i^m a_m z^-m,

    slow parts         z^(k+2) G0^2 + C^2/2 z |P0|^2      (|P0|^2 by Nicholson's series; it brings a logarithm)
    once oscillating   2 C z^n Im[e^(i psi) (z G0) P0]    -> -2 C z^n Im[e^(i psi) sum i^(m+1) chi_m z^-m]
    twice oscillating  -C^2/2 z Re[e^(2 i psi) P0^2]      ->  C^2/4 z Re[e^(2 i psi) sum i^(m+1) X_m z^-m]
    chi_m = f_m + (n-m+1) chi_(m-1),    X_m = F_m + (1 - m/2) X_(m-1)

where f_m and F_m are the real coefficients of (z G0) P0 and of P0^2.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import TWO_PI, TWO_PI_LOW, sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import fma, make_horner
from gradhesion.core.struve.bins import economisation
from gradhesion.core.struve.filling import ask_for_moments
from gradhesion.core.struve.layout import (
    BIN_TERMS,
    BIN_WIDTH,
    MOMENT_BINS,
    MOMENT_SERIES_TERMS,
    MOMENT_START,
    MOMENT_TAIL_TERMS,
    MOMENT_TERMS,
    SWITCH,
)
from gradhesion.core.struve.pair import pair
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Table

_TAYLOR: Final = 2 * BIN_TERMS - 1
"""The square of a bin's polynomial has this many coefficients."""
_SLOW_TERMS: Final = 12
ECONOMISATION: Final = economisation(_TAYLOR, MOMENT_TERMS)
_series = make_horner(2, MOMENT_SERIES_TERMS)
_bins = make_horner(2, MOMENT_TERMS)


@kernel()
def _build_series(k: float, series: Floats) -> None:
    """Integrate S0/z = sum c_n z^(2n) and its square term by term, into `series`, of shape (MOMENT_SERIES_TERMS, 2)."""
    terms = len(series)
    c = np.empty(terms)
    c[0] = 1.0 / (1.0 + k)
    for n in range(1, terms):
        c[n] = -c[n - 1] / ((2.0 * n + 1.0) * (2.0 * n + 1.0 + k))
    for n in range(terms):
        square = 0.0
        for m in range(n + 1):
            square += c[m] * c[n - m]
        series[n, 0] = c[n] / (2.0 * n + k + 5.0)
        series[n, 1] = square / (2.0 * n + k + 5.0)


@kernel()
def _build_bins(k: float, bins: Floats, pair_bins: Floats, start: Floats, matrix: Floats) -> None:
    """Solve z f' + (k+5) f = right bin by bin, from the values (2,) at the lower edge of the first one.

    `bins` are those of the moments, `pair_bins` those of the pair (layout.py), `matrix` is ECONOMISATION.
    """
    half = 0.5 * BIN_WIDTH
    first = len(pair_bins) - len(bins)
    right = np.empty((_TAYLOR, 2))
    particular = np.empty(_TAYLOR)
    homogeneous = np.empty(_TAYLOR)
    edge = start.copy()
    for i in range(len(bins)):
        centre = BIN_WIDTH * (first + i) + half
        right[:, :] = 0.0
        for m in range(BIN_TERMS):
            right[m, 0] = pair_bins[first + i, m, 0]
            for n in range(BIN_TERMS):
                right[m + n, 1] += pair_bins[first + i, m, 0] * pair_bins[first + i, n, 0]
        for lane in range(2):
            # the series at the centre: one that starts at 0 with the right side, one that starts at 1 without
            particular[0], homogeneous[0] = 0.0, 1.0
            for n in range(_TAYLOR - 1):
                step = half / (centre * (n + 1.0))
                particular[n + 1] = step * (right[n, lane] - (n + k + 5.0) * particular[n])
                homogeneous[n + 1] = -step * (n + k + 5.0) * homogeneous[n]
            particular_edge, homogeneous_edge, sign = 0.0, 0.0, 1.0
            for n in range(_TAYLOR):
                particular_edge += sign * particular[n]
                homogeneous_edge += sign * homogeneous[n]
                sign = -sign
            weight = (edge[lane] - particular_edge) / homogeneous_edge
            edge[lane] = 0.0
            for n in range(_TAYLOR):
                particular[n] += weight * homogeneous[n]
                edge[lane] += particular[n]
            for j in range(MOMENT_TERMS):
                total = 0.0
                for n in range(_TAYLOR - 1, -1, -1):
                    total += matrix[j, n] * particular[n]
                bins[i, j, lane] = total


@kernel()
def _build_tail(k: float, amplitude: float, tail: Floats) -> float:
    """Put the coefficients of the parts of W into `tail`, of shape (MOMENT_TAIL_TERMS, 5); return the logarithm's."""
    terms = len(tail)
    alpha, n = 0.5 * (k - 1.0), 0.5 * (k + 1.0)
    descent_zero = np.zeros(terms)  # z G0 in 1/z: only even terms
    descent_one = np.empty(terms)  # P0 = sum i^m a_m z^-m
    descent_zero[0] = descent_one[0] = 1.0
    for m in range(1, terms):
        descent_one[m] = descent_one[m - 1] * (alpha - m + 1.0) * (alpha + m) / (2.0 * m)
    for m in range(1, _SLOW_TERMS):
        descent_zero[2 * m] = descent_zero[2 * m - 2] * (alpha - m + 1.0) * 2.0 * (2.0 * m - 1.0)
    once, twice, nicholson = 0.0, 0.0, 1.0
    logarithm = 0.0
    tail[:, :] = 0.0
    for m in range(terms):
        mixed, square = 0.0, 0.0
        for j in range(m + 1):
            # i^m f_m: an even term of z G0 brings no factor of i, which (-1)^(j/2) makes up for
            mixed += descent_zero[j] * descent_one[m - j] * (1.0 if (j // 2) % 2 == 0 else -1.0)
            square += descent_one[j] * descent_one[m - j]
        once = mixed + (n - m + 1.0) * once if m > 0 else mixed
        twice = square + (1.0 - 0.5 * m) * twice if m > 0 else square
        sign = 1.0 if m % 4 < 2 else -1.0
        tail[m, 2] = sign * 2.0 * once
        tail[m, 3] = sign * 0.25 * twice
    for m in range(_SLOW_TERMS):
        square = 0.0
        for j in range(m + 1):
            square += descent_zero[2 * j] * descent_zero[2 * (m - j)]
        # the coefficient of z^(k-1)/(k-1) is 2 (k-1), so that k = 1 is no exception
        tail[m, 0] = 2.0 if m == 1 else square / (k + 1.0 - 2.0 * m)
        if m > 0:
            nicholson *= (2.0 * m - 1.0) / (2.0 * m) * (k * k - (2.0 * m - 1.0) ** 2) / 4.0
        if m == 1:
            logarithm = 0.5 * amplitude * amplitude * nicholson
        else:
            tail[m, 1] = 0.5 * amplitude * amplitude * nicholson / (2.0 - 2.0 * m)
    return logarithm


@kernel(contract=True)
def _second_moment_of_square(table: Table, x: float, z: float, power: float) -> float:
    """Return W at z >= 40 but for its constant."""
    tail = table.moment_tail
    inverse = 1.0 / z
    w = inverse * inverse
    slow0, slow1 = 0.0, 0.0
    for m in range(_SLOW_TERMS - 1, -1, -1):
        slow0 = slow0 * w + tail[m, 0]
        slow1 = slow1 * w + tail[m, 1]
    once_even, once_odd, twice_even, twice_odd = 0.0, 0.0, 0.0, 0.0
    for m in range(MOMENT_TAIL_TERMS - 2, -2, -2):
        once_even = once_even * w + tail[m, 2]
        once_odd = once_odd * w + tail[m + 1, 2]
        twice_even = twice_even * w + tail[m, 3]
        twice_odd = twice_odd * w + tail[m + 1, 3]
    sine, cosine = sine_cosine_of_turns(x)
    s = sine * table.cos_phase - cosine * table.sin_phase  # C sin psi
    c = cosine * table.cos_phase + sine * table.sin_phase
    slow = slow0 / (power * power) + slow1 * z * z + table.moment_logarithm * math.log(z)
    once = (c * once_even - s * inverse * once_odd) / power
    twice = z * (2.0 * s * c * twice_even + (c * c - s * s) * inverse * twice_odd)
    return slow - once - twice


@kernel()
def build_moments(table: Table, matrix: Floats) -> None:
    """Fill the moments of a table whose pair is complete; `matrix` is ECONOMISATION."""
    _build_series(table.k, table.moment_series)
    start = np.array(_series(table.moment_series, MOMENT_START * MOMENT_START))
    _build_bins(table.k, table.moment_bins, table.bins, start, matrix)
    table.moment_logarithm = _build_tail(table.k, table.amplitude, table.moment_tail)
    # the constant that continues W of the last bin
    edge_square = 0.0
    for m in range(MOMENT_TERMS):
        edge_square += table.moment_bins[MOMENT_BINS - 1, m, 1]
    power = amplitude_power(table, SWITCH)
    square = edge_square * SWITCH**4 / (power * power)
    table.moment_constant = square - _second_moment_of_square(table, SWITCH / TWO_PI, SWITCH, power)


@kernel(contract=True)
def moments(table: Table, x: float, power: float) -> tuple[float, float]:
    """Return E2/z^(k+5) and W/z^(k+5) at z = 2 pi x, with power = z^(-(1+k)/2) (used from z = 40 on)."""
    z = TWO_PI * x
    if z < MOMENT_START:
        return _series(table.moment_series, z * z)
    if z < SWITCH:
        i = int(2.0 * z)
        t = fma(4.0 * TWO_PI, x, -(2.0 * i + 1.0)) + 4.0 * TWO_PI_LOW * x
        ask_for_moments(table, i - 4)
        return _bins(table.moment_bins[i - 4], t)
    k = table.k
    s0, s1, _, _ = pair(table, x)
    inverse = 1.0 / z
    e2 = (
        (s1 - 2.0 * inverse / (k + 3.0)) / (k + 1.0) + 2.0 * inverse * inverse * (s0 - (k + 2.0) / (k + 1.0) * s1)
    ) * inverse
    square = table.moment_constant + _second_moment_of_square(table, x, z, power)
    return e2, square * (power * power) * (inverse * inverse) ** 2
