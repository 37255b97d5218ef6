"""The gap against the surface that the pressure itself presses in, Hertz, and the flat punch."""

import math
from functools import lru_cache

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations import gap as module
from gradhesion.core.equations import general, hertz, jkr, profile

pytestmark = pytest.mark.slow

gap, surface = module.gap, module.surface


@lru_cache
def _disc_shape(k: float, ratio: float) -> float:
    """Return the surface at r around a flat disc of radius a pressed in by 1, ratio = a/r, from its pressure.

    The pressure (a^2-s^2)^((k-1)/2) acts through the influence 1/distance^(1+k) of a point load (a graded half-space at
    the surface); the angle is integrated to a hypergeometric function, and the depth at the centre scales the result.
    """
    power = mpmath.mpf(k - 1) / 2
    n = mpmath.mpf(1 + k) / 2

    def outside(u: mpmath.mpf) -> mpmath.mpf:  # t = sin u
        t = mpmath.sin(u)
        return mpmath.cos(u) ** (2 * power + 1) * t * mpmath.hyp2f1(n, n, 1, (ratio * t) ** 2)

    centre = mpmath.beta((1 - mpmath.mpf(k)) / 2, n) / 2  # int_0^1 (1-t^2)^power t^(-k) dt
    return float(mpmath.mpf(ratio) ** (1 + k) * mpmath.quad(outside, [0, mpmath.pi / 4, mpmath.pi / 2]) / centre)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.8])
@pytest.mark.parametrize("ratio", [0.15, 0.7, 0.95])
def test_the_surface_around_a_flat_disc(k: float, ratio: float) -> None:
    # two depths of one disc differ by a flat disc
    a, wave = 0.2, (0.1, 0.01)
    above, below = surface(k, a / ratio, a, [1.0, 0.0], *wave)
    with mpmath.workdps(18):
        assert above - below == pytest.approx(_disc_shape(k, ratio), rel=1e-12)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.8])
def test_the_surface_around_a_wavy_punch(k: float) -> None:
    # contact that grows from 0 to a presses flat discs of all radii s one after the other, by d(delta_H)(s) each
    a, r, wavelength, amplitude, M = 0.11, 0.17, 0.09, 0.02, 300.0
    nodes, weights = np.polynomial.legendre.leggauss(20)
    s, weights = 0.5 * a * (1 + nodes), 0.5 * a * weights
    step = 1e-5
    rate = hertz.indentation(k, s + step, wavelength, amplitude) - hertz.indentation(k, s - step, wavelength, amplitude)
    with mpmath.workdps(15):
        shapes = [_disc_shape(k, float(one) / r) for one in s]
        adhesive = _disc_shape(k, a / r) * float(jkr.adhesive_depth(k, M, a))
    expected = float(np.sum(weights * rate / (2 * step) * shapes)) - adhesive
    depth = jkr.indentation(k, M, a, wavelength, amplitude)
    # the central difference leaves step^2 delta_H'''/6, delta_H''' <= 2 pi A (2 pi/lambda)^2 pi/2
    assert surface(k, r, a, depth, wavelength, amplitude) == pytest.approx(expected, abs=1e-7)


def test_around_hertz() -> None:
    r = np.array([1.0, 1.01, 1.7, 9.0]) * 0.31
    a = 0.31
    pressed = ((2 * a * a - r * r) * np.arcsin(a / r) + a * np.sqrt(r * r - a * a)) / math.pi
    # the surface is a small difference of the gap and r^2/2 = 3.9: 20 eps of that
    np.testing.assert_allclose(surface(0.0, r, a, a * a, 1.0, 0.0), pressed, atol=2e-14, rtol=0.0)


def test_at_exponent_one_the_surface_is_flat_outside() -> None:
    r = np.linspace(0.21, 0.6, 30)
    depth = jkr.indentation(1.0, 300.0, 0.2, 0.1, 0.03)
    np.testing.assert_allclose(gap(1.0, r, 0.2, depth, 0.1, 0.03), profile.height(r, 0.1, 0.03) - depth, atol=1e-15)
    # which the integral approaches
    np.testing.assert_allclose(gap(1 - 1e-7, r, 0.2, depth, 0.1, 0.03), profile.height(r, 0.1, 0.03) - depth, atol=2e-6)


