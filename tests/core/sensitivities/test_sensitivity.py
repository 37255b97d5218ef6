"""Sensitivities against reference values, differences of the solver, similarity, and their limits."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import PARAMETERS, SENSITIVITIES, Harmonic, Profile, solve
from gradhesion.core.problem.status import PULL_OFF_AT_RIM
from gradhesion.core.sensitivities.sensitivity import sensitivities

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "sensitivities.json").read_text())
VALUES = ("pull_off_force", "dissipated_energy")
SUMS = (0.0, 2.0)
"""Of c0 + lambda + A + a_max - 3 modulus: the powers of R of the values in units of R dgamma and of dgamma."""
GOOD = 1e-8
"""What the reference values are good to."""
ROUNDING = 1e-7
"""Of a difference of steps of 2e-5: 10 eps over the step, and of the place at which a jump lands, 1e-9."""
Scenes = Callable[..., dict[str, NDArray[np.float64]]]
Differences = Callable[..., tuple[dict[str, NDArray[np.float64]], NDArray[np.bool_]]]


def column(found: dict[str, NDArray[np.float64]], value: str, parameter: str) -> NDArray[np.float64]:
    return found[f"{value}_sensitivity"][..., PARAMETERS.index(parameter)]


def test_reference_values() -> None:
    scenes = {name: np.array([one["input"][name] for one in REFERENCE]) for name in PARAMETERS}
    found = solve(scenes, SENSITIVITIES)
    for value in VALUES:
        for name in PARAMETERS:
            exact = np.array([one[value][name] for one in REFERENCE])
            np.testing.assert_allclose(column(found, value, name), exact, rtol=GOOD, atol=GOOD)


def test_all_are_asked_for_at_once_with_values(scene: dict[str, float]) -> None:
    outputs = [SENSITIVITIES[1], "delta_max", SENSITIVITIES[0]]
    found = solve(scene | {"A": [0.01, 0.02]}, outputs)
    assert list(found) == [*outputs, "status"]
    assert found[SENSITIVITIES[0]].shape == (2, 7)
    one = solve(scene | {"A": 0.02}, [SENSITIVITIES[0]])[SENSITIVITIES[0]]
    np.testing.assert_array_equal(one, found[SENSITIVITIES[0]][1])


@pytest.mark.parametrize(("seed", "low", "high"), [(1, -2.0, 0.0), (2, -1.8, -0.8)])
def test_against_differences(
    seed: int, low: float, high: float, random_scenes: Scenes, differences: Differences
) -> None:
    scenes = random_scenes(250, seed, low, high)
    found = solve(scenes, SENSITIVITIES, check_contact=False)
    for name in PARAMETERS:
        exact, same = differences(scenes, name)
        assert same.sum() > 200
        for value in VALUES:
            error = np.abs(column(found, value, name) - exact[value]) / (1 + np.abs(exact[value]))
            assert error[same].max() < ROUNDING, (value, name)


def test_long_curves_against_differences(random_scenes: Scenes, differences: Differences) -> None:
    """Waves are summed; a change of the amplitude moves no wave past the rim."""
    scenes = random_scenes(200, 5, -6.0, -3.0)
    exact, same = differences(scenes, "A")
    found = solve(scenes, SENSITIVITIES, check_contact=False)
    assert same.sum() > 150
    for value in VALUES:
        error = np.abs(column(found, value, "A") - exact[value]) / (1 + np.abs(exact[value]))
        assert error[same].max() < ROUNDING


def test_similarity(random_scenes: Scenes) -> None:
    scenes = random_scenes(500, 8, -5.0, 0.0)
    found = solve(scenes, SENSITIVITIES, check_contact=False)
    for value, total in zip(VALUES, SUMS, strict=True):
        parts = [column(found, value, name) for name in ("c0_over_R", "lambda_over_R", "A", "a_max_over_R")]
        stiffness = column(found, value, "modulus")
        sizes = 1 + sum(map(np.abs, parts)) + 3 * np.abs(stiffness)
        assert np.max(np.abs(sum(parts) - 3 * stiffness - total) / sizes) < 1e-12


def test_what_has_no_influence(scene: dict[str, float]) -> None:
    smooth = solve(scene | {"A": 0.0}, SENSITIVITIES)
    ungraded = solve(scene | {"k": 0.0}, SENSITIVITIES)
    endless = solve(scene | {"a_max_over_R": np.inf}, SENSITIVITIES)
    for value in VALUES:
        assert column(smooth, value, "lambda_over_R") == column(smooth, value, "A") == 0.0
        assert column(ungraded, value, "c0_over_R") == column(ungraded, value, "nu") == 0.0
        assert np.isfinite(column(ungraded, value, "k"))
        assert column(endless, value, "a_max_over_R") == 0.0
    assert abs(column(smooth, "pull_off_force", "modulus")) < 1e-13
    # (3+k)/3 of section 3 of docs/theory.md
    assert column(smooth, "pull_off_force", "k") == pytest.approx(
        1 / (3 + scene["k"]), rel=1e-9
    )  # (sensitivities/neighbours.py)


def test_the_smooth_cycle(scene: dict[str, float]) -> None:
    """Its energy is a number of k times M^(-2/(3+k)), where the rim is beyond the jump-in."""
    found = solve(scene | {"A": 0.0, "a_max_over_R": np.inf}, SENSITIVITIES)
    stiffness = column(found, "dissipated_energy", "modulus")
    assert stiffness == pytest.approx(-2 / (3 + scene["k"]), rel=1e-12)


@pytest.mark.parametrize("radius", [0.02, 0.06, 0.12])
def test_a_smooth_punch_that_is_small(radius: float, scene: dict[str, float], differences: Differences) -> None:
    small = scene | {"A": 0.0, "a_max_over_R": radius}
    found = solve(small, SENSITIVITIES)
    for name in ("k", "nu", "modulus", "c0_over_R", "a_max_over_R"):
        exact, _ = differences(small, name)
        for value in VALUES:
            assert column(found, value, name) == pytest.approx(exact[value], rel=ROUNDING, abs=ROUNDING)


def test_the_softest_gradient(scene: dict[str, float]) -> None:
    """At k = 1 only nu = 1/2 has a stiffness."""
    found = solve(scene | {"k": 1.0, "nu": 0.5}, SENSITIVITIES)
    for value in VALUES:
        assert np.isnan(column(found, value, "nu"))
        rest = [column(found, value, name) for name in PARAMETERS if name != "nu"]
        assert np.all(np.isfinite(rest))
    near = solve(scene | {"k": 1.0 - 1e-5, "nu": 0.5}, SENSITIVITIES)
    for name in ("modulus", "lambda_over_R", "A"):
        assert column(found, "pull_off_force", name) == pytest.approx(column(near, "pull_off_force", name), abs=1e-3)


@pytest.mark.parametrize("turn", ["indentation_max_over_R", "load_max"])
def test_cycles_that_turn(turn: str, random_scenes: Scenes, differences: Differences) -> None:
    scenes = random_scenes(150, 3, -1.0, 0.0)
    rng = np.random.default_rng(4)
    low, high = (-3.5, -1.5) if turn == "indentation_max_over_R" else (-1.0, 1.0)
    scenes |= {"a_max_over_R": np.full(150, np.inf), turn: 10 ** rng.uniform(low, high, 150)}
    found = solve(scenes, SENSITIVITIES, check_contact=False)
    assert found[SENSITIVITIES[0]].shape == (150, 8)
    for i, name in enumerate([*PARAMETERS[:6], turn]):
        exact, same = differences(scenes, name)
        for value in VALUES:
            own = found[f"{value}_sensitivity"][:, i if name != turn else 7]
            error = np.abs(own - exact[value]) / (1 + np.abs(exact[value]))
            assert error[same].max() < ROUNDING, (value, name)
    if turn == "indentation_max_over_R":
        assert np.any(found[SENSITIVITIES[0]][:, 7] != 0.0)  # some forces are met where the cycle turns


def test_the_force_at_a_turn_moves_with_the_depth_unless_a_jump_has_passed_that(scene: dict[str, float]) -> None:
    """Two cycles whose greatest depths both are far below 1e-14; the solver says which one a jump has taken there."""
    scenes = {name: np.full(2, value) for name, value in scene.items()} | {"indentation_max_over_R": np.full(2, 1e-19)}
    solved: dict[str, NDArray[Any]] = {"pull_off_force": np.ones(2), "turning_radius": np.full(2, 1e-3)}
    solved |= {"delta_max": np.array([1e-19, 1e-15]), "status": np.full(2, PULL_OFF_AT_RIM)}
    asked, passed = [SENSITIVITIES[0]], np.array([False, True])
    reduced = np.ones((3, 6, 2))
    reduced[0] = 1e19
    found = sensitivities(
        scenes, asked, solved, reduced, "indentation_max_over_R", passed, lambda other: np.ones_like(other["A"])
    )
    assert found[SENSITIVITIES[0]][:, 7] == pytest.approx([1.0, 0.0], abs=1e-12)


def test_no_contact_has_no_sensitivity(scene: dict[str, float]) -> None:
    found = solve(scene | {"indentation_max_over_R": -10.0}, SENSITIVITIES)
    assert all(np.all(np.isnan(found[name])) for name in SENSITIVITIES)


def test_out_of_range_has_no_sensitivity(scene: dict[str, float]) -> None:
    found = solve(scene | {"nu": [0.3, 0.7]}, SENSITIVITIES)
    for name in SENSITIVITIES:
        assert np.all(np.isfinite(found[name][0]))
        assert np.all(np.isnan(found[name][1]))


def test_a_harmonic_is_a_wave_of_its_own(scene: dict[str, float]) -> None:
    profile = Profile(harmonics=(Harmonic(n=3, cos=0.5),))
    found = solve(scene, SENSITIVITIES, profile=profile)
    alike = scene | {"lambda_over_R": scene["lambda_over_R"] / 3, "A": 1.5 * scene["A"]}
    other = solve(alike, SENSITIVITIES)
    for name in SENSITIVITIES:
        np.testing.assert_allclose(found[name], other[name], rtol=1e-9)


def test_what_is_not_known(scene: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=r"pull_off_force_sensitivity.* known of the exact solver only"):
        solve(scene, SENSITIVITIES, solver="asymptotic")


def test_threads_make_no_difference(random_scenes: Scenes) -> None:
    scenes = random_scenes(40, 9)
    one, two = (solve(scenes, SENSITIVITIES, threads=threads) for threads in (1, 2))
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(one[name], two[name])
