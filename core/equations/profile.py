"""The profile of the punch (2.1): a power of the radius and a cosine wave.

    f(r) = f1 + lambda f2(r/lambda),   f1 = r^m/(m R^(m-1)),   f2(xi) = A (1 - cos 2 pi xi)

with m = 2 for a paraboloid. Source: (2.1) and section 5 of Jin, Guo & Wan (2013). All lengths are in R.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.equations._domain import Array, not_negative, positive, power_of

DEEPEST_SINC: Final = 0.21723362821122164
"""-min sin(y)/y, met at tan y = y, y = 4.4934094579090642 (a zero of the spherical Bessel function j_1)."""


def height(radius: ArrayLike, wavelength: ArrayLike, amplitude: ArrayLike, exponent: ArrayLike = 2.0) -> Array:
    """Return the height f/R of the punch over its apex (2.1).

    Parameters
    ----------
    radius
        r/R >= 0.
    wavelength
        lambda/R > 0.
    amplitude
        A, amplitude over wavelength, >= 0.
    exponent
        m >= 1: 1 is a cone, 2 a paraboloid.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges.

    Examples
    --------
    >>> height([0.0, 0.05, 0.1], 0.1, 0.02).round(6).tolist()
    [0.0, 0.00525, 0.005]
    """
    r, m, length = not_negative(radius), power_of(exponent), positive(wavelength)
    half_turn = np.sin(math.pi * r / length)
    return r**m / m + 2.0 * not_negative(amplitude) * length * half_turn**2


def slope(radius: ArrayLike, wavelength: ArrayLike, amplitude: ArrayLike, exponent: ArrayLike = 2.0) -> Array:
    """Return f'(r), the slope of the punch.

    Parameters
    ----------
    radius, wavelength, amplitude, exponent
        As in `height`.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges.

    Examples
    --------
    >>> slope([0.0, 0.025], 0.1, 0.02).round(6).tolist()
    [0.0, 0.150664]
    """
    r, m, length = not_negative(radius), power_of(exponent), positive(wavelength)
    return r ** (m - 1.0) + 2.0 * math.pi * not_negative(amplitude) * np.sin(2.0 * math.pi * r / length)


def largest_monotonic_amplitude(wavelength: ArrayLike) -> Array:
    """Return the largest A at which a wavy paraboloid without a rim still rises everywhere.

    f' >= 0 for all r asks for A <= 4.6033 lambda/(4 pi^2 R), where 1/4.6033 = -min sin(y)/y. A monotonic profile is
    the paper's condition for contact over one disc, after Guduru (2007). It is not sufficient: see gap.py.

    Parameters
    ----------
    wavelength
        lambda/R > 0.

    Returns
    -------
    Array of the shape of `wavelength`; NaN outside the range.

    Examples
    --------
    >>> float(largest_monotonic_amplitude(0.1).round(6))
    0.01166
    """
    return positive(wavelength) / (4.0 * math.pi**2 * DEEPEST_SINC)


def is_monotonic(wavelength: ArrayLike, amplitude: ArrayLike) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Return whether a wavy paraboloid without a rim rises everywhere.

    Parameters
    ----------
    wavelength
        lambda/R > 0.
    amplitude
        A, amplitude over wavelength, >= 0.

    Returns
    -------
    Boolean array of the broadcast shape; False outside the ranges.

    Examples
    --------
    >>> is_monotonic(0.1, [0.011, 0.012]).tolist()
    [True, False]
    """
    return np.asarray(not_negative(amplitude) <= largest_monotonic_amplitude(wavelength))
