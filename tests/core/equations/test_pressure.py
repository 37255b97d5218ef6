"""The pressure: its integral is the load, it sinks the surface by the depth; Hertz, Sneddon and Boussinesq."""

import math
from collections.abc import Callable

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import roots_jacobi

from gradhesion.core.equations import general, hertz, jkr, pressure, profile

pytestmark = pytest.mark.slow

M, WAVELENGTH = 210.0, 0.13
PROFILES = [
    ([], [], 2.0),
    ([-0.021, 0.004], [0.003, 0.0, -0.002], 2.0),
    ([-0.01], [0.02], 1.0),
    ([0.0, 0.0, 0.005], [], 2.9),
]
"""Pressure, load and depth are sums over the terms of a profile, so that a wrong term shows beside others too."""
EXPONENTS = [0.0, 0.43, 0.9, 1.0]


NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


def _panels(edges: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    centre, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    return (centre[:, None] + half[:, None] * NODES).ravel(), (half[:, None] * WEIGHTS).ravel()


def _integral(k: float, a: float, power: float, values: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> float:
    """Integrate r^power p dr over the contact, in two parts that meet at a/2."""
    # within: w = r^(1+power), graded towards 0
    n = 1.0 + power
    w, weights = _panels(
        (0.5 * a) ** n * np.concatenate([[0.0], 0.5 ** np.arange(39.0, 2.0, -2.0), np.linspace(0.5, 1.0, 7)])
    )
    within = float(np.sum(weights / n * values(w ** (1.0 / n))))
    # beyond: u = a^2 - r^2, in which p is u^((k-1)/2) times a smooth function; Jacobi's rule takes the panel at the edge
    edges, rest = np.linspace(0.0, 0.75 * a * a, 11), 0.5 * (k - 1.0)
    t, jacobi = roots_jacobi(24, 0.0, rest)
    u, weights = _panels(edges[1:])
    near = 0.5 * edges[1] * (1.0 + t)
    u = np.concatenate([near, u])
    weights = np.concatenate([(0.5 * edges[1]) ** (1.0 + rest) * jacobi * near**-rest, weights])
    r = np.sqrt(a * a - u)
    return within + float(np.sum(weights * 0.5 * r ** (power - 1.0) * values(r)))


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize(("cosines", "sines", "m"), PROFILES)
def test_the_integral_of_the_pressure_is_the_load(k: float, cosines: list[float], sines: list[float], m: float) -> None:
    wave = (WAVELENGTH, cosines, sines, m)
    for a, raised in ((0.11, 0.0), (0.31, -0.7)):
        stretch = float(jkr.adhesive_depth(k, M, a))
        depth = float(general.hertz_indentation(k, a, *wave)) + raised * stretch
        found = 2.0 * math.pi * _integral(k, a, 1.0, lambda r: pressure.pressure(k, M, r, a, depth, *wave))  # noqa: B023
        disc = float(hertz.disc_stiffness(k, M, a))
        load = 1.5 * math.pi * (float(general.hertz_load(k, M, a, *wave)) + disc * raised * stretch)
        assert found == pytest.approx(load, rel=1e-10, abs=1e-10 * disc * stretch)


@pytest.mark.parametrize("k", [0.0, 0.43, 0.8])
@pytest.mark.parametrize(("cosines", "sines", "m"), PROFILES)
def test_the_pressure_presses_the_middle_in_by_the_depth(
    k: float, cosines: list[float], sines: list[float], m: float
) -> None:
    # a point load sinks the surface as distance^-(1+k); a flat punch, of depth 1, tells the factor:
    # int_0^a (a^2-s^2)^((k-1)/2) s^-k ds = pi/(2 cos(k pi/2))
    a, wave = 0.27, (WAVELENGTH, cosines, sines, m)
    depth = float(general.indentation(k, M, a, *wave))
    sunk = _integral(k, a, -k, lambda r: pressure.pressure(k, M, r, a, depth, *wave))
    flat = _integral(k, a, -k, lambda r: pressure.flat_pressure(k, M, r, a, 1.0))
    front = 2.0 ** (1.0 - k) * M / (2.0 * math.pi)
    assert flat == pytest.approx(front * math.pi / (2.0 * math.cos(0.5 * math.pi * k)), rel=1e-11)
    assert sunk / flat == pytest.approx(depth, abs=1e-11 * float(jkr.adhesive_depth(k, M, a)))


def test_hertz() -> None:
    r, a = np.linspace(0.0, 0.31, 9), 0.31
    np.testing.assert_allclose(
        pressure.hertz_pressure(0.0, M, r, a, 1.0, []), 2 * M * np.sqrt(a * a - r * r) / math.pi, rtol=1e-14
    )


@pytest.mark.parametrize("k", EXPONENTS)
def test_a_paraboloid_on_a_graded_half_space(k: float) -> None:
    r, a = np.linspace(0.0, 0.31, 9), 0.31
    front = 2.0 ** (1.0 - k) * M / (2.0 * math.pi)
    expected = front * 2.0 / (1.0 + k) ** 2 * (a * a - r * r) ** (0.5 * (1.0 + k))
    np.testing.assert_allclose(pressure.hertz_pressure(k, M, r, a, 1.0, []), expected, rtol=2e-14)


def test_a_cone_is_sneddon() -> None:
    r, a = np.array([1e-9, 0.01, 0.2, 0.309]), 0.31
    np.testing.assert_allclose(
        pressure.hertz_pressure(0.0, M, r, a, 1.0, [], exponent=1.0), 0.5 * M * np.arccosh(a / r), rtol=1e-13
    )
    assert pressure.hertz_pressure(0.0, M, 0.0, a, 1.0, [], exponent=1.0) == math.inf


@pytest.mark.parametrize("k", EXPONENTS)
def test_a_flat_cylinder(k: float) -> None:
    # Boussinesq's form, of the mean pressure: p = (1+k)/2 P/(pi a^2) (1 - r^2/a^2)^((k-1)/2)
    r, a = np.linspace(0.001, 0.3, 7), 0.31
    load = 1.5 * math.pi * float(hertz.disc_stiffness(k, M, a)) * 0.02
    expected = 0.5 * (1 + k) * load / (math.pi * a * a) * (1 - (r / a) ** 2) ** (0.5 * (k - 1))
    np.testing.assert_allclose(pressure.flat_pressure(k, M, r, a, 0.02), expected, rtol=1e-14)
    # two depths of one disc under any punch differ by it
    wave = (WAVELENGTH, [-0.02], [0.003])
    difference = pressure.pressure(k, M, r, a, 0.05, *wave) - pressure.pressure(k, M, r, a, 0.03, *wave)
    np.testing.assert_allclose(difference, expected, rtol=1e-11)


def test_at_exponent_one_every_point_is_a_spring() -> None:
    r, wave = np.linspace(0.0, 0.31, 20), (WAVELENGTH, 0.02)
    depth = float(jkr.indentation(1.0, M, 0.31, *wave))
    found = pressure.pressure(1.0, M, r, 0.31, depth, WAVELENGTH, [-0.02])
    np.testing.assert_allclose(found, M / (2 * math.pi) * (depth - profile.height(r, *wave)), atol=1e-13 * M)


@pytest.mark.parametrize(
    ("k", "r"), [(0.0, 0.0), (0.0, 0.16), (0.43, 0.0), (0.43, 0.003), (0.43, 0.23), (0.9, 0.003), (0.9, 0.23)]
)
def test_quadrature_of_the_integral(k: float, r: float) -> None:
    a, cosine, sine = 0.24, -0.02, 0.005 if k > 0.0 or r > 0.0 else 0.0
    n = (mpmath.mpf(k) + 1) / 2

    def slope(s: mpmath.mpf) -> mpmath.mpf:
        """Take the slope of delta_H = s^2/(1+k) + 2 pi s [-a_1 S0 + b_1 C0], of Struve and Bessel functions."""

        def depth(t: mpmath.mpf) -> mpmath.mpf:
            y = 2 * mpmath.pi * t / mpmath.mpf(WAVELENGTH)
            factor = mpmath.sqrt(mpmath.pi) / 2 * mpmath.gamma(n) * (y / 2) ** (mpmath.mpf(1) / 2 - n)
            waves = -cosine * mpmath.struveh(n - 0.5, y) + sine * mpmath.besselj(n - 0.5, y)
            return t * t / (1 + k) + 2 * mpmath.pi * t * factor * waves

        return mpmath.re(mpmath.diff(depth, s))  # the powers of a negative s cancel but for rounding

    with mpmath.workdps(15):  # s^2 = r^2 + (a^2-r^2) v^(1/n), or s = a v^(1/k) where the axis has a slope
        if r == 0.0 and sine:
            values = mpmath.quad(lambda v: slope(a * v ** (1 / mpmath.mpf(k))), mpmath.linspace(0, 1, 9))
            integral = values * mpmath.mpf(a) ** k / k
        else:
            span = mpmath.mpf(a) ** 2 - mpmath.mpf(r) ** 2

            def integrand(v: mpmath.mpf) -> mpmath.mpf:
                s = mpmath.sqrt(mpmath.mpf(r) ** 2 + span * v ** (1 / n))
                return slope(s) / s

            integral = span**n / (2 * n) * mpmath.quad(integrand, [0, 0.001, 0.01, 0.1, *mpmath.linspace(0.25, 1, 7)])
    expected = 2.0 ** (1.0 - k) * M / (2.0 * math.pi) * float(integral)
    found = pressure.hertz_pressure(k, M, r, a, WAVELENGTH, [cosine], [sine])
    assert found == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_slope_of_the_depth(k: float) -> None:
    a, wave = np.linspace(0.02, 0.8, 40), (WAVELENGTH, [-0.021, 0.004], [0.003, 0.0, -0.002], 2.3)
    step = 1e-6
    ahead, behind = (general.hertz_indentation(k, a + h, *wave) for h in (step, -step))
    # the central difference leaves step^2/6 of the third derivative, and rounding eps/step
    np.testing.assert_allclose(pressure.indentation_slope(k, a, *wave), (ahead - behind) / (2 * step), atol=1e-8)


def test_the_edge_and_outside_the_ranges() -> None:
    def at(r: float, depth: float) -> NDArray[np.float64]:
        return pressure.pressure(0.3, M, r, 0.2, depth, 0.1, [-0.02])

    top = float(general.hertz_indentation(0.3, 0.2, 0.1, [-0.02]))
    assert [float(at(0.2, depth)) for depth in (top - 0.01, top, top + 0.01)] == [-math.inf, 0.0, math.inf]
    assert np.isfinite(pressure.pressure(1.0, M, 0.2, 0.2, 0.01, 0.1, [-0.02]))
    assert np.isnan(at(0.21, top))
    assert np.isnan(pressure.hertz_pressure([-0.1, 0.3, 0.3], [M, 0.0, M], 0.1, [0.2, 0.2, 0.0], 0.1, [])).all()
    assert pressure.pressure(np.full((2, 1), 0.3), M, np.zeros(3), 0.2, 0.01, 0.1, [0.01]).shape == (2, 3)
    assert pressure.hertz_pressure(0.0, M, 0.0, 0.2, 0.1, [], [0.01]) == math.inf
