"""The slope of the punch at the largest radius that counts: closed forms, the drawn cycle, and what is said beside it."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Loading, Profile, draw_curves, solve
from tests.core.scene import profile_of, scene_of

SCENE = scene_of(0.3, 0.3, 30.0, 0.1, 0.2, 0.05, math.inf)
SERIES = profile_of(1.7, (1, 1.0, 0.0), (3, 0.0, 0.2))
ENERGY = ["dissipated_energy", "contact_slope"]


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


REACHED: list[tuple[dict[str, float], dict[str, Any]]] = [
    ({}, {}),
    ({"k": 1.0, "nu": 0.5}, {}),
    ({"lambda_over_R": 0.07, "modulus": 500.0}, {}),
    ({}, {"profile": SERIES}),
    ({}, {"loading": Loading(control="load")}),
    ({"machine_stiffness": 1.0}, {"loading": Loading(control="machine")}),
]


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
