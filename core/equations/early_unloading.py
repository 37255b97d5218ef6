"""Early unloading of any series of short waves (5.28)-(5.31): from one envelope to the other at one radius.

    delta(alpha) = delta_1(a_am) + g a_am^((1-k)/2) alpha,   zeta_min <= alpha <= zeta_max
    P(alpha)     = P_1(a_am) + K g a_am^((3+k)/2) alpha,     g = 2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2)

with delta_1, P_1 of the smooth adhesive punch and zeta of short_waves.py; alpha = zeta_max is the loading envelope,
where unloading begins, and alpha = zeta_min the unloading one. In the plane of depth and load this is the line of a
flat punch (5.30), over the depth g a_am^((1-k)/2) (zeta_max - zeta_min) (5.31); one cosine has
zeta = +-(2 pi)^((1-k)/2) A and the line (5.32) of effective.py. The mean height of the waves, which the printed forms
leave out, raises depths by -lambda sum a_n. Lengths are in R, loads in 1.5 pi R dgamma, M in dgamma/R^(1+k). Source:
Jin, Guo & Wan (2013).
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from gradhesion.core.equations import envelopes, hertz, jkr
from gradhesion.core.equations._arguments import Real, Waves, documented
from gradhesion.core.equations._domain import Array, exponent_of, not_negative, positive


@documented()
def indentation(
    k: Real,
    stiffness: Real,
    radius: Real,
    alpha: Real,
    wavelength: Real,
    *,
    exponent: Real = 2.0,
    mean_height: Real = 0.0,
) -> Array:
    """Return the depth delta/R at the radius a_am, for a value alpha of zeta (5.28).

    >>> lowest, highest = envelopes.zeta_extrema(0.2, [-0.02])
    >>> span = indentation(0.2, 500.0, 0.3, highest, 0.01) - indentation(0.2, 500.0, 0.3, lowest, 0.01)
    >>> bool(abs(span / drop(0.2, 0.3, 0.01, [-0.02]) - 1) < 1e-13)
    True
    """
    smooth = hertz.power_indentation(k, radius, exponent) - jkr.adhesive_depth(k, stiffness, radius)
    return smooth + _swing(k, radius, wavelength) * np.asarray(alpha, dtype=float) + np.asarray(mean_height)


@documented()
def load(k: Real, stiffness: Real, radius: Real, alpha: Real, wavelength: Real, *, exponent: Real = 2.0) -> Array:
    """Return the load P/(1.5 pi R dgamma) at the radius a_am, for a value alpha of zeta (5.29).

    At alpha = 0 it is the smooth punch:

    >>> own, smooth = load(0.2, 500.0, 0.3, 0.0, 0.01), jkr.load(0.2, 500.0, 0.3, 0.01, 0.0)
    >>> bool(abs(own - smooth) < 1e-14)
    True
    """
    smooth = jkr.load(k, stiffness, radius, wavelength, 0.0, exponent)
    swing = _swing(k, radius, wavelength) * np.asarray(alpha, dtype=float)
    return smooth + hertz.disc_stiffness(k, stiffness, radius) * swing


@documented()
def load_at_depth(
    k: Real, stiffness: Real, radius: Real, depth: Real, *, exponent: Real = 2.0, mean_height: Real = 0.0
) -> Array:
    """Return the load P/(1.5 pi R dgamma) on the line of early unloading at a depth (5.30).

    For a paraboloid it is (5.32):

    >>> from gradhesion.core.equations import effective
    >>> own, line = load_at_depth(0.2, 500.0, 0.3, 0.05), effective.early_unloading_load(0.2, 500.0, 0.3, 0.05)
    >>> bool(abs(own - line) < 1e-13)
    True
    """
    smooth = hertz.power_indentation(k, radius, exponent) - jkr.adhesive_depth(k, stiffness, radius)
    lowered = np.asarray(depth, dtype=float) - np.asarray(mean_height, dtype=float) - smooth
    start = jkr.load(k, stiffness, radius, 1.0, 0.0, exponent)
    return start + hertz.disc_stiffness(k, stiffness, radius) * lowered


@documented()
def drop(k: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = ()) -> Array:
    """Return the depth over which the line of early unloading runs, over R (5.31).

    One cosine has 2 r a_am^((1-k)/2), which (5.33) should print.

    >>> r = envelopes.waviness_strength(0.2, 0.01, 0.02)
    >>> bool(abs(drop(0.2, 0.3, 0.01, [-0.02]) / (2 * r * 0.3**0.4) - 1) < 1e-13)
    True
    """
    lowest, highest = envelopes.zeta_extrema(k, cosines, sines)
    return _swing(k, radius, wavelength) * (highest - lowest)


def _swing(k: ArrayLike, radius: ArrayLike, wavelength: ArrayLike) -> Array:
    """Return g a^((1-k)/2), by which depth changes over zeta."""
    n = 0.5 * (1.0 + exponent_of(k))
    return 2.0 ** (n - 1.0) * gamma(n) * positive(wavelength) ** n * not_negative(radius) ** (1.0 - n)
