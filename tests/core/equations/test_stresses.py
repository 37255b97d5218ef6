"""Pressure, gap and stress intensity: load, depth, flat discs and quadratures that they must agree with."""

import math
from collections.abc import Callable
from functools import lru_cache

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import roots_jacobi

from gradhesion.core.equations import general, hertz, jkr, quadrature

pytestmark = pytest.mark.slow

M, WAVELENGTH = 210.0, 0.13
SERIES = ([-0.021, 0.004], [0.003, 0.0, -0.002], 2.0)
PROFILES = [([], [], 2.0), SERIES, ([-0.01], [0.02], 1.0), ([0.0, 0.0, 0.005], [], 2.9)]
"""Pressure, load and depth are sums over the terms of a profile, so that a wrong term shows beside others too."""
Values = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def _panels(edges: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    nodes, weights = np.polynomial.legendre.leggauss(12)
    centre, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    return (centre[:, None] + half[:, None] * nodes).ravel(), (half[:, None] * weights).ravel()


def _integral(k: float, a: float, power: float, values: Values) -> float:
    """Integrate r^power p dr over the contact, in two parts that meet at a/2."""
    # within: w = r^(1+power), graded towards 0
    n, grades = 1.0 + power, np.concatenate([[0.0], 0.5 ** np.arange(39.0, 2.0, -2.0), np.linspace(0.5, 1.0, 7)])
    w, weights = _panels((0.5 * a) ** n * grades)
    within = float(np.sum(weights / n * values(w ** (1.0 / n))))
    # beyond: u = a^2 - r^2, in which p is u^((k-1)/2) times a smooth function; Jacobi's rule takes the panel at the edge
    edges, rest = np.linspace(0.0, 0.75 * a * a, 11), 0.5 * (k - 1.0)
    t, jacobi = roots_jacobi(24, 0.0, rest)
    u, weights = _panels(edges[1:])
    near = 0.5 * edges[1] * (1.0 + t)
    weights = np.concatenate([(0.5 * edges[1]) ** (1.0 + rest) * jacobi * near**-rest, weights])
    r = np.sqrt(a * a - np.concatenate([near, u]))
    return within + float(np.sum(weights * 0.5 * r ** (power - 1.0) * values(r)))


@pytest.mark.parametrize(("k", "profile"), [(0.0, 0), (0.43, 0), (0.0, 1), (0.43, 2), (0.43, 3), (0.95, 1), (1.0, 2)])
def test_the_pressure_makes_the_load_and_the_depth(k: float, profile: int) -> None:
    cosines, sines, m = PROFILES[profile]
    wave, front = (WAVELENGTH, cosines, sines, m), 2.0 ** (1.0 - k) * M / (2.0 * math.pi)
    for a, raised in ((0.11, 0.0), (0.31, -0.7)):
        stretch, disc = float(jkr.adhesive_depth(k, M, a)), float(hertz.disc_stiffness(k, M, a))
        depth = float(general.hertz_indentation(k, a, *wave)) + raised * stretch

        def pressure(r: NDArray[np.float64], a: float = a, depth: float = depth) -> NDArray[np.float64]:
            return quadrature.pressure(k, M, r, a, depth, *wave)

        load = 1.5 * math.pi * (float(general.hertz_load(k, M, a, *wave)) + disc * raised * stretch)
        found = 2.0 * math.pi * _integral(k, a, 1.0, pressure)
        assert found == pytest.approx(load, rel=1e-10, abs=1e-10 * disc * stretch)
        if k < 0.9:  # a point load sinks the surface as distance^-(1+k); a flat punch, of depth 1, tells the factor
            flat = front * math.pi / (2.0 * math.cos(0.5 * math.pi * k))
            assert _integral(k, a, -k, pressure) / flat == pytest.approx(depth, abs=1e-11 * stretch)
            found = _integral(k, a, -k, lambda r, a=a: quadrature.flat_pressure(k, M, r, a, 1.0))
            assert found == pytest.approx(flat, rel=1e-11)


def test_the_pressure_at_the_edge_and_at_the_apex_of_a_slope() -> None:
    top = float(general.hertz_indentation(0.3, 0.2, 0.1, [-0.02]))
    found = quadrature.pressure(0.3, M, 0.2, 0.2, np.array([top - 0.01, top, top + 0.01]), 0.1, [-0.02])
    assert found.tolist() == [-math.inf, 0.0, math.inf]
    assert np.isfinite(quadrature.pressure(1.0, M, 0.2, 0.2, 0.01, 0.1, [-0.02]))
    assert quadrature.hertz_pressure(0.0, M, 0.0, 0.2, 0.1, [], [0.01]) == math.inf
    assert quadrature.hertz_pressure(0.0, M, 0.0, 0.2, 1.0, [], exponent=1.0) == math.inf
    for sine in (-2.0, -0.1):  # against a cone whose slope is 1
        apex, near = (float(quadrature.hertz_pressure(0.0, M, r, 0.2, 0.1, [], [0.1 * sine], 1.0)) for r in (0.0, 1e-9))
        assert apex == math.copysign(math.inf, near)


@pytest.mark.parametrize("k", [0.0, 0.2, 0.61, 0.95])
@pytest.mark.parametrize("raised", [-1.3, 0.4])
def test_stress_intensity_is_the_limit_of_the_pressure(k: float, raised: float) -> None:
    a, wave = 0.23, (WAVELENGTH, [-0.02], [0.004])
    depth = float(general.hertz_indentation(k, a, *wave)) + raised * float(jkr.adhesive_depth(k, M, a))
    shares = np.array([1e-6, 1e-8])
    limit = math.sqrt(2 * math.pi) * (a * shares) ** (0.5 * (1 - k))
    limit *= quadrature.pressure(k, M, a * (1 - shares), a, depth, *wave)
    found = float(general.stress_intensity(k, M, a, depth, *wave))
    assert abs(limit[1] / found - 1) < 1e-5
    assert abs(limit[1] - found) < 0.05 * abs(limit[0] - found)
    assert found**2 / (2 * M) == pytest.approx(raised**2, rel=1e-11)
    assert general.energy_release_rate(k, M, a, depth, *wave) == pytest.approx(raised**2, rel=1e-11)
    top = float(hertz.indentation(k, a, WAVELENGTH, 0.02)) + raised * float(jkr.adhesive_depth(k, M, a))
    assert jkr.energy_release_rate(k, M, a, top, WAVELENGTH, 0.02) == pytest.approx(raised**2, rel=1e-11)


@lru_cache
def _disc_shape(k: float, ratio: float) -> float:
    """Return the surface at r around a flat disc of radius a pressed in by 1, ratio = a/r, from its pressure.

    The pressure (a^2-s^2)^((k-1)/2) acts through the influence 1/distance^(1+k) of a point load (a graded half-space at
    the surface); the angle is integrated to a hypergeometric function, and the depth at the centre scales the result.
    """
    power, n = mpmath.mpf(k - 1) / 2, mpmath.mpf(1 + k) / 2

    def outside(u: mpmath.mpf) -> mpmath.mpf:  # t = sin u
        t = mpmath.sin(u)
        return mpmath.cos(u) ** (2 * power + 1) * t * mpmath.hyp2f1(n, n, 1, (ratio * t) ** 2)

    centre = mpmath.beta((1 - mpmath.mpf(k)) / 2, n) / 2  # int_0^1 (1-t^2)^power t^(-k) dt
    return float(mpmath.mpf(ratio) ** (1 + k) * mpmath.quad(outside, [0, mpmath.pi / 4, mpmath.pi / 2]) / centre)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.8])
