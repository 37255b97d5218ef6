"""The waves of a profile at one radius: a sum over harmonics of the integrals of core/struve.

With z = 2 pi x, x = a/lambda, and y = n z for each harmonic,

    w0 = sum n [cos_n S0 + sin_n T0]           w1 = sum n [cos_n (S0 - S1) + sin_n (T0 - T1)]
    v  = sum n [cos_n V_S + sin_n V_T] = (z w0)'    V_S = S0 + y S0',  V_T = T0 + y T0'     v1 = dv/dz

n x is rounded, and its rounding error is carried along: the phase of every harmonic is that of the exact product.

Far out a place is `whole` + x, with x of a few waves: whole waves have no part in the phase, so that no digit of it is
lost at 10^6 waves. `whole` is 0, or at least 8 (z > 40); it may be any real number, which makes what belongs to a
wave a smooth function of its number (waves/general.py).
"""

from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.harmonics.series_table import (
    COSINES,
    PLACES,
    TERMS,
    Flat,
    build_far,
    fit_powers,
    join_table,
    near_bins,
    tabulated_sums,
)
from gradhesion.core.numbers.circle import TWO_PI, TWO_PI_LOW, sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import fma, make_horner
from gradhesion.core.struve.layout import BIN_TERMS, SWITCH, TAIL_TERMS
from gradhesion.core.struve.pair import pair_above, pair_below
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics, Table

_COSINE_BIN: Final = 2 * BIN_TERMS
horner2 = make_horner(2, BIN_TERMS)
horner4 = make_horner(4, BIN_TERMS)
horner8 = make_horner(8, TAIL_TERMS)


@kernel()
def highest_harmonic(series: Harmonics) -> float:
    """Return n of the highest harmonic, 0 without any."""
    shortest = 0.0
    for i in range(series.shape[0]):
        shortest = max(shortest, series[i, 0])
    return shortest


@kernel(contract=True, inline=True)
def integrals(
    table: Table, cosine_bins: Flat, x: float, x_low: float, whole: float = 0.0, odd: float = 1.0
) -> tuple[float, float, float, float, float, float]:
    """Return z, S0, S1, S0', T0, T1 at z = 2 pi (whole + x + x_low) and the phase of x + x_low.

    x_low is below the last place of x. Where z < 40 `whole` must be 0. T0 and T1 are 0 where `odd` is: a harmonic
    without a sine does not need them.
    """
    k = table.k
    z = TWO_PI * (whole + x)
    if z < SWITCH:
        i = int(2.0 * z)
        t = fma(4.0 * TWO_PI, x, -(2.0 * i + 1.0)) + 4.0 * (TWO_PI_LOW * x + TWO_PI * x_low)
        s0_over_z, s1_over_z, s0_slope, _ = horner4(table.bins[i], t)
        if odd == 0.0:
            return z, z * s0_over_z, z * s1_over_z, s0_slope, 0.0, 0.0
        t0, t1 = horner2(cosine_bins[_COSINE_BIN * i : _COSINE_BIN * (i + 1)], t)
        return z, z * s0_over_z, z * s1_over_z, s0_slope, t0, t1
    inverse = 1.0 / z
    w = SWITCH * inverse
    p0, q0, p1, q1, g0, g1, h0, _ = horner8(table.tail, 2.0 * (w * w) - 1.0)
    sine, cosine = sine_cosine_of_turns(x)
    shift = TWO_PI * x_low
    sine, cosine = sine + shift * cosine, cosine - shift * sine
    power = amplitude_power(table, z)
    s = power * (sine * table.cos_phase - cosine * table.sin_phase)
    c = power * (cosine * table.cos_phase + sine * table.sin_phase)
    wave1 = q1 * inverse * s - p1 * c
    s0 = g0 * inverse + (p0 * s + q0 * inverse * c)
    s1 = inverse * (g1 + (k + 1.0) * wave1)
    if odd == 0.0:
        return z, s0, s1, h0 * inverse * inverse - wave1, 0.0, 0.0
    t0 = p0 * c - q0 * inverse * s
    t1 = inverse * (k + 1.0) * (p1 * s + q1 * inverse * c)
    return z, s0, s1, h0 * inverse * inverse - wave1, t0, t1


