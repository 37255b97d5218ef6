"""Studies in units: the same scenes as in ratios, and results in SI beside those without a unit."""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.explorer import choice
from gradhesion.cli.explorer.data import study_data
from gradhesion.cli.explorer.lines import lines_of
from gradhesion.cli.names.curves import CURVES
from gradhesion.cli.names.outputs import OUTPUTS, SI
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.picture.curves import drawn_curves
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.core import SENSITIVITIES, VALIDITY
from gradhesion.core.problem.names import CONTACT_SLOPE, RATE

Call = Callable[..., Result]
EPS = 2.0**-52
SCALES = {
    "microscope": (1e-6, 1e9, 0.05, {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2"}),
    "lens": (0.013, 7e5, 0.027, {"R": "13 mm", "E_star": "0.7 MPa", "work_of_adhesion": "27 mN/m"}),
    "metres": (1.7, 3e4, 0.1, {"R": "1.7 m", "E_star": "30 kPa", "work_of_adhesion": "100 erg/cm^2"}),
}
ALL = [
    name
    for name in OUTPUTS
    if not name.endswith("_residual") and name not in (*VALIDITY, CONTACT_SLOPE, *SENSITIVITIES, *RATE)
]


def lengths(R: float) -> dict[str, Any]:
    """Give the other quantities in metres, for a tip of radius R."""
    metres = {"c0": 0.031 * R, "wavelength": 0.057 * R}
    return {name: f"{value!r} m" for name, value in metres.items()} | {"a_max": [f"{0.4 * R!r} m", "inf"]}


@pytest.fixture
def physical(data: dict[str, Any]) -> dict[str, Any]:
    """The small study in units."""
    parameters = {"k": [0.0, 0.31], "nu": 0.27, "A": [0.0, 0.023]}
    quantities = {"R": ["1 um", "1.3 um"], "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "13 nm"}
    quantities |= {"wavelength": {"start": "110 nm", "stop": "470 nm", "num": 3, "spacing": "log"}}
    return data | {"parameters": parameters, "physical": quantities | {"a_max": ["1.7 um", float("inf")]}}


@pytest.mark.parametrize("scale", SCALES)
def test_both_ways_of_giving_a_scene_agree_to_the_last_digits(scale: str) -> None:
    R, E_star, work, written = SCALES[scale]
    study = {"outputs": ALL}
    parameters = {"k": [0.0, 0.31, 0.8], "nu": 0.27, "A": [0.0, 0.004, 0.023]}
    quantities = written | lengths(R)
    with_units = compute(study_from(study | {"parameters": parameters, "physical": quantities}))
    metres = [(float(str(quantities[name]).split()[0])) for name in ("c0", "wavelength")]
    ratios = {"modulus": E_star * R / work, "c0_over_R": metres[0] / R, "lambda_over_R": metres[1] / R}
    rims = [float(quantities["a_max"][0].split()[0]) / R, math.inf]
    plain = compute(study_from(study | {"parameters": parameters | ratios | {"a_max_over_R": rims}}))
    for name, value in ratios.items():
        assert float(with_units[name]) == pytest.approx(value, rel=2 * EPS)
    size = {"N": 1.5 * math.pi * R * work, "J": R * R * work, "m": R}
    for name in ALL:
        one, other = with_units[name].values, plain[name].values
        # inputs agree to two roundings; the radius of a flat trough magnifies these
        loose = name == "pull_off_radius"
        np.testing.assert_allclose(one, other, rtol=1e-7 if loose else 64 * EPS, atol=1e-300)
        if name in UNITS:
            expected = other * size[UNITS[name]]
            np.testing.assert_allclose(with_units[name + SI], expected, rtol=1e-7 if loose else 64 * EPS, atol=1e-300)


def test_jkr_in_newtons_and_joules() -> None:
    """F = 1.5 pi R dgamma and H = 7.0922 (dgamma^5 R^4/E*^2)^(1/3), Johnson, Kendall & Roberts (1971)."""
    R, E_star, work, written = SCALES["microscope"]
    parameters = {"k": 0.0, "nu": 0.3, "A": 0.0}
    study = {
        "outputs": ["pull_off_force", "dissipated_energy"],
        "parameters": parameters,
        "physical": written | lengths(R),
    }
    dataset = compute(study_from(study)).sel(a_max=math.inf)
    assert float(dataset["pull_off_force_si"]) == pytest.approx(1.5 * math.pi * R * work, rel=1e-13)
    assert float(dataset["dissipated_energy_si"]) == pytest.approx(
        7.0922 * (work**5 * R**4 / E_star**2) ** (1 / 3), rel=1e-4
    )


def test_axes_have_units_and_ratios_follow(physical: dict[str, Any]) -> None:
    dataset = compute(study_from(physical))
    assert list(dataset["pull_off_force"].dims) == ["k", "R", "wavelength", "A", "a_max"]
    assert dataset["lambda_over_R"].dims == dataset["pull_off_force"].dims[1:3]
    assert (dataset["modulus"].dims, dataset["a_max_over_R"].dims) == (("R",), ("R", "a_max"))
    units = {
        name: dataset[name].units
        for name in ("R", "E_star", "work_of_adhesion", "c0", "wavelength", "a_max", "modulus")
    }
    assert units == {
        "R": "m",
        "E_star": "Pa",
        "work_of_adhesion": "J/m^2",
        "c0": "m",
        "wavelength": "m",
        "a_max": "m",
        "modulus": "1",
    }
    assert (dataset["pull_off_force_si"].units, dataset["dissipated_energy_si"].units) == ("N", "J")
    assert "loading_jumps_si" not in dataset
    assert not any("_FillValue" in dataset[name].encoding for name in dataset.coords)
    assert dataset["R"].values.tolist() == [1e-6, 1.3e-6]


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["grid", "points"])
@pytest.mark.parametrize("solver", ["exact", ["envelope", "exact"]])
def test_the_file_is_the_same_in_whatever_blocks_and_is_verified(
    layout: str,
    solver: Any,
    physical: dict[str, Any],
    gradhesion: Call,
    write_study: Callable[[str], Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    physical |= {"layout": layout, "method": {"solver": solver}}
    if layout == "points":
        physical["physical"] |= {"wavelength": ["110 nm", "200 nm"]}
    study, path = write_study(study_from(physical).text), tmp_path / "x.nc"
    computed = compute(load_study(study))
    monkeypatch.setenv("GRADHESION_CHUNK", "3")
    assert gradhesion("run", study, "-o", path).exit_code == 0
    with xarray.open_dataset(path) as written:
        assert set(written.coords) == set(computed.coords)
        for name in computed.variables:
            np.testing.assert_array_equal(written[name].values, computed[name].values)
    told = " ".join(gradhesion("info", path).stdout.split())
    assert "R 1e-06, 1.3e-06 m" in told
    assert "pull_off_force_si: pull-off force F, in N" in told
    assert gradhesion("plot", path, "--variable", "pull_off_force_si").exit_code == 0
    result = gradhesion("verify", path, "--sample", "1000")
    assert result.exit_code == 0, result.stdout + result.stderr
    last = result.stdout.split("worst of each")[1]
    for name in ("modulus", "c0_over_R", "lambda_over_R", "a_max_over_R", "pull_off_force_si", "dissipated_energy_si"):
        assert f"{name} " in last
    with netCDF4.Dataset(path, "a") as file:
        file["dissipated_energy_si"][-1] *= 1 + 1e-11
    assert gradhesion("verify", path, "--sample", "1000").exit_code == 3


def test_an_amplitude_in_metres_and_reduced_variables_beside_units(physical: dict[str, Any]) -> None:
    del physical["parameters"]["A"]
    del physical["physical"]["a_max"]
    physical["physical"] |= {"wavelength": "0.2 um", "amplitude": ["0 nm", "4 nm"]}
    physical["parameters"]["a_max_over_a2"] = 1.5
    dataset = compute(study_from(physical))
    assert dataset["A"].dims == ("R", "amplitude")  # through R in and out again
    np.testing.assert_allclose(dataset["A"].values, [[0.0, 0.02], [0.0, 0.02]], rtol=4 * EPS)
    assert dataset["a_max_over_R"].dims == ("k", "R", "amplitude")


def test_curves_have_units_too(
    physical: dict[str, Any], gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    physical |= {"kind": "curve", "outputs": ["path", "jumps"]}
    physical["physical"] |= {"wavelength": "0.2 um", "a_max": "0.4 um"}
    study, path = write_study(study_from(physical).text), tmp_path / "x.nc"
    assert gradhesion("run", study, "-o", path).exit_code == 0
    with xarray.open_dataset(path) as dataset:
        scale = 1.5 * math.pi * dataset["R"] * dataset["work_of_adhesion"]
        np.testing.assert_allclose(dataset["path_load_si"], dataset["path_load"] * scale, rtol=4 * EPS)
        assert dataset["path_load_si"].units == "N"
        assert dataset["jump_energy_si"].units == "J"
        assert dataset["jump_energy_si"].dims == ("jump",)
        assert "path_branch_si" not in dataset
    told = " ".join(gradhesion("info", path).stdout.split())
    assert re.search(r"path_load_si \S+ to \S+ load P on the path of a loading cycle, in N", told)
    assert re.search(r"jump_energy_si \S+ to \S+ energy dissipated by the jump \(negative: gained\), in J", told)
    assert ",jump_energy,jump_load_before" in (header := gradhesion("info", path, "--jumps").stdout.splitlines()[0])
    assert "jump_energy_si" in header
    assert "path_load_si" in gradhesion("info", path, "--format", "csv", "--variable", "path").stdout.splitlines()[0]
    result = gradhesion("plot", path, "--variable", "path_load_si")
    assert result.exit_code == 0, result.stderr


@pytest.fixture
def curves_in_units(physical: dict[str, Any]) -> xarray.Dataset:
    """Curves of a tip of 1 um, whose depths are nanometres and whose loads are micronewtons."""
    physical |= {"kind": "curve", "outputs": ["equilibrium", "path", "smooth", "jumps"]}
    physical["physical"] |= {"R": "1 um", "wavelength": "0.2 um", "a_max": "0.4 um"}
    return compute(study_from(physical))


def test_curves_in_units_are_drawn_in_units(curves_in_units: xarray.Dataset) -> None:
    figure = drawn_curves(curves_in_units, [])
    labels = [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes]
    assert labels == [
        (r"depth $\delta$ (nm)", "load $P$ (µN)"),
        ("contact radius $a$ (nm)", r"depth $\delta$ (nm)"),
        ("contact radius $a$ (nm)", "load $P$ (µN)"),
    ]
    path = drawn_curves(curves_in_units.isel(k=0), ["path_load_si"]).axes[0]
    shown = np.concatenate([line.get_ydata() for line in path.get_lines() if len(line.get_xdata()) > 2])
    expected = curves_in_units["path_load_si"].isel(k=0)
    assert (np.nanmin(shown), np.nanmax(shown)) == (float(expected.min()), float(expected.max()))
    reduced = drawn_curves(curves_in_units, ["path_load"])
    assert reduced.axes[0].get_xlabel() == r"depth $\delta/R$"
    with pytest.raises(DatasetError, match="path_load has no unit and path_indentation_si has one"):
        drawn_curves(curves_in_units, ["path_load", "path_indentation_si"])


def test_a_page_of_curves_in_units_has_rows_of_them(curves_in_units: xarray.Dataset) -> None:
    """A variable of a curve once stood among the scalars: the second point of its first curve."""
    cut = choice.chosen(curves_in_units, [], [])
    lines = lines_of(cut)
    _, variables = study_data(cut, lines.units)
    rows = {variable["name"]: variable for variable in variables}
    assert {name for name, row in rows.items() if row["length"] == 1} == set()
    assert {(row["curve"] != "") for row in rows.values()} == {True}
    assert "path_load" not in rows
    drawn = {track[quantity] for track in lines.tracks for quantity in lines.labels}
    assert drawn <= {*rows}
    assert all(name.endswith(SI) for name in drawn)
    assert lines.labels == {
        "contact_radius": "contact radius a (nm)",
        "indentation": "depth δ (nm)",
        "load": "load P (µN)",
    }
    for name in ("path_load_si", "smooth_load_si", "load_si"):  # one unit, though their sizes differ
        expected = curves_in_units[name].values.ravel() / 1e-6
        np.testing.assert_allclose(rows[name]["values"], expected, rtol=5e-6, atol=0.0)


def test_every_output_over_something_has_its_unit_and_every_variable_its_symbol() -> None:
    plain = {"loading_jumps", "unloading_jumps", "roughness_parameter", "adhesion_gain", "energy_gain"}
    assert {*OUTPUTS} - {*UNITS} == {*plain, *VALIDITY, CONTACT_SLOPE, *SENSITIVITIES, *RATE}
    assert {name + SI for name in OUTPUTS if name in UNITS} <= {*SYMBOLS}
    for own in CURVES.values():
        for name in own:
            kind = next(
                (
                    unit
                    for end, unit in (("_radius", "m"), ("indentation", "m"), ("load", "N"), ("energy", "J"))
                    if name.endswith(end)
                ),
                None,
            )
            if kind:
                assert UNITS[name] == kind
    assert UNITS["jump_radius_before"] == "m"
    assert UNITS["jump_load_after"] == "N"


def test_what_is_missing_is_told_at_once(
    physical: dict[str, Any], gradhesion: Call, write_study: Callable[[str], Path]
) -> None:
    text = write_study(study_from(physical).text)
    text.write_text(text.read_text().split("[physical]")[0] + "[physical]\n")
    lines = gradhesion("run", text).stderr.splitlines()
    assert len(lines) == 5
    for name in ("R", "E_star", "work_of_adhesion", "c0", "wavelength"):
        (line,) = [line for line in lines if f"physical.{name}: " in line]
        assert f" {name} = " in line, "an example"
    assert any("E_star = " in line and " E = " in line for line in lines), "what may stand instead"


def test_a_machine_has_its_spring_constant_in_newtons_per_metre() -> None:
    """The ratio is S/(E* R); the dataset has it beside the quantity, over the axes of both."""
    R, E_star, _, written = SCALES["microscope"]
    table = {"outputs": ["pull_off_force", "dissipated_energy"], "loading": {"control": "machine"}}
    table |= {"parameters": {"k": 0.31, "nu": 0.27, "A": 0.023}}
    constants = [0.2, 41.0]
    with_units = compute(
        study_from(table | {"physical": written | lengths(R) | {"spring_constant": ["0.2 N/m", "41 kN/km"]}})
    )
    ratios = [constant / (E_star * R) for constant in constants]
    assert with_units["spring_constant"].attrs["units"] == "N/m"
    assert with_units["dissipated_energy"].dims == ("spring_constant", "a_max")
    np.testing.assert_allclose(with_units["machine_stiffness"].values, ratios, rtol=2 * EPS)
    plain = compute(
        study_from(
            table | {"physical": written | lengths(R), "loading": {"control": "machine", "machine_stiffness": ratios}}
        )
    )
    for name in table["outputs"]:
        np.testing.assert_allclose(with_units[name].values, plain[name].values, rtol=64 * EPS)
