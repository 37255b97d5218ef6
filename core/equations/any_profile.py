"""A punch of any smooth profile, by quadrature of its slope (3.9), (3.10), (5.1)-(5.4).

    delta_H(a) = a^(1-k) int_0^a f'(s) (a^2-s^2)^((k-1)/2) ds
    P_H(a)     = K [a^(1+k) delta_H - I],   I = int_0^a f'(s) (a^2-s^2)^((k+1)/2) ds
    delta = delta_H - Delta,   P = P_H - K a^(1+k) Delta

f' is a function of the radius: that of f1 alone, or of the whole punch f1'(s) + f2'(s/lambda). Both integrals are
linear in it, so that parts may be added: f1 by this module, a Fourier series by general.py. For r^m/(m R^(m-1)) the
results are those of hertz.py.
"""

import math
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.equations import _abel, hertz, jkr
from gradhesion.core.equations._arguments import Array, Real, describe, exponent_of, not_negative

Slope: TypeAlias = Callable[[Array], ArrayLike]


def hertz_indentation(k: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return delta_H/R, the depth of contact over a disc without adhesion (3.9).

    Accurate to 1e-13 of a times the largest slope.

    A sphere in the place of its paraboloid, f' = r/sqrt(1-r^2); at k = 1 depth is the profile:

    >>> float(hertz_indentation(1.0, 0.6, lambda r: r / np.sqrt(1 - r**2)).round(12))
    0.2
    """
    return _integrals(k, radius, slope, shortest)[0]


def hertz_load(k: Real, stiffness: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return P_H/(1.5 pi R dgamma), the load of contact over a disc without adhesion (3.10)."""
    depth, mean = _integrals(k, radius, slope, shortest)
    return hertz.disc_stiffness(k, stiffness, radius) * (depth - mean)


def indentation(k: Real, stiffness: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return the depth delta/R in adhesive equilibrium (4.8), (5.1), (5.3)."""
    return hertz_indentation(k, radius, slope, shortest) - jkr.adhesive_depth(k, stiffness, radius)


def load(k: Real, stiffness: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return the load P/(1.5 pi R dgamma) in adhesive equilibrium (4.7), (5.2), (5.4).

    A sphere adheres a little less than its paraboloid, here with E* R/dgamma = 500:

    >>> a = np.linspace(0.1, 0.3, 201)
    >>> float(load(0.0, 500.0, a, lambda r: r / np.sqrt(1 - r**2)).min().round(4))
    -0.9855
    """
    pull = hertz.disc_stiffness(k, stiffness, radius) * jkr.adhesive_depth(k, stiffness, radius)
    return hertz_load(k, stiffness, radius, slope, shortest) - pull


def _integrals(k: ArrayLike, radius: ArrayLike, slope: Slope, shortest: float) -> tuple[Array, Array]:
    """Return delta_H and I/a^(1+k)."""
    exponents, radii = np.broadcast_arrays(exponent_of(k), not_negative(radius))
    depth, mean = np.full(radii.shape, np.nan), np.full(radii.shape, np.nan)
    for place in np.ndindex(radii.shape):
        gradient, a = float(exponents[place]), float(radii[place])
        if math.isnan(gradient + a):
            continue
        if a == 0.0:
            depth[place] = mean[place] = 0.0
            continue
        s, weights = _abel.below(a, 0.5 * (gradient - 1.0), 0.5 * shortest)
        values = weights * np.asarray(slope(s), dtype=float)
        depth[place] = a ** (1.0 - gradient) * np.sum(values)
        mean[place] = a ** (-1.0 - gradient) * np.sum(values * (a - s) * (a + s))
    return depth, mean


describe(__name__)
