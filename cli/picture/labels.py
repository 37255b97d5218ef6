"""Numbers, parameters and variables as a picture writes them, with the prefix of a unit that suits the values."""

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.keys import INPUTS
from gradhesion.cli.names import IDLE, SYMBOLS, unit_of

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

    def number(self, value: float) -> str:
        """Write a value in this unit."""
        return number(value / 10.0**self.power)


def unit_for(name: str, values: Any) -> Unit:
    """
    Choose a unit for values in SI, so that the greatest of them is 1 to 1000.

    >>> unit_for("R", [5e-7, 5e-6]), unit_for("A", [0.1])
    (Unit(symbol='µm', power=-6), Unit(symbol='', power=0))
    """
    symbol = UNIT_SYMBOLS.get(unit_of(name), "")
    sizes: NDArray[np.float64] = np.abs(np.asarray(values, dtype=float)) if symbol else np.empty(0)
    greatest = max(sizes[np.isfinite(sizes)], default=0.0)
    if not greatest:
        return Unit(symbol=symbol)
    power = 3 * math.floor((math.log10(greatest) + SHORT) / 3)
    power = min(max(power, min(PREFIXES)), max(PREFIXES))
    return Unit(symbol=PREFIXES[power] + symbol, power=power)


SHORT: Final = 1e-9
"""A value this short of a power of ten, in decades, counts as the power: 10^-6 m is 1 µm."""


def number(value: float) -> str:
    r"""
    Write a number for a picture.

    >>> number(0.25), number(1e-6), number(float("inf")), number(float("nan"))
    ('0.25', '$10^{-6}$', '$\\infty$', 'nan')
    """
    if np.isinf(value):
        return r"$\infty$"
    if np.isnan(value):
        return "nan"
    text = f"{value:.4g}"
    if value and not 1e-3 <= abs(value) < 1e5:
        digits, exponent = f"{value:.3e}".split("e")
        digits = digits.rstrip("0").rstrip(".")
        text = f"$10^{{{int(exponent)}}}$" if digits == "1" else rf"${digits}\times10^{{{int(exponent)}}}$"
    return text.replace("-", "\N{MINUS SIGN}") if "$" not in text else text


def equation(name: str, value: float | str) -> str:
    r"""
    Say in a picture which value a parameter has.

    >>> equation("A", 0.02), equation("c0", 1e-8), equation("solver", "exact")
    ('$A$ = 0.02', '$c_0$ = 10 nm', 'exact')
    """
    if isinstance(value, str):
        return value
    unit = unit_for(name, value)
    return f"{SYMBOLS[name]} = {unit.number(value)}" + (f" {unit.symbol}" if unit.symbol and np.isfinite(value) else "")


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
