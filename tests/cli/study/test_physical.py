"""Studies in units: texts become doubles and then the scenes of their ratios, with results in SI beside; what may be left out."""

import math
from itertools import product
from typing import Any, Final

import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st

from gradhesion.cli.dataset import compute
from gradhesion.cli.names.outputs import SI, UNITS
from gradhesion.cli.study import study_from
from gradhesion.cli.study.text.quantities import WORDS, si_value
from gradhesion.core import OUTPUTS
from gradhesion.core.problem.inputs import PHYSICAL

EPS: Final = 2.0**-52
TIP = {"R": ["1 um", "1.3 um"], "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "13 nm", "wavelength": "0.2 um"}  # fmt: skip
VALUES = ["pull_off_force", "dissipated_energy", "loading_jumps"]
R, E_STAR, WORK = 1.7e-6, 2.3e6, 0.045
PROBE = {"R": "1.7 um", "E_star": "2.3e-3 GPa", "work_of_adhesion": "45 mN/m", "c0": "510 nm", "wavelength": "0.425 um"}
RATIOS = {"modulus": E_STAR * R / WORK, "c0_over_R": 0.3, "lambda_over_R": 0.25}
RIM, RIM_RATIO = {"a_max": "1.36e-3 mm"}, {"a_max_over_R": 0.8}
PATTERN = {"toughness": {"harmonics": [{"n": 1, "cos": 0.3}, {"n": 2, "sin": 0.1}]}}
SPRING, MACHINE = {"spring_constant": "7.82 nN/nm"}, {"loading": {"control": "machine"}}
SPEED = {"speed": "20 nm/s", "reference_speed": "1 um/s"}
CASES: Final[dict[str, tuple[dict[str, str], dict[str, float], dict[str, Any]]]] = {
    "a rim": (RIM, RIM_RATIO, {}),
    "a depth": ({"indentation_max": "34 nm"}, {"indentation_max_over_R": 0.02}, {}),
    "a preload": ({"preload": "900 nN"}, {"load_max": 9e-7 / (1.5 * math.pi * R * WORK)}, {}),
    "a dead load": (RIM, RIM_RATIO, {"loading": {"control": "load"}}),
    "a machine": (RIM | SPRING, RIM_RATIO | {"machine_stiffness": 7.82 / (E_STAR * R)}, MACHINE),
    "two works": (RIM | {"work_of_adhesion_closing": "4.5 mJ/m^2"}, RIM_RATIO | {"closing_ratio": 0.1}, {}),
    "a pattern": (RIM | {"toughness_wavelength": "340 nm"}, RIM_RATIO | {"toughness_wavelength_over_R": 0.2}, PATTERN),
    "a speed": (RIM | SPEED, RIM_RATIO | {"speed_over_reference": 0.02}, {"rate": {"exponent": 0.6}}),
}
"""Quantities of a cycle, their ratios, and what else the study has."""
BALL: dict[str, Any] = {"k": 0.0, "nu": 0.3, "A": 0.0}
PIECES = st.sampled_from(["m", "k", "Pa", "inf", "e5", "deg", "**", "-2", *"1/*^ ()'\\é²\n_.,"])
QUANTITIES = [
    ("1 um", "R", 1e-6), ("1 µm", "R", 1e-6), ("1 μm", "R", 1e-6), ("0.3mm", "R", 0.3e-3), ("3 * angstrom", "R", 3e-10),
    (" 7e2 nm ", "c0", 7e-7), (".5 inch", "wavelength", 0.0127), ("50 kPa", "E_star", 5e4), ("1.7 MPa", "E_star", 1.7e6),
    ("2 N/mm^2", "E_star", 2e6), ("5e10 dyn/cm^2", "E_star", 5e9), ("20 mJ/m^2", "work_of_adhesion", 0.02),
    ("20 mJ/m²", "work_of_adhesion", 0.02), ("20 mJ m-2", "work_of_adhesion", 0.02), ("20 mJ m**-2", "work_of_adhesion", 0.02),
    ("20 mN/m", "work_of_adhesion", 0.02), ("50 erg/cm^2", "work_of_adhesion", 0.05), ("0 nm", "amplitude", 0.0),
    ("-0 nm", "amplitude", 0.0), ("inf", "a_max", float("inf")), ("inf mm", "a_max", float("inf")),
    (float("inf"), "a_max", float("inf")),
]  # fmt: skip
NO_QUANTITIES = [
    ("1", "without a unit"), (0.001, "without a unit"), (3, "without a unit"), (True, "not a number"), (["1 m"], "not a number"),
    ("mm", "not a number"), ("", "not a number"), ("1 2 mm", '"2 mm"'), ("1 foo", '"foo"'), ("1 m**m", '"m**m"'), ("1 m*", '"m*"'),
    ("1 __import__('os')", "not a known unit"), ("1 degC", '"degC"'), ("1 %", '"%"'), ("1 m^99999999", '"m^99999999"'),
    ("1" * 70 + " m", "not a number"), ("300,5 nm", "comma"), ("1,000 nm", "comma"),
]  # fmt: skip


def made(parameters: dict[str, Any], outputs: Any = tuple(VALUES), **tables: Any) -> xarray.Dataset:
    return compute(study_from({"outputs": [*outputs], "parameters": parameters, **tables}))


@pytest.mark.parametrize("case", CASES)
def test_quantities_are_the_scenes_of_their_ratios_and_have_the_same_bits(case: str) -> None:
    quantities, ratios, more = CASES[case]
    numbers = {"k": [0.0, 0.31, 0.8], "nu": 0.3, "A": [0.0, 0.02]}
    outputs = [name for name in OUTPUTS if "rate" not in more or not name.endswith("_jumps")]
    units = made(numbers, outputs, physical=PROBE | quantities, **more)
    for name, ratio in (RATIOS | ratios).items():  # each text is rounded once, and so is each step
        assert units[name].item() == pytest.approx(ratio, rel=4 * EPS), name
    own = {name: units[name].item() for name in RATIOS | ratios}
    stiffness = {name: own.pop(name) for name in ("machine_stiffness",) if name in own}
    plain = made(numbers | own, outputs, **(more | {"loading": more.get("loading", {}) | stiffness}))
    size = {"N": 1.5 * math.pi * R * WORK, "J": R * R * WORK, "m": R}
    for name in (*outputs, "status"):
        np.testing.assert_array_equal(units[name].values, plain[name].values, err_msg=name)
        if name in UNITS:
            np.testing.assert_allclose(units[name + SI], plain[name] * size[UNITS[name]], rtol=8 * EPS, err_msg=name)
    assert np.isfinite(plain["pull_off_force"]).all()


def test_axes_have_units_and_ratios_follow() -> None:
    waves = {"start": "110 nm", "stop": "470 nm", "num": 3, "spacing": "log"}
    physical = TIP | {"wavelength": waves, "a_max": ["1.7 um", math.inf]}
    dataset = made({"k": [0.0, 0.31], "nu": 0.27, "A": [0.0, 0.023]}, physical=physical)
    assert list(dataset["pull_off_force"].dims) == ["k", "R", "wavelength", "A", "a_max"]
    assert dataset["lambda_over_R"].dims == ("R", "wavelength")
    assert (dataset["modulus"].dims, dataset["a_max_over_R"].dims) == (("R",), ("R", "a_max"))
    units = {"R": "m", "E_star": "Pa", "work_of_adhesion": "J/m^2", "c0": "m", "wavelength": "m", "a_max": "m", "modulus": "1"}  # fmt: skip
    assert {name: dataset[name].units for name in units} == units
    assert (dataset["pull_off_force_si"].units, dataset["dissipated_energy_si"].units) == ("N", "J")
    assert "loading_jumps_si" not in dataset
    assert dataset["R"].values.tolist() == [1e-6, 1.3e-6]


def test_an_amplitude_in_metres_and_reduced_variables_beside_units() -> None:
    parameters = {"k": [0.0, 0.31], "nu": 0.27, "a_max_over_a2": 1.5}
    dataset = made(parameters, physical=TIP | {"amplitude": ["0 nm", "4 nm"]})
    assert dataset["A"].dims == ("R", "amplitude")  # through R in and out again
    np.testing.assert_allclose(dataset["A"].values, [[0.0, 0.02], [0.0, 0.02]], rtol=4 * EPS)
    assert dataset["a_max_over_R"].dims == ("k", "R", "amplitude")


def test_curves_have_units_too() -> None:
    parameters = {"k": 0.31, "nu": 0.27, "A": [0.0, 0.023]}
    dataset = made(parameters, ["path", "jumps"], kind="curve", physical=TIP | {"a_max": "0.4 um"})
    scale = 1.5 * math.pi * dataset["R"] * dataset["work_of_adhesion"]
    np.testing.assert_allclose(dataset["path_load_si"], dataset["path_load"] * scale, rtol=4 * EPS)
    for name, unit in {"path_load_si": "N", "jump_energy_si": "J", "path_contact_radius_si": "m"}.items():
        assert dataset[name].units == unit
    assert dataset["jump_energy_si"].dims == ("jump",)
    assert "path_branch_si" not in dataset


def test_a_smooth_homogeneous_ball_needs_four_numbers() -> None:
    """Johnson, Kendall & Roberts (1971): F = 1.5 pi R dgamma and H = 7.0922 (dgamma^5 R^4/E*^2)^(1/3)."""
    plain = made(BALL | {"modulus": 500.0})
    assert plain["pull_off_force"].item() == pytest.approx(1.0, rel=4 * EPS)
    assert plain["a_max_over_R"].item() == math.inf
    assert (plain["c0_over_R"].item(), plain["lambda_over_R"].item()) == (1.0, 1.0)
    assert [name for name in plain.coords if "comment" in plain[name].attrs] == ["c0_over_R", "lambda_over_R"]
    for name in ("c0_over_R", "lambda_over_R"):
        for value in (1e-3, 0.37, 40.0):
            other = made(BALL | {"modulus": 500.0, name: value})
            assert all(other[output].item() == plain[output].item() for output in VALUES)
    R, E_star, work = 5e-6, 1e9, 0.05
    dataset = made(BALL, physical={"R": "5 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2"})
    assert dataset["pull_off_force_si"].item() == pytest.approx(1.5 * math.pi * R * work, rel=1e-14)
    energy = 7.0922 * (work**5 * R**4 / E_star**2) ** (1 / 3)
    assert dataset["dissipated_energy_si"].item() == pytest.approx(energy, rel=1e-4)


def test_youngs_modulus_gives_the_reduced_one() -> None:
    others = {name: value for name, value in TIP.items() if name != "E_star"} | {"R": "1 um"}
    dataset = made({"k": 0.4, "nu": [-0.4, 0.0, 0.5], "A": 0.02}, physical=others | {"E": ["0.7 GPa", "1 GPa"]})
    assert dataset["E"].attrs["units"] == "Pa"
    assert {*dataset["modulus"].dims} == {"E", "nu"}
    for nu, modulus in product((-0.4, 0.0, 0.5), (0.7e9, 1e9)):
        reduced = others | {"E_star": f"{modulus / (1 - nu**2)!r} Pa"}
        expected, own = made({"k": 0.4, "nu": nu, "A": 0.02}, physical=reduced), dataset.sel(E=modulus, nu=nu)
        for output in VALUES:
            assert own[output].item() == pytest.approx(expected[output].item(), rel=1e-12)
    alone = made({"k": 0.4, "nu": 0.3, "A": 0.02}, physical=others | {"E": ["0.7 GPa", "1 GPa"]})
    assert alone["modulus"].dims == ("E",)


@pytest.mark.parametrize(("text", "name", "value"), QUANTITIES)
def test_a_quantity_is_the_double_next_to_it(text: str, name: str, value: float) -> None:
    assert si_value(text, name) == value


@pytest.mark.parametrize(("value", "words"), NO_QUANTITIES)
def test_what_is_no_quantity_is_told_with_what_is_expected(value: object, words: str) -> None:
    for name, key in PHYSICAL.items():
        with pytest.raises(ValueError, match=r"^[^\n]+$") as caught:
            si_value(value, name)
        assert words in str(caught.value)
        assert f"{WORDS[key.unit]} is expected; write for example {name} = " in str(caught.value)


@pytest.mark.parametrize("name", PHYSICAL)
def test_the_range_of_each(name: str) -> None:
    bounded = {"a_max": ("inf", "1e9999"), "indentation_max": ("-1", "0", "1e-9999")}
    bounded |= dict.fromkeys(("amplitude", "work_of_adhesion_closing", "speed"), ("0", "1e-9999"))
    for number in ("-1", "nan", "-inf", "1e-9999", "1e9999", "inf", "0"):
        text = f"{number} {PHYSICAL[name].unit}"
        if number in bounded.get(name, ()):
            si_value(text, name)
        else:
            with pytest.raises(ValueError, match=r"out of range; choose an? .* (with|that is finite)"):
                si_value(text, name)


@given(number=st.floats(1e-300, 1e300), unit=st.sampled_from(["nm", "um", "mm", "m"]))
def test_the_shortest_text_of_a_double_is_scaled_and_rounded_once(number: float, unit: str) -> None:
    exponent = {"nm": -9, "um": -6, "mm": -3, "m": 0}[unit]
    digits, _, power = f"{number:.17e}".partition("e")
    try:
        found = si_value(f"{digits}e{power} {unit}", "R")
    except ValueError:
        assert number * 10.0**exponent in (0.0, float("inf"))
    else:
        assert found == float(f"{digits}e{int(power) + exponent}")


@given(text=st.one_of(st.lists(PIECES, max_size=12).map("".join), st.text(max_size=12)))
def test_any_text_is_a_quantity_or_has_its_sentence(text: str) -> None:
    told = ""
    try:
        assert si_value(text, "a_max") > 0.0
    except ValueError as error:
        told = str(error)
    assert not told or "write for example" in told or "out of range" in told
