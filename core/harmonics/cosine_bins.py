"""The integrals that belong to the sines of a profile, below z = 40, as polynomials in the bins of bins.py.

    T_j = int_0^1 (1 - t^2)^((k-1)/2 + j) cos(z t) dt,    j = 0, 1

Bessel functions of the orders k/2 and 1 + k/2 times powers of z. They obey the equations of the pair S_0, S_1 without
the part that has no wave,

    z T0'' + (k+1) T0' + z T0 = 0,    T0' = -z T1/(1+k),    T1' = ((1+k) T0 - (2+k) T1)/z

so that no slope needs polynomials of its own: none cancels. From z = 40 on the tail of the pair is used (large.py):
T_j = Re[...] of what S_j is G_j + Im[...].

Accuracy: on 1,800 points of nine k (z up to 2,500) the error of T0 and T1 is at most 1.0e-15 of the larger of the
function and its local amplitude, against mpmath's Bessel functions.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers import double_double as dd
from gradhesion.core.struve.bins import (
    ECONOMISATION,
    TAYLOR,
    at_next_centre,
    differentiate,
    economise,
    over_z,
    taylor_of,
)
from gradhesion.core.struve.layout import BIN_TERMS, BIN_WIDTH, BINS
from gradhesion.core.types import Floats

_SERIES: Final = 12
"""Terms of the power series at z = 1/4."""


@kernel()
def integral_at_zero(k: float) -> float:
    """Return T0(0) = sqrt(pi)/2 G((1+k)/2)/G(1+k/2)."""
    return 0.5 * math.sqrt(math.pi) * math.gamma(0.5 * (1.0 + k)) / math.gamma(1.0 + 0.5 * k)


@kernel()
def _start(k: float, z: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return T0 and T0' at a small z from T0 = sum c_n z^(2n), c_n = -c_(n-1)/(2n (2n+k))."""
    term = (integral_at_zero(k), 0.0)
    value, slope = term, (0.0, 0.0)
    for n in range(1, _SERIES):
        even = 2.0 * n
        term = dd.divide(dd.scale(term, -z * z), dd.scale(dd.two_sum(even, k), even))
        value = dd.add(value, term)
        slope = dd.add(slope, dd.scale(term, even / z))
    return value, slope


@kernel(entry=True)
def _fill(k: float, bins: Floats, matrix: Floats) -> None:
    """Fill bins, of shape (BINS, BIN_TERMS, 4), with T0, T1 and their slopes; `matrix` is ECONOMISATION of bins.py."""
    half = 0.5 * BIN_WIDTH
    t0 = np.zeros((TAYLOR + 2, 2))
    t0_slope = np.zeros((TAYLOR + 2, 2))
    t1 = np.zeros((TAYLOR, 2))
    minus_k1 = dd.scale(dd.two_sum(1.0, k), -1.0)
    value, slope = _start(k, half)
    for i in range(len(bins)):
        centre = BIN_WIDTH * i + half
        t0[0, 0], t0[0, 1] = value
        t0[1, 0], t0[1, 1] = dd.scale(slope, half)
        taylor_of(t0, k, centre, half, 0.0)
        differentiate(t0, t0_slope, half)
        over_z(t0_slope[:TAYLOR], t1, centre, half)
        for n in range(TAYLOR):
            t1[n, 0], t1[n, 1] = dd.multiply((t1[n, 0], t1[n, 1]), minus_k1)
        economise(t0[:TAYLOR], matrix, bins[i, :, 0])
        economise(t1, matrix, bins[i, :, 1])
        value = at_next_centre(t0, TAYLOR + 2)
        slope = at_next_centre(t0_slope, TAYLOR + 1)


def build_cosine_bins(k: float) -> Floats:
    """Return T0 and T1 of the gradient exponent 0 <= k <= 1 in t = 4 z - (2 bin + 1), of shape (80, 11, 2)."""
    bins = np.zeros((BINS, BIN_TERMS, 2))
    _fill(float(k), bins, ECONOMISATION)
    return bins
