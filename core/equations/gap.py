"""The gap between the surfaces outside the contact (2.2), reference quality: one quadrature per point.

    gap(r) = u_z(r) - delta + f(r) = (2/pi) cos(k pi/2) int_a^r s^k (delta_H(s) - delta) (r^2-s^2)^(-(1+k)/2) ds

which is (3.5) with the adhesive part (4.10), in one integral. Contact over one disc requires gap(r) >= 0 for all r > a;
delta_H(s) >= delta for all s > a is sufficient. The integral is a sum of Gauss rules: Jacobi's in the last panel, which
takes the singular end r by its weight, and Legendre's in panels that grow from there by a factor of 2 to at most half a
wave, and likewise from a, where s^k is not smooth at s = 0. As k tends to 1 all of the weight moves to r: that part is
left out of the sum. For millions of points this is slow.
"""

import math
from collections.abc import Callable
from typing import Final

import numpy as np
from scipy.special import roots_legendre

from gradhesion.core.equations import _abel, general, hertz, profile
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

_NODES: Final = 24
_LEGENDRE: Final = roots_legendre(_NODES)


def gap(
    k: Real, distance: Real, radius: Real, depth: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return gap/R at a distance r from the axis, around contact over a disc of radius a at a depth delta (2.2).

    It is negative where the surfaces would overlap. Accurate to 1e-12 of the largest delta_H between a and r
    (tests/core/equations/test_gap.py).

    A profile that rises everywhere, and yet no contact over one disc:

    >>> from gradhesion.core.equations import jkr
    >>> depth = jkr.indentation(0.0, 1e7, 0.0511, 0.1, 4.59 * 0.1 / (4 * np.pi**2))
    >>> float(gap(0.0, 0.0811, 0.0511, depth, 0.1, 4.59 * 0.1 / (4 * np.pi**2)).round(6))
    -0.00026
    """

    def at(k: float, r: float, a: float, level: float, length: float, size: float, m: float) -> float:
        return _gap(k, r, a, length, lambda s: hertz.indentation(k, s, length, size, m) - level)

    power, size = power_of(exponent), not_negative(amplitude)
    return point_by_point(
        at, exponent_of(k), positive(distance), positive(radius), depth, positive(wavelength), size, power
    )


def surface(
    k: Real, distance: Real, radius: Real, depth: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return u_z/R, how far the surface of the half-space is pressed in at a distance r >= a (3.5), (4.10).

    Around a flat disc on a homogeneous half-space the depth falls as (2/pi) asin(a/r). Here a paraboloid is pulled out
    by 1 from its Hertzian depth, and the difference is that of a flat disc:

    >>> shapes = surface(0.0, 0.2, 0.1, [0.01, -0.99], 0.1, 0.0)
    >>> float((shapes[0] - shapes[1]).round(12))
    0.333333333333
    """
    opening = gap(k, distance, radius, depth, wavelength, amplitude, exponent)
    return opening + np.asarray(depth, dtype=float) - profile.height(distance, wavelength, amplitude, exponent)


def series_gap(
    k: Real,
    distance: Real,
    radius: Real,
    depth: Real,
    wavelength: Real,
    cosines: Waves,
    sines: Waves = (),
    exponent: Real = 2.0,
) -> Array:
    """Return gap/R around a punch whose waviness is a Fourier series (2.2)."""
    shortest = max(1, len(cosines), len(sines))

    def at(k: float, r: float, a: float, level: float, length: float, m: float) -> float:
        return _gap(
            k, r, a, length / shortest, lambda s: general.hertz_indentation(k, s, length, cosines, sines, m) - level
        )

    power = power_of(exponent)
    return point_by_point(at, exponent_of(k), positive(distance), positive(radius), depth, positive(wavelength), power)


def series_surface(
    k: Real,
    distance: Real,
    radius: Real,
    depth: Real,
    wavelength: Real,
    cosines: Waves,
    sines: Waves = (),
    exponent: Real = 2.0,
) -> Array:
    """Return u_z/R, how far the surface is pressed in outside a punch of any series (4.3), (4.10)."""
    opening = series_gap(k, distance, radius, depth, wavelength, cosines, sines, exponent)
    r, m, length = positive(distance), power_of(exponent), positive(wavelength)
    height = r**m / m + length * general.waviness(r / length, cosines, sines)
    return opening + np.asarray(depth, dtype=float) - height


def _gap(k: float, r: float, a: float, shortest: float, opening: Callable[[Array], Array]) -> float:
    """Return the gap at one point r, from delta_H - delta; NaN for r < a."""
    if r < a:
        return math.nan
    c = 0.5 * (1.0 - k)
    if r == a:  # at k = 1 the surface gives way where it is pressed alone
        return float(opening(np.asarray(r))) if c == 0.0 else 0.0

    def density(s: Array) -> Array:
        """Return the integrand times (r-s)^(1-c)."""
        return s**k * opening(s) * (r + s) ** (c - 1.0)

    edges = _panels(a, r, 0.5 * shortest)
    centre, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * (edges[1:] - edges[:-1])
    nodes, weights = _LEGENDRE
    s = (centre[:-1, None] + half[:-1, None] * nodes).ravel()
    total = np.sum((half[:-1, None] * weights).ravel() * density(s) * (r - s) ** (c - 1.0))
    # the last panel less density(r), with the weight (r-s)^c; density(r) has an integral in closed form
    nodes, weights = _abel.jacobi_rule(c, 0.0)
    s, at_end = centre[-1] + half[-1] * nodes, density(np.asarray(r))
    total -= half[-1] ** (1.0 + c) * np.sum(weights * (at_end - density(s)) / (r - s))
    wave = math.pi * c
    share = math.sin(wave) / wave if c > 0.0 else 1.0
    return float(2.0 / math.pi * math.sin(wave) * total + 2.0 * share * (r - edges[-2]) ** c * at_end)


def _panels(a: float, r: float, widest: float) -> Array:
    """Return the edges of panels from a to r: no wider than `widest`, than their distance from 0, or from r."""
    last = r - min(0.5 * (r - a), widest)
    edges = [a]
    while edges[-1] < last:
        low = edges[-1]
        edges.append(min(last, low + min(widest, low, 0.5 * (r - low))))
    return np.array([*edges, r])


describe(__name__)
