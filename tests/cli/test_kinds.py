"""Every kind of study through every command: in a file as in Python, whatever the blocks; and read by others."""

import math
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pint
import pint_xarray  # noqa: F401 (registers the accessor)
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import load_study, study_from
from gradhesion.core import OUTPUTS
from tests.conftest import ROOT, command

STUDY: dict[str, Any] = {"title": "A small study", "outputs": ["pull_off_force", "dissipated_energy", "loading_jumps"]}
MATERIAL: dict[str, Any] = {"k": [0.0, 0.31], "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013}
PUNCH = MATERIAL | {"lambda_over_R": [0.11, 0.3], "A": [0.0, 0.023], "a_max_over_R": [0.7, math.inf]}
LISTS = {"k": [0.0, 0.2, 0.31], "lambda_over_R": [0.11, 0.3, 0.2], "A": [0.0, 0.01, 0.02], "a_max_over_R": [1.0, 2.0, math.inf]}  # fmt: skip
BALL = {"R": ["1 um", "1.3 um"], "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "13 nm"}
TIP = BALL | {"wavelength": "0.3 um", "a_max": ["0.7 um", "inf"]}
SHAPE = {"exponent": 1.7, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "sin": -0.2}]}
DRAWN = PUNCH | {"k": 0.31, "lambda_over_R": 0.17, "a_max_over_R": [0.41, 0.7]}
CURVE: dict[str, Any] = {"kind": "curve", "parameters": DRAWN}
REDUCED = MATERIAL | {"lambda_over_L": [0.5, 0.9], "chi": [0.0, 0.4], "a_max_over_L": [1.5, 2.5]}
RIM = {name: value for name, value in PUNCH.items() if name != "a_max_over_R"} | {"a_max_over_a2": [0.7, math.inf]}
SEARCHED = PUNCH | {"A": 0.02, "a_max_over_R": 1.0, "lambda_over_R": {"start": 0.05, "stop": 1.0, "spacing": "log"}}

