"""The reduced variables of the problem: its length, amplitudes over the one that adhesion can level, and the jump-in.

    L   = (R^2 dgamma/M)^(1/(3+k))
    chi = r/s,   r = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2),   s = sqrt(2^(1+k) pi dgamma/M)
    a_2 = [(1+k) R (s - r)]^(2/(3+k)), the jump-in radius of the loading envelope (5.34)

At one gradient exponent a paraboloid with one cosine wave depends on lambda/L, chi and a_max/L alone: nu, E* and c0 act
through M only (docs/theory.md). Lengths are in R. The arguments are the first of `PARAMETERS`, with their ranges, all
broadcastable; results are NaN outside the ranges, and accurate to a few units in the last place. A scene is given in
these variables by `gradhesion.core.closed.reduced`.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.equations.effective import jump_in_radius
from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.problem.material import stiffness


def similarity_length(k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike) -> NDArray[np.float64]:
    """Return L/R = (dgamma/(M R^(1+k)))^(1/(3+k)), the size of a contact that adhesion alone makes.

    On a homogeneous half-space L^3 = R^2 dgamma/E*:

    >>> float(similarity_length(0.0, 0.3, 1000.0, 0.01).round(12))
    0.1
    """
    with np.errstate(all="ignore"):  # what overflows has no value
        exponents = np.asarray(k, dtype=float)
        return np.power(stiffness(exponents, nu, modulus, c0_over_R), -1.0 / (3.0 + exponents))


def amplitude_of_ratio(
    k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike, lambda_over_R: ArrayLike, chi: ArrayLike
) -> NDArray[np.float64]:
    """Return the amplitude A over the wavelength at which the waviness is chi = r/s >= 0 times as strong as adhesion.

    At 1 the jump-in of the envelopes ends, and the pull-off force of short waves grows as (1 + chi)^2. It is the
    inverse of the report `roughness_parameter`:

    >>> from gradhesion.core import solve
    >>> scene = dict(k=0.5, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1)
    >>> scene |= {"A": amplitude_of_ratio(**scene, chi=0.25), "a_max_over_R": 1.0}
    >>> float(solve(scene, ["roughness_parameter"])["roughness_parameter"].round(12))
    0.25
    """
    with np.errstate(all="ignore"):
        ratio = np.asarray(chi, dtype=float)
        adhesion = adhesion_strength(k, stiffness(k, nu, modulus, c0_over_R))
        amplitude = np.where(ratio >= 0.0, ratio, np.nan) * adhesion / waviness_strength(k, lambda_over_R, 1.0)
    return np.where(np.isfinite(amplitude), amplitude, np.nan)


def jump_in_radius_of_envelope(
    k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike, lambda_over_R: ArrayLike, A: ArrayLike
) -> NDArray[np.float64]:
    """Return a_2/R, the radius to which the contact jumps in on the loading envelope (5.34): punches are given in it.

    NaN also where r >= s: there the waves lift the loading envelope above zero depth everywhere. Where s and r are
    close the error is that of their difference. The smooth punch of Johnson, Kendall & Roberts (1971) has
    a^3 = 2 pi R^2 dgamma/E* at zero depth:

    >>> radius = jump_in_radius_of_envelope(0.0, 0.3, 500.0, 0.01, 0.1, A=0.0)
    >>> round(float(radius**3 * 500.0 / (2.0 * np.pi)), 12)
    1.0
    """
    with np.errstate(all="ignore"):
        adhesion = adhesion_strength(k, stiffness(k, nu, modulus, c0_over_R))
        return jump_in_radius(k, adhesion, waviness_strength(k, lambda_over_R, A))
