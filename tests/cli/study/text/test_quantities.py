"""Numbers with units become the doubles that they mean, and whatever else stands there gets its sentence."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradhesion.cli.study.rules.form import Range
from gradhesion.cli.study.rules.mistakes import checked
from gradhesion.cli.study.text.quantities import si_value
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL

UNITS = {
    "m": "a length (m)",
    "Pa": "a pressure (Pa)",
    "J/m^2": "an energy per area (J/m^2)",
    "N/m": "a force per length (N/m)",
    "N": "a force (N)",
    "m/s": "a speed (m/s)",
}


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("1 um", "R", 1e-6),
        ("1 µm", "R", 1e-6),
        ("1 μm", "R", 1e-6),
        ("0.3mm", "R", 0.3e-3),
        ("3 * angstrom", "R", 3e-10),
        (" 7e2 nm ", "c0", 7e-7),
        (".5 inch", "wavelength", 0.0127),
        ("50 kPa", "E_star", 5e4),
        ("1.7 MPa", "E_star", 1.7e6),
        ("2 N/mm^2", "E_star", 2e6),
        ("5e10 dyn/cm^2", "E_star", 5e9),
        ("20 mJ/m^2", "work_of_adhesion", 0.02),
        ("20 mJ/m²", "work_of_adhesion", 0.02),
        ("20 mJ m-2", "work_of_adhesion", 0.02),
        ("20 mJ m**-2", "work_of_adhesion", 0.02),
        ("20 mN/m", "work_of_adhesion", 0.02),
        ("50 erg/cm^2", "work_of_adhesion", 0.05),
        ("0 nm", "amplitude", 0.0),
        ("-0 nm", "amplitude", 0.0),
        ("inf", "a_max", float("inf")),
        ("inf mm", "a_max", float("inf")),
        (float("inf"), "a_max", float("inf")),
    ],
)
def test_a_quantity_is_the_double_next_to_it(text: str, name: str, value: float) -> None:
    assert si_value(text, name) == value


WRONG = {
    "no unit": ("1", "a number without a unit"),
    "a number": (0.001, "a number without a unit"),
    "an integer": (3, "a number without a unit"),
    "a bool": (True, "not a number with its unit, in quotes"),
    "a list": (["1 m"], "not a number with its unit, in quotes"),
    "no number": ("mm", "not a number with its unit"),
    "nothing": ("", "not a number with its unit"),
    "two numbers": ("1 2 mm", 'the unit "2 mm" is not known'),
    "unknown": ("1 foo", 'the unit "foo" is not known'),
    "wrong case": ("1 KPA", 'the unit "KPA" is not known'),
    "not a unit": ("1 m**m", 'the unit "m**m" is not known'),
    "half a unit": ("1 m*", 'the unit "m*" is not known'),
    "code": ("1 __import__('os')", "is not known"),
    "temperature": ("1 degC", '"degC" is not a unit of this quantity'),
    "percent": ("1 %", '"%" is not a unit of this quantity'),
    "power": ("1 m^99999999", '"m^99999999" is not a unit of this quantity'),
    "very long": ("1" * 70 + " m", "not a number with its unit"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_no_quantity_is_told_with_what_is_expected(case: str) -> None:
    value, message = WRONG[case]
    for name in PHYSICAL:
        with pytest.raises(ValueError, match=r".") as caught:
            si_value(value, name)
        sentence = str(caught.value)
        assert message in sentence
        assert f"{UNITS[PHYSICAL[name].unit]} is expected; write for example {name} = " in sentence
        assert "\n" not in sentence


@pytest.mark.parametrize("name", PHYSICAL)
def test_the_range_of_each(name: str) -> None:
    bounded = {"a_max": ("inf", "1e9999"), "indentation_max": ("-1", "0", "1e-9999")}
    bounded |= dict.fromkeys(("amplitude", "work_of_adhesion_closing", "speed"), ("0", "1e-9999"))
    allowed = bounded.get(name, ())
    for number in ("-1", "nan", "-inf", "1e-9999", "1e9999", "inf", "0"):
        text = f"{number} {PHYSICAL[name].unit}"
        if number in allowed:
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


pieces = st.sampled_from(
    [
        "1",
        "m",
        "/",
        "*",
        "^",
        "**",
        "-2",
        " ",
        "k",
        "Pa",
        "(",
        ")",
        "inf",
        "e5",
        "deg",
        "'",
        "\\",
        "é",
        "²",
        "\n",
        "_",
        ".",
    ]
)


@given(text=st.one_of(st.lists(pieces, max_size=12).map("".join), st.text(max_size=12)))
def test_any_text_is_a_quantity_or_has_its_sentence(text: str) -> None:
    told = ""
    try:
        assert si_value(text, "a_max") > 0.0
    except ValueError as error:
        told = str(error)
    assert not told or "write for example" in told or "out of range" in told


def test_tables_keep_their_form_and_all_mistakes_are_told() -> None:
    table: dict[str, Any] = {
        "R": ["1 mm", "2 mm"],
        "c0": {"start": "1 um", "stop": "1 mm", "num": 3, "spacing": "log"},
        "a_max": ["3 mm", float("inf")],
        "E_star": ["1 Pa", "1 m", 3.0],
        "wavelength": {"start": "1 J", "stop": 3, "num": 2},
        "amplitude": "wrong by its form already",
    }
    found = checked({"outputs": ["pull_off_force"], "parameters": {"k": 0.5, "nu": 0.3}, "physical": table})
    entries = {name: entry for name, entry in found.form.entries.items() if INPUTS[name].table == "physical"}
    assert isinstance(entries["c0"], Range)
    assert entries.pop("c0").model_dump() == {"start": 1e-6, "stop": 1e-3, "num": 3, "spacing": "log"}
    assert entries == {
        "R": [0.001, 0.002],
        "a_max": [0.003, float("inf")],
    }
    assert [mistake.path for mistake in found.mistakes] == [
        ("physical", "E_star", 1), ("physical", "E_star", 2), ("physical", "wavelength", "start"),
        ("physical", "wavelength", "stop"), ("physical", "amplitude"),
    ]  # fmt: skip
    assert found.wrong == {("physical", name) for name in ("E_star", "wavelength", "amplitude")}
    (mistake,) = checked(
        {"outputs": ["pull_off_force"], "parameters": {"k": 0.5, "nu": 0.3}, "physical": "no table"}
    ).mistakes
    assert mistake.path == ("physical",)
