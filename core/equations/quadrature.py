"""What takes a quadrature: punches of any smooth profile, the pressure under a punch, and the gap around it.

    p(r)   = (1+k) K/(2 pi) { int_r^a (s^2-r^2)^((k-1)/2) delta_H'(s) ds - (delta_H - delta) (a^2-r^2)^((k-1)/2) }
    gap(r) = u_z(r) - delta + f(r) = (2/pi) cos(k pi/2) int_a^r s^k (delta_H(s) - delta) (r^2-s^2)^(-(1+k)/2) ds

beside (3.9) and (3.10), as in hertz.py. In the pressure (r < a, compression positive) the integral is the contact
without adhesion (3.4); the second term is a flat punch (3.1) that is pulled out by delta_H - delta, which is Delta in
equilibrium (4.9). The gap is (3.5) with the adhesive part (4.10). Contact over one disc requires gap(r) >= 0 for all
r > a (2.2); delta_H(s) >= delta for all s > a is sufficient.

All are integrals of Abel's kind: sums of Gauss rules, Jacobi's in the panel at the singular end, which takes it by its
weight, and Legendre's in the others. Panels are no wider than half the shortest wave of what is integrated, than their
distance from the singular end, and than that from s = 0, where profiles have branch points of their own: the error of
24 points is then below 1e-14 of the largest value. Each point has its own quadrature, which is slow for millions.
"""

import math
from collections.abc import Callable
from functools import lru_cache, partial
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import roots_jacobi, roots_legendre

from gradhesion.core.equations import general, hertz, jkr
from gradhesion.core.equations._arguments import Array, Real, Waves, exponent_of, not_negative, positive, power_of

Slope: TypeAlias = Callable[[Array], ArrayLike]
_NODES: Final = 24
_LEGENDRE: Final = roots_legendre(_NODES)
_rule: Final = lru_cache(maxsize=64)(roots_jacobi)
"""Jacobi's rule on (-1, 1), kept: it takes as long as the panels of a point."""
_LEAST: Final = 2.0**-57
"""Width of the panel at s = 0, over that of all: the integral of a bounded function over it is below rounding."""


