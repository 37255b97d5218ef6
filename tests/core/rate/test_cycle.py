"""Whole cycles at a speed: stored ones, their parts, and what becomes of them at rest."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Loading, solve
from gradhesion.core.problem.names import EDGE, RATE
from gradhesion.core.problem.status import FLAGS
from gradhesion.core.problem.toughness import Rate
from gradhesion.core.rate.cycle import KNOWN

BALL: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.01}
TURNED = BALL | {"a_max_over_R": math.inf, "indentation_max_over_R": 0.05}
KEYS = {"k": "k", "nu": "nu", "modulus": "modulus", "c0": "c0_over_R", "lam": "lambda_over_R", "A": "A"}
REST = [name for name in KNOWN if name not in RATE]


def stored(root: Path) -> dict[str, Any]:
    cases: dict[str, Any] = json.loads((root / "tests/reference/moving_edge.json").read_text())
    return cases


def scene_of(case: dict[str, float]) -> dict[str, Any]:
    return {KEYS[name]: value for name, value in case.items() if name in KEYS} | {"a_max_over_R": case["end"]}


def test_cycles_that_close_at_rest_lose_what_another_solver_finds(root: Path) -> None:
    compared = 0
    cases = [(one["input"], case, 1.0) for one in stored(root)["rate"].values() for case in one["cases"]]
    more = stored(root)["rate_more"]["quasi_static_closing"]
    cases += [(case["input"], case, case["closing_ratio"]) for case in more]
    for given, case, ratio in cases:
        scene = scene_of(given) | {"speed_over_reference": case["eps"], "closing_ratio": ratio}
        found = solve(scene, ["pull_off_force", "dissipated_energy"], rate=Rate(exponent=case["n"]))
        assert float(found["pull_off_force"]) == pytest.approx(case["pull_off_force"], rel=1e-11)
        assert float(found["dissipated_energy"]) == pytest.approx(case["dissipated_energy"], rel=1e-11)
        compared += 1
    assert compared == 26


def test_cycles_that_close_by_the_same_law_lose_the_loop_integral(root: Path) -> None:
    for case in stored(root)["rate_more"]["closing_same"]:
        scene = scene_of(case["input"]) | {"a_max_over_R": math.inf, "indentation_max_over_R": case["delta_max"]}
        scene |= {"closing_ratio": case["closing_ratio"], "speed_over_reference": case["eps"]}
        names = ["turning_radius", "dissipated_energy", "pinned_depth", "delta_max"]
        found = solve(scene, names, rate=Rate(exponent=case["n"], closing="same"))
        assert float(found["turning_radius"]) == pytest.approx(case["a_t"], rel=1e-11)
        assert float(found["dissipated_energy"]) == pytest.approx(case["dissipated_energy"], rel=1e-11)
        apart = case["depth_edge_stops"] - case["depth_opening_starts"]
        assert float(found["pinned_depth"]) == pytest.approx(apart, rel=1e-11, abs=1e-15)
        assert float(found["delta_max"]) == pytest.approx(case["delta_max"], rel=1e-13)


@pytest.mark.parametrize("closing", ["quasi-static", "same"])
@pytest.mark.parametrize("ratio", [0.3, 1.0])
def test_the_parts_of_the_energy_add_up(closing: str, ratio: float) -> None:
    scene = TURNED | {"closing_ratio": ratio, "speed_over_reference": np.array([0.0, 1e-3, 1.0])}
    parts = ["loading_energy", "unloading_energy", "front_energy"]
    found = solve(scene, ["dissipated_energy", *parts], rate=Rate(exponent=0.5, closing=closing))
    total = sum(found[name] for name in parts)
    np.testing.assert_allclose(found["dissipated_energy"], total, rtol=8.0 * np.finfo(float).eps)


@pytest.mark.parametrize("closing", ["quasi-static", "same"])
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


def test_a_cycle_without_contact_has_nothing() -> None:
    scene = TURNED | {"indentation_max_over_R": -0.01, "speed_over_reference": 0.1}
    for closing in ("quasi-static", "same"):
        found = solve(
            scene,
            ["pull_off_force", "dissipated_energy", "pull_off_radius", *EDGE],
            rate=Rate(exponent=0.6, closing=closing),
        )
        assert int(found["status"]) == FLAGS["no_contact"]
        assert found["dissipated_energy"] == found["pull_off_force"] == found["front_energy"] == 0.0
        assert np.isnan(found["pull_off_radius"])


@pytest.mark.parametrize(
    ("outputs", "how"),
    [
        (["loading_jumps"], {}),
        (["dissipated_energy_sensitivity"], {}),
        (["pull_off_force"], {"loading": Loading(control="load")}),
    ],
)
def test_what_is_not_known_of_a_moving_edge_is_refused(outputs: list[str], how: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="an edge with a speed needs"):
        solve(TURNED | {"speed_over_reference": 0.1}, outputs, rate=Rate(exponent=0.6), **how)
