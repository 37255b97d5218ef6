"""Any periodic waviness: a Fourier series of cosines and sines, (5.1)-(5.14).

    f2(xi) = a0/2 + sum_n [a_n cos(2 pi n xi) + b_n sin(2 pi n xi)],   f2(0) = 0, so that a0/2 = -sum a_n
    delta_H gains 2 pi a     sum_n n [-a_n S0(n z) + b_n C0(n z)],   z = 2 pi a/lambda
    I       gains 2 pi a^(2+k) sum_n n [-a_n S1(n z) + b_n C1(n z)]

with the integrals of pair.py: a harmonic n is a wave n times shorter. One cosine wave A (1 - cos 2 pi xi) is
cosines = [-A].
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.equations import hertz, jkr
from gradhesion.core.equations._arguments import (
    Array,
    Real,
    Waves,
    describe,
    exponent_of,
    not_negative,
    positive,
    power_of,
)
from gradhesion.core.equations.pair import cosine_integrals, sine_integrals


def harmonics(cosines: Sequence[float], sines: Sequence[float] = ()) -> list[tuple[int, float, float]]:
    """Return (n, a_n, b_n) of every harmonic, the shorter list filled up with zeros."""
    count = max(len(cosines), len(sines))
    pairs = zip([*cosines, *[0.0] * (count - len(cosines))], [*sines, *[0.0] * (count - len(sines))], strict=True)
    return [(n, float(a_n), float(b_n)) for n, (a_n, b_n) in enumerate(pairs, start=1)]


def waviness(xi: Real, cosines: Waves, sines: Waves = ()) -> Array:
    """Return f2(xi), the waviness over its wavelength; f2(0) = 0.

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
    """Return delta_H/R, the depth of contact over a disc without adhesion (3.9)."""
    wave, _ = _integrals(k, radius, wavelength, cosines, sines)
    return hertz.power_indentation(k, radius, exponent) + not_negative(radius) * wave


def hertz_load(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return P_H/(1.5 pi R dgamma), the load of contact over a disc without adhesion (3.10)."""
    first, second = _integrals(k, radius, wavelength, cosines, sines)
    m = power_of(exponent)
    smooth = hertz.power_indentation(k, radius, m) * m / (1.0 + exponent_of(k) + m)
    return hertz.disc_stiffness(k, stiffness, radius) * (smooth + not_negative(radius) * (first - second))


def indentation(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return the depth delta/R in adhesive equilibrium (4.8), (5.8), (5.12)-(5.14)."""
    hertzian = hertz_indentation(k, radius, wavelength, cosines, sines, exponent)
    return hertzian - jkr.adhesive_depth(k, stiffness, radius)


def load(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), exponent: Real = 2.0
) -> Array:
    """Return the load P/(1.5 pi R dgamma) in adhesive equilibrium (4.7), (5.9), (5.12)-(5.14).

    A second harmonic with half the amplitude of its own wave is a wave of half the length:

    >>> one, other = load(0.3, 500.0, 0.2, 0.1, [0.0, -0.01]), load(0.3, 500.0, 0.2, 0.05, [-0.02])
    >>> bool(abs(one / other - 1) < 1e-12)
    True
    """
    pull = hertz.disc_stiffness(k, stiffness, radius) * jkr.adhesive_depth(k, stiffness, radius)
    return hertz_load(k, stiffness, radius, wavelength, cosines, sines, exponent) - pull


def _integrals(
    k: ArrayLike, radius: ArrayLike, wavelength: ArrayLike, cosines: Sequence[float], sines: Sequence[float]
) -> tuple[Array, Array]:
    """Return the waviness's parts of delta_H/a and of I/a^(2+k)."""
    x = not_negative(radius) / positive(wavelength)
    shape = np.broadcast_shapes(np.shape(k), x.shape)
    first, second = np.zeros(shape), np.zeros(shape)
    for n, a_n, b_n in harmonics(cosines, sines):
        if a_n != 0.0:
            s0, s1, _, _ = sine_integrals(k, n * x)
            first, second = first - a_n * n * s0, second - a_n * n * s1
        if b_n != 0.0:
            c0, c1 = cosine_integrals(k, n * x)
            first, second = first + b_n * n * c0, second + b_n * n * c1
    return 2.0 * math.pi * first, 2.0 * math.pi * second


describe(__name__)
