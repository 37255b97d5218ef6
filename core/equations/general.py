"""Punches of a power and any periodic waviness, (2.1), (5.1)-(5.14), and the edge of their contact, (4.4), (4.5).

    f(r) = f1 + lambda f2(r/lambda),   f1 = r^m/(m R^(m-1)),   f2 = A (1 - cos 2 pi xi) or any Fourier series:
    f2(xi) = a0/2 + sum_n [a_n cos(2 pi n xi) + b_n sin(2 pi n xi)],   f2(0) = 0, so that a0/2 = -sum a_n
    a_n = 2 int_{-1/2}^{1/2} f2(xi) cos(2 pi n xi) d(xi),   b_n = 2 int_{-1/2}^{1/2} f2(xi) sin(2 pi n xi) d(xi)

One cosine wave is cosines = [-A]. The edge of the contact is a crack:

    K_I = sqrt(2 pi) lim_{r->a} (a-r)^((1-k)/2) p(r) = -2^(1-k) M (delta_H - delta) (2a)^((k-1)/2)/sqrt(2 pi)
    G   = K_I^2/(2 M) = dgamma ((delta_H - delta)/Delta)^2,   G = dgamma in equilibrium

K_I is negative where the edge is pulled open, as p is positive in compression. The printed (4.5) has 2^(1+k/2) for
2^(1-k/2): with it (4.4) does not hold for k > 0.
"""

import math
from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.equations import hertz, jkr
from gradhesion.core.equations._arguments import Array, Real, Waves, exponent_of, not_negative, positive, power_of

DEEPEST_SINC: Final = 0.21723362821122164
"""-min sin(y)/y, met at tan y = y, y = 4.4934094579090642 (a zero of the spherical Bessel function j_1)."""
_MOST: Final = 2**20  # most samples of a period


