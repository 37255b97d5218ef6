"""Curves on a patterned interface: what they pass through, and what their jumps add up to."""

import math

import numpy as np
import pytest

from gradhesion.core import Loading, draw_curves, solve
from gradhesion.core.problem.status import FAILED
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

HARMONICS = (ToughnessHarmonic(n=1, cos=0.2, sin=0.1), ToughnessHarmonic(n=3, sin=0.1))
SCENE = {
    "k": 0.3,
    "nu": 0.3,
    "modulus": 500.0,
    "c0_over_R": 0.01,
    "lambda_over_R": 0.1,
    "A": 0.003,
    "a_max_over_R": 0.5,
    "toughness_wavelength_over_R": 0.1,
}
RESULTS = ("dissipated_energy", "pull_off_force", "loading_jumps", "unloading_jumps")


@pytest.mark.parametrize("of", ["toughness", "work"])
@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("turn", [{}, {"indentation_max_over_R": 0.05, "a_max_over_R": math.inf}])
@pytest.mark.parametrize("amplitude", [0.0, 0.003])
def test_curves_are_those_of_the_results(of: str, control: str, turn: dict[str, float], amplitude: float) -> None:
    scene = SCENE | turn | {"A": amplitude} | ({"machine_stiffness": 0.1} if control == "machine" else {})
    known = {"toughness": Toughness(HARMONICS, of), "loading": Loading(control=control)}
    found = solve(scene, RESULTS, **known)
    drawn, status = draw_curves(scene, ("equilibrium", "path", "jumps"), **known)
    assert status == int(found["status"]) & ~FAILED
    jumps = int(found["loading_jumps"]) + int(found["unloading_jumps"]) - (control == "load")
    assert drawn["jump_energy"].size == jumps
    assert drawn["jump_energy"].sum() == pytest.approx(float(found["dissipated_energy"]), rel=1e-12)
    for name in ("load", "path_load"):
        assert drawn[name].min() == pytest.approx(-float(found["pull_off_force"]), rel=1e-13)
    if control != "load":
        load = 1.5 * math.pi * drawn["path_load"]
        held = drawn["path_indentation"] + (load / (0.1 * scene["modulus"]) if control == "machine" else 0.0)
        assert np.trapezoid(load, held) == pytest.approx(float(found["dissipated_energy"]), rel=2e-3), "chords"


def test_what_cannot_be_drawn() -> None:
    pattern = Toughness(HARMONICS)
    with pytest.raises(ValueError, match="equilibrium, path, jumps"):
        draw_curves(SCENE, ["envelope"], toughness=pattern)
    with pytest.raises(ValueError, match="belongs to a pattern"):
        draw_curves(SCENE, ["path"])
    drawn, status = draw_curves(SCENE | {"toughness_wavelength_over_R": 1e-6}, ["equilibrium"], toughness=pattern)
    assert status == 64
    assert np.isnan(drawn["load"]).all()
    _, status = draw_curves(SCENE | {"toughness_amplitude": 9.0}, ["path"], toughness=pattern)
    assert status & 64
