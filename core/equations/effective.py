"""The effective path of a short wave: the envelopes, and what connects them, (5.28)-(5.35).

Loading jumps in at zero depth to a_2, climbs the loading envelope to a_am, and unloads first at that radius, pinned by
the barrier of one wave, along a straight line to the unloading envelope, which it descends to a_4, where contact ends.

    P = K [a_am^(1+k) (delta - lambda A) - a_am^(3+k)/((3+k) R)]   over the depth 2 r a_am^((1-k)/2)      (5.32)
    a_2 = [(1+k) R (s-r)]^(2/(3+k)),  r < s      (5.34)
    a_4 = [(1-k^2)/4 R (s+r)]^(2/(3+k))          (5.35)

with s and r of envelopes.py. The printed form leaves out lambda A. The punch is a paraboloid.
"""

import numpy as np

from gradhesion.core.equations import hertz
from gradhesion.core.equations._arguments import Array, Real, describe, exponent_of, not_negative


def jump_in_radius(k: Real, adhesion: Real, waviness: Real) -> Array:
    """Return a_2/R, to which contact jumps when it begins (5.34).

    NaN for r >= s: the loading envelope then starts at a = 0 without a jump.

    >>> jump_in_radius(0.0, 0.1, [0.0, 0.05, 0.1]).round(6).tolist()
    [0.215443, 0.135721, nan]
    """
    exponent, rest = exponent_of(k), np.asarray(adhesion, dtype=float) - not_negative(waviness)
    return ((1.0 + exponent) * np.where(rest > 0.0, rest, np.nan)) ** (2.0 / (3.0 + exponent))


def jump_out_radius(k: Real, adhesion: Real, waviness: Real) -> Array:
    """Return a_4/R, from which contact jumps when it ends (5.35).

    It is 0 at k = 1, where contact shrinks to a point, and any r >= 0 is in range.
    """
    exponent, pull = exponent_of(k), not_negative(adhesion) + not_negative(waviness)
    return (0.25 * (1.0 - exponent) * (1.0 + exponent) * pull) ** (2.0 / (3.0 + exponent))


def early_unloading_load(k: Real, stiffness: Real, radius: Real, depth: Real, mean_height: Real = 0.0) -> Array:
    """Return P/(1.5 pi R dgamma) on the line of early unloading at the largest radius a_am (5.32)."""
    smooth = hertz.power_indentation(k, radius) * (1.0 + exponent_of(k)) / (3.0 + exponent_of(k))
    lowered = np.asarray(depth, dtype=float) - np.asarray(mean_height, dtype=float)
    return hertz.disc_stiffness(k, stiffness, radius) * (lowered - smooth)


def early_unloading_depth(k: Real, radius: Real, waviness: Real) -> Array:
    """Return the depth over which the line of early unloading runs, 2 r a_am^((1-k)/2), over R."""
    return 2.0 * not_negative(waviness) * not_negative(radius) ** (0.5 * (1.0 - exponent_of(k)))


describe(__name__)
