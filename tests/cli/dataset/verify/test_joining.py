"""Datasets that differ along one axis make one: that of the study with all values."""

import hashlib
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study.reading import study_from

Call = Callable[..., Result]


@pytest.fixture
def written(data: dict[str, Any], tmp_path: Path) -> Callable[..., Path]:
    """Write the dataset of the small study with other keys."""

    def make(name: str, *, parameters: dict[str, Any] | None = None, **changes: Any) -> Path:
        path = tmp_path / f"{name}.nc"
        table = data["parameters"] | (parameters or {})
        write(study_from(data | changes | {"parameters": table}), path, history=f"made {name}")
        return path

    return make


def same_values(one: Path, other: Path) -> None:
    with xarray.open_dataset(one) as first, xarray.open_dataset(other) as second:
        assert first.sizes == second.sizes
        xarray.testing.assert_identical(first.drop_attrs(deep=False), second.drop_attrs(deep=False))


@pytest.mark.parametrize("cells", [2, 100])
def test_values_of_an_axis_are_joined_in_their_order(
    cells: int, gradhesion: Call, written: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", str(cells))
    whole = written("whole", parameters={"A": [0.0, 0.01, 0.02, 0.023, 0.05]})
    parts = [written("low", parameters={"A": [0.0, 0.02]}), written("high", parameters={"A": [0.01, 0.02, 0.05]}), written("one", parameters={"A": 0.023})]  # fmt: skip
    result = gradhesion("merge", *parts, "-o", tmp_path / "joined.nc")
    assert result.exit_code == 0, result.stderr
    same_values(tmp_path / "joined.nc", whole)
    with xarray.open_dataset(tmp_path / "joined.nc") as dataset:
        assert dataset.attrs["history"].splitlines()[:3] == ["made low", "made high", "made one"]
        again = study_from(tomllib.loads(dataset.attrs["study"]))
        np.testing.assert_array_equal(again.parameters["A"], [0.0, 0.01, 0.02, 0.023, 0.05])
    told = gradhesion("info", tmp_path / "joined.nc")
    assert told.exit_code == 0


def test_several_axes_are_joined_where_their_grid_is_full(
    gradhesion: Call, written: Callable[..., Path], tmp_path: Path
) -> None:
    whole = written("whole", parameters={"A": [0.0, 0.02], "k": [0.0, 0.3, 0.6]})
    corners = [(0.0, [0.0, 0.3]), (0.0, 0.6), (0.02, [0.6, 0.3]), (0.02, 0.0)]
    parts = [written(f"part{i}", parameters={"A": A, "k": k}) for i, (A, k) in enumerate(corners)]
    assert gradhesion("merge", *parts, "-o", tmp_path / "joined.nc").exit_code == 0
    same_values(tmp_path / "joined.nc", whole)
    assert gradhesion("verify", tmp_path / "joined.nc").exit_code == 0
    assert gradhesion("merge", *parts[:3], "-o", tmp_path / "other.nc").exit_code == 2


def test_units_as_they_were_written_before_go_with_those_of_today(gradhesion: Call, tmp_path: Path) -> None:
    physical = {"R": "1 um", "E_star": "1 GPa", "c0": "10 nm", "wavelength": "50 nm"}
    files = [tmp_path / f"{work}.nc" for work in ("20", "50", "both")]
    for file, work in zip(files, ("20 mJ m-2", "50 mJ/m^2", ["20 mJ m-2", "50 mJ/m^2"]), strict=True):
        keys = {"outputs": ["pull_off_force"], "parameters": {"k": [0.0, 0.3], "nu": 0.3, "A": 0.01}}
        write(study_from(keys | {"physical": physical | {"work_of_adhesion": work}}), file, history="")
    with netCDF4.Dataset(files[0], "a") as old:
        old["work_of_adhesion"].units = "J m-2"
    assert gradhesion("merge", *files[:2], "-o", tmp_path / "joined.nc").exit_code == 0
    same_values(tmp_path / "joined.nc", files[2])
    told = gradhesion("info", files[0])
    assert (told.exit_code, "0.02 J m-2" in told.stdout) == (0, True), told.stdout
    with gr.open(files[0]) as old:
        given = {name: old[name] for name in ("k", "nu", "A", *physical, "work_of_adhesion")}
        assert gr.solve(given, "pull_off_force")["pull_off_force"].equals(old["pull_off_force"])


def test_fixed_values_become_an_axis_and_solvers_stay(
    gradhesion: Call, written: Callable[..., Path], tmp_path: Path
) -> None:
    method = {"solver": ["exact", "envelope"]}
    whole = written("whole", parameters={"nu": [-0.2, 0.27]}, method=method)
    parts = [
        written("one", parameters={"nu": 0.27}, method=method),
        written("two", parameters={"nu": -0.2}, method=method),
    ]
    assert gradhesion("merge", *parts, "-o", tmp_path / "joined.nc", "--quiet").exit_code == 0
    same_values(tmp_path / "joined.nc", whole)


def test_quantities_keep_their_unit(gradhesion: Call, data: dict[str, Any], tmp_path: Path) -> None:
    units = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "13 nm", "wavelength": "200 nm"}
    study = data | {"parameters": {"k": 0.3, "nu": 0.27, "A": [0.0, 0.02]}}
    files = {"near": ["1 um", "0.1 mm"], "far": ["2 um", "inf"], "all": ["1 um", "2 um", "100 um", "inf"]}
    for name, rims in files.items():
        write(study_from(study | {"physical": units | {"a_max": rims}}), tmp_path / f"{name}.nc", history="")
    result = gradhesion("merge", tmp_path / "near.nc", tmp_path / "far.nc", "-o", tmp_path / "joined.nc")
    assert result.exit_code == 0, result.stderr
    same_values(tmp_path / "joined.nc", tmp_path / "all.nc")


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({}, "have the same scenes; join datasets that differ in an axis"),
        ({"parameters": {"A": 0.5, "k": 0.5}}, "differ in k and A, and .* scenes of their common grid are in none of them"),
        ({"parameters": {"A": 0.5}, "outputs": ["pull_off_force"]}, "differs from .* in outputs; join datasets that share it"),
        ({"parameters": {"A": 0.5}, "method": {"solver": "envelope"}, "outputs": ["pull_off_force", "dissipated_energy"]}, "differs from .* in outputs"),
        ({"parameters": {"A": 0.5}, "profile": {"exponent": 3.0}}, "differs from .* in profile"),
        ({"kind": "curve", "outputs": ["path"]}, "contains a curve; only maps and optima on a grid can be joined"),
    ],
)  # fmt: skip
def test_what_cannot_be_joined_is_told(
    change: dict[str, Any], sentence: str, gradhesion: Call, written: Callable[..., Path], tmp_path: Path
) -> None:
    one, other, output = written("one"), written("other", **change), tmp_path / "joined.nc"
    result = gradhesion("merge", one, other, "-o", output)
    assert result.exit_code == 2
    assert re.search(sentence, result.stderr)
    assert not output.exists()


