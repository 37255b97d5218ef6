"""The energy that a cycle along the effective path dissipates, (5.36)-(5.43), and its fits.

    H = C1 + C2
    C1 = pi dgamma { a_2^2 [(1+x)^2 - 2 (1-x)^2/(5+k)] + (1+x)^2 e a_4^2 },   x = r/s < 1
    e  = 16 t^2/((1+k)(3+k)(5+k)) - 8 t/((1+k)(3+k)) + 2/(1+k) - 1,           t = (1-k)/4
    C2 = 4 pi x dgamma (a_am^2 - a_2^2)
       = A G((1+k)/2) sqrt(2^(3-k) pi^(2-k) lambda^(1+k) dgamma M) (a_am^2 - a_2^2)

C1 is a cycle that turns at a_2: a line of early unloading at a_2, then the unloading envelope to a_4. C2 is the band
between the envelopes from a_2 to a_am. Both are closed forms, so that none needs a fit. Expanded in r to first order,

    H ~ F0 dgamma L^2 + F1 A lambda^((1+k)/2) dgamma R L^((1-k)/2) + C2,   L = (R^2 dgamma/M)^(1/(3+k))        (5.43)

F0 and F1 are closed forms in k as well; the paper has polynomials fitted to them. C2 grows without bound with a_am: the
envelopes do not include the radius at which folds end. The punch is a paraboloid with one
cosine wave.
"""

import math

import numpy as np
from scipy.special import gamma

from gradhesion.core.equations import effective, envelopes
from gradhesion.core.equations._arguments import Array, Real, describe, exponent_of, not_negative, positive


def first_part(k: Real, stiffness: Real, wavelength: Real, amplitude: Real) -> Array:
    """Return C1/(R^2 dgamma), the energy of a cycle along the effective path that turns at a_2.

    NaN for r >= s.

    A smooth punch on a homogeneous half-space loses 7.0922 (dgamma^5 R^4/E*^2)^(1/3):

    >>> float(first_part(0.0, 1000.0, 0.1, 0.0).round(6))
    0.070922
    """
    exponent, s = exponent_of(k), envelopes.adhesion_strength(k, stiffness)
    r = envelopes.waviness_strength(k, wavelength, amplitude)
    up, down, x = effective.jump_in_radius(k, s, r), effective.jump_out_radius(k, s, r), r / s
    inner = up**2 * ((1.0 + x) ** 2 - 2.0 * (1.0 - x) ** 2 / (5.0 + exponent))
    return math.pi * (inner + (1.0 + x) ** 2 * _end_factor(exponent) * down**2)


def second_part(k: Real, stiffness: Real, wavelength: Real, amplitude: Real, largest_radius: Real) -> Array:
    """Return C2/(R^2 dgamma), the energy of the band between the envelopes from a_2 to a_am.

    NaN for r >= s and for a_am < a_2.
    """
    n, s = 0.5 * (1.0 + exponent_of(k)), envelopes.adhesion_strength(k, stiffness)
    length, ratio = positive(wavelength), not_negative(amplitude)
    start = effective.jump_in_radius(k, s, envelopes.waviness_strength(k, length, ratio))
    area = not_negative(largest_radius) ** 2 - start**2
    root = np.sqrt(2.0 ** (4.0 - 2.0 * n) * math.pi ** (3.0 - 2.0 * n) * length ** (2.0 * n) * positive(stiffness))
    return ratio * gamma(n) * root * np.where(area >= 0.0, area, np.nan)


def dissipated_energy(k: Real, stiffness: Real, wavelength: Real, amplitude: Real, largest_radius: Real) -> Array:
    """Return H/(R^2 dgamma) = C1 + C2, exact for the effective path.

    NaN for r >= s and for a_am < a_2; `solve` with solver="envelope" covers those as well.

    >>> dissipated_energy(0.0, 1000.0, 0.1, [0.0, 0.005], 0.5).round(6).tolist()
    [0.070922, 0.256852]
    """
    first = first_part(k, stiffness, wavelength, amplitude)
    return first + second_part(k, stiffness, wavelength, amplitude, largest_radius)