def test_the_surface_around_a_punch_is_that_of_flat_discs(k: float) -> None:
    with mpmath.workdps(18):
        series = (0.1, [-0.02, 0.003], [0.0, 0.01])
        for ratio in (0.15, 0.7, 0.95):  # two depths of one disc differ by a flat disc, whatever the punch
            for surface, wave in ((quadrature.surface, (0.1, 0.01)), (quadrature.series_surface, series)):
                above, below = surface(k, 0.2 / ratio, 0.2, [1.0, 0.0], *wave)
                assert above - below == pytest.approx(_disc_shape(k, ratio), rel=1e-12)
    # contact that grows from 0 to a presses flat discs of all radii s one after the other, by d(delta_H)(s) each
    a, r, wave = 0.11, 0.17, (0.09, [-0.02], [0.0, 0.004])
    nodes, weights = np.polynomial.legendre.leggauss(20)
    s, weights = 0.5 * a * (1 + nodes), 0.5 * a * weights
    with mpmath.workdps(15):
        shapes = [_disc_shape(k, float(one) / r) for one in s]
        adhesive = _disc_shape(k, a / r) * float(jkr.adhesive_depth(k, M, a))
    # a series of sines has a depth of its own slope at the apex, which is no stress there: delta_H(0) = 0 all the same
    expected = float(np.sum(weights * quadrature.indentation_slope(k, s, *wave) * shapes)) - adhesive
    depth = general.indentation(k, M, a, *wave)
    assert quadrature.series_surface(k, r, a, depth, *wave) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("k", [0.0, 0.37, 1 - 1e-3, 1 - 1e-13])
