"""Numbers with units: `"50 kPa"` as the number of pascals that it is.

Units are those of pint. Numbers are converted in decimal arithmetic and rounded once, so that "1 um" is the double next
to 10^-6, as if it had been written in metres.
"""

import re
from decimal import Decimal
from functools import cache
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.core.problem.inputs import ANY, INPUTS, PHYSICAL, Input

if TYPE_CHECKING:
    from pint import UnitRegistry

_UP_TO: Final = "distance from the centre up to which heights are fitted [a_max]"
QUANTITIES: Final = INPUTS | {
    "up_to": Input("up_to", _UP_TO, "", '"2 um"', unit="m", table="profile"),
    "indentation": Input("indentation", "a depth", "", '"1 um"', ANY, unit="m", table="data"),
    "load": Input("load", "a load", "", '"1 nN"', ANY, unit="N", table="data"),
}
"""Every quantity that a study may have: its inputs, and those of files."""
LONGEST: Final = 60
"""Characters of a quantity: above any that is meant as one."""
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
_QUANTITY: Final = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?|[+-]?inf|nan)\s*\*?\s*(.*)")
_COMMA: Final = re.compile(r"\s*[+-]?\d+,\d")
_NO_COMMA: Final = "a comma in a number; write a point before the decimals, and nothing between thousands, as 1234.5"
_POWER: Final = re.compile(r"([^\W\d_])([+-]?\d)")
"""A power as UDUNITS and astropy write it, `m-2`."""


def si_value(value: object, name: str) -> float:
    """Give a quantity in its unit in SI; an infinite one needs no unit. ValueError says what to write instead.

    >>> si_value("1 um", "R"), si_value("20 mJ/m^2", "work_of_adhesion"), si_value("20 mN m-1", "work_of_adhesion")
    (1e-06, 0.02, 0.02)
    """
    key = QUANTITIES[name]
    number, written = _parts_of(str(value) if isinstance(value, str | float) else "")
    plain = isinstance(value, int | float) and not isinstance(value, bool)
    if "inf" not in number and (plain or not written):
        what = WORDS["1"] if plain or number else "not a number with its unit, in quotes"
        raise ValueError(f"{what}; {_expected(name)}")
    if _COMMA.match(str(value)):
        raise ValueError(f"{_NO_COMMA}; {_expected(name)}")
    result = float(Decimal(number) * (factor_of(written, name) if written else 1)) + 0.0
    if not key.admits(result):
        unpressed = '; for a turn at zero depth write indentation_max = "0 nm"' if name == "preload" else ""
        raise ValueError(f"out of range; choose {WORDS[key.unit]} with {key.allowed}{unpressed}")
    return result


def _parts_of(text: str) -> tuple[str, str]:
    """Take a number and its unit apart; nothing of what begins with no number."""
    parts = _QUANTITY.fullmatch(text.strip()) if len(text) <= LONGEST else None
    return (parts[1], parts[2]) if parts else ("", "")


def ratio_sentence(text: str, name: str) -> str:
    """Say that a quantity, or a number with a comma, stands where a ratio is expected; nothing if it is neither."""
    if _COMMA.match(text):
        return f"{_NO_COMMA}, without quotes"
    written = _parts_of(text)[1]
    return f'"{written}" is not a unit of this quantity; {_expected(name)}' if written else ""


def _expected(name: str) -> str:
    """Say what is expected of a key, and under which other one a quantity would stand."""
    key = QUANTITIES[name]
    others = [one for one in PHYSICAL.values() if key.unit == "1" and one.gives == name]
    instead = f", or give {others[0].name} in {others[0].unit}" if len(others) == 1 else ""
    return f"{WORDS[key.unit]} is expected; write for example {key.example}{instead}"


def factor_of(written: str, name: str) -> Decimal:
    """Report how many of the unit of a key another unit is; ValueError where it is unknown or of another dimension."""
    unit = QUANTITIES[name].unit
    factor = Decimal(1) if written == unit else factor_between(written, unit)  # without asking pint
    if not factor:
        problem = "is not a known unit" if factor is None else "is not a unit of this quantity"
        raise ValueError(f'"{written}" {problem}; {_expected(name)}')
    return factor


def factor_of_column(found: Columns, name: str, key: str, written: str = "") -> Decimal:
    """Report how many of the unit of a key the unit of a column is: the one written in a study, or in the file.

    ColumnsError where there is none, it has another dimension, or the two differ.
    """
    of_file, own = found.units.get(name, ""), QUANTITIES[key].unit
    unit = written or of_file or (own if own == "1" else "")
    if not unit:
        remedy = f"write it after the name in the header in brackets, as {name} [{own}]"
        raise ColumnsError(f'the column "{name}" has no unit; {remedy}')
    try:
        factor = factor_of(unit, key)
    except ValueError as error:
        raise ColumnsError(f'the column "{name}": {str(error).partition("; write")[0]}') from None
    if of_file and of_file != unit and factor_between(of_file, own) != factor:
        words = f'the unit of the column "{name}" is "{unit}" in the study and "{of_file}" in the header of the file'
        raise ColumnsError(f"{words}; correct one of the two, or leave it out of the study")
    return factor


def scaled(numbers: NDArray[Any], factor: Decimal) -> NDArray[np.float64]:
    """Multiply numbers, as the shortest decimals that they are, by a factor; each product is rounded once.

    So that 25 um is 2.5e-05 m, which the product of 25.0 and 1e-06 is not.

    >>> scaled(np.array([1.0, 25.0]), Decimal("1e-6"))
    array([1.0e-06, 2.5e-05])
    """
    given = np.asarray(numbers, dtype=np.float64)
    if factor == 1:
        return given + 0.0
    products = [float(Decimal(repr(value)) * factor) for value in given.ravel().tolist()]
    return np.reshape(products, given.shape) + 0.0  # no negative zeros


@cache
def _registry() -> "UnitRegistry[Any]":
    """Read the units that pint knows; 0.3 s."""
    from pint import UnitRegistry  # noqa: PLC0415 (300 ms that a study without units does not need)

    return UnitRegistry(non_int_type=Decimal)


@cache
def factor_between(written: str, unit: str) -> Decimal | None:
    """Report how many of one unit another is: None if it is not known, 0 if it is one of something else.

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
        except Exception:  # noqa: BLE001, S112 (whatever pint raises where it is given no unit)
            continue
    return None
