"""Waves far shorter than the contact, lambda << a: the leading term (5.15)-(5.20), and what the paper lacks: its end.

    zeta(xi) = sum_n (2 pi n)^((1-k)/2) [-a_n sin(2 pi n xi - phi) + b_n cos(2 pi n xi - phi)],   phi = (1+k) pi/4
    delta ~ delta_1 - lambda sum a_n + 2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2) a^((1-k)/2) zeta(a/lambda)
    P     ~ P_1     + K 2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2) a^((3+k)/2) zeta(a/lambda)

with delta_1, P_1 of the smooth adhesive punch. The printed form leaves out the second term of delta, the mean height of
the waviness; P has none to this order. The error of both is of the order lambda/a of the term in zeta.

Depth over one wave is a sine on a slope: in units of its swing, with theta = 2 pi a/lambda - phi,

    delta = sin(theta) + u theta,   u = (a/a_e)^((1+k)/2),   a_e = [pi (1+k) R r/lambda]^(2/(1+k))

so that folds end at the radius a_e, which depends on k, A and lambda alone, and not on the material. Loading follows
the running maximum of delta and unloading its running minimum from the right. Their mean distance over 2, the *share*

    W(u) = { c (t_2 - t_1) + cos t_2 - cos t_1 - u (t_2^2 - t_1^2)/2 }/2 pi
    cos t_1 = -u,   c = sin t_1 + u t_1 = sin t_2 + u t_2,   t_2 next after t_1

falls from 1 at u = 0 to 0 at u = 1, as 1 - pi u at first. In H ~ C1 + 4 pi (r/s) dgamma int W(u(a)) d(a^2) from a_2 to
a_am, for a_2 well below a_e, the paper's C2 has 1 for W. With W the energy of an unbounded punch is finite.
"""

import math
from typing import Final

import numpy as np
from scipy.special import roots_legendre

from gradhesion.core.equations import effective, envelopes
from gradhesion.core.equations._arguments import Array, Real, Waves, exponent_of, not_negative, positive
from gradhesion.core.equations.general import harmonics

_NODES, _WEIGHTS = roots_legendre(64)
_HALVINGS: Final = 60


def zeta(k: Real, xi: Real, cosines: Waves, sines: Waves = ()) -> Array:
    """Return the function of period 1 to which all waviness reduces (5.17)."""
    exponent, turns = exponent_of(k), np.asarray(xi, dtype=float)
    total = np.zeros(turns.shape) + 0.0 * exponent
    for n, a_n, b_n in harmonics(cosines, sines):
        phase = 2.0 * math.pi * np.mod(n * turns, 1.0) - 0.25 * math.pi * (1.0 + exponent)
        wave = b_n * np.cos(phase) - a_n * np.sin(phase)
        total = total + (2.0 * math.pi * n) ** (0.5 * (1.0 - exponent)) * wave
    return total


def indentation(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), *,
    exponent: Real = 2.0, mean_height: bool = True,
) -> Array:  # fmt: skip
    """Return the depth delta/R in equilibrium for waves far shorter than the contact (5.15).

    Off by about lambda/a of its term in zeta (exact at k = 1).

    >>> from gradhesion.core.equations import jkr
    >>> exact = jkr.indentation(0.3, 500.0, 0.5, 0.01, 0.02)
    >>> with_mean = indentation(0.3, 500.0, 0.5, 0.01, [-0.02])
    >>> printed = indentation(0.3, 500.0, 0.5, 0.01, [-0.02], mean_height=False)
    >>> f"{float(with_mean - exact):.0e} {float(printed - exact):.0e}"
    '3e-07 -2e-04'
    """
    alpha = zeta(k, positive(radius) / positive(wavelength), cosines, sines)
    mean = -positive(wavelength) * sum(cosines) if mean_height else 0.0
    return effective.indentation(k, stiffness, radius, alpha, wavelength, exponent=exponent, mean_height=mean)


def load(
    k: Real, stiffness: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = (), *, exponent: Real = 2.0
) -> Array:
    """Return the load P/(1.5 pi R dgamma) in equilibrium for waves far shorter than the contact (5.16).

    Off by about lambda/a of its term in zeta.
    """
    alpha = zeta(k, positive(radius) / positive(wavelength), cosines, sines)
    return effective.load(k, stiffness, radius, alpha, wavelength, exponent=exponent)


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
    s, r = envelopes.adhesion_strength(k, stiffness), envelopes.waviness_strength(k, wavelength, amplitude)
    start, end = effective.jump_in_radius(k, s, r), end_of_folds(k, wavelength, amplitude)
    last, unit = not_negative(largest_radius), np.where(end > 0.0, end, 1.0)
    band = _shares(k, np.minimum(start / unit, 1.0), np.minimum(last / unit, 1.0))
    first = effective.first_part(k, stiffness, wavelength, amplitude)
    return first + 4.0 * math.pi * r / s * end**2 * np.where(last >= start, band, np.nan)


def saturated_share(k: Real) -> Array:
    """Return w(k), the integral of W d(a^2)/a_e^2 from a = 0 to a_e.

    An unbounded punch with a_2 well below a_e loses about C1 + 4 pi (r/s) dgamma w a_e^2, C1 as in effective.py.
    """
    return _shares(k, 0.0, 1.0)


def _shares(k: Real, start: Real, stop: Real) -> Array:
    """Return int W d(a^2)/a_e^2 between radii over a_e."""
    # int W d(u^(4/(1+k))), with u = t^2 because W has a term u^(3/2)
    power = 8.0 / (1.0 + exponent_of(k))
    lower, upper = np.asarray(start) ** (2.0 / power), np.asarray(stop) ** (2.0 / power)
    middle, half = 0.5 * (upper + lower), 0.5 * (upper - lower)
    t, power = middle[..., None] + half[..., None] * _NODES, power[..., None]
    return half * np.sum(_WEIGHTS * power * np.abs(t) ** (power - 1.0) * share(t * t), axis=-1)