def changed(path: Path, **attributes: str) -> None:
    """Change attributes of a dataset."""
    with netCDF4.Dataset(path, "a") as file:
        file.setncatts(attributes)


def test_a_study_that_does_not_match_its_coordinates_is_refused(
    gradhesion: Call, written: Callable[..., Path], tmp_path: Path
) -> None:
    one, other, output = written("one"), written("other"), tmp_path / "joined.nc"
    with netCDF4.Dataset(other) as file:
        text = file.study
    lie = text.replace("nu = 0.27", "nu = 0.29")
    assert lie != text
    changed(other, study=lie)
    result = gradhesion("merge", one, other, "-o", output)
    assert result.exit_code == 2
    assert result.stderr.startswith(f"{other}: the text of its study was changed")
    changed(other, study=lie, study_sha256=hashlib.sha256(lie.encode()).hexdigest())
    result = gradhesion("merge", one, other, "-o", output)
    assert result.exit_code == 2
    assert result.stderr.startswith(f"{other}: nu is 0.27, in its study 0.29, so that its study and its values do not")
    assert not output.exists()


@pytest.mark.parametrize("text", ["not TOML", "[" * 5000, "outputs = []", 'kind = "map"', "a.b.c = 1"])
def test_a_study_that_is_none_is_refused(
    text: str, gradhesion: Call, written: Callable[..., Path], tmp_path: Path
) -> None:
    one, other = written("one"), written("other", parameters={"A": 0.5})
    changed(other, study=text, study_sha256=hashlib.sha256(text.encode()).hexdigest())
    for command in (["merge", one, other, "-o", tmp_path / "joined.nc"], ["verify", other]):
        result = gradhesion(*command)
        assert result.exit_code == 2
        assert result.stderr.startswith(f"{other}: ")
    assert not (tmp_path / "joined.nc").exists()


def test_a_coordinate_in_the_last_place_apart_takes_its_own_values(
    gradhesion: Call, written: Callable[..., Path], tmp_path: Path
) -> None:
    """As a logarithmic axis is with another numpy: no cell is left without an owner, or has another's values."""
    whole = written("whole", parameters={"lambda_over_R": [0.11, 0.2, 0.3, 0.47]})
    one, other = (
        written("one", parameters={"lambda_over_R": [0.11, 0.3]}),
        written("other", parameters={"lambda_over_R": [0.2, 0.47]}),
    )
    for path, away in ((one, 1.0), (other, 0.0)):
        with netCDF4.Dataset(path, "a") as file:
            file["lambda_over_R"][:] = np.nextafter(file["lambda_over_R"][:], away)
    assert gradhesion("merge", one, other, "-o", tmp_path / "joined.nc").exit_code == 0
    same_values(tmp_path / "joined.nc", whole)


def test_the_output_is_named_and_stays(gradhesion: Call, written: Callable[..., Path], tmp_path: Path) -> None:
    one, other = written("one"), written("other", parameters={"A": 0.5})
    assert "named with -o" in gradhesion("merge", one, other).stderr
    assert "named twice" in gradhesion("merge", one, one, "-o", tmp_path / "x.nc").stderr
    before = one.read_bytes()
    result = gradhesion("merge", one, other, "-o", one)
    assert result.exit_code == 4
    assert one.read_bytes() == before
