"""Whole cycles at a speed and their paths: stored ones, loop integrals, parts and ends, and what becomes of them at rest."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FLAGS, Loading, draw_curves, solve
from gradhesion.core.problem.names import EDGE, RATE
from gradhesion.core.problem.toughness import Rate
from gradhesion.core.rate.cycle import KNOWN
from tests.core.scene import ENDLESS, scene_of

TURNED = scene_of(0.3, 0.3, 500.0, 0.01, 0.2, 0.01, np.inf, indentation_max_over_R=0.05)
REST = [name for name in KNOWN if name not in RATE]
BOTH = pytest.mark.parametrize("closing", ["quasi-static", "same"])
REFUSED: list[tuple[str, dict[str, Any]]] = [("loading_jumps", {}), ("dissipated_energy_sensitivity", {})]


def test_cycles_that_close_at_rest_lose_what_another_solver_finds(root: Path) -> None:
    stored = json.loads((root / "tests/reference/moving_edge.json").read_text())
    cases = [(one["input"], case, 1.0) for one in stored["rate"].values() for case in one["cases"]]
    more = stored["rate_more"]["quasi_static_closing"]
    cases += [(case["input"], case, case["closing_ratio"]) for case in more]
    assert len(cases) == 26
    for given, case, ratio in cases:
        scene = scene_of(*(given[name] for name in ("k", "nu", "modulus", "c0", "lam", "A", "end")))
        scene |= {"speed_over_reference": case["eps"], "closing_ratio": ratio}
        names = ("pull_off_force", "dissipated_energy")
        found = solve(scene, names, rate=Rate(exponent=case["n"]))
        for name in names:
            assert float(found[name]) == pytest.approx(case[name], rel=1e-11)


@BOTH
@pytest.mark.parametrize("ratio", [0.3, 1.0])
def test_the_parts_of_the_energy_add_up(closing: str, ratio: float) -> None:
    scene = TURNED | {"closing_ratio": ratio, "speed_over_reference": np.array([0.0, 1e-3, 1.0])}
    parts = ["loading_energy", "unloading_energy", "front_energy"]
    found = solve(scene, ["dissipated_energy", *parts], rate=Rate(exponent=0.5, closing=closing))
    total = sum(found[name] for name in parts)
    np.testing.assert_allclose(found["dissipated_energy"], total, rtol=8.0 * np.finfo(float).eps)


@BOTH
@pytest.mark.parametrize("control", ["displacement", "machine"])
def test_at_speed_0_every_bit_is_that_of_an_edge_at_rest(closing: str, control: str) -> None:
    scene = TURNED | ({"machine_stiffness": 0.3} if control == "machine" else {}) | {"closing_ratio": 0.5}
    loading = Loading(control=control)
    plain = solve(scene, REST, loading=loading)
    moving = scene | {"speed_over_reference": np.array([0.0, 0.1])}
    found = solve(moving, KNOWN, loading=loading, rate=Rate(exponent=0.6, closing=closing))
    for name in REST:
        assert np.array_equal(found[name][0], plain[name], equal_nan=True), name
    assert found["edge_speed_at_pull_off"][0] == 0.0
    assert found["edge_speed_at_pull_off"][1] > 0.0
    assert found["pull_off_force"][1] > found["pull_off_force"][0]


def test_a_machine_that_turns_at_a_depth_reaches_it() -> None:
    scene = TURNED | {"machine_stiffness": 0.05, "closing_ratio": 0.5, "speed_over_reference": np.array([0.01, 1.0])}
    how: dict[str, Any] = {"rate": Rate(exponent=0.6, closing="same"), "loading": Loading(control="machine")}
    found = solve(scene, ["delta_max", "turning_radius"], **how)
    np.testing.assert_allclose(found["delta_max"], 0.05, rtol=1e-13)
    assert found["turning_radius"][0] > found["turning_radius"][1]


@BOTH
def test_a_cycle_without_contact_has_nothing(closing: str) -> None:
    scene = TURNED | {"indentation_max_over_R": -0.01, "speed_over_reference": 0.1}
    names = ["pull_off_force", "dissipated_energy", "pull_off_radius", *EDGE]
    found = solve(scene, names, rate=Rate(exponent=0.6, closing=closing))
    assert int(found["status"]) == FLAGS["no_contact"]
    assert found["dissipated_energy"] == found["pull_off_force"] == found["front_energy"] == 0.0
    assert np.isnan(found["pull_off_radius"])


@pytest.mark.parametrize(("output", "how"), [*REFUSED, ("pull_off_force", {"loading": Loading(control="load")})])
def test_what_is_not_known_of_a_moving_edge_is_refused(output: str, how: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="an edge with a speed needs"):
        solve(TURNED | ENDLESS | {"speed_over_reference": 0.1}, [output], rate=Rate(exponent=0.6), **how)


BALL: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.01}
DRIVEN: list[dict[str, float]] = [
    ENDLESS | {"indentation_max_over_R": 0.05},
    {"a_max_over_R": 0.5},
    {"a_max_over_R": 0.5, "machine_stiffness": 0.05},
    ENDLESS | {"indentation_max_over_R": 0.04, "machine_stiffness": 0.05},
]
CHORDS = 3e-3
"""Chords between the points, of the energy of the loop: most where the contact closes at rest, over few points."""


@pytest.mark.parametrize("turn", DRIVEN)
@pytest.mark.parametrize("closing", ["quasi-static", "same"])
@pytest.mark.parametrize("speed", [1e-3, 1.0])
def test_the_path_encloses_the_energy(turn: dict[str, float], closing: str, speed: float) -> None:
    scene = BALL | turn | {"closing_ratio": 0.5, "speed_over_reference": speed}
    how: dict[str, Any] = {"loading": Loading(control="machine")} if "machine_stiffness" in turn else {}
    how["rate"] = Rate(exponent=0.6, closing=closing)
    drawn, status = draw_curves(scene, ["path"], **how)
    found = solve(scene, ["dissipated_energy", "pull_off_force", "delta_jump_out", "turning_radius"], **how)
    assert status == found["status"] == 0
    load = 1.5 * np.pi * drawn["path_load"]
    coordinate = drawn["path_indentation"].copy()
    if "machine_stiffness" in scene:
        coordinate += load / (scene["machine_stiffness"] * scene["modulus"])
    loop = np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(coordinate))
    assert loop == pytest.approx(float(found["dissipated_energy"]), rel=CHORDS)
    assert -drawn["path_load"].min() == pytest.approx(float(found["pull_off_force"]), rel=CHORDS)
    assert drawn["path_indentation"][-1] == found["delta_jump_out"]
    assert drawn["path_contact_radius"].max() == pytest.approx(float(found["turning_radius"]), rel=1e-12)
    opening = drawn["path_contact_radius"][drawn["path_unloading"] == 1]
    assert (np.diff(opening) <= np.finfo(float).eps).all()


def test_at_speed_0_it_is_the_path_of_an_edge_at_rest_and_has_no_jumps_beyond() -> None:
    scene = BALL | DRIVEN[0]
    rest, _ = draw_curves(scene, ["path", "jumps"])
    still, _ = draw_curves(scene | {"speed_over_reference": 0.0}, ["path", "jumps"], rate=Rate(exponent=0.6))
    for name, values in rest.items():
        assert np.array_equal(still[name], values)
    with pytest.raises(ValueError, match="has no jumps"):
        draw_curves(BALL | DRIVEN[0] | {"speed_over_reference": 0.1}, ["jumps", "path"], rate=Rate(exponent=0.6))
