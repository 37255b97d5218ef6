"""How the stiffness M = theta(k, nu) E*/c0^k of the half-space changes with the gradient exponent and Poisson's ratio.

With n = nu/(1-nu), beta^2 = (1+k)(1 - k n), u(x) = (pi/2) cot(pi x/2) - 1/x and psi the digamma function, the formula
of problem/material.py gives

    d ln theta/dp = (d ln theta/dk at fixed beta) - [psi((3+k+beta)/2) - psi((3+k-beta)/2)]/2 beta' - [2/beta + u] beta'

where beta' = (d beta^2/dp)/2 beta. As k -> 1 at nu = 1/2 beta vanishes: the terms are grouped so that only finite ones
remain.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import polygamma, psi


def _cotangent_rest(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return [(pi/2) cot(pi x/2) - 1/x]/x for |x| <= 2, by its series where x is small."""
    y = 0.5 * np.pi * x
    square = y * y
    series = -(1.0 / 3.0 + square * (1.0 / 45.0 + square * (2.0 / 945.0 + square / 4725.0)))
    with np.errstate(all="ignore"):
        direct = (y / np.tan(y) - 1.0) / square
    rest: NDArray[np.float64] = (0.5 * np.pi) ** 2 * np.where(np.abs(y) < 0.05, series, direct)
    return rest


def _psi_difference(middle: NDArray[np.float64], beta: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return [psi(middle + beta/2) - psi(middle - beta/2)]/beta, by its series where beta is small."""
    with np.errstate(all="ignore"):
        direct = (psi(middle + 0.5 * beta) - psi(middle - 0.5 * beta)) / beta
    small = beta < 2e-3
    if not small.any():  # the series takes longer than all else
        return np.asarray(direct)
    series = polygamma(1, middle) + beta * beta / 24.0 * polygamma(3, middle)
    difference: NDArray[np.float64] = np.where(small, series, direct)
    return difference


def theta_slopes(k: ArrayLike, nu: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return d ln theta/dk and d ln theta/d nu.

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    nu
        Poisson's ratio, -1 < nu <= 0.5; 0.5 where k = 1.

    Returns
    -------
    Two arrays of the broadcast shape; NaN outside the ranges. The slope by nu is NaN at k = 1, where only nu = 1/2 has
    a stiffness; that by k is then the one-sided one. Good to about 1e-12 of the larger of 1 and the slope.

    Examples
    --------
    A homogeneous half-space has theta = 1 whatever Poisson's ratio:

    >>> by_k, by_nu = theta_slopes(0.0, 0.3)
    >>> float(by_nu)
    0.0
    """
    k, nu = np.broadcast_arrays(np.asarray(k, dtype=float), np.asarray(nu, dtype=float))
    valid = (k >= 0.0) & (k <= 1.0) & (nu > -1.0) & (nu <= 0.5) & ((k < 1.0) | (nu == 0.5))
    k, nu = np.where(valid, k, 0.0), np.where(valid, nu, 0.0)
    rest = 1.0 - k
    gap = rest * nu + (1.0 - 2.0 * nu)  # (1-nu)(1 - k n)
    square = (1.0 + k) * gap / (1.0 - nu)
    beta = np.sqrt(square)
    middle = 0.5 * (3.0 + k)
    both = 0.5 * (psi(middle + 0.5 * beta) + psi(middle - 0.5 * beta))
    by_square = -0.5 * (0.5 * _psi_difference(middle, beta) + _cotangent_rest(beta))
    square_by_k = (gap - (1.0 + k) * nu) / (1.0 - nu)
    square_by_nu = -(1.0 + k) * k / (1.0 - nu) ** 2
    # ln[(1-k)/beta^2] and the rests of sin and cos
    with np.errstate(all="ignore"):
        quotient = np.where(nu == 0.5, -1.0 / (1.0 + k), (2.0 * nu - 1.0) / (rest * gap) - 1.0 / (1.0 + k))
        quotient_by_nu = np.where(k < 1.0, k / ((1.0 - nu) * gap), np.nan)
    by_k = (
        1.0 / (1.0 + k)
        + 0.5 * psi(1.0 + 0.5 * k)
        - 0.5 * psi(0.5 * (1.0 + k))
        + psi(2.0 + k)
        - both
        + quotient
        - rest * _cotangent_rest(rest)
        + by_square * square_by_k
    )
    by_nu = by_square * square_by_nu + quotient_by_nu
    return np.where(valid, by_k, np.nan), np.where(valid, by_nu, np.nan)
