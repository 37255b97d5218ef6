"""The fractional integral of order c = (1-k)/2 against its definition, its limit and its moments."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.struve.fractional import NODES, interpolated

EPS = 2.0**-52
EXPONENTS = [0.0, 1e-9, 0.31, 0.7, 0.95, 1 - 1e-9, 1.0]
PLACES = np.array([*NODES, 1.0])


def _matrix(table_of: Callable[[float], Any], k: float) -> np.ndarray:
    matrix: np.ndarray = np.array(table_of(k)["fractional"]).T
    return matrix


@pytest.mark.parametrize("k", EXPONENTS)
def test_powers(k: float, table_of: Callable[[float], Any]) -> None:
    """J x^m = m! x^m/((c+1) ... (c+m)), for all powers that the polynomial holds."""
    matrix, c = _matrix(table_of, k), 0.5 * (1.0 - k)
    for m in range(NODES.size):
        factor = math.prod(i / (c + i) for i in range(1, m + 1))
        # each of 16 terms is rounded, and the barycentric form of the build loses as much again
        tolerance = 64 * EPS * np.abs(matrix).sum(axis=1)
        assert (np.abs(matrix @ NODES**m - factor * PLACES**m) <= tolerance).all()


@pytest.mark.parametrize("k", EXPONENTS)
def test_a_wave(k: float, table_of: Callable[[float], Any]) -> None:
    """A wave of 6.3 radians from its definition, with q = v^c for the variable (at k = 1 all of it lies at v = 0)."""
    values = _matrix(table_of, k) @ np.cos(6.3 * NODES + 0.4)
    c = (1 - mpmath.mpf(k)) / 2
    for i in (0, 5, 16):
        x = mpmath.mpf(PLACES[i])
        if k > 0.99:  # half of a billionth of the weight is not at v = 0
            expected = mpmath.cos(6.3 * x + 0.4)
        else:
            expected = mpmath.quad(lambda q, x=x: mpmath.cos(6.3 * x * (1 - q ** (1 / c)) + 0.4), [0, 0.5, 0.9, 1])
        assert abs(values[i] - expected) < 3e-9


def test_the_polynomial_between_the_nodes() -> None:
    """It has the values of any polynomial of its degree, at the nodes and between them, up to rounding."""
    coefficients = np.random.default_rng(4).normal(size=NODES.size)
    polynomial = np.polynomial.Polynomial(coefficients, domain=[0.0, 1.0])
    values = polynomial(NODES)
    # the Lebesgue constant of Gauss's nodes at the ends is about 2 sqrt(16)
    tolerance = 16 * 8 * EPS * np.abs(values).max()
    for x in (0.0, 0.013, 0.5, float(NODES[4]), 0.97, 1.0):
        assert abs(interpolated(values, x) - polynomial(x)) < tolerance
