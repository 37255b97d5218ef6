"""The universal functions of a gradient exponent, by which every harmonic contributes to depth and load.

    S(K, z) = int_0^1 (1 - t^2)^((K-1)/2) sin zt dt        C(K, z) = int_0^1 (1 - t^2)^((K-1)/2) cos zt dt

(Struve's and Bessel's functions times a power.) Those of K = k give the depth, those of K = k + 2 the load. Both solve
z f'' + (K+1) f' + z f = 1 (S) or 0 (C). They are evaluated by a power series below z = 2, by Taylor polynomials in bins
of width 1/2 below z = 40, built from the equation, and by steepest descent beyond.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.jit import allocating, kernel
from gradhesion.core.types import Floats

FIRST: Final = 2.0
"""Where the bins begin."""
LAST: Final = 40.0
"""Where they end, and the expansions begin."""
BINS: Final = 76
TERMS: Final = 13
"""Coefficients of a bin: (1/4)^13/13! is below 1e-17."""
TAIL: Final = 16
"""Terms of each expansion: the smallest ones at z = 40."""
_NOTHING: Final = 1e-18
"""Terms below are no part of a series that begins with 1."""
_MORE: Final = 8
"""Further coefficients by which a bin is continued to the next."""


class Functions(NamedTuple):
    """S and C of K = k (first) and K = k + 2 (second), ready to be evaluated.

    bins        coefficients of S and C in each bin, in t = 4 (z - its centre), of shape (2, BINS, 2, TERMS)
    real        of P(z), the expansion at t = 1, in powers of 1/z^2: its real part, (2, TAIL)
    imaginary   its imaginary part times z, (2, TAIL)
    slow        of z G(z), the expansion at t = 0, in powers of 1/z^2, (2, TAIL)
    phase       amplitude 2^a G(1+a) times cosine and sine of pi (1+K)/4, a = (K-1)/2, and C(K, 0), (2, 3)
    """

    k: float
    bins: Floats
    real: Floats
    imaginary: Floats
    slow: Floats
    phase: Floats


@kernel
def _by_series(K: float, z: float) -> tuple[float, float, float, float]:
    """Return S, S', C/C(0) and C'/C(0) at z up to about 2.5 by their power series."""
    square = -z * z
    term = 1.0 / (1.0 + K)
    sine, sine_slope = term, term
    cosine_term = cosine = 1.0
    cosine_slope = 0.0
    for n in range(1, 20):
        term *= square / ((2 * n + 1.0) * (2 * n + 1.0 + K))
        sine += term
        sine_slope += (2 * n + 1) * term
        cosine_term *= square / (2 * n * (2 * n + K))
        cosine += cosine_term
        cosine_slope += 2 * n * cosine_term
        if abs(cosine_term) < _NOTHING:  # the other terms are smaller
            break
    return sine * z, sine_slope, cosine, cosine_slope / z


@allocating
def _fill_bins(K: float, at_zero: float, bins: Floats) -> None:
    """Put Taylor coefficients of S and C into `bins` (BINS, 2, TERMS), from the equation; `at_zero` is C(K, 0)."""
    half = 1.0 / 4.0
    sine, sine_slope, cosine, cosine_slope = _by_series(K, FIRST + half)
    value = np.array([sine, cosine * at_zero])
    slope = np.array([sine_slope, cosine_slope * at_zero])
    taylor = np.zeros(TERMS + _MORE)
    for i in range(BINS):
        centre = FIRST + half + 2.0 * half * i
        for lane in range(2):
            taylor[0], taylor[1] = value[lane], slope[lane] * half
            for n in range(taylor.size - 2):
                rest = -half * (n + 1.0) * (n + K + 1.0) * taylor[n + 1] - half * half * centre * taylor[n]
                if n > 0:
                    rest -= half**3 * taylor[n - 1]
                elif lane == 0:
                    rest += half * half
                taylor[n + 2] = rest / (centre * (n + 1.0) * (n + 2.0))
            for n in range(TERMS):  # one by one: an assignment of arrays takes seconds to compile
                bins[i, lane, n] = taylor[n]
            ahead, rise = 0.0, 0.0  # at the centre of the next bin, t = 2
            for n in range(taylor.size - 1, -1, -1):
                rise = rise * 2.0 + ahead
                ahead = ahead * 2.0 + taylor[n]
            value[lane], slope[lane] = ahead, rise / half


@kernel
def _fill_tail(K: float, real: Floats, imaginary: Floats, slow: Floats) -> None:
    """Put the coefficients of the expansions for large z into arrays (TAIL,)."""
    a = 0.5 * (K - 1.0)
    end, start = 1.0, 1.0
    for n in range(2 * TAIL):
        sign = 1.0 if n % 4 < 2 else -1.0
        if n % 2 == 0:
            real[n // 2] = end * sign
        else:
            imaginary[n // 2] = end * sign
        end *= (a - n) * (1.0 + a + n) / (2.0 * (n + 1.0))
        if n < TAIL:
            slow[n] = start
            start *= (a - n) * 2.0 * (2.0 * n + 1.0)


@allocating
def functions_of(k: float) -> Functions:
    """Return the functions of an exponent k, about -0.01 to 1.01: 40 microseconds."""
    bins, phase = np.zeros((2, BINS, 2, TERMS)), np.zeros((2, 3))
    real, imaginary, slow = np.zeros((2, TAIL)), np.zeros((2, TAIL)), np.zeros((2, TAIL))
    for pair in range(2):
        K = k + 2.0 * pair
        at_zero = 0.5 * math.sqrt(math.pi) * math.gamma(0.5 * (1.0 + K)) / math.gamma(1.0 + 0.5 * K)
        amplitude = 2.0 ** (0.5 * (K - 1.0)) * math.gamma(0.5 * (1.0 + K))
        phase[pair, 0] = amplitude * math.cos(0.25 * math.pi * (1.0 + K))
        phase[pair, 1] = amplitude * math.sin(0.25 * math.pi * (1.0 + K))
        phase[pair, 2] = at_zero
        _fill_bins(K, at_zero, bins[pair])
        _fill_tail(K, real[pair], imaginary[pair], slow[pair])
    return Functions(k, bins, real, imaginary, slow, phase)


@kernel
def _pair(functions: Functions, which: int, z: float, sine: float, cosine: float, power: float) -> tuple[float, float]:
    """Return S and C of K = k (`which` = 0) or k + 2 (1) at z; `power` is z^(-(1+K)/2), needed like sin z beyond 40."""
    if z < FIRST:
        S, _, C, _ = _by_series(functions.k + 2.0 * which, z)
        return S, C * functions.phase[which, 2]
    if z < LAST:
        i = int(2.0 * z) - 4
        t = 4.0 * (z - (FIRST + 0.25 + 0.5 * i))
        S, C = 0.0, 0.0
        for n in range(TERMS - 1, -1, -1):
            S = S * t + functions.bins[which, i, 0, n]
            C = C * t + functions.bins[which, i, 1, n]
        return S, C
    inverse = 1.0 / z
    square = inverse * inverse
    real, imaginary, slow = 0.0, 0.0, 0.0
    for n in range(TAIL - 1 if z < 80.0 else 6, -1, -1):
        real = real * square + functions.real[which, n]
        imaginary = imaginary * square + functions.imaginary[which, n]
        slow = slow * square + functions.slow[which, n]
    imaginary *= inverse
    s = sine * functions.phase[which, 0] - cosine * functions.phase[which, 1]
    c = cosine * functions.phase[which, 0] + sine * functions.phase[which, 1]
    return slow * inverse + power * (s * real + c * imaginary), power * (c * real - s * imaginary)


@kernel
def pairs_at(functions: Functions, z: float) -> tuple[float, float, float, float]:
    """Return S0, C0 (K = k) and S1, C1 (K = k + 2) at z > 0, to 1e-15 of their amplitude and the rounding of z."""
    sine = cosine = power = 0.0
    if z >= LAST:
        sine, cosine, power = math.sin(z), math.cos(z), z ** (-0.5 * (1.0 + functions.k))
    S0, C0 = _pair(functions, 0, z, sine, cosine, power)
    S1, C1 = _pair(functions, 1, z, sine, cosine, power / z)
    return S0, C0, S1, C1