@pytest.mark.parametrize("k", [0.9, 1 - 1e-3, 1 - 1e-6, 1 - 1e-9, 1 - 1e-13])
@pytest.mark.parametrize("amplitude", [0.0, 0.01])
def test_next_to_exponent_one(k: float, amplitude: float) -> None:
    """All of the weight is at r, where int (r-s)^(c-1) ds has the closed form (r-a)^c/c; c = (1-k)/2."""
    a, r, wavelength, depth = 0.2, 0.29, 0.1, 0.013
    with mpmath.workdps(25):
        c, end = (1 - mpmath.mpf(k)) / 2, mpmath.mpf(r)

        def density(s: mpmath.mpf) -> mpmath.mpf:
            wave = float(hertz.wave_indentation(k, float(s), wavelength, amplitude)) if amplitude else 0
            return s**k * (s * s / (1 + mpmath.mpf(k)) + wave - depth) * (end + s) ** (c - 1)

        def rest(s: mpmath.mpf) -> mpmath.mpf:
            return (density(s) - density(end)) * (end - s) ** (c - 1) if s < end else mpmath.mpf(0)

        total = mpmath.quad(rest, mpmath.linspace(a, r, 7)) + density(end) * (end - a) ** c / c
        expected = float(2 / mpmath.pi * mpmath.sin(mpmath.pi * c) * total)
    largest = float(hertz.indentation(k, r, wavelength, amplitude))
    assert gap(k, r, a, depth, wavelength, amplitude) == pytest.approx(expected, abs=1e-14 * largest)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9])
@pytest.mark.parametrize("wavelength", [1.0, 0.04])
def test_quadrature_of_the_integral(k: float, wavelength: float) -> None:
    a, r, amplitude, M = 0.013, 0.29, 0.01, 300.0
    depth = float(jkr.indentation(k, M, a, wavelength, amplitude))

    def integrand(v: mpmath.mpf) -> mpmath.mpf:  # r^2 - s^2 = (r^2-a^2) v^p, p = 2/(1-k), has no singular end
        s = mpmath.sqrt(r * r - (r * r - a * a) * v ** (mpmath.mpf(2) / (1 - k)))
        return s ** (k - 1) * (float(hertz.indentation(k, float(s), wavelength, amplitude)) - depth)

    # v = 1 - w^2/.. towards s = a is smooth; the waves are densest near v = 1
    places = [1 - (1 - i / 24) ** 3 for i in range(25)]
    with mpmath.workdps(15):
        total = mpmath.quad(integrand, places) * mpmath.mpf(r * r - a * a) ** (mpmath.mpf(1 - k) / 2) / (1 - k)
    expected = float(2 / mpmath.pi * mpmath.cos(mpmath.pi * k / 2) * total)
    largest = float(hertz.indentation(k, r, wavelength, amplitude))
    assert gap(k, r, a, depth, wavelength, amplitude) == pytest.approx(expected, abs=1e-12 * largest)


def test_a_rising_profile_does_not_ensure_contact_over_one_disc() -> None:
    amplitude = 4.59 * 0.1 / (4 * math.pi**2)
    assert profile.is_monotonic(0.1, amplitude)
    depth = jkr.indentation(0.0, 1e7, 0.0511, 0.1, amplitude)
    assert gap(0.0, 0.0811, 0.0511, depth, 0.1, amplitude) == pytest.approx(-2.6e-4, abs=0.05e-4)


def test_just_outside_an_adhesive_edge_the_gap_opens_upwards() -> None:
    # K_I opening at k = 0: (2/pi) Delta acosh-like, 2 Delta/pi sqrt(2 (r-a)/a)
    depth, stretch = jkr.indentation(0.0, 300.0, 0.2, 0.1, 0.01), jkr.adhesive_depth(0.0, 300.0, 0.2)
    distance = 1e-9
    expected = 2 / math.pi * float(stretch) * math.sqrt(2 * distance / 0.2)
    assert gap(0.0, 0.2 + distance, 0.2, depth, 0.1, 0.01) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9])
