"""What scenes on patterned interfaces tell of themselves."""

import math

import numpy as np
import pytest

from gradhesion.core import REPORTS, Loading, solve
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from tests.core.slow_pattern import SlowScene

ROWS = ((1, 0.2, 0.1), (3, 0.0, 0.1))
HARMONICS = tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd in ROWS)
SCENE = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.003}
RIMS = {"a_max_over_R": np.array([0.3, 0.5]), "toughness_wavelength_over_R": np.array([[0.04], [0.13]])}
VALUES = ("dissipated_energy", "pull_off_force")


@pytest.mark.parametrize("of", ["toughness", "work"])
@pytest.mark.parametrize("control", ["displacement", "machine"])
def test_the_loop_integral_is_the_energy(of: str, control: str) -> None:
    known = {"toughness": Toughness(HARMONICS, of), "loading": Loading(control=control)}
    scene = SCENE | RIMS | ({"machine_stiffness": 0.1} if control == "machine" else {})
    found = solve(scene, (*VALUES, *REPORTS), **known)
    assert np.abs(found["energy_residual"]).max() < 1e-12 * found["dissipated_energy"].max()
    assert (found["status"] == 0).all()
    smooth = solve(scene | {"A": 0.0}, VALUES, **known)
    assert found["adhesion_gain"] == pytest.approx(found["pull_off_force"] / smooth["pull_off_force"], rel=1e-14)
    assert found["energy_gain"] == pytest.approx(found["dissipated_energy"] / smooth["dissipated_energy"], rel=1e-14)
    radius = found["saturation_radius"][0, 0]
    beyond = solve(scene | {"a_max_over_R": [radius * 1.001, radius * 2.0]}, ["dissipated_energy"], **known)
    assert beyond["dissipated_energy"][0, 1] == pytest.approx(beyond["dissipated_energy"][0, 0], rel=1e-12)
    plain = {name: value for name, value in scene.items() if not name.startswith("toughness")}
    chi = solve(plain, ["roughness_parameter"], loading=known["loading"])["roughness_parameter"]
    assert found["roughness_parameter"][0] == pytest.approx(chi, rel=1e-13)


@pytest.mark.parametrize("of", ["toughness", "work"])
def test_values_are_those_of_a_slow_solver(of: str) -> None:
    found = solve(
        SCENE | {"a_max_over_R": 0.5, "toughness_wavelength_over_R": 0.13},
        VALUES,
        toughness=Toughness(HARMONICS, of),
    )
    slow = SlowScene(0.3, 0.3, 500.0, 0.01, 0.1, 0.003, ROWS, 0.13, of, points=40_000).cycle(0.5)
    for name in VALUES:
        assert float(found[name]) == pytest.approx(slow[name], rel=1e-12), name


def test_a_dead_load_closes_no_loop() -> None:
    scene = SCENE | {"a_max_over_R": math.inf, "toughness_wavelength_over_R": 0.1}
    with pytest.raises(ValueError, match="dead load"):
        solve(scene, ["energy_residual"], toughness=Toughness(HARMONICS), loading=Loading(control="load"))
