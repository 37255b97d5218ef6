"""Cycles with a closing ratio: beside other ratios, pressed after the jump into contact, and without contact."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FLAGS, OUTPUTS, REPORTS, SENSITIVITIES, Harmonic, Loading, Profile, solve
from gradhesion.twin import stated
from gradhesion.twin.general import Shape

SCENE: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.1, "lambda_over_R": 0.1, "A": 0.03}
OF_CYCLES = [
    *OUTPUTS,
    *(name for name in (*REPORTS, *SENSITIVITIES) if name != "energy_residual"),  # which a dead load does not have
    *("front_energy", "snap_in_force", "pinned_depth", "turning_radius", "contact_slope"),
]
RATIOS = np.array([0.0, 0.5, 0.8, 1.0])


def test_loading_beside_a_ratio_of_1_is_that_of_the_reference_solver() -> None:
    scene = SCENE | {"a_max_over_R": 0.5}
    found = solve(scene | {"closing_ratio": np.array([0.5, 1.0])}, ["delta_max", "loading_jumps"])
    for number, ratio in enumerate((0.5, 1.0)):
        names = ["delta_max", "loading_jumps"]
        expected = stated.expected(scene | {"closing_ratio": ratio}, names, "exact", Shape())
        for name in names:
            one = expected[name]
            assert stated.deviation(float(found[name][number]), one) <= one.error, (name, ratio)


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize(
    "end",
    [
        {"a_max_over_R": 0.5},
        {"a_max_over_R": math.inf},
        {"a_max_over_R": 0.5, "indentation_max_over_R": 0.03},
        {"a_max_over_R": 0.5, "load_max": 2.0},
    ],
)
def test_each_ratio_has_the_cycle_that_it_has_alone(end: dict[str, float], control: str) -> None:
    scene = SCENE | {"A": np.array([0.01, 0.03, 0.06])[:, None]} | end
    scene |= {"machine_stiffness": 0.3} if control == "machine" else {}
    together = solve(scene | {"closing_ratio": RATIOS}, OF_CYCLES, loading=Loading(control=control))
    for number, ratio in enumerate(RATIOS):
        alone = solve(scene | {"closing_ratio": ratio}, OF_CYCLES, loading=Loading(control=control))
        for name in (*OF_CYCLES, "status"):
            tolerance = 1e-8 if name in SENSITIVITIES else 1e-12 if alone[name].dtype.kind == "f" else 0.0
            np.testing.assert_allclose(
                together[name][:, number], alone[name][:, 0], tolerance, err_msg=f"{name} {ratio}"
            )


@pytest.mark.parametrize("stiffness", [0.01, 0.02, 0.04, 0.056, 0.1, 1.0, 100.0])
def test_a_contact_that_a_machine_presses_after_the_jump_has_no_pull(stiffness: float) -> None:
    """The waves descend from the tip, so that contact begins under a load above 0."""
    waves = ((1, 0.31, -0.28), (2, 0.06, -0.07), (3, -0.38, -0.01))
    profile = Profile(exponent=3.0, harmonics=tuple(Harmonic(n=n, cos=c, sin=s) for n, c, s in waves))
    scene = {"k": 0.8, "nu": 0.3, "modulus": 1200.0, "c0_over_R": 0.0433, "lambda_over_R": 0.46, "A": 0.0816}
    scene |= {"a_max_over_R": 0.72, "closing_ratio": 0.85}
    assert solve(scene, ["snap_in_force"], profile=profile)["snap_in_force"] < 0.0, "at depth 0 it is pressed"
    scene["machine_stiffness"] = stiffness
    through_machine = solve(scene, ["snap_in_force"], profile=profile, loading=Loading(control="machine"))
    assert np.isnan(through_machine["snap_in_force"])


@pytest.mark.parametrize("ratio", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
def test_without_contact_the_pull_off_is_at_no_rim(control: str, ratio: float) -> None:
    """The rim is so small that it holds the pull-off of a cycle that makes contact."""
    scene = SCENE | {"a_max_over_R": 0.05, "closing_ratio": ratio}
    scene |= {"machine_stiffness": 0.3} if control == "machine" else {}
    turn = {"indentation_max_over_R": np.array([-0.01, 0.03])}
    status = solve(scene | turn, ["pull_off_force", "dissipated_energy"], loading=Loading(control=control))["status"]
    assert status[0] == FLAGS["no_contact"]
    assert status[1] & FLAGS["pull_off_at_rim"]
