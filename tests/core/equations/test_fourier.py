"""Fourier coefficients against the integrals that define them, closed forms, and the profile they stand for."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations import any_profile, fourier, general


def test_a_series_gives_its_own_coefficients_back() -> None:
    cosines, sines = [-0.021, 0.004, 0.0, 0.001], [0.003, 0.0, -0.002, 0.0]
    found = fourier.coefficients(lambda xi: general.waviness(xi, cosines, sines), 4)
    np.testing.assert_allclose(found, [cosines, sines], atol=1e-16)
    # samples as few as the harmonics allow, and a height that does not count
    heights = 7.0 + general.waviness(np.arange(9) / 9, cosines, sines)
    np.testing.assert_allclose(fourier.sampled_coefficients(heights, 4), [cosines, sines], atol=1e-15)


def test_coefficients_are_the_integrals() -> None:
    def bump(xi: mpmath.mpf) -> mpmath.mpf:
        return mpmath.exp(mpmath.sin(2 * mpmath.pi * xi)) * mpmath.cos(2 * mpmath.pi * xi)

    cosines, sines = fourier.coefficients(lambda xi: np.exp(np.sin(2 * math.pi * xi)) * np.cos(2 * math.pi * xi), 5)
    with mpmath.workdps(20):
        for n in range(1, 6):
            for found, wave in ((cosines, mpmath.cos), (sines, mpmath.sin)):
                exact = 2 * mpmath.quad(
                    lambda xi, n=n, wave=wave: bump(xi) * wave(2 * mpmath.pi * n * xi), mpmath.linspace(-0.5, 0.5, 9)
                )
                assert found[n - 1] == pytest.approx(float(exact), abs=1e-14)


def test_corners_take_more_samples_and_steps_have_no_answer() -> None:
    # a triangle of height 1: a_n = -4/(pi n)^2 for odd n
    cosines, _ = fourier.coefficients(lambda xi: 2 * np.minimum(xi % 1, 1 - xi % 1), 3)
    np.testing.assert_allclose(cosines, [-4 / math.pi**2, 0.0, -4 / (9 * math.pi**2)], atol=1e-11)
    with pytest.raises(ValueError, match="not resolved"):
        fourier.coefficients(lambda xi: np.where(xi % 1 < 0.3, 1.0, 0.0), 2)


@pytest.mark.parametrize("k", [0.0, 0.43, 1.0])
def test_they_are_the_way_from_a_function_to_the_punch(k: float) -> None:
    # the same punch by quadrature of its own slope; exp(sin) has 20 harmonics above rounding
    wavelength, a = 0.13, np.array([0.04, 0.21])
    cosines, sines = fourier.coefficients(lambda xi: 0.01 * np.exp(np.sin(2 * math.pi * xi)), 20)

    def slope(r: np.ndarray) -> np.ndarray:
        y = 2 * math.pi * r / wavelength
        return r + 0.02 * math.pi * np.cos(y) * np.exp(np.sin(y))

    own = any_profile.indentation(k, 210.0, a, slope, wavelength / 6)
    np.testing.assert_allclose(general.indentation(k, 210.0, a, wavelength, cosines, sines), own, atol=1e-14)


def test_bad_input() -> None:
    with pytest.raises(ValueError, match="terms = 5: 8 samples hold 1 to 3"):
        fourier.sampled_coefficients(np.zeros(8), 5)
    with pytest.raises(ValueError, match="finite"):
        fourier.sampled_coefficients([0.0, math.nan, 0.0], 1)
    with pytest.raises(ValueError, match="terms = 0"):
        fourier.coefficients(np.sin, 0)
