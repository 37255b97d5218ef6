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


@pytest.fixture
def written(
    gradhesion: Call, data: dict[str, Any], write_study: Callable[[str], Path], tmp_path: Path
) -> Callable[..., Path]:
    """Write the dataset of the small study, of 24 scenes, with other keys."""
    from gradhesion.cli.study.reading import study_from

    def make(parameters: dict[str, Any] | None = None, **changes: Any) -> Path:
        study = data | changes | {"parameters": data["parameters"] | (parameters or {})}
        path = tmp_path / "whole.nc"
        result = gradhesion("run", write_study(study_from(study).text), "-o", path, "--quiet", "--overwrite")
        assert result.exit_code == 0, result.stderr
        return path

    return make


@pytest.fixture
def select(gradhesion: Call, tmp_path: Path) -> Callable[..., Path]:
    """Select, and let each command that reads datasets take the result."""

    def take(path: Path, *words: str, verify: int = 0, plot: int = 0) -> Path:
        part = tmp_path / "part.nc"
        result = gradhesion("select", path, *words, "-o", part)
        assert result.exit_code == 0, result.stderr
        assert gradhesion("info", part).exit_code == 0
        assert gradhesion("plot", part, "--overwrite").exit_code == plot
        verified = gradhesion("verify", part, "--sample", "50")
        assert verified.exit_code == verify, verified.stderr
        return part

    return take


def test_a_part_of_a_grid_has_the_values_and_the_study_of_the_whole(
    written: Callable[..., Path], select: Callable[..., Path]
) -> None:
    path = written()
    part = select(path, "--at", "k=0.3", "--at", "lambda_over_R=0.2:", "--at", "a_max_over_R=inf")
    with xarray.open_dataset(path) as whole, xarray.open_dataset(part) as found:
        expected = whole.isel(k=1, lambda_over_R=[1, 2], a_max_over_R=1)
        xarray.testing.assert_identical(found.drop_attrs(deep=False), expected.drop_attrs(deep=False))
        assert found.attrs.pop("history").startswith(expected.attrs.pop("history") + "\n")
        assert found.attrs == expected.attrs
        assert found["pull_off_force"].dtype == np.float64
        assert found["status"].dtype == np.int8


@pytest.mark.parametrize("wrong", [1e-11, 0.0])
def test_a_changed_value_of_a_part_is_found(
    wrong: float, gradhesion: Call, written: Callable[..., Path], select: Callable[..., Path]
) -> None:
    part = select(written(), "--at", "k=0.31")
    with netCDF4.Dataset(part, "a") as file:
        file["pull_off_force"][0, 1, 0] *= 1.0 + wrong
    assert gradhesion("verify", part, "--sample", "50").exit_code == (3 if wrong else 0)
    with netCDF4.Dataset(part, "a") as file:
        file["lambda_over_R"][0] = 0.12
    assert gradhesion("verify", part).exit_code == 2


def test_solvers_and_points(written: Callable[..., Path], select: Callable[..., Path]) -> None:
    part = select(written(method={"solver": ["exact", "envelope"]}), "--at", "solver=envelope", "--at", "k=0")
    with xarray.open_dataset(part) as found:
        assert found["solver"].item() == "envelope"
    part.unlink()
    lists = {"k": [0.1, 0.1, 0.6], "lambda_over_R": 0.3, "A": [0.01, 0.02, 0.03], "a_max_over_R": 0.5}
    path = written(lists, layout="points")
    with xarray.open_dataset(select(path, "--at", "A=0.015:1")) as found, xarray.open_dataset(path) as whole:
        xarray.testing.assert_equal(found, whole.isel(scene=[1, 2]))


@pytest.mark.parametrize(
    ("how", "reduce"), [("max", np.max), ("mean", np.mean), ("sum", np.sum), ("median", np.median)]
)
def test_reductions_have_the_flags_of_all_and_say_what_they_are(
    how: str, reduce: Callable[..., Any], written: Callable[..., Path], select: Callable[..., Path]
) -> None:
    path = written()
    with netCDF4.Dataset(path, "a") as file:
        file["status"][0, 1, 0, 0] = 4
    part = select(path, "--over", f"lambda_over_R={how}", "--at", "A=0.023", verify=2)
    with xarray.open_dataset(path) as whole, xarray.open_dataset(part) as found:
        values = whole["pull_off_force"].isel(A=1).values
        np.testing.assert_allclose(found["pull_off_force"], reduce(values, axis=1), rtol=4e-16)
        assert found["pull_off_force"].dims == ("k", "a_max_over_R")
        assert f"{how} over lambda_over_R" in found["pull_off_force"].long_name
        expected = np.bitwise_or.reduce(whole["status"].isel(A=1).values, axis=1)
        np.testing.assert_array_equal(found["status"], expected)


def test_curves_are_cut_with_their_jumps(written: Callable[..., Path], select: Callable[..., Path]) -> None:
    path = written({"k": 0.31, "a_max_over_R": [0.44, 0.7]}, kind="curve", outputs=["path", "jumps"])
    part = select(path, "--at", "A=0.023", "--at", "lambda_over_R=0.2:1", verify=2)
    with xarray.open_dataset(path) as whole, xarray.open_dataset(part) as found:
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
        (("--at", "k=0", "-o", "whole.nc"), 4),
    ],
)
def test_what_cannot_be_selected_is_one_sentence(
    words: tuple[str, ...], code: int, gradhesion: Call, written: Callable[..., Path], tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    path = written()
    before = path.read_bytes()
    result = gradhesion("select", path, "-o", "part.nc", *words)
    assert (result.exit_code, result.stdout) == (code, "")
    assert path.read_bytes() == before
    assert not (tmp_path / "part.nc").exists()


def test_parts_of_datasets_are_not_merged(
    gradhesion: Call, written: Callable[..., Path], select: Callable[..., Path], tmp_path: Path
) -> None:
    path = written()
    part = select(path, "--at", "k=0")
    result = gradhesion("merge", path, part, "-o", tmp_path / "both.nc")
    assert result.exit_code == 2
    assert result.stderr.startswith(f"{part}: has only a part")
