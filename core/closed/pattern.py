"""The area of a contact on a pattern of toughness, each part weighted by its work of adhesion.

int_0^a 2 pi r kappa^2 dr      kappa^2 = t of a pattern of work, t^2 of one of toughness (problem/toughness.py)
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.toughness import Toughness, rows_of_pattern

_SMALL = 0.7
"""Phase below which x cos x - sin x is summed as a series: seven terms leave 1e-17 of it."""


def _moments(x: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the integrals of u cos(x u) and u sin(x u) over u from 0 to 1, of the shape of x > 0."""
    half = np.sin(0.5 * x) / (0.5 * x)
    even = np.sin(x) / x - 0.5 * half * half
    term, odd = x / 3.0, np.zeros(x.shape)
    for j in range(1, 9):
        odd = odd + term
        term = -term * x * x / (2.0 * j * (2.0 * j + 3.0))
    return even, np.where(x < _SMALL, odd, (np.sin(x) / x - np.cos(x)) / x)


def pattern_area(
    toughness: Toughness, amplitude: ArrayLike, wavelength: ArrayLike, radius: ArrayLike
) -> NDArray[np.float64]:
    """Return int_0^a 2 pi r kappa^2 dr in R^2, of the broadcast shape: pi a^2 where there is no pattern.

    Parameters
    ----------
    toughness
        The pattern.
    amplitude, wavelength
        `toughness_amplitude` and `toughness_wavelength_over_R` > 0.
    radius
        a/R >= 0, finite.

    Examples
    --------
    >>> from gradhesion.core.problem.toughness import ToughnessHarmonic
    >>> pattern = Toughness((ToughnessHarmonic(n=1, cos=0.2),))
    >>> round(float(pattern_area(pattern, 1.0, 0.1, 0.5)) / (math.pi * 0.25), 12)  # 1 + 0.2^2/2 over whole waves
    1.02
    """
    size, length, a = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in (amplitude, wavelength, radius)))
    linear = {int(n): complex(even, -odd) for n, even, odd in rows_of_pattern(toughness)}  # Re of c exp(i n phase)
    square: dict[int, complex] = {}
    for n, one in linear.items() if toughness.of == "toughness" else ():
        for m, other in linear.items():
            square[n + m] = square.get(n + m, 0.0) + 0.5 * one * other
            product = one * other.conjugate() if n >= m else one.conjugate() * other
            square[abs(n - m)] = square.get(abs(n - m), 0.0) + 0.5 * product
    doubled = 2.0 if toughness.of == "toughness" else 1.0
    total = np.full(a.shape, 0.5)
    for terms, factor in ((linear, doubled * size), (square, size * size)):
        for n, value in terms.items():
            x = np.maximum(2.0 * math.pi * n / length * a, 1e-300)
            even, odd = _moments(x) if n else (0.5, 0.0)
            total = total + factor * (value.real * even - value.imag * odd)
    area: NDArray[np.float64] = 2.0 * math.pi * a * a * total
    return area


def toughness_at(
    toughness: Toughness, amplitude: ArrayLike, wavelength: ArrayLike, radius: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return kappa at radii a/R, and its slopes by ln a and by ln of the amplitude, of the broadcast shape.

    By the logarithm of the wavelength it changes as by that of the radius, with the other sign. The arguments are those
    of `pattern_area`.
    """
    size, length, a = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in (amplitude, wavelength, radius)))
    waves, outwards = np.zeros(a.shape), np.zeros(a.shape)
    for n, even, odd in rows_of_pattern(toughness):
        turns = n * a / length
        phase = 2.0 * math.pi * (turns % 1.0)
        waves = waves + even * np.cos(phase) + odd * np.sin(phase)
        outwards = outwards + 2.0 * math.pi * turns * (odd * np.cos(phase) - even * np.sin(phase))
    series = 1.0 + size * waves
    if toughness.of == "toughness":
        return series, size * outwards, size * waves
    kappa = np.sqrt(series)
    return kappa, 0.5 * size * outwards / kappa, 0.5 * size * waves / kappa
