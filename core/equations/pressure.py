"""The pressure under the punch (3.1), (3.4), (4.2), (4.9).

    p(r) = (1+k) K/(2 pi) { int_r^a (s^2-r^2)^((k-1)/2) delta_H'(s) ds - (delta_H - delta) (a^2-r^2)^((k-1)/2) }

for r < a, compression positive. The integral is the contact without adhesion (3.4); the second term is a flat punch
(3.1) that is pulled out by delta_H - delta, which is Delta in equilibrium (4.9). P = 2 pi int r p dr. For k < 1 the
pressure is infinite at the edge r = a, unless delta = delta_H; at k = 1 it is finite there. The profile is a power and
a Fourier series as in general.py; one cosine wave is cosines = [-A].
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.equations import _abel, hertz
from gradhesion.core.equations._arguments import (
    Array,
    Real,
    Waves,
    describe,
    exponent_of,
    not_negative,
    point_by_point,
    positive,
    power_of,
)
from gradhesion.core.equations.general import harmonics, hertz_indentation
from gradhesion.core.equations.pair import cosine_integrals, sine_integrals


def pressure_unit(radius_of_punch: ArrayLike, work_of_adhesion: ArrayLike) -> Array:
    """Return dgamma/R in Pa, by which pressures are multiplied for SI units."""
    return np.asarray(work_of_adhesion, dtype=float) / np.asarray(radius_of_punch, dtype=float)


def flat_pressure(k: Real, stiffness: Real, distance: Real, radius: Real, depth: Real) -> Array:
    """Return p R/dgamma under a flat-ended cylinder, pressed in by a depth (3.1).

    Infinite at r = a for k < 1. Accurate to a few units in the last place, of r and a that are given.

    Boussinesq: E* delta/(pi sqrt(a^2-r^2)) on a homogeneous half-space.

    >>> float((flat_pressure(0.0, 500.0, 0.12, 0.13, 0.02) * np.pi).round(9))
    200.0
    """
    n, r, a = 1.0 + exponent_of(k), not_negative(distance), positive(radius)
    inside = np.where(r <= a, (a - r) * (a + r), np.nan)
    pressed = np.asarray(depth, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.where(n < 2.0, inside ** (0.5 * n - 1.0), 1.0 + 0.0 * inside)
        return np.where(pressed == 0.0, 0.0 * inside, _front(n - 1.0, positive(stiffness)) * pressed * root)


def hertz_pressure(
    k: Real,
    stiffness: Real,
    distance: Real,
    radius: Real,
    wavelength: Real,
    cosines: Waves,
    sines: Waves = (),
    exponent: Real = 2.0,
) -> Array:
    """Return p_H R/dgamma of contact without adhesion over a disc of radius a (3.4).

    Zero at r = a. Accurate to 1e-12 of its largest value. At r = 0 it is infinite for k = 0 where the profile has a
    slope there (a cone, or a series of sines with sum n b_n not 0).

    Hertz: 2 E* sqrt(a^2-r^2)/(pi R).

    >>> float((hertz_pressure(0.0, 500.0, 0.12, 0.13, 1.0, []) * np.pi).round(9))
    50.0
    """
    waves = harmonics(cosines, sines)

    def at(k: float, r: float, a: float, length: float, m: float, stiffness: float) -> float:
        return float(_front(k, stiffness)) * _integral(k, r, a, length, waves, m) if r <= a else math.nan

    r, a, material = not_negative(distance), positive(radius), positive(stiffness)
    return point_by_point(at, exponent_of(k), r, a, positive(wavelength), power_of(exponent), material)


def pressure(
    k: Real,
    stiffness: Real,
    distance: Real,
    radius: Real,
    depth: Real,
    wavelength: Real,
    cosines: Waves,
    sines: Waves = (),
    exponent: Real = 2.0,
) -> Array:
    """Return p R/dgamma under a punch at any depth, over a disc of radius a (4.2); in equilibrium (4.9).

    Positive in compression. For k < 1 it is minus infinity at r = a where delta < delta_H, as in equilibrium, plus
    infinity where delta > delta_H. Accurate to 1e-12 of the largest of both terms.

    An adhesive contact is pulled at its edge:

    >>> from gradhesion.core.equations import general
    >>> depth = general.indentation(0.3, 500.0, 0.2, 0.1, [-0.02])
    >>> pressure(0.3, 500.0, [0.0, 0.19, 0.2], 0.2, depth, 0.1, [-0.02]).round(1).tolist()
    [-3.4, -59.0, -inf]
    """
    lowered = np.asarray(depth, dtype=float) - hertz_indentation(k, radius, wavelength, cosines, sines, exponent)
    flat = flat_pressure(k, stiffness, distance, radius, lowered)
    return hertz_pressure(k, stiffness, distance, radius, wavelength, cosines, sines, exponent) + flat


def indentation_slope(
    k: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return delta_H'(a), the slope of the depth of contact without adhesion over the contact radius."""
    a, m = positive(radius), power_of(exponent)
    smooth = m * hertz.power_indentation(k, a, m) / a
    return smooth + _wave_slope(k, a, wavelength, harmonics(cosines, sines))


def _front(k: ArrayLike, stiffness: ArrayLike) -> Array:
    """Return (1+k) K/(2 pi)."""
    return 2.0 ** (1.0 - np.asarray(k)) * np.asarray(stiffness) / (2.0 * math.pi)


def _wave_slope(k: ArrayLike, a: ArrayLike, wavelength: ArrayLike, waves: list[tuple[int, float, float]]) -> Array:
    """Return the part of delta_H' that the waves add."""
    x = np.asarray(a, dtype=float) / positive(wavelength)
    total = np.zeros(np.broadcast_shapes(np.shape(k), x.shape))
    for n, a_n, b_n in waves:
        y = 2.0 * math.pi * n * x
        if a_n != 0.0:
            s0, _, slope, _ = sine_integrals(k, n * x)
            total = total - 2.0 * math.pi * n * a_n * (s0 + y * slope)
        if b_n != 0.0:
            c0, c1 = cosine_integrals(k, n * x)
            total = total + 2.0 * math.pi * n * b_n * (c0 - y * y * c1 / (1.0 + np.asarray(k)))
    return total


def _integral(k: float, r: float, a: float, length: float, waves: list[tuple[int, float, float]], m: float) -> float:
    """Return int_r^a (s^2-r^2)^((k-1)/2) delta_H'(s) ds."""
    if r == a:
        return 0.0
    shown = [wave for wave in waves if wave[1] != 0.0 or wave[2] != 0.0]
    widest = 0.5 * length / shown[-1][0] if shown else math.inf
    front = m * float(hertz.power_indentation(k, 1.0, m))
    if r > 0.0:
        s, weights = _abel.beyond(r, a, 0.5 * (k - 1.0), widest)
        slope = front * s ** (m - 1.0) + (_wave_slope(k, s, length, shown) if shown else 0.0)
        return float(np.sum(weights * slope))
    smooth = front * a ** (k + m - 1.0) / (k + m - 1.0) if k + m > 1.0 else math.inf
    if not shown:
        return smooth
    first = float(_wave_slope(k, 0.0, length, shown))  # of the profile's own slope at its apex
    if first != 0.0 and k == 0.0:
        return math.copysign(math.inf, first) + smooth
    s, weights = _abel.from_zero(a, k, widest)
    rest = float(np.sum(weights * (_wave_slope(k, s, length, shown) - first) / s))
    return smooth + rest + (first * a**k / k if first != 0.0 else 0.0)


describe(__name__)
