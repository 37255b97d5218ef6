"""Jumps of a curve study: one scene after the other in the dataset, told in words and listed as CSV."""

import csv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.names.curves import CURVES, INTEGERS
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.words.table import jumps_listed
from gradhesion.core import draw_curves, solve
from gradhesion.core.problem.inputs import INPUTS

Call = Callable[..., Result]
VARIABLES = [name for name in CURVES["jumps"] if name != "jump_count"]


@pytest.fixture
def study(data: dict[str, Any]) -> dict[str, Any]:
    """Six scenes: smooth, wavy and very wavy, with a rim and without."""
    parameters = data["parameters"] | {"k": 0.31, "lambda_over_R": 0.17, "A": [0.0, 0.071, 0.3]}
    parameters["a_max_over_R"] = [0.44, float("inf")]
    return data | {"kind": "curve", "outputs": ["jumps", "smooth"], "parameters": parameters}


@pytest.fixture
def dataset_file(
    study: dict[str, Any], gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path
) -> Callable[..., Path]:
    def make(*sets: str, exit_code: int = 0) -> Path:
        path = tmp_path / "jumps.nc"
        toml = write_study(study_from(study).text)
        result = gradhesion("run", toml, "-o", path, "--quiet", *(f"--set={one}" for one in sets))
        assert result.exit_code == exit_code, result.stderr
        return path

    return make


def test_they_are_a_ragged_array(dataset_file: Callable[..., Path]) -> None:
    with netCDF4.Dataset(dataset_file()) as file:
        count = file["jump_count"]
        assert count.dimensions == ("A", "a_max_over_R")
        assert (count.dtype, count.sample_dimension) == (np.dtype("i4"), "jump")
        assert count.coordinates == "k nu modulus c0_over_R lambda_over_R steep_contact"
        assert file.dimensions["jump"].size == count[:].sum()
        for name in VARIABLES:
            variable = file[name]
            assert variable.dimensions == ("jump",)
            assert variable.dtype == np.dtype(INTEGERS.get(name, "f8"))
            assert (variable.units, variable.long_name) == ("1", CURVES["jumps"][name])
            assert not {"coordinates", "ancillary_variables", "_FillValue"} & {*variable.ncattrs()}


def test_each_scene_has_its_jumps_in_the_order_of_the_scenes(dataset_file: Callable[..., Path]) -> None:
    with xarray.open_dataset(dataset_file()) as dataset:
        begun = 0
        for i in range(3):
            for j in range(2):
                scene = dataset.isel(A=i, a_max_over_R=j)
                parameters = {name: scene[name].item() for name in INPUTS if name in scene}
                found, _ = draw_curves(parameters, ["jumps"])
                items = slice(begun, begun + scene["jump_count"].item())
                for name in VARIABLES:
                    np.testing.assert_array_equal(dataset[name][items], found[name])
                cycle = solve(parameters, ["dissipated_energy", "loading_jumps", "unloading_jumps"])
                assert scene["jump_count"] == cycle["loading_jumps"] + cycle["unloading_jumps"]
                energies = dataset["jump_energy"][items].values
                assert abs(energies.sum() - cycle["dissipated_energy"]) <= 1e-12 * np.abs(energies).sum()
                begun = items.stop
        assert begun == dataset.sizes["jump"]


@pytest.mark.parametrize("layout", ["grid", "points"])
def test_the_file_and_the_notebook_have_the_same_whatever_the_threads(
    layout: str, study: dict[str, Any], dataset_file: Callable[..., Path]
) -> None:
    study["layout"] = layout
    if layout == "points":
        study["parameters"]["a_max_over_R"] = [0.41, float("inf"), 0.3]
    whole = compute(study_from(study), threads=1)
    xarray.testing.assert_identical(compute(study_from(study), threads=3), whole)
    with xarray.open_dataset(dataset_file()) as written:
        assert set(written.variables) == set(whole.variables)
        for name, variable in whole.variables.items():
            assert written[name].dtype == variable.dtype
            assert written[name].dims == variable.dims
            np.testing.assert_array_equal(written[name], variable)


