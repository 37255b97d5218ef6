"""The integrals of pair.py against mpmath's quadrature of what defines them."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations.pair import cosine_integrals, sine_integrals

EPS = float(np.finfo(float).eps)


def _defined(k: float, x: float, j: int, function: object) -> float:
    z = 2 * mpmath.pi * mpmath.mpf(x)
    power = mpmath.mpf(k - 1) / 2 + j
    # t = sin u takes the singular end away: dt (1-t^2)^power = cos(u)^(2 power + 1) du
    nodes = mpmath.linspace(0, mpmath.pi / 2, 3 + math.ceil(2 * x))
    return float(mpmath.quad(lambda u: mpmath.cos(u) ** (2 * power + 1) * function(z * mpmath.sin(u)), nodes))  # type: ignore[operator]


@pytest.mark.parametrize("k", [0.0, 0.37, 0.8, 1.0])
@pytest.mark.parametrize("x", [0.0, 1.3e-4, 0.21, 1.7, 9.3])
@pytest.mark.parametrize("j", [0, 1])
def test_integrals(k: float, x: float, j: int) -> None:
    # amplitudes are below 2: 20 eps and the phase of a rounded z
    tolerance = 20 * EPS * (1.0 + 2 * math.pi * x)
    with mpmath.workdps(18):
        assert sine_integrals(k, x)[j] == pytest.approx(_defined(k, x, j, mpmath.sin), abs=tolerance)
        assert cosine_integrals(k, x)[j] == pytest.approx(_defined(k, x, j, mpmath.cos), abs=tolerance)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_series_near_zero_meets_the_bessel_function(k: float) -> None:
    seam = 1e-3 / (2 * math.pi)
    below, above = cosine_integrals(k, seam * (1 - 1e-9)).T, cosine_integrals(k, seam * (1 + 1e-9)).T
    np.testing.assert_allclose(below, above, rtol=20 * EPS, atol=1e-14)


@pytest.mark.parametrize("k", [0.2, 0.9])
def test_slopes_of_the_sines(k: float) -> None:
    x = np.array([0.13, 3.1])
    step = 1e-6
    ahead, behind = sine_integrals(k, x + step), sine_integrals(k, x - step)
    slopes = (ahead[:2] - behind[:2]) / (4 * math.pi * step)
    np.testing.assert_allclose(sine_integrals(k, x)[2:], slopes, atol=1e-9)


def test_shapes_and_ranges() -> None:
    assert sine_integrals(np.full((3, 1), 0.3), np.ones(2)).shape == (4, 3, 2)
    assert cosine_integrals(np.full((3, 1), 0.3), np.ones(2)).shape == (2, 3, 2)
    for function in (sine_integrals, cosine_integrals):
        assert np.isnan(function([-0.1, 1.1, math.nan, 0.5, 0.5, 0.5], [1.0, 1.0, 1.0, -1.0, math.nan, math.inf])).all()


def test_a_value_does_not_depend_on_its_company() -> None:
    exponents, points = np.array([0.3, 0.7, 0.3, 0.0]), np.array([0.4, 2.0, 9.0, 0.0])
    together = sine_integrals(exponents, points)
    for i in range(4):
        assert np.array_equal(together[:, i], sine_integrals(exponents[i], points[i]))


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_far_waves_are_sines(k: float) -> None:
    # (B5)-(B7): H_nu ~ Y_nu + (z/2)^(nu-1)/(sqrt(pi) Gamma(nu+1/2)), and Y, J ~ sqrt(2/(pi z)) sin, cos of
    # z - nu pi/2 - pi/4; so S0 = sqrt(pi)/2 Gamma(n) (z/2)^(1/2-n) H and the mean height 1/z are (B8)'s
    n = 0.5 * (1.0 + k)
    for x in (200.25, 2000.6):
        z = 2.0 * math.pi * x
        phase = 2.0 * math.pi * (x % 1.0) - 0.25 * math.pi * (1.0 + k)
        size = 0.5 * math.sqrt(math.pi) * math.gamma(n) * (0.5 * z) ** (0.5 - n) * math.sqrt(2.0 / (math.pi * z))
        s0 = float(sine_integrals(k, x)[0])
        c0 = float(cosine_integrals(k, x)[0])
        # the next terms of Y and J are 1/z of the first, that of the mean height (1-k) 1/z^3
        assert s0 == pytest.approx(size * math.sin(phase) + 1.0 / z, abs=0.2 * size / z + 1.0 / z**3)
        assert c0 == pytest.approx(size * math.cos(phase), abs=0.2 * size / z)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7])
def test_the_second_term_of_struves_function_has_the_gamma_function_of_its_own_order(k: float) -> None:
    """(B5) prints G((k+1)/2) for every order: at 1 + k/2, which (B4) needs, that is (1+k)/2 times the term."""
    with mpmath.workdps(30):
        z = mpmath.mpf(2000)
        for order, share in ((mpmath.mpf(k) / 2, 1.0), (1 + mpmath.mpf(k) / 2, 0.5 * (1.0 + k))):
            term = mpmath.struveh(order, z) - mpmath.bessely(order, z)
            held = (z / 2) ** (order - 1) / (mpmath.sqrt(mpmath.pi) * mpmath.gamma(order + mpmath.mpf(1) / 2))
            printed = (z / 2) ** (order - 1) / (mpmath.sqrt(mpmath.pi) * mpmath.gamma((mpmath.mpf(k) + 1) / 2))
            assert float(term / held) == pytest.approx(1.0, abs=1e-6)  # the next term is 1/z^2 of it
            assert float(printed / term) == pytest.approx(share, abs=1e-6)
