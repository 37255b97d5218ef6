"""The integrals in which all waviness is contained, for arrays of exponents and radii.

    S_j = int_0^1 (1-t^2)^((k-1)/2 + j) sin(z t) dt,   C_j = int_0^1 (1-t^2)^((k-1)/2 + j) cos(z t) dt,   z = 2 pi x

x is the contact radius over the wavelength. S_j belongs to a cosine of the profile and is a Struve function, C_j
belongs to a sine and is a Bessel function, sqrt(pi)/2 G(n+1/2) (2/z)^n J_n(z), n = k/2 + j. (5.7)-(5.14) of Jin, Guo &
Wan (2013) need no others. They are those of core/table/functions.py, good to 1e-15 of each function or of its local
amplitude, whichever is larger; the phase of the rounded z loses about 1e-15 x beyond.
"""

import math
from functools import lru_cache
from typing import Final

import numpy as np

from gradhesion.core.equations._arguments import Array, Real, describe, exponent_of, not_negative
from gradhesion.core.jit import kernel
from gradhesion.core.table.functions import Functions, functions_of, pairs_at

_LARGEST: Final = 2.0**49
"""Turns beyond which a double resolves no phase."""
_kept: Final = lru_cache(maxsize=16)(functions_of)
"""For repeated calls with a few points each."""


@kernel
def _fill(functions: Functions, z: Array, out: Array) -> None:
    """Put S0, C0, S1 and C1 at each z (n,) into the rows of `out`, of shape (4, n)."""
    for i in range(z.size):
        out[0, i], out[1, i], out[2, i], out[3, i] = pairs_at(functions, z[i])


def _integrals(k: Real, x: Real) -> tuple[Array, Array, Array]:
    """Return k and z, broadcast and NaN out of range, and S0, C0, S1 and C1 in an array with one axis more."""
    exponents, points = np.broadcast_arrays(exponent_of(k), not_negative(x))
    z = np.where(np.isnan(exponents) | (points >= _LARGEST), np.nan, 2.0 * math.pi * points)
    out = np.full((4, *z.shape), np.nan)
    for exponent in np.unique(exponents[~np.isnan(z)]):
        place = ~np.isnan(z) & (exponents == exponent)
        values = np.empty((4, np.count_nonzero(place)))
        _fill(_kept(float(exponent)), z[place], values)
        out[:, place] = values
    return exponents, z, out


def sine_integrals(k: Real, x: Real) -> Array:
    """Return S0, S1, dS0/dz = (1 - z S1)/(1+k) and dS1/dz = ((1+k) S0 - (2+k) S1)/z at z = 2 pi x.

    On a homogeneous half-space S0 is pi/2 times the Struve function of order 0:

    >>> from scipy.special import struve
    >>> np.allclose(sine_integrals(0.0, [0.1, 0.7])[0], np.pi / 2 * struve(0, 2 * np.pi * np.array([0.1, 0.7])))
    True
    """
    exponents, z, (s0, _, s1, _) = _integrals(k, x)
    some = np.where(z > 0.0, z, 1.0)
    slope = np.where(z > 0.0, ((1.0 + exponents) * s0 - (2.0 + exponents) * s1) / some, 1.0 / (3.0 + exponents))
    return np.stack([s0, s1, (1.0 - z * s1) / (1.0 + exponents), np.where(np.isnan(z), np.nan, slope)])


def cosine_integrals(k: Real, x: Real) -> Array:
    """Return C0 and C1 at z = 2 pi x.

    At k = 1 the first is sin(z)/z:

    >>> cosine_integrals(1.0, [0.25, 0.5]).round(12)[0].tolist()
    [0.636619772368, 0.0]
    """
    return _integrals(k, x)[2][1::2]


describe(__name__)
