"""Waves far shorter than the contact, lambda << a: the leading term, (5.15)-(5.20).

    zeta(xi) = sum_n (2 pi n)^((1-k)/2) [-a_n sin(2 pi n xi - phi) + b_n cos(2 pi n xi - phi)],   phi = (1+k) pi/4
    delta ~ delta_1 - lambda sum a_n + 2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2) a^((1-k)/2) zeta(a/lambda)
    P     ~ P_1     + K 2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2) a^((3+k)/2) zeta(a/lambda)

with delta_1, P_1 of the smooth adhesive punch. The printed form leaves out the second term of delta, the mean height of
the waviness over the apex; P has none to this order. The error of delta and of P is of the order lambda/a of the term
in zeta, so that it is not valid where the contact is no larger than a wave.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from gradhesion.core.equations import hertz, jkr
from gradhesion.core.equations._arguments import Array, Real, Waves, describe, exponent_of, positive
from gradhesion.core.equations.general import harmonics


def zeta(k: Real, xi: Real, cosines: Waves, sines: Waves = ()) -> Array:
    """Return the function of period 1 to which all waviness reduces (5.17)."""
    exponent, turns = exponent_of(k), np.asarray(xi, dtype=float)
    total = np.zeros(np.broadcast_shapes(exponent.shape, turns.shape)) + 0.0 * exponent
    for n, a_n, b_n in harmonics(cosines, sines):
        phase = 2.0 * math.pi * np.mod(n * turns, 1.0) - 0.25 * math.pi * (1.0 + exponent)
        wave = b_n * np.cos(phase) - a_n * np.sin(phase)
        total = total + (2.0 * math.pi * n) ** (0.5 * (1.0 - exponent)) * wave
    return total


def indentation(
    k: Real,
    stiffness: Real,
    radius: Real,
    wavelength: Real,
    cosines: Waves,
    sines: Waves = (),
    *,
    exponent: Real = 2.0,
    mean_height: bool = True,
) -> Array:
    """Return the depth delta/R in equilibrium for waves far shorter than the contact.

    Off by about lambda/a of its term in zeta (exact at k = 1).

    >>> exact = jkr.indentation(0.3, 500.0, 0.5, 0.01, 0.02)
    >>> with_mean = indentation(0.3, 500.0, 0.5, 0.01, [-0.02])
    >>> printed = indentation(0.3, 500.0, 0.5, 0.01, [-0.02], mean_height=False)
    >>> f"{float(with_mean - exact):.0e} {float(printed - exact):.0e}"
    '3e-07 -2e-04'
    """
    smooth = hertz.power_indentation(k, positive(radius), exponent) - jkr.adhesive_depth(k, stiffness, radius)
    mean = -positive(wavelength) * sum(cosines) if mean_height else 0.0
    return smooth + mean + _wave(k, radius, wavelength, cosines, sines)


def load(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), *, exponent: Real = 2.0
) -> Array:
    """Return the load P/(1.5 pi R dgamma) in equilibrium for waves far shorter than the contact.

    Off by about lambda/a of its term in zeta.
    """
    # the smooth punch is a wave of no amplitude
    smooth = jkr.load(k, stiffness, positive(radius), wavelength, 0.0, exponent)
    return smooth + hertz.disc_stiffness(k, stiffness, radius) * _wave(k, radius, wavelength, cosines, sines)


def _wave(
    k: ArrayLike, radius: ArrayLike, wavelength: ArrayLike, cosines: Sequence[float], sines: Sequence[float]
) -> Array:
    """Return the term in zeta."""
    a, length, n = positive(radius), positive(wavelength), 0.5 * (1.0 + exponent_of(k))
    size = 2.0 ** (n - 1.0) * gamma(n) * length**n * a ** (1.0 - n)
    return size * zeta(k, a / length, cosines, sines)


describe(__name__)
