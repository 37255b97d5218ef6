"""Numbers with units: `"50 kPa"` as the number of pascals that it is.

Units are those of pint. Numbers are converted in decimal arithmetic and rounded once, so that "1 um" is the double next
to 10^-6, as if it had been written in metres.
"""

import math
import re
from decimal import Decimal
from functools import cache
from tokenize import TokenError
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.problem.inputs import ANY, INPUTS, PHYSICAL, Input

if TYPE_CHECKING:
    from pint import UnitRegistry

QUANTITIES: Final = INPUTS | {
    "up_to": Input(
        "up_to",
        "distance from the centre up to which heights are fitted [a_max]",
        "",
        '"2 um"',
        unit="m",
        table="profile",
    ),
    "indentation": Input("indentation", "a depth", "", '"1 um"', ANY, unit="m", table="data"),
    "load": Input("load", "a load", "", '"1 nN"', ANY, unit="N", table="data"),
}
"""Every quantity that a study may have: its inputs, and those of files."""
LONGEST: Final = 60
"""Characters of a quantity: above any that is meant as one."""

_QUANTITY: Final = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?|[+-]?inf|nan)\s*\*?\s*(.*)")
_COMMA: Final = re.compile(r"([+-]?\d+),(\d+)")
_THOUSANDS: Final = re.compile(r"([+-]?[1-9]\d{0,2}(?:,\d{3})+(?![\d,]))(\.\d*)?")
"""A number that may have commas between its thousands, and its decimals after a point."""
_POWER: Final = re.compile(r"([^\W\d_])([+-]?\d)")
"""A power as UDUNITS and astropy write it, `m-2`."""
WORDS: Final = {
    "1": "a number without a unit",
    "m": "a length (m)",
    "Pa": "a pressure (Pa)",
    "J/m^2": "an energy per area (J/m^2)",
    "N/m": "a force per length (N/m)",
    "N": "a force (N)",
    "m/s": "a speed (m/s)",
}
"""What is expected of a quantity, by its unit in SI."""
_NO_UNIT: Final = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    RecursionError,
    SyntaxError,
    TokenError,
    TypeError,
    ValueError,
)
"""What pint raises where it is given no unit."""
_EXACT: Final = 10.0 ** np.arange(23)
"""The powers of ten that are doubles."""
_DIGITS: Final = 15
"""Decimals of so many digits are each the only one of their double."""


def si_value(value: object, name: str) -> float:
    """
    Give a quantity of [physical] in its unit in SI; an infinite one needs no unit.

    Raises
    ------
    ValueError
        It is no number with a unit of the right dimension, or out of range; the message says what to write.

    >>> si_value("1 um", "R"), si_value("20 mJ/m^2", "work_of_adhesion"), si_value("20 mN m-1", "work_of_adhesion")
    (1e-06, 0.02, 0.02)
    """
    key = QUANTITIES[name]
    text = str(value) if isinstance(value, str | float) else ""
    parts = _QUANTITY.fullmatch(text.strip()) if len(text) <= LONGEST else None
    number, written = parts.groups() if parts else ("", "")
    comma = _comma_in(text.strip())
    if isinstance(value, int | float) and not isinstance(value, bool) and "inf" not in number:
        problem = WORDS["1"]
    elif comma:
        problem = comma
    elif not parts:
        problem = "not a number with its unit, in quotes"
    else:
        problem = WORDS["1"] if not written and "inf" not in number else ""
    if problem:
        raise ValueError(f"{problem}; {_expected(name)}")
    result = float(Decimal(number) * (factor_of(written, name) if written else 1)) + 0.0
    if not key.admits(result):
        allowed = f"{WORDS[key.unit]} with {key.allowed}" if key.bounds else f"{WORDS[key.unit]} that is finite"
        unpressed = '; for a turn at zero depth write indentation_max = "0 nm"' if name == "preload" else ""
        raise ValueError(f"out of range; choose {allowed}{unpressed}")
    return result


def _comma_in(text: str) -> str:
    """
    Describe the comma in a number, and how to write the number without it; "" without one.

    >>> _comma_in("300,5 nm"), _comma_in("1,000 nm"), _comma_in("1,234.5 nm")  # doctest: +NORMALIZE_WHITESPACE
    ('a decimal comma; write a point, 300.5', 'a comma of decimals or between thousands; write 1.000 or 1000',
    'a comma between thousands; write 1234.5')
    """
    thousands, comma = _THOUSANDS.match(text), _COMMA.match(text)
    if thousands:
        plain = thousands[0].replace(",", "")
        if thousands[2] or thousands[1].count(",") > 1:
            return f"a comma between thousands; write {plain}"
        return f"a comma of decimals or between thousands; write {thousands[1].replace(',', '.')} or {plain}"
    return f"a decimal comma; write a point, {comma[1]}.{comma[2]}" if comma else ""


