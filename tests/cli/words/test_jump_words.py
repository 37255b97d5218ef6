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

from gradhesion.cli.names.curves import CURVES, INTEGERS
from gradhesion.core import draw_curves, solve
from gradhesion.core.problem.inputs import INPUTS

Call = Callable[..., Result]
VARIABLES = [name for name in CURVES["jumps"] if name != "jump_count"]
PUNCH = {"k": 0.31, "lambda_over_R": 0.17, "A": [0.0, 0.071, 0.3], "a_max_over_R": [0.44, float("inf")]}
ONE = {"A": 0.3, "a_max_over_R": 0.4}


@pytest.fixture
def written(made: Callable[..., Path]) -> Callable[..., Path]:
    """Six scenes: smooth, wavy and very wavy, with a rim and without."""

    def make(parameters: dict[str, Any] | None = None, exit_code: int = 0, outputs: Any = ("jumps", "smooth")) -> Path:
        return made(exit_code=exit_code, parameters=PUNCH | (parameters or {}), kind="curve", outputs=[*outputs])

    return make


def test_they_are_a_ragged_array_of_the_jumps_of_each_scene_in_its_order(written: Callable[..., Path]) -> None:
    path = written()
    with netCDF4.Dataset(path) as file:
        count = file["jump_count"]
        assert (count.dimensions, count.dtype, count.sample_dimension) == (
            ("A", "a_max_over_R"),
            np.dtype("i4"),
            "jump",
        )
        for name in VARIABLES:
            assert (file[name].dimensions, file[name].dtype) == (("jump",), np.dtype(INTEGERS.get(name, "f8")))
            assert not {"coordinates", "ancillary_variables", "_FillValue"} & {*file[name].ncattrs()}
    with xarray.open_dataset(path) as dataset:
        ends = np.cumsum(dataset["jump_count"].values.ravel())
        assert ends[-1] == dataset.sizes["jump"]
        for number, (i, j) in enumerate(np.ndindex(3, 2)):
            scene = dataset.isel(A=i, a_max_over_R=j)
            parameters = {name: scene[name].item() for name in INPUTS if name in scene}
            own = dataset.isel(jump=slice(ends[number] - scene["jump_count"].item(), ends[number]))
            for name, values in draw_curves(parameters, ["jumps"])[0].items():
                np.testing.assert_array_equal(own[name] if name != "jump_count" else scene[name], values)
            cycle = solve(parameters, ["dissipated_energy", "loading_jumps", "unloading_jumps"])
            assert scene["jump_count"] == cycle["loading_jumps"] + cycle["unloading_jumps"]
            energies = own["jump_energy"].values
            assert abs(energies.sum() - cycle["dissipated_energy"]) <= 1e-12 * np.abs(energies).sum()


@pytest.mark.parametrize("asked", ["jump_energy", "jump_count"])
def test_a_single_variable_brings_the_count_along(asked: str, gradhesion: Call, written: Callable[..., Path]) -> None:
    path = written(ONE, outputs=[asked])
    with xarray.open_dataset(path) as dataset:
        assert set(dataset.data_vars) == {"jump_count", asked, "status"}
        assert f"jumps: {dataset['jump_count'].item()} per scene" in gradhesion("info", path).stdout


def test_info_tells_how_many_and_which_is_the_largest(gradhesion: Call, written: Callable[..., Path]) -> None:
    path = written()
    told = " ".join(gradhesion("info", path).stdout.split())
    with xarray.open_dataset(path) as dataset:
        counts, energies = dataset["jump_count"].values, dataset["jump_energy"].values
        largest = int(energies.argmax())
        i, j = np.unravel_index(np.flatnonzero(counts.ravel().cumsum() > largest)[0], counts.shape)
        assert counts.min() == 2, "the smooth punch jumps in and out"
        for number in (
            f"2 to {counts.max()} per scene, {counts.sum()} in all",
            f" {int(dataset['jump_unloading'].sum())} from or to the rim {int(dataset['jump_at_rim'].sum())} ",
            f" {energies.min():.6g} to {energies.max():.6g} ",
            f" {float(dataset['jump_indentation'][largest]):.6g}, from",
            f"A = {dataset['A'].values[i]:g}, a_max_over_R = {dataset['a_max_over_R'].values[j]:g}",
        ):
            assert number in told, number


def test_info_lists_them_as_csv_without_losing_a_digit(gradhesion: Call, written: Callable[..., Path]) -> None:
    path = written()
    result = gradhesion("info", "--jumps", path)
    assert (result.exit_code, result.stderr) == (0, "")
    header, *rows = csv.reader(result.stdout.splitlines())
    assert header == ["A", "a_max_over_R", *VARIABLES]
    listed = dict(zip(header, np.array(rows, dtype=float).T, strict=True))
    with xarray.open_dataset(path) as dataset:
        for name in VARIABLES:
            np.testing.assert_array_equal(listed[name], dataset[name])
        for name, values in zip(header, xarray.broadcast(dataset["A"], dataset["a_max_over_R"]), strict=False):
            np.testing.assert_array_equal(listed[name], np.repeat(values.values.ravel(), dataset["jump_count"].values.ravel()))  # fmt: skip


def test_scenes_without_jumps_are_passed_over(gradhesion: Call, written: Callable[..., Path]) -> None:
    # the first has waves beyond every count of folds
    path = written(ONE | {"lambda_over_R": [1e-9, 0.2]}, 3, ["jumps"])
    with xarray.open_dataset(path) as dataset:
        assert dataset["jump_count"].values.tolist() == [0, dataset.sizes["jump"]]
        assert dataset.sizes["jump"] > 2
    lines = gradhesion("info", "--jumps", path).stdout.splitlines()
    assert {line.split(",")[0] for line in lines[1:]} == {"0.2"}
    path = written(ONE | {"a_max_over_R": [0.4], "lambda_over_R": 1e-9}, 3, ["jumps"])
    assert "jumps: 0 per scene, 0 in all" in gradhesion("info", path).stdout
    assert gradhesion("info", "--jumps", path).stdout.splitlines() == [",".join(["a_max_over_R", *VARIABLES])]


@pytest.mark.parametrize("command", [["info", "--jumps"], ["plot"], ["explore"]])
def test_what_has_no_jumps_or_nothing_else_says_so(
    command: list[str], gradhesion: Call, dataset_file: Path, written: Callable[..., Path]
) -> None:
    path = dataset_file if "--jumps" in command else written(ONE, outputs=["jumps"])
    result = gradhesion(*command, path)
    assert (result.exit_code, result.stdout, len(result.stderr.splitlines())) == (2, "", 1)
    assert 'add "' in result.stderr, "what to do"
