"""The profile of the punch (2.1): a power of the radius and a cosine wave.

    f(r) = f1 + lambda f2(r/lambda),   f1 = r^m/(m R^(m-1)),   f2(xi) = A (1 - cos 2 pi xi)

with m = 2 for a paraboloid. Source: (2.1) and section 5 of Jin, Guo & Wan (2013).
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.equations._arguments import Array, Real, describe, not_negative, positive, power_of

DEEPEST_SINC: Final = 0.21723362821122164
"""-min sin(y)/y, met at tan y = y, y = 4.4934094579090642 (a zero of the spherical Bessel function j_1)."""


def height(radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return the height f/R of the punch over its apex (2.1)."""
    r, m, length = not_negative(radius), power_of(exponent), positive(wavelength)
    half_turn = np.sin(math.pi * r / length)
    return r**m / m + 2.0 * not_negative(amplitude) * length * half_turn**2


def slope(radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return f'(r), the slope of the punch."""
    r, m, length = not_negative(radius), power_of(exponent), positive(wavelength)
    return r ** (m - 1.0) + 2.0 * math.pi * not_negative(amplitude) * np.sin(2.0 * math.pi * r / length)


def largest_monotonic_amplitude(wavelength: Real) -> Array:
    """Return the largest A at which a wavy paraboloid without a rim still rises everywhere.

      f' >= 0 for all r requires A <= 4.6033 lambda/(4 pi^2 R), where 1/4.6033 = -min sin(y)/y. A monotonic profile is
      the paper's condition for contact over one disc, after Guduru (2007). It is not sufficient: see gap.py.

    >>> float(largest_monotonic_amplitude(0.1).round(6))
    0.01166
    """
    return positive(wavelength) / (4.0 * math.pi**2 * DEEPEST_SINC)


def is_monotonic(wavelength: Real, amplitude: Real) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Return whether a wavy paraboloid without a rim rises everywhere.

    Returns
    -------
    Boolean array of the broadcast shape; False outside the ranges.
    """
    return np.asarray(not_negative(amplitude) <= largest_monotonic_amplitude(wavelength))


describe(__name__)
