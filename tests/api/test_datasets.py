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
        ("none.nc", None, "does not exist"),
        ("folder", "", "a directory"),
        ("study.toml", "title = 1", "a study (TOML)"),
        ("table.csv", "k,nu\n", "a table (CSV)"),
        ("x.nc", "text", "NetCDF"),
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


@pytest.mark.parametrize("lack", ["status", "title", "source", "flag_meanings", "another program 3.1"])
def test_a_dataset_of_another_program_says_what_is_missing(lack: str, tmp_path: Path) -> None:
    dataset = gr.solve(PUNCH, "pull_off_force", A=0.0, solver="envelope")
    if lack == "status":
        dataset = dataset.drop_vars("status")
    elif lack == "flag_meanings":
        del dataset["status"].attrs[lack]
    elif lack == "another program 3.1":
        dataset.attrs["source"] = lack
    else:
        del dataset.attrs[lack]
    path = tmp_path / "x.nc"
    dataset.to_netcdf(path)
    calls: list[tuple[Any, Any, str]] = [(call, path, str(path)) for call in (gr.open, gr.verify, gr.plot, gr.explore)]
    for call, given, name in [*calls, (gr.verify, dataset, "the dataset"), (gr.plot, dataset, "the dataset")]:
        with pytest.raises(gr.DatasetError) as refused:
            call(given)
        assert str(refused.value).startswith(f"{name}: ")
        assert lack in str(refused.value)


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
    with pytest.raises(gr.DatasetError, match="the dataset: its status"):
        gr.verify(dataset.where(dataset["A"] > 0.0))


def test_what_cannot_be_verified_says_why() -> None:
    pytest.importorskip("flint")
    named = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.0, 0.01], dims="x"))
    with pytest.raises(gr.DatasetError, match="the dataset: lacks its study"):
        gr.verify(named)
    with pytest.raises(gr.StudyError, match="sample = 0"):
        gr.verify(named, sample=0)
    points = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.01, 0.0, 0.02], dims="scene"))
    assert gr.verify(points, seed=3).exceeding == 0
    moved = points.assign_coords(A=points["A"] + 1e-3)
    with pytest.raises(gr.DatasetError, match=r"the dataset: A\[0\] is 0.011"):
        gr.verify(moved)
    assert np.isfinite(points["pull_off_force"]).all()