def test_quadrature_of_the_gap(k: float) -> None:
    a, r, wave = (0.013, 0.29, (1.0, [-0.01], [])) if k in (0.0, 1 - 1e-3) else (0.05, 0.17, (0.1, [-0.01], [0.012]))
    depth = float(general.indentation(k, 300.0, a, *wave))
    with mpmath.workdps(25):  # the integral of what is left of the density at r has a closed form
        c, end = (1 - mpmath.mpf(k)) / 2, mpmath.mpf(r)

        def density(s: mpmath.mpf) -> mpmath.mpf:
            return s**k * (float(general.hertz_indentation(k, float(s), *wave)) - depth) * (end + s) ** (c - 1)

        def rest(v: mpmath.mpf) -> mpmath.mpf:  # r - s = (r-a) v^4
            inner = density(end - (end - a) * v**4) - density(end)
            return inner * ((end - a) * v**4) ** (c - 1) * 4 * (end - a) * v**3 if v else mpmath.mpf(0)

        total = mpmath.quad(rest, mpmath.linspace(0, 1, 13), maxdegree=5) + density(end) * (end - a) ** c / c
        expected = float(2 / mpmath.pi * mpmath.sin(mpmath.pi * c) * total)
    largest = float(general.hertz_indentation(k, r, *wave))
    assert quadrature.series_gap(k, r, a, depth, *wave) == pytest.approx(expected, abs=1e-12 * largest)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9, 1.0])
def test_the_gap_of_one_cosine_and_of_sums(k: float) -> None:
    r = np.array([0.2, 0.21, 0.3, 0.9])
    one, series = quadrature.gap(k, r, 0.2, 0.03, 0.1, 0.02), quadrature.series_gap(k, r, 0.2, 0.03, 0.1, [-0.02])
    np.testing.assert_allclose(series, one, atol=1e-15)
    # the gap is linear in the profile and the depth: sines and cosines by their sum
    waves = (([-0.02, 0.003], [0.0, 0.01]), ([-0.02], []), ([0.0, 0.003], []), ([], [0.0, 0.01]), ([], []))
    parts = [quadrature.series_gap(k, r, 0.2, 0.0, 0.1, *wave) for wave in waves]
    np.testing.assert_allclose(parts[0], sum(parts[1:4]) - 2 * parts[4], atol=1e-13)
    # (3.6), (3.7): the surface meets the punch at the edge, without adhesion and with it
    for depth in (hertz.indentation(k, 0.2, 0.1, 0.02), jkr.indentation(k, 300.0, 0.2, 0.1, 0.02)):
        edge = float(depth - general.height(0.2, 0.1, 0.02))
        if k < 1.0:
            assert quadrature.surface(k, 0.2, 0.2, depth, 0.1, 0.02) == pytest.approx(edge, abs=1e-15)
    if k < 1.0:  # without adhesion it opens as (r-a)^((3-k)/2)
        gaps = quadrature.gap(k, 0.2 + np.array([1e-6, 1e-5]), 0.2, hertz.indentation(k, 0.2, 0.1, 0.02), 0.1, 0.02)
        assert gaps[1] / gaps[0] == pytest.approx(10 ** (0.5 * (3 - k)), rel=1e-3)
