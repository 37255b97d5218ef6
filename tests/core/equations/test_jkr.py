"""Contact with adhesion: the energy release rate from the elastic energy, equilibrium, folds, and the exact solver."""

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize_scalar
from scipy.special import struve

from gradhesion.core import solve
from gradhesion.core.equations import hertz, jkr
from gradhesion.core.problem.material import stiffness

WAVE = (0.13, 0.017)
M = 210.0


@pytest.mark.parametrize("k", [0.0, 0.43, 1.0])
@pytest.mark.parametrize("a", [0.06, 0.31])
def test_energy_release_rate_is_what_the_elastic_energy_loses(k: float, a: float) -> None:
    # U(a, delta) = U(a, delta_H) + int P d(delta), and U(a, delta_H) does not depend on a to first order: at fixed
    # delta, dU/da = int_{delta_H}^{delta} dP/da d(delta) = 2 pi a G
    top = float(hertz.indentation(k, a, *WAVE))
    depth = top - 0.7 * float(jkr.adhesive_depth(k, M, a))
    step = 1e-5 * a

    def load_rate(d: float) -> float:
        ahead, behind = (float(jkr.load_at_depth(k, M, a + h, d, *WAVE)) for h in (step, -step))
        return 1.5 * math.pi * (ahead - behind) / (2 * step)

    rate, _ = quad(load_rate, top, depth)
    # the central difference: (step/wave)^2 relative
    assert jkr.energy_release_rate(k, M, a, depth, *WAVE) == pytest.approx(rate / (2 * math.pi * a), rel=1e-6)
    assert jkr.energy_release_rate(k, M, a, depth, *WAVE) == pytest.approx(0.49, rel=1e-12)


@pytest.mark.parametrize("k", [0.0, 0.2, 0.5, 0.9, 1.0])
def test_adhesive_depth_is_the_printed_root(k: float) -> None:
    exact = mpmath.sqrt(2 ** (1 + mpmath.mpf(k)) * mpmath.pi * mpmath.mpf("0.3") ** (1 - k) / M)
    assert jkr.adhesive_depth(k, M, 0.3) == pytest.approx(float(exact), rel=1e-15)


@pytest.mark.parametrize("k", [0.0, 0.43, 0.9])
@pytest.mark.parametrize("a", [0.06, 0.31])
def test_the_printed_struve_functions(k: float, a: float) -> None:
    # (5.8)-(5.11) term by term, R = dgamma = 1
    wavelength, amplitude = (mpmath.mpf(one) for one in WAVE)
    k_, a_, stiff = mpmath.mpf(k), mpmath.mpf(a), mpmath.mpf(M)
    n, pi = (1 + k_) / 2, mpmath.pi
    first, second = (mpmath.struveh(k_ / 2 + j, 2 * pi * a_ / wavelength) for j in (0, 1))
    smooth = a_**2 / (1 + k_) - mpmath.sqrt(2 ** (1 + k_) * pi * a_ ** (1 - k_) / stiff)
    wave = wavelength * amplitude * mpmath.sqrt(pi) * mpmath.gamma(n) * (pi * a_ / wavelength) ** (1 - k_ / 2) * first
    assert jkr.indentation(k, M, a, *WAVE) == pytest.approx(float(smooth + wave), rel=1e-13)
    load = 2 ** (2 - k_) * stiff * a_ ** (3 + k_) / ((1 + k_) ** 2 * (3 + k_))
    load -= mpmath.sqrt(2 ** (3 - k_) * pi * stiff * a_ ** (3 + k_)) / (1 + k_)
    front = (2 * mpmath.sqrt(pi)) ** (1 - k_) * stiff / (1 + k_) * amplitude * (wavelength * a_) ** (k_ / 2)
    load += front * (pi * a_**2 * mpmath.gamma(n) * first - wavelength * a_ * mpmath.gamma(n + 1) * second)
    assert 1.5 * math.pi * jkr.load(k, M, a, *WAVE) == pytest.approx(float(load), rel=1e-12)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_load_in_equilibrium_is_the_load_at_that_depth(k: float) -> None:
    a = np.linspace(0.01, 0.8, 60)
    depth = jkr.indentation(k, M, a, *WAVE)
    np.testing.assert_allclose(
        jkr.load(k, M, a, *WAVE), jkr.load_at_depth(k, M, a, depth, *WAVE), rtol=1e-11, atol=1e-12
    )


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_fold_number_tells_where_depth_and_load_rise(k: float) -> None:
    a, step = np.linspace(0.01, 0.8, 700), 1e-6
    number = jkr.fold_number(k, M, a, *WAVE)
    stretch = jkr.adhesive_depth(k, M, a)
    for function, level, scale in (
        (jkr.indentation, 0.5 * (1 - k), 1.0),
        (jkr.load, 0.5 * (3 + k), hertz.disc_stiffness(k, M, a)),
    ):
        slope = (function(k, M, a + step, *WAVE) - function(k, M, a - step, *WAVE)) / (2 * step)
        # d/da = scale Delta/a (q - level)
        np.testing.assert_allclose(slope / scale, stretch / a * (number - level), atol=2e-5)
        assert ((number > level)[:-1] != (number > level)[1:]).any()


