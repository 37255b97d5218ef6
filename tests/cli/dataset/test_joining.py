"""Datasets that differ along one axis make one: that of the study with all values."""

import hashlib
import tomllib
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study.reading import study_from
from tests.cli.conftest import Call, Made, Patch, Told

UNSEALED = "# a comment that the sha256 does not know"
LIES = [UNSEALED, "nu = 0.29", "not TOML", "[" * 5000, "outputs = []", 'profile = { file = "x.csv" }', "a.b.c = 1"]


@pytest.fixture
def joined(gradhesion: Call, tmp_path: Path) -> Made:
    def join(*files: Path) -> Path:
        gradhesion("merge", *files, "-o", tmp_path / "joined.nc", "--quiet", code=0)
        return tmp_path / "joined.nc"

    return join


@pytest.fixture
def written(data: dict[str, Any], tmp_path: Path) -> Made:
    def make(name: str, *, parameters: dict[str, Any] | None = None, **changes: Any) -> Path:
        path = tmp_path / f"{name}.nc"
        table, physical = data["parameters"] | (parameters or {}), changes.get("physical")
        if physical:
            changes["physical"] = physical | {"a_max": table.pop("a_max")}
            table = {"k": 0.3, "nu": 0.27, "A": [0.0, 0.02]}
        study = {key: keys for key, keys in (data | changes | {"parameters": table}).items() if keys is not None}
        write(study_from(study), path, history=f"made {name}")
        return path

    return make


def same_values(one: Path, other: Path) -> None:
    with xarray.open_dataset(one) as first, xarray.open_dataset(other) as second:
        xarray.testing.assert_identical(first.drop_attrs(deep=False), second.drop_attrs(deep=False))


METHOD = {"method": {"solver": ["exact", "envelope"]}}
UNITS = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "13 nm", "wavelength": "200 nm"}
SEARCHED = {"A": 0.02, "a_max_over_R": 1.0, "lambda_over_R": {"start": 0.05, "stop": 1.0, "spacing": "log"}}
SOME, ONE, ALL = (SEARCHED | {"k": k} for k in ([0.0, 0.7], 0.3, [0.0, 0.3, 0.7]))


def optimum(goal: Any) -> dict[str, Any]:
    return {"kind": "optimum", "outputs": None, "optimum": {"maximise": goal, "over": ["lambda_over_R"]}}


WHOLES: dict[str, tuple[dict[str, Any], list[dict[str, Any]], dict[str, Any]]] = {
    "an axis": ({"A": [0.0, 0.01, 0.02, 0.05]}, [{"A": [0.0, 0.02]}, {"A": [0.01, 0.02]}, {"A": 0.05}], {}),
    "two axes": ({"A": [0.0, 0.02], "k": [0.0, 0.3, 0.6]}, [{"A": 0.0, "k": [0.0, 0.3]}, {"A": 0.0, "k": 0.6}, {"A": 0.02, "k": [0.6, 0.3]}, {"A": 0.02, "k": 0.0}], {}),
    "solvers": ({"nu": [-0.2, 0.27]}, [{"nu": 0.27}, {"nu": -0.2}], METHOD),
    "quantities": ({"a_max": ["1 um", "2 um", "100 um", "inf"]}, [{"a_max": ["1 um", "0.1 mm"]}, {"a_max": ["2 um", "inf"]}], {"physical": UNITS}),
    "optima": (ALL, [SOME, ONE], optimum("pull_off_force")),
}  # fmt: skip
"""A whole, its parts, and what all share."""


@pytest.mark.parametrize("name", WHOLES)
def test_parts_are_joined_in_the_order_of_their_axes(
    name: str, gradhesion: Call, written: Made, joined: Made, tmp_path: Path, monkeypatch: Patch
) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    whole, parts, keys = WHOLES[name]
    path = joined(*(written(f"part{i}", parameters=part, **keys) for i, part in enumerate(parts)))
    same_values(path, written("whole", parameters=whole, **keys))
    with xarray.open_dataset(path) as dataset:
        assert dataset.attrs["history"].splitlines()[: len(parts)] == [f"made part{i}" for i in range(len(parts))]
        again = study_from(tomllib.loads(dataset.attrs["study"]))
        for axis in {*again.parameters} & {*dataset.dims}:
            np.testing.assert_array_equal(again.parameters[axis], dataset[axis])
    gradhesion("verify", path, "--sample", "4", code=2 if name == "optima" else 0)
    if name == "two axes":
        lacking = [tmp_path / f"part{i}.nc" for i in range(3)]
        assert gradhesion("merge", *lacking, "-o", tmp_path / "other.nc").exit_code == 2


