"""Numbers with units become the doubles that they mean, and whatever else stands there gets its sentence."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradhesion.cli.study.text.quantities import WORDS, si_value
from gradhesion.core.problem.inputs import PHYSICAL


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("1 um", "R", 1e-6), ("1 µm", "R", 1e-6), ("1 μm", "R", 1e-6), ("0.3mm", "R", 0.3e-3), ("3 * angstrom", "R", 3e-10),
        (" 7e2 nm ", "c0", 7e-7), (".5 inch", "wavelength", 0.0127), ("50 kPa", "E_star", 5e4), ("1.7 MPa", "E_star", 1.7e6),
        ("2 N/mm^2", "E_star", 2e6), ("5e10 dyn/cm^2", "E_star", 5e9), ("20 mJ/m^2", "work_of_adhesion", 0.02),
        ("20 mJ/m²", "work_of_adhesion", 0.02), ("20 mJ m-2", "work_of_adhesion", 0.02), ("20 mJ m**-2", "work_of_adhesion", 0.02),
        ("20 mN/m", "work_of_adhesion", 0.02), ("50 erg/cm^2", "work_of_adhesion", 0.05), ("0 nm", "amplitude", 0.0),
        ("-0 nm", "amplitude", 0.0), ("inf", "a_max", float("inf")), ("inf mm", "a_max", float("inf")),
        (float("inf"), "a_max", float("inf")),
    ],
)  # fmt: skip
def test_a_quantity_is_the_double_next_to_it(text: str, name: str, value: float) -> None:
    assert si_value(text, name) == value


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("1", "without a unit"), (0.001, "without a unit"), (3, "without a unit"), (True, "not a number"), (["1 m"], "not a number"),
        ("mm", "not a number"), ("", "not a number"), ("1 2 mm", '"2 mm"'), ("1 foo", '"foo"'), ("1 m**m", '"m**m"'), ("1 m*", '"m*"'),
        ("1 __import__('os')", "not known"), ("1 degC", '"degC"'), ("1 %", '"%"'), ("1 m^99999999", '"m^99999999"'),
        ("1" * 70 + " m", "not a number"), ("300,5 nm", "300.5"), ("1,000 nm", "comma"),
    ],
)  # fmt: skip
def test_what_is_no_quantity_is_told_with_what_is_expected(value: object, words: str) -> None:
    for name, key in PHYSICAL.items():
        with pytest.raises(ValueError, match=r"^[^\n]+$") as caught:
            si_value(value, name)
        assert words in str(caught.value)
        assert f"{WORDS[key.unit]} is expected; write for example {name} = " in str(caught.value)


@pytest.mark.parametrize(
    ("text", "name", "unit"), [("3 Mpa", "E_star", "MPa"), ("3 KPA", "E", "kPa"), ("2 NM", "R", "nm")]
)
def test_a_unit_in_the_wrong_case_is_suggested(text: str, name: str, unit: str) -> None:
    with pytest.raises(ValueError, match=f'did you mean "{unit}"'):
        si_value(text, name)


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


PIECES = st.sampled_from(["m", "k", "Pa", "inf", "e5", "deg", "**", "-2", *"1/*^ ()'\\é²\n_.,"])


@given(text=st.one_of(st.lists(PIECES, max_size=12).map("".join), st.text(max_size=12)))
def test_any_text_is_a_quantity_or_has_its_sentence(text: str) -> None:
    told = ""
    try:
        assert si_value(text, "a_max") > 0.0
    except ValueError as error:
        told = str(error)
    assert not told or "write for example" in told or "out of range" in told
