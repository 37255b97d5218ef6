"""The reduced variables of the problem: its length, and amplitudes in units of the one that adhesion can level.

    L   = (R^2 dgamma/M)^(1/(3+k))
    chi = r/s,   r = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2),   s = sqrt(2^(1+k) pi dgamma/M)

At one gradient exponent a paraboloid with one cosine wave depends on lambda/L, chi and a_max/L alone: nu, E* and c0 act
through M only (docs/theory.md). Lengths are in R. A scene is given in these variables by
`gradhesion.core.variables.reduced`.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.problem.material import stiffness


def similarity_length(k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike) -> NDArray[np.float64]:
    """Return L/R = (dgamma/(M R^(1+k)))^(1/(3+k)), the size of a contact that adhesion alone makes.

    Parameters
    ----------
    k, nu, modulus, c0_over_R
        The first four of `PARAMETERS`, with their ranges; all broadcastable.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges. Accurate to a few units in the last place.

    Examples
    --------
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
    """Return the amplitude A over the wavelength at which the waviness is chi = r/s times as strong as adhesion.

    Parameters
    ----------
    k, nu, modulus, c0_over_R, lambda_over_R
        The first five of `PARAMETERS`, with their ranges; all broadcastable with `chi`.
    chi
        r/s >= 0, (5.26): at 1 the jump-in ends, and the pull-off force of short waves grows as (1 + chi)^2.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges. Accurate to a few units in the last place.

    Examples
    --------
    It is the inverse of the report `roughness_parameter`:

    >>> from gradhesion.core import solve
    >>> scene = dict(k=0.5, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1)
    >>> scene |= {"A": amplitude_of_ratio(**scene, chi=0.25), "a_max_over_R": 1.0}
    >>> float(solve(scene, ["roughness_parameter"])["roughness_parameter"].round(12))
    0.25
    """
    with np.errstate(all="ignore"):  # what overflows has no value
        ratio = np.asarray(chi, dtype=float)
        adhesion = adhesion_strength(k, stiffness(k, nu, modulus, c0_over_R))
        amplitude = np.where(ratio >= 0.0, ratio, np.nan) * adhesion / waviness_strength(k, lambda_over_R, 1.0)
    return np.where(np.isfinite(amplitude), amplitude, np.nan)
