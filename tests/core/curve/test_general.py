"""Depth and load of any profile against the defining integrals at 30 digits, and against their own slopes."""

import math
from functools import cache

import mpmath
import numpy as np
import pytest

from gradhesion.core import Harmonic, Profile
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis, coordinate, curve_of, slope, state
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.shape import depth_factor_of, rows_of

pytestmark = pytest.mark.slow

EPS = float(np.finfo(float).eps)
SQUARE = tuple(Harmonic(n=n, cos=0.0, sin=1.0 / n) for n in (1, 3, 5, 7))
TRIANGLE = tuple(Harmonic(n=n, cos=1.0 / n**2) for n in (1, 3, 5))
SHIFTED = (Harmonic(n=1, cos=math.cos(0.7), sin=math.sin(0.7)),)
MIXED = (Harmonic(n=2, cos=0.61803), Harmonic(n=7, cos=-0.1, sin=0.141421))
STRETCH, WAVELENGTH, AMPLITUDE = 0.083, 0.41, 0.027


@cache
def _wavy_slope(harmonics: tuple[Harmonic, ...], s: mpmath.mpf) -> mpmath.mpf:
    """Return the slope of the waves, at nodes that the quadratures of all exponents share."""
    total = mpmath.mpf(0)
    for h in harmonics:
        y = 2 * mpmath.pi * h.n * s / WAVELENGTH
        total += 2 * mpmath.pi * AMPLITUDE * h.n * (h.cos * mpmath.sin(y) + h.sin * mpmath.cos(y))
    return total


@cache
def _integral_of(k: float, shape: float | tuple[Harmonic, ...], a: float, j: int) -> mpmath.mpf:
    """Return int_0^a f'(s) (a^2-s^2)^((k-1)/2 + j) ds of a power s^m/m or of waves, with s = a sin u."""
    power = mpmath.mpf(k) + 2 * j

    def integrand(u: mpmath.mpf) -> mpmath.mpf:
        s = a * mpmath.sin(u)
        slope_there = _wavy_slope(shape, s) if isinstance(shape, tuple) else s ** (mpmath.mpf(shape) - 1)
        return slope_there * mpmath.cos(u) ** power

    return mpmath.mpf(a) ** power * mpmath.quad(integrand, mpmath.linspace(0, mpmath.pi / 2, 7))


def _integral(k: float, m: float, harmonics: tuple[Harmonic, ...], a: float, j: int) -> mpmath.mpf:
    """Return the integral of the whole profile: it is linear, and each part serves many profiles."""
    return _integral_of(k, m, a, j) + _integral_of(k, harmonics, a, j)


@pytest.mark.parametrize(
    "harmonics", [SQUARE, TRIANGLE, SHIFTED, MIXED], ids=["square", "triangle", "shifted", "mixed"]
)
@pytest.mark.parametrize("k", [0.0, 0.3, 0.9, 1.0])
@pytest.mark.parametrize("m", [1.0, 1.5, 2.0, 3.0, 4.0, 6.5])
def test_against_quadrature(m: float, k: float, harmonics: tuple[Harmonic, ...]) -> None:
    basis = Basis(*tables_of(k), rows_of(Profile(exponent=m, harmonics=harmonics)))
    curve, length, unit = curve_of(k, m, depth_factor_of(k, m), STRETCH, WAVELENGTH, AMPLITUDE, 0.0)
    for x in (0.11, 0.93):
        a = x * WAVELENGTH
        _, stretch, front, depth, load = state(basis, curve, x)
        with mpmath.workdps(30):
            hertz = mpmath.mpf(a) ** (1 - mpmath.mpf(k)) * _integral(k, m, harmonics, a, 0)
            pull = STRETCH * mpmath.mpf(a) ** ((1 - mpmath.mpf(k)) / 2)
            rest = hertz - mpmath.mpf(a) ** (-1 - mpmath.mpf(k)) * _integral(k, m, harmonics, a, 1) - pull
        size = (
            abs(float(hertz)) + float(pull) + AMPLITUDE * WAVELENGTH * sum(math.hypot(h.cos, h.sin) for h in harmonics)
        )
        assert unit * depth == pytest.approx(float(hertz - pull), abs=8 * EPS * size, rel=0.0)
        assert unit * load / front == pytest.approx(float(rest), abs=8 * EPS * size, rel=0.0)
        assert unit * stretch == pytest.approx(float(pull), rel=8 * EPS)
        assert TWO_PI * length == pytest.approx(WAVELENGTH, rel=2 * EPS)


@pytest.mark.parametrize("compliance", [0.0, 0.7, 1e3, math.inf])
@pytest.mark.parametrize("k", [0.0, 0.4, 1.0])
def test_slopes_are_derivatives(k: float, compliance: float) -> None:
    basis = Basis(*tables_of(k), rows_of(Profile(harmonics=MIXED)))
    curve, _, _ = curve_of(k, 2.6, depth_factor_of(k, 2.6), STRETCH, WAVELENGTH, AMPLITUDE, compliance)
    for x in (0.05, 0.4, 3.3, 11.7):
        h = 1e-3
        value, rate, whole = slope(basis, curve, x)
        # differences of the order h^8: 1e-3 of a wave leaves 1e-11 of a harmonic n = 7
        weights = zip((1, 2, 3, 4), (4 / 5, -1 / 5, 4 / 105, -1 / 280), strict=True)
        found, found_rate = 0.0, 0.0
        for i, weight in weights:
            found += weight * (coordinate(basis, curve, x + i * h) - coordinate(basis, curve, x - i * h)) / (TWO_PI * h)
            found_rate += (
                weight * (slope(basis, curve, x + i * h)[0] - slope(basis, curve, x - i * h)[0]) / (TWO_PI * h)
            )
        size = abs(coordinate(basis, curve, x)) + abs(whole)
        assert whole == pytest.approx(found, rel=1e-8, abs=1e-8 * size)
        assert rate == pytest.approx(found_rate, rel=1e-8, abs=1e-8 * abs(value))


def test_an_unbroken_exponent_meets_the_gamma_functions() -> None:
    for k in (0.0, 0.37, 1.0):
        assert depth_factor_of(k, 2.0) == pytest.approx(depth_factor_of(k, 2.0 + 1e-13), rel=1e-12)
        with mpmath.workdps(30):
            m = mpmath.mpf(3.7)
            value = mpmath.gamma(m / 2) * mpmath.gamma((1 + mpmath.mpf(k)) / 2) / 2 / mpmath.gamma((1 + k + m) / 2)
        assert depth_factor_of(k, 3.7) == pytest.approx(float(value), rel=8 * EPS)