KINDS: dict[str, dict[str, Any]] = {
    "map": {"parameters": PUNCH},
    "points": {"layout": "points", "parameters": MATERIAL | LISTS},
    "solvers": {"parameters": PUNCH, "method": {"solver": ["envelope", "exact", "asymptotic"]}},
    "points of solvers": {"layout": "points", "outputs": [*OUTPUTS], "parameters": MATERIAL | LISTS, "method": {"solver": ["exact", "envelope"]}},
    "similarity": {"parameters": REDUCED},
    "points of similarity": {"layout": "points", "parameters": REDUCED | {"k": 0.31}},
    "rim over jump-in": {"parameters": RIM},
    "units": {"parameters": {"k": [0.0, 0.31], "nu": 0.27, "A": [0.0, 0.023]}, "physical": TIP},
    "points in units": {"layout": "points", "parameters": {"k": [0.0, 0.31], "nu": 0.27, "A": 0.023}, "physical": TIP, "method": {"solver": ["envelope", "exact"]}},
    "Young's modulus and a spring": {"parameters": {"k": 0.0, "nu": [-0.9, 0.49], "A": 0.0}, "loading": {"control": "machine"},
                                     "physical": {"R": "5 um", "E": "2 MPa", "work_of_adhesion": "45 mJ/m^2", "a_max": "2 um", "spring_constant": ["3 N/m", "9 N/m"]}},
    "another shape": {"outputs": [*OUTPUTS], "parameters": PUNCH | {"lambda_over_R": 0.3}, "profile": SHAPE},
    "dead load": {"outputs": [*OUTPUTS], "parameters": PUNCH | {"lambda_over_R": 0.3}, "profile": SHAPE, "loading": {"control": "load"}},
    "machine": {"outputs": [*OUTPUTS], "parameters": PUNCH | {"lambda_over_R": 0.3, "a_max_over_R": [0.6, 0.8]}, "profile": SHAPE, "loading": {"control": "machine", "machine_stiffness": [0.1, 3.0]}},
    "roughness": {"parameters": PUNCH | {"A": 0.004, "a_max_over_R": 0.4}, "profile": {"spectrum": {"hurst": 0.8, "first": 1, "last": 4, "realisations": 2, "seed": 3}}},
    "sensitivities": {"parameters": PUNCH, "outputs": ["pull_off_force", "dissipated_energy", "pull_off_force_sensitivity", "dissipated_energy_sensitivity"]},
    "uncertainty": {"parameters": PUNCH | {"A": 0.02}, "uncertainty": {"modulus": "5 %", "samples": 8, "seed": 1}},
    "turned": {"parameters": PUNCH | {"indentation_max_over_R": [-0.1, 0.05]}},
    "two works": {"parameters": PUNCH | {"a_max_over_R": 0.7, "closing_ratio": [0.5, 1.0]}},
    "pattern": {"parameters": PUNCH | {"a_max_over_R": 0.7, "toughness_wavelength_over_R": [0.1, 0.2]}, "toughness": {"harmonics": [{"n": 1, "sin": 0.2}], "of": "work"}},
    "optimum": {"kind": "optimum", "outputs": None, "parameters": SEARCHED, "optimum": {"maximise": "pull_off_force", "over": ["lambda_over_R"], "resolution": 20}},
    "curve": CURVE | {"outputs": ["equilibrium", "path", "asymptotic", "envelope", "effective", "smooth"]},
    "points of curves": CURVE | {"layout": "points", "outputs": ["path", "jumps"], "parameters": CURVE["parameters"] | {"A": [0.02, 0.0]}},
    "jumps": CURVE | {"outputs": ["jumps", "smooth"], "loading": {"control": "machine", "machine_stiffness": 9.0}},
    "curve in units": {"kind": "curve", "outputs": ["path", "jumps"], "parameters": {"k": 0.3, "nu": 0.3, "A": [0.0, 0.01]}, "physical": TIP | {"a_max": "0.4 um"}},
    "curves of a pattern": CURVE | {"outputs": ["path", "equilibrium", "closing_equilibrium", "jumps"], "parameters": CURVE["parameters"] | {"closing_ratio": 0.4, "toughness_wavelength_over_R": 0.1}, "toughness": {"harmonics": [{"n": 1, "cos": 0.3}]}},
    "curves at a speed": CURVE | {"outputs": ["path", "equilibrium"], "parameters": CURVE["parameters"] | {"speed_over_reference": 0.1}, "rate": {"exponent": 0.6, "closing": "same"}},
    "states": CURVE | {"outputs": ["pressure", "surface"]},
}  # fmt: skip
call = partial(command, code=0)
SAMPLE = ("--sample", "8", "--seed", "1")
CHECKED = ("map", "points", "solvers", "similarity", "Young's modulus and a spring", "roughness", "sensitivities", "uncertainty", "two works",
           "optimum", "curve", "jumps", "curve in units", "states", "a part", "reduced")  # fmt: skip
