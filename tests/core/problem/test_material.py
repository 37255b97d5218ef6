"""Theta and the stiffness M against 40 digits, at the corner where they are 0/0, and outside their ranges."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.problem.material import stiffness, theta, theta_of

EPS = 2.0**-52


def _theta(k: float, nu: float) -> mpmath.mpf:
    """Give theta as it stands in section 2 of docs/theory.md, with the exact doubles k and nu."""
    k, nu = mpmath.mpf(k), mpmath.mpf(nu)
    beta = mpmath.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
    c = 2 ** (1 + k) * mpmath.gamma((3 + k + beta) / 2) * mpmath.gamma((3 + k - beta) / 2) / mpmath.gamma(2 + k)
    c /= mpmath.pi
    front = 2 ** (1 + k) * (1 + k) * mpmath.cos(k * mpmath.pi / 2) * mpmath.gamma(1 + k / 2)
    return front / (mpmath.sqrt(mpmath.pi) * c * beta * mpmath.sin(beta * mpmath.pi / 2) * mpmath.gamma((1 + k) / 2))


def _draws() -> list[tuple[float, float]]:
    rng = np.random.default_rng(10)
    draws = [(float(k), float(nu)) for k, nu in zip(rng.uniform(0, 1, 300), rng.uniform(-1, 0.5, 300), strict=True)]
    draws += [(float(k), 0.5) for k in 1 - 10.0 ** -rng.uniform(0, 15, 60)]
    draws += [(1 - float(d), 0.5 - float(e)) for d, e in 10.0 ** -rng.uniform(1, 14, (100, 2))]
    draws += [(float(k), -1 + float(e)) for k, e in 10.0 ** -rng.uniform(1, 14, (30, 2))]
    return [*draws, (0.0, -0.99), (0.0, 0.5), (1e-16, 0.3), (2.0**-53, 0.49), (1 - 2.0**-53, 0.5), (1 - 2.0**-53, 0.3)]


@pytest.mark.parametrize("function", [theta_of, theta_of.py_func])
def test_against_forty_digits(function: object) -> None:
    mpmath.mp.dps = 60  # cos(k pi/2) loses 16 digits next to k = 1
    worst = max(abs(float(function(k, nu) / _theta(k, nu) - 1)) for k, nu in _draws())  # type: ignore[operator]
    # five gamma functions of 3 ulp at most, two sines, a root and ten products
    assert worst <= 16 * EPS, worst / EPS


def test_homogeneous() -> None:
    nu = np.linspace(-0.999, 0.5, 77)
    np.testing.assert_allclose(theta(0.0, nu), 1.0, rtol=4 * EPS)


def test_steepest() -> None:
    assert math.isclose(float(theta(1.0, 0.5)), math.pi, rel_tol=4 * EPS)


def test_continuous_at_the_corner() -> None:
    steps = 10.0 ** -np.arange(2.0, 16.0)
    assert (np.abs(theta(1.0 - steps, 0.5) - math.pi) <= 2 * steps * math.pi).all()


def test_compressible_surface_has_no_stiffness_at_exponent_one() -> None:
    steps = 2.0 ** -np.arange(20.0, 54.0)
    np.testing.assert_allclose(theta(1.0 - steps, 0.3) / steps, 7.696902, rtol=2e-6)
    assert np.isnan(theta(1.0, [0.3, np.nextafter(0.5, 0.0), -0.5])).all()


@pytest.mark.parametrize(
    ("k", "nu", "inside"),
    [
        (0.0, 0.3, True),
        (-0.0, 0.3, True),
        (np.nextafter(0.0, -1.0), 0.3, False),
        (np.nextafter(1.0, 0.0), 0.3, True),
        (np.nextafter(1.0, 2.0), 0.5, False),
        (0.4, -1.0, False),
        (0.4, np.nextafter(-1.0, 0.0), True),
        (0.4, 0.5, True),
        (0.4, np.nextafter(0.5, 1.0), False),
        (math.nan, 0.3, False),
        (0.4, math.nan, False),
        (math.inf, 0.3, False),
        (0.4, -math.inf, False),
    ],
)
def test_edges(k: float, nu: float, inside: bool) -> None:
    for value in (theta_of(k, nu), theta_of.py_func(k, nu), float(theta(k, nu))):
        assert (value > 0.0 and value < math.inf) if inside else math.isnan(value)


def test_stiffness_is_theta_times_modulus_over_the_power_of_the_depth() -> None:
    for k, nu, modulus, depth in [(0.31, 0.27, 1730.0, 0.037), (0.0, 0.1, 3.3, 1e-9), (1.0, 0.5, 0.7, 17.0)]:
        exact = _theta(k, nu) * modulus / mpmath.mpf(depth) ** k if k < 1 else mpmath.pi * modulus / mpmath.mpf(depth)
        assert abs(float(stiffness(k, nu, modulus, depth)) / exact - 1) <= 16 * EPS


def test_stiffness_scales() -> None:
    k = np.linspace(0.0, 0.97, 20)
    base = stiffness(k, 0.3, 70.0, 0.11)
    np.testing.assert_allclose(stiffness(k, 0.3, 7000.0, 0.11), 100.0 * base, rtol=4 * EPS)
    np.testing.assert_allclose(stiffness(k, 0.3, 70.0, 0.11 * 2.0**10), base * 2.0 ** (-10 * k), rtol=6 * EPS)


@pytest.mark.parametrize(
    "wrong", [{"modulus": 0.0}, {"modulus": -1.0}, {"modulus": math.nan}, {"nu": -1.0}, {"k": 1.5}]
)
def test_stiffness_outside_its_range(wrong: dict[str, float]) -> None:
    arguments = {"k": 0.3, "nu": 0.3, "modulus": 10.0, "c0_over_R": 0.1} | wrong
    assert np.isnan(stiffness(**arguments))


@pytest.mark.parametrize("depth", [0.0, -1.0, math.nan])
def test_depth_outside_its_range(depth: float) -> None:
    assert np.isnan(stiffness(0.3, 0.3, 10.0, depth))


def test_broadcasting() -> None:
    assert theta(np.full((3, 1), 0.3), np.full(2, 0.1)).shape == (3, 2)
    assert stiffness(np.full((3, 1), 0.3), 0.1, 1.0, np.full((1, 4), 0.2)).shape == (3, 4)
    assert theta(0.3, 0.1).shape == ()
    assert theta([], 0.1).shape == (0,)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.9])
def test_the_modulus_law_is_the_same_at_every_reference_depth(k: float) -> None:
    # E = E0 (z/c0)^k is not changed by c0 -> 7 c0, E0 -> 7^k E0
    assert stiffness(k, 0.3, 7.0**k * 500.0, 7 * 0.02) == pytest.approx(
        float(stiffness(k, 0.3, 500.0, 0.02)), rel=1e-14
    )


def test_arrays_of_one() -> None:
    assert stiffness(np.array([0.3]), 0.3, [500.0], 0.01).shape == (1,)
