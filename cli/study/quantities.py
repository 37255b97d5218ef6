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

from gradhesion.cli.keys import KEYS
from gradhesion.cli.terminal.wording import example

if TYPE_CHECKING:
    from pint import UnitRegistry

LONGEST: Final = 60
"""Characters of a quantity: above any that is meant as one."""

_QUANTITY: Final = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?|[+-]?inf|nan)\s*\*?\s*(.*)")
_POWER: Final = re.compile(r"([^\W\d_])([+-]?\d)")
"""A power as UDUNITS writes it, `m-2`."""
WORDS: Final = {
    "m": "a length",
    "Pa": "a pressure",
    "J m-2": "an energy per area",
    "N m-1": "a force per length",
    "N": "a force",
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
    key = KEYS[name]
    text = str(value) if isinstance(value, str | float) else ""
    parts = _QUANTITY.fullmatch(text.strip()) if len(text) <= LONGEST else None
    number, written = parts.groups() if parts else ("", "")
    factor = _factor(written, key.unit) if written else Decimal(1)
    if isinstance(value, int | float) and not isinstance(value, bool) and "inf" not in number:
        problem = "a number without a unit"
    elif not parts:
        problem = "not a number with its unit, in quotes"
    elif not written:
        problem = "" if "inf" in number else "a number without a unit"
    elif factor is None:
        problem = f'the unit "{written}" is not known'
    else:
        problem = "" if factor else f'"{written}" is not a unit of this quantity'
    if problem or not factor:
        raise ValueError(f"{problem}; {WORDS[key.unit]} is expected; {example(('physical', name))}")
    result = float(Decimal(number) * factor) + 0.0
    inside = result > 0.0 or result == key.bounds.get("ge") or not key.bounds
    if not inside or (math.isinf(result) and not key.infinite) or math.isnan(result):
        allowed = f"{WORDS[key.unit]} with {key.allowed}" if key.bounds else f"{WORDS[key.unit]} that is finite"
        raise ValueError(f"out of range; choose {allowed}")
    return result


@cache
def _registry() -> "UnitRegistry[Any]":
    """Read the units that pint knows; 0.3 s."""
    from pint import UnitRegistry  # noqa: PLC0415 (300 ms that a study without units does not need)

    return UnitRegistry(non_int_type=Decimal)


@cache
def _factor(written: str, unit: str) -> Decimal | None:
    """Report how many of the SI unit a unit is: None if it is not known, 0 if it is one of something else."""
    registry = _registry()
    wanted = registry.parse_units(_POWER.sub(r"\1^\2", unit))
    for text in (written, _POWER.sub(r"\1^\2", written)):
        try:
            meant = registry.parse_units(text)
            if meant.dimensionality != wanted.dimensionality:
                return Decimal(0)
            return Decimal(registry.Quantity(Decimal(1), meant).to(wanted).magnitude)
        except _NO_UNIT:
            continue
    return None
