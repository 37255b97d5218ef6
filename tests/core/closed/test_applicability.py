"""The numbers that say where the model applies: their closed forms, their limits and their scaling laws."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import VALIDITY, solve, validity
from gradhesion.core.problem.profile import Harmonic, Profile

EPS = np.finfo(float).eps
SCENE: dict[str, Any] = {
    "k": 0.37,
    "nu": 0.27,
    "modulus": 430.0,
    "c0_over_R": 0.013,
    "lambda_over_R": 0.17,
    "A": 0.041,
    "a_max_over_R": 1.3,
    "adhesion_range_over_R": 1.7e-4,
}


def test_homogeneous_numbers_are_those_of_the_literature() -> None:
    """Tabor (1977) and Johnson (1995), in SI units with R = 1.7 um."""
    R, E, work, z0, wavelength, height = 1.7e-6, 3.1e9, 0.043, 0.27e-9, 0.21e-6, 1.9e-9
    scene = {"k": 0.0, "nu": 0.3, "modulus": E * R / work, "c0_over_R": 1.0, "lambda_over_R": wavelength / R}
    scene |= {"A": height / wavelength, "a_max_over_R": np.inf, "adhesion_range_over_R": z0 / R}
    found = validity(scene)
    assert found["tabor_parameter"] == pytest.approx((R * work**2 / E**2) ** (1 / 3) / z0, rel=20 * EPS)
    crest = wavelength**2 / (4 * math.pi**2 * height)
    assert found["wave_tabor_parameter"] == pytest.approx((crest * work**2 / E**2) ** (1 / 3) / z0, rel=20 * EPS)
    assert found["wave_slope"] == pytest.approx(2 * math.pi * height / wavelength, rel=8 * EPS)
    alpha = math.sqrt(2 * wavelength * work / (math.pi**2 * E * height**2))
    assert found["johnson_alpha"] == pytest.approx(alpha, rel=20 * EPS)


@pytest.mark.parametrize("k", [0.0, 0.31, 0.9, 1.0])
def test_alpha_is_that_of_the_roughness_parameter(k: float) -> None:
    scene = SCENE | {"k": k, "nu": 0.5}
    chi = solve({name: scene[name] for name in scene if "range" not in name}, ["roughness_parameter"])
    found = validity(scene, ["johnson_alpha"])["johnson_alpha"]
    assert found * chi["roughness_parameter"] * math.sqrt(math.pi) == pytest.approx(1.0, rel=100 * EPS)


@pytest.mark.slow
def test_alpha_of_a_series_too() -> None:
    profile = Profile(exponent=1.7, harmonics=(Harmonic(n=2, cos=0.7, sin=-0.4), Harmonic(n=5, sin=0.3)))
    scene = {name: value for name, value in SCENE.items() if "range" not in name}
    chi = solve(scene, ["roughness_parameter"], profile=profile)["roughness_parameter"]
    found = validity(scene, ["johnson_alpha"], profile)["johnson_alpha"]
    assert found * chi * math.sqrt(math.pi) == pytest.approx(1.0, rel=100 * EPS)


def test_slope_and_crest_of_a_series_are_the_extremes_of_its_derivatives() -> None:
    waves = (Harmonic(n=1, cos=1.0), Harmonic(n=3, cos=-0.21, sin=0.35), Harmonic(n=7, sin=-0.06))
    x = np.linspace(0.0, 1.0, 400_001)
    slope = sum(
        2 * np.pi * w.n * (w.cos * np.sin(2 * np.pi * w.n * x) + w.sin * np.cos(2 * np.pi * w.n * x)) for w in waves
    )
    bend = sum(
        (2 * np.pi * w.n) ** 2 * (w.cos * np.cos(2 * np.pi * w.n * x) - w.sin * np.sin(2 * np.pi * w.n * x))
        for w in waves
    )
    found = validity(SCENE, profile=Profile(harmonics=waves))
    near = (2 * np.pi * 7 / 800_000) ** 2  # how far a maximum is from the nearest sample, squared
    assert found["wave_slope"] == pytest.approx(SCENE["A"] * np.abs(slope).max(), rel=near)
    sharper = bend.max() / (4 * np.pi**2)
    one = validity(SCENE | {"A": SCENE["A"] * sharper}, ["wave_tabor_parameter"])["wave_tabor_parameter"]
    assert found["wave_tabor_parameter"] == pytest.approx(one, rel=near)


def test_a_wave_n_times_shorter_is_a_harmonic() -> None:
    one = validity(SCENE | {"lambda_over_R": SCENE["lambda_over_R"] / 3, "A": 3 * SCENE["A"]})
    other = validity(SCENE, profile=Profile(harmonics=(Harmonic(n=3),)))
    for name in VALIDITY:
        assert other[name] == pytest.approx(one[name], rel=50 * EPS), name


def test_similar_scenes_have_the_same_tabor_parameters() -> None:
    """With all lengths in L, z0 R/L^2 stays."""
    k = SCENE["k"]
    factor = 2.3  # of L/R, so that M changes by its power -(3+k)
    scale = factor ** -(3.0 + k)
    other = SCENE | {
        "modulus": SCENE["modulus"] * scale,
        "adhesion_range_over_R": SCENE["adhesion_range_over_R"] * factor**2,
    }
    other |= {"lambda_over_R": SCENE["lambda_over_R"] * factor, "A": SCENE["A"] * factor}
    one, two = validity(SCENE), validity(other)
    for name in ("tabor_parameter", "wave_tabor_parameter", "johnson_alpha"):
        assert two[name] == pytest.approx(one[name], rel=50 * EPS), name


@pytest.mark.parametrize("m", [1.0, 1.5, 2.0, 4.0])
def test_the_neck_of_any_power_is_as_high_as_adhesion_draws_it(m: float) -> None:
    """At L the stretch Delta = sqrt(dgamma L^(1-k)/M) is the height L^m of the neck."""
    from gradhesion.core.problem.material import stiffness

    k = SCENE["k"]
    M = float(stiffness(k, SCENE["nu"], SCENE["modulus"], SCENE["c0_over_R"]))
    height = float(validity(SCENE, profile=Profile(exponent=m))["tabor_parameter"]) * SCENE["adhesion_range_over_R"]
    assert height == pytest.approx(math.sqrt(height ** ((1 - k) / m) / M), rel=50 * EPS)


def test_a_smooth_punch_has_no_waves() -> None:
    found = validity(SCENE | {"A": 0.0})
    assert found["wave_slope"] == 0.0
    assert np.isnan(found["wave_tabor_parameter"])
    assert found["johnson_alpha"] == np.inf
    flat = validity(SCENE, profile=Profile(harmonics=(Harmonic(n=1, cos=0.0),)))
    assert (flat["wave_slope"], flat["johnson_alpha"]) == (0.0, np.inf)
    assert np.isnan(flat["wave_tabor_parameter"])


@pytest.mark.parametrize(
    "change",
    [
        {"k": -0.1},
        {"k": 1.1},
        {"k": 1.0},
        {"nu": 0.6},
        {"modulus": 0.0},
        {"lambda_over_R": -1.0},
        {"A": -0.1},
        {"A": np.nan},
        {"a_max_over_R": 0.0},
    ],
    ids=str,
)
def test_out_of_range_is_nan(change: dict[str, float]) -> None:
    assert all(np.isnan(values) for values in validity(SCENE | change).values())


@pytest.mark.parametrize("z0", [0.0, -1.0, np.inf, np.nan])
def test_a_range_out_of_range_is_nan_in_the_tabor_parameters_alone(z0: float) -> None:
    found = validity(SCENE | {"adhesion_range_over_R": z0})
    assert {name: bool(np.isnan(value)) for name, value in found.items()} == {
        name: "tabor" in name for name in VALIDITY
    }


def test_arrays_broadcast_and_what_is_unknown_is_refused() -> None:
    found = validity(SCENE | {"k": np.array([0.0, 0.3])[:, None], "A": np.array([0.0, 0.1, 0.2])})
    assert {values.shape for values in found.values()} == {(2, 3)}
    assert "tabor_parameter" not in validity({name: SCENE[name] for name in SCENE if "range" not in name}, VALIDITY[2:])
    with pytest.raises(ValueError, match="adhesion_range_over_R"):
        validity({name: SCENE[name] for name in SCENE if "range" not in name})
    with pytest.raises(ValueError, match="slope"):
        validity(SCENE, ["slope"])
