"""Contact without adhesion against mpmath's quadrature of (3.9) and (3.10)."""

import math
from functools import cache

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations import hertz, profile

EPS = float(np.finfo(float).eps)
WAVELENGTH, AMPLITUDE = 0.37, 0.023
CASES = [(k, a, m) for k in (0.0, 0.31, 0.9, 1.0) for a in (0.017, 0.29, 1.3) for m in (1.0, 2.0, 3.7)]


@cache
def _integral(a: float, power: mpmath.mpf, m: float | None) -> mpmath.mpf:
    """Integrate f'(s) (a^2-s^2)^power over (0, a), with s = a sin u: of s^m/m, or of the wave where m is None."""

    def slope(s: mpmath.mpf) -> mpmath.mpf:
        wave = 2 * mpmath.pi * mpmath.sin(2 * mpmath.pi * s / WAVELENGTH)
        return AMPLITUDE * wave if m is None else s ** (m - 1)

    nodes = mpmath.linspace(0, mpmath.pi / 2, 3 + math.ceil(2 * a / WAVELENGTH) if m is None else 3)
    exponent = 2 * power + 1
    return mpmath.mpf(a) ** exponent * mpmath.quad(
        lambda u: slope(a * mpmath.sin(u)) * mpmath.cos(u) ** exponent, nodes
    )


@pytest.mark.parametrize(("k", "a", "m"), CASES)
def test_depth_and_load(k: float, a: float, m: float) -> None:
    M = 71.3
    with mpmath.workdps(20):
        powers = (mpmath.mpf(k) - 1) / 2, (mpmath.mpf(k) + 1) / 2
        smooth_depth, smooth_moment = (_integral(a, power, m) for power in powers)
        depth, moment = (_integral(a, power, None) for power in powers)
        depth, moment = depth + smooth_depth, moment + smooth_moment
        depth, smooth_depth = (mpmath.mpf(a) ** (1 - k) * one for one in (depth, smooth_depth))
        load = 2 ** (1 - mpmath.mpf(k)) * M / (1 + k) * (mpmath.mpf(a) ** (1 + k) * depth - moment)
    assert hertz.power_indentation(k, a, m) == pytest.approx(float(smooth_depth), rel=20 * EPS)
    assert hertz.power_moment(k, a, m) == pytest.approx(float(smooth_moment), rel=20 * EPS)
    found = hertz.indentation(k, a, WAVELENGTH, AMPLITUDE, m)
    size = hertz.power_indentation(k, a, m) + 2 * math.pi * AMPLITUDE * a
    assert abs(found - float(depth)) <= 20 * EPS * size
    found_moment = hertz.power_moment(k, a, m) + hertz.wave_moment(k, a, WAVELENGTH, AMPLITUDE)
    assert abs(found_moment - float(moment)) <= 20 * EPS * size * a ** (1 + k)
    found_load = hertz.load(k, M, a, WAVELENGTH, AMPLITUDE, m) * 1.5 * math.pi
    assert abs(found_load - float(load)) <= 40 * EPS * size * 2 * M * a ** (1 + k)


@pytest.mark.parametrize("k", [0.0, 0.3, 1.0])
def test_load_grows_as_depth_does(k: float) -> None:
    # dP_H/da = K a^(1+k) d(delta_H)/da
    a, step = np.linspace(0.05, 0.9, 12), 1e-6

    def rate(function: object) -> np.ndarray:
        return (function(a + step) - function(a - step)) / (2 * step)  # type: ignore[operator]

    depth = rate(lambda x: hertz.indentation(k, x, WAVELENGTH, AMPLITUDE))
    load = rate(lambda x: hertz.load(k, 71.3, x, WAVELENGTH, AMPLITUDE))
    np.testing.assert_allclose(load, hertz.disc_stiffness(k, 71.3, a) * depth, rtol=1e-7, atol=1e-7)


def test_without_gradient_a_smooth_paraboloid_is_hertz() -> None:
    a, M = np.array([0.1, 0.7]), 33.0
    np.testing.assert_allclose(hertz.indentation(0.0, a, 1.0, 0.0), a**2, rtol=4 * EPS)
    np.testing.assert_allclose(hertz.load(0.0, M, a, 1.0, 0.0) * 1.5 * math.pi, 4 * M * a**3 / 3, rtol=8 * EPS)


def test_a_cone_without_gradient_is_sneddon() -> None:
    # slope 1: depth pi a/2, load pi E* a^2/2 at k = 0
    assert hertz.indentation(0.0, 0.3, 1.0, 0.0, 1.0) == pytest.approx(math.pi * 0.15, rel=8 * EPS)
    assert hertz.load(0.0, 33.0, 0.3, 1.0, 0.0, 1.0) * 1.5 * math.pi == pytest.approx(
        math.pi * 33 * 0.09 / 2, rel=8 * EPS
    )


def test_at_exponent_one_depth_is_the_profile() -> None:
    a = np.linspace(0.0, 1.4, 50)
    np.testing.assert_allclose(
        hertz.indentation(1.0, a, WAVELENGTH, AMPLITUDE), profile.height(a, WAVELENGTH, AMPLITUDE), atol=40 * EPS
    )


def test_outside_the_ranges() -> None:
    assert np.isnan(
        hertz.indentation([-0.1, 1.1, 0.5, 0.5, 0.5], [1, 1, -1, 1, 1], [1, 1, 1, 0, 1], [0, 0, 0, 0, -1])
    ).all()
    assert np.isnan(hertz.load(0.3, [0.0, -1.0, math.nan], 0.1, 0.1, 0.0)).all()
    assert np.isnan(hertz.power_moment(0.3, 0.1, [0.99, math.nan])).all()
    assert hertz.load(np.full((3, 1), 0.3), 1.0, np.ones(2), 0.1, 0.0).shape == (3, 2)
