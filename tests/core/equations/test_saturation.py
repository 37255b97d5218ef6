"""Where folds end and what is lost up to there, against the exact curve and the exact energy."""

import math

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.equations import energy, envelopes, jkr, saturation
from gradhesion.core.problem.material import stiffness

SCENE = {"nu": 0.3, "modulus": 300.0, "c0_over_R": 0.01, "A": 0.03}


@pytest.mark.parametrize(
    ("k", "wavelength", "error"), [(0.0, 0.01, 0.003), (0.2, 0.01, 0.006), (0.5, 0.01, 0.017), (0.2, 0.001, 0.0008)]
)
def test_last_fold(k: float, wavelength: float, error: float) -> None:
    end = float(saturation.end_of_folds(k, wavelength, SCENE["A"]))
    a = np.arange(0.8 * end, 1.2 * end, wavelength / 100)
    material = stiffness(k, SCENE["nu"], SCENE["modulus"], SCENE["c0_over_R"])
    stable = jkr.fold_number(k, material, a, wavelength, SCENE["A"]) > 0.5 * (1 - k)
    last = a[np.flatnonzero(stable[1:] != stable[:-1])[-1]]
    assert 0.0 < last / end - 1 < error


@pytest.mark.parametrize("u", [0.0, 0.03, 0.4, 0.95])
def test_share_of_a_sampled_wave(u: float) -> None:
    theta = np.linspace(0.0, 40 * math.pi, 400_001)
    curve = np.sin(theta) + u * theta
    distance = np.maximum.accumulate(curve) - np.minimum.accumulate(curve[::-1])[::-1]
    # one wave from the middle; 10,000 steps of h a quarter wave: h^2
    middle = slice(200_000, 220_000)
    assert saturation.share(u) == pytest.approx(distance[middle].mean() / 2, abs=1e-6)


def test_share_falls_from_one_to_nothing() -> None:
    u = np.linspace(0.0, 1.0, 101)
    values = saturation.share(u)
    assert values[0] == pytest.approx(1.0, abs=1e-15)
    assert (np.diff(values) < 0.0).all()
    assert (saturation.share([1.0, 1.5, math.inf]) == 0.0).all()
    assert (1 - saturation.share(1e-7)) / 1e-7 == pytest.approx(math.pi, rel=1e-3)
    assert np.isnan(saturation.share([-0.1, math.nan])).all()


@pytest.mark.parametrize("k", [0.0, 0.2, 0.5])
@pytest.mark.parametrize("reach", [0.5, 0.8, 1.3, math.inf])
def test_energy_of_short_waves(k: float, reach: float) -> None:
    # the error falls as the wavelength, and more slowly where waves end near the jump-in
    wavelength = 5e-4 if k == 0.0 else 1e-4  # 350,000 to 30,000 waves
    largest = reach * float(saturation.end_of_folds(k, wavelength, SCENE["A"]))
    material = stiffness(k, SCENE["nu"], SCENE["modulus"], SCENE["c0_over_R"])
    exact = float(solve({"k": k, "lambda_over_R": wavelength, "a_max_over_R": largest} | SCENE)["dissipated_energy"])
    found = saturation.dissipated_energy(k, material, wavelength, SCENE["A"], largest)
    assert found == pytest.approx(exact, rel=3e-3)


def test_energy_saturates_where_the_printed_one_does_not() -> None:
    material, wavelength = 1009.0, 1e-4
    end = saturation.end_of_folds(0.2, wavelength, 0.03)
    beyond = saturation.dissipated_energy(0.2, material, wavelength, 0.03, [end, 3 * end, math.inf])
    np.testing.assert_allclose(beyond, beyond[0], rtol=1e-14)
    printed = energy.dissipated_energy(0.2, material, wavelength, 0.03, [end, 3 * end])
    assert printed[1] > 8 * printed[0] > 100 * beyond[0]


@pytest.mark.parametrize(("k", "error"), [(0.0, 1e-3), (0.2, 1e-3)])
def test_saturated_share_is_the_energy_of_an_unbounded_punch(k: float, error: float) -> None:
    wavelength = 5e-4 if k == 0.0 else 1e-4  # 350,000 and 510,000 waves
    material = stiffness(k, SCENE["nu"], SCENE["modulus"], SCENE["c0_over_R"])
    exact = float(solve({"k": k, "lambda_over_R": wavelength, "a_max_over_R": math.inf} | SCENE)["dissipated_energy"])
    area = saturation.end_of_folds(k, wavelength, SCENE["A"]) ** 2 * saturation.saturated_share(k)
    ratio = envelopes.waviness_strength(k, wavelength, SCENE["A"]) / envelopes.adhesion_strength(k, material)
    first = energy.first_part(k, material, wavelength, SCENE["A"])
    # a_2 is 1/250 of a_e at most, and W is 1 there
    assert first + 4 * math.pi * ratio * area == pytest.approx(exact, rel=error)


@pytest.mark.parametrize("k", [0.0, 0.5, 1.0])
def test_saturated_share_by_parts(k: float) -> None:
    # int W d(u^(2/n)) over 2001 points of u = t^2, Simpson
    t = np.linspace(0.0, 1.0, 2001)
    power = 8 / (1 + k)
    values = power * t ** (power - 1) * saturation.share(t * t)
    expected = (values[0] + values[-1] + 4 * values[1::2].sum() + 2 * values[2:-1:2].sum()) / 6000
    assert saturation.saturated_share(k) == pytest.approx(expected, abs=1e-9)


def test_without_waviness_the_first_part_is_all() -> None:
    assert saturation.dissipated_energy(0.3, 90.0, 0.01, 0.0, math.inf) == energy.first_part(0.3, 90.0, 0.01, 0.0)


def test_outside_the_ranges() -> None:
    assert np.isnan(saturation.end_of_folds([-0.1, 0.3, 0.3], [0.1, 0.0, 0.1], [0.1, 0.1, -0.1])).all()
    assert np.isnan(
        saturation.dissipated_energy(0.3, [0.0, 90.0, 90.0], 0.01, [0.01, 0.01, 5.0], [1.0, 1e-3, 1.0])
    ).all()
    assert np.isnan(saturation.saturated_share([-0.1, 1.1])).all()
    assert saturation.dissipated_energy(np.full((2, 1), 0.3), 90.0, 0.01, 0.01, np.ones(3)).shape == (2, 3)