"""Those whose names and attributes differ."""
BROWSED = ("map", "points", "solvers", "roughness", "sensitivities", "curve", "curve in units")
"""Those whose pages test_explore_page.py opens; their pictures are saved."""
PAGED = ("points of solvers", "points of similarity", "units", "machine", "uncertainty", "optimum", "jumps", "curves of a pattern", "states")  # fmt: skip
"""Others whose pages have sliders, sections or words of their own."""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """A dataset of each kind, computed in blocks of few scenes; and those that are made of others."""
    folder = tmp_path_factory.mktemp("kinds")
    paths = {kind: folder / f"{kind}.nc" for kind in KINDS}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("GRADHESION_CHUNK", "3")
        for kind, keys in KINDS.items():
            study = {key: value for key, value in (STUDY | keys).items() if value is not None}
            path = paths[kind].with_suffix(".toml")
            path.write_text(study_from(study).text, encoding="utf-8")
            call("run", path, "-o", paths[kind], "--quiet", "--threads", "2")
    for name, words in {"a part": ["--at", "lambda_over_R=0.2:0.4"], "reduced": ["--over", "k=max"]}.items():
        paths[name] = folder / f"{name}.nc"
        call("select", paths["map"], *words, "-o", paths[name])
    paths["fit"] = folder / "fit.nc"
    call("run", ROOT / "configs" / "fit.toml", "-o", paths["fit"], "--quiet", '--set=fit.intervals="linear"')
    return paths


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_in_blocks_is_what_python_computes_in_one(kind: str, files: dict[str, Path]) -> None:
    """Names, dimensions, types, values and attributes."""
    computed = compute(load_study(files[kind].with_suffix(".toml")), threads=1)
    with xarray.open_dataset(files[kind]) as written:
        for one in (computed, written):
            del one.attrs["history"]
            for variable in one.variables.values():
                for key in ("flag_masks", "flag_values"):  # a file gives a number for an array of one
                    if key in variable.attrs:
                        variable.attrs[key] = np.atleast_1d(variable.attrs[key]).tolist()
        xarray.testing.assert_identical(computed, written.load())
        types = ({name: one.dtype for name, one in found.variables.items() if one.dtype.kind not in "OU"} for found in (computed, written))  # fmt: skip
        assert next(types) == next(types)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_command_takes_it_and_changed_values_of_maps_are_found(
    kind: str, files: dict[str, Path], tmp_path: Path
) -> None:
    """Results, those in SI units, and parameters that follow from others."""
    told = call("info", files[kind])
    with xarray.open_dataset(files[kind]) as dataset:
        plain = [name for name in map(str, dataset.data_vars) if f"{name}_si" not in dataset]
        shown = [name for name in plain if dataset[name].dtype == float and not name.endswith("branch")]
        assert [name for name in shown if name not in told.stdout] == []
    if kind in BROWSED:
        call("plot", files[kind], "-o", tmp_path / "x.svg")
    else:
        gr.plot(files[kind]).figure.draw_without_rendering()
    if kind in PAGED:
        call("explore", files[kind], "-o", tmp_path / "x.html", code=2 * (kind == "states"))
    path, is_map = tmp_path / "x.nc", KINDS[kind].get("kind", "map") == "map"
    told = call("verify", files[kind], *SAMPLE, code=0 if is_map else 2)
    if not is_map:
        assert told.stdout == ""
        return
    with netCDF4.Dataset(files[kind]) as file:
        given = file.study.partition("[parameters]")[2]
        of_punch = [name for name in ("modulus", "lambda_over_R", "A", "a_max_over_R") if file[name].ndim]
        results = [name for name in file.variables if name.endswith(("force", "energy", "_si"))]
        changes = [[name for name in results if np.isfinite(file[name][:]).any()]]
        changes += [[name] for name in of_punch if f"\n{name} =" not in given and np.isfinite(file[name][:]).any()]
    for names in changes:
        shutil.copy(files[kind], path)
        with netCDF4.Dataset(path, "a") as file:
            for name in names:
                file[name][...] = file[name][...] * (1 + 1e-11)
        found = gr.verify(path, sample=8, seed=1)
        assert found.exceeding
        if names is changes[0]:
            assert {one.output for one in found.deviations if one.share > 1.0} >= {*names}


def test_the_checker_of_the_conventions_has_nothing_to_say(files: dict[str, Path]) -> None:
    """In one process; of a fit it takes differences of the names along a dimension, which it cannot, and ends with a code."""
    those = [files[kind] for kind in (*CHECKED, "fit")]
    command = [Path(sys.prefix) / "bin" / "compliance-checker", "-t", "cf:1.11", "-c", "strict", *those]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stdout.count("All tests passed!") == len(those), done.stdout + done.stderr


def test_pint_knows_every_unit(files: dict[str, Path]) -> None:
    for kind, file in files.items():
        with xarray.open_dataset(file) as dataset:
            quantified = dataset.pint.quantify()
            for name, variable in dataset.variables.items():
                unit = variable.attrs.get("units", "")
                assert not unit or quantified[name].pint.units == pint.Unit(unit), (kind, name)
            for unit in dataset["parameter_units"].values if kind == "fit" else ():
                assert pint.Unit(unit)


@pytest.mark.parametrize("reader", [["ncdump", "-h"], ["ncks", "-M", "-m"]], ids=["ncdump", "NCO"])
def test_others_read_them(reader: list[str], files: dict[str, Path]) -> None:
    if not shutil.which(reader[0]):
        pytest.skip(f"{reader[0]} is not installed")
    for file in files.values():
        done = subprocess.run([*reader, file], capture_output=True, text=True, check=True)
        assert "status" in done.stdout
