"""Contact without adhesion over a disc of radius a (3.9), (3.10), in closed form, and the integrals of its waves.

    delta_H(a) = a^(1-k) int_0^a f'(s) (a^2-s^2)^((k-1)/2) ds
    P_H(a)     = K [a^(1+k) delta_H - I],   I = int_0^a f'(s) (a^2-s^2)^((k+1)/2) ds,   K = 2^(1-k) M/(1+k)

For f1 = r^m/(m R^(m-1)) both integrals are powers, (5.5) and (5.6) as corrected in docs/theory.md. Those of waves are

    S_j = int_0^1 (1-t^2)^((k-1)/2 + j) sin(z t) dt,   C_j = int_0^1 (1-t^2)^((k-1)/2 + j) cos(z t) dt,   z = 2 pi x

x being the contact radius over the wavelength: S_j belongs to a cosine of the profile and is a Struve function, C_j
belongs to a sine and is a Bessel function, sqrt(pi)/2 G(n+1/2) (2/z)^n J_n(z), n = k/2 + j; (5.7)-(5.14) need no
others. They are those of core/table/functions.py, good to 1e-15 of each function or of its local amplitude, whichever
is larger; the phase of the rounded z loses about 1e-15 x beyond.
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any, Final, TypeAlias

import numpy as np
from scipy.special import gamma

from gradhesion.core.equations._arguments import Array, Real, exponent_of, not_negative, positive, power_of
from gradhesion.core.jit import kernel
from gradhesion.core.table.functions import Functions, functions_of, pairs_at

Harmonics: TypeAlias = Sequence[tuple[int, Any, Any]]
"""(n, a_n, b_n) of each harmonic, numbers or arrays."""
_LOAD_UNIT: Final = 1.5 * math.pi  # 1.5 pi R dgamma over R dgamma
_LARGEST: Final = 2.0**49  # turns beyond which a double resolves no phase
_kept: Final = lru_cache(maxsize=16)(functions_of)
"""For repeated calls with a few points each."""


@kernel
def _fill(functions: Functions, z: Array, out: Array) -> None:
    """Put S0, C0, S1 and C1 at each z (n,) into the rows of `out`, of shape (4, n)."""
    for i in range(z.size):
        out[0, i], out[1, i], out[2, i], out[3, i] = pairs_at(functions, z[i])


def _integrals(k: Real, x: Real) -> tuple[Array, Array, Array]:
    """Return k and z, broadcast and NaN out of range, and S0, C0, S1, C1 and dS0/dz in an array with one axis more."""
    exponents, points = np.broadcast_arrays(exponent_of(k), not_negative(x))
    z = np.where(np.isnan(exponents) | (points >= _LARGEST), np.nan, 2.0 * math.pi * points)
    out = np.full((5, *z.shape), np.nan)
    for exponent in np.unique(exponents[~np.isnan(z)]):
        place = ~np.isnan(z) & (exponents == exponent)
        values = np.empty((4, np.count_nonzero(place)))
        _fill(_kept(float(exponent)), z[place], values)
        out[:4, place] = values
    out[4] = (1.0 - z * out[2]) / (1.0 + exponents)
    return exponents, z, out


def sine_integrals(k: Real, x: Real) -> Array:
    """Return S0, S1, dS0/dz = (1 - z S1)/(1+k) and dS1/dz = ((1+k) S0 - (2+k) S1)/z at z = 2 pi x.

    On a homogeneous half-space S0 is pi/2 times the Struve function of order 0:

    >>> from scipy.special import struve
    >>> np.allclose(sine_integrals(0.0, [0.1, 0.7])[0], np.pi / 2 * struve(0, 2 * np.pi * np.array([0.1, 0.7])))
    True
    """
    exponents, z, (s0, _, s1, _, slope) = _integrals(k, x)
    far = ((1.0 + exponents) * s0 - (2.0 + exponents) * s1) / np.where(z == 0.0, 1.0, z)
    return np.stack([s0, s1, slope, np.where(z == 0.0, 1.0 / (3.0 + exponents), far)])


def cosine_integrals(k: Real, x: Real) -> Array:
    """Return C0 and C1 at z = 2 pi x.

    At k = 1 the first is sin(z)/z:

    >>> cosine_integrals(1.0, [0.25, 0.5]).round(12)[0].tolist()
    [0.636619772368, 0.0]
    """
    return _integrals(k, x)[2][1:4:2]


def cosine_wave(amplitude: Real) -> Harmonics:
    """Return the wave A (1 - cos 2 pi xi) as harmonics."""
    return [(1, -not_negative(amplitude), 0.0)]


def wave_terms(k: Real, radius: Real, wavelength: Real, waves: Harmonics) -> tuple[Array, Array, Array]:
    """Return what harmonics add to delta_H, to I/a^(1+k) and to a delta_H', over R (B1)-(B4).

        2 pi a sum n [-a_n S0(n z) + b_n C0(n z)],   2 pi a sum n [-a_n S1(n z) + b_n C1(n z)]

    A harmonic n is a wave n times shorter.
    """
    a = not_negative(radius)
    x = a / positive(wavelength)
    depth = moment = rise = 0.0 * (x + exponent_of(k))
    for n, cosine, sine in waves:
        if np.any(cosine) or np.any(sine):
            exponents, z, (s0, c0, s1, c1, slope) = _integrals(k, n * x)
            front = 2.0 * math.pi * n * a
            depth = depth + front * (sine * c0 - cosine * s0)
            moment = moment + front * (sine * c1 - cosine * s1)
            rise = rise + front * (sine * (c0 - z * z * c1 / (1.0 + exponents)) - cosine * (s0 + z * slope))
    return depth, moment, rise


def over_disc(
    k: Real, radius: Real, wavelength: Real, waves: Harmonics, exponent: Real = 2.0
) -> tuple[Array, Array, Array]:
    """Return delta_H, P_H/(K a^(1+k)) = delta_H - I/a^(1+k) and a delta_H', over R, of a power and harmonics."""
    n, m = 1.0 + exponent_of(k), power_of(exponent)
    smooth = power_indentation(k, radius, m)
    depth, moment, rise = wave_terms(k, radius, wavelength, waves)
    return smooth + depth, smooth * m / (n + m) + (depth - moment), m * smooth + rise


