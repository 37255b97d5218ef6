"""Validity numbers as outputs of a map: with any solver, in Python and in a file, and what `info` says of them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.core import VALIDITY, validity

Call = Callable[..., Result]


@pytest.fixture
def study(data: dict[str, Any]) -> dict[str, Any]:
    """A study that asks for all of them, beside a force."""
    parameters = data["parameters"] | {"adhesion_range_over_R": [1e-5, 1e-3]}
    return data | {"outputs": ["pull_off_force", *VALIDITY], "parameters": parameters}


def test_the_range_is_the_last_dimension_and_solves_nothing_again(study: dict[str, Any]) -> None:
    dataset = compute(study_from(study))
    assert list(dataset.sizes) == ["k", "lambda_over_R", "A", "a_max_over_R", "adhesion_range_over_R"]
    np.testing.assert_array_equal(dataset["pull_off_force"][..., 0], dataset["pull_off_force"][..., 1])
    names = [*gr.PARAMETERS, "adhesion_range_over_R"]
    arrays = dict(zip(names, xarray.broadcast(*(dataset[name] for name in names)), strict=True))
    order = dataset["wave_slope"].dims
    for name, values in validity({one: array.transpose(*order).values for one, array in arrays.items()}).items():
        np.testing.assert_array_equal(dataset[name], values)
        assert dataset[name].attrs["units"] == "1"


@pytest.mark.parametrize("solver", ["asymptotic", "envelope", ["exact", "envelope"]])
def test_with_any_solver(solver: Any, study: dict[str, Any]) -> None:
    dataset = compute(study_from(study | {"method": {"solver": solver}}))
    exact = compute(study_from(study))
    for name in VALIDITY:
        values = dataset[name] if isinstance(solver, str) else dataset[name].isel(solver=1)
        np.testing.assert_array_equal(values, exact[name])


def test_alone_and_in_python() -> None:
    ball = {"k": 0.0, "nu": 0.5, "A": 0.0, "R": "1 mm", "E_star": "1 MPa", "work_of_adhesion": "50 mJ/m^2"}
    found = gr.solve(ball, "tabor_parameter", adhesion_range=["0.3 nm", "1 um"])
    assert found["tabor_parameter"].sizes == {"adhesion_range": 2}
    one = (1e-3 * 0.05**2 / 1e6**2) ** (1 / 3) / 3e-10
    assert found["tabor_parameter"][0].item() == pytest.approx(one, rel=1e-14)
    np.testing.assert_allclose(found["adhesion_range_over_R"], [3e-7, 1e-3], rtol=1e-15)
    assert (
        gr.solve(k=0.0, nu=0.3, modulus=500.0, A=[0.0, 0.1], lambda_over_R=0.1, outputs="wave_slope")["status"].sum()
        == 0
    )


def test_a_scene_without_value_has_none_of_them() -> None:
    found = gr.solve(
        k=0.0, nu=0.3, modulus=5000.0, A=0.1, lambda_over_R=0.1, a_max_over_a2=1.0, outputs=list(VALIDITY[2:])
    )
    assert found["status"].item() == 64
    assert all(np.isnan(found[name].item()) for name in VALIDITY[2:])


@pytest.mark.parametrize(
    ("more", "beyond"),
    [
        ({}, {"wave_slope": 2}),
        ({"profile": {"harmonics": [{"n": 1, "cos": 0.0, "sin": 0.2}]}}, {}),
        ({"outputs": ["pull_off_force", "wave_slope"]}, {"wave_slope": 2}),
        (
            {
                "outputs": [*VALIDITY],
                "parameters": {"A": [0.0, 1e-5, 0.05, 0.2], "adhesion_range_over_R": [1e-5, 0.01]},
            },
            {"tabor_parameter": 4, "wave_tabor_parameter": 1, "wave_slope": 2, "johnson_alpha": 2},
        ),
    ],
)
def test_run_and_info_count_what_is_beyond_the_model(
    more: dict[str, Any], beyond: dict[str, int], gradhesion: Call, tmp_path: Path, write_study: Callable[[str], Path]
) -> None:
    """Two of four amplitudes have 2 pi A above 0.5, and there chi is above 1/2 and loading not one disc."""
    numbers = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}
    numbers |= {"A": [0.01, 0.05, 0.1, 0.2]} | more.get("parameters", {})
    study = {"outputs": ["dissipated_energy"]} | more | {"parameters": numbers}
    result = gradhesion("run", write_study(study_from(study).text), "-o", tmp_path / "out.nc")
    assert result.exit_code == 0
    told = gradhesion("info", tmp_path / "out.nc").stdout.partition("outside the range of the model\n")[2]
    lines = {line.split()[0]: line for line in told.splitlines() if line.startswith("  ")}
    assert {name: int(lines[name].split(" of ")[0].split()[-1]) for name in VALIDITY if name in lines} == beyond
    if study["outputs"] == ["dissipated_energy"]:
        assert ("slopes above 0.5 in 2 of 4 scenes" in result.stderr) == ("wave_slope" in beyond)
        assert ("not one disc in 2 of 4 scenes" in result.stderr) == ("wave_slope" in beyond)
    if study["outputs"] == [*VALIDITY]:
        assert gradhesion("verify", tmp_path / "out.nc").exit_code == 2, "there is nothing to recompute"
