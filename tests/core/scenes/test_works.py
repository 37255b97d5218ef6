"""Cycles that open at a larger work than they close at, and patterned interfaces: closed forms, limits, and corners.

Stored cycles, random ones against the twin, sums and neighbours are in tests/conformance.
"""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Loading, solve
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE, TOO_MANY_WAVES
from tests.core.scene import ENDLESS, EPS, pattern_of, profile_of, scene_of

BALL = scene_of(0.1, 0.3, 500.0, 0.01, 0.1, 0.02, 0.5)
ROW = (1, 0.6, 0.8)


def test_without_adhesion_on_approach_contact_grows_as_hertz_has_it() -> None:
    """A paraboloid at the depth d touches within a = sqrt((1+k) d) (Hertz at k = 0)."""
    depth = np.array([0.001, 0.02, 0.3])
    scene = BALL | ENDLESS | {"A": 0.0, "indentation_max_over_R": depth, "closing_ratio": 0.0}
    found = solve(scene, ["turning_radius", "loading_jumps", "loading_energy", "snap_in_force"])
    np.testing.assert_allclose(found["turning_radius"], np.sqrt(1.1 * depth), rtol=4.0 * EPS)
    assert not found["loading_jumps"].any()
    assert not found["loading_energy"].any()
    assert np.isnan(found["snap_in_force"]).all()


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("exponent", [1.0, 1.3, 2.0])
def test_without_adhesion_on_approach_a_pattern_of_toughness_changes_nothing(exponent: float, control: str) -> None:
    """Loading follows the contact without adhesion; at k = 0 its first jump is within 1e-30 of a tip with a slope."""
    k, moduli = np.array([[0.0], [0.3]]), np.array([1e-3, 16.0, 1e6])
    scenes = scene_of(k, 0.5, moduli, 0.015, 0.0075, 0.011, 0.022, closing_ratio=0.0)
    scenes |= {"machine_stiffness": 0.3} if control == "machine" else {}
    names = ("loading_jumps", "loading_energy", "delta_max")
    how: dict[str, Any] = {"profile": profile_of(exponent, (1, -0.94, 0.33), (4, -0.56, 0.15))}
    how["loading"] = Loading(control=control)
    plain = solve(scenes, names, **how)
    pattern = {"toughness_wavelength_over_R": 0.03, "toughness_amplitude": 0.3}
    found = solve(scenes | pattern, names, toughness=pattern_of("toughness", (1, 1.0, 0.5)), **how)
    assert (plain["loading_jumps"] > 0).any()
    for name, rtol in zip(names, (0.0, 1e-9, 1e-12), strict=True):
        np.testing.assert_allclose(found[name], plain[name], rtol=rtol)


def test_what_has_no_bound_is_infinite() -> None:
    without = ("dissipated_energy", "front_energy", "pinned_depth")
    found = solve(BALL | ENDLESS | {"closing_ratio": [0.5, 1.0]}, [*without, "pull_off_force", "loading_energy"])
    for name in without:
        assert np.isinf(found[name]).tolist() == [True, False]
    assert found["pull_off_force"][0] == found["pull_off_force"][1]
    assert np.isfinite(found["loading_energy"]).all()


def test_a_contact_that_a_machine_presses_after_the_jump_has_no_pull() -> None:
    """The waves descend from the tip, so that contact begins under a load above 0."""
    profile = profile_of(3.0, (1, 0.31, -0.28), (2, 0.06, -0.07), (3, -0.38, -0.01))
    scene = scene_of(0.8, 0.3, 1200.0, 0.0433, 0.46, 0.0816, 0.72, closing_ratio=0.85)
    assert solve(scene, ["snap_in_force"], profile=profile)["snap_in_force"] < 0.0, "at depth 0 it is pressed"
    scene["machine_stiffness"] = np.array([0.01, 0.02, 0.04, 0.056, 0.1, 1.0, 100.0])
    held = solve(scene, ["snap_in_force"], profile=profile, loading=Loading(control="machine"))
    assert np.isnan(held["snap_in_force"]).all()


# Patterned interfaces


PLAIN = scene_of(0.23, 0.3, 400.0, 0.05, 0.1, 0.004, 0.47)
PATTERNED = PLAIN | {"toughness_wavelength_over_R": 0.07, "toughness_amplitude": 0.5}


def test_a_centre_without_adhesion() -> None:
    """Contact grows from a point and shrinks to one: nothing pulls, nothing is lost; whether it jumps there is rounding."""
    scene = PATTERNED | {"A": 0.0, "toughness_amplitude": 1.0, "toughness_wavelength_over_R": 3.0, "a_max_over_R": 0.2}
    found = solve(scene, OUTPUTS, toughness=pattern_of("toughness", (1, -1.0, 0.0)))
    assert float(found["pull_off_force"]) == 0.0
    assert np.isnan(found["pull_off_radius"])
    assert found["status"] & CLOSE_TO_A_JUMP
    for name in ("dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out"):
        assert abs(float(found[name])) < 1e-18, name


def test_patterns_are_followed_to_ten_thousand_waves() -> None:
    """Fine waves of chi on a smooth punch lose 4 pi chi a^2 beyond it, less by the order of their length (section 10)."""
    smooth, one = PLAIN | {"A": 0.0, "k": 0.0, "a_max_over_R": 0.5}, pattern_of("toughness", ROW)
    scene = smooth | {"toughness_amplitude": 0.3}
    found = solve(scene | {"toughness_wavelength_over_R": 5e-5}, OUTPUTS, toughness=one)
    assert found["status"] == 0
    assert min(int(found[name]) for name in ("loading_jumps", "unloading_jumps")) > 6_000
    up, down = (solve(smooth | {"modulus": 400.0 / w}, OUTPUTS) for w in (0.7**2, 1.3**2))
    limit = 0.7**2 * up["loading_energy"] + 1.3**2 * down["unloading_energy"] + math.pi * 0.25 * (1.3**2 - 0.7**2)
    assert float(found["dissipated_energy"]) == pytest.approx(float(limit), rel=2e-2)
    assert float(found["pull_off_force"]) == pytest.approx(1.3**2, rel=1e-7)
    finer = scene | {"toughness_wavelength_over_R": 5e-6}
    found = solve(finer | {"a_max_over_R": np.array([0.01, 0.5])}, ["dissipated_energy"], toughness=one)
    turned = solve(finer | {"load_max": 30.0}, ["dissipated_energy"], toughness=one)
    assert found["status"][1] == turned["status"] == NO_VALUE | TOO_MANY_WAVES
    assert not found["status"][0] & NO_VALUE, "a rim that is near enough has its values"
