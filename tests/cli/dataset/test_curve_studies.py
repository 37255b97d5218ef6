"""Curve studies: what their dataset holds, of jumps and states too, whatever fails, and what `gradhesion info` tells of it."""

import csv
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.names.curves import CURVES, EXTENTS, INTEGERS, MEANINGS, RAGGED, STATE_CURVES
from gradhesion.cli.study import study_from
from gradhesion.cli.study.study import Study
from gradhesion.core import FAILED, FLAGS, draw_curves
from gradhesion.core.draw import states
from gradhesion.core.problem.inputs import INPUTS
from tests.cli.conftest import Call, Made, Told

OWN = {curve: own for curve, own in CURVES.items() if curve not in STATE_CURVES}  # these are below
PADDED = [curve for curve in OWN if curve not in RAGGED]
PUNCH = {"k": 0.31, "lambda_over_R": 0.17, "A": [0.0, 0.023, 0.071], "a_max_over_R": [0.41, float("inf")]}
"""Three punches, one of them smooth, with a rim and without."""
WAVY = {"A": [0.0, 0.071, 0.3], "a_max_over_R": [0.44, float("inf")]}
JUMPS = ["jumps", "smooth"]
ONE = {"A": 0.3, "a_max_over_R": 0.4}
VARIABLES = [name for name in CURVES["jumps"] if name != "jump_count"]
SCENE = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.055}


@pytest.fixture
def drawn(made: Made) -> Made:
    """Run the small study of curves with other keys."""

    def draw(parameters: dict[str, Any] | None = None, outputs: Any = tuple(OWN), exit_code: int = 0) -> Path:
        return made(exit_code=exit_code, parameters=PUNCH | (parameters or {}), kind="curve", outputs=[*outputs])

    return draw


def test_a_curve_stands_for_its_variables_and_a_single_scene_has_no_other_dimension(data: dict[str, Any]) -> None:
    study = study_from(data | {"kind": "curve", "outputs": ["path_load", "smooth", "load", "path_jump"]})
    assert study.outputs == ("load", "path_load", "path_jump", *CURVES["smooth"])
    assert set(compute(study).data_vars) == {*study.outputs, "status"}
    one = gr.curves(data["parameters"] | {"k": 0.3, "lambda_over_R": 0.2} | ONE, "envelope")
    assert set(one.sizes) == {"envelope_point"}
    assert one["status"].shape == ()
    assert one["envelope_contact_radius"][-1] == 0.4


def test_the_dataset_keeps_its_contract_and_info_tells_it_in_words(gradhesion: Call, drawn: Made) -> None:
    with netCDF4.Dataset(path := drawn()) as file:
        assert list(file.dimensions) == ["A", "a_max_over_R", *(EXTENTS[curve] for curve in OWN)]
        for curve in PADDED:
            for name, long_name in CURVES[curve].items():
                variable = file[name]
                assert variable.dimensions == ("A", "a_max_over_R", EXTENTS[curve])
                assert variable.dtype == np.dtype(INTEGERS.get(name, "f8"))
                blank = variable.getncattr("_FillValue")
                assert blank == -1 if name in INTEGERS else np.isnan(blank)
                assert (variable.units, variable.long_name) == ("1", long_name)
                assert variable.coordinates == "k nu modulus c0_over_R lambda_over_R steep_contact"
                assert variable.ancillary_variables == "status"
                filters = variable.filters()
                assert (filters["zlib"], filters["complevel"], filters["shuffle"]) == (True, 1, True)
        for name, meanings in MEANINGS.items():
            assert file[name].flag_values.tolist() == [0, 1]
            assert file[name].flag_values.dtype == file[name].dtype
            assert file[name].flag_meanings == meanings
        assert (file["status"].dimensions, file["status"].dtype) == (("A", "a_max_over_R"), np.int8)
    told = " ".join(gradhesion("info", path).stdout.split())
    with opened(path) as dataset:
        points = dataset["load"].count("point")
        loading = ((dataset["path_jump"] == 1) & (dataset["path_unloading"] == 0)).sum("path_point")
        least, greatest = float(dataset["load"].min()), float(dataset["load"].max())
    assert int(loading.max()) > 1
    assert f"equilibrium: {int(points.min())} to {int(points.max())} points per scene" in told
    assert f"jumps on loading 1 to {int(loading.max())}" in told
    assert f" load {least:.6g} to {greatest:.6g} " in told


