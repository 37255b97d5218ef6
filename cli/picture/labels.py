"""Numbers, parameters and variables as a picture writes them, with the prefix of a unit that suits the values."""

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names.scenes import IDLE
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.names.units import unit_of
from gradhesion.core.problem.inputs import INPUTS

UNIT_SYMBOLS: Final = {"m": "m", "Pa": "Pa", "J/m^2": "J/m$^2$", "N": "N", "J": "J", "N/m": "N/m"}
"""Units as a picture writes them."""

PREFIXES: Final = {-18: "a", -15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
"""The prefixes of units by their power of ten."""


@dataclass(frozen=True, kw_only=True)
class Unit:
    """How the values of a variable are written."""

    symbol: str = ""
    """Its unit with its prefix; "" if it has none."""
    power: int = 0
    """The power of ten that the prefix stands for."""

    def number(self, value: float, digits: int = 4) -> str:
        """Write a value in this unit."""
        return number(value / 10.0**self.power, digits)

    def numbers(self, values: Any) -> list[str]:
        """
        Write values in this unit, with so many digits that what differs reads differently.

        >>> Unit().numbers([1.0, 1.00001]), Unit(symbol="nm", power=-9).numbers([2e-6, 2.00025e-6])
        (['1', '1.00001'], ['2000', '2000.25'])
        """
        listed = np.asarray(values, dtype=float)
        different = np.unique(listed[np.isfinite(listed)])
        apart = SHARE * float(np.min(np.diff(different), initial=np.inf))
        digits = next(
            (few for few in range(4, MOST) if all(abs(float(f"{one:.{few}g}") - one) <= apart for one in different)),
            MOST,
        )
        return [self.number(value, digits) for value in listed]


def unit_for(name: str, values: Any, *, log: bool = False) -> Unit:
    """
    Choose a unit for values in SI, so that the greatest of them is 1 to 1000; on a logarithmic axis as many as can be.

    >>> unit_for("R", [5e-9, 5e-6]), unit_for("R", [5e-9, 5e-6], log=True), unit_for("A", [0.1])
    (Unit(symbol='µm', power=-6), Unit(symbol='nm', power=-9), Unit(symbol='', power=0))
    """
    symbol = UNIT_SYMBOLS.get(unit_of(name), "")
    sizes: NDArray[np.float64] = np.abs(np.asarray(values, dtype=float)) if symbol else np.empty(0)
    greatest = max(sizes[np.isfinite(sizes)], default=0.0)
    if not greatest:
        return Unit(symbol=symbol)
    power = 3 * math.floor((math.log10(greatest) + SHORT) / 3)
    if log:
        least, most = (math.log10(one) for one in (min(sizes[np.isfinite(sizes) & (sizes > 0.0)]), greatest))
        power = min(range(power, power - 9, -3), key=lambda one: max(0.0, one - least) + max(0.0, most - one - 3))
    power = min(max(power, min(PREFIXES)), max(PREFIXES))
    return Unit(symbol=PREFIXES[power] + symbol, power=power)


SHORT: Final = 1e-9
"""A value this short of a power of ten, in decades, counts as the power: 10^-6 m is 1 µm."""


SHARE: Final = 0.005
"""How far a number may be from its value, over the least distance of two values."""

MOST: Final = 15
"""Digits of a number: all that a double has."""


def number(value: float, digits: int = 4) -> str:
    r"""
    Write a number for a picture, to some digits; whole numbers below 100,000 to all.

    >>> number(0.25), number(1e-6), number(12346), number(float("inf")), number(float("nan"))
    ('0.25', '$10^{-6}$', '12346', '$\\infty$', 'nan')
    """
    if np.isinf(value):
        return r"$\infty$"
    if np.isnan(value):
        return "nan"
    text = f"{value:.{max(digits, 5) if abs(value) >= 1e4 else digits}g}"
    if value and not 1e-3 <= abs(value) < 1e5:
        front, exponent = f"{value:.{digits - 1}e}".split("e")
        front = front.rstrip("0").rstrip(".") if "." in front else front
        text = f"$10^{{{int(exponent)}}}$" if front == "1" else rf"${front}\times10^{{{int(exponent)}}}$"
    return text.replace("-", "\N{MINUS SIGN}") if "$" not in text else text


def equation(name: str, value: float | str, digits: int = 4) -> str:
    r"""
    Say in a picture which value a parameter has, to some digits.

    >>> equation("A", 0.02), equation("c0", 1e-8), equation("solver", "exact")
    ('$A$ = 0.02', '$c_0$ = 10 nm', 'exact')
    """
    if isinstance(value, str):
        return value
    unit = unit_for(name, value)
    written = f"{SYMBOLS[name]} = {unit.number(value, digits)}"
    return written + (f" {unit.symbol}" if unit.symbol and np.isfinite(value) else "")


def equations(name: str, values: Any) -> list[str]:
    r"""
    Say of each of some values that a parameter has it, with so many digits that all differ.

    >>> equations("A", [0.02, 0.020001])
    ['$A$ = 0.02', '$A$ = 0.020001']
    """
    listed = np.asarray(values).tolist()
    found: list[str] = []
    for digits in range(4, MOST + 3):
        found = [equation(name, value, digits) for value in listed]
        if len({*found}) == len({*listed}):
            break
    return found


def label(name: str, unit: Unit | None = None) -> str:
    """
    Name a variable at an axis of a picture.

    >>> label("A"), label("R"), label("R", Unit(symbol="nm", power=-9))
    ('$A$', '$R$ (m)', '$R$ (nm)')
    """
    symbol = unit.symbol if unit else UNIT_SYMBOLS.get(unit_of(name), "")
    return SYMBOLS[name] + (f" ({symbol})" if symbol else "")


def effective(dataset: Any) -> list[str]:
    """List the parameters that give the scenes of a dataset, without those that have no effect, as c0 where k = 0."""
    return [name for name in given(dataset.coords) if IDLE not in str(dataset[name].attrs.get("comment", ""))]


def given(names: Any) -> list[str]:
    """
    List the keys among some names that give parameters; not the parameters that follow from others.

    >>> given(["k", "modulus", "lambda_over_R", "lambda_over_L", "pull_off_force"])
    ['k', 'modulus', 'lambda_over_L']
    """
    known = [key for name, key in INPUTS.items() if name in names]
    follow = {key.gives for key in known if not key.is_parameter}
    return [key.name for key in known if key.name not in follow]
