"""What a study may leave out: a radius, and what has no effect; and Young's modulus in the place of the reduced one."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset import compute
from gradhesion.cli.errors import StudyError
from gradhesion.cli.study import study_from

OUTPUTS = ["pull_off_force", "dissipated_energy"]
BALL: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "A": 0.0}


def made(parameters: dict[str, Any], **tables: Any) -> xarray.Dataset:
    """Compute a study of some parameters."""
    return compute(study_from({"outputs": OUTPUTS, "parameters": parameters, **tables}))


def test_a_smooth_homogeneous_ball_needs_four_numbers() -> None:
    """Johnson, Kendall & Roberts (1971)."""
    dataset = made(BALL)
    assert dataset["pull_off_force"].item() == pytest.approx(1.0, rel=4 * np.finfo(float).eps)
    assert dataset["a_max_over_R"].item() == math.inf
    assert "without effect where k = 0" in dataset["c0_over_R"].attrs["comment"]
    assert "without effect where A = 0" in dataset["lambda_over_R"].attrs["comment"]
    assert (dataset["c0_over_R"].item(), dataset["lambda_over_R"].item()) == (1.0, 1.0)
    assert "comment" not in dataset["modulus"].attrs


@pytest.mark.parametrize("name", ["c0_over_R", "lambda_over_R"])
def test_what_is_left_out_has_no_effect(name: str) -> None:
    for value in (1e-3, 0.37, 40.0):
        for output in OUTPUTS:
            assert made(BALL | {name: value})[output].item() == made(BALL)[output].item()


@pytest.mark.parametrize(
    ("parameters", "name"),
    [
        (BALL | {"k": [0.0, 0.1]}, "c0_over_R"),
        (BALL | {"A": [0.0, 0.1]}, "lambda_over_R"),
        (BALL | {"k": 2.0}, "c0_over_R"),
    ],
)
def test_it_is_required_where_it_has_an_effect(parameters: dict[str, Any], name: str) -> None:
    with pytest.raises(StudyError) as caught:
        study_from({"outputs": OUTPUTS, "parameters": parameters})
    assert any(f"parameters.{name}: unless" in line for line in caught.value.mistakes)


def test_with_units_too() -> None:
    quantities = {"R": "5 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2"}
    dataset = made({"k": 0.0, "nu": 0.3, "A": 0.0}, physical=quantities)
    assert dataset["pull_off_force_si"].item() == pytest.approx(1.5 * math.pi * 5e-6 * 0.05, rel=1e-14)
    assert dataset["a_max"].item() == math.inf


@pytest.mark.parametrize("nu", [0.3, [-0.4, 0.0, 0.5]])
def test_youngs_modulus_gives_the_reduced_one(nu: Any) -> None:
    waves = {"wavelength": "0.3 um", "c0": "0.1 um"}
    others = {"R": "1 um", "work_of_adhesion": "50 mJ/m^2", **waves}
    dataset = made({"k": 0.4, "nu": nu, "A": 0.02}, physical=others | {"E": ["0.7 GPa", "1 GPa"]})
    assert dataset["E"].attrs["units"] == "Pa"
    assert {*dataset["modulus"].dims} == {"E"} | ({"nu"} if isinstance(nu, list) else set())
    for one in np.atleast_1d(nu):
        for modulus in (0.7e9, 1e9):
            reduced = f"{float(modulus / (1 - one**2))!r} Pa"
            expected = made({"k": 0.4, "nu": float(one), "A": 0.02}, physical=others | {"E_star": reduced})
            own = dataset.sel(E=modulus, **({"nu": one} if isinstance(nu, list) else {}))
            for output in OUTPUTS:
                assert own[output].item() == pytest.approx(expected[output].item(), rel=1e-12)


def test_one_modulus_is_enough() -> None:
    quantities = {"R": "1 um", "E_star": "1 GPa", "E": "1 GPa", "work_of_adhesion": "50 mJ/m^2"}
    with pytest.raises(StudyError, match=r"physical\.E = .*E_star"):
        study_from({"outputs": OUTPUTS, "parameters": {"k": 0.0, "nu": 0.3, "A": 0.0}, "physical": quantities})


def test_info_says_which_parameters_have_no_effect(gradhesion: Callable[..., Result], tmp_path: Path) -> None:
    study, file = tmp_path / "ball.toml", tmp_path / "ball.nc"
    study.write_text(
        'outputs = ["pull_off_force"]\n[parameters]\nk = 0.0\nnu = 0.3\nA = 0.0\n[physical]\nR = "5 um"\n'
        'E = { start = "1 MPa", stop = "2 MPa", num = 9 }\nwork_of_adhesion = "45 mJ/m^2"\n'
    )
    assert gradhesion("run", study, "-o", file, "--quiet").exit_code == 0
    lines = [" ".join(line.split()) for line in gradhesion("info", file).stdout.splitlines()]
    assert "c0_over_R 1 (without effect where k = 0)" in lines
    assert "lambda_over_R 1 (without effect where A = 0)" in lines
    assert "E 9 values from 1e+06 to 2e+06 Pa, evenly spaced" in lines
