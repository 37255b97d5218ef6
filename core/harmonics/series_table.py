"""The waves of a series of many harmonics at the cost of a few: a table for each exponent and series.

Up to z = 40 the four sums of harmonics/series.py are polynomials in bins of x. From there on every integral is a sum of
powers of 1/z, those of its wave with a sine and a cosine for factors, and with y = n z so are the sums,

    w = slow(1/z) + z^(-n) sum_j F_j(x) (40/z)^j,

where F_j is periodic in x: polynomials in bins of one wavelength. Far out few of the 16 orders are left. A bin is a
seventh of the shortest wave, of which 13 terms leave 1e-17.

All is one flat array, because to hand over one is much cheaper than four: the bins of T0 and T1 (cosine_bins.py), and
where there is a table, the number of bins of a wavelength, the slow parts, and the bins up to z = 40 and beyond.
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import fma, make_horner
from gradhesion.core.struve.layout import BIN_TERMS, SWITCH, TAIL_TERMS
from gradhesion.core.struve.layout import BINS as COSINE_BINS
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics, Table

FEWEST: Final = 6
"""Harmonics from which on a table saves time."""
HIGHEST: Final = 64
"""The shortest wave of a table, which then takes 4 MB."""
BINS: Final = 7
"""Bins a shortest wave."""
TERMS: Final = 13
NEAR: Final = 6.5
"""x up to which the sums themselves are tabulated; z > 40 there."""
COSINES: Final = COSINE_BINS * BIN_TERMS * 2
"""Numbers before the table of a series."""
Flat: TypeAlias = Floats
"""The bins of T0 and T1, flat, of shape (COSINES,), and behind them the table of a series that has one."""
_SLOW: Final = COSINES + 1
_NEAR: Final = _SLOW + 4 * TAIL_TERMS
_ORDERS: Final = 2 * TAIL_TERMS
_LANES: Final = 8
"""The four sums, with an even order of 40/z and the odd one that follows."""
PLACES: Final = np.cos(np.pi * (np.arange(TERMS)[::-1] + 0.5) / TERMS)

_horner_near = make_horner(4, TERMS)
_horner_far = make_horner(_LANES, TERMS)
_horner_slow = make_horner(4, TAIL_TERMS)


_CHEBYSHEV: Final = np.array(
    [[(1.0 + (j > 0)) / TERMS * np.cos(j * np.arccos(x)) for x in PLACES] for j in range(TERMS)]
)
"""From values at `PLACES` to Chebyshev coefficients."""


def _powers_of_chebyshev() -> Floats:
    """Return the coefficients of powers, all integers, of Chebyshev polynomials, one a column; shape (TERMS, TERMS)."""
    powers = np.zeros((TERMS, TERMS))
    for j in range(TERMS):
        row = np.polynomial.chebyshev.cheb2poly([0.0] * j + [1.0])
        powers[: row.size, j] = row
    return powers


_POWERS: Final = _powers_of_chebyshev()


@kernel()
def fit_powers(values: Floats, powers: Floats) -> None:
    """Put coefficients of powers for values at `PLACES`, one column a function, into `powers`; shapes (TERMS, n).

    By way of Chebyshev coefficients: the matrix of both steps has entries of thousands, of opposite signs.
    """
    middle = np.empty(TERMS)
    for lane in range(values.shape[1]):
        for j in range(TERMS):
            middle[j] = 0.0
            for place in range(TERMS):
                middle[j] += _CHEBYSHEV[j, place] * values[place, lane]
        for power in range(TERMS):
            total = 0.0
            for j in range(TERMS - 1, power - 1, -1):
                total += _POWERS[power, j] * middle[j]
            powers[power, lane] = total


_NEAR_BIN: Final = 4 * TERMS
_FAR_ORDER: Final = _LANES * TERMS
_FAR_BIN: Final = TAIL_TERMS * _FAR_ORDER


def has_table(rows: Harmonics) -> bool:
    """Return whether a table of the series saves time."""
    return bool(len(rows) >= FEWEST and rows[:, 0].max() <= HIGHEST)


def _orders(k: float, tail: Floats) -> tuple[Floats, Floats]:
    """Return the orders of 40/y of the four sums of one harmonic.

    Returns
    -------
    Those of the oscillating parts over y^(-n), by the cosine and the sine of the profile, by the sums w0, w1, v/y and
    v1/y of n = 1, by the factors of sine and cosine of y - phi, and by the order; and those of the slow parts y w0,
    y w1, y v and v1 of the cosine in (40/y)^2.
    """
    powers = np.zeros((8, _ORDERS))  # p0, q0/y, p1, q1/y, g0, g1, h0 in powers of 40/y
    for lane in range(7):
        total = np.poly1d([0.0])
        for j in range(TAIL_TERMS - 1, -1, -1):  # from 2 (40/y)^2 - 1
            total = total * np.poly1d([2.0, -1.0]) + tail[j, lane]
        even = total.coeffs[::-1]
        powers[lane, : 2 * even.size : 2] = even
    p0, p1, g0, g1, h0 = powers[[0, 2, 4, 5, 6]]

    def over_y(orders: Floats) -> Floats:
        return np.concatenate([[0.0], orders[:-1] / SWITCH])

    q0, q1 = over_y(powers[1]), over_y(powers[3])
    s0, t0 = np.array([p0, q0]), np.array([-q0, p0])  # factors of sine and cosine
    wave, other = np.array([q1, -p1]), np.array([p1, q1])  # S0' = h0/y^2 - wave, T0' = -other
    s1, t1 = ((1.0 + k) * np.array([over_y(row) for row in rows]) for rows in (wave, other))
    once = [np.array([over_y(row) for row in rows]) for rows in (s0, t0, wave, other)]
    cosines = [s0, s0 - s1, once[0] - wave, s1 - s0 - 2.0 * once[2]]
    sines = [t0, t0 - t1, once[1] - other, t1 - t0 - 2.0 * once[3]]
    slow = np.array([g0, g0 - g1, g0 + h0, g1 - g0 + 2.0 * over_y(over_y(h0))])
    return np.array([cosines, sines]), np.ascontiguousarray(slow[:, ::2].T)


@kernel(entry=True)
def _fill_far(table: Table, series: Harmonics, orders: Floats, far: Floats) -> None:
    """Fill the bins `far` of F_j, those of w0, w1, v/z and v1/z; `orders` are the first array of `_orders`."""
    bins = far.shape[0]
    values = np.zeros((TERMS, TAIL_TERMS, _LANES))
    for b in range(bins):
        values[:] = 0.0
        for place in range(TERMS):
            part = 0.5 * (1.0 + PLACES[place])
            for h in range(series.shape[0]):
                n = series[h, 0]
                # whole turns apart: a rounded n u would be off by n units
                sine, cosine = sine_cosine_of_turns((float((int(n) * b) % bins) + n * part) / bins)
                s = sine * table.cos_phase - cosine * table.sin_phase
                c = cosine * table.cos_phase + sine * table.sin_phase
                scale = n ** (0.5 * (1.0 - table.k))
                for j in range(_ORDERS):
                    for f in range(4):
                        value = series[h, 1] * (orders[0, f, 0, j] * s + orders[0, f, 1, j] * c)
                        value += series[h, 2] * (orders[1, f, 0, j] * s + orders[1, f, 1, j] * c)
                        weight = scale if f < 2 else (scale * n if f == 2 else scale * n * n)
                        values[place, j // 2, f + 4 * (j % 2)] += weight * value
                    scale /= n
        for i in range(TAIL_TERMS):
            fit_powers(values[:, i], far[b, i])


@kernel(contract=True)
def _orders_left(z: float) -> int:
    """Return i from which on orders 2 i of 1/z, about (2 i - 1)!/(2 z)^(2 i), are lost in rounding."""
    if z >= 900.0:
        return 2 if z >= 16000.0 else 3
    if z >= 240.0:
        return 4
    return 5 if z >= 110.0 else TAIL_TERMS


@kernel(contract=True)
def near_bins(bins: int) -> int:
    """Return the number of bins up to z = 40, a little more than that, of so many a wavelength."""
    return math.ceil(NEAR * bins) + 1


@kernel(contract=True)
def tabulated_sums(table: Table, waves: Flat, x: float, whole: float) -> tuple[float, float, float, float]:
    """Return the result of `sums` of harmonics/series.py from the table of a series."""
    place = whole + x
    bins = int(waves[COSINES])
    if place < NEAR:  # whole = 0
        i = int(bins * x)
        start = _NEAR + _NEAR_BIN * i
        w0, w1, v, v1 = _horner_near(waves[start : start + _NEAR_BIN], 2.0 * fma(float(bins), x, -(i + 0.5)))
        return w0, w1, v, v1
    z = TWO_PI * place
    inverse = 1.0 / z
    w = SWITCH * inverse
    square = w * w
    u = x - np.floor(x)
    b = min(bins - 1, int(bins * u))
    t = 2.0 * fma(float(bins), u, -(b + 0.5))
    w0, w1, v, v1 = 0.0, 0.0, 0.0, 0.0
    far = _NEAR + _NEAR_BIN * near_bins(bins) + _FAR_BIN * b
    for i in range(_orders_left(z) - 1, -1, -1):
        start = far + _FAR_ORDER * i
        a0, a1, a2, a3, b0, b1, b2, b3 = _horner_far(waves[start : start + _FAR_ORDER], t)
        w0 = w0 * square + (a0 + w * b0)
        w1 = w1 * square + (a1 + w * b1)
        v = v * square + (a2 + w * b2)
        v1 = v1 * square + (a3 + w * b3)
    power = amplitude_power(table, z)
    s0, s1, s2, s3 = _horner_slow(waves[_SLOW:_NEAR], square)
    swing = z * power
    return power * w0 + inverse * s0, power * w1 + inverse * s1, swing * v + inverse * s2, swing * v1 + s3


@kernel(contract=True)
def slow_sums(waves: Flat, z: float) -> tuple[float, float]:
    """Return the parts of w0 and w1 that have no phase, from the table of a series."""
    inverse = 1.0 / z
    w = SWITCH * inverse
    s0, s1, _, _ = _horner_slow(waves[_SLOW:_NEAR], w * w)
    return inverse * s0, inverse * s1


def join_table(bins: Floats, near: Floats, far: Floats, slow: Floats) -> Flat:
    """Return the flat array of the bins of T0 and T1, and the table of a series."""
    return np.concatenate([bins.ravel(), [float(far.shape[0])], slow.ravel(), near.ravel(), far.ravel()])


def build_far(table: Table, rows: Harmonics) -> tuple[Floats, Floats]:
    """Return the bins of F_j and the slow parts of a series, in the shapes that `join_table` makes flat."""
    n, even = rows[:, 0], rows[:, 1]
    orders, slow = _orders(float(table["k"]), table["tail"])
    far = np.empty((BINS * int(n.max()), TAIL_TERMS, TERMS, _LANES))
    _fill_far(table, rows, orders, far)
    weights = even * n ** (-2.0 * np.arange(TAIL_TERMS)[:, None])  # of y^-2i, the factor n against 1/y
    sums = np.column_stack([slow[:, f] * weights.sum(axis=1) for f in range(3)])
    last = slow[:, 3] * (weights * n * n).sum(axis=1)
    return far, np.ascontiguousarray(np.column_stack([sums, last]))