@pytest.mark.parametrize("asked", ["jump_energy", "jump_count"])
def test_a_single_variable_brings_the_count_along(
    asked: str, study: dict[str, Any], gradhesion: Call, dataset_file: Callable[..., Path]
) -> None:
    assert study_from(study | {"outputs": [asked]}).outputs == tuple(dict.fromkeys(["jump_count", asked]))
    path = dataset_file(f"outputs=['{asked}']", "parameters.A=0.071", "parameters.a_max_over_R=0.3")
    with xarray.open_dataset(path) as dataset:
        assert set(dataset.data_vars) == {"jump_count", asked, "status"}
        assert dataset["jump_count"].shape == ()
        told = gradhesion("info", path).stdout
        assert f"jumps: {dataset['jump_count'].item()} per scene" in told


def test_info_tells_them_in_words(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file()
    told = " ".join(gradhesion("info", path).stdout.split())
    with xarray.open_dataset(path) as dataset:
        counts, energies = dataset["jump_count"].values, dataset["jump_energy"].values
        unloading, at_rim = int(dataset["jump_unloading"].sum()), int(dataset["jump_at_rim"].sum())
        largest = int(energies.argmax())
        depth = float(dataset["jump_indentation"][largest])
        ends = counts.ravel().cumsum()
        i, j = np.unravel_index(np.flatnonzero(ends > largest)[0], counts.shape)
        where = f"A = {dataset['A'].values[i]:g}, a_max_over_R = {dataset['a_max_over_R'].values[j]:g}"
    assert at_rim > 0
    assert counts.min() == 2, "the smooth punch jumps in and out"
    for words in (
        f"jumps: 2 to {counts.max()} per scene, {counts.sum()} in all on unloading {unloading} from or to the rim {at_rim}",
        f"jump_energy {energies.min():.6g} to {energies.max():.6g} energy dissipated by the jump",
        f"the largest dissipates {energies.max():.6g}, on ",
        f" at the depth {depth:.6g}, from the radius ",
        f", {where} status: 6 of 6 scenes",
    ):
        assert words in told, words


def test_info_lists_them_as_csv_without_losing_a_digit(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file()
    result = gradhesion("info", "--jumps", path)
    assert (result.exit_code, result.stderr) == (0, "")
    with opened(path) as dataset:
        assert "\n".join(jumps_listed(dataset, path, items=5)) + "\n" == result.stdout
    header, *rows = csv.reader(result.stdout.splitlines())
    assert header == ["A", "a_max_over_R", *VARIABLES]
    listed = np.array(rows, dtype=float).T
    with xarray.open_dataset(path) as dataset:
        for name, values in zip(header, listed, strict=True):
            if name in VARIABLES:
                np.testing.assert_array_equal(values, dataset[name])
        amplitude, rim = xarray.broadcast(dataset["A"], dataset["a_max_over_R"])
        counts = dataset["jump_count"].values.ravel()
        np.testing.assert_array_equal(listed[0], np.repeat(amplitude.values.ravel(), counts))
        np.testing.assert_array_equal(listed[1], np.repeat(rim.values.ravel(), counts))


def test_scenes_without_jumps_are_passed_over(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    # the first has waves beyond every count of folds
    sets = ["outputs=['jumps']", "parameters.A=0.3", "parameters.a_max_over_R=0.4"]
    path = dataset_file(*sets, "parameters.lambda_over_R=[1e-9, 0.2]", exit_code=3)
    with xarray.open_dataset(path) as dataset:
        assert dataset["jump_count"].values.tolist() == [0, dataset.sizes["jump"]]
        assert dataset.sizes["jump"] > 2
    lines = gradhesion("info", "--jumps", path).stdout.splitlines()
    assert {line.split(",")[0] for line in lines[1:]} == {"0.2"}
    path.unlink()
    path = dataset_file("outputs=['jumps']", "parameters.lambda_over_R=1e-9", "parameters.A=0.3", exit_code=3)
    assert "jumps: 0 per scene, 0 in all" in gradhesion("info", path).stdout
    assert gradhesion("info", "--jumps", path).stdout.splitlines() == [",".join(["a_max_over_R", *VARIABLES])]


def test_what_has_no_jumps_says_so(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "map.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    result = gradhesion("info", "--jumps", path)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr == f'{path}: has no jumps; add "jumps" to the outputs of a study of kind "curve" and run it\n'


def test_jumps_alone_are_no_picture(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file("outputs=['jumps']")
    result = gradhesion("plot", path)
    assert result.exit_code == 2
    assert 'add "path" to the outputs of the study' in result.stderr
    path.unlink()
    assert gradhesion("plot", dataset_file("outputs=['jumps', 'path']")).exit_code == 0