def height(radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return the height f(r)/R of the punch over its apex, with one cosine wave, at a distance from its axis (2.1)."""
    r, m, length = not_negative(radius), power_of(exponent), positive(wavelength)
    return r**m / m + 2.0 * not_negative(amplitude) * length * np.sin(math.pi * r / length) ** 2


def slope(radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return f'(r), the slope of the punch with one cosine wave, at a distance from its axis."""
    r, m, length = not_negative(radius), power_of(exponent), positive(wavelength)
    smooth = np.where(np.isnan(m), np.nan, r ** (m - 1.0))  # 1 to the power of NaN is 1
    return smooth + 2.0 * math.pi * not_negative(amplitude) * np.sin(2.0 * math.pi * r / length)


def largest_monotonic_amplitude(wavelength: Real) -> Array:
    """Return the largest A at which a wavy paraboloid without a rim still rises everywhere.

    A <= 4.6033 lambda/(4 pi^2 R), where 1/4.6033 = -min sin(y)/y. A monotonic profile is the paper's condition for
    contact over one disc, after Guduru (2007). It is not sufficient: see `quadrature.gap`.

    >>> float(largest_monotonic_amplitude(0.1).round(6))
    0.01166
    """
    return positive(wavelength) / (4.0 * math.pi**2 * DEEPEST_SINC)


def is_monotonic(wavelength: Real, amplitude: Real) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Return whether a wavy paraboloid without a rim rises everywhere; False outside the ranges."""
    return np.asarray(not_negative(amplitude) <= largest_monotonic_amplitude(wavelength))


def sampled_coefficients(heights: ArrayLike, terms: int) -> tuple[list[float], list[float]]:
    """Return the coefficients of a waviness that is sampled at equal steps over one period (5.13), (5.14).

    Returns
    -------
    The lists a_1, a_2, ... and b_1, b_2, ... Exact to rounding for a series of fewer than N - terms harmonics. Other
    arguments, and samples that are not finite, are a ValueError.
    """
    values = np.asarray(heights, dtype=float)
    if values.ndim != 1 or not np.isfinite(values).all():
        raise ValueError("heights are to be finite numbers along one dimension: the samples of one period")
    if not 1 <= terms <= (values.size - 1) // 2:
        most = max(0, (values.size - 1) // 2)
        raise ValueError(f"terms = {terms}: {values.size} samples hold 1 to {most} harmonics; take more samples")
    found = 2.0 / values.size * np.fft.rfft(values)[1 : terms + 1]
    return found.real.tolist(), (-found.imag).tolist()


def coefficients(waviness: Callable[[Array], Array], terms: int) -> tuple[list[float], list[float]]:
    """Return the coefficients of a waviness that is given as a function (5.13), (5.14).

    A wave of flat valleys: A (1 - cos)^2 = A (3/2 - 2 cos + cos(2 .)/2).

    >>> cosines, _ = coefficients(lambda xi: 0.01 * (1 - np.cos(2 * np.pi * xi)) ** 2, 3)
    >>> [round(a_n, 12) + 0.0 for a_n in cosines]
    [-0.02, 0.005, 0.0]

    Returns
    -------
    The lists a_1, a_2, ... and b_1, b_2, ... Samples are doubled until no coefficient changes by more than 1e-11 of the
    largest |f2|. One with corners needs some 2^19 samples; one with steps, which 2^20 do not resolve, or one that is
    not finite is a ValueError.
    """
    if terms < 1:
        raise ValueError(f"terms = {terms}: a series has one harmonic or more")
    count, before = 4, np.full((2, terms), np.inf)
    while count < 4 * terms:
        count *= 2
    while count <= _MOST:
        heights = np.broadcast_to(np.asarray(waviness(np.arange(count) / count), dtype=float), (count,))
        now = np.array(sampled_coefficients(heights, terms))
        if np.abs(now - before).max() <= 1e-11 * np.abs(heights).max():
            return now[0].tolist(), now[1].tolist()
        before, count = now, 2 * count
    raise ValueError(f"the waviness is not resolved by {_MOST:,} samples of its period; it is to be continuous")


def harmonics(cosines: Waves, sines: Waves = ()) -> list[tuple[int, float, float]]:
    """Return (n, a_n, b_n) of every harmonic, the shorter list filled up with zeros (B11)."""
    count = max(len(cosines), len(sines))
    pairs = zip([*cosines, *[0.0] * (count - len(cosines))], [*sines, *[0.0] * (count - len(sines))], strict=True)
    return [(n, float(a_n), float(b_n)) for n, (a_n, b_n) in enumerate(pairs, start=1)]


def waviness(xi: Real, cosines: Waves, sines: Waves = ()) -> Array:
    """Return f2(xi), the waviness over its wavelength (5.12); f2(0) = 0.

    >>> waviness([0.25, 0.5], [-0.02], [0.0, 0.01]).round(12).tolist()
    [0.02, 0.04]
    """
    turns = np.asarray(xi, dtype=float)
    total = np.zeros(turns.shape)
    for n, a_n, b_n in harmonics(cosines, sines):
        total = total - 2.0 * a_n * np.sin(math.pi * n * turns) ** 2 + b_n * np.sin(2.0 * math.pi * n * turns)
    return total


def hertz_indentation(
    k: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return delta_H/R, the depth of contact over a disc without adhesion (3.9), (B1)."""
    return hertz.over_disc(k, radius, wavelength, harmonics(cosines, sines), exponent)[0]


def hertz_load(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return P_H/(1.5 pi R dgamma), the load of contact over a disc without adhesion (3.10), (B2)."""
    raised = hertz.over_disc(k, radius, wavelength, harmonics(cosines, sines), exponent)[1]
    return hertz.disc_stiffness(k, stiffness, radius) * raised


def indentation(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return the depth delta/R in adhesive equilibrium (4.8), (5.8), (5.12)-(5.14)."""
    hertzian = hertz_indentation(k, radius, wavelength, cosines, sines, exponent)
    return hertzian - jkr.adhesive_depth(k, stiffness, radius)


def load(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return the load P/(1.5 pi R dgamma) in adhesive equilibrium (4.7), (5.9), (5.12)-(5.14)."""
    pull = hertz.disc_stiffness(k, stiffness, radius) * jkr.adhesive_depth(k, stiffness, radius)
    return hertz_load(k, stiffness, radius, wavelength, cosines, sines, exponent) - pull


def stress_intensity(
    k: Real, stiffness: Real, radius: Real, depth: Real,
    wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0,
) -> Array:  # fmt: skip
    """Return K_I R^((1+k)/2)/dgamma at the edge of a disc of radius a at any depth (4.5).

    In equilibrium -sqrt(2 M dgamma), which is -sqrt(2 stiffness) in this unit, whatever the punch.

    >>> depth = indentation(0.3, 500.0, [0.1, 0.2], 0.1, [-0.02])
    >>> (stress_intensity(0.3, 500.0, [0.1, 0.2], depth, 0.1, [-0.02]) ** 2 / 1000.0).round(12).tolist()
    [1.0, 1.0]
    """
    n, a = 1.0 + exponent_of(k), positive(radius)
    lowered = np.asarray(depth, dtype=float) - hertz_indentation(k, a, wavelength, cosines, sines, exponent)
    return 2.0 ** (2.0 - n) * positive(stiffness) / math.sqrt(2.0 * math.pi) * lowered * (2.0 * a) ** (0.5 * n - 1.0)


def energy_release_rate(
    k: Real, stiffness: Real, radius: Real, depth: Real,
    wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0,
) -> Array:  # fmt: skip
    """Return G/dgamma at the edge of a disc of radius a at any depth (4.4), for any series; 1 is equilibrium."""
    lowered = np.asarray(depth, dtype=float) - hertz_indentation(k, radius, wavelength, cosines, sines, exponent)
    return (lowered / jkr.adhesive_depth(k, stiffness, positive(radius))) ** 2
