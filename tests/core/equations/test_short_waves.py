"""The leading term for short waves against the exact curve: its error falls as the wavelength does."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations import general, jkr, short_waves

COSINES, SINES = [-0.02, 0.004], [0.006, 0.0, -0.001]
M = 150.0


def _window(wavelength: float) -> np.ndarray:
    """Return one wave of radii around 0.5."""
    return 0.5 + wavelength * np.linspace(-0.5, 0.5, 101)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7, 1.0])
def test_error_over_the_wave_falls_as_the_wavelength(k: float) -> None:
    errors = []
    for wavelength in (0.02, 0.002, 0.0002):
        a = _window(wavelength)
        wave = short_waves.indentation(k, M, a, wavelength, COSINES, SINES)
        swing = np.ptp(wavelength ** (0.5 * (1 + k)) * short_waves.zeta(k, a / wavelength, COSINES, SINES))
        exact = general.indentation(k, M, a, wavelength, COSINES, SINES)
        load = short_waves.load(k, M, a, wavelength, COSINES, SINES)
        exact_load = general.load(k, M, a, wavelength, COSINES, SINES)
        # K a^(1+k) in units of 1.5 pi turns a swing of depth to one of load
        disc = 2 ** (1 - k) * M / (1 + k) * 0.5 ** (1 + k) / (1.5 * math.pi)
        errors.append([np.abs(wave - exact).max() / swing, np.abs(load - exact_load).max() / (disc * swing)])
    depth, load = np.array(errors).T
    np.testing.assert_allclose(load[:-1] / load[1:], 10.0, rtol=0.15)
    if k == 1.0:
        assert max(depth) < 1e-9  # the depth is exact
    else:
        np.testing.assert_allclose(depth[:-1] / depth[1:], 10.0, rtol=0.15)
    assert max(depth[0], load[0]) < 0.1


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7])
def test_the_remainder_of_the_load_is_smaller_than_the_printed_one(k: float) -> None:
    """K a^(2+k) O((lambda/a)^((3+k)/2)), not O(lambda/a): with the right (B5) the terms of that order cancel in P."""
    rest = []
    for wavelength in (2e-3, 2e-4, 2e-5):
        a = _window(wavelength)
        off = short_waves.load(k, M, a, wavelength, COSINES, SINES) - general.load(k, M, a, wavelength, COSINES, SINES)
        rest.append(np.abs(off).max())
    np.testing.assert_allclose(np.log10(np.array(rest[:-1]) / rest[1:]), 0.5 * (3.0 + k), atol=0.02)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7, 1.0])
def test_the_printed_form_lacks_the_mean_height(k: float) -> None:
    wavelength = 0.0005
    a = _window(wavelength)
    exact = general.indentation(k, M, a, wavelength, COSINES, SINES)
    printed = short_waves.indentation(k, M, a, wavelength, COSINES, SINES, mean_height=False)
    assert np.mean(exact - printed) == pytest.approx(wavelength * 0.016, rel=0.03)


def test_zeta_has_period_one_and_is_a_sine_for_one_cosine() -> None:
    xi = np.linspace(0.0, 1.0, 57)
    for k in (0.0, 0.4, 1.0):
        expected = (2 * math.pi) ** (0.5 * (1 - k)) * 0.03 * np.sin(2 * math.pi * xi - 0.25 * math.pi * (1 + k))
        np.testing.assert_allclose(short_waves.zeta(k, xi, [-0.03]), expected, atol=1e-16)
        np.testing.assert_allclose(
            short_waves.zeta(k, xi + 3.0, COSINES, SINES), short_waves.zeta(k, xi, COSINES, SINES), atol=1e-14
        )


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7])
def test_zeta_is_weyls_fractional_derivative(k: float) -> None:
    # (B11)-(B13): the derivative of order al = (1-k)/2 is d/dx of the integral of order 1-al. As an integral, for Q of
    # mean zero, Q_be(x) = 1/Gamma(be) int_0^inf t^(be-1) Q(x-t) dt, and the sum over all periods is Hurwitz's zeta:
    # (2 pi)^be/Gamma(be) int_0^1 zeta(1-be, u) Q(x - 2 pi u) du
    al = mpmath.mpf(1 - k) / 2
    be = 1 - al

    def slope(x: mpmath.mpf) -> mpmath.mpf:  # of f2 - a0/2, over x = 2 pi xi
        return -COSINES[0] * mpmath.sin(x) - 2 * COSINES[1] * mpmath.sin(2 * x) + SINES[0] * mpmath.cos(x)

    with mpmath.workdps(15):
        turn = 2 * mpmath.pi
        for xi in (0.13, 0.7):
            x = turn * mpmath.mpf(xi)

            def integrand(v: mpmath.mpf, x: mpmath.mpf = x) -> mpmath.mpf:  # u = v^(1/be)
                u = v ** (1 / be)
                return v ** (1 / be - 1) / be * mpmath.zeta(1 - be, u) * slope(x - turn * u)

            whole = turn**be * mpmath.quad(integrand, mpmath.linspace(0, 1, 5))
            exact = turn**al * whole / mpmath.gamma(be)  # of xi, not of x
            found = short_waves.zeta(k, xi, COSINES, SINES[:1])
            assert float(found) == pytest.approx(float(exact), abs=1e-12)
            # the sums (B13), their derivative (B12) by a central difference
            step = mpmath.mpf("1e-5")
            ahead, behind = (_weyl_integral(be, x + h, COSINES, SINES[:1]) for h in (step, -step))
            assert float(found) == pytest.approx(float(turn**al * (ahead - behind) / (2 * step)), abs=1e-9)


def _weyl_integral(order: mpmath.mpf, x: mpmath.mpf, cosines: list[float], sines: list[float]) -> mpmath.mpf:
    """Return Q_order(x) as (B13) has it."""
    total = mpmath.mpf(0)
    for n, a_n, b_n in general.harmonics(cosines, sines):
        c, s = mpmath.cos(n * x), mpmath.sin(n * x)
        half = mpmath.pi * order / 2
        total += mpmath.mpf(n) ** -order * (
            mpmath.cos(half) * (a_n * c + b_n * s) + mpmath.sin(half) * (a_n * s - b_n * c)
        )
    return total


def test_a_smooth_punch_is_left_as_it_is() -> None:
    a = np.linspace(0.1, 0.9, 9)
    np.testing.assert_allclose(
        short_waves.indentation(0.4, M, a, 0.1, []), jkr.indentation(0.4, M, a, 0.1, 0.0), rtol=1e-14
    )
    np.testing.assert_allclose(short_waves.load(0.4, M, a, 0.1, []), jkr.load(0.4, M, a, 0.1, 0.0), rtol=1e-14)


def test_outside_the_ranges() -> None:
    assert np.isnan(short_waves.zeta([-0.1, 1.1], 0.3, [-0.1])).all()
    assert np.isnan(short_waves.indentation(0.3, [0.0, M, M], [0.1, 0.0, 0.1], [0.1, 0.1, 0.0], [-0.1])).all()
    assert short_waves.load(np.full((2, 1), 0.3), 1.0, np.ones(3), 0.1, [-0.1], [0.1]).shape == (2, 3)