def test_each_scene_is_the_curve_of_the_core_padded_to_the_longest(drawn: Made) -> None:
    with xarray.open_dataset(drawn(), mask_and_scale=False) as dataset:
        lengths: dict[str, list[int]] = {EXTENTS[curve]: [] for curve in PADDED}
        for i, j in np.ndindex(3, 2):
            scene = dataset.isel(A=i, a_max_over_R=j)
            parameters = {name: scene[name].item() for name in INPUTS if name in scene}
            found, status = draw_curves(parameters, PADDED)
            assert scene["status"] == status
            for name, values in found.items():
                row = scene[name].values
                np.testing.assert_array_equal(row[: values.size], values)
                rest = row[values.size :]
                assert (rest == -1).all() if name in INTEGERS else np.isnan(rest).all()
            for curve in PADDED:
                lengths[EXTENTS[curve]].append(found[next(iter(CURVES[curve]))].size)
        assert {name: dataset.sizes[name] for name in lengths} == {name: max(sizes) for name, sizes in lengths.items()}
        assert len(set(lengths["point"])) > 1, "some are padded"


def test_scenes_without_curves_lose_nothing_and_have_no_jumps(drawn: Made, gradhesion: Call) -> None:
    # waves beyond every count of folds: the exact curve cannot be drawn, the smooth one can
    path = drawn(ONE | {"lambda_over_R": [1e-9, 0.2]}, ["path", "smooth", "jumps"], 3)
    with xarray.open_dataset(path) as dataset:
        assert (dataset["status"].values & FAILED).tolist() == [FLAGS["no_value"], 0]
        failed, fine = dataset.isel(lambda_over_R=0), dataset.isel(lambda_over_R=1)
        assert failed["path_load"].isnull().all()
        assert failed["path_branch"].isnull().all()
        assert np.isfinite(fine["path_load"]).all()
        np.testing.assert_allclose(failed["smooth_load"], fine["smooth_load"], rtol=1e-12)  # but for its units
        assert dataset["jump_count"].values.tolist() == [0, dataset.sizes["jump"]]
        assert dataset.sizes["jump"] > 2
    lines = gradhesion("info", "--jumps", path).stdout.splitlines()
    assert {line.split(",")[0] for line in lines[1:]} == {"0.2"}
    path = drawn(ONE | {"a_max_over_R": [0.4], "lambda_over_R": 1e-9}, ["path_load", "jumps"], 3)
    told = gradhesion("info", path).stdout
    assert "no value in any scene" in told
    assert "jumps: 0 per scene, 0 in all" in told
    assert gradhesion("info", "--jumps", path).stdout.splitlines() == [",".join(["a_max_over_R", *VARIABLES])]
    assert gradhesion("plot", path).exit_code == 2
    assert not path.with_suffix(".png").exists()


def test_they_are_a_ragged_array_of_the_jumps_of_each_scene_in_its_order(drawn: Made) -> None:
    path = drawn(WAVY, JUMPS)
    with netCDF4.Dataset(path) as file:
        count = file["jump_count"]
        assert (count.dimensions, count.dtype) == (("A", "a_max_over_R"), np.dtype("i4"))
        assert count.sample_dimension == "jump"
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


@pytest.mark.parametrize("asked", ["jump_energy", "jump_count"])
def test_a_single_variable_brings_the_count_along(asked: str, gradhesion: Call, drawn: Made) -> None:
    path = drawn(ONE, [asked])
    with xarray.open_dataset(path) as dataset:
        assert set(dataset.data_vars) == {"jump_count", asked, "status"}
        assert f"jumps: {dataset['jump_count'].item()} per scene" in gradhesion("info", path).stdout


