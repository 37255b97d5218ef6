"""Theta, its slopes and the stiffness M against 40 digits, at the corner where they are 0/0, and outside their ranges."""

import math

import numpy as np
import pytest
from flint import arb

from gradhesion.core.problem.material import stiffness, theta, theta_of, theta_slopes
from gradhesion.twin.special import theta as exact_theta
from tests.core.scene import EPS

PLACES = [(0.3, 0.3), (0.9, 0.45), (0.999, 0.3), (0.5, 0.5), (0.9999, 0.5), (1e-4, 0.2), (0.7, -0.5)]


def _draws() -> list[tuple[float, float]]:
    rng = np.random.default_rng(10)
    draws = [(float(k), float(nu)) for k, nu in zip(rng.uniform(0, 1, 120), rng.uniform(-1, 0.5, 120), strict=True)]
    draws += [(float(k), 0.5) for k in 1 - 10.0 ** -rng.uniform(0, 15, 40)]
    draws += [(1 - float(d), 0.5 - float(e)) for d, e in 10.0 ** -rng.uniform(1, 14, (60, 2))]
    draws += [(float(k), -1 + float(e)) for k, e in 10.0 ** -rng.uniform(1, 14, (20, 2))]
    return [*draws, (0.0, -0.99), (0.0, 0.5), (1e-16, 0.3), (2.0**-53, 0.49), (1 - 2.0**-53, 0.5), (1 - 2.0**-53, 0.3)]


def test_against_forty_digits() -> None:
    """As it is compiled, and as Python runs it: five gamma functions of 3 ulp at most, two sines, a root, ten products."""
    for k, nu in _draws():
        exact = exact_theta(arb(k), arb(nu))  # its cos(k pi/2) loses 16 of 51 digits next to k = 1
        for found in (theta_of(k, nu), theta_of.py_func(k, nu), float(theta(k, nu))):
            assert abs(found / exact - 1) <= 16 * EPS, (k, nu)


def test_where_it_is_known() -> None:
    np.testing.assert_allclose(theta(0.0, np.linspace(-0.999, 0.5, 77)), 1.0, rtol=4 * EPS)
    assert theta(1.0, 0.5) == pytest.approx(math.pi, rel=4 * EPS)


EDGES = [(0.0, 0.3), (-0.0, 0.3), (np.nextafter(1.0, 0.0), 0.3), (0.4, np.nextafter(-1.0, 0.0)), (0.4, 0.5)]
BEYOND = [(np.nextafter(0.0, -1.0), 0.3), (np.nextafter(1.0, 2.0), 0.5), (0.4, -1.0), (0.4, np.nextafter(0.5, 1.0))]
BEYOND += [(math.nan, 0.3), (0.4, math.nan), (math.inf, 0.3), (0.4, -math.inf)]
BEYOND += [(1.0, 0.3), (1.0, np.nextafter(0.5, 0.0)), (1.0, -0.5)]  # a compressible surface has no stiffness


@pytest.mark.parametrize(("k", "nu"), [*EDGES, *BEYOND])
def test_edges(k: float, nu: float) -> None:
    for value in (theta_of(k, nu), theta_of.py_func(k, nu), float(theta(k, nu))):
        assert 0.0 < value < math.inf if (k, nu) in EDGES else math.isnan(value)


def test_stiffness_is_theta_times_modulus_over_the_power_of_the_depth() -> None:
    for k, nu, modulus, depth in [(0.31, 0.27, 1730.0, 0.037), (0.0, 0.1, 3.3, 1e-9), (1.0, 0.5, 0.7, 17.0)]:
        exact = exact_theta(arb(k), arb(nu)) * modulus / arb(depth) ** arb(k)
        assert abs(float(stiffness(k, nu, modulus, depth)) / exact - 1) <= 16 * EPS
    good = {"k": 0.3, "nu": 0.3, "modulus": 10.0, "c0_over_R": 0.1}
    wrong = {"modulus": [0.0, -1.0, math.nan], "nu": [-1.0], "k": [1.5], "c0_over_R": [0.0, -1.0, math.nan]}
    for name, values in wrong.items():
        assert np.isnan(stiffness(**good | {name: values})).all()


@pytest.mark.parametrize(("k", "nu"), PLACES)
def test_slopes_against_forty_digits(k: float, nu: float) -> None:
    step = arb(10) ** -15
    for found, (by_k, by_nu) in zip(theta_slopes(k, nu), ((step, 0), (0, step)), strict=True):
        above, below = (exact_theta(arb(k) + sign * by_k, arb(nu) + sign * by_nu).log() for sign in (1, -1))
        value = float((above - below) / (2 * step))
        # sums of ten terms of the size of the digamma function; 1 - k has lost its last digits before
        assert abs(found - value) <= 1e-13 * (1 + abs(value))


def test_slopes_at_the_ends_of_the_range() -> None:
    by_k, by_nu = theta_slopes([0.0, 1.0], [0.3, 0.5])
    assert by_nu[0] == 0.0
    assert np.isnan(by_nu[1])
    assert by_k[1] == pytest.approx(float(theta_slopes(1.0 - 1e-9, 0.5)[0]), abs=1e-7)
    assert np.isnan(theta_slopes([1.0, -0.1, 0.5, 0.5], [0.3, 0.3, 0.6, -1.0])).all()
