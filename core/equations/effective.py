"""The effective path of short waves and the energy that a cycle along it loses, (5.28)-(5.43).

Loading jumps in at zero depth to a_2, climbs the loading envelope to a_am, and unloads first at that radius, pinned by
the barrier of one wave, along the line of a flat punch to the unloading envelope, which it descends to a_4, where
contact ends. On the line depth and load are those of the smooth adhesive punch and g a_am^((1-k)/2) alpha, g of
`envelopes.depth_over_zeta`: alpha = zeta_max is the loading envelope, zeta_min the unloading one. The mean height of
the waves, which the printed forms leave out, raises depths by -lambda sum a_n. The cycle loses, with the strengths s of
adhesion and r of the waviness as in envelopes.py, and x = r/s < 1,

    H = C1 + C2,   C1 = pi dgamma { a_2^2 [(1+x)^2 - 2 (1-x)^2/(5+k)] + (1+x)^2 e a_4^2 }
    e  = 16 t^2/((1+k)(3+k)(5+k)) - 8 t/((1+k)(3+k)) + 2/(1+k) - 1,           t = (1-k)/4
    C2 = 4 pi x dgamma (a_am^2 - a_2^2)
    H ~ F0 dgamma L^2 + F1 A lambda^((1+k)/2) dgamma R L^((1-k)/2) + C2,   L = (R^2 dgamma/M)^(1/(3+k))   (5.43)

C1 is a cycle that turns at a_2, C2 the band between the envelopes from a_2 to a_am; the second form of H is of first
order in r. F0 and F1 are closed forms in k as well, so that none needs the paper's fitted polynomials. C2 grows without
bound with a_am: the envelopes do not include the radius at which folds end. The punch is a paraboloid with one cosine
wave, but for the line of early unloading.
"""

import math

import numpy as np

from gradhesion.core.equations import envelopes, hertz, jkr
from gradhesion.core.equations._arguments import Array, Real, Waves, exponent_of, not_negative, positive


def indentation(
    k: Real, stiffness: Real, radius: Real, alpha: Real, wavelength: Real, *,
    exponent: Real = 2.0, mean_height: Real = 0.0,
) -> Array:  # fmt: skip
    """Return the depth delta/R of early unloading at the radius a_am, for a value alpha of zeta (5.28)."""
    smooth = hertz.power_indentation(k, radius, exponent) - jkr.adhesive_depth(k, stiffness, radius)
    swing = envelopes.depth_over_zeta(k, radius, wavelength) * np.asarray(alpha, dtype=float)
    return smooth + swing + np.asarray(mean_height, dtype=float)


def load(k: Real, stiffness: Real, radius: Real, alpha: Real, wavelength: Real, *, exponent: Real = 2.0) -> Array:
    """Return the load P/(1.5 pi R dgamma) of early unloading at the radius a_am, for a value alpha of zeta (5.29)."""
    pull = envelopes.adhesion_strength(k, stiffness)
    swing = envelopes.depth_over_zeta(k, radius, wavelength) * np.asarray(alpha, dtype=float)
    return envelopes.load(k, stiffness, radius, pull, exponent) + hertz.disc_stiffness(k, stiffness, radius) * swing


def load_at_depth(
    k: Real, stiffness: Real, radius: Real, depth: Real, *, exponent: Real = 2.0, mean_height: Real = 0.0
) -> Array:
    """Return P/(1.5 pi R dgamma) on the line of early unloading at a depth, for any power and series (5.30).

    It is that of the smooth punch pinned at a_am.
    """
    lowered = np.asarray(depth, dtype=float) - np.asarray(mean_height, dtype=float)
    return jkr.load_at_depth(k, stiffness, radius, lowered, 1.0, 0.0, exponent)


def drop(k: Real, radius: Real, wavelength: Real, cosines: Waves, sines: Waves = ()) -> Array:
    """Return the depth over which the line of early unloading of a series runs, over R (5.31).

    One cosine has 2 r a_am^((1-k)/2), which (5.33) should print.
    """
    lowest, highest = envelopes.zeta_extrema(k, cosines, sines)
    return envelopes.depth_over_zeta(k, radius, wavelength) * (highest - lowest)


def early_unloading_load(k: Real, stiffness: Real, radius: Real, depth: Real, mean_height: Real = 0.0) -> Array:
    """Return K [a_am^(1+k) (delta - lambda A) - a_am^(3+k)/(3+k)], (5.30) of a paraboloid (5.32)."""
    return load_at_depth(k, stiffness, radius, depth, mean_height=mean_height)


def early_unloading_depth(k: Real, radius: Real, waviness: Real) -> Array:
    """Return the depth over which the line of one cosine runs, 2 r a_am^((1-k)/2), over R (5.33)."""
    return 2.0 * not_negative(waviness) * not_negative(radius) ** (0.5 * (1.0 - exponent_of(k)))


def jump_in_radius(k: Real, adhesion: Real, waviness: Real) -> Array:
    """Return a_2/R = [(1+k) (s-r)]^(2/(3+k)), to which contact jumps when it begins (5.34).

    NaN for r >= s: the loading envelope then starts at a = 0 without a jump.

    >>> jump_in_radius(0.0, 0.1, [0.0, 0.05, 0.1]).round(6).tolist()
    [0.215443, 0.135721, nan]
    """
    return envelopes.power_radii(k, positive(np.asarray(adhesion) - not_negative(waviness)))[0]


