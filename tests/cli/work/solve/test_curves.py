"""Curve studies: what their dataset holds, whatever the threads, and what `gradhesion info` tells of it."""

import os
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
from gradhesion.cli.names.curves import CURVES, EXTENTS, INTEGERS, MEANINGS, RAGGED, STATE_CURVES
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.cli.words.curve_words import curve_lines
from gradhesion.core import FAILED, FLAGS, draw_curves, solve
from gradhesion.core.draw import draw
from gradhesion.core.problem import names
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.problem.outputs import CURVES as DECLARED

Call = Callable[..., Result]


OWN = {curve: own for curve, own in CURVES.items() if curve not in STATE_CURVES}  # these have test_states.py
PADDED = [curve for curve in OWN if curve not in RAGGED]


@pytest.fixture
def curve_data(data: dict[str, Any]) -> dict[str, Any]:
    """A small curve study: three punches, one of them smooth, with a rim and without."""
    parameters = data["parameters"] | {"k": 0.31, "lambda_over_R": 0.17, "A": [0.0, 0.023, 0.071]}
    parameters["a_max_over_R"] = [0.41, float("inf")]
    return data | {"kind": "curve", "outputs": [*OWN], "parameters": parameters}


@pytest.fixture
def curve_file(curve_data: dict[str, Any], write_study: Callable[[str], Path]) -> Path:
    return write_study(study_from(curve_data).text)


@pytest.fixture
def dataset_file(gradhesion: Call, curve_file: Path, tmp_path: Path) -> Path:
    path = tmp_path / "curves.nc"
    assert gradhesion("run", curve_file, "-o", path, "--quiet").exit_code == 0
    return path


def test_the_names_are_those_of_the_core() -> None:
    counts = {*RAGGED.values()}
    of_core = {curve: tuple(name for name in own if name not in counts) for curve, own in OWN.items()}
    assert of_core == names.CURVES
    general = tuple(name for name, curve in DECLARED.items() if not curve.needs_depth)
    assert (*draw.GENERAL_CURVES, *STATE_CURVES) == general
    assert set(INTEGERS) - counts == set(draw.INTEGERS)
    assert list(EXTENTS) == list(CURVES)
    assert set(MEANINGS) < set(INTEGERS)


def test_a_curve_stands_for_its_variables(curve_data: dict[str, Any]) -> None:
    study = study_from(curve_data | {"outputs": ["path_load", "smooth", "load", "path_jump"]})
    assert study.outputs == ("load", "path_load", "path_jump", *CURVES["smooth"])
    assert study.scenes == 6
    assert set(compute(study).data_vars) == {*study.outputs, "status"}


def test_the_dataset_keeps_its_contract(dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file) as file:
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
        assert file["status"].dimensions == ("A", "a_max_over_R")
        assert file["status"].dtype == np.int8
        assert file.Conventions == "CF-1.11"
        assert all(name in file.variables for name in PARAMETERS)


def test_each_scene_is_the_curve_of_the_core_padded_to_the_longest(dataset_file: Path) -> None:
    with xarray.open_dataset(dataset_file, mask_and_scale=False) as dataset:
        lengths: dict[str, list[int]] = {EXTENTS[curve]: [] for curve in PADDED}
        for i in range(3):
            for j in range(2):
                scene = dataset.isel(A=i, a_max_over_R=j)
                found, status = draw_curves({name: scene[name].item() for name in INPUTS if name in scene}, PADDED)
                assert scene["status"] == status
                for name, values in found.items():
                    row = scene[name].values
                    np.testing.assert_array_equal(row[: values.size], values)
                    rest = row[values.size :]
                    assert (rest == -1).all() if name in INTEGERS else np.isnan(rest).all()
                for curve in PADDED:
                    lengths[EXTENTS[curve]].append(found[next(iter(CURVES[curve]))].size)
        assert {extent: dataset.sizes[extent] for extent in lengths} == {
            extent: max(points) for extent, points in lengths.items()
        }
        assert len(set(lengths["point"])) > 1, "some are padded"


