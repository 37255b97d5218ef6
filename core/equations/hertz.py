"""Contact without adhesion: depth and load of a disc of radius a (3.9), (3.10), in closed form.

    delta_H(a) = a^(1-k) int_0^a f'(s) (a^2-s^2)^((k-1)/2) ds
    P_H(a)     = K [a^(1+k) delta_H - I],   I = int_0^a f'(s) (a^2-s^2)^((k+1)/2) ds,   K = 2^(1-k) M/(1+k)

For f1 = r^m/(m R^(m-1)) both integrals are powers, (5.5) and (5.6) as corrected in docs/theory.md; a cosine wave adds
2 pi A a S0 and 2 pi A a^(2+k) S1 (pair.py).
"""

import math

from scipy.special import gamma

from gradhesion.core.equations._arguments import (
    LOAD_UNIT,
    Array,
    Real,
    describe,
    exponent_of,
    not_negative,
    positive,
    power_of,
)
from gradhesion.core.equations.pair import sine_integrals


def disc_stiffness(k: Real, stiffness: Real, radius: Real) -> Array:
    """Return K a^(1+k), the load over the depth of a flat disc, in 1.5 pi R dgamma over R.

    On a homogeneous half-space 2 E* a:

    >>> float(disc_stiffness(0.0, 500.0, 0.3) * 1.5 * math.pi)
    300.0
    """
    n = 1.0 + exponent_of(k)
    return 2.0 ** (2.0 - n) * positive(stiffness) / n * not_negative(radius) ** n / LOAD_UNIT


def power_indentation(k: Real, radius: Real, exponent: Real = 2.0) -> Array:
    """Return delta_H/R of the smooth part (5.5): G(m/2) G((1+k)/2)/(2 G((1+k+m)/2)) a^m.

    A paraboloid has a^2/((1+k) R):

    >>> power_indentation([0.0, 0.5], 0.3).round(12).tolist()
    [0.09, 0.06]
    """
    n, m = 1.0 + exponent_of(k), power_of(exponent)
    return 0.5 * gamma(0.5 * m) * gamma(0.5 * n) / gamma(0.5 * (n + m)) * not_negative(radius) ** m


def power_moment(k: Real, radius: Real, exponent: Real = 2.0) -> Array:
    """Return I/R^(2+k) of the smooth part (5.6): G(m/2) G((3+k)/2)/(2 G((3+k+m)/2)) a^(1+k+m)."""
    n, m = 1.0 + exponent_of(k), power_of(exponent)
    factor = 0.5 * gamma(0.5 * m) * gamma(0.5 * n + 1.0) / gamma(0.5 * (n + m) + 1.0)
    return factor * not_negative(radius) ** (n + m)


def wave_indentation(k: Real, radius: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return the part of delta_H/R that a cosine wave adds, 2 pi A a S0(2 pi a/lambda).

    At k = 1 it is the wave itself, A lambda (1 - cos(2 pi a/lambda)):

    >>> float(wave_indentation(1.0, 0.05, 0.1, 0.02).round(12))
    0.004
    """
    a = not_negative(radius)
    s0, _, _, _ = sine_integrals(k, a / positive(wavelength))
    return 2.0 * math.pi * not_negative(amplitude) * a * s0


def wave_moment(k: Real, radius: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return the part of I/R^(2+k) that a cosine wave adds, 2 pi A a^(2+k) S1(2 pi a/lambda)."""
    a = not_negative(radius)
    _, s1, _, _ = sine_integrals(k, a / positive(wavelength))
    return 2.0 * math.pi * not_negative(amplitude) * a ** (2.0 + exponent_of(k)) * s1


def indentation(k: Real, radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return delta_H/R, the depth of contact over a disc without adhesion (3.9).

    Accurate to a few units in the last place of its largest term.
    """
    return power_indentation(k, radius, exponent) + wave_indentation(k, radius, wavelength, amplitude)


def load(k: Real, stiffness: Real, radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return P_H/(1.5 pi R dgamma), the load of contact over a disc without adhesion (3.10).

    Zero at a = 0.

    Hertz: 4 E* a^3/(3 R):

    >>> float((load(0.0, 500.0, 0.3, 0.1, 0.0) * 1.5 * math.pi).round(10))
    18.0
    """
    a, n = not_negative(radius), 1.0 + exponent_of(k)
    s0, s1, _, _ = sine_integrals(k, a / positive(wavelength))
    wave = 2.0 * math.pi * not_negative(amplitude) * a * (s0 - s1)
    smooth = power_indentation(k, a, exponent) * power_of(exponent) / (n + power_of(exponent))
    return disc_stiffness(k, stiffness, a) * (smooth + wave)


describe(__name__)
