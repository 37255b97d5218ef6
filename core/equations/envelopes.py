"""The envelopes of a short wave, between which depth and load swing, (5.21)-(5.27).

    s = sqrt(2^(1+k) pi dgamma/M)   strength of adhesion:      Delta = s a^((1-k)/2)
    r = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2)   strength of the waviness:  its swing is r a^((1-k)/2)
    delta+- = a^2/((1+k) R) + lambda A - (s -+ r) a^((1-k)/2)                        (5.26)
    P+-     = K [2 a^(3+k)/((1+k)(3+k) R) - (s -+ r) a^((3+k)/2)]                    (5.27)

Loading runs along the upper signs, unloading along the lower ones: a smooth punch with s + r for s, whose pull-off
force is (3+k)/3 (1+r/s)^2. The printed form leaves out lambda A, the mean height of the wave. For a Fourier series r is
2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2) times the maximum of zeta for loading, and minus its minimum for unloading,
(5.21)-(5.25). For a punch r^m/m the first terms are those of `hertz.power_indentation`; c = (1-k)/2, and G is that
factor of depth at a = R.
"""

import math

import numpy as np
from scipy.special import gamma

from gradhesion.core.equations import hertz, jkr
from gradhesion.core.equations._arguments import Array, Real, Waves, exponent_of, not_negative, positive, power_of
from gradhesion.core.equations.general import harmonics
from gradhesion.core.problem.profile import swings_of


def adhesion_strength(k: Real, stiffness: Real) -> Array:
    """Return s/R^((1+k)/2) = sqrt(2^(1+k) pi dgamma/M), the Delta of a = R."""
    return jkr.adhesive_depth(k, stiffness, 1.0)


def waviness_strength(k: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return r/R^((1+k)/2) = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2) of one cosine wave.

    >>> waviness_strength([0.0, 1.0], 0.01, 0.02).round(6).tolist()
    [0.006283, 0.0002]
    """
    n = 0.5 * (1.0 + exponent_of(k))
    return math.pi ** (1.0 - n) * gamma(n) * not_negative(amplitude) * positive(wavelength) ** n


def series_strengths(k: Real, wavelength: Real, cosines: Waves, sines: Waves = ()) -> tuple[Array, Array]:
    """Return r/R^((1+k)/2) of a Fourier series, for loading and for unloading (5.21)-(5.25)."""
    lowest, highest = zeta_extrema(k, cosines, sines)
    size = depth_over_zeta(k, 1.0, wavelength)
    return size * highest, -size * lowest


def zeta_extrema(k: Real, cosines: Waves, sines: Waves = ()) -> tuple[Array, Array]:
    """Return the true minimum and maximum of zeta (5.17) over its period."""
    exponents = exponent_of(k)
    rows = tuple((float(n), -a_n, b_n) for n, a_n, b_n in harmonics(cosines, sines) if a_n != 0.0 or b_n != 0.0)
    up, down = swings_of(exponents, rows)
    size = (2.0 * math.pi) ** (0.5 * (1.0 - exponents))
    return -size * down, size * up


def depth_over_zeta(k: Real, radius: Real, wavelength: Real) -> Array:
    """Return by how much depth/R swings over zeta, 2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2) a^((1-k)/2)."""
    c = 0.5 * (1.0 - exponent_of(k))
    return waviness_strength(k, wavelength, 1.0) * (not_negative(radius) / (2.0 * math.pi)) ** c


def power_pull_off(k: Real, stiffness: Real, pull: Real, exponent: Real = 2.0) -> tuple[Array, Array]:
    """Return a/R and F/(1.5 pi R dgamma) of pull-off of an envelope of any power m.

    a^(m-c) = (3+k) (s+r)/(2 m G),   F = K (s+r) a^((3+k)/2) (m-c)/(1+k+m)
    """
    gradient, hold, m = exponent_of(k), positive(pull), power_of(exponent)
    c = 0.5 * (1.0 - gradient)
    front = hertz.power_indentation(gradient, 1.0, m)
    radius = (0.5 * (3.0 + gradient) * hold / (m * front)) ** (1.0 / (m - c))
    return radius, hertz.disc_stiffness(k, stiffness, radius) * hold * radius**c * (m - c) / (1.0 + gradient + m)


def power_radii(k: Real, pull: Real, exponent: Real = 2.0) -> tuple[Array, Array]:
    """Return a_2/R and a_4/R of an envelope of any power m, at the depth 0 and at its fold, (5.34) and (5.35).

    a_2^(m-c) = pull/G,   a_4^(m-c) = (1-k) pull/(2 m G),   depths counted from the mean surface
    """
    gradient, hold, m = exponent_of(k), not_negative(pull), power_of(exponent)
    c = 0.5 * (1.0 - gradient)
    ratio = hold / hertz.power_indentation(gradient, 1.0, m)
    return ratio ** (1.0 / (m - c)), (c * ratio / m) ** (1.0 / (m - c))


def pull_off_force(k: Real, ratio: Real) -> Array:
    """Return the pull-off force of the unloading envelope over 1.5 pi R dgamma, (3+k)/3 (1+r/s)^2.

    The exact force tends to it as lambda -> 0 at fixed r/s, with an error of the order (lambda/a)^2, below it except
    for k near 1.
    """
    return (3.0 + exponent_of(k)) / 3.0 * (1.0 + not_negative(ratio)) ** 2


def indentation(k: Real, radius: Real, pull: Real, mean_height: Real = 0.0, exponent: Real = 2.0) -> Array:
    """Return the depth delta/R on an envelope (5.26).

    >>> s, r = adhesion_strength(0.0, 500.0), waviness_strength(0.0, 0.01, 0.02)
    >>> indentation(0.0, 0.3, [s - r, s + r], 0.01 * 0.02).round(6).tolist()
    [0.032242, 0.025359]
    """
    a, c = not_negative(radius), 0.5 * (1.0 - exponent_of(k))
    smooth = hertz.power_indentation(k, a, exponent) - np.asarray(pull, dtype=float) * a**c
    return smooth + np.asarray(mean_height, dtype=float)


def load(k: Real, stiffness: Real, radius: Real, pull: Real, exponent: Real = 2.0) -> Array:
    """Return the load P/(1.5 pi R dgamma) on an envelope (5.27)."""
    a, gradient, m = not_negative(radius), exponent_of(k), power_of(exponent)
    smooth = hertz.power_indentation(k, a, m) * m / (1.0 + gradient + m)
    hold = np.asarray(pull, dtype=float) * a ** (0.5 * (1.0 - gradient))
    return hertz.disc_stiffness(k, stiffness, a) * (smooth - hold)
