"""Where the model applies: its numbers, in closed form and by scaling, and the slope at the largest radius that counts."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import VALIDITY, Loading, Profile, draw_curves, solve, validity
from tests.core.scene import EPS, material_of, profile_of, scene_of

ROUGH = scene_of(0.37, 0.27, 430.0, 0.013, 0.17, 0.041, 1.3)
NUMBERED = ROUGH | {"adhesion_range_over_R": 1.7e-4}
SCENE = scene_of(0.3, 0.3, 30.0, 0.1, 0.2, 0.05, math.inf)
SERIES = profile_of(1.7, (1, 1.0, 0.0), (3, 0.0, 0.2))
ENERGY = ["dissipated_energy", "contact_slope"]
REACHED: list[tuple[dict[str, float], dict[str, Any]]] = [
    ({}, {}),
    ({"k": 1.0, "nu": 0.5}, {}),
    ({"lambda_over_R": 0.07, "modulus": 500.0}, {}),
    ({}, {"profile": SERIES}),
    ({}, {"loading": Loading(control="load")}),
    ({"machine_stiffness": 1.0}, {"loading": Loading(control="machine")}),
]


def test_homogeneous_numbers_are_those_of_the_literature() -> None:
    """Tabor (1977) and Johnson (1995), in SI units with R = 1.7 um."""
    R, E, work, z0, wavelength, height = 1.7e-6, 3.1e9, 0.043, 0.27e-9, 0.21e-6, 1.9e-9
    scene = scene_of(0.0, 0.3, E * R / work, 1.0, wavelength / R, height / wavelength, math.inf)
    found = validity(scene | {"adhesion_range_over_R": z0 / R})
    crest = wavelength**2 / (4 * math.pi**2 * height)
    expected = {
        "tabor_parameter": (R * work**2 / E**2) ** (1 / 3) / z0,
        "wave_tabor_parameter": (crest * work**2 / E**2) ** (1 / 3) / z0,
        "wave_slope": 2 * math.pi * height / wavelength,
        "johnson_alpha": math.sqrt(2 * wavelength * work / (math.pi**2 * E * height**2)),
    }
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=20 * EPS), name


@pytest.mark.parametrize("k", [0.0, 0.31, 0.9, 1.0])
@pytest.mark.parametrize("profile", [Profile(), profile_of(1.7, (2, 0.7, -0.4), (5, 0.0, 0.3))], ids=["one", "series"])
def test_alpha_is_that_of_the_roughness_parameter(k: float, profile: Profile) -> None:
    scene = ROUGH | {"k": k, "nu": 0.5}
    chi = solve(scene, ["roughness_parameter"], profile=profile)["roughness_parameter"]
    found = validity(scene, ["johnson_alpha"], profile)["johnson_alpha"]
    assert found * chi * math.sqrt(math.pi) == pytest.approx(1.0, rel=100 * EPS)


def test_slope_and_crest_of_a_series_are_the_extremes_of_its_derivatives() -> None:
    waves = ((1, 1.0, 0.0), (3, -0.21, 0.35), (7, 0.0, -0.06))
    slope, bend, x = 0.0, 0.0, np.linspace(0.0, 1.0, 400_001)
    for n, even, odd in waves:
        phase = 2 * np.pi * n * x
        slope = slope + 2 * np.pi * n * (even * np.sin(phase) + odd * np.cos(phase))
        bend = bend + (2 * np.pi * n) ** 2 * (even * np.cos(phase) - odd * np.sin(phase))
    found = validity(NUMBERED, profile=profile_of(2.0, *waves))
    near = (2 * np.pi * 7 / 800_000) ** 2  # how far a maximum is from the nearest sample, squared
    assert found["wave_slope"] == pytest.approx(NUMBERED["A"] * np.abs(slope).max(), rel=near)
    sharper = NUMBERED["A"] * np.max(bend) / (4 * np.pi**2)
    one = validity(NUMBERED | {"A": sharper}, ["wave_tabor_parameter"])["wave_tabor_parameter"]
    assert found["wave_tabor_parameter"] == pytest.approx(one, rel=near)


def test_scenes_that_are_the_same_in_other_numbers() -> None:
    """A wave three times shorter is a harmonic; with all lengths in L, z0 R/L^2 stays, where M goes as L^-(3+k)."""
    third = NUMBERED | {"lambda_over_R": NUMBERED["lambda_over_R"] / 3, "A": 3 * NUMBERED["A"]}
    one, harmonic = validity(third), validity(NUMBERED, profile=profile_of(2.0, (3, 1.0, 0.0)))
    for name in VALIDITY:
        assert harmonic[name] == pytest.approx(one[name], rel=50 * EPS), name
    powers = {"modulus": -3.37, "adhesion_range_over_R": 2.0, "lambda_over_R": 1.0, "A": 1.0}
    scaled = {name: NUMBERED[name] * 2.3**power for name, power in powers.items()}
    own, other = validity(NUMBERED), validity(NUMBERED | scaled)
    for name in ("tabor_parameter", "wave_tabor_parameter", "johnson_alpha"):
        assert other[name] == pytest.approx(own[name], rel=50 * EPS), name


@pytest.mark.parametrize("m", [1.0, 1.5, 2.0, 4.0])
def test_the_neck_of_any_power_is_as_high_as_adhesion_draws_it(m: float) -> None:
    """At L the stretch Delta = sqrt(dgamma L^(1-k)/M) is the height L^m of the neck."""
    number = float(validity(NUMBERED, profile=Profile(exponent=m))["tabor_parameter"])
    height = number * NUMBERED["adhesion_range_over_R"]
    assert height == pytest.approx(math.sqrt(height ** ((1 - NUMBERED["k"]) / m) / material_of(NUMBERED)), rel=50 * EPS)


def test_a_smooth_punch_has_no_waves() -> None:
    for found in (validity(NUMBERED | {"A": 0.0}), validity(NUMBERED, profile=profile_of(2.0, (1, 0.0, 0.0)))):
        assert (found["wave_slope"], found["johnson_alpha"]) == (0.0, np.inf)
        assert np.isnan(found["wave_tabor_parameter"])


OUTSIDE: list[tuple[str, float]] = [("k", -0.1), ("k", 1.1), ("k", 1.0), ("nu", 0.6), ("modulus", 0.0), ("A", -0.1)]
OUTSIDE += [("lambda_over_R", -1.0), ("A", math.nan), ("a_max_over_R", 0.0)]
OUTSIDE += [("adhesion_range_over_R", z0) for z0 in (0.0, -1.0, math.inf, math.nan)]


@pytest.mark.parametrize(("name", "value"), OUTSIDE)
def test_out_of_range_is_nan_of_a_range_in_the_tabor_parameters_alone(name: str, value: float) -> None:
    for output, found in validity(NUMBERED | {name: value}).items():
        assert np.isnan(found) == (name != "adhesion_range_over_R" or "tabor" in output), output


def test_arrays_broadcast_and_what_is_unknown_is_refused() -> None:
    found = validity(NUMBERED | {"k": np.array([0.0, 0.3])[:, None], "A": np.array([0.0, 0.1, 0.2])})
    assert {values.shape for values in found.values()} == {(2, 3)}
    assert "tabor_parameter" not in validity(ROUGH, VALIDITY[2:])
    with pytest.raises(ValueError, match="adhesion_range_over_R"):
        validity(ROUGH, VALIDITY)
    with pytest.raises(ValueError, match="slope"):
        validity(NUMBERED, ["slope"])


def slope(scene: dict[str, Any], outputs: list[str], **how: Any) -> Any:
    return solve(scene, [*outputs, "contact_slope"], **how)["contact_slope"]


@pytest.mark.parametrize("modulus", [3.7, 170.0])
def test_the_smooth_sphere_is_that_of_johnson_kendall_and_roberts(modulus: float) -> None:
    ball = scene_of(0.0, 0.3, modulus, 1.0, 1.0, 0.0, math.inf)
    jump_in = (2.0 * math.pi / modulus) ** (1.0 / 3.0)  # zero depth: a^3 = 2 pi R^2 dgamma/E*
    pull_off = (9.0 * math.pi / (8.0 * modulus)) ** (1.0 / 3.0)
    assert slope(ball, ["pull_off_force"]) == pytest.approx(pull_off, rel=1e-14)
    many = ball | {"modulus": np.full(5000, modulus)}  # by the kernels of many smooth scenes
    for scene, solver in ((ball, "exact"), (many, "exact"), (ball, "envelope")):
        np.testing.assert_allclose(slope(scene, ["dissipated_energy"], solver=solver), jump_in, rtol=1e-14)


@pytest.mark.parametrize(("change", "how"), REACHED)
def test_an_unbounded_punch_reaches_where_its_last_jump_ends(change: dict[str, float], how: dict[str, Any]) -> None:
    drawn, _ = draw_curves(SCENE | change, ["jumps"], **how)
    furthest = max(float(drawn[f"jump_radius_{when}"].max()) for when in ("before", "after"))
    found = float(slope(SCENE | change, ["dissipated_energy"], **how))
    assert found == pytest.approx(furthest ** (how.get("profile", Profile()).exponent - 1.0), rel=1e-12)


def test_of_a_long_curve_it_is_next_to_the_last_fold() -> None:
    """And a stiff machine finds the same, whose waves another solver sums."""
    scene = SCENE | {"lambda_over_R": 3e-4, "A": 0.02}
    found = solve(scene, [*ENERGY, "saturation_radius"], check_contact=False)
    assert 0.0 < float(found["contact_slope"]) - float(found["saturation_radius"]) < scene["lambda_over_R"]
    machine: dict[str, Any] = {"loading": Loading(control="machine"), "check_contact": False}
    stiff = slope(scene | {"machine_stiffness": 1e14}, ["dissipated_energy"], **machine)
    assert float(stiff) == pytest.approx(float(found["contact_slope"]), rel=1e-9)


def test_a_rim_or_a_turn_is_what_is_reached() -> None:
    scene = SCENE | {"a_max_over_R": np.array([0.05, 2.0])}
    np.testing.assert_array_equal(slope(scene, ["dissipated_energy"]), [0.05, 2.0])
    np.testing.assert_array_equal(slope(scene, ["delta_max"], profile=SERIES), np.array([0.05, 2.0]) ** 0.7)
    for turn in ({"indentation_max_over_R": 0.4}, {"load_max": 2.0}):
        found = solve(SCENE | turn, [*ENERGY, "turning_radius"])
        assert found["contact_slope"] == found["turning_radius"]


@pytest.mark.parametrize("solver", ["exact", "asymptotic", "envelope"])
def test_of_the_force_alone_it_is_that_at_pull_off(solver: str) -> None:
    scene = SCENE | {"a_max_over_R": np.array([0.05, 2.0, math.inf])}
    found = solve(scene, ["pull_off_force", "pull_off_radius", "contact_slope"], solver=solver)
    np.testing.assert_array_equal(found["contact_slope"], found["pull_off_radius"])
    assert slope(SCENE, ["pull_off_force", "loading_jumps"]) > found["contact_slope"][-1]
    if solver == "envelope":
        assert slope(SCENE, ["dissipated_energy"], solver=solver, profile=SERIES) == math.inf, "waves have no end"
