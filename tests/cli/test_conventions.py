"""Datasets of every kind keep to CF-1.11, by a checker of others, and other programs read them."""

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pint
import pint_xarray  # noqa: F401 (registers the accessor)
import pytest
import xarray

from gradhesion.cli.dataset.fits.fit import write_fit
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.dataset.select import selected, write_dataset
from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.reading import load_any, study_from
from gradhesion.cli.work.solve.fitting import fits_of

CONFIGS = Path(__file__).parents[2] / "configs"
UNITS = {"R": ["1 um", "2 um"], "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm", "a_max": "inf"}
SHAPE = {"exponent": 2.5, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 2, "sin": 0.2}]}
CHANGES: dict[str, dict[str, Any]] = {
    "map": {},
    "solvers": {"method": {"solver": ["exact", "envelope"]}},
    "points": {"layout": "points", "parameters": {"k": [0.1, 0.2], "lambda_over_R": 0.2, "A": [0.01, 0.02], "a_max_over_R": 1.0}},
    "curve": {"kind": "curve", "outputs": ["equilibrium", "path"]},
    "jumps": {"kind": "curve", "outputs": ["jumps"], "profile": SHAPE, "loading": {"control": "machine", "machine_stiffness": [1.0, 9.0]}},
    "physical": {"parameters": {"k": 0.3, "nu": 0.3, "A": [0.0, 0.01]}, "physical": UNITS | {"wavelength": ["50 nm", "90 nm"], "spring_constant": "2 N/m"}, "loading": {"control": "machine"}},
}  # fmt: skip


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """One dataset of each kind."""
    folder = tmp_path_factory.mktemp("datasets")
    common = {"outputs": ["pull_off_force", "dissipated_energy", "loading_jumps"]}
    parameters = {"k": [0.0, 0.3], "nu": 0.3, "modulus": 400.0, "c0_over_R": 0.01}
    parameters |= {"lambda_over_R": [0.1, 0.2, 0.4], "A": 0.02, "a_max_over_R": [1.0, float("inf")]}
    paths = {}
    for kind, changes in CHANGES.items():
        own = changes.get("parameters", {})
        table = own if "physical" in changes else parameters | own
        paths[kind] = folder / f"{kind}.nc"
        write(study_from(common | changes | {"parameters": table}), paths[kind], history="made by a test")
    for kind, wishes in {"part": (["lambda_over_R=0.1:0.3"], ()), "reduced": ((), ["k=max"])}.items():
        paths[kind] = folder / f"{kind}.nc"
        with opened(paths["map"]) as whole:
            write_dataset(selected(whole, *wishes), paths[kind], overwrite=False)
    paths["fit"] = folder / "fit.nc"
    fit = load_any(CONFIGS / "fit.toml", ['fit.intervals="linear"'])
    assert isinstance(fit, FitStudy)
    write_fit(fit, fits_of(fit), paths["fit"], history="made by a test", overwrite=False)
    return paths


@pytest.mark.parametrize("kind", [*CHANGES, "fit"])
def test_pint_knows_every_unit(kind: str, files: dict[str, Path]) -> None:
    with xarray.open_dataset(files[kind]) as dataset:
        quantified = dataset.pint.quantify()
        units = {name: variable.attrs.get("units", "") for name, variable in dataset.variables.items()}
        for name, unit in units.items():
            assert not unit or quantified[name].pint.units == pint.Unit(unit)
        for unit in dataset["parameter_units"].values if kind == "fit" else ():
            assert pint.Unit(unit)
    if kind == "physical":
        assert (units["work_of_adhesion"], units["spring_constant"]) == ("J/m^2", "N/m")


def checker(*files: Path) -> subprocess.CompletedProcess[str]:
    """Run the checker of others."""
    command = Path(sys.prefix) / "bin" / "compliance-checker"
    return subprocess.run(
        [command, "-t", "cf:1.11", "-c", "strict", *files], capture_output=True, text=True, check=False
    )


def test_the_checker_has_nothing_to_say(files: dict[str, Path]) -> None:
    others = [file for kind, file in files.items() if kind != "fit"]
    done = checker(*others)
    assert done.stdout.count("All tests passed!") == len(others), done.stdout + done.stderr
    assert done.returncode == 0


def test_the_checker_has_nothing_to_say_of_a_fit(files: dict[str, Path]) -> None:
    """It takes differences of the names along a dimension, which it cannot, and says so with another exit code."""
    assert "All tests passed!" in checker(files["fit"]).stdout


@pytest.mark.parametrize("reader", [["ncdump", "-h"], ["ncks", "-M", "-m"]], ids=["ncdump", "NCO"])
@pytest.mark.parametrize("kind", [*CHANGES, "fit"])
def test_others_read_them(reader: list[str], kind: str, files: dict[str, Path]) -> None:
    if not shutil.which(reader[0]):
        pytest.skip(f"{reader[0]} is not installed")
    done = subprocess.run([*reader, files[kind]], capture_output=True, text=True, check=True)
    assert "status" in done.stdout


def test_values_are_read_without_this_package(files: dict[str, Path]) -> None:
    if not shutil.which("ncdump"):
        pytest.skip("ncdump is not installed")
    text = subprocess.run(["ncdump", "-v", "k", files["map"]], capture_output=True, text=True, check=True).stdout
    assert "k = 0, 0.3 ;" in text
