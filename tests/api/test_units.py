"""A quantity means the same whatever package it is of and wherever it stands, or is refused with its unit and the one wanted."""

import math
from decimal import Decimal
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import netCDF4
import numpy as np
import pandas as pd
import pint
import pint_xarray  # noqa: F401 (registers the accessor)
import pytest
import xarray

import gradhesion as gr
from tests.conftest import mistakes

ureg = pint.UnitRegistry()
um = ureg.um
other = pint.UnitRegistry(non_int_type=Decimal)
own = pint.UnitRegistry()
own.define("micron = 2 um")  # which is 1 um elsewhere
own.define("apple = [fruit]")

BULK = {"nu": 0.5, "E": "2 MPa", "work_of_adhesion": "50 mJ/m^2", "k": 0.0}
WAVY = BULK | {"R": "25 um", "wavelength": "1 um", "A": 0.05}
STUDY: dict[str, Any] = {
    "outputs": ["pull_off_force"],
    "parameters": {"k": 0.0, "nu": 0.5, "A": 0.05},
    "physical": {"E": 2 * ureg.MPa, "work_of_adhesion": 50 * ureg.mJ / ureg.m**2, "wavelength": 1 * um, "R": [25 * um, "50 um"]},
}  # fmt: skip


class Quantity(np.ndarray):  # type: ignore[type-arg]
    """An array with a unit, of which numpy keeps the numbers, as other packages give it."""

    def in_mks(self) -> Any:
        return SimpleNamespace(value=self.value * self.units.factor, units=self.units.base)


class Unit:
    """A unit of astropy or unyt: a number times it is a quantity."""

    def __init__(self, text: str, factor: float, base: str, *, unyt: bool = False) -> None:
        self.text, self.factor, self.base, self.unyt = text, factor, base, unyt

    def __str__(self) -> str:
        return self.text

    def quantity(self, numbers: Any) -> Any:
        made = np.asarray(numbers, dtype=float).view(Quantity)
        made.value = np.asarray(numbers, dtype=float)
        if self.unyt:
            made.units = self
        else:
            made.unit, made.si = self, SimpleNamespace(value=made.value * self.factor, unit=self.base)
        return made

    __rmul__ = quantity


AU_UM = Unit("um", 1e-6, "m")
UNYT_UM = Unit("\u03bcm", 1e-6, "m", unyt=True)


class PintColumn(pd.Series):  # type: ignore[type-arg]
    """A column of pandas as pint-pandas makes it."""

    @property
    def array(self) -> Any:
        return SimpleNamespace(quantity=ureg.Quantity(np.asarray(self.values), "um"))


def series_with_attribute() -> Any:
    column = pd.Series([25.0, 50.0])
    column.attrs["units"] = "um"
    return column


def netcdf_variable() -> Any:
    """Give a variable of a file that is open."""
    file = netCDF4.Dataset("units", "w", diskless=True)
    file.createDimension("n", 2)
    variable = file.createVariable("R", "f8", ("n",))
    variable[:], variable.units = [25.0, 50.0], "um"
    return variable


def quantified(name: str = "R") -> xarray.DataArray:
    """Give an axis that pint-xarray has given its unit, in its index as well."""
    dataset = xarray.Dataset(coords={name: (name, [25.0, 50.0], {"units": "um"})})
    return dataset.pint.quantify()[name]


def called(value: Any, name: str = "R", scene: dict[str, Any] = BULK | {"A": 0.0}) -> xarray.DataArray:
    """Give what a call makes of a value."""
    return gr.solve(scene, "pull_off_force", **{name: value})[name]


ALONG_T = xarray.DataArray([25.0, 50.0], dims="t", coords={"t": quantified("t")}, attrs={"units": "um"})
SAME: dict[str, tuple[Any, tuple[str, ...]]] = {
    "pint": (25 * um, ()),
    "another registry": (other.Quantity("25 um"), ()),
    "decimal": (ureg.Quantity(Decimal("0.025"), "mm"), ()),
    "a unit that it means otherwise": (12.5 * own.micron, ()),
    "a unit of many": (ureg.Quantity(25.0, "um * kilogram * millimeter / gram / meter"), ()),
    "in an array of xarray": (xarray.DataArray(ureg.Quantity(np.array(25.0), "um")), ()),
    "attribute": (xarray.DataArray(25.0, attrs={"units": "um"}), ()),
    "astropy": (AU_UM.quantity(25.0), ()),
    "unyt": (UNYT_UM.quantity(25.0), ()),
    "a unit that only astropy knows": (Unit("Angstrom", 1.0000000000000002e-10, "m").quantity(250_000.0), ()),
    "number": (25e-6, ()),
    "pints": (np.array([25.0, 50.0]) * um, ("R",)),
    "list": ([25 * um, 0.05 * ureg.mm], ("R",)),
    "quantities and texts": ((25 * um, "50 um"), ("R",)),
    "arrays in a list": ([xarray.DataArray(25.0, attrs={"units": "um"}), "50 um"], ("R",)),
    "xarray": (xarray.DataArray([25, 50] * um, dims="x"), ("x",)),
    "xarray of objects": (xarray.DataArray(np.array([25 * um, 50 * um], dtype=object), dims="x"), ("x",)),
    "pint-xarray": (quantified(), ("R",)),
    "pint-xarray, along another": (ALONG_T, ("t",)),
    "pandas": (pd.Series([25 * um, 50 * um]), ("index",)),
    "pint-pandas": (PintColumn([25.0, 50.0]), ("index",)),
    "attribute of pandas": (series_with_attribute(), ("index",)),
    "netCDF4": (netcdf_variable(), ("R",)),
    "several of astropy": (AU_UM.quantity([25.0, 50.0]), ("R",)),
    "several of unyt": (UNYT_UM.quantity([25.0, 50.0]), ("R",)),
}
"""25 um, or 25 um and 50 um, and the dimensions of what it becomes."""


