"""The envelopes of a short wave, between which depth and load swing, (5.21)-(5.27).

    s = sqrt(2^(1+k) pi dgamma/M)   strength of adhesion:      Delta = s a^((1-k)/2)
    r = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2)   strength of the waviness:  its swing is r a^((1-k)/2)
    delta+- = a^2/((1+k) R) + lambda A - (s -+ r) a^((1-k)/2)                        (5.26)
    P+-     = K [2 a^(3+k)/((1+k)(3+k) R) - (s -+ r) a^((3+k)/2)]                    (5.27)

Loading runs along the upper signs, unloading along the lower ones: a smooth punch with s + r for s, whose pull-off
force is (3+k)/3 (1+r/s)^2. The printed form leaves out lambda A, the mean height of the wave. For a Fourier series r is
2^((k-1)/2) G((1+k)/2) lambda^((1+k)/2) times the maximum of zeta for loading, and minus its minimum for unloading,
(5.21)-(5.25). A paraboloid, lengths in R, loads in 1.5 pi R dgamma, M in dgamma/R^(1+k). Source: Jin, Guo & Wan (2013)
as corrected in docs/theory.md.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from gradhesion.core.equations import hertz
from gradhesion.core.equations._domain import Array, exponent_of, not_negative, positive
from gradhesion.core.equations.general import harmonics
from gradhesion.core.equations.short_waves import zeta


def adhesion_strength(k: ArrayLike, stiffness: ArrayLike) -> Array:
    """Return s/R^((1+k)/2) = sqrt(2^(1+k) pi dgamma/M).

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    stiffness
        M R^(1+k)/dgamma > 0.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges.

    Examples
    --------
    >>> float(adhesion_strength(0.0, 200.0 * np.pi).round(12))
    0.1
    """
    return np.sqrt(2.0 ** (1.0 + exponent_of(k)) * math.pi / positive(stiffness))


def waviness_strength(k: ArrayLike, wavelength: ArrayLike, amplitude: ArrayLike) -> Array:
    """Return r/R^((1+k)/2) = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2) of one cosine wave.

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    wavelength
        lambda/R > 0.
    amplitude
        A, amplitude over wavelength, >= 0.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges.

    Examples
    --------
    >>> waviness_strength([0.0, 1.0], 0.01, 0.02).round(6).tolist()
    [0.006283, 0.0002]
    """
    n = 0.5 * (1.0 + exponent_of(k))
    return math.pi ** (1.0 - n) * gamma(n) * not_negative(amplitude) * positive(wavelength) ** n


def series_strengths(
    k: ArrayLike, wavelength: ArrayLike, cosines: Sequence[float], sines: Sequence[float] = ()
) -> tuple[Array, Array]:
    """Return r/R^((1+k)/2) of a Fourier series, for loading and for unloading (5.21)-(5.25).

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    wavelength
        lambda/R > 0.
    cosines, sines
        a_1, a_2, ... and b_1, b_2, ..., over the wavelength.

    Returns
    -------
    Two arrays of the broadcast shape; NaN outside the ranges. The extrema of zeta are those of 512 samples for each
    harmonic with a parabola through the best three: 1e-9 of the sum of all amplitudes, relative.

    Examples
    --------
    >>> one, other = series_strengths(0.0, 0.01, [-0.02])
    >>> one.round(6) == other.round(6) == waviness_strength(0.0, 0.01, 0.02).round(6)
    np.True_
    """
    n = 0.5 * (1.0 + exponent_of(k))
    size = 2.0 ** (n - 1.0) * gamma(n) * positive(wavelength) ** n
    turns = np.arange(512 * max(1, len(harmonics(cosines, sines)))) / (512 * max(1, len(harmonics(cosines, sines))))
    values = zeta(np.asarray(k, dtype=float)[..., None], turns, cosines, sines)
    return size * _crest(values), size * _crest(-values)


def pull_off_force(k: ArrayLike, ratio: ArrayLike) -> Array:
    """Return the pull-off force of the unloading envelope over 1.5 pi R dgamma, (3+k)/3 (1+r/s)^2.

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    ratio
        r/s >= 0.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges. The exact force tends to it as lambda -> 0 at
    fixed r/s, with an error of the order (lambda/a)^2, below it except for k near 1.

    Examples
    --------
    >>> pull_off_force([0.0, 0.6], 0.5).round(12).tolist()
    [2.25, 2.7]
    """
    return (3.0 + exponent_of(k)) / 3.0 * (1.0 + not_negative(ratio)) ** 2


def indentation(
    k: ArrayLike,
    radius: ArrayLike,
    pull: ArrayLike,
    mean_height: ArrayLike = 0.0,
) -> Array:
    """Return the depth delta/R on an envelope (5.26).

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    radius
        a/R >= 0.
    pull
        s - r for loading, s + r for unloading, over R^((1+k)/2); may be negative.
    mean_height
        lambda A/R of the wave, or 0 for the printed form.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges.

    Examples
    --------
    >>> s, r = adhesion_strength(0.0, 500.0), waviness_strength(0.0, 0.01, 0.02)
    >>> indentation(0.0, 0.3, [s - r, s + r], 0.01 * 0.02).round(6).tolist()
    [0.032242, 0.025359]
    """
    a, c = not_negative(radius), 0.5 * (1.0 - exponent_of(k))
    smooth = hertz.power_indentation(k, a) - np.asarray(pull, dtype=float) * a**c
    return smooth + np.asarray(mean_height, dtype=float)


def load(k: ArrayLike, stiffness: ArrayLike, radius: ArrayLike, pull: ArrayLike) -> Array:
    """Return the load P/(1.5 pi R dgamma) on an envelope (5.27).

    Parameters
    ----------
    k, radius, pull
        As in `indentation`.
    stiffness
        M R^(1+k)/dgamma > 0, finite.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges.

    Examples
    --------
    >>> s, r = adhesion_strength(0.0, 500.0), waviness_strength(0.0, 0.01, 0.02)
    >>> load(0.0, 500.0, 0.3, [s - r, s + r]).round(4).tolist()
    [0.13, -0.3082]
    """
    a, exponent = not_negative(radius), exponent_of(k)
    smooth = hertz.power_indentation(k, a) * 2.0 / (3.0 + exponent)
    hold = np.asarray(pull, dtype=float) * a ** (0.5 * (1.0 - exponent))
    return hertz.disc_stiffness(k, stiffness, a) * (smooth - hold)


def _crest(values: Array) -> Array:
    """Return the maximum of a periodic function along the last axis, from samples."""
    place = np.expand_dims(np.argmax(values, axis=-1), -1)
    count = values.shape[-1]
    before, best, after = (np.take_along_axis(values, (place + i) % count, -1)[..., 0] for i in (-1, 0, 1))
    bend = 2.0 * best - before - after
    return best + np.divide((after - before) ** 2, 8.0 * bend, out=np.zeros_like(best), where=bend > 0.0)
