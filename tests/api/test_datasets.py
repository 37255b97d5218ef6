"""`gr.open` and `gr.verify`."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr

PUNCH: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "a_max_over_R": 0.7}  # fmt: skip


def test_what_is_kept_is_opened_again(tmp_path: Path) -> None:
    named = gr.solve(PUNCH, A=xarray.DataArray([0.0, 0.01], dims="x"))
    grid = gr.solve(PUNCH, A=[0.0, 0.01])
    for number, dataset in enumerate((named, grid)):
        dataset.to_netcdf(tmp_path / f"{number}.nc")
        with gr.open(str(tmp_path / f"{number}.nc")) as again:
            xarray.testing.assert_identical(again, dataset)
            assert again.gr.valid().all()


@pytest.mark.parametrize(
    ("name", "content", "what"),
    [
        ("none.nc", None, "does not exist; name a dataset that `gradhesion run` wrote"),
        ("folder", "", "is not a file, but a directory"),
        ("study.toml", "title = 1", "cannot be read as NetCDF (it is a study (TOML)); name a dataset"),
        ("table.csv", "k,nu\n", "cannot be read as NetCDF (it is a table (CSV))"),
        ("x.nc", "text", "cannot be read as NetCDF"),
    ],
)
def test_a_path_that_is_no_dataset_says_what_it_is(name: str, content: str | None, what: str, tmp_path: Path) -> None:
    path = tmp_path / name
    if content == "":
        path.mkdir()
    elif content is not None:
        path.write_text(content)
    with pytest.raises(gr.DatasetError) as refused:
        gr.open(path)
    assert str(refused.value).startswith(f"{path}: ")
    assert what in str(refused.value)


@pytest.mark.parametrize(
    ("left_out", "lack"),
    [
        ("status", "it lacks the variable status"),
        ("title", "it lacks the attribute title"),
        ("source", "it lacks the attribute source"),
        ("meanings", "it lacks the attribute flag_meanings of status"),
        ("other", "its source is another program 3.1"),
    ],
)
def test_a_dataset_of_another_program_says_what_is_missing(left_out: str, lack: str, tmp_path: Path) -> None:
    dataset = gr.solve(PUNCH, "pull_off_force", A=0.0, solver="envelope")
    if left_out == "status":
        dataset = dataset.drop_vars("status")
    elif left_out == "meanings":
        del dataset["status"].attrs["flag_meanings"]
    elif left_out == "other":
        dataset.attrs["source"] = "another program 3.1"
    else:
        del dataset.attrs[left_out]
    dataset.to_netcdf(tmp_path / "x.nc")
    sentence = f"is not a dataset of gradhesion; name one that `gradhesion run` wrote ({lack})"
    for call in (gr.open, gr.verify, gr.plot, gr.explore):
        with pytest.raises(gr.DatasetError) as refused:
            call(tmp_path / "x.nc")
        assert str(refused.value) == f"{tmp_path / 'x.nc'}: {sentence}"
    for call in (gr.verify, gr.plot):
        with pytest.raises(gr.DatasetError) as refused:
            call(dataset)
        assert str(refused.value) == f"the dataset: {sentence}"


def test_a_value_that_was_changed_is_found(tmp_path: Path) -> None:
    pytest.importorskip("flint")
    dataset = gr.solve(PUNCH, "pull_off_force", A=[0.0, 0.01], k=[0.1, 0.3])
    found = gr.verify(dataset, seed=1)
    assert (found.exceeding, len(found.deviations), found.seed) == (0, 4, 1)
    dataset["pull_off_force"][1, 1] *= 1.0 + 1e-11
    found = gr.verify(dataset, seed=1)
    assert found.exceeding == 1
    assert dict(found.deviations[0].scene) == {"k": 0.3, "A": 0.01}
    dataset.to_netcdf(tmp_path / "x.nc")
    assert gr.verify(tmp_path / "x.nc", sample=4).exceeding == 1


def test_a_dataset_is_verified_whatever_the_order_of_its_axes(tmp_path: Path) -> None:
    pytest.importorskip("flint")
    for amplitudes in ([0.0, 0.01], [0.0, 0.01, 0.02]):  # a square, whose places would be mistaken, and a rectangle
        dataset = gr.solve(PUNCH, "pull_off_force", A=amplitudes, k=[0.1, 0.3])
        for turned in (dataset, dataset.transpose("A", "k")):
            found = gr.verify(turned, seed=1)
            assert (found.exceeding, len(found.deviations)) == (0, 2 * len(amplitudes))
        turned.to_netcdf(tmp_path / f"{len(amplitudes)}.nc")
        assert gr.verify(tmp_path / f"{len(amplitudes)}.nc", seed=1).exceeding == 0
    with pytest.raises(gr.DatasetError, match="the dataset: its status is no integer; give the dataset"):
        gr.verify(dataset.where(dataset["A"] > 0.0))


def test_what_cannot_be_verified_says_why() -> None:
    pytest.importorskip("flint")
    named = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.0, 0.01], dims="x"))
    with pytest.raises(gr.DatasetError, match="the dataset: lacks its study, the attributes study and study_sha256"):
        gr.verify(named)
    with pytest.raises(gr.StudyError, match="sample = 0, seed = None: a sample of 1 scene or more"):
        gr.verify(named, sample=0)
    points = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.01, 0.0, 0.02], dims="scene"))
    assert gr.verify(points, seed=3).exceeding == 0
    moved = points.assign_coords(A=points["A"] + 1e-3)
    with pytest.raises(gr.DatasetError, match=r"the dataset: A\[0\] is 0.011, in its study 0.01"):
        gr.verify(moved)
    assert np.isfinite(points["pull_off_force"]).all()