@pytest.mark.parametrize("case", SAME)
def test_quantities_are_what_their_texts_are(case: str) -> None:
    value, dims = SAME[case]
    found = called(value)
    assert (found.dims, found.attrs["units"]) == (dims, "m")
    assert found.values.tolist() == ([25e-6, 50e-6] if dims else 25e-6)


def test_without_end_and_without_value() -> None:
    found = gr.solve(BULK | {"A": 0.0, "R": 25 * um}, "pull_off_force", a_max=[1.0, math.inf] * um)
    assert found["a_max"].values.tolist() == [1e-6, math.inf]
    masked = ureg.Quantity(np.ma.array([1.0, 2.0], mask=[1, 0]), "um")
    for wrong in (math.inf * um, [math.nan, 1.0] * um, -1 * um, masked):
        with pytest.raises(gr.StudyError, match=r"R(\[0\])? = .*: out of range; choose .* with R > 0"):
            called(wrong)


RATIOS: list[tuple[Any, Any]] = [
    (5 * ureg.percent, 0.05),
    ([5 * ureg.percent, 0.1], [0.05, 0.1]),
    (50 * um / ureg.mm, 0.05),
    ([5.0, 10.0] * ureg.percent, [0.05, 0.1]),
    (xarray.DataArray(5, attrs={"units": "%"}), 0.05),
    (xarray.DataArray(0.05, attrs={"units": "1"}), 0.05),
    (Unit("%", 0.01, "").quantity(5.0), 0.05),
    ({"start": 0.0, "stop": 5 * ureg.percent, "num": 2}, [0.0, 0.05]),
]


@pytest.mark.parametrize(("value", "numbers"), RATIOS)
def test_a_ratio_may_have_a_unit_without_dimension(value: Any, numbers: Any) -> None:
    assert called(value, "A", WAVY).values.tolist() == numbers


OTHERWISE: dict[str, tuple[str, Any]] = {
    "joule": ("R", [1.0, 2.0] * ureg.J),
    "dimensionless": ("R", ureg.Quantity(5e-6, "")),
    "percent": ("R", [5 * ureg.percent]),
    "degree_Celsius": ("R", ureg.Quantity(25.0, "degC")),
    "kg": ("R", Unit("kg", 1.0, "kg").quantity(25.0)),
    "s": ("R", xarray.DataArray(25.0, attrs={"units": "s"})),
    "1": ("R", xarray.DataArray(25.0, attrs={"units": "1"})),
    "nanoseconds": ("R", np.timedelta64(5, "ns")),
    "apple": ("R", 5 * own.apple),
    "second": ("R", {"start": 1 * ureg.s, "stop": 2 * ureg.s, "num": 3}),
    "micrometer": ("A", [5 * um]),
    "meter": ("A", {"start": 0.0, "stop": 5 * ureg.m, "num": 2}),
    "decibel": ("A", ureg.Quantity(3.0, "dB")),  # no multiple of a number
}
"""The unit, and where it stands: of lengths and of ratios."""


@pytest.mark.parametrize("unit", OTHERWISE)
def test_another_dimension_is_refused_with_its_unit_and_what_is_wanted(unit: str) -> None:
    name, value = OTHERWISE[unit]
    told = mistakes(called, value, name, WAVY)
    for sentence in told:
        assert sentence.startswith(f"gr.solve: {name}")
        assert f'"{unit}"' in sentence
        assert ("a length (m)" if name == "R" else "a number without a unit") in sentence
    assert len(told) == (2 if unit == "second" else 1)


