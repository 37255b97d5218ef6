"""What a scene tells of itself, checked by other routes."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS, REPORTS, solve
from gradhesion.core.equations.jkr import indentation
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE

STORED = Path(__file__).parents[2] / "twin" / "scenes.json"
SCENE: dict[str, Any] = {
    "k": 0.3,
    "nu": 0.3,
    "modulus": 500.0,
    "c0_over_R": 0.01,
    "lambda_over_R": 0.1,
    "A": 0.03,
    "a_max_over_R": 0.8,
}
WITHOUT_CYCLE = ("roughness_parameter", "adhesion_gain")


@pytest.fixture(scope="module")
def stored() -> tuple[dict[str, Any], dict[str, Any]]:
    """2,184 scenes solved to 30 digits by another method: parameters and values."""
    data = json.loads(STORED.read_text(encoding="utf-8"))
    columns = dict(zip(data["columns"], zip(*data["scenes"], strict=True), strict=True))
    return {name: np.array(columns[name], dtype=float) for name in PARAMETERS}, columns


def test_the_residual_is_rounding(stored: tuple[dict[str, Any], dict[str, Any]]) -> None:
    """The loop integral is another way to the energy; its own rounding grows with the load that cancels in it."""
    parameters, columns = stored
    result = solve(parameters, ("dissipated_energy", "energy_residual"))
    share = np.abs(result["energy_residual"] / result["dissipated_energy"])
    few = np.array(columns["loading_jumps"], dtype=float) <= 5
    assert np.median(share) <= 4e-14
    assert np.quantile(share[few], 0.99) <= 1e-12
    # work of the load, M a^(1+k) times the square of a depth: of the paraboloid, of the stretch and of the waves
    k, material = parameters["k"], stiffness(*(parameters[name] for name in PARAMETERS[:4]))
    last = np.maximum(
        solve(parameters, ("saturation_radius",))["saturation_radius"], 3.0 * material ** (-1.0 / (3.0 + k))
    )
    rim = np.fmin(parameters["a_max_over_R"], last)  # beyond, loading and unloading are one
    stretch = np.sqrt(2.0 ** (1.0 + k) * np.pi / material) * rim ** (0.5 * (1.0 - k))
    chi = solve(parameters, ("roughness_parameter",))["roughness_parameter"]
    work = material * rim ** (1.0 + k) * (rim**2 + (1.0 + chi) * stretch) ** 2
    plain = (result["status"] & CLOSE_TO_A_JUMP) == 0
    branches = 1.0 + np.array(columns["loading_jumps"], dtype=float) + np.array(columns["unloading_jumps"], dtype=float)
    size = branches * (work + result["dissipated_energy"])
    assert (np.abs(result["energy_residual"]) <= 512 * 2.0**-52 * size)[plain].all()
    assert share[~plain].max() <= 1e-9


def test_a_residual_of_too_many_waves_has_no_value() -> None:
    result = solve(SCENE | {"lambda_over_R": 1e-5, "A": 0.05, "k": 0.0, "modulus": 1e4}, ("energy_residual",))
    assert np.isnan(result["energy_residual"])
    assert result["status"] & NO_VALUE == 0


@pytest.mark.parametrize("k", [0.0, 0.3, 0.8])
def test_roughness_parameter(k: float) -> None:
    """chi = r/s, with s = sqrt(2^(1+k) pi dgamma/M); at k = 0, M = E*, and r = sqrt(pi) G(1/2) A lambda^(1/2)."""
    found = solve(SCENE | {"k": k}, ("roughness_parameter",))["roughness_parameter"]
    if k == 0.0:
        r = math.pi * SCENE["A"] * math.sqrt(SCENE["lambda_over_R"])
        assert math.isclose(found, r / math.sqrt(2 * math.pi / SCENE["modulus"]), rel_tol=1e-14)
    chi = solve(SCENE | {"k": k, "lambda_over_R": 1e-5, "A": 3.0, "a_max_over_R": np.inf}, WITHOUT_CYCLE)
    # short waves: the pull-off force is (1 + chi)^2 of the smooth one
    assert math.isclose(chi["adhesion_gain"], (1 + chi["roughness_parameter"]) ** 2, rel_tol=1e-4)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.8, 0.97])
@pytest.mark.parametrize("amplitude", [0.0, 0.01, 0.05])
def test_nothing_folds_beyond_the_saturation_radius(k: float, amplitude: float) -> None:
    scene = SCENE | {"k": k, "A": amplitude}
    fold = float(solve(scene, ("saturation_radius",))["saturation_radius"])
    material = stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"])
    radii = np.linspace(fold, 4 * fold + 1.0, 4000)
    depths = indentation(k, material, radii, scene["lambda_over_R"], amplitude)
    assert np.all(np.diff(depths) > 0.0)
    just = fold - np.array([2e-3, 1e-3, 0.0]) * min(fold, scene["lambda_over_R"])
    inside = indentation(k, material, just, scene["lambda_over_R"], amplitude)
    assert inside[0] > inside[1] > inside[2]


def test_gains_are_those_over_the_smooth_punch() -> None:
    names = ("pull_off_force", "dissipated_energy", "adhesion_gain", "energy_gain")
    rims = np.array([0.05, 0.2, 0.8, np.inf])
    wavy, smooth = solve(SCENE | {"a_max_over_R": rims}, names), solve(SCENE | {"A": 0.0, "a_max_over_R": rims}, names)
    np.testing.assert_allclose(wavy["adhesion_gain"], wavy["pull_off_force"] / smooth["pull_off_force"], rtol=1e-15)
    np.testing.assert_allclose(wavy["energy_gain"], wavy["dissipated_energy"] / smooth["dissipated_energy"], rtol=1e-15)
    assert np.all(smooth["adhesion_gain"] == 1.0)
    assert np.all(smooth["energy_gain"] == 1.0)


def test_asking_changes_no_value(stored: tuple[dict[str, Any], dict[str, Any]]) -> None:
    parameters = {name: values[:300] for name, values in stored[0].items()}
    plain, asked = solve(parameters), solve(parameters, (*REPORTS, "pull_off_force", "dissipated_energy"))
    for name, values in plain.items():
        np.testing.assert_array_equal(values, asked[name])
    assert set(asked) == {*REPORTS, "pull_off_force", "dissipated_energy", "status"}


def test_no_value() -> None:
    result = solve(SCENE | {"A": np.array([0.02, -1.0]), "a_max_over_R": np.array([-0.5, 0.5])}, REPORTS)
    for name in REPORTS:
        assert np.all(np.isnan(result[name]))


def test_only_the_exact_solver_reports() -> None:
    with pytest.raises(ValueError, match="exact solver only"):
        solve(SCENE, ("energy_gain",), solver="envelope")