def test_the_surface_meets_the_punch_at_the_edge(k: float) -> None:
    # (3.6), (3.7): u_z(a) = delta - f(a), without adhesion and with it
    for depth in (hertz.indentation(k, 0.2, 0.1, 0.02), jkr.indentation(k, 300.0, 0.2, 0.1, 0.02)):
        edge = float(depth - profile.height(0.2, 0.1, 0.02))
        assert surface(k, 0.2, 0.2, depth, 0.1, 0.02) == pytest.approx(edge, abs=1e-15)
    # without adhesion continuous and smooth, the gap opening as (r-a)^((3-k)/2)
    depth = hertz.indentation(k, 0.2, 0.1, 0.02)
    gaps = gap(k, 0.2 + np.array([1e-6, 1e-5]), 0.2, depth, 0.1, 0.02)
    assert gaps[1] / gaps[0] == pytest.approx(10 ** (0.5 * (3 - k)), rel=1e-3)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9, 1.0])
def test_a_series(k: float) -> None:
    r = np.array([0.2, 0.21, 0.3, 0.9])
    one, series = gap(k, r, 0.2, 0.03, 0.1, 0.02), module.series_gap(k, r, 0.2, 0.03, 0.1, [-0.02])
    np.testing.assert_allclose(series, one, atol=1e-15)
    # the gap is linear in the profile and the depth: sines and cosines by their sum
    both = module.series_gap(k, r, 0.2, 0.0, 0.1, [-0.02, 0.003], [0.0, 0.01])
    parts = [
        module.series_gap(k, r, 0.2, 0.0, 0.1, cosines, sines)
        for cosines, sines in (([-0.02], []), ([0.0, 0.003], []), ([], [0.0, 0.01]), ([], []))
    ]
    np.testing.assert_allclose(both, sum(parts[:3]) - 2 * parts[3], atol=1e-13)
    flat = module.series_surface(k, r, 0.2, [[0.05], [0.03]], 0.1, [-0.02, 0.003], [0.0, 0.01])
    disc = surface(k, r, 0.2, 0.05, 0.1, 0.0) - surface(k, r, 0.2, 0.03, 0.1, 0.0)
    np.testing.assert_allclose(flat[0] - flat[1], disc, atol=1e-13)


@pytest.mark.parametrize("k", [0.0, 0.37])
def test_a_sine_by_quadrature(k: float) -> None:
    a, r, wave = 0.05, 0.17, (0.1, [-0.01], [0.012])
    depth = float(general.indentation(k, 300.0, a, *wave))

    def integrand(v: mpmath.mpf) -> mpmath.mpf:  # r^2 - s^2 = (r^2-a^2) v^p, p = 2/(1-k)
        s = mpmath.sqrt(r * r - (r * r - a * a) * v ** (mpmath.mpf(2) / (1 - k)))
        return s ** (k - 1) * (float(general.hertz_indentation(k, float(s), *wave)) - depth)

    with mpmath.workdps(15):
        total = mpmath.quad(integrand, [1 - (1 - i / 12) ** 3 for i in range(13)])
        total *= mpmath.mpf(r * r - a * a) ** (mpmath.mpf(1 - k) / 2) / (1 - k)
    expected = float(2 / mpmath.pi * mpmath.cos(mpmath.pi * k / 2) * total)
    assert module.series_gap(k, r, a, depth, *wave) == pytest.approx(expected, abs=1e-13)


def test_ranges_and_shapes() -> None:
    assert gap(0.3, 0.2, 0.2, 0.0, 0.1, 0.01) == 0.0
    assert np.isnan(
        gap([0.3, 0.3, -0.1, 0.3], [0.1, 0.3, 0.3, 0.3], [0.2, 0.0, 0.2, 0.2], [0.0, 0.0, 0.0, math.nan], 0.1, 0.0)
    ).all()
    assert gap(np.full((2, 1), 0.3), np.full(3, 0.3), 0.2, 0.01, 0.1, 0.0).shape == (2, 3)
