"""The slope of the punch at the largest radius that counts: closed forms, the drawn cycle, similarity."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, draw_curves, solve
from gradhesion.core.closed.reach import depends_on_contact
from gradhesion.core.problem.status import FLAGS, NO_CONTACT

SCENE = {"k": 0.3, "nu": 0.3, "modulus": 30.0, "c0_over_R": 0.1, "lambda_over_R": 0.2, "A": 0.05}
ENDLESS = SCENE | {"a_max_over_R": math.inf}
SERIES = Profile(exponent=1.7, harmonics=(Harmonic(n=1), Harmonic(n=3, sin=0.2)))
ENERGY = ["dissipated_energy", "contact_slope"]


def slope(scene: dict[str, Any], outputs: list[str], **how: Any) -> Any:
    return solve(scene, [*outputs, "contact_slope"], **how)["contact_slope"]


def furthest(scene: dict[str, float], profile: Profile, loading: Loading) -> float:
    """The largest end of a jump, off the cycle as it is drawn."""
    drawn, _ = draw_curves(scene, ["jumps"], profile, loading)
    return max(float(drawn[f"jump_radius_{when}"].max()) for when in ("before", "after"))


@pytest.mark.parametrize("modulus", [3.7, 170.0])
def test_the_smooth_sphere_is_that_of_johnson_kendall_and_roberts(modulus: float) -> None:
    ball = {"k": 0.0, "nu": 0.3, "modulus": modulus, "c0_over_R": 1.0, "lambda_over_R": 1.0, "A": 0.0}
    ball["a_max_over_R"] = math.inf
    jump_in = (2.0 * math.pi / modulus) ** (1.0 / 3.0)  # zero depth: a^3 = 2 pi R^2 dgamma/E*
    pull_off = (9.0 * math.pi / (8.0 * modulus)) ** (1.0 / 3.0)
    assert slope(ball, ["dissipated_energy"]) == pytest.approx(jump_in, rel=1e-14)
    assert slope(ball, ["pull_off_force"]) == pytest.approx(pull_off, rel=1e-14)
    many = ball | {"modulus": np.full(5000, modulus)}  # by the kernels of many smooth scenes
    np.testing.assert_allclose(slope(many, ["dissipated_energy"]), jump_in, rtol=1e-14)
    envelope = slope(ball, ["dissipated_energy"], solver="envelope")
    assert envelope == pytest.approx(jump_in, rel=1e-14)


@pytest.mark.parametrize(
    ("change", "profile", "loading"),
    [
        ({}, Profile(), Loading()),
        ({"k": 1.0, "nu": 0.5}, Profile(), Loading()),
        ({"lambda_over_R": 0.07, "modulus": 500.0}, Profile(), Loading()),
        ({}, SERIES, Loading()),
        ({}, Profile(), Loading(control="load")),
        ({"machine_stiffness": 1.0}, Profile(), Loading(control="machine")),
    ],
)
def test_an_unbounded_punch_reaches_where_its_last_jump_ends(
    change: dict[str, float], profile: Profile, loading: Loading
) -> None:
    scene = ENDLESS | change
    found = float(slope(scene, ["dissipated_energy"], profile=profile, loading=loading))
    assert found == pytest.approx(furthest(scene, profile, loading) ** (profile.exponent - 1.0), rel=1e-12)


def test_of_a_long_curve_it_is_next_to_the_last_fold() -> None:
    wavelength = 1e-3
    found = solve(ENDLESS | {"lambda_over_R": wavelength}, ["dissipated_energy", "saturation_radius", "contact_slope"])
    assert 0.0 < float(found["contact_slope"]) - float(found["saturation_radius"]) < wavelength


def test_of_a_long_curve_a_stiff_machine_finds_the_same() -> None:
    scene = ENDLESS | {"lambda_over_R": 3e-4, "A": 0.02}  # its waves are summed, by each solver in its own way
    stiff = slope(
        scene | {"machine_stiffness": 1e14},
        ["dissipated_energy"],
        loading=Loading(control="machine"),
        check_contact=False,
    )
    assert float(stiff) == pytest.approx(float(slope(scene, ["dissipated_energy"], check_contact=False)), rel=1e-9)


def test_a_rim_or_a_turn_is_what_is_reached() -> None:
    scene = SCENE | {"a_max_over_R": np.array([0.05, 2.0])}
    np.testing.assert_array_equal(slope(scene, ["dissipated_energy"]), [0.05, 2.0])
    np.testing.assert_array_equal(slope(scene, ["delta_max"], profile=SERIES), np.array([0.05, 2.0]) ** 0.7)
    for turn in ({"indentation_max_over_R": 0.4}, {"load_max": 2.0}):
        found = solve(ENDLESS | turn, [*ENERGY, "turning_radius"])
        assert found["contact_slope"] == found["turning_radius"]


@pytest.mark.parametrize("solver", ["exact", "asymptotic", "envelope"])
def test_of_the_force_alone_it_is_that_at_pull_off(solver: str) -> None:
    scene = SCENE | {"a_max_over_R": np.array([0.05, 2.0, math.inf])}
    found = solve(scene, ["pull_off_force", "pull_off_radius", "contact_slope"], solver=solver)
    np.testing.assert_array_equal(found["contact_slope"], found["pull_off_radius"])
    assert slope(ENDLESS, ["pull_off_force", "loading_jumps"]) > found["contact_slope"][-1]


def test_with_waves_the_envelopes_have_no_end() -> None:
    assert slope(ENDLESS, ["dissipated_energy"], solver="envelope") == math.inf
    assert slope(ENDLESS, ["dissipated_energy"], solver="envelope", profile=SERIES) == math.inf


def test_similar_scenes_reach_similar_radii() -> None:
    ratio = 0.37  # of the lengths L over R; heights are as their squares: L^(3+k) = R^2 dgamma/M, k = 0.3
    other = ENDLESS | {"modulus": 30.0 * ratio**-3.3, "lambda_over_R": 0.2 * ratio, "A": 0.05 * ratio}
    first = float(slope(ENDLESS, ["dissipated_energy"]))
    assert slope(other, ["dissipated_energy"]) == pytest.approx(first * ratio, rel=1e-12)


def test_no_other_value_changes() -> None:
    scene = SCENE | {"a_max_over_R": np.array([0.05, 2.0, math.inf])}
    plain = solve(scene, ["pull_off_force", "dissipated_energy", "loading_jumps"])
    beside = solve(scene, ["pull_off_force", "dissipated_energy", "loading_jumps", "contact_slope"])
    for name, values in plain.items():
        np.testing.assert_array_equal(values, beside[name])


def test_a_depth_below_first_contact_is_said() -> None:
    depths = np.array([-10.0, -1e-3, 0.05])
    for profile in (Profile(), SERIES):
        found = solve(ENDLESS | {"indentation_max_over_R": depths}, [*ENERGY, "turning_radius"], profile=profile)
        assert found["status"].dtype == np.int16
        away = found["turning_radius"] == 0.0
        assert away.any()
        assert not away.all()
        np.testing.assert_array_equal((found["status"] & NO_CONTACT) != 0, away)
        np.testing.assert_array_equal(found["dissipated_energy"][away], 0.0)
        np.testing.assert_array_equal(found["contact_slope"][away], 0.0)
    assert solve(ENDLESS | {"load_max": 1.0})["status"].dtype == solve(ENDLESS)["status"].dtype == np.int8
    assert FLAGS["no_contact"] == 1024


def test_what_depends_on_no_radius() -> None:
    assert not depends_on_contact(["wave_slope", "johnson_alpha", "roughness_parameter"])
    assert depends_on_contact(["saturation_radius"])
    assert np.isnan(slope(ENDLESS | {"A": -1.0}, ["dissipated_energy"]))
