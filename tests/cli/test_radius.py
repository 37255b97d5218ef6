"""The radius of the punch over that of the jump-in: `a_max_over_a2` in the place of `a_max_over_R`."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.core import FAILED, FLAGS, solve
from gradhesion.core.closed.similarity import jump_in_radius_of_envelope

Call = Callable[..., Result]


@pytest.fixture
def over_a2(data: dict[str, Any]) -> dict[str, Any]:
    """The small study with a_max in units of a_2."""
    del data["parameters"]["a_max_over_R"]
    data["parameters"]["a_max_over_a2"] = [0.7, 2.0, float("inf")]
    return data


def radii_of(dataset: xarray.Dataset) -> xarray.DataArray:
    names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A")
    given = xarray.broadcast(*(dataset[name] for name in names))
    return xarray.DataArray(jump_in_radius_of_envelope(*(one.values for one in given)), dims=given[0].dims, name="a_2")


def test_it_is_an_axis_and_the_radius_follows(over_a2: dict[str, Any]) -> None:
    dataset = compute(study_from(over_a2))
    assert dict(dataset.sizes) == {"k": 2, "lambda_over_R": 3, "A": 2, "a_max_over_a2": 3}
    assert dataset["a_max_over_R"].dims == ("k", "lambda_over_R", "A", "a_max_over_a2")
    assert "a_max_over_R" in dataset["pull_off_force"].coords
    expected = radii_of(dataset).variable * dataset["a_max_over_a2"].variable
    assert expected.dims == dataset["a_max_over_R"].dims
    np.testing.assert_array_equal(dataset["a_max_over_R"], expected)


def test_values_are_those_of_the_radii(over_a2: dict[str, Any]) -> None:
    dataset = compute(study_from(over_a2))
    names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
    parameters = dict(
        zip(names, (one.values for one in xarray.broadcast(*(dataset[name] for name in names))), strict=True)
    )
    for name, values in solve(parameters, over_a2["outputs"]).items():
        np.testing.assert_array_equal(dataset[name], values)


def test_the_file_has_it_as_well_in_whatever_blocks(
    over_a2: dict[str, Any],
    gradhesion: Call,
    write_study: Callable[[str], Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    study = write_study(study_from(over_a2).text)
    computed = compute(load_study(study))
    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    assert gradhesion("run", study, "-o", tmp_path / "x.nc").exit_code == 0
    with xarray.open_dataset(tmp_path / "x.nc") as written:
        assert set(written.coords) == set(computed.coords)
        for name in computed.variables:
            np.testing.assert_array_equal(written[name].values, computed[name].values)
    with netCDF4.Dataset(tmp_path / "x.nc") as file:
        assert file["pull_off_force"].coordinates == "nu modulus c0_over_R a_max_over_R"
        assert "_FillValue" not in file["a_max_over_a2"].ncattrs()
    told = " ".join(gradhesion("info", tmp_path / "x.nc").stdout.split())
    assert "a_max_over_a2 0.7, 2, inf" in told
    assert f"following from these a_max_over_R {float(computed['a_max_over_R'].min()):g} to inf" in told
    assert gradhesion("plot", tmp_path / "x.nc").exit_code == 0


def test_where_there_is_no_jump_in_radius_there_is_no_value(
    over_a2: dict[str, Any], gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    over_a2["parameters"]["A"] = [0.0, 0.023, 9.0]
    result = gradhesion("run", write_study(study_from(over_a2).text), "-o", tmp_path / "x.nc", "--quiet")
    assert result.exit_code == 3
    assert "18 of 54 scenes failed" in result.stderr
    with xarray.open_dataset(tmp_path / "x.nc") as dataset:
        strong, others = dataset.sel(A=9.0), dataset.sel(A=[0.0, 0.023])
        assert ((strong["status"] & FAILED) != 0).all()
        assert strong["pull_off_force"].isnull().all()
        assert strong["a_max_over_R"].isnull().all()
        assert ((others["status"] & FAILED) == 0).all()
        assert np.isfinite(others["pull_off_force"]).all()


@pytest.mark.parametrize("solver", ["envelope", "asymptotic"])
def test_points_and_other_solvers_take_it_too(solver: str, over_a2: dict[str, Any]) -> None:
    lists = {"k": [0.0, 0.2, 0.4], "lambda_over_R": [0.02, 0.03, 0.01], "A": [0.01, 9.0, 0.02]}
    over_a2 |= {"layout": "points", "parameters": over_a2["parameters"] | lists, "method": {"solver": solver}}
    dataset = compute(study_from(over_a2))
    assert dataset["a_max_over_R"].dims == ("scene",)
    assert (dataset["status"].values & FLAGS["no_value"]).tolist() == [0, FLAGS["no_value"], 0]
    assert np.isfinite(dataset["pull_off_force"].values).tolist() == [True, False, True]


def test_a_single_scene(over_a2: dict[str, Any]) -> None:
    single = {"k": 0.2, "lambda_over_R": 0.1, "A": 0.01, "a_max_over_a2": 1.5}
    dataset = compute(study_from(over_a2 | {"parameters": over_a2["parameters"] | single}))
    assert dataset["a_max_over_R"].shape == ()
    assert float(dataset["a_max_over_R"]) == pytest.approx(1.5 * float(radii_of(dataset)), rel=1e-15)


def test_curves_take_it_too(over_a2: dict[str, Any]) -> None:
    parameters = {"k": 0.31, "lambda_over_R": 0.1, "A": [0.01, 9.0], "a_max_over_a2": [1.5, 2.5]}
    over_a2 |= {"kind": "curve", "outputs": ["effective"], "parameters": over_a2["parameters"] | parameters}
    dataset = compute(study_from(over_a2))
    assert (dataset["status"].values & FAILED).tolist() == [[0, 0], 2 * [FLAGS["no_value"]]]
    radii = dataset["a_max_over_R"]
    assert radii.dims == ("A", "a_max_over_a2")
    reached = dataset["effective_contact_radius"].max("effective_point")
    np.testing.assert_allclose(reached[0], radii[0], rtol=1e-15)
    assert reached[1].isnull().all()