def test_info_tells_how_many_and_the_largest_and_lists_them_as_csv(gradhesion: Call, drawn: Made) -> None:
    path = drawn(WAVY, JUMPS)
    told = " ".join(gradhesion("info", path).stdout.split())
    with xarray.open_dataset(path) as dataset:
        counts, energies = dataset["jump_count"].values, dataset["jump_energy"].values
        largest = int(energies.argmax())
        i, j = np.unravel_index(np.flatnonzero(counts.ravel().cumsum() > largest)[0], counts.shape)
        assert counts.min() == 2, "the smooth punch jumps in and out"
        for number in (
            f"2 to {counts.max()} per scene, {counts.sum()} in all",
            f" unloading {int(dataset['jump_unloading'].sum())} at the rim {int(dataset['jump_at_rim'].sum())} ",
            f" {energies.min():.6g} to {energies.max():.6g} ",
            f"jump_indentation = {float(dataset['jump_indentation'][largest]):.6g}, ",
            f"A = {dataset['A'].values[i]:g}, a_max_over_R = {dataset['a_max_over_R'].values[j]:g}",
        ):
            assert number in told, number

    result = gradhesion("info", "--jumps", path, code=0)
    assert result.stderr == ""
    header, *rows = csv.reader(result.stdout.splitlines())
    assert header == ["A", "a_max_over_R", *VARIABLES]
    listed = dict(zip(header, np.array(rows, dtype=float).T, strict=True))
    with xarray.open_dataset(path) as dataset:
        for name in VARIABLES:
            np.testing.assert_array_equal(listed[name], dataset[name])
        for name, values in zip(header, xarray.broadcast(dataset["A"], dataset["a_max_over_R"]), strict=False):
            np.testing.assert_array_equal(listed[name], np.repeat(values.values.ravel(), dataset["jump_count"].values.ravel()))  # fmt: skip


@pytest.mark.parametrize("command", [["info", "--jumps"], ["plot"], ["explore"]])
def test_no_jumps_or_only_jumps_is_said(command: list[str], refusal: Told, dataset_file: Path, drawn: Made) -> None:
    assert 'add "' in refusal(*command, dataset_file if "--jumps" in command else drawn(ONE, ["jumps"])), "what to do"


def states_of(outputs: list[str], radii: list[Any] | None = None, **more: Any) -> Study:
    data: dict[str, Any] = {"kind": "curve", "outputs": outputs, "parameters": SCENE | {"a_max_over_R": 0.45} | more}
    return study_from(data | ({"states": {"contact_radius_over_R": radii}} if radii is not None else {}))


def test_named_states_and_their_curves() -> None:
    dataset = compute(states_of(["pressure", "surface"]))
    assert dataset["state"].values.tolist() == ["turning_point", "pull_off", "jump_out"]
    scene = SCENE | {"a_max_over_R": 0.45}
    expected = states.draw_states(scene, states.named_states(scene)[0], ["pressure", "surface"])
    assert {name for name in dataset.data_vars if name != "status"} == set(expected)
    for name, values in expected.items():
        assert dataset[name].dims == ("state", name.split("_")[0] + "_point")
        np.testing.assert_array_equal(dataset[name].values, values)


def test_given_radii_along_an_axis() -> None:
    dataset = compute(states_of(["pressure"], [0.1, 0.4], A=[0.0, 0.055]))
    assert dataset["pressure"].dims == ("A", "state", "pressure_point")
    assert dataset["state"].values.tolist() == [0.1, 0.4]
    # each scene has as many points as it needs, the others are padded
    for i, amplitude in enumerate((0.0, 0.055)):
        scene = SCENE | {"a_max_over_R": 0.45, "A": amplitude}
        own = states.draw_states(scene, states.equilibrium_states(scene, [0.1, 0.4]), ["pressure"])["pressure"]
        values = dataset["pressure"].values[i]
        np.testing.assert_array_equal(values[:, : own.shape[1]], own)
        assert np.isnan(values[:, own.shape[1] :]).all()


def test_states_in_units() -> None:
    ball = {"nu": 0.3, "A": 0.0, "R": "2 um", "E_star": "1 MPa", "work_of_adhesion": "50 mJ/m^2"}
    dataset = gr.curves(ball, "pressure", k=0.0, contact_radius_over_R=[0.5])
    assert dataset["pressure_si"].attrs["units"] == "Pa"
    assert dataset["pressure_si"].attrs["long_name"] == "contact pressure p, positive in compression"
    np.testing.assert_allclose(dataset["pressure_si"], dataset["pressure"] * 0.05 / 2e-6)
    np.testing.assert_allclose(dataset["pressure_radius_si"], dataset["pressure_radius"] * 2e-6)
