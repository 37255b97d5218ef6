"""The integrals in which all waviness is contained, for arrays of exponents and radii.

    S_j = int_0^1 (1-t^2)^((k-1)/2 + j) sin(z t) dt,   C_j = int_0^1 (1-t^2)^((k-1)/2 + j) cos(z t) dt,   z = 2 pi x

x is the contact radius over the wavelength. S_j belongs to a cosine of the profile and is a Struve function, C_j
belongs to a sine and is a Bessel function. (5.7)-(5.14) of Jin, Guo & Wan (2013) need no others.
"""

import math
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import beta, gamma, jv

from gradhesion.core.equations._arguments import Gradient, documented
from gradhesion.core.equations._domain import Array, exponent_of, not_negative
from gradhesion.core.struve.table import struve_pair

_LARGEST = 2.0**49
"""Turns beyond which a double resolves no phase."""
Turns = Annotated[ArrayLike, "Contact radius over wavelength, 0 <= x < 2**49."]


@documented
def sine_integrals(k: Gradient, x: Turns) -> Array:
    """Return S0, S1, dS0/dz and dS1/dz at z = 2 pi x.

    Returns
    -------
    Array of shape (4, *broadcast shape); NaN outside the ranges. Accurate to 1e-15 of each function or of its local
    amplitude, whichever is larger (core/struve/table.py).

    Examples
    --------
    On a homogeneous half-space S0 is pi/2 times the Struve function of order 0:

    >>> from scipy.special import struve
    >>> np.allclose(sine_integrals(0.0, [0.1, 0.7])[0], np.pi / 2 * struve(0, 2 * np.pi * np.array([0.1, 0.7])))
    True
    """
    exponents, points = np.broadcast_arrays(exponent_of(k), not_negative(x))
    out = np.full((4, *exponents.shape), np.nan)
    valid = ~np.isnan(exponents) & (points < _LARGEST)
    for exponent in np.unique(exponents[valid]):
        place = valid & (exponents == exponent)
        out[:, place] = struve_pair(float(exponent), points[place])
    return out


@documented
def cosine_integrals(k: Gradient, x: Turns) -> Array:
    """Return C0 and C1 at z = 2 pi x.

      C_j = sqrt(pi)/2 G(n+1/2) (2/z)^n J_n(z), n = k/2 + j.

    Returns
    -------
    Array of shape (2, *broadcast shape); NaN outside the ranges. Absolute accuracy 1e-13 of the local amplitude for
    x <= 100; the phase of the rounded z loses about 1e-15 x beyond.

    Examples
    --------
    At k = 1 the first is sin(z)/z:

    >>> cosine_integrals(1.0, [0.25, 0.5]).round(12)[0].tolist()
    [0.636619772368, 0.0]
    """
    exponents, points = np.broadcast_arrays(exponent_of(k), not_negative(x))
    z = 2.0 * math.pi * np.where(points < _LARGEST, points, np.nan)
    out = np.empty((2, *exponents.shape))
    for j in (0, 1):
        order = 0.5 * exponents + j
        small = z < 1e-3
        wide = np.where(small, 1.0, z)
        far = 0.5 * math.sqrt(math.pi) * gamma(order + 0.5) * (2.0 / wide) ** order * jv(order, wide)
        # three terms of the power series leave z^6/2304
        quarter = 0.25 * z * z
        series = 1.0 - quarter / (order + 1.0) * (1.0 - quarter / (2.0 * (order + 2.0)))
        near = 0.5 * beta(0.5, order + 0.5) * series
        out[j] = np.where(small, near, far)
    return out
