"""Numbers with units: `"50 kPa"` as the number of pascals that it is, and values of other packages as a study has them.

Units are those of pint. Numbers are converted in decimal arithmetic and rounded once, so that "1 um" is the double next
to 10^-6, as if it had been written in metres. Quantities of pint, astropy and unyt, and arrays of xarray and pandas are
known by what they have, so that none of these packages is imported; a unit is never dropped.
"""

import math
import re
from collections.abc import Mapping
from contextlib import suppress
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
_PACKAGES: Final = (
    ("magnitude", "units", "to_base_units"),  # pint
    ("value", "unit", "si"),  # astropy
    ("value", "units", "in_mks"),  # unyt
)
"""What the quantities of each package have: their numbers, their unit, and themselves in base units."""
_PLAIN: Final = (str, bool, int, float, type(None))
_POWER: Final = re.compile(r"([^\W\d_])([+-]?\d)")
"""A power as UDUNITS and astropy write it, `m-2`."""


def si_value(value: object, name: str) -> float:
    """Give a quantity in its unit in SI; an infinite one needs no unit. ValueError says what to write instead."""
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


def apart(value: Any) -> tuple[Any, str]:
    """Take what has a unit apart: its numbers, and the unit as pint reads it; of all else there is none."""
    if isinstance(value, _PLAIN):
        return value, ""
    attributes = getattr(value, "attrs", None)
    written = attributes.get("units", "") if isinstance(attributes, Mapping) else getattr(value, "units", "")
    if hasattr(value, "dims") and hasattr(value, "coords"):  # xarray
        numbers, unit = apart(value.data)
        return numbers, unit or str(written)
    column = getattr(getattr(value, "array", None), "quantity", None)  # pandas with pint
    value = value if column is None else column
    for names in _PACKAGES:
        if all(hasattr(value, name) for name in names):
            return _in_a_known_unit(value, *names)
    return value, written if isinstance(written, str) else ""


def _in_a_known_unit(value: Any, numbers: str, unit: str, base: str) -> tuple[Any, str]:
    """Give a quantity in its own unit, or in base units where its registry means something else by it than ours."""

    def text_of(own: Any) -> str:  # as pint reads it
        return (f"{own:C}" if hasattr(own, "dimensionality") else str(own)) or "dimensionless"

    array, own = np.asanyarray(getattr(value, numbers)), getattr(value, unit)
    if array.dtype == object:  # of decimals or fractions
        with suppress(TypeError, ValueError):
            array = array.astype(np.float64)
    text = text_of(own)
    try:
        ends = [getattr(size * own, base) for size in (0, 1)]
        nothing, one = (end() if callable(end) else end for end in ends)
        scale, base_text = float(getattr(one, numbers)), text_of(getattr(one, unit))
        is_scale = float(getattr(nothing, numbers)) == 0.0 and factor_between(base_text, base_text) is not None
    except (ArithmeticError, LookupError, TypeError, ValueError):
        return array, text
    known = factor_between(text, base_text) if len(text) <= LONGEST - 26 else None  # beside the longest number
    same = known and math.isclose(float(known), scale)  # as constants are measured anew
    if same or not is_scale or array.dtype.kind not in "iuf":
        return array, text
    return scaled(array, Decimal(f"{scale:.15g}")), base_text


def as_written(value: Any, path: tuple[str, ...] = (), *, bare: bool = True) -> Any:
    """Turn a value made in Python, at a path in a study, into what TOML would give: quantities are texts, as "25 um".

    Quantities without a dimension become numbers if `bare`.
    """
    if type(value) in _PLAIN:
        return value
    if isinstance(value, Mapping):
        return {str(key): as_written(item, (*path, str(key)), bare=bare) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [as_written(item, path, bare=bare) for item in value]
    numbers, unit = apart(value)
    if not unit and not hasattr(numbers, "__array__"):
        return value
    array = filled(numbers)
    if array.dtype.kind in "mM":
        return array.astype(str if array.dtype.kind == "m" else "M8[us]").tolist()  # and no bare integers
    if array.dtype == object:
        return as_written(array.tolist(), path, bare=bare) if array.ndim else array.item()
    if unit in ("percent", "%") and path[:1] == ("uncertainty",) and len(path) == 2:
        unit = "%"
    elif bare and unit and array.dtype.kind in "iuf" and (factor := factor_between(unit, "1")):
        return scaled(array, factor).tolist()
    if not unit:
        return array.tolist()
    return np.reshape([f"{one!r} {unit}" for one in array.ravel().tolist()], array.shape).tolist()


def filled(numbers: Any) -> NDArray[Any]:
    """Give an array whose missing values are NaN, which is out of range."""
    if not np.ma.isMaskedArray(numbers):
        return np.asarray(numbers)
    return np.ma.filled(numbers if numbers.dtype == object else numbers.astype(float), np.nan)