def in_si(numbers: NDArray[Any], written: str, name: str) -> NDArray[np.float64]:
    """
    Give numbers in some unit in that of a key in a dataset, of which a ratio has none; their range is not checked.

    Raises
    ------
    ValueError
        The unit is not known, or has another dimension; the message says what to write.

    >>> in_si(np.array([1.0, 25.0]), "um", "R"), in_si(np.array([5.0]), "percent", "A")
    (array([1.0e-06, 2.5e-05]), array([0.05]))
    """
    same = written == QUANTITIES[name].unit  # without asking pint
    return np.asarray(numbers, dtype=np.float64) + 0.0 if same else scaled(numbers, factor_of(written, name))


def factor_of(written: str, name: str) -> Decimal:
    """
    Report how many of the unit of a key another unit is.

    Raises
    ------
    ValueError
        It is not known, or has another dimension; the message says what to write.
    """
    factor = factor_between(written, QUANTITIES[name].unit)
    if not factor:
        unknown = factor is None
        problem = f'the unit "{written}" is not known' if unknown else f'"{written}" is not a unit of this quantity'
        raise ValueError(f"{problem}; {_expected(name)}")
    return factor


def scaled(numbers: NDArray[Any], factor: Decimal) -> NDArray[np.float64]:
    """
    Multiply numbers, as the shortest decimals that they are, by a factor; each product is rounded once.

    So that 25 um is 2.5e-05 m, which the product of 25.0 and 1e-06 is not.
    """
    given = np.asarray(numbers, dtype=np.float64)
    values = given.ravel()
    results, left = np.empty_like(values), np.isfinite(values)
    _, digits, power = factor.normalize().as_tuple()
    if digits != (1,) or not isinstance(power, int):
        results = np.array([float(Decimal(repr(value)) * factor) for value in values.tolist()])
        return results.reshape(given.shape) + 0.0  # no negative zeros
    for places in range(min(_DIGITS, 22 + power) + 1):  # of decimals, as long as each step is exact
        whole = np.rint(np.where(left, values, 0.0) * _EXACT[places])
        found = left & (whole / _EXACT[places] == values) & (np.abs(whole) < 10.0**_DIGITS)
        up = power - places
        if up <= 22:
            results[found] = whole[found] * _EXACT[up] if up >= 0 else whole[found] / _EXACT[-up]
            left &= ~found
        if not left.any():
            break
    rest = left | ~np.isfinite(values)
    results[rest] = [_shifted(value, power) for value in values[rest].tolist()]
    return results.reshape(given.shape) + 0.0


def _shifted(value: float, power: int) -> float:
    """Multiply a number by a power of ten, in its text."""
    digits, _, own = repr(value).partition("e")
    return float(f"{digits}e{int(own or 0) + power}") if math.isfinite(value) else value


def ratio_sentence(text: str, name: str) -> str:
    """Say that a quantity stands where a ratio is expected; nothing if the text is no quantity."""
    parts = _QUANTITY.fullmatch(text.strip()) if len(text) <= LONGEST else None
    if not parts or not parts[2]:
        return ""
    return f'"{parts[2]}" is not a unit of this quantity; {_expected(name)}'


def _expected(name: str) -> str:
    """Say what is expected of a key, and under which other one a quantity would stand."""
    key = QUANTITIES[name]
    sentence = f"{WORDS[key.unit]} is expected; write for example {key.example}"
    others = [one for one in PHYSICAL.values() if key.unit == "1" and one.gives == name]
    return f"{sentence}, or give {others[0].name} in {others[0].unit}" if len(others) == 1 else sentence


@cache
def _registry() -> "UnitRegistry[Any]":
    """Read the units that pint knows; 0.3 s."""
    from pint import UnitRegistry  # noqa: PLC0415 (300 ms that a study without units does not need)

    return UnitRegistry(non_int_type=Decimal)


@cache
def factor_between(written: str, unit: str) -> Decimal | None:
    """
    Report how many of one unit another is: None if it is not known, 0 if it is one of something else.

    >>> [str(factor_between(*units)) for units in (("um", "m"), ("mJ m-2", "kg/s^2"), ("%", "1"), ("N", "m"))]
    ['0.000001', '0.001', '0.01', '0']
    """
    registry = _registry()
    for text in (written, _POWER.sub(r"\1^\2", written)):
        try:
            wanted = registry.parse_units(_POWER.sub(r"\1^\2", unit))
            meant = registry.parse_units("" if text == "-" else text)
            if meant.dimensionality != wanted.dimensionality:
                return Decimal(0)
            if registry.Quantity(Decimal(0), meant).to(wanted).magnitude:  # decibels, which are no multiples
                return None
            return Decimal(registry.Quantity(Decimal(1), meant).to(wanted).magnitude)
        except _NO_UNIT:
            continue
    return None