def test_the_path_is_that_of_the_map(curve_data: dict[str, Any]) -> None:
    dataset = compute(study_from(curve_data))
    parameters = {name: dataset[name].values for name in INPUTS if name in dataset}
    parameters["A"] = parameters["A"][:, None]
    expected = solve(parameters, ["pull_off_force", "loading_jumps", "unloading_jumps", "delta_jump_out"])
    jumps = dataset["path_jump"] == 1
    unloading = dataset["path_unloading"] == 1
    np.testing.assert_array_equal((jumps & ~unloading).sum("path_point"), expected["loading_jumps"])
    np.testing.assert_array_equal((jumps & unloading).sum("path_point"), expected["unloading_jumps"])
    np.testing.assert_allclose(-dataset["load"].min("point"), expected["pull_off_force"], rtol=1e-13)
    np.testing.assert_allclose(
        dataset["path_indentation"].min("path_point"), expected["delta_jump_out"], rtol=1e-12, atol=1e-16
    )


def test_the_file_and_the_notebook_have_the_same_dataset(dataset_file: Path, curve_file: Path) -> None:
    with xarray.open_dataset(dataset_file) as written:
        computed = compute(load_study(curve_file))
        for one in (computed, written):
            del one.attrs["history"]
            for variable in one.variables.values():
                for key in ("flag_masks", "flag_values"):
                    if key in variable.attrs:
                        variable.attrs[key] = np.atleast_1d(variable.attrs[key]).tolist()
        xarray.testing.assert_identical(computed, written)
        assert {name: v.dtype for name, v in computed.variables.items()} == {
            name: v.dtype for name, v in written.variables.items()
        }


@pytest.mark.parametrize("layout", ["grid", "points"])
def test_values_do_not_depend_on_threads_or_chunks(
    layout: str, curve_data: dict[str, Any], tmp_path: Path, gradhesion: Call
) -> None:
    if layout == "points":
        curve_data["layout"] = layout
        curve_data["parameters"]["a_max_over_R"] = [0.41, 0.2, float("inf")]
    study = study_from(curve_data)
    whole = compute(study, threads=1)
    assert dict(whole["status"].sizes) == ({"scene": 3} if layout == "points" else {"A": 3, "a_max_over_R": 2})
    xarray.testing.assert_identical(compute(study, threads=3), whole)
    (tmp_path / "study.toml").write_text(study.text)
    result = gradhesion("run", tmp_path / "study.toml", "-o", tmp_path / "x.nc", "--threads", "2")
    assert result.exit_code == 0
    with xarray.open_dataset(tmp_path / "x.nc") as written:
        for name in whole.variables:
            np.testing.assert_array_equal(written[name].values, whole[name].values)


def test_a_single_scene_has_no_dimension_but_those_of_its_curves(
    gradhesion: Call, curve_file: Path, tmp_path: Path
) -> None:
    single = ["--set=parameters.A=0.02", "--set=parameters.a_max_over_R=0.3", "--set=outputs=['envelope']"]
    result = gradhesion("run", curve_file, "-o", tmp_path / "x.nc", *single)
    assert result.exit_code == 0
    assert "1 scene in" in result.stderr
    with xarray.open_dataset(tmp_path / "x.nc") as dataset:
        assert set(dataset.sizes) == {"envelope_point"}
        assert dataset["status"].shape == ()
        assert dataset["envelope_contact_radius"][-1] == 0.3