def smooth_coefficient(k: Real) -> Array:
    """Return F0(k) of (5.43): a smooth punch loses F0 dgamma L^2 in a cycle."""
    exponent = exponent_of(k)
    power, q = 4.0 / (3.0 + exponent), 0.25 * (1.0 - exponent)
    return math.pi * _area_of_jump_in(exponent) * (1.0 - 2.0 / (5.0 + exponent) + _end_factor(exponent) * q**power)


def waviness_coefficient(k: Real) -> Array:
    """Return F1(k) of (5.43): C1 gains F1 A lambda^((1+k)/2) dgamma R L^((1-k)/2) to first order in r."""
    exponent = exponent_of(k)
    n, power, q = 0.5 * (1.0 + exponent), 4.0 / (3.0 + exponent), 0.25 * (1.0 - exponent)
    # d/dx of (1-x)^power [(1+x)^2 - 2 (1-x)^2/(5+k)] + (1+x)^(2+power) F q^power at x = 0
    rate = 2.0 - power + (4.0 + 2.0 * power) / (5.0 + exponent)
    rate = rate + (2.0 + power) * _end_factor(exponent) * q**power
    ratio = math.pi ** (1.0 - n) * gamma(n) / np.sqrt(2.0 ** (1.0 + exponent) * math.pi)
    return math.pi * _area_of_jump_in(exponent) * rate * ratio


def fitted_smooth_coefficient(k: Real) -> Array:
    """Return the paper's polynomial for F0(k), 7.1 + 9.1 k - 1.4 k^2.

    Within 0.33 % of `smooth_coefficient`.
    """
    exponent = exponent_of(k)
    return 7.1 + 9.1 * exponent - 1.4 * exponent**2


def fitted_waviness_coefficient(k: Real) -> Array:
    """Return the paper's polynomial for F1(k), 29.6 - 23.6 k + 6.5 k^2.

    Within 0.53 % of `waviness_coefficient`.
    """
    exponent = exponent_of(k)
    return 29.6 - 23.6 * exponent + 6.5 * exponent**2


def fitted_energy(k: Real, stiffness: Real, wavelength: Real, amplitude: Real, largest_radius: Real) -> Array:
    """Return H/(R^2 dgamma) by (5.43) with the paper's polynomials and the corrected exponents.

    NaN for r >= s and for a_am < a_2. At a_am = 2 a_2 it is above `dissipated_energy` by up to 0.3 %, 1.5 %, 7.5 % and
    19 % for r/s = 0.03, 0.1, 0.3 and 0.5, for every M.

    >>> fitted_energy(0.0, 1000.0, 0.1, [0.0, 0.005], 0.5).round(4).tolist()
    [0.071, 0.2581]
    """
    exponent = exponent_of(k)
    length = positive(stiffness) ** (-1.0 / (3.0 + exponent))
    rough = not_negative(amplitude) * positive(wavelength) ** (0.5 * (1.0 + exponent))
    first = fitted_smooth_coefficient(k) * length**2
    first = first + fitted_waviness_coefficient(k) * rough * length ** (0.5 * (1.0 - exponent))
    return first + second_part(k, stiffness, wavelength, amplitude, largest_radius)


def _end_factor(k: Array) -> Array:
    """Return epsilon(t) of docs/theory.md, section 11, at t = (1-k)/4."""
    t = 0.25 * (1.0 - k)
    return (16.0 * t * t / (5.0 + k) - 8.0 * t) / ((1.0 + k) * (3.0 + k)) + 2.0 / (1.0 + k) - 1.0


def _area_of_jump_in(k: Array) -> Array:
    """Return (a_2/L)^2 of the smooth punch."""
    return ((1.0 + k) * np.sqrt(2.0 ** (1.0 + k) * math.pi)) ** (4.0 / (3.0 + k))


describe(__name__)
