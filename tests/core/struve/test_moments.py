"""The moments of S0 against quadrature at 20 digits and against their differential equations."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import mpmath
import numba
import numpy as np
import pytest

from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.moments import moments
from gradhesion.core.struve.pair import pair
from gradhesion.core.struve.power import amplitude_power

pytestmark = pytest.mark.slow

EPS = 2.0**-52
EXPONENTS = [0.0, 1e-10, 0.43, 0.5, 0.92, 1 - 1e-12, 1.0]


@numba.njit
def _moments(table: Any, x: float) -> tuple[float, float]:
    return moments(table, x, amplitude_power(table, TWO_PI * x))


@numba.njit
def _s0(table: Any, x: float) -> float:
    return pair(table, x)[0]


def _exact(
    k: float, z: mpmath.mpf, pair: Callable[..., tuple[mpmath.mpf, mpmath.mpf]]
) -> tuple[mpmath.mpf, mpmath.mpf]:
    places = [mpmath.mpf(0), *[mpmath.mpf(3 * i) for i in range(1, 1 + int(z / 3))], z]
    s0 = lru_cache(maxsize=None)(lambda y: pair(k, y)[0])  # both integrals have the same nodes
    e2 = mpmath.quad(lambda y: y ** (k + 3) * s0(y) if y else mpmath.mpf(0), places)
    w = mpmath.quad(lambda y: y ** (k + 2) * s0(y) ** 2 if y else mpmath.mpf(0), places)
    return e2, w


@pytest.mark.parametrize("k", [0.0, 0.43, 1.0])
@pytest.mark.parametrize("x", [0.011, 0.31, 0.33, 2.9, 6.36, 6.38, 9.7])
def test_against_quadrature(
    k: float, x: float, table_of: Callable[[float], Any], slow_pair: Callable[..., tuple[mpmath.mpf, mpmath.mpf]]
) -> None:
    mpmath.mp.dps = 20
    z = 2 * mpmath.pi * mpmath.mpf(x)
    e2, w = _exact(k, z, slow_pair)
    value, square = _moments(table_of(k), x)
    # E2 swings about 0: relative to the amplitude of its leading term z^(k+4) S1/(k+1); W is a sum of squares
    size = max(abs(e2), z ** (k + 3 - (1 + mpmath.mpf(k)) / 2) if z > 1 else mpmath.mpf(0))
    assert abs(value * z ** (k + 5) - e2) <= 8 * EPS * size
    # beyond z = 40 the power z^(-(1+k)/2), good to 2.5 eps, enters squared, and W is a sum of four parts and a constant
    assert abs(square * z ** (k + 5) / w - 1) <= 12 * EPS


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("x", [0.2, 1.3, 5.9, 6.5, 30.1, 640.3, 1e4])
def test_they_solve_their_equations(k: float, x: float, table_of: Callable[[float], Any]) -> None:
    """E2 and W between two close radii, by Gauss's rule on the pair."""
    table = table_of(k)
    nodes, weights = np.polynomial.legendre.leggauss(24)
    inner, outer = x, x + 0.4
    places = inner + 0.5 * (outer - inner) * (1 + nodes)
    s0 = np.array([_s0(table, place) for place in places])
    ends = np.array([_moments(table, inner), _moments(table, outer)])
    ends *= np.array([inner, outer])[:, None] ** (k + 5)
    for lane, integrand in enumerate([places ** (k + 3) * s0, places ** (k + 2) * s0**2 / TWO_PI]):
        # in units of (2 pi)^(k+5): int z^(k+3) S0 dz = (2 pi)^(k+4) int x^(k+3) S0 dx, and so on
        step = 0.5 * (outer - inner) * float(np.sum(weights * integrand)) / TWO_PI
        difference = ends[1, lane] - ends[0, lane]
        size = np.abs(ends[:, lane]).max() + TWO_PI**-1 * float(np.abs(integrand).max())
        # the powers x^(k+5) and x^(k+3) of the test and the moments of 8 eps at either end; and the nodes are rounded,
        # each by up to half an ulp of x, which the waves feel
        assert abs(difference - step) <= 32 * EPS * size + EPS * outer * float(np.abs(integrand).max())


def test_edges(table_of: Callable[[float], Any]) -> None:
    """No step at z = 2, at the edges of bins and at z = 40."""
    for k in EXPONENTS:
        for z in [2.0, 2.5, 11.0, 39.5, 40.0]:
            x = z / TWO_PI
            inside, outside = _moments(table_of(k), np.nextafter(x, 0)), _moments(table_of(k), np.nextafter(x, 99))
            np.testing.assert_allclose(inside, outside, rtol=2e-14)  # one ulp of x is some ulps of a steep function