def test_scenes_without_curves_lose_nothing(gradhesion: Call, curve_file: Path, tmp_path: Path) -> None:
    # waves beyond every count of folds: the exact curve cannot be drawn, the smooth one can
    sets = ["--set=parameters.lambda_over_R=[1e-9, 0.2]", "--set=parameters.a_max_over_R=0.4", "--set=parameters.A=0.3"]
    result = gradhesion(
        "run", curve_file, "-o", tmp_path / "x.nc", "--quiet", *sets, "--set=outputs=['path', 'smooth']"
    )
    assert result.exit_code == 3
    assert "1 of 2 scenes failed" in result.stderr
    with xarray.open_dataset(tmp_path / "x.nc") as dataset:
        assert (dataset["status"].values & FAILED).tolist() == [FLAGS["no_value"], 0]
        failed, fine = dataset.isel(lambda_over_R=0), dataset.isel(lambda_over_R=1)
        assert failed["path_load"].isnull().all()
        assert failed["path_branch"].isnull().all()
        assert np.isfinite(fine["path_load"]).all()
        np.testing.assert_allclose(failed["smooth_load"], fine["smooth_load"], rtol=1e-12)  # but for its units
    told = gradhesion("info", tmp_path / "x.nc").stdout
    assert "path: 0 to " in told
    assert "status: 1 of 2 scenes (50.0%) have values" in told


def test_all_scenes_may_fail(gradhesion: Call, curve_file: Path, tmp_path: Path) -> None:
    sets = ["--set=parameters.lambda_over_R=1e-9", "--set=parameters.A=0.3", "--set=outputs=['path_load']"]
    assert gradhesion("run", curve_file, "-o", tmp_path / "x.nc", "--quiet", *sets).exit_code == 3
    told = gradhesion("info", tmp_path / "x.nc").stdout
    assert "path_load                      no value in any scene" in told
    result = gradhesion("plot", tmp_path / "x.nc")
    assert result.exit_code == 2
    assert not (tmp_path / "x.png").exists()


def test_what_stood_there_stays_until_all_is_drawn(
    gradhesion: Call, curve_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "data"
    folder.mkdir()
    (folder / "x.nc").write_text("precious")
    drawn = []

    def failing(*arguments: Any, **driven: Any) -> Any:
        drawn.append(arguments)
        if len(drawn) == 5:
            raise MemoryError
        return draw_curves(*arguments, **driven)

    monkeypatch.setattr("gradhesion.core.draw_curves", failing)
    with pytest.raises(MemoryError):
        gradhesion("run", curve_file, "-o", folder / "x.nc", "--overwrite", "--threads", "1")
    assert (folder / "x.nc").read_text() == "precious"
    assert os.listdir(folder) == ["x.nc"]
    monkeypatch.setattr("gradhesion.core.draw_curves", lambda *_: pytest.fail("nothing is drawn"))
    assert gradhesion("run", curve_file, "-o", folder / "x.nc").exit_code == 4


def test_info_tells_curves_in_words(gradhesion: Call, dataset_file: Path) -> None:
    told = " ".join(gradhesion("info", dataset_file).stdout.split())
    with xarray.open_dataset(dataset_file) as dataset:
        points = dataset["load"].count("point")
        loading = ((dataset["path_jump"] == 1) & (dataset["path_unloading"] == 0)).sum("path_point")
        least, greatest = float(dataset["load"].min()), float(dataset["load"].max())
    assert int(loading.max()) > 1
    for words in (
        "6 scenes",
        "axes A 0, 0.023, 0.071 a_max_over_R 0.41, inf fixed k 0.31",
        f"equilibrium: {int(points.min())} to {int(points.max())} points per scene stable branches 1 to",
        f"jumps on loading 1 to {int(loading.max())} jumps on unloading 1 to",
        f" load {least:.6g} to {greatest:.6g} load P/(1.5 pi R dgamma) in equilibrium",
        "smooth_contact_radius 0 to",
        "status: 6 of 6 scenes (100.0%) have values",
        "origin gradhesion",
    ):
        assert words in told, words
    with opened(dataset_file) as dataset:
        assert list(curve_lines(dataset, cells=1)) == list(curve_lines(dataset)), "read in whatever pieces"
