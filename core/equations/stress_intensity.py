"""The edge of the contact as a crack: its stress intensity and energy release rate (4.4), (4.5).

    K_I = sqrt(2 pi) lim_{r->a} (a-r)^((1-k)/2) p(r) = -2^(1-k) M (delta_H - delta) (2a)^((k-1)/2)/sqrt(2 pi)
    G   = K_I^2/(2 M) = dgamma ((delta_H - delta)/Delta)^2,   G = dgamma in equilibrium

K_I is negative where the edge is pulled open, as p is positive in compression. The printed (4.5) has 2^(1+k/2) for
2^(1-k/2): with it (4.4) does not hold for k > 0. The profile is that of general.py; G of one cosine wave is
`jkr.energy_release_rate`. Lengths are in R, K_I in dgamma/R^((1+k)/2), M in dgamma/R^(1+k).
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.equations import general, jkr
from gradhesion.core.equations._arguments import Array, Real, Waves, describe, exponent_of, positive


def stress_intensity(
    k: Real,
    stiffness: Real,
    radius: Real,
    depth: Real,
    wavelength: Real,
    cosines: Waves,
    sines: Waves = (),
    exponent: Real = 2.0,
) -> Array:
    """Return K_I R^((1+k)/2)/dgamma at the edge of a disc of radius a at any depth (4.5).

    In equilibrium -sqrt(2 M dgamma), whatever the punch.

    >>> depth = general.indentation(0.3, 500.0, [0.1, 0.2], 0.1, [-0.02])
    >>> (stress_intensity(0.3, 500.0, [0.1, 0.2], depth, 0.1, [-0.02]) ** 2 / 1000.0).round(12).tolist()
    [1.0, 1.0]
    """
    opening = _opening(k, radius, depth, wavelength, cosines, sines, exponent)
    n, a = 1.0 + exponent_of(k), positive(radius)
    front = 2.0 ** (2.0 - n) * positive(stiffness) / math.sqrt(2.0 * math.pi)
    return -front * opening * (2.0 * a) ** (0.5 * n - 1.0)


def energy_release_rate(
    k: Real,
    stiffness: Real,
    radius: Real,
    depth: Real,
    wavelength: Real,
    cosines: Waves,
    sines: Waves = (),
    exponent: Real = 2.0,
) -> Array:
    """Return G/dgamma at the edge of a disc of radius a at any depth (4.4), for any series; 1 is equilibrium."""
    opening = _opening(k, radius, depth, wavelength, cosines, sines, exponent)
    return (opening / jkr.adhesive_depth(k, stiffness, positive(radius))) ** 2


def _opening(
    k: ArrayLike,
    radius: ArrayLike,
    depth: ArrayLike,
    wavelength: ArrayLike,
    cosines: Sequence[float],
    sines: Sequence[float],
    exponent: ArrayLike,
) -> Array:
    """Return delta_H - delta."""
    hertzian = general.hertz_indentation(k, positive(radius), wavelength, cosines, sines, exponent)
    return hertzian - np.asarray(depth, dtype=float)


describe(__name__)
