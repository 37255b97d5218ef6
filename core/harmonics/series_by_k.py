"""The waves of a profile at one radius, and how they change with the gradient exponent.

All tables are linear in their entries, so that the derivative by k of every polynomial is kept as a table of the same
shape: differences of tables of neighbouring exponents. Where z >= 40 the waves have a factor z^(-(1+k)/2) more.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.harmonics.series import _COSINE_BIN, horner2, horner4, horner8
from gradhesion.core.harmonics.series_table import COSINES, NEAR, Flat, slow_sums, tabulated_sums
from gradhesion.core.numbers.circle import TWO_PI, TWO_PI_LOW, sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.struve.layout import SWITCH
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics, Table


@kernel(contract=True)
def _integrals_by_k(
    table: Table, cosine_bins: Flat, change: Table, cosine_change: Flat, x: float, x_low: float, whole: float
) -> tuple[float, float, float, float, float, float, float, float]:
    """Return S0, S1, T0, T1 and their derivatives by k, at places as in `integrals` of harmonics/series.py."""
    k1 = table.k + 1.0
    z = TWO_PI * (whole + x)
    if z < SWITCH:
        i = int(2.0 * z)
        t = fma(4.0 * TWO_PI, x, -(2.0 * i + 1.0)) + 4.0 * (TWO_PI_LOW * x + TWO_PI * x_low)
        s0, s1, _, _ = horner4(table.bins[i], t)
        s0_k, s1_k, _, _ = horner4(change.bins[i], t)
        t0, t1 = horner2(cosine_bins[_COSINE_BIN * i : _COSINE_BIN * (i + 1)], t)
        t0_k, t1_k = horner2(cosine_change[_COSINE_BIN * i : _COSINE_BIN * (i + 1)], t)
        return z * s0, z * s1, t0, t1, z * s0_k, z * s1_k, t0_k, t1_k
    inverse = 1.0 / z
    w = SWITCH * inverse
    w = 2.0 * (w * w) - 1.0
    p0, q0, p1, q1, g0, g1, _, _ = horner8(table.tail, w)
    p0_k, q0_k, p1_k, q1_k, g0_k, g1_k, _, _ = horner8(change.tail, w)
    q0, q1, q0_k, q1_k = q0 * inverse, q1 * inverse, q0_k * inverse, q1_k * inverse
    sine, cosine = sine_cosine_of_turns(x)
    shift = TWO_PI * x_low
    sine, cosine = sine + shift * cosine, cosine - shift * sine
    power = amplitude_power(table, z)
    s = power * (sine * table.cos_phase - cosine * table.sin_phase)
    c = power * (cosine * table.cos_phase + sine * table.sin_phase)
    fall = -0.5 * math.log(z)
    s_k = fall * s + power * (sine * change.cos_phase - cosine * change.sin_phase)
    c_k = fall * c + power * (cosine * change.cos_phase + sine * change.sin_phase)
    wave1, other1 = q1 * s - p1 * c, p1 * s + q1 * c
    wave1_k = q1_k * s - p1_k * c + q1 * s_k - p1 * c_k
    other1_k = p1_k * s + q1_k * c + p1 * s_k + q1 * c_k
    return (
        g0 * inverse + (p0 * s + q0 * c),
        inverse * (g1 + k1 * wave1),
        p0 * c - q0 * s,
        inverse * k1 * other1,
        g0_k * inverse + (p0_k * s + q0_k * c) + (p0 * s_k + q0 * c_k),
        inverse * (g1_k + wave1 + k1 * wave1_k),
        p0_k * c - q0_k * s + p0 * c_k - q0 * s_k,
        inverse * (other1 + k1 * other1_k),
    )


@kernel(contract=True)
def sums_by_k(
    table: Table, waves: Flat, series: Harmonics, change: Table, wave_change: Flat, x: float, whole: float
) -> tuple[float, float, float, float]:
    """Return w0 and w1 of harmonics/series.py at whole + x > 0, and their derivatives by k.

    Parameters
    ----------
    table, waves, series, x, whole
        As those of `sums`.
    change, wave_change
        The derivatives of the table and of `waves` (`change_of`).
    """
    if waves.size > COSINES and series.shape[0] > 0 and waves[COSINES] * (whole + x) >= 1.0:
        w0, w1, _, _ = tabulated_sums(table, waves, x, whole)
        w0_k, w1_k, _, _ = tabulated_sums(table, wave_change, x, whole)
        if whole + x >= NEAR:
            z = TWO_PI * (whole + x)
            slow0, slow1 = slow_sums(waves, z)
            fall = -0.5 * math.log(z)
            w0_k, w1_k = w0_k + fall * (w0 - slow0), w1_k + fall * (w1 - slow1)
        return w0, w1, w0_k, w1_k
    w0, w1, w0_k, w1_k = 0.0, 0.0, 0.0, 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        even, odd = n * series[i, 1], n * series[i, 2]
        product = n * x
        s0, s1, t0, t1, s0_k, s1_k, t0_k, t1_k = _integrals_by_k(
            table, waves, change, wave_change, product, fma(n, x, -product), n * whole
        )
        w0 += even * s0 + odd * t0
        w1 += even * (s0 - s1) + odd * (t0 - t1)
        w0_k += even * s0_k + odd * t0_k
        w1_k += even * (s0_k - s1_k) + odd * (t0_k - t1_k)
    return w0, w1, w0_k, w1_k


def change_of(
    own: tuple[Any, Floats], others: list[tuple[Any, Floats]], weights: Floats
) -> tuple[NDArray[Any], Floats]:
    """Return the derivatives by k of a table, as an array of one record, and of the flat array that goes with it.

    Parameters
    ----------
    own
        The table and the flat array of the exponent.
    others, weights
        Those of neighbouring exponents, and their weights in d/dk.
    """
    change = np.array([own[0]], dtype=own[0].dtype)
    for name in ("bins", "tail", "cos_phase", "sin_phase"):
        change[name][0] = sum(weight * table[name] for weight, (table, _) in zip(weights, others, strict=True))
    flat = np.asarray(sum(weight * waves for weight, (_, waves) in zip(weights, others, strict=True)))
    if flat.size > COSINES:
        flat[COSINES] = own[1][COSINES]
    return change, flat
