"""The envelopes against the curve that they hold: short_waves.py, of which they are the bounds."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from gradhesion.core import solve
from gradhesion.core.equations import envelopes, jkr, short_waves
from gradhesion.core.problem.material import stiffness

EPS = float(np.finfo(float).eps)
M, WAVELENGTH, AMPLITUDE = 150.0, 0.003, 0.02


def _pulls(k: float) -> tuple[float, float]:
    s, r = envelopes.adhesion_strength(k, M), envelopes.waviness_strength(k, WAVELENGTH, AMPLITUDE)
    return float(s - r), float(s + r)


@pytest.mark.parametrize("k", [0.0, 0.41, 1.0])
def test_they_bound_the_leading_term_and_touch_it(k: float) -> None:
    a = 0.5 + WAVELENGTH * np.linspace(0.0, 1.0, 2001)
    mean = WAVELENGTH * AMPLITUDE
    depth = short_waves.indentation(k, M, a, WAVELENGTH, [-AMPLITUDE])
    load = short_waves.load(k, M, a, WAVELENGTH, [-AMPLITUDE])
    swing = np.ptp(depth)
    for sign, pull in zip((1.0, -1.0), _pulls(k), strict=True):
        space = sign * (envelopes.indentation(k, a, pull, mean) - depth)
        assert space.min() >= -40 * EPS
        assert space.min() <= 1e-5 * swing  # (step of phase)^2/8
        space = sign * (envelopes.load(k, M, a, pull) - load)
        assert space.min() >= -400 * EPS * M
        assert space.min() <= 1e-5 * np.ptp(load)


@pytest.mark.parametrize("k", [0.0, 0.41, 1.0])
def test_strength_of_adhesion_is_the_adhesive_depth_at_unit_radius(k: float) -> None:
    assert envelopes.adhesion_strength(k, M) == pytest.approx(jkr.adhesive_depth(k, M, 1.0), rel=4 * EPS)


@pytest.mark.parametrize("k", [0.0, 0.41, 1.0])
def test_pull_off_of_the_unloading_envelope(k: float) -> None:
    loading, unloading = _pulls(k)
    s = 0.5 * (loading + unloading)
    low = minimize_scalar(
        lambda a: float(envelopes.load(k, M, a, unloading)), bounds=(0.02, 2.0), options={"xatol": 1e-10}
    )
    assert -low.fun == pytest.approx(envelopes.pull_off_force(k, unloading / s - 1), rel=1e-12)


@pytest.mark.parametrize("k", [0.0, 0.41, 0.9])
def test_exact_force_tends_to_that_of_the_envelope(k: float) -> None:
    material = float(stiffness(k, 0.3, 300.0, 0.2))
    ratio, errors = 0.4, []
    for wavelength in (1e-2, 1e-3, 1e-4):
        unit = float(envelopes.waviness_strength(k, wavelength, 1.0))
        amplitude = ratio * float(envelopes.adhesion_strength(k, material)) / unit
        scene = {"k": k, "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.2, "lambda_over_R": wavelength, "A": amplitude}
        force = float(solve(scene | {"a_max_over_R": math.inf}, ["pull_off_force"])["pull_off_force"])
        errors.append(abs(float(envelopes.pull_off_force(k, ratio)) / force - 1))
    # second order in the wavelength, and where the wave next to the lowest point stands is chance
    assert (np.array(errors) < 10.0 * np.array([1e-4, 1e-6, 1e-8])).all()


def test_one_wave_as_a_series() -> None:
    k = np.array([0.0, 0.3, 0.7, 1.0])
    for wave in ([-AMPLITUDE], [AMPLITUDE]):
        for strength in envelopes.series_strengths(k, WAVELENGTH, wave):
            np.testing.assert_allclose(strength, envelopes.waviness_strength(k, WAVELENGTH, AMPLITUDE), rtol=1e-15 * 8)


@pytest.mark.parametrize("k", [0.0, 0.6, 1.0])
def test_series_are_bounded_and_touched(k: float) -> None:
    cosines, sines = [-0.02, 0.004], [0.006, 0.0, -0.001]
    loading, unloading = envelopes.series_strengths(k, WAVELENGTH, cosines, sines)
    xi = np.linspace(0.0, 1.0, 100_001)
    size = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (1 + k)) * WAVELENGTH ** (0.5 * (1 + k))
    values = size * short_waves.zeta(k, xi, cosines, sines)
    assert loading == pytest.approx(values.max(), rel=1e-8)
    assert unloading == pytest.approx(-values.min(), rel=1e-8)
    assert abs(loading - unloading) > 1e-3 * loading


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_extrema_of_zeta_are_true(k: float) -> None:
    rng = np.random.default_rng(5)
    for count in (1, 2, 5, 17, 64):
        cosines, sines = rng.normal(size=(2, count)) / np.arange(1, count + 1)
        lowest, highest = envelopes.zeta_extrema(k, cosines.tolist(), sines.tolist())
        for sign, extreme in ((1.0, highest), (-1.0, -lowest)):
            xi = np.linspace(0.0, 1.0, 2000 * count + 1)
            values = sign * short_waves.zeta(k, xi, cosines.tolist(), sines.tolist())
            best = xi[np.argmax(values)]
            polished = minimize_scalar(
                lambda t, sign=sign, cosines=cosines, sines=sines: (
                    -sign * float(short_waves.zeta(k, t, cosines.tolist(), sines.tolist()))
                ),
                bounds=(best - 1e-3 / count, best + 1e-3 / count),
                method="bounded",
                options={"xatol": 1e-12},
            )
            size = np.sum(np.hypot(cosines, sines) * (2 * math.pi * np.arange(1, count + 1)) ** (0.5 * (1 - k)))
            assert extreme == pytest.approx(-polished.fun, abs=50 * EPS * size)


@pytest.mark.parametrize("k", [0.0, 0.41, 1.0])
@pytest.mark.parametrize("m", [1.0, 1.5, 2.0, 4.0, 6.5])
def test_envelopes_of_any_power(k: float, m: float) -> None:
    loading, unloading = _pulls(k)
    radius, force = envelopes.power_pull_off(k, M, unloading, m)
    low = minimize_scalar(
        lambda a: float(envelopes.load(k, M, a, unloading, m)),
        bounds=(0.5 * float(radius), 2.0 * float(radius)),
        method="bounded",
        options={"xatol": 1e-12},
    )
    assert -low.fun == pytest.approx(float(force), rel=1e-12)
    touch, _ = envelopes.power_radii(k, loading, m)
    assert abs(float(envelopes.indentation(k, touch, loading, 0.0, m))) <= 20 * EPS * loading
    _, fold = envelopes.power_radii(k, unloading, m)
    if k < 1.0:
        near = envelopes.indentation(k, float(fold) * np.array([1 - 1e-4, 1.0, 1 + 1e-4]), unloading, 0.0, m)
        assert near[1] < min(near[0], near[2])
    else:
        assert fold == 0.0


def test_exact_force_of_other_powers_and_series_tends_to_the_envelope() -> None:
    from gradhesion.core import Harmonic, Profile

    k, m, wavelength = 0.3, 3.0, 1e-3
    material = float(stiffness(k, 0.3, 300.0, 0.2))
    profile = Profile(exponent=m, harmonics=(Harmonic(n=1, cos=0.7, sin=0.2), Harmonic(n=3, cos=-0.1, sin=0.05)))
    amplitude = 0.02
    cosines, sines = [-0.7 * amplitude, 0.0, 0.1 * amplitude], [0.2 * amplitude, 0.0, 0.05 * amplitude]
    _, r = envelopes.series_strengths(k, wavelength, cosines, sines)
    _, force = envelopes.power_pull_off(k, material, envelopes.adhesion_strength(k, material) + r, m)
    scene = {"k": k, "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.2, "lambda_over_R": wavelength, "A": amplitude}
    exact = solve(scene | {"a_max_over_R": math.inf}, ["pull_off_force"], profile=profile)["pull_off_force"]
    assert float(exact) == pytest.approx(float(force), rel=1e-3)  # of the order of the wavelength over the radius


def test_outside_the_ranges() -> None:
    assert np.isnan(envelopes.adhesion_strength([-0.1, 0.3, 0.3], [1.0, 0.0, math.nan])).all()
    assert np.isnan(envelopes.waviness_strength([1.1, 0.3, 0.3], [0.1, 0.0, 0.1], [0.1, 0.1, -0.1])).all()
    assert np.isnan(envelopes.pull_off_force(0.3, -0.1))
    assert np.isnan(envelopes.indentation(0.3, -0.1, 0.1))
    assert np.isnan(envelopes.load(0.3, 0.0, 0.1, 0.1))


def test_kesari_and_lew() -> None:
    # Kesari & Lew (2011), homogeneous: the swing of depth is pi A sqrt(lambda a), of load 2 E* a times that
    a, M, length, amplitude = np.linspace(0.05, 0.8, 9), 150.0, 0.003, 0.03
    s, r = envelopes.adhesion_strength(0.0, M), envelopes.waviness_strength(0.0, length, amplitude)
    for sign in (1.0, -1.0):
        swing = sign * math.pi * amplitude * np.sqrt(length * a)
        depth = a**2 - np.sqrt(2 * math.pi * a / M) + swing
        np.testing.assert_allclose(envelopes.indentation(0.0, a, s - sign * r), depth, atol=1e-15)
        load = 4 * M * a**3 / 3 - np.sqrt(8 * math.pi * M * a**3) + 2 * M * a * swing
        found = 1.5 * math.pi * envelopes.load(0.0, M, a, s - sign * r)
        np.testing.assert_allclose(found, load, atol=1e-13 * np.abs(load).max())