def test_units_as_once_written_go_with_those_of_today(gradhesion: Call, joined: Made, tmp_path: Path) -> None:
    physical = {"R": "1 um", "E_star": "1 GPa", "c0": "10 nm", "wavelength": "50 nm"}
    files = [tmp_path / f"{work}.nc" for work in ("20", "50", "both")]
    for file, work in zip(files, ("20 mJ m-2", "50 mJ/m^2", ["20 mJ m-2", "50 mJ/m^2"]), strict=True):
        keys = {"outputs": ["pull_off_force"], "parameters": {"k": [0.0, 0.3], "nu": 0.3, "A": 0.01}}
        write(study_from(keys | {"physical": physical | {"work_of_adhesion": work}}), file, history="")
    with netCDF4.Dataset(files[0], "a") as old:
        old["work_of_adhesion"].units = "J m-2"
    same_values(joined(*files[:2]), files[2])
    assert "0.02 J m-2" in gradhesion("info", files[0], code=0).stdout
    with gr.open(files[0]) as old:
        given = {name: old[name] for name in ("k", "nu", "A", *physical, "work_of_adhesion")}
        assert gr.solve(given, "pull_off_force")["pull_off_force"].equals(old["pull_off_force"])


RINGS: dict[str, Any] = {
    "parameters": {"k": 0.0, "lambda_over_R": 0.2, "A": 0.0, "a_max_over_R": 0.5, "toughness_wavelength_over_R": 0.3},
    "toughness": {"harmonics": [{"n": 1, "cos": 0.1}]},
}
TOUGHER = RINGS | {"parameters": RINGS["parameters"] | {"A": 0.02}, "toughness": {"harmonics": [{"n": 1, "cos": 0.2}]}}
FORCE, ENERGY, BOTH = map(optimum, ("pull_off_force", "dissipated_energy", ["pull_off_force", "dissipated_energy"]))
APART: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "the same": ({}, {}),
    "scenes in none": ({}, {"parameters": {"A": 0.5, "k": 0.5}}),
    "outputs": ({}, {"parameters": {"A": 0.5}, "outputs": ["pull_off_force"]}),
    "method": ({}, {"parameters": {"A": 0.5}, "method": {"check_contact": False}}),
    "profile": ({}, {"parameters": {"A": 0.5}, "profile": {"exponent": 3.0}}),
    "curve": ({}, {"kind": "curve", "outputs": ["path"]}),
    "toughness": (RINGS, TOUGHER),
    "search": (FORCE | {"parameters": SOME}, ENERGY | {"parameters": ONE}),
    "fronts": (BOTH | {"parameters": SOME}, BOTH | {"parameters": ONE}),
}
"""Two studies, by a word of what is said."""


@pytest.mark.parametrize("name", APART)
def test_what_cannot_be_joined_is_told(name: str, refusal: Told, written: Made, tmp_path: Path) -> None:
    one, other = (written(f"{i}", **keys) for i, keys in enumerate(APART[name]))
    output = tmp_path / "joined.nc"
    assert name.rsplit(maxsplit=1)[-1] in refusal("merge", one, other, "-o", output)
    assert not output.exists()


@pytest.mark.parametrize("text", LIES)
def test_a_study_of_other_values_is_told(text: str, refusal: Told, written: Made, tmp_path: Path) -> None:
    one, other = written("one"), written("other", parameters={"A": 0.5})
    with netCDF4.Dataset(other, "a") as file:
        if text == UNSEALED:
            file.study += text
        else:
            file.study = file.study.replace("nu = 0.27", text) if text.startswith("nu") else text
            file.study_sha256 = hashlib.sha256(file.study.encode()).hexdigest()
    for command in (["merge", one, other, "-o", tmp_path / "joined.nc"], ["verify", other]):
        assert refusal(*command).startswith(f"{other}: ")
    assert not (tmp_path / "joined.nc").exists()


def test_a_coordinate_in_the_last_place_apart_takes_its_own_values(written: Made, joined: Made) -> None:
    """As a logarithmic axis is with another numpy: no cell is left without an owner, or has another's values."""
    whole = written("whole", parameters={"lambda_over_R": [0.11, 0.2, 0.3, 0.47]})
    one, other = (written(str(some[0]), parameters={"lambda_over_R": some}) for some in ([0.11, 0.3], [0.2, 0.47]))
    for path, away in ((one, 1.0), (other, 0.0)):
        with netCDF4.Dataset(path, "a") as file:
            file["lambda_over_R"][:] = np.nextafter(file["lambda_over_R"][:], away)
    same_values(joined(one, other), whole)


def test_the_output_is_named_and_stays(gradhesion: Call, written: Made, tmp_path: Path) -> None:
    one, other = written("one"), written("other", parameters={"A": 0.5})
    for command in ((one, other), (one, one, "-o", tmp_path / "x.nc"), (one, "-o", tmp_path / "x.nc")):
        assert gradhesion("merge", *command).exit_code == 2
    before = one.read_bytes()
    assert gradhesion("merge", one, other, "-o", one).exit_code == 4
    assert one.read_bytes() == before
