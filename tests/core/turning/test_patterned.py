"""Where cycles on a patterned interface turn: the results are those of a rim that stands there."""

import math

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Loading, solve
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, NO_CONTACT, NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

HARMONICS = (ToughnessHarmonic(n=1, cos=0.4, sin=0.3), ToughnessHarmonic(n=2, sin=-0.2))
SCENE = {
    "k": 0.15,
    "nu": 0.3,
    "modulus": 600.0,
    "c0_over_R": 0.05,
    "lambda_over_R": 0.13,
    "A": 0.003,
    "a_max_over_R": math.inf,
    "toughness_wavelength_over_R": 0.06,
}
CYCLE = tuple(name for name in OUTPUTS if name != "turning_radius")


@pytest.mark.parametrize("of", ["toughness", "work"])
@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize(
    ("turn", "targets"),
    [("indentation_max_over_R", [0.001, 0.02, 0.05, 0.11]), ("load_max", [0.05, 0.7, 3.0, 8.0])],
)
def test_a_cycle_that_turns_is_that_of_a_rim_there(of: str, control: str, turn: str, targets: list[float]) -> None:
    known = {"toughness": Toughness(HARMONICS, of), "loading": Loading(control=control)}
    scene = SCENE | ({"machine_stiffness": 0.2} if control == "machine" else {})
    found = solve(scene | {turn: np.array(targets)}, OUTPUTS, **known)
    assert (np.diff(found["turning_radius"]) >= 0.0).all()
    for i, target in enumerate(targets):
        alone = solve(scene | {turn: target}, OUTPUTS, **known)
        rim = solve(scene | {"a_max_over_R": float(found["turning_radius"][i])}, OUTPUTS, **known)
        for name in CYCLE:
            assert float(alone[name]) == pytest.approx(float(found[name][i]), rel=1e-12), name
            if name != "delta_max":
                assert float(rim[name]) == pytest.approx(float(found[name][i]), rel=1e-12), name
        told = ~(JUMP_IN_TO_RIM | CLOSE_TO_A_JUMP)  # a rim may stand where a jump lands: that is close
        assert found["status"][i] & told == rim["status"] & told
    if turn == "indentation_max_over_R" and control == "displacement":
        assert found["delta_max"] == pytest.approx(np.array(targets), rel=1e-13)
    assert found["status"].dtype == np.int16


def test_turns_without_contact_or_beyond_the_rim() -> None:
    pattern = Toughness(HARMONICS)
    found = solve(
        SCENE | {"indentation_max_over_R": np.array([-0.01, 0.05]), "a_max_over_R": 0.2}, OUTPUTS, toughness=pattern
    )
    assert found["status"][0] == NO_CONTACT
    assert found["turning_radius"].tolist() == [0.0, 0.2]
    assert solve(SCENE | {"load_max": -1.0}, OUTPUTS, toughness=pattern)["status"] == NO_VALUE
    strong = SCENE | {"toughness_amplitude": 3.0, "indentation_max_over_R": 0.05}
    assert solve(strong, OUTPUTS, toughness=pattern)["status"] == NO_VALUE, "t < 0 somewhere on the punch"


def test_a_turn_that_is_too_far_leaves_the_others() -> None:
    fine = SCENE | {"A": 0.0, "toughness_wavelength_over_R": 5e-5, "indentation_max_over_R": np.array([0.003, 1.5])}
    found = solve(fine, ["dissipated_energy", "turning_radius"], toughness=Toughness(HARMONICS))
    assert found["status"][1] == NO_VALUE | TOO_MANY_WAVES
    alone = solve(fine | {"indentation_max_over_R": 0.003}, ["dissipated_energy"], toughness=Toughness(HARMONICS))
    assert not alone["status"] & NO_VALUE
    assert found["dissipated_energy"][0] == pytest.approx(float(alone["dissipated_energy"]), rel=1e-13)
