"""The energy of the effective path: the loop integral of its load over depth, the solver, and the numbers of the paper."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from gradhesion.core import solve
from gradhesion.core.equations import effective, energy, envelopes
from gradhesion.core.problem.material import stiffness

EPS = float(np.finfo(float).eps)
WAVELENGTH = 0.01
EXPONENTS = [0.0, 0.2, 0.53, 0.9, 1.0]


def _amplitude(k: float, M: float, ratio: float) -> float:
    return ratio * float(envelopes.adhesion_strength(k, M) / envelopes.waviness_strength(k, WAVELENGTH, 1.0))


def _work(k: float, M: float, pull: float, first: float, last: float) -> float:
    """Integrate P d(delta) along an envelope, a = t^4 to soften the branch point at 0."""

    def integrand(t: float) -> float:
        a, step = t**4, 4 * t**3
        slope = 2 * a / (1 + k) - 0.5 * (1 - k) * pull * a ** (-0.5 * (1 + k))
        return 1.5 * math.pi * float(envelopes.load(k, M, a, pull)) * slope * step

    return float(quad(integrand, first**0.25, last**0.25, epsabs=0.0, epsrel=1e-12)[0])


def _loop(k: float, M: float, ratio: float, largest: float) -> float:
    s, r = float(envelopes.adhesion_strength(k, M)), 0.0
    r = ratio * s
    top, bottom = envelopes.indentation(k, largest, np.array([s - r, s + r]))
    line = quad(lambda d: 1.5 * math.pi * float(effective.early_unloading_load(k, M, largest, d)), bottom, top)[0]
    up, down = effective.jump_in_radius(k, s, r), effective.jump_out_radius(k, s, r)
    return _work(k, M, s - r, float(up), largest) - float(line) - _work(k, M, s + r, float(down), largest)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("ratio", [0.03, 0.7])
def test_energy_is_the_loop_integral(k: float, ratio: float) -> None:
    M = 90.0
    amplitude = _amplitude(k, M, ratio)
    s = float(envelopes.adhesion_strength(k, M))
    start = float(effective.jump_in_radius(k, s, ratio * s))
    first = energy.first_part(k, M, WAVELENGTH, amplitude)
    assert first == pytest.approx(_loop(k, M, ratio, start), rel=1e-10)
    for largest in (1.3 * start, 4.0 * start):
        total = energy.dissipated_energy(k, M, WAVELENGTH, amplitude, largest)
        assert total == pytest.approx(_loop(k, M, ratio, largest), rel=1e-10)
        assert total - first == pytest.approx(4 * math.pi * ratio * (largest**2 - start**2), rel=1e-12)


@pytest.mark.parametrize("k", [0.0, 0.41, 0.9])
def test_energy_is_that_of_the_envelope_solver(k: float) -> None:
    scene = {
        "k": k,
        "nu": 0.3,
        "modulus": 300.0,
        "c0_over_R": 0.2,
        "lambda_over_R": 0.02,
        "A": 0.004,
        "a_max_over_R": 0.9,
    }
    M = stiffness(k, 0.3, 300.0, 0.2)
    expected = solve(scene, solver="envelope")["dissipated_energy"]
    assert energy.dissipated_energy(k, M, 0.02, 0.004, 0.9) == pytest.approx(expected, rel=40 * EPS)


def test_coefficients_of_the_paper() -> None:
    k = [0.0, 0.2, 0.5, 0.9]
    np.testing.assert_allclose(energy.smooth_coefficient(k), [7.092, 8.863, 11.317, 14.188], atol=5e-4)
    np.testing.assert_allclose(energy.waviness_coefficient(k), [29.629, 25.241, 19.465, 13.692], atol=5e-4)


@pytest.mark.parametrize("k", [0.0, 0.2, 0.5, 0.9, 1.0])
def test_coefficients_are_the_expansion_of_the_first_part(k: float) -> None:
    M = 90.0
    length = M ** (-1 / (3 + k))
    assert energy.first_part(k, M, WAVELENGTH, 0.0) == pytest.approx(
        energy.smooth_coefficient(k) * length**2, rel=40 * EPS
    )
    step = _amplitude(k, M, 1e-4)
    one, two = energy.first_part(k, M, WAVELENGTH, [step, 2 * step]) - energy.first_part(k, M, WAVELENGTH, 0.0)
    slope = (4 * one - two) / (2 * step)  # second-order forward difference
    expected = energy.waviness_coefficient(k) * WAVELENGTH ** (0.5 * (1 + k)) * length ** (0.5 * (1 - k))
    assert slope == pytest.approx(expected, rel=1e-6)


def test_fits_of_the_paper() -> None:
    k = np.linspace(0.0, 1.0, 101)
    first = energy.fitted_smooth_coefficient(k) / energy.smooth_coefficient(k) - 1
    second = energy.fitted_waviness_coefficient(k) / energy.waviness_coefficient(k) - 1
    assert 0.0032 < np.abs(first).max() < 0.0034
    assert 0.0052 < np.abs(second).max() < 0.0054


@pytest.mark.parametrize("k", [0.0, 0.5, 0.9])
@pytest.mark.parametrize(("ratio", "low", "high"), [(0.01, 0.0, 0.002), (0.1, 0.009, 0.015), (0.5, 0.14, 0.2)])
def test_fitted_energy_is_good_for_weak_waviness(k: float, ratio: float, low: float, high: float) -> None:
    M = 90.0
    amplitude = _amplitude(k, M, ratio)
    s = float(envelopes.adhesion_strength(k, M))
    largest = 2 * effective.jump_in_radius(k, s, ratio * s)
    fitted = energy.fitted_energy(k, M, WAVELENGTH, amplitude, largest)
    assert low < abs(fitted / energy.dissipated_energy(k, M, WAVELENGTH, amplitude, largest) - 1) < high


def test_outside_the_ranges() -> None:
    strong = _amplitude(0.3, 90.0, 1.01)
    for function in (energy.second_part, energy.dissipated_energy, energy.fitted_energy):
        assert np.isnan(
            function(0.3, [90.0, 90.0, 0.0, 90.0], WAVELENGTH, [strong, 0.001, 0.001, -1.0], [0.9, 1e-3, 0.9, 0.9])
        ).all()
    assert np.isnan(energy.first_part([-0.1, 1.1], 90.0, WAVELENGTH, 0.0)).all()
    assert np.isnan(energy.smooth_coefficient(1.1))
    assert np.isnan(energy.fitted_waviness_coefficient(-0.1))