@kernel(contract=True, inline=True)
def summed(
    table: Table, waves: Flat, series: Harmonics, x: float, x_low: float, whole: float
) -> tuple[float, float, float, float]:
    """Return what `sums` does, term by term, at whole + x + x_low."""
    k1 = 1.0 + table.k
    w0, w1, v, v1 = 0.0, 0.0, 0.0, 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        even, odd = n * series[i, 1], n * series[i, 2]
        product = n * x
        y, s0, s1, d0, t0, t1 = integrals(table, waves, product, fma(n, x, -product) + n * x_low, n * whole, odd)
        w0 += even * s0
        w1 += even * (s0 - s1)
        v += even * (s0 + y * d0)
        v1 += n * even * (2.0 * d0 + y * (s1 - s0))
        if odd != 0.0:
            fall = -y * t1 / k1  # T0'
            w0 += odd * t0
            w1 += odd * (t0 - t1)
            v += odd * (t0 + y * fall)
            v1 += n * odd * (2.0 * fall + y * (t1 - t0))
    return w0, w1, v, v1


@kernel(contract=True, inline=True)
def _of_one_cosine(table: Table, even: float, x: float, whole: float) -> tuple[float, float, float, float]:
    """Return what `sums` does for the one row (1, even, 0)."""
    z = TWO_PI * (whole + x)
    if z < SWITCH:
        s0, s1, d0, _ = pair_below(table, x, z)
    else:
        s0, s1, d0, _ = pair_above(table, x, z, amplitude_power(table, z))
    return even * s0, even * (s0 - s1), even * (s0 + z * d0), even * (2.0 * d0 + z * (s1 - s0))


@kernel(contract=True, inline=True)
def sums(
    table: Table, waves: Flat, series: Harmonics, x: float, whole: float = 0.0
) -> tuple[float, float, float, float]:
    """Return w0, w1, v and v1 at whole + x >= 0; `series` has a row (n, cos, sin) for each harmonic."""
    if waves.size > COSINES and series.shape[0] > 0 and waves[COSINES] * (whole + x) >= 1.0:
        return tabulated_sums(table, waves, x, whole)
    if series.shape[0] == 1 and series[0, 0] == 1.0 and series[0, 2] == 0.0:
        return _of_one_cosine(table, series[0, 1], x, whole)
    return summed(table, waves, series, x, 0.0, whole)


@kernel(entry=True)
def _fill_near(table: Table, waves: Flat, series: Harmonics, count: float, near: Floats) -> None:
    """Fill the bins `near`, of shape (bins, TERMS, 4), up to z = 40 and a little more, `count` a wavelength."""
    values = np.empty((TERMS, 4))
    for b in range(near.shape[0]):
        for place in range(TERMS):
            part = 0.5 * (1.0 + PLACES[place])
            x = (b + part) / count
            x_low = (fma(-x, count, float(b)) + part) / count
            w0, w1, v, v1 = summed(table, waves, series, x, x_low, 0.0)
            values[place, 0], values[place, 1], values[place, 2], values[place, 3] = w0, w1, v, v1
        fit_powers(values, near[b])


def with_table(table: Table, bins: Floats, rows: Harmonics) -> Flat:
    """Return the bins of T0 and T1, flat, with the table of a series that has_table (harmonics/series_table.py)."""
    far, slow = build_far(table, rows)
    near = np.empty((near_bins(far.shape[0]), TERMS, 4))
    _fill_near(table, bins.ravel(), rows, float(far.shape[0]), near)
    return join_table(bins, near, far, slow)
