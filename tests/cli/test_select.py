"""`gradhesion select` writes a part of a dataset, or a reduced one, which all other commands take."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

Call = Callable[..., Result]
Select = Callable[..., tuple[xarray.Dataset, xarray.Dataset, Path]]


@pytest.fixture
def select(gradhesion: Call, tmp_path: Path) -> Select:
    """Select, and let each command that reads datasets take the result; gives the part and the whole."""

    def take(path: Path, *words: str, verify: int = 0) -> tuple[xarray.Dataset, xarray.Dataset, Path]:
        part = tmp_path / "part.nc"
        part.unlink(missing_ok=True)
        result = gradhesion("select", path, *words, "-o", part)
        assert result.exit_code == 0, result.stderr
        assert gradhesion("info", part).exit_code == gradhesion("plot", part, "--overwrite").exit_code == 0
        verified = gradhesion("verify", part, "--sample", "50")
        assert verified.exit_code == verify, verified.stderr
        with xarray.open_dataset(part) as found, xarray.open_dataset(path) as whole:
            return found.load(), whole.load(), part

    return take


def test_a_part_of_a_grid_has_the_values_and_the_study_of_the_whole(dataset_file: Path, select: Select) -> None:
    wishes = ("--at", "k=0.3", "--at", "lambda_over_R=0.2:", "--at", "a_max_over_R=inf")
    found, whole, _ = select(dataset_file, *wishes)
    expected = whole.isel(k=1, lambda_over_R=[1, 2], a_max_over_R=1)
    xarray.testing.assert_identical(found.drop_attrs(deep=False), expected.drop_attrs(deep=False))
    assert found.attrs.pop("history").startswith(expected.attrs.pop("history") + "\n")
    assert found.attrs == expected.attrs
    assert (found["pull_off_force"].dtype, found["status"].dtype) == (np.float64, np.int8)


def test_a_changed_value_of_a_part_is_found(gradhesion: Call, dataset_file: Path, select: Select) -> None:
    *_, part = select(dataset_file, "--at", "k=0.31")
    with netCDF4.Dataset(part, "a") as file:
        file["pull_off_force"][0, 1, 0] *= 1.0 + 1e-11
    assert gradhesion("verify", part, "--sample", "50").exit_code == 3
    with netCDF4.Dataset(part, "a") as file:
        file["lambda_over_R"][0] = 0.12
    assert gradhesion("verify", part).exit_code == 2


def test_solvers_and_points(made: Callable[..., Path], select: Select) -> None:
    solvers = made(method={"solver": ["exact", "envelope"]})
    assert select(solvers, "--at", "solver=envelope", "--at", "k=0")[0]["solver"].item() == "envelope"
    lists = {"k": [0.1, 0.1, 0.6], "lambda_over_R": 0.3, "A": [0.01, 0.02, 0.03], "a_max_over_R": 0.5}
    found, whole, _ = select(made(parameters=lists, layout="points"), "--at", "A=0.015:1")
    xarray.testing.assert_equal(found, whole.isel(scene=[1, 2]))


REDUCTIONS = [("max", np.max), ("mean", np.mean), ("sum", np.sum), ("median", np.median)]


@pytest.mark.parametrize(("how", "reduce"), REDUCTIONS)
def test_reductions_have_the_flags_of_all_and_say_what_they_are(
    how: str, reduce: Callable[..., Any], dataset_file: Path, select: Select
) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["status"][0, 1, 0, 0] = 4
    found, whole, _ = select(dataset_file, "--over", f"lambda_over_R={how}", "--at", "A=0.023", verify=2)
    values = whole["pull_off_force"].isel(A=1).values
    np.testing.assert_allclose(found["pull_off_force"], reduce(values, axis=1), rtol=4e-16)
    assert found["pull_off_force"].dims == ("k", "a_max_over_R")
    assert f"{how} over lambda_over_R" in found["pull_off_force"].long_name
    expected = np.bitwise_or.reduce(whole["status"].isel(A=1).values, axis=1)
    np.testing.assert_array_equal(found["status"], expected)


def test_curves_are_cut_with_their_jumps(made: Callable[..., Path], select: Select) -> None:
    parameters = {"k": 0.31, "a_max_over_R": [0.44, 0.7]}
    path = made(parameters=parameters, kind="curve", outputs=["path", "jumps"])
    found, whole, _ = select(path, "--at", "A=0.023", "--at", "lambda_over_R=0.2:1", verify=2)
    counts = whole["jump_count"].values
    of_scene = np.repeat(np.arange(counts.size), counts.ravel()).astype(int)
    left = np.arange(counts.size).reshape(counts.shape)[1:, 1].ravel()
    np.testing.assert_array_equal(found["jump_energy"], whole["jump_energy"].values[np.isin(of_scene, left)])
    np.testing.assert_array_equal(found["jump_count"], counts[1:, 1])
    np.testing.assert_array_equal(found["path_load"], whole["path_load"].isel(lambda_over_R=[1, 2], A=1))


@pytest.mark.parametrize(
    ("words", "code"),
    [
        ((), 2),
        (("--at", "nu=0.27"), 2),
        (("--at", "k=0.32:0.5"), 2),
        (("--over", "k=argmax"), 2),
        (("--at", "k=0", "-o", "part.csv"), 2),
        (("--at", "k=0", "-o", "out.nc"), 4),
    ],
)
def test_what_cannot_be_selected_is_one_sentence(
    words: tuple[str, ...], code: int, gradhesion: Call, dataset_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(dataset_file.parent)
    before = dataset_file.read_bytes()
    result = gradhesion("select", dataset_file, "-o", "part.nc", *words)
    assert (result.exit_code, result.stdout) == (code, "")
    assert dataset_file.read_bytes() == before
    assert not Path("part.nc").exists()


def test_parts_of_datasets_are_not_merged(gradhesion: Call, dataset_file: Path, select: Select, tmp_path: Path) -> None:
    *_, part = select(dataset_file, "--at", "k=0")
    result = gradhesion("merge", dataset_file, part, "-o", tmp_path / "both.nc")
    assert result.exit_code == 2
    assert result.stderr.startswith(f"{part}: has only a part")