def jump_out_radius(k: Real, adhesion: Real, waviness: Real) -> Array:
    """Return a_4/R = [(1-k^2)/4 (s+r)]^(2/(3+k)), from which contact jumps when it ends, any r >= 0 (5.35)."""
    return envelopes.power_radii(k, not_negative(adhesion) + not_negative(waviness))[1]


def first_part(k: Real, stiffness: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return C1/(R^2 dgamma), the energy of a cycle along the effective path that turns at a_2 (5.37), (5.39).

    NaN for r >= s.

    A smooth punch on a homogeneous half-space loses 7.0922 (dgamma^5 R^4/E*^2)^(1/3):

    >>> float(first_part(0.0, 1000.0, 0.1, 0.0).round(6))
    0.070922
    """
    exponent, s = exponent_of(k), envelopes.adhesion_strength(k, stiffness)
    r = envelopes.waviness_strength(k, wavelength, amplitude)
    up, down, x = jump_in_radius(k, s, r), jump_out_radius(k, s, r), r / s
    inner = up**2 * ((1.0 + x) ** 2 - 2.0 * (1.0 - x) ** 2 / (5.0 + exponent))
    return math.pi * (inner + (1.0 + x) ** 2 * _end_factor(exponent) * down**2)


def second_part(k: Real, stiffness: Real, wavelength: Real, amplitude: Real, largest_radius: Real) -> Array:
    """Return C2/(R^2 dgamma), the energy of the band between the envelopes from a_2 to a_am (5.38), (5.42).

    NaN for r >= s and for a_am < a_2.
    """
    s, r = envelopes.adhesion_strength(k, stiffness), envelopes.waviness_strength(k, wavelength, amplitude)
    area = not_negative(largest_radius) ** 2 - jump_in_radius(k, s, r) ** 2
    return 4.0 * math.pi * r / s * np.where(area >= 0.0, area, np.nan)


def dissipated_energy(k: Real, stiffness: Real, wavelength: Real, amplitude: Real, largest_radius: Real) -> Array:
    """Return H/(R^2 dgamma) = C1 + C2, exact for the effective path (5.36).

    NaN for r >= s and for a_am < a_2; `solve` with solver="envelope" covers those as well.

    >>> dissipated_energy(0.0, 1000.0, 0.1, [0.0, 0.005], 0.5).round(6).tolist()
    [0.070922, 0.256852]
    """
    first = first_part(k, stiffness, wavelength, amplitude)
    return first + second_part(k, stiffness, wavelength, amplitude, largest_radius)


def smooth_coefficient(k: Real) -> Array:
    """Return F0(k) of (5.43): a smooth punch loses F0 dgamma L^2 in a cycle, which is C1 of M = 1."""
    return first_part(k, 1.0, 1.0, 0.0)


def waviness_coefficient(k: Real) -> Array:
    """Return F1(k) of (5.43): C1 gains F1 A lambda^((1+k)/2) dgamma R L^((1-k)/2) to first order in r."""
    exponent, s = exponent_of(k), envelopes.adhesion_strength(k, 1.0)
    power = 4.0 / (3.0 + exponent)
    # d/dx at 0 of (1-x)^power [(1+x)^2 - 2 (1-x)^2/(5+k)] and of (1+x)^(2+power) e
    inner = jump_in_radius(k, s, 0.0) ** 2 * (2.0 - power + (4.0 + 2.0 * power) / (5.0 + exponent))
    rate = inner + jump_out_radius(k, s, 0.0) ** 2 * (2.0 + power) * _end_factor(exponent)
    return math.pi * rate * envelopes.waviness_strength(k, 1.0, 1.0) / s


def fitted_smooth_coefficient(k: Real) -> Array:
    """Return the paper's polynomial for F0(k), 7.1 + 9.1 k - 1.4 k^2 (5.40), within 0.33 % of it."""
    exponent = exponent_of(k)
    return 7.1 + 9.1 * exponent - 1.4 * exponent**2


def fitted_waviness_coefficient(k: Real) -> Array:
    """Return the paper's polynomial for F1(k), 29.6 - 23.6 k + 6.5 k^2 (5.41), within 0.53 % of it."""
    exponent = exponent_of(k)
    return 29.6 - 23.6 * exponent + 6.5 * exponent**2


def fitted_energy(k: Real, stiffness: Real, wavelength: Real, amplitude: Real, largest_radius: Real) -> Array:
    """Return H/(R^2 dgamma) by (5.43) with the paper's polynomials and the corrected exponents.

    NaN for r >= s and for a_am < a_2. At a_am = 2 a_2 it is above `dissipated_energy` by up to 0.3 %, 1.5 %, 7.5 % and
    19 % for r/s = 0.03, 0.1, 0.3 and 0.5, for every M.
    """
    exponent = exponent_of(k)
    length = positive(stiffness) ** (-1.0 / (3.0 + exponent))
    rough = not_negative(amplitude) * positive(wavelength) ** (0.5 * (1.0 + exponent))
    first = fitted_smooth_coefficient(k) * length**2
    first = first + fitted_waviness_coefficient(k) * rough * length ** (0.5 * (1.0 - exponent))
    return first + second_part(k, stiffness, wavelength, amplitude, largest_radius)


def _end_factor(k: Array) -> Array:
    """Return e, epsilon(t) of docs/theory.md, section 11, at t = (1-k)/4."""
    t = 0.25 * (1.0 - k)
    return (16.0 * t * t / (5.0 + k) - 8.0 * t) / ((1.0 + k) * (3.0 + k)) + 2.0 / (1.0 + k) - 1.0
