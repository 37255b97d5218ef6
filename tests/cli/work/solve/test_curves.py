"""Curve studies: what their dataset holds, whatever fails, and what `gradhesion info` tells of it."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset import compute
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.names.curves import CURVES, EXTENTS, INTEGERS, MEANINGS, RAGGED, STATE_CURVES
from gradhesion.cli.study import study_from
from gradhesion.core import FAILED, FLAGS, draw_curves, solve
from gradhesion.core.problem.inputs import INPUTS

Call = Callable[..., Result]
OWN = {curve: own for curve, own in CURVES.items() if curve not in STATE_CURVES}  # these have test_states.py
PADDED = [curve for curve in OWN if curve not in RAGGED]
PUNCH = {"k": 0.31, "lambda_over_R": 0.17, "A": [0.0, 0.023, 0.071], "a_max_over_R": [0.41, float("inf")]}
"""Three punches, one of them smooth, with a rim and without."""


@pytest.fixture
def drawn(made: Callable[..., Path]) -> Callable[..., Path]:
    """Run the small study of curves with other keys."""

    def draw(parameters: dict[str, Any] | None = None, outputs: Any = tuple(OWN), exit_code: int = 0) -> Path:
        return made(exit_code=exit_code, parameters=PUNCH | (parameters or {}), kind="curve", outputs=[*outputs])

    return draw


def test_a_curve_stands_for_its_variables(data: dict[str, Any]) -> None:
    study = study_from(data | {"kind": "curve", "outputs": ["path_load", "smooth", "load", "path_jump"]})
    assert study.outputs == ("load", "path_load", "path_jump", *CURVES["smooth"])
    assert set(compute(study).data_vars) == {*study.outputs, "status"}


def test_the_dataset_keeps_its_contract(drawn: Callable[..., Path]) -> None:
    with netCDF4.Dataset(drawn()) as file:
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


def test_each_scene_is_the_curve_of_the_core_padded_to_the_longest(drawn: Callable[..., Path]) -> None:
    outputs = ["pull_off_force", "loading_jumps", "unloading_jumps", "delta_jump_out"]
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
            cycle = solve(parameters, outputs)  # the path is that of the map
            jumps, back = found["path_jump"] == 1, found["path_unloading"] == 1
            assert [(jumps & ~back).sum(), (jumps & back).sum()] == [cycle["loading_jumps"], cycle["unloading_jumps"]]
            assert -found["load"].min() == pytest.approx(float(cycle["pull_off_force"]), rel=1e-13)
            assert found["path_indentation"].min() == pytest.approx(
                float(cycle["delta_jump_out"]), rel=1e-12, abs=1e-16
            )
        assert {name: dataset.sizes[name] for name in lengths} == {name: max(sizes) for name, sizes in lengths.items()}
        assert len(set(lengths["point"])) > 1, "some are padded"


def test_a_single_scene_has_no_dimension_but_those_of_its_curves(drawn: Callable[..., Path]) -> None:
    with xarray.open_dataset(drawn({"A": 0.02, "a_max_over_R": 0.3}, ["envelope"])) as dataset:
        assert set(dataset.sizes) == {"envelope_point"}
        assert dataset["status"].shape == ()
        assert dataset["envelope_contact_radius"][-1] == 0.3


def test_scenes_without_curves_lose_nothing(drawn: Callable[..., Path], gradhesion: Call) -> None:
    # waves beyond every count of folds: the exact curve cannot be drawn, the smooth one can
    one = {"A": 0.3, "a_max_over_R": 0.4}
    path = drawn(one | {"lambda_over_R": [1e-9, 0.2]}, ["path", "smooth"], 3)
    with xarray.open_dataset(path) as dataset:
        assert (dataset["status"].values & FAILED).tolist() == [FLAGS["no_value"], 0]
        failed, fine = dataset.isel(lambda_over_R=0), dataset.isel(lambda_over_R=1)
        assert failed["path_load"].isnull().all()
        assert failed["path_branch"].isnull().all()
        assert np.isfinite(fine["path_load"]).all()
        np.testing.assert_allclose(failed["smooth_load"], fine["smooth_load"], rtol=1e-12)  # but for its units
    path = drawn(one | {"lambda_over_R": 1e-9}, ["path_load"], 3)
    assert "no value in any scene" in gradhesion("info", path).stdout
    assert gradhesion("plot", path).exit_code == 2
    assert not path.with_suffix(".png").exists()


def test_what_stood_there_stays_until_all_is_drawn(
    gradhesion: Call, drawn: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, study, count = drawn(outputs=["smooth"]), tmp_path / "study.toml", 0
    before, files = path.read_bytes(), sorted(os.listdir(tmp_path))

    def failing(*arguments: Any, **driven: Any) -> Any:
        nonlocal count
        count += 1
        if count == 5:
            raise MemoryError
        return draw_curves(*arguments, **driven)

    monkeypatch.setattr("gradhesion.core.draw_curves", failing)
    with pytest.raises(MemoryError):
        gradhesion("run", study, "-o", path, "--overwrite", "--threads", "1")
    assert path.read_bytes() == before
    assert sorted(os.listdir(tmp_path)) == files
    monkeypatch.setattr("gradhesion.core.draw_curves", lambda *_: pytest.fail("nothing is drawn"))
    assert gradhesion("run", study, "-o", path).exit_code == 4


def test_info_tells_curves_in_words(gradhesion: Call, drawn: Callable[..., Path]) -> None:
    path = drawn()
    told = " ".join(gradhesion("info", path).stdout.split())
    with opened(path) as dataset:
        points = dataset["load"].count("point")
        loading = ((dataset["path_jump"] == 1) & (dataset["path_unloading"] == 0)).sum("path_point")
        least, greatest = float(dataset["load"].min()), float(dataset["load"].max())
    assert int(loading.max()) > 1
    for words in (
        f"equilibrium: {int(points.min())} to {int(points.max())} points per scene",
        f"jumps on loading 1 to {int(loading.max())}",
        f" load {least:.6g} to {greatest:.6g} ",
    ):
        assert words in told, words
