"""Any smooth profile: closed forms of powers and of a sphere, superposition, and the general series."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations import any_profile, general, hertz, jkr

M = 210.0


@pytest.mark.parametrize("k", [0.0, 0.31, 1.0])
@pytest.mark.parametrize("m", [1.0, 1.3, 2.0, 5.0])
def test_powers(k: float, m: float) -> None:
    a = np.array([0.0, 0.02, 0.4, 1.7])

    def slope(r: np.ndarray) -> np.ndarray:
        return r ** (m - 1.0)

    np.testing.assert_allclose(any_profile.hertz_indentation(k, a, slope), hertz.power_indentation(k, a, m), rtol=2e-14)
    exact = hertz.load(k, M, a, 1.0, 0.0, m)
    np.testing.assert_allclose(any_profile.hertz_load(k, M, a, slope), exact, rtol=1e-13)
    np.testing.assert_allclose(
        any_profile.load(k, M, a, slope), jkr.load(k, M, a, 1.0, 0.0, m), atol=1e-13 * np.abs(exact).max()
    )


def test_a_sphere() -> None:
    # Sneddon (1965): delta = a/2 ln((1+a)/(1-a)), P = E* [(1+a^2)/2 ln((1+a)/(1-a)) - a]
    a = np.array([0.1, 0.5, 0.8])
    logarithm = np.log((1 + a) / (1 - a))

    def slope(r: np.ndarray) -> np.ndarray:
        return r / np.sqrt((1 - r) * (1 + r))

    np.testing.assert_allclose(any_profile.hertz_indentation(0.0, a, slope), 0.5 * a * logarithm, rtol=1e-13)
    load = M * (0.5 * (1 + a * a) * logarithm - a)
    # P_H is the difference of delta_H and of the mean height, which cancel to a/3 of them
    np.testing.assert_allclose(1.5 * math.pi * any_profile.hertz_load(0.0, M, a, slope), load, rtol=1e-12)


@pytest.mark.parametrize("k", [0.0, 0.31, 1.0])
def test_a_smooth_punch_and_its_waviness_add_up(k: float) -> None:
    # (5.1)-(5.4): delta = delta_1 + the integral of f2', P likewise
    a, wavelength, cosines, sines = np.array([0.05, 0.33]), 0.11, [-0.02, 0.003], [0.0, 0.004]

    def slope(r: np.ndarray) -> np.ndarray:
        y = 2 * math.pi * r / wavelength
        waves = -cosines[0] * np.sin(y) - 2 * cosines[1] * np.sin(2 * y) + 2 * sines[1] * np.cos(2 * y)
        return np.sinh(r) + 2 * math.pi * waves

    whole = any_profile.indentation(k, M, a, slope, 0.5 * wavelength)
    smooth = any_profile.indentation(k, M, a, np.sinh)
    rest = general.hertz_indentation(k, a, wavelength, cosines, sines) - hertz.power_indentation(k, a)
    np.testing.assert_allclose(whole, smooth + rest, rtol=1e-12)
    whole, smooth = any_profile.load(k, M, a, slope, 0.5 * wavelength), any_profile.load(k, M, a, np.sinh)
    rest = general.hertz_load(k, M, a, wavelength, cosines, sines) - hertz.load(k, M, a, wavelength, 0.0)
    np.testing.assert_allclose(whole, smooth + rest, rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize("k", [0.0, 0.31, 0.9])
def test_the_inversion_of_the_generalised_abel_equation(k: float) -> None:
    # (3.8), (A1)-(A5): the depth gives the profile back, f(a) = (2/pi) cos(k pi/2) int_0^a s^k delta (a^2-s^2)^-n ds
    a, n = mpmath.mpf("0.7"), (1 + mpmath.mpf(k)) / 2

    def depth(s: mpmath.mpf) -> float:
        return float(any_profile.hertz_indentation(k, float(s), np.sinh))

    def integrand(v: mpmath.mpf) -> mpmath.mpf:  # a^2 - s^2 = a^2 v^(1/(1-n))
        s = a * mpmath.sqrt(1 - v ** (1 / (1 - n)))
        return s ** (k - 1) * depth(s)

    with mpmath.workdps(15):
        edges = [*mpmath.linspace(0, 0.9, 4), 0.99, 0.999, 1]
        total = mpmath.quad(integrand, edges, maxdegree=5) * a ** (2 - 2 * n) / (2 * (1 - n))
        found = 2 / mpmath.pi * mpmath.cos(mpmath.pi * k / 2) * total
        # (A4): int (T^2-a^2)^((1+k)/2) f' da = (1+k) int s^k delta ds
        moment = mpmath.quad(lambda s: s**k * depth(s), [0, 0.01, 0.1, a], maxdegree=5)
        slope = mpmath.quad(lambda s: (a * a - s * s) ** n * mpmath.sinh(s), [0, a / 2, a])
        # (A2): the same by parts
        parts = mpmath.quad(lambda s: s * (mpmath.cosh(s) - 1) * (a * a - s * s) ** (n - 1), [0, a / 2, a])
        assert float((1 + k) * parts / slope) == pytest.approx(1.0, rel=1e-6)
        # (A3), with the ends 0 and 1
        identity = mpmath.beta((1 + mpmath.mpf(k)) / 2, (1 - mpmath.mpf(k)) / 2)
        assert float(identity * mpmath.cos(mpmath.pi * k / 2) / mpmath.pi) == pytest.approx(1.0, rel=1e-13)
    assert float(found) == pytest.approx(math.cosh(0.7) - 1.0, rel=1e-8)
    assert float((1 + k) * moment / slope) == pytest.approx(1.0, rel=1e-9)


def test_outside_the_ranges() -> None:
    assert np.isnan(any_profile.indentation([-0.1, 0.3, 0.3], [1, 0, 1], [1, 1, -1], np.sinh)).all()
    assert any_profile.load(np.full((2, 1), 0.3), 1.0, np.ones(3), np.sinh).shape == (2, 3)
