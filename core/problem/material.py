"""The graded half-space: one number for stiffness.

    beta^2 = (1+k) (1 - k nu/(1-nu))
    theta  = sqrt(pi) (1+k) G(1+k/2) G(2+k) / [G((1+k)/2) G((3+k+beta)/2) G((3+k-beta)/2)]
             cos(k pi/2)/(beta sin(beta pi/2))
    M      = theta E*/c0^k

(3.3) and (4.6) of Jin, Guo & Wan (2013). As k -> 1 at nu = 1/2 the last quotient is 0/0: it is taken as a whole, the
zeros divided out. The slopes of ln theta are its terms' own, grouped so that only finite ones remain there.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.jit import kernel
from gradhesion.core.types import Floats


@kernel
def theta_of(k: float, nu: float) -> float:
    """Return theta, NaN out of range: outside 0 <= k <= 1, -1 < nu <= 1/2, and at k = 1, nu < 1/2 (no stiffness)."""
    if not (0.0 <= k <= 1.0 and -1.0 < nu <= 0.5) or (k == 1.0 and nu < 0.5):
        return math.nan
    rest = 1.0 - k  # exact near k = 1
    beta = math.sqrt((1.0 + k) * (rest * nu + (1.0 - 2.0 * nu)) / (1.0 - nu))
    gammas = math.gamma(1.0 + 0.5 * k) * math.gamma(2.0 + k) / math.gamma(0.5 * (1.0 + k))
    gammas /= math.gamma(0.5 * (3.0 + k + beta)) * math.gamma(0.5 * (3.0 + k - beta))
    # cos(k pi/2) = sin(rest pi/2) and beta sin(beta pi/2) over their first terms, whose quotient is rest/beta^2
    over, under = 0.5 * math.pi * rest, 0.5 * math.pi * beta
    quotient = (1.0 - nu) / ((1.0 + k) * (nu + (1.0 - 2.0 * nu) / rest)) if rest > 0.0 else 0.5
    quotient *= (math.sin(over) / over if over > 0.0 else 1.0) * (under / math.sin(under) if under > 0.0 else 1.0)
    return math.sqrt(math.pi) * (1.0 + k) * gammas * quotient


@kernel
def _fill_thetas(k: Floats, nu: Floats, out: Floats) -> None:
    """Put theta of each k and nu into `out`, all of shape (n,)."""
    for i in range(k.size):
        out[i] = theta_of(k[i], nu[i])


def theta(k: ArrayLike, nu: ArrayLike) -> NDArray[np.float64]:
    """Return theta(k, nu), the stiffness of the graded half-space relative to E*/c0^k (3.3).

    `k` is the gradient exponent, 0 to 1, and `nu` Poisson's ratio, -1 < nu <= 0.5; 0.5 where k = 1. An array of the
    broadcast shape; NaN outside the ranges. Accurate to a few units in the last place.

    >>> theta([0.0, 1.0], [0.3, 0.5]).round(12).tolist()
    [1.0, 3.14159265359]
    """
    exponents, ratios = np.broadcast_arrays(np.asarray(k, dtype=float), np.asarray(nu, dtype=float))
    out = np.empty(exponents.size)
    _fill_thetas(np.array(exponents).ravel(), np.array(ratios).ravel(), out)
    return out.reshape(exponents.shape)


def stiffness(k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike) -> NDArray[np.float64]:
    """Return M R^(1+k)/dgamma = theta (E* R/dgamma)/(c0/R)^k (4.6), the one number through which the material acts.

    `k` and `nu` as in `theta`; `modulus` E* R/dgamma > 0; `c0_over_R` > 0, the reference depth of the gradient over
    the radius of the punch. An array of the broadcast shape; NaN outside the ranges.

    >>> float(stiffness(1.0, 0.5, 100.0, 0.25).round(10))  # theta is pi
    1256.6370614359
    """
    exponents, moduli, depths = (np.asarray(one, dtype=float) for one in (k, modulus, c0_over_R))
    valid = (moduli > 0.0) & (depths > 0.0)
    return theta(exponents, nu) * np.where(valid, moduli, np.nan) / np.power(np.where(valid, depths, 1.0), exponents)


def _cotangent_rest(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return [(pi/2) cot(pi x/2) - 1/x]/x for |x| <= 2, by its series where x is small."""
    y = 0.5 * np.pi * x
    square = y * y
    series = -(1.0 / 3.0 + square * (1.0 / 45.0 + square * (2.0 / 945.0 + square / 4725.0)))
    rest: NDArray[np.float64] = (0.5 * np.pi) ** 2 * np.where(np.abs(y) < 0.05, series, (y / np.tan(y) - 1.0) / square)
    return rest


def theta_slopes(k: ArrayLike, nu: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return d ln theta/dk and d ln theta/dnu, two arrays of the broadcast shape; NaN outside the ranges of `theta`.

    The slope by nu is NaN at k = 1, where only nu = 1/2 has a stiffness; that by k is then the one-sided one. Good to
    1e-12 of the larger of 1 and the slope.

    >>> round(float(theta_slopes(1.0, 0.5)[0]), 9)  # 1 - ln 2
    0.306852819
    """
    from scipy.special import polygamma, psi  # noqa: PLC0415 (200 ms that only sensitivities need)

    k, nu = np.broadcast_arrays(np.asarray(k, dtype=float), np.asarray(nu, dtype=float))
    valid = (k >= 0.0) & (k <= 1.0) & (nu > -1.0) & (nu <= 0.5) & ((k < 1.0) | (nu == 0.5))
    k, nu = np.where(valid, k, np.nan), np.where(valid, nu, np.nan)
    rest, middle = 1.0 - k, 0.5 * (3.0 + k)
    gap = rest * nu + (1.0 - 2.0 * nu)  # (1-nu) beta^2/(1+k)
    beta = np.sqrt((1.0 + k) * gap / (1.0 - nu))
    above, below = psi(middle + 0.5 * beta), psi(middle - 0.5 * beta)
    with np.errstate(all="ignore"):  # each case has its own terms
        series = polygamma(1, middle) + beta * beta / 24.0 * polygamma(3, middle)
        difference = np.where(beta < 2e-3, series, (above - below) / beta)
        by_square = -0.25 * difference - 0.5 * _cotangent_rest(beta)  # but for the slopes of rest/beta^2:
        quotient_by_k = np.where(nu == 0.5, 0.0, (2.0 * nu - 1.0) / (rest * gap)) - 1.0 / (1.0 + k)
        quotient_by_nu = np.where(k < 1.0, k / ((1.0 - nu) * gap), np.nan)
        fixed = 1.0 / (1.0 + k) + psi(2.0 + k) + 0.5 * (psi(1.0 + 0.5 * k) - psi(0.5 * (1.0 + k)) - above - below)
        by_k = fixed + quotient_by_k - rest * _cotangent_rest(rest) + by_square * (gap - (1.0 + k) * nu) / (1.0 - nu)
        by_nu = quotient_by_nu - by_square * (1.0 + k) * k / (1.0 - nu) ** 2
    return by_k, by_nu
