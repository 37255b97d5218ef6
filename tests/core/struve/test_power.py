"""The power z^(-(1+k)/2) against 30 digits."""

from collections.abc import Callable
from typing import Any

import mpmath
import numba
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.lanes import LANES, load, store
from gradhesion.core.struve.power import amplitude_power, amplitude_powers

EPS = 2.0**-52
EXPONENTS = [0.0, 1e-16, 1e-8, 0.123, 1 / 3, 0.5, 0.777, 1 - 1e-12, 1.0]


@numba.njit
def _powers(table: Any, z: NDArray[np.float64]) -> NDArray[np.float64]:
    out = np.empty(z.size)
    for i in range(z.size):
        out[i] = amplitude_power(table, z[i])
    return out


@kernel()
def powers_at_once(table: Any, z: Any, out: Any) -> None:
    """Put the powers of z into `out`, eight at a time."""
    for first in range(0, z.size, LANES):
        store(out, first, amplitude_powers(table, load(z, first)))


@pytest.mark.parametrize("k", EXPONENTS)
def test_eight_at_once(k: float, table_of: Callable[[float], Any]) -> None:
    rng = np.random.default_rng(6)
    halves = np.repeat(2.0 ** np.arange(-511.5, 512), LANES) * (1.0 + EPS * np.tile(np.arange(-4, 4), 1024))
    z = np.concatenate([2.0 ** rng.uniform(-512, 511.99, 400), rng.uniform(0.01, 1000, 400), halves])
    values = np.empty(z.size)
    powers_at_once(table_of(k), z, values)
    exact = [mpmath.mpf(float(place)) ** (-(1 + mpmath.mpf(k)) / 2) for place in z]
    error = np.array([abs(float(value / truth - 1)) for value, truth in zip(values, exact, strict=True)])
    # of the logarithm, its product with the exponent, the polynomial; 1 + k is rounded, times ln z
    assert (error <= (2.0 + 0.25 * np.abs(np.log(z)) * (0.0 < k < 1.0)) * EPS).all()


@pytest.mark.parametrize("k", EXPONENTS)
def test_against_thirty_digits(k: float, table_of: Callable[[float], Any]) -> None:
    rng = np.random.default_rng(6)
    z = np.concatenate(
        [2.0 ** rng.uniform(-512, 511.99, 400), rng.uniform(0.01, 100, 400), 2.0 ** np.arange(-512, 512)]
    )
    values = _powers(table_of(k), z)
    exact = [mpmath.mpf(float(place)) ** (-(1 + mpmath.mpf(k)) / 2) for place in z]
    error = np.array([abs(float(value / truth - 1)) for value, truth in zip(values, exact, strict=True)])
    # three roundings: of the polynomial, of the stored power of two, of their product
    assert error.max() <= 2.5 * EPS


def test_slices_join(table_of: Callable[[float], Any]) -> None:
    edges = 1.0 + np.arange(1, 65) / 64.0
    for k in EXPONENTS:
        below, above = _powers(table_of(k), np.nextafter(edges, 0.0)), _powers(table_of(k), edges)
        np.testing.assert_allclose(below, above, rtol=4 * EPS)


def test_homogeneous_and_steepest(table_of: Callable[[float], Any]) -> None:
    z = np.random.default_rng(7).uniform(0, 1e6, 1000)
    np.testing.assert_allclose(_powers(table_of(0.0), z) ** -2, z, rtol=6 * EPS)
    np.testing.assert_allclose(_powers(table_of(1.0), z), 1.0 / z, rtol=3 * EPS)
