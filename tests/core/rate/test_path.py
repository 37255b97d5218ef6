"""The path of a moving edge: its loop integral, its lowest load, and its ends."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Loading, draw_curves, solve
from gradhesion.core.problem.toughness import Rate

BALL: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.01}
DRIVEN: list[tuple[dict[str, float], dict[str, Any]]] = [
    ({"a_max_over_R": math.inf, "indentation_max_over_R": 0.05}, {}),
    ({"a_max_over_R": 0.5}, {}),
    ({"a_max_over_R": 0.5, "machine_stiffness": 0.05}, {"loading": Loading(control="machine")}),
    (
        {"a_max_over_R": math.inf, "indentation_max_over_R": 0.04, "machine_stiffness": 0.05},
        {"loading": Loading(control="machine")},
    ),
]
CHORDS = 3e-3
"""Chords between the points, of the energy of the loop: most where the contact closes at rest, over few points."""


@pytest.mark.parametrize(("turn", "how"), DRIVEN)
@pytest.mark.parametrize("closing", ["quasi-static", "same"])
@pytest.mark.parametrize("speed", [1e-3, 1.0])
def test_the_path_encloses_the_energy(turn: dict[str, float], how: dict[str, Any], closing: str, speed: float) -> None:
    scene = BALL | turn | {"closing_ratio": 0.5, "speed_over_reference": speed}
    rate = Rate(exponent=0.6, closing=closing)
    drawn, status = draw_curves(scene, ["path"], rate=rate, **how)
    found = solve(scene, ["dissipated_energy", "pull_off_force", "delta_jump_out", "turning_radius"], rate=rate, **how)
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


def test_at_speed_0_it_is_the_path_of_an_edge_at_rest() -> None:
    scene = BALL | DRIVEN[0][0]
    rest, _ = draw_curves(scene, ["path", "jumps"])
    still, _ = draw_curves(scene | {"speed_over_reference": 0.0}, ["path", "jumps"], rate=Rate(exponent=0.6))
    for name, values in rest.items():
        assert np.array_equal(still[name], values)


def test_jumps_are_refused() -> None:
    with pytest.raises(ValueError, match="has no jumps"):
        draw_curves(BALL | DRIVEN[0][0] | {"speed_over_reference": 0.1}, ["jumps", "path"], rate=Rate(exponent=0.6))