def test_radii_of_states_and_amplitudes_of_a_profile_are_ratios() -> None:
    scene = WAVY | {"R": "0.3 um", "wavelength": "0.1 um"}
    half = 50 * ureg.percent
    for radii in (half, [half], xarray.DataArray([50.0], dims="x", attrs={"units": "%"})):
        assert gr.curves(scene, "pressure", contact_radius_over_R=radii)["state"].values.tolist() == [0.5]
    for radius in (5 * um, [5 * um], -1.0):
        with pytest.raises(gr.StudyError, match=r"contact_radius_over_R\[0\] = "):
            gr.curves(scene, "pressure", contact_radius_over_R=radius)
    for profile in ({"harmonics": [{"n": 1, "cos": half}]}, gr.Profile(harmonics=(gr.Harmonic(n=1, cos=half),))):
        assert "0.5 (1 - cos(2 pi x))" in gr.solve(WAVY, "pull_off_force", profile=profile).attrs["profile"]
    with pytest.raises(gr.StudyError, match='cos = "1 micrometer": '):
        gr.solve(WAVY, "pull_off_force", profile={"harmonics": [{"n": 1, "cos": um * 1}]})


def test_a_study_takes_them_as_a_call_does(tmp_path: Path) -> None:
    study: Any = gr.load(STUDY)
    assert study.parameters["work_of_adhesion"] == 0.05
    (tmp_path / "study.toml").write_text(study.text)
    for value in (
        STUDY["physical"]["R"], [25.0, 50.0] * um, xarray.DataArray([25.0, 50.0], dims="x", attrs={"units": "um"}), quantified(), pd.Series([25 * um, 50 * um]),
        {"start": 25 * um, "stop": 0.05 * ureg.mm, "num": 2}, AU_UM.quantity([25.0, 50.0]),
    ):  # fmt: skip
        for where in (STUDY, tmp_path / "study.toml"):
            changed: Any = gr.load(where, set={"physical.R": value, "parameters.A": 10 * ureg.percent})
            assert changed.parameters["R"].tolist() == [25e-6, 50e-6]
            assert changed.parameters["A"] == 0.1
    for wrong in (25 * ureg.kg, 25e-6):
        for where in (STUDY, tmp_path / "study.toml"):
            with pytest.raises(gr.StudyError, match=r"physical.R = .* a length \(m\) is expected"):
                gr.load(where, set={"physical.R": wrong})


def test_uncertainties_are_quantities_or_shares() -> None:
    table = {"R": 2 * um, "wavelength": 5 * ureg.percent, "A": {"low": 4 * ureg.percent, "high": 0.06}, "E": {"low": 1 * ureg.MPa, "high": "3 MPa"}}  # fmt: skip
    study: Any = gr.load(STUDY | {"uncertainty": table})
    found = dict(study.uncertainty.deviations)
    assert (found["R"].deviation, found["R"].relative) == (2e-6, False)
    assert (found["wavelength"].deviation, found["wavelength"].relative) == (0.05, True)
    assert (found["A"].low, found["A"].high) == (0.04, 0.06)
    assert (found["E"].low, found["E"].high) == (1e6, 3e6)
    for name, unit in (("R", "kilogram"), ("A", "meter")):
        with pytest.raises(gr.StudyError, match=f'uncertainty.{name} = "1 {unit}": "{unit}" is not a unit'):
            gr.load(STUDY | {"uncertainty": {name: 1 * ureg.Unit(unit)}})


def test_a_fit_takes_them_in_ranges_and_noise(tmp_path: Path) -> None:
    depth = [*range(-2, 9), *range(7, -6, -1)]
    rows = "\n".join(f"{one},{one * abs(one) ** 0.5}" for one in depth)
    (tmp_path / "loop.csv").write_text("depth,force\n" + rows + "\n")
    study = {
        "kind": "fit",
        "data": {"file": str(tmp_path / "loop.csv"), "indentation": {"column": "depth", "unit": "nm"}, "load": {"column": "force", "unit": "nN"}},
        "parameters": {"k": 0.0, "nu": 0.5, "A": 0.0},
        "physical": {"R": 1 * um, "E_star": {"start": 0.1 * ureg.GPa, "stop": "10 GPa"}, "work_of_adhesion": {"start": 5 * ureg.mJ / ureg.m**2, "stop": 0.2 * ureg.N / ureg.m}},
        "fit": {"noise": {"load": 0.5 * ureg.nN, "indentation": 0.1 * ureg.nm}},
    }  # fmt: skip
    read: Any = gr.load(study)
    assert (read.fixed["R"], read.free["E_star"], read.free["work_of_adhesion"]) == (1e-6, (1e8, 1e10), (0.005, 0.2))
    assert read.given_noise == (1e-10, 5e-10)
    for key in ("physical.E_star.start", "fit.noise.load", "physical.R", "parameters.A"):
        with pytest.raises(gr.StudyError, match='"kilogram" is not a unit of this quantity'):
            gr.load(study, set={key: 1 * ureg.kg})
