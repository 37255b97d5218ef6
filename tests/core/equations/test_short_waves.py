"""Short waves: the leading term, its envelopes, the effective path, its energy, and where folds end."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from gradhesion.core import solve
from gradhesion.core.equations import effective, envelopes, general, jkr, short_waves
from gradhesion.core.problem.material import stiffness
from tests.core.scene import EPS, envelope_loop

M, WAVELENGTH, AMPLITUDE = 150.0, 0.003, 0.02
COSINES, SINES = [-0.02, 0.004], [0.006, 0.0, -0.001]
EXPONENTS = [0.0, 0.41, 0.9, 1.0]
SCENE = {"nu": 0.3, "modulus": 300.0, "c0_over_R": 0.01, "A": 0.03}


def strengths(k: float) -> tuple[float, float]:
    s, r = envelopes.adhesion_strength(k, M), envelopes.waviness_strength(k, WAVELENGTH, AMPLITUDE)
    return float(s), float(r)


def amplitude_of(k: float, stiff: float, ratio: float) -> float:
    """The amplitude at which r/s is a ratio, for waves of 0.01 R."""
    return ratio * float(envelopes.adhesion_strength(k, stiff) / envelopes.waviness_strength(k, 0.01, 1.0))


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7, 1.0])
def test_error_over_the_wave_falls_as_the_wavelength(k: float) -> None:
    errors, rest, means = [], [], []
    for wavelength in (2e-2, 2e-3, 2e-4):
        a = 0.5 + wavelength * np.linspace(-0.5, 0.5, 101)
        wave = (wavelength, COSINES, SINES)
        swing = np.ptp(wavelength ** (0.5 * (1 + k)) * short_waves.zeta(k, a / wavelength, COSINES, SINES))
        depth = general.indentation(k, M, a, *wave)
        error = np.abs(short_waves.indentation(k, M, a, *wave) - depth).max() / swing
        off = np.abs(short_waves.load(k, M, a, *wave) - general.load(k, M, a, *wave)).max()
        # K a^(1+k) in units of 1.5 pi turns a swing of depth to one of load
        disc = 2 ** (1 - k) * M / (1 + k) * 0.5 ** (1 + k) / (1.5 * math.pi)
        errors.append([error, off / (disc * swing)])
        rest.append(off)
        means.append(np.mean(depth - short_waves.indentation(k, M, a, *wave, mean_height=False)))
    falls = np.array(errors[:-1]) / errors[1:]
    np.testing.assert_allclose(falls[:, 1], 10.0, rtol=0.15)
    if k == 1.0:
        assert max(error for error, _ in errors) < 1e-9  # the depth is exact
    else:
        np.testing.assert_allclose(falls[:, 0], 10.0, rtol=0.15)
        # not of the order lambda/a of K a^(2+k), as printed: with the right (B5) the terms of that order cancel in P
        assert np.log10(rest[1] / rest[2]) == pytest.approx(0.5 * (3.0 + k), abs=0.02)
    assert np.max(errors[0]) < 0.1
    assert means[2] == pytest.approx(2e-4 * 0.016, rel=0.03)  # the mean height, which the printed form lacks


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
        for xi in (0.13, 3.7):
            x = turn * mpmath.mpf(xi)

            def integrand(v: mpmath.mpf, x: mpmath.mpf = x) -> mpmath.mpf:  # u = v^(1/be)
                u = v ** (1 / be)
                return v ** (1 / be - 1) / be * mpmath.zeta(1 - be, u) * slope(x - turn * u)

            exact = turn * mpmath.quad(integrand, mpmath.linspace(0, 1, 5)) / mpmath.gamma(be)  # of xi, not of x
            found = float(short_waves.zeta(k, xi, COSINES, SINES[:1]))
            assert found == pytest.approx(float(exact), abs=1e-12)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("m", [1.5, 2.0])
def test_envelopes_bound_the_leading_term_and_touch_it(k: float, m: float) -> None:
    a = 0.5 + WAVELENGTH * np.linspace(0.0, 1.0, 2001)
    wave = (WAVELENGTH, COSINES, SINES)
    depth, load = short_waves.indentation(k, M, a, *wave, exponent=m), short_waves.load(k, M, a, *wave, exponent=m)
    up, down = envelopes.series_strengths(k, *wave)
    assert abs(up - down) > 1e-3 * up
    s, mean = float(envelopes.adhesion_strength(k, M)), WAVELENGTH * 0.016
    for sign, pull in ((1.0, s - up), (-1.0, s + down)):
        space = sign * (envelopes.indentation(k, a, pull, mean, m) - depth)
        assert -40 * EPS <= space.min() <= 1e-5 * np.ptp(depth)  # (step of phase)^2/8
        space = sign * (envelopes.load(k, M, a, pull, m) - load)
        assert -400 * EPS * M <= space.min() <= 1e-5 * np.ptp(load)
    one = envelopes.waviness_strength(k, WAVELENGTH, AMPLITUDE)
    for wave_of_one in ([-AMPLITUDE], [AMPLITUDE]):
        np.testing.assert_allclose(envelopes.series_strengths(k, WAVELENGTH, wave_of_one), one, rtol=8e-15)
    assert s == pytest.approx(jkr.adhesive_depth(k, M, 1.0), rel=4 * EPS)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_extrema_of_zeta_are_true(k: float) -> None:
    rng = np.random.default_rng(5)
    for count in (1, 2, 5, 64):
        waves = (rng.normal(size=(2, count)) / np.arange(1, count + 1)).tolist()
        xi = np.linspace(0.0, 1.0, 2000 * count + 1)
        size = np.sum(np.hypot(*waves) * (2 * math.pi * np.arange(1, count + 1)) ** (0.5 * (1 - k)))
        for sign, extreme in zip((-1.0, 1.0), envelopes.zeta_extrema(k, *waves), strict=True):

            def height(t: Any, sign: float = sign, waves: list[list[float]] = waves) -> Any:
                return -sign * short_waves.zeta(k, t, *waves)

            best = xi[np.argmin(height(xi))]
            around = (best - 1e-3 / count, best + 1e-3 / count)
            polished = minimize_scalar(lambda t: float(height(t)), bounds=around, options={"xatol": 1e-12})
            assert sign * extreme == pytest.approx(-polished.fun, abs=50 * EPS * size)


@pytest.mark.parametrize("k", [0.0, 0.41, 1.0])
@pytest.mark.parametrize("m", [1.0, 1.5, 2.0, 6.5])
def test_envelopes_of_any_power(k: float, m: float) -> None:
    s, r = strengths(k)
    radius, force = (float(one) for one in envelopes.power_pull_off(k, M, s + r, m))
    around = {"bounds": (0.5 * radius, 2 * radius), "options": {"xatol": 1e-12}}
    low = minimize_scalar(lambda a: float(envelopes.load(k, M, a, s + r, m)), **around)
    assert -low.fun == pytest.approx(force, rel=1e-12)
    if m == 2.0:
        assert envelopes.pull_off_force(k, r / s) == pytest.approx(force, rel=1e-12)
    touch, _ = envelopes.power_radii(k, s - r, m)
    assert abs(float(envelopes.indentation(k, touch, s - r, 0.0, m))) <= 20 * EPS * s
    _, fold = envelopes.power_radii(k, s + r, m)
    near = envelopes.indentation(k, float(fold) * np.array([1 - 1e-4, 1.0, 1 + 1e-4]), s + r, 0.0, m)
    assert fold == 0.0 if k == 1.0 else near[1] < min(near[0], near[2])
    if m == 2.0:
        assert effective.jump_in_radius(k, s, r) == pytest.approx(float(touch), rel=8 * EPS)
        assert effective.jump_out_radius(k, s, r) == pytest.approx(float(fold), rel=8 * EPS)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("m", [1.5, 2.0])
def test_early_unloading_joins_the_envelopes(k: float, m: float) -> None:
    a, wave = 0.6, (WAVELENGTH, COSINES, SINES)
    lowest, highest = envelopes.zeta_extrema(k, COSINES, SINES)
    (up, down), s = envelopes.series_strengths(k, *wave), envelopes.adhesion_strength(k, M)
    ends = []
    for alpha, pull in ((highest, s - up), (lowest, s + down)):
        depth = effective.indentation(k, M, a, alpha, WAVELENGTH, exponent=m, mean_height=0.001)
        assert depth == pytest.approx(envelopes.indentation(k, a, pull, 0.001, m), rel=1e-12)
        load = envelopes.load(k, M, a, pull, m)
        assert effective.load(k, M, a, alpha, WAVELENGTH, exponent=m) == pytest.approx(load, rel=1e-12)
        on_line = effective.load_at_depth(k, M, a, depth, exponent=m, mean_height=0.001)
        assert on_line == pytest.approx(load, rel=1e-11)
        assert m != 2.0 or effective.early_unloading_load(k, M, a, depth, 0.001) == pytest.approx(load, rel=1e-11)
        ends.append(float(depth))
    drop = effective.drop(k, a, *wave)  # of depths of the order of the radius: eps of it
    assert ends[0] - ends[1] == pytest.approx(float(drop), abs=4e-16)
    r = envelopes.waviness_strength(k, WAVELENGTH, AMPLITUDE)
    one = float(effective.early_unloading_depth(k, a, r))
    assert effective.drop(k, a, WAVELENGTH, [-AMPLITUDE]) == pytest.approx(one, rel=1e-13)
    assert one == pytest.approx(2 * float(r) * a ** (0.5 * (1 - k)), rel=1e-13)
    assert effective.drop(k, a, WAVELENGTH, [0.0]) == 0.0


@pytest.mark.parametrize("k", [0.0, 0.2, 0.53, 0.9, 1.0])
@pytest.mark.parametrize("ratio", [0.03, 0.7])
def test_energy_is_the_loop_integral(k: float, ratio: float) -> None:
    amplitude, s = amplitude_of(k, M, ratio), float(envelopes.adhesion_strength(k, M))
    start, r = float(effective.jump_in_radius(k, s, ratio * s)), ratio * s
    first = effective.first_part(k, M, 0.01, amplitude)
    if effective.jump_out_radius(k, s, r) < start:  # unloading ends within the contact
        assert first == pytest.approx(float(envelope_loop(k, M, 2.0, r, r, start)), rel=1e-10)
    # (5.42) as it must be
    per_area = amplitude * math.gamma((1 + k) / 2) * math.sqrt(2 ** (3 - k) * math.pi ** (2 - k) * 0.01 ** (1 + k) * M)
    for largest in (1.3 * start, 4.0 * start):
        total = effective.dissipated_energy(k, M, 0.01, amplitude, largest)
        assert total == pytest.approx(float(envelope_loop(k, M, 2.0, r, r, largest)), rel=1e-10)
        assert total - first == pytest.approx(per_area * (largest**2 - start**2), rel=1e-12)


def test_coefficients_of_the_paper() -> None:
    k = [0.0, 0.2, 0.5, 0.9]
    np.testing.assert_allclose(effective.smooth_coefficient(k), [7.092, 8.863, 11.317, 14.188], atol=5e-4)
    np.testing.assert_allclose(effective.waviness_coefficient(k), [29.629, 25.241, 19.465, 13.692], atol=5e-4)


@pytest.mark.parametrize("k", [0.0, 0.5, 0.9, 1.0])
def test_coefficients_are_the_expansion_of_the_first_part(k: float) -> None:
    length, step = M ** (-1 / (3 + k)), amplitude_of(k, M, 1e-4)
    none, one, two = effective.first_part(k, M, 0.01, [0.0, step, 2 * step])
    assert none == pytest.approx(effective.smooth_coefficient(k) * length**2, rel=40 * EPS)
    slope = (4 * one - two - 3 * none) / (2 * step)  # second-order forward difference
    expected = effective.waviness_coefficient(k) * 0.01 ** (0.5 * (1 + k)) * length ** (0.5 * (1 - k))
    assert slope == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("k", [0.0, 0.5, 0.9])
@pytest.mark.parametrize(("ratio", "low", "high"), [(0.01, 0.0, 0.002), (0.1, 0.009, 0.015), (0.5, 0.14, 0.2)])
def test_fitted_energy_is_good_for_weak_waviness(k: float, ratio: float, low: float, high: float) -> None:
    amplitude, s = amplitude_of(k, 90.0, ratio), float(envelopes.adhesion_strength(k, 90.0))
    largest = 2 * effective.jump_in_radius(k, s, ratio * s)
    fitted = effective.fitted_energy(k, 90.0, 0.01, amplitude, largest)
    assert low < abs(fitted / effective.dissipated_energy(k, 90.0, 0.01, amplitude, largest) - 1) < high


@pytest.mark.parametrize("u", [0.0, 0.03, 0.4, 0.95])
def test_share_of_a_sampled_wave(u: float) -> None:
    theta = np.linspace(0.0, 40 * math.pi, 400_001)
    curve = np.sin(theta) + u * theta
    distance = np.maximum.accumulate(curve) - np.minimum.accumulate(curve[::-1])[::-1]
    # one wave from the middle; 10,000 steps of h a quarter wave: h^2
    assert short_waves.share(u) == pytest.approx(distance[200_000:220_000].mean() / 2, abs=1e-6)
    assert (1 - short_waves.share(1e-7)) / 1e-7 == pytest.approx(math.pi, rel=1e-3)


@pytest.mark.parametrize("k", [0.0, 0.2, 0.5])
def test_energy_of_short_waves(k: float) -> None:
    # the error falls as the wavelength, and more slowly where waves end near the jump-in
    wavelength, material = 5e-4 if k == 0.0 else 1e-4, stiffness(k, 0.3, 300.0, 0.01)  # 350,000 to 30,000 waves
    end = float(short_waves.end_of_folds(k, wavelength, SCENE["A"]))
    largest = np.array([0.5, 0.8, 1.3, math.inf]) * end
    exact = solve({"k": k, "lambda_over_R": wavelength, "a_max_over_R": largest} | SCENE)["dissipated_energy"]
    found = short_waves.dissipated_energy(k, material, wavelength, SCENE["A"], largest)
    np.testing.assert_allclose(found, exact, rtol=3e-3)
    assert found[2] == pytest.approx(found[3], rel=1e-14)  # it saturates, where the printed one does not
    printed = effective.dissipated_energy(k, material, wavelength, SCENE["A"], largest[:3])
    assert printed[2] > 2 * printed[0] > 2 * found[2]
    smooth = effective.first_part(k, material, 0.01, 0.0)
    assert short_waves.dissipated_energy(k, material, 0.01, 0.0, math.inf) == smooth
    # int W d(u^(2/n)) over 2001 points of u = t^2, Simpson
    t, power = np.linspace(0.0, 1.0, 2001), 8 / (1 + k)
    values = power * t ** (power - 1) * short_waves.share(t * t)
    expected = (values[0] + values[-1] + 4 * values[1::2].sum() + 2 * values[2:-1:2].sum()) / 6000
    assert short_waves.saturated_share(k) == pytest.approx(expected, abs=1e-9)
