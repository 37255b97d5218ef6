"""Curves of a scene by name: what comes back, and what has no value."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import CURVES, draw_curves, solve
from gradhesion.core.draw.draw import INTEGERS
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE


def test_every_curve_has_its_variables_of_one_length_and_type(any_scene: dict[str, float]) -> None:
    variables, status = draw_curves(any_scene, list(CURVES))
    assert status & NO_VALUE == 0
    assert list(variables) == [name for curve in CURVES.values() for name in curve]
    for names in CURVES.values():
        assert len({variables[name].shape for name in names}) == 1
    for name, values in variables.items():
        assert values.ndim == 1
        assert (values.dtype.kind == "i") == (name in INTEGERS)
        assert np.isfinite(values).all()


def test_a_curve_does_not_depend_on_what_else_is_drawn(scene: dict[str, float]) -> None:
    together, _ = draw_curves(scene, list(CURVES))
    for curve, names in CURVES.items():
        alone, _ = draw_curves(scene, [curve])
        assert list(alone) == list(names)
        assert all(np.array_equal(alone[name], together[name]) for name in names)


def test_curves_end_at_the_rim_exactly(any_scene: dict[str, float]) -> None:
    variables, _ = draw_curves(any_scene, list(CURVES))
    ends = {name: values.max() for name, values in variables.items() if name.endswith("contact_radius")}
    del ends["effective_contact_radius"]  # it turns earlier if there is no rim
    assert len(set(ends.values())) == 1
    if any_scene["a_max_over_R"] < math.inf:
        assert ends["contact_radius"] == any_scene["a_max_over_R"]
        assert variables["effective_contact_radius"].max() == any_scene["a_max_over_R"]


@pytest.mark.parametrize(
    "wrong",
    [
        {"k": -0.1},
        {"k": 1.1},
        {"k": 1.0, "nu": 0.3},
        {"nu": 0.6},
        {"modulus": 0.0},
        {"c0_over_R": -1.0},
        {"lambda_over_R": 0.0},
        {"lambda_over_R": math.nan},
        {"A": -0.1},
        {"A": math.inf},
        {"a_max_over_R": 0.0},
        {"a_max_over_R": math.nan},
    ],
    ids=str,
)
def test_beyond_its_range_a_parameter_gives_no_value(wrong: dict[str, float], scene: dict[str, float]) -> None:
    variables, status = draw_curves(scene | wrong, list(CURVES))
    assert status == NO_VALUE
    for name, values in variables.items():
        if name in CURVES["jumps"]:
            assert values.size == 0
            continue
        assert values.shape == (1,)
        assert values[0] == -1 if name in INTEGERS else math.isnan(values[0])


def test_more_folds_than_can_be_drawn_leave_what_has_a_closed_form(scene: dict[str, float]) -> None:
    scene["lambda_over_R"] = 8e-6
    variables, status = draw_curves(scene, list(CURVES))
    assert status == NO_VALUE
    without = {name for name, values in variables.items() if values.size <= 1}
    folded = ("equilibrium", "closing_equilibrium", "path", "asymptotic", "jumps")
    assert without == {name for curve in folded for name in CURVES[curve]}
    assert draw_curves(scene, ["smooth", "envelope", "effective"])[1] == 0


def test_loading_that_gains_energy_is_flagged_as_in_a_map() -> None:
    scene = {
        "k": 1.0,
        "nu": 0.5,
        "modulus": 900.0,
        "c0_over_R": 0.1,
        "lambda_over_R": 0.11,
        "A": 2.3,
        "a_max_over_R": 0.16,
    }
    assert draw_curves(scene, ["path"])[1] == LOADING_NOT_ONE_DISC == solve(scene)["status"]
    assert draw_curves(scene, ["equilibrium"])[1] == 0


def test_a_path_that_rounding_could_change_is_flagged_as_in_a_map(scene: dict[str, float]) -> None:
    """A rim at the end of a branch: an ulp further, and there is one more jump."""
    path, _ = draw_curves(scene | {"A": 0.1}, ["path"])
    third = int(np.flatnonzero(path["path_jump"])[3]) - 1
    scene |= {"A": 0.1, "a_max_over_R": float(path["path_contact_radius"][third])}
    assert draw_curves(scene, ["path"])[1] & CLOSE_TO_A_JUMP
    assert not draw_curves(scene | {"A": 0.1, "a_max_over_R": 0.47}, ["path"])[1] & CLOSE_TO_A_JUMP
    assert draw_curves(scene, ["equilibrium"])[1] == 0


def test_mistakes_of_the_caller_are_named(scene: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="'hysteresis'"):
        draw_curves(scene, ["hysteresis"])
    incomplete: dict[str, Any] = {name: value for name, value in scene.items() if name != "nu"}
    with pytest.raises(ValueError, match="missing parameters \\['nu'\\]"):
        draw_curves(incomplete, ["smooth"])
