"""The graded half-space: one number for stiffness.

    beta  = sqrt((1+k) (1 - k nu/(1-nu)))
    theta = sqrt(pi) (1+k) G(1+k/2) G(2+k) / [G((1+k)/2) G((3+k+beta)/2) G((3+k-beta)/2)]
            cos(k pi/2)/(beta sin(beta pi/2))
    M     = theta E*/c0^k

(3.3) and (4.6) of Jin, Guo & Wan (2013). As k -> 1 at nu = 1/2 the last quotient is 0/0; it is evaluated as a whole.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.struve.current import ready_for_theta
from gradhesion.core.struve.theta import front_of, gammas_by_table, gammas_of, sinc
from gradhesion.core.types import Floats, Integers, Table, Tables


@kernel(entry=True)
def _square(k: float, nu: float) -> float:
    """Return beta^2 without cancellation at k = 1, nu = 1/2."""
    return (1.0 + k) * ((1.0 - k) * nu + (1.0 - 2.0 * nu)) / (1.0 - nu)


@kernel(entry=True)
def _wave(k: float) -> float:
    """Return sinc((1-k)/2)."""
    return sinc(0.5 * (1.0 - k))  # 1 - k is exact near k = 1


@kernel(entry=True)
def _rest(k: float, nu: float, wave: float) -> float:
    """Return cos(k pi/2)/(beta sin(beta pi/2)) times sinc(beta/2): (1-k)/beta^2 times `_wave`."""
    rest = 1.0 - k
    quotient = (1.0 - nu) / ((1.0 + k) * (nu + (1.0 - 2.0 * nu) / rest)) if rest > 0.0 else 0.5
    return quotient * wave


@kernel(entry=True)
def _is_out_of_range(k: float, nu: float) -> bool:
    """Return whether theta has no value: outside 0 <= k <= 1, -1 < nu <= 1/2, and at k = 1, nu < 1/2 (no stiffness)."""
    return not (0.0 <= k <= 1.0 and -1.0 < nu <= 0.5) or (k == 1.0 and nu < 0.5)


@kernel()
def theta_of(k: float, nu: float) -> float:
    """Return theta, NaN out of range."""
    if _is_out_of_range(k, nu):
        return math.nan
    return front_of(k) * gammas_of(k, _square(k, nu)) * _rest(k, nu, _wave(k))


@kernel()
def _theta_by_table(table: Table, k: float, nu: float, wave: float) -> float:
    """Return theta, NaN out of range; the table is that of k, if k has one, and `wave` that of `_wave`."""
    if _is_out_of_range(k, nu):
        return math.nan
    return table.theta_front * gammas_by_table(table, _square(k, nu)) * _rest(k, nu, wave)


@kernel(entry=True)
def _thetas(k: Floats, nu: Floats, out: Floats) -> None:
    """Put theta of each k and nu into `out`, all of shape (n,)."""
    for i in range(k.size):
        out[i] = theta_of(k[i], nu[i])


def theta(k: ArrayLike, nu: ArrayLike) -> NDArray[np.float64]:
    """Return theta(k, nu), the stiffness of the graded half-space relative to E*/c0^k (3.3).

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    nu
        Poisson's ratio, -1 < nu <= 0.5; 0.5 where k = 1.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges. Accurate to a few units in the last place.

    Examples
    --------
    >>> theta([0.0, 1.0], [0.3, 0.5]).round(12).tolist()
    [1.0, 3.14159265359]
    """
    exponents, ratios = np.broadcast_arrays(np.asarray(k, dtype=float), np.asarray(nu, dtype=float))
    out = np.empty(exponents.size)
    _thetas(np.array(exponents).ravel(), np.array(ratios).ravel(), out)
    return out.reshape(exponents.shape)


@kernel()
def fill_stiffness(
    tables: Tables,
    which: Integers,
    index: Integers,
    k: Floats,
    nu: Floats,
    modulus: Floats,
    c0_over_R: Floats,
    out: Floats,
) -> None:
    """Put M R^(1+k)/dgamma of the curves `index` into `out`, NaN outside the ranges.

    `which` are their tables: both of shape (n,); the rest are numbers of all curves, of
    shape (curves,), as of `stiffness`.
    """
    value, power, wave = math.nan, math.nan, math.nan
    before = index[0] if index.size > 0 else 0
    for j in range(index.size):
        i = index[j]
        if j == 0 or k[i] != k[before]:
            wave = _wave(k[i])
        if j == 0 or k[i] != k[before] or nu[i] != nu[before]:
            value = _theta_by_table(tables[ready_for_theta(tables, which[j])], k[i], nu[i], wave)
        if j == 0 or k[i] != k[before] or c0_over_R[i] != c0_over_R[before]:
            power = c0_over_R[i] ** k[i]
        before = i
        valid = modulus[i] > 0.0 and c0_over_R[i] > 0.0
        out[i] = value * modulus[i] / power if valid else math.nan


def stiffness(k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike) -> NDArray[np.float64]:
    """Return M R^(1+k)/dgamma = theta (E* R/dgamma)/(c0/R)^k (4.6), the one number through which the material acts.

    Parameters
    ----------
    k, nu
        As in `theta`.
    modulus
        E* R/dgamma > 0.
    c0_over_R
        Reference depth of the gradient over the punch radius, > 0.

    Returns
    -------
    Array of the broadcast shape; NaN outside the ranges.

    Examples
    --------
    At k = 1 and nu = 1/2 theta is pi:

    >>> float(stiffness(1.0, 0.5, 100.0, 0.25).round(10))
    1256.6370614359
    """
    exponents = np.asarray(k, dtype=float)
    depths = np.asarray(c0_over_R, dtype=float)
    moduli = np.asarray(modulus, dtype=float)
    valid = (moduli > 0.0) & (depths > 0.0)
    return theta(exponents, nu) * np.where(valid, moduli, np.nan) / np.power(np.where(valid, depths, 1.0), exponents)