def test_guduru() -> None:
    # Guduru (2007), homogeneous: delta = a^2/R + pi^2 A a H0 - sqrt(2 pi a dgamma/E*) and
    # P = 4 E* a^3/(3R) + pi E* A a (2 pi a H0 - lambda H1) - sqrt(8 pi E* dgamma a^3), of 2 pi a/lambda
    a, (length, amplitude) = np.linspace(0.01, 0.8, 30), WAVE
    first, second = (struve(order, 2 * math.pi * a / length) for order in (0, 1))
    depth = a**2 + math.pi**2 * amplitude * a * first - np.sqrt(2 * math.pi * a / M)
    np.testing.assert_allclose(jkr.indentation(0.0, M, a, *WAVE), depth, atol=1e-14)
    load = 4 * M * a**3 / 3 + math.pi * M * amplitude * a * (2 * math.pi * a * first - length * second)
    load -= np.sqrt(8 * math.pi * M * a**3)
    np.testing.assert_allclose(1.5 * math.pi * jkr.load(0.0, M, a, *WAVE), load, atol=1e-12 * np.abs(load).max())


@pytest.mark.parametrize("k", [0.0, 0.3, 0.6, 1.0])
def test_lowest_load_of_the_smooth_punch(k: float) -> None:
    low = minimize_scalar(lambda a: float(jkr.load(k, M, a, 0.1, 0.0)), bounds=(0.01, 1.0), options={"xatol": 1e-10})
    assert low.fun == pytest.approx(-(3 + k) / 3, rel=1e-13)


@pytest.mark.parametrize("k", [0.0, 0.31, 0.8])
def test_lowest_load_is_the_force_of_the_solver(k: float) -> None:
    scene = {
        "k": k,
        "nu": 0.27,
        "modulus": 400.0,
        "c0_over_R": 0.2,
        "lambda_over_R": 0.09,
        "A": 0.02,
        "a_max_over_R": 0.8,
    }
    material = float(stiffness(k, 0.27, 400.0, 0.2))
    a = np.linspace(1e-3, 0.8, 20001)
    load = jkr.load(k, material, a, 0.09, 0.02)
    i = int(np.argmin(load))
    found = minimize_scalar(
        lambda x: float(jkr.load(k, material, x, 0.09, 0.02)), bounds=(a[i - 1], a[i + 1]), options={"xatol": 1e-11}
    )
    assert solve(scene)["pull_off_force"] == pytest.approx(-found.fun, rel=1e-12)


def test_without_adhesion_it_is_hertz() -> None:
    a = np.linspace(0.0, 0.8, 9)
    assert np.array_equal(jkr.indentation(0.4, math.inf, a, *WAVE), hertz.indentation(0.4, a, *WAVE))


def test_outside_the_ranges() -> None:
    assert np.isnan(jkr.indentation(0.3, [0.0, -1.0, M, M], [0.1, 0.1, -0.1, math.nan], *WAVE)).all()
    assert np.isnan(jkr.fold_number(0.3, M, 0.0, *WAVE))
    assert np.isnan(jkr.energy_release_rate(0.3, M, 0.0, 0.0, *WAVE))
    assert jkr.load(np.full((3, 1), 0.3), M, np.full(2, 0.2), *WAVE).shape == (3, 2)
