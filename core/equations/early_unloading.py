"""Early unloading of any series of short waves (5.28)-(5.31): from one envelope to the other at one radius.

    delta(alpha) = delta_1(a_am) + g a_am^((1-k)/2) alpha,   zeta_min <= alpha <= zeta_max
    P(alpha)     = P_1(a_am) + K g a_am^((3+k)/2) alpha,     g = 2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2)

with delta_1, P_1 of the smooth adhesive punch and zeta of short_waves.py; alpha = zeta_max is the loading envelope,
where unloading begins, and alpha = zeta_min the unloading one. In the plane of depth and load this is the line of a
flat punch (5.30), over the depth g a_am^((1-k)/2) (zeta_max - zeta_min) (5.31); one cosine has
zeta = +-(2 pi)^((1-k)/2) A and the line (5.32) of effective.py. The mean height of the waves, which the printed forms
leave out, raises depths by -lambda sum a_n.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from gradhesion.core.equations import envelopes, hertz, jkr
from gradhesion.core.equations._arguments import Array, Real, Waves, describe, exponent_of, not_negative, positive


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
    """Return the depth delta/R at the radius a_am, for a value alpha of zeta (5.28)."""
    smooth = hertz.power_indentation(k, radius, exponent) - jkr.adhesive_depth(k, stiffness, radius)
    return smooth + _swing(k, radius, wavelength) * np.asarray(alpha, dtype=float) + np.asarray(mean_height)


def load(k: Real, stiffness: Real, radius: Real, alpha: Real, wavelength: Real, *, exponent: Real = 2.0) -> Array:
    """Return the load P/(1.5 pi R dgamma) at the radius a_am, for a value alpha of zeta (5.29)."""
    smooth = jkr.load(k, stiffness, radius, wavelength, 0.0, exponent)
    swing = _swing(k, radius, wavelength) * np.asarray(alpha, dtype=float)
    return smooth + hertz.disc_stiffness(k, stiffness, radius) * swing


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


def drop(k: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = ()) -> Array:
    """Return the depth over which the line of early unloading runs, over R (5.31).

    One cosine has 2 r a_am^((1-k)/2), which (5.33) should print.
    """
    lowest, highest = envelopes.zeta_extrema(k, cosines, sines)
    return _swing(k, radius, wavelength) * (highest - lowest)


def _swing(k: ArrayLike, radius: ArrayLike, wavelength: ArrayLike) -> Array:
    """Return g a^((1-k)/2), by which depth changes over zeta."""
    n = 0.5 * (1.0 + exponent_of(k))
    return 2.0 ** (n - 1.0) * gamma(n) * positive(wavelength) ** n * not_negative(radius) ** (1.0 - n)


describe(__name__)