def disc_stiffness(k: Real, stiffness: Real, radius: Real) -> Array:
    """Return K a^(1+k), the load over the depth of a flat disc, in 1.5 pi R dgamma over R.

    On a homogeneous half-space 2 E* a:

    >>> float(disc_stiffness(0.0, 500.0, 0.3) * 1.5 * math.pi)
    300.0
    """
    n = 1.0 + exponent_of(k)
    return 2.0 ** (2.0 - n) * positive(stiffness) / n * not_negative(radius) ** n / _LOAD_UNIT


def power_indentation(k: Real, radius: Real, exponent: Real = 2.0) -> Array:
    """Return delta_H/R of the smooth part (5.5): G(m/2) G((1+k)/2)/(2 G((1+k+m)/2)) a^m.

    A paraboloid has a^2/((1+k) R):

    >>> power_indentation([0.0, 0.5], 0.3).round(12).tolist()
    [0.09, 0.06]
    """
    n, m = 1.0 + exponent_of(k), power_of(exponent)
    return 0.5 * gamma(0.5 * m) * gamma(0.5 * n) / gamma(0.5 * (n + m)) * not_negative(radius) ** m


def power_moment(k: Real, radius: Real, exponent: Real = 2.0) -> Array:
    """Return I/R^(2+k) of the smooth part (5.6), (1+k)/(1+k+m) a^(1+k) times its delta_H."""
    n, m = 1.0 + exponent_of(k), power_of(exponent)
    return power_indentation(k, radius, m) * n / (n + m) * not_negative(radius) ** n


def wave_indentation(k: Real, radius: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return the part of delta_H/R that a cosine wave adds, 2 pi A a S0(2 pi a/lambda); at k = 1 the wave itself."""
    return wave_terms(k, radius, wavelength, cosine_wave(amplitude))[0]


def wave_moment(k: Real, radius: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return the part of I/R^(2+k) that a cosine wave adds, 2 pi A a^(2+k) S1(2 pi a/lambda)."""
    moment = wave_terms(k, radius, wavelength, cosine_wave(amplitude))[1]
    return moment * not_negative(radius) ** (1.0 + exponent_of(k))


def indentation(k: Real, radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return delta_H/R, the depth of contact without adhesion over a disc, of a power and one cosine wave (3.9).

    Accurate to a few units in the last place of its largest term.
    """
    return over_disc(k, radius, wavelength, cosine_wave(amplitude), exponent)[0]


def load(k: Real, stiffness: Real, radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return P_H/(1.5 pi R dgamma), the load of contact over a disc without adhesion (3.10).

    Hertz: 4 E* a^3/(3 R):

    >>> float((load(0.0, 500.0, 0.3, 0.1, 0.0) * 1.5 * math.pi).round(10))
    18.0
    """
    raised = over_disc(k, radius, wavelength, cosine_wave(amplitude), exponent)[1]
    return disc_stiffness(k, stiffness, radius) * raised
