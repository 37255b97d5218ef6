"""Contact with adhesion: energy release rate, load and depth in equilibrium, (4.4), (4.7), (4.8).

    G(a, delta) = dgamma [(delta_H(a) - delta)/Delta(a)]^2,   Delta(a) = sqrt(2^(1+k) pi dgamma a^(1-k)/M)
    equilibrium G = dgamma:   delta = delta_H - Delta,   P = P_H - K a^(1+k) Delta

Depth under displacement control folds where q = a delta_H'/Delta meets (1-k)/2, and load where it meets (3+k)/2. The
punch is a power with one cosine wave.
"""

import math

import numpy as np

from gradhesion.core.equations import hertz
from gradhesion.core.equations._arguments import Array, Real, exponent_of, not_negative, positive


def adhesive_depth(k: Real, stiffness: Real, radius: Real) -> Array:
    """Return Delta/R, by which adhesion pulls the surface out at equilibrium.

    On a homogeneous half-space sqrt(2 pi dgamma a/E*):

    >>> float(adhesive_depth(0.0, 200.0 * np.pi, 0.25))
    0.05
    """
    exponent = exponent_of(k)
    square = 2.0 ** (1.0 + exponent) * math.pi / positive(stiffness) * not_negative(radius) ** (1.0 - exponent)
    return np.sqrt(square)


def energy_release_rate(
    k: Real, stiffness: Real, radius: Real, depth: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return G/dgamma at the edge of a disc of radius a when the punch is at any depth (4.4); 1 is equilibrium.

    >>> depth = indentation(0.3, 500.0, 0.2, 0.1, 0.02)
    >>> float(energy_release_rate(0.3, 500.0, 0.2, depth, 0.1, 0.02).round(12))
    1.0
    """
    opening = hertz.indentation(k, radius, wavelength, amplitude, exponent) - np.asarray(depth, dtype=float)
    return (opening / adhesive_depth(k, stiffness, positive(radius))) ** 2


def indentation(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return the depth delta/R in equilibrium (4.8)."""
    hertzian = hertz.indentation(k, radius, wavelength, amplitude, exponent)
    return hertzian - adhesive_depth(k, stiffness, radius)


def load(k: Real, stiffness: Real, radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0) -> Array:
    """Return the load P/(1.5 pi R dgamma) in equilibrium (4.7); negative where it pulls.

    The pull-off of Johnson, Kendall & Roberts, met at a^3 = 9 pi R^2 dgamma/(8 E*):

    >>> float(load(0.0, 500.0, (9 * np.pi / 4000) ** (1 / 3), 0.1, 0.0).round(12))
    -1.0
    """
    pull = hertz.disc_stiffness(k, stiffness, radius) * adhesive_depth(k, stiffness, radius)
    return hertz.load(k, stiffness, radius, wavelength, amplitude, exponent) - pull


def load_at_depth(
    k: Real, stiffness: Real, radius: Real, depth: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return the load P/(1.5 pi R dgamma) on a disc of fixed radius at any depth, K [a^(1+k) delta - I] (4.1).

    This is contact pinned at the rim of a finite punch, and the state between two equilibria during a jump.
    """
    hertzian, raised, _ = hertz.over_disc(k, radius, wavelength, hertz.cosine_wave(amplitude), exponent)
    return hertz.disc_stiffness(k, stiffness, radius) * (raised + (np.asarray(depth, dtype=float) - hertzian))


def fold_number(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, amplitude: Real, exponent: Real = 2.0
) -> Array:
    """Return q = a delta_H'(a)/Delta(a), which decides stability.

    Depth rises with the radius, and contact is stable under displacement control, where q > (1-k)/2; load rises, and
    contact is stable under load control, where q > (3+k)/2.
    """
    rise = hertz.over_disc(k, radius, wavelength, hertz.cosine_wave(amplitude), exponent)[2]
    return rise / adhesive_depth(k, stiffness, positive(radius))