def hertz_indentation(k: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return delta_H/R, the depth of contact over a disc without adhesion, of any profile (3.9).

    Accurate to 1e-13 of a times the largest slope. A sphere, f' = r/sqrt(1-r^2); at k = 1 depth is the profile:

    >>> float(hertz_indentation(1.0, 0.6, lambda r: r / np.sqrt(1 - r**2)).round(12))
    0.2
    """
    return _over_disc(k, radius, slope, shortest, 0)


def hertz_load(k: Real, stiffness: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return P_H/(1.5 pi R dgamma), the load of contact over a disc without adhesion, of any profile (3.10)."""
    raised = _over_disc(k, radius, slope, shortest, 0) - _over_disc(k, radius, slope, shortest, 1)
    return hertz.disc_stiffness(k, stiffness, radius) * raised


def indentation(k: Real, stiffness: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return the depth delta/R in adhesive equilibrium, of any profile (4.8), (5.1), (5.3)."""
    return hertz_indentation(k, radius, slope, shortest) - jkr.adhesive_depth(k, stiffness, radius)


def load(k: Real, stiffness: Real, radius: Real, slope: Slope, shortest: float = math.inf) -> Array:
    """Return the load P/(1.5 pi R dgamma) in adhesive equilibrium, of any profile (4.7), (5.2), (5.4)."""
    pull = hertz.disc_stiffness(k, stiffness, radius) * jkr.adhesive_depth(k, stiffness, radius)
    return hertz_load(k, stiffness, radius, slope, shortest) - pull


def pressure_unit(radius_of_punch: ArrayLike, work_of_adhesion: ArrayLike) -> Array:
    """Return dgamma/R in Pa, by which pressures are multiplied for SI units."""
    return np.asarray(work_of_adhesion, dtype=float) / np.asarray(radius_of_punch, dtype=float)


def flat_pressure(k: Real, stiffness: Real, distance: Real, radius: Real, depth: Real) -> Array:
    """Return p R/dgamma under a flat-ended cylinder, pressed in by a depth (3.1).

    Infinite at r = a for k < 1. Boussinesq, k = 0: E* delta/(pi sqrt(a^2-r^2)).

    >>> float((flat_pressure(0.0, 500.0, 0.12, 0.13, 0.02) * np.pi).round(9))
    200.0
    """
    n, r, a = 1.0 + exponent_of(k), not_negative(distance), positive(radius)
    inside, pressed = np.where(r <= a, (a - r) * (a + r), np.nan), np.asarray(depth, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        root = inside ** (0.5 * n - 1.0) + 0.0 * inside  # NaN to the power of 0 is 1
        return np.where(pressed == 0.0, 0.0 * inside, _front(k, stiffness) * pressed * root)


def hertz_pressure(
    k: Real, stiffness: Real, distance: Real, radius: Real,
    wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0,
) -> Array:  # fmt: skip
    """Return p_H R/dgamma of contact without adhesion over a disc of radius a (3.4).

    Zero at r = a, NaN beyond. Accurate to 1e-12 of its largest value. At r = 0 and k = 0 it is infinite, with the sign
    of the slope, where the profile has one there (a cone, or a series of sines with sum n b_n not 0). Hertz:
    2 E* sqrt(a^2-r^2)/(pi R).

    >>> float((hertz_pressure(0.0, 500.0, 0.12, 0.13, 1.0, []) * np.pi).round(9))
    50.0
    """
    pressed = partial(_pressed, general.harmonics(cosines, sines))
    numbers = exponent_of(k), not_negative(distance), positive(radius), positive(wavelength), power_of(exponent)
    return _front(k, stiffness) * _point_by_point(pressed, *numbers)


def pressure(
    k: Real, stiffness: Real, distance: Real, radius: Real, depth: Real,
    wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0,
) -> Array:  # fmt: skip
    """Return p R/dgamma under a punch at any depth, over a disc of radius a (4.2); in equilibrium (4.9).

    Positive in compression; for k < 1 infinite at r = a, downwards where delta < delta_H, as in equilibrium. Accurate
    to 1e-12 of the largest of both terms. At its edge it pulls:

    >>> depth = general.indentation(0.3, 500.0, 0.2, 0.1, [-0.02])
    >>> pressure(0.3, 500.0, [0.0, 0.19, 0.2], 0.2, depth, 0.1, [-0.02]).round(1).tolist()
    [-3.4, -59.0, -inf]
    """
    hertzian = general.hertz_indentation(k, radius, wavelength, cosines, sines, exponent)
    flat = flat_pressure(k, stiffness, distance, radius, np.asarray(depth, dtype=float) - hertzian)
    return hertz_pressure(k, stiffness, distance, radius, wavelength, cosines, sines, exponent) + flat


def indentation_slope(
    k: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return delta_H'(a), the slope of the depth of contact without adhesion over the contact radius."""
    a = positive(radius)
    return hertz.over_disc(k, a, wavelength, general.harmonics(cosines, sines), exponent)[2] / a


def gap(
    k: Real, distance: Real, radius: Real, depth: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return gap/R at a distance r from the axis, around contact over a disc of radius a at a depth delta (2.2).

    It is negative where the surfaces would overlap. Accurate to 1e-12 of the largest delta_H between a and r. A profile
    that rises everywhere, and yet no contact over one disc:

    >>> depth = jkr.indentation(0.0, 1e7, 0.0511, 0.1, 4.59 * 0.1 / (4 * np.pi**2))
    >>> float(gap(0.0, 0.0811, 0.0511, depth, 0.1, 4.59 * 0.1 / (4 * np.pi**2)).round(6))
    -0.00026
    """
    return _gaps(hertz.cosine_wave, not_negative(amplitude), k, distance, radius, depth, wavelength, exponent)


def surface(
    k: Real, distance: Real, radius: Real, depth: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return u_z/R, how far the surface of the half-space is pressed in at a distance r >= a (3.2), (3.5), (4.10)."""
    opening = gap(k, distance, radius, depth, wavelength, amplitude, exponent)
    return opening + np.asarray(depth, dtype=float) - general.height(distance, wavelength, amplitude, exponent)


def series_gap(
    k: Real, distance: Real, radius: Real, depth: Real,
    wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0,
) -> Array:  # fmt: skip
    """Return gap/R around a punch whose waviness is a Fourier series (2.2)."""
    waves = general.harmonics(cosines, sines)
    return _gaps(lambda _: waves, 0.0, k, distance, radius, depth, wavelength, exponent)


def series_surface(
    k: Real, distance: Real, radius: Real, depth: Real,
    wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0,
) -> Array:  # fmt: skip
    """Return u_z/R, how far the surface is pressed in outside a punch of any series (4.3), (4.10)."""
    opening = series_gap(k, distance, radius, depth, wavelength, cosines, sines, exponent)
    r, length = positive(distance), positive(wavelength)
    height = general.height(r, length, 0.0, exponent) + length * general.waviness(r / length, cosines, sines)
    return opening + np.asarray(depth, dtype=float) - height


def _point_by_point(formula: Callable[..., float], *numbers: Real) -> Array:
    """Return a formula of floats at every point of broadcast arrays, NaN where one of them is NaN."""

    def at(*point: float) -> float:
        return math.nan if any(map(math.isnan, point)) else formula(*map(float, point))

    return np.asarray(np.vectorize(at, otypes=[float])(*numbers))


def _front(k: Real, stiffness: Real) -> Array:
    """Return (1+k) K/(2 pi), the factor of all pressures, in dgamma/R^(1+k); K is that of hertz.py."""
    return 2.0 ** (1.0 - exponent_of(k)) * positive(stiffness) / (2.0 * math.pi)


def _shortest(length: float, waves: hertz.Harmonics) -> float:
    """Return the shortest wave of harmonics."""
    return min((length / n for n, cosine, sine in waves if cosine != 0.0 or sine != 0.0), default=math.inf)


def _over_disc(k: Real, radius: Real, slope: Slope, shortest: float, j: int) -> Array:
    """Return a^(1-k-2j) int_0^a f'(s) (a^2-s^2)^((k-1)/2+j) ds: delta_H, and for j = 1 I/a^(1+k), of any profile."""

    def at(k: float, a: float) -> float:
        if a == 0.0:
            return 0.0
        s, weights = _below(a, 0.5 * (k - 1.0) + j, 0.5 * shortest)
        return a ** (1.0 - k - 2.0 * j) * float(np.sum(weights * np.asarray(slope(s), dtype=float)))

    return _point_by_point(at, exponent_of(k), not_negative(radius))


def _pressed(waves: hertz.Harmonics, k: float, r: float, a: float, length: float, m: float) -> float:
    """Return int_r^a (s^2-r^2)^((k-1)/2) delta_H'(s) ds; NaN for r > a."""
    if r >= a:
        return 0.0 if r == a else math.nan
    widest = 0.5 * _shortest(length, waves)
    if r > 0.0:
        s, weights = _beyond(r, a, 0.5 * (k - 1.0), widest)
        return float(np.sum(weights / s * hertz.over_disc(k, s, length, waves, m)[2]))
    front = m * float(hertz.power_indentation(k, 1.0, m))  # delta_H' of the power is front s^(m-1)
    smooth = front * a ** (k + m - 1.0) / (k + m - 1.0) if k + m > 1.0 else 0.0
    first = 2.0 * math.pi * sum(n * sine for n, _, sine in waves) * float(hertz.cosine_integrals(k, 0.0)[0])
    steep = first + (0.0 if k + m > 1.0 else front)  # delta_H' at the apex
    if k == 0.0 and steep != 0.0:
        return math.copysign(math.inf, steep)
    low = min(a, widest)
    near, weights = _jacobi(0.0, low, k, upper=False)
    s, w = _legendre(low, a, lambda _: widest)
    s, weights = np.append(near, s), np.append(weights, w * s**k)
    rest = float(np.sum(weights * (hertz.wave_terms(k, s, length, waves)[2] / s - first) / s))
    return smooth + rest + (first * a**k / k if first != 0.0 else 0.0)


def _gaps(waves_of: Callable[[float], hertz.Harmonics], size: Real, *scene: Real) -> Array:
    """Return gaps, with the waves of a size; scenes are k, distance, radius, depth, wavelength and exponent."""

    def at(size: float, k: float, r: float, a: float, level: float, length: float, m: float) -> float:
        waves = waves_of(size)
        return _gap(k, r, a, _shortest(length, waves), lambda s: hertz.over_disc(k, s, length, waves, m)[0] - level)

    k, distance, radius, depth, wavelength, exponent = scene
    r, a, length = positive(distance), positive(radius), positive(wavelength)
    return _point_by_point(at, size, exponent_of(k), r, a, depth, length, power_of(exponent))


def _gap(k: float, r: float, a: float, shortest: float, opening: Callable[[Array], Array]) -> float:
    """Return the gap at one point r, from delta_H - delta; NaN for r < a."""
    c = 0.5 * (1.0 - k)
    if r <= a:  # at k = 1 the surface gives way where it is pressed alone
        return math.nan if r < a else float(opening(np.asarray(r))) if c == 0.0 else 0.0

    def density(s: Array) -> Array:
        """Return the integrand times (r-s)^(1-c)."""
        return s**k * opening(s) * (r + s) ** (c - 1.0)

    last = r - min(0.5 * (r - a), 0.5 * shortest)
    s, weights = _legendre(a, last, lambda low: min(0.5 * shortest, low, 0.5 * (r - low)))
    total = np.sum(weights * density(s) * (r - s) ** (c - 1.0))
    # as k tends to 1 all of the weight moves to r: the last panel is taken less density(r), with the weight (r-s)^c,
    # and density(r) has an integral in closed form
    s, weights = _jacobi(last, r, c, upper=True)
    at_end = density(np.asarray(r))
    total -= np.sum(weights * (at_end - density(s)) / (r - s))
    return float(2.0 * np.sinc(c) * (c * total + (r - last) ** c * at_end))


def _below(a: float, power: float, widest: float) -> tuple[Array, Array]:
    """Return nodes s and weights w, sum w g(s) = int_0^a g(s) (a^2-s^2)^power ds, for power > -1. Else as `_beyond`."""
    last = a - min(0.5 * a, widest)
    s, w = _legendre(0.0, last, lambda low: min(widest, max(low, _LEAST * a)))
    end, weights = _jacobi(last, a, power, upper=True)
    return np.append(s, end), np.append(w * ((a - s) * (a + s)) ** power, weights * (a + end) ** power)


def _beyond(r: float, a: float, power: float, widest: float) -> tuple[Array, Array]:
    """Return nodes s and weights w, sum w g(s) = int_r^a g(s) (s^2-r^2)^power ds, for 0 < r < a and power > -1.

    g is smooth, and its waves are no shorter than 2 `widest`, the largest width of a panel.
    """
    first = min(a, r + min(widest, 0.5 * r))
    near, weights = _jacobi(r, first, power, upper=False)
    s, w = _legendre(first, a, lambda low: min(widest, low - r))
    return np.append(near, s), np.append(weights * (near + r) ** power, w * ((s - r) * (s + r)) ** power)


def _legendre(low: float, high: float, width: Callable[[float], float]) -> tuple[Array, Array]:
    """Return Gauss's rule on panels from low to high, no wider than a width of their lower edge."""
    edges = [low]
    while edges[-1] < high:
        edges.append(min(high, max(edges[-1] + width(edges[-1]), math.nextafter(edges[-1], high))))
    lower, upper = np.array(edges[:-1])[:, None], np.array(edges[1:])[:, None]
    nodes, weights = _LEGENDRE
    half = 0.5 * (upper - lower)
    return (0.5 * (lower + upper) + half * nodes).ravel(), (half * weights).ravel()


def _jacobi(low: float, high: float, power: float, *, upper: bool) -> tuple[Array, Array]:
    """Return the rule of int (high-s)^power g ds, or of int (s-low)^power g ds, on one panel."""
    nodes, weights = _rule(_NODES, power, 0.0) if upper else _rule(_NODES, 0.0, power)
    half = 0.5 * (high - low)
    return 0.5 * (high + low) + half * nodes, half ** (1.0 + power) * weights
