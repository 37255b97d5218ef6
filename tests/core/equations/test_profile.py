"""The profile (2.1): its slope, and where it stops to rise."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from gradhesion.core.equations import general
from gradhesion.core.equations.profile import DEEPEST_SINC, height, is_monotonic, largest_monotonic_amplitude, slope


def test_height_is_a_power_and_a_wave() -> None:
    r = np.linspace(0.0, 0.9, 40)
    for m in (1.0, 2.0, 3.3):
        expected = r**m / m + 0.13 * 0.021 * (1 - np.cos(2 * math.pi * r / 0.13))
        np.testing.assert_allclose(height(r, 0.13, 0.021, m), expected, rtol=1e-13, atol=1e-17)


def test_height_is_that_of_the_general_series() -> None:
    r = np.linspace(0.0, 0.9, 40)
    np.testing.assert_allclose(
        height(r, 0.13, 0.021) - r * r / 2, 0.13 * general.waviness(r / 0.13, [-0.021]), atol=1e-16
    )


@pytest.mark.parametrize("m", [1.0, 2.0, 3.3])
def test_slope_is_the_derivative_of_the_height(m: float) -> None:
    r, step = np.linspace(0.05, 0.9, 33), 1e-6
    central = (height(r + step, 0.13, 0.021, m) - height(r - step, 0.13, 0.021, m)) / (2 * step)
    # third derivative 2 pi A (2 pi/lambda)^2 = 308, times step^2/6, and rounding eps/step
    np.testing.assert_allclose(slope(r, 0.13, 0.021, m), central, atol=2e-9)


def test_constant_is_the_deepest_point_of_the_sinc() -> None:
    found = minimize_scalar(lambda y: math.sin(y) / y, bounds=(4.0, 5.0), options={"xatol": 1e-10})
    assert pytest.approx(-found.fun, rel=1e-14) == DEEPEST_SINC


def test_largest_amplitude_of_a_rising_profile() -> None:
    for wavelength in (0.013, 0.2, 1.7):
        limit = float(largest_monotonic_amplitude(wavelength))
        r = np.linspace(0.0, 3 * wavelength, 30001)
        assert slope(r, wavelength, limit * (1 - 1e-6)).min() >= 0.0
        assert slope(r, wavelength, limit * (1 + 1e-5)).min() < 0.0
        assert is_monotonic(wavelength, limit)
        assert not is_monotonic(wavelength, np.nextafter(limit, 1.0))


def test_outside_the_ranges() -> None:
    assert np.isnan(
        height([-1.0, math.nan, 0.1, 0.1, 0.1], [0.1, 0.1, 0.0, 0.1, 0.1], [0, 0, 0, -1, 0], [2, 2, 2, 2, 0.9])
    ).all()
    assert np.isnan(slope(0.1, [0.1, -0.1], [-1.0, 0.1])).all()
    assert not is_monotonic([0.1, -0.1], [-1.0, 0.001]).any()
