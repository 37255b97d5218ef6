"""The end of folds, and the energy lost by short waves up to there (not in the paper).

Depth over a short wave is a sine on a slope. With theta = 2 pi a/lambda - phi and r, s of envelopes.py, in units of the
swing r a^((1-k)/2), one wave is

    delta = sin(theta) + u theta,   u = (a/a_e)^((1+k)/2),   a_e = [pi (1+k) R r/lambda]^(2/(1+k))

so that folds end at the radius a_e, which depends on k, A and lambda alone, and not on the material. Loading follows
the running maximum of delta and unloading its running minimum from the right. Their mean distance over 2, the *share*

    W(u) = { c (t_2 - t_1) + cos t_2 - cos t_1 - u (t_2^2 - t_1^2)/2 }/2 pi
    cos t_1 = -u,   c = sin t_1 + u t_1 = sin t_2 + u t_2,   t_2 next after t_1

falls from 1 at u = 0 to 0 at u = 1, as 1 - pi u at first. In H the terms of second order cancel over a wave, and

    H ~ C1 + 4 pi (r/s) dgamma int_{a_2}^{a_am} W(u(a)) d(a^2)

for a_2 well below a_e. The paper's C2 has 1 for W: it is the limit of a contact far smaller than a_e. With W the energy
of an unbounded punch is finite.
"""

import math
from typing import Final

import numpy as np
from scipy.special import roots_legendre

from gradhesion.core.equations import effective, energy, envelopes
from gradhesion.core.equations._arguments import Array, Real, describe, exponent_of, not_negative

_NODES, _WEIGHTS = roots_legendre(64)
_HALVINGS: Final = 60


def end_of_folds(k: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return a_e/R, the radius beyond which a short wave has no folds.

    For A = 0.03 and lambda/R = 0.01 the last fold is 0.2 to 1.6 % further out (k from 0 to 0.5); with waves as long as
    the contact it is only an estimate.

    >>> end_of_folds([0.0, 0.2], 0.01, 0.03).round(3).tolist()
    [8.767, 2.374]
    """
    n = 0.5 * (1.0 + exponent_of(k))
    unit = envelopes.waviness_strength(k, wavelength, amplitude) / np.asarray(wavelength, dtype=float)
    return (2.0 * math.pi * n * unit) ** (1.0 / n)


def share(ratio: Real) -> Array:
    """Return W(u), the mean distance of loading from unloading over the distance of the envelopes.

    Zero for u >= 1. Accurate to 1e-14.

    >>> share([0.0, 0.1, 0.5, 1.0]).round(6).tolist()
    [1.0, 0.757171, 0.201452, 0.0]
    """
    u = np.minimum(not_negative(ratio), 1.0)
    first = math.pi - np.arccos(u)
    crest = np.sin(first) + u * first
    low, high = 2.0 * math.pi - first, first + 2.0 * math.pi  # the next trough, and one wave on
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = np.sin(middle) + u * middle < crest
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    # the area between crest and curve, over the wave's own area 2 pi
    area = crest * (high - first) + np.cos(high) - np.cos(first) - 0.5 * u * (high * high - first * first)
    return np.where(u < 1.0, area / (2.0 * math.pi), 0.0) + 0.0 * u


def dissipated_energy(k: Real, stiffness: Real, wavelength: Real, amplitude: Real, largest_radius: Real) -> Array:
    """Return H/(R^2 dgamma) of short waves, with the saturation that C2 leaves out.

    NaN for r >= s and for a_am < a_2; a_am may be inf, for the saturated energy. For k = 0.2, A = 0.03 and
    M R^(1+k)/dgamma = 1009 within 4 %, 0.9 % and 0.12 % of the exact energy at lambda/R = 0.01, 0.001 and 0.0001; it is
    not for waves that end, at a_e, near a_2 or before it.
    """
    n, s = 0.5 * (1.0 + exponent_of(k)), envelopes.adhesion_strength(k, stiffness)
    r = envelopes.waviness_strength(k, wavelength, amplitude)
    start, end = effective.jump_in_radius(k, s, r), end_of_folds(k, wavelength, amplitude)
    last = not_negative(largest_radius)
    # int W d(a^2) = a_e^2 int W d(u^(2/n)), with u = t^2 because W has a term u^(3/2)
    stop = np.where(end > 0.0, np.minimum(last / np.where(end > 0.0, end, 1.0), 1.0), 0.0)
    begin = np.where(end > 0.0, np.minimum(start / np.where(end > 0.0, end, 1.0), 1.0), 0.0)
    lower, upper = begin ** (0.5 * n), stop ** (0.5 * n)
    middle, half = 0.5 * (upper + lower), 0.5 * (upper - lower)
    t = middle[..., None] + half[..., None] * _NODES
    power = np.asarray(4.0 / n)[..., None]
    rate = power * np.abs(t) ** (power - 1.0) * share(t * t)
    band = np.where(last >= start, half * np.sum(_WEIGHTS * rate, axis=-1), np.nan)
    return energy.first_part(k, stiffness, wavelength, amplitude) + 4.0 * math.pi * r / s * end**2 * band


def saturated_share(k: Real) -> Array:
    """Return w(k) = int W d(a^2)/a_e^2, so that an unbounded punch loses about C1 + 4 pi (r/s) dgamma w a_e^2."""
    power = 8.0 / (1.0 + exponent_of(k))
    t = 0.5 + 0.5 * _NODES
    rate = power[..., None] * t ** (power[..., None] - 1.0) * share(t * t)
    return 0.5 * np.sum(_WEIGHTS * rate, axis=-1)


describe(__name__)
