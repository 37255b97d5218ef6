"""Numbers, parameters and variables as a picture writes them, with the prefix of a unit that suits the values."""

import math
import re
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from matplotlib.ticker import EngFormatter

from gradhesion.cli.names.scenes import IDLE
from gradhesion.cli.names.symbols import CURVE_SYMBOLS, SYMBOLS
from gradhesion.cli.names.units import unit_of
from gradhesion.core.problem.inputs import INPUTS


@dataclass(frozen=True, kw_only=True)
class Unit:
    """How the values of a variable are written; what is drawn stays in SI."""

    symbol: str = ""
    """Its unit with its prefix; "" if it has none."""
    power: int = 0
    """The power of ten that the prefix stands for."""

    def number(self, value: float, digits: int = 4) -> str:
        """Write a value in this unit."""
        return number(value / 10.0**self.power, digits)

    def numbers(self, values: Any) -> list[str]:
        """Write values in this unit, with so many digits that what differs reads differently.

        >>> Unit().numbers([1.0, 1.00001]), Unit(symbol="nm", power=-9).numbers([2e-6, 2.00025e-6])
        (['1', '1.00001'], ['2000', '2000.25'])
        """
        listed = np.asarray(values, dtype=float)
        different = np.unique(listed[np.isfinite(listed)])
        near = 0.005 * float(np.min(np.diff(different), initial=np.inf))
        digits = 4
        while digits < 15 and any(abs(float(f"{value:.{digits}g}") - value) > near for value in different):
            digits += 1
        return [self.number(value, digits) for value in listed]


PLAIN: Final = Unit()
"""That of a number."""


def unit_for(name: str, values: Any, *, log: bool = False) -> Unit:
    """Choose a unit for values in SI: the greatest of them is 1 to 1000; on a logarithmic axis as many as can be.

    >>> unit_for("R", [5e-9, 5e-6]), unit_for("R", [5e-9, 5e-6], log=True), unit_for("A", [0.1])
    (Unit(symbol='µm', power=-6), Unit(symbol='nm', power=-9), Unit(symbol='', power=0))
    """
    symbol = _symbol(unit_of(name))
    sizes = np.abs(np.asarray(values, dtype=float))
    sizes = sizes[np.isfinite(sizes) & (sizes > 0.0)]
    if not symbol or not sizes.size:
        return Unit(symbol=symbol)
    least, most = np.log10([sizes.min(), sizes.max()])
    power = 3 * math.floor((most + 1e-9) / 3)  # a value this short of a power counts as it: 10^-6 m is 1 µm
    if log:
        power = min(range(power, power - 9, -3), key=lambda one: max(0.0, one - least) + max(0.0, most - one - 3))
    prefixes = EngFormatter.ENG_PREFIXES
    power = min(max(power, min(prefixes)), max(prefixes))
    return Unit(symbol=prefixes[power] + symbol, power=power)


def _symbol(unit: str) -> str:
    """Write a unit of UDUNITS with its powers raised."""
    return "" if unit == "1" else re.sub(r"\^(\d)", r"$^\1$", unit)


def number(value: float, digits: int = 4) -> str:
    r"""Write a number for a picture, to some digits; whole numbers below 100,000 to all.

    >>> number(0.25), number(1e-6), number(12346), number(float("inf")), number(float("nan"))
    ('0.25', '$10^{-6}$', '12346', '$\\infty$', 'nan')
    """
    if np.isinf(value):
        return r"$\infty$"
    if value and not np.isnan(value) and not 1e-4 <= abs(value) < 1e5:
        front, exponent = f"{value:.{digits - 1}e}".split("e")
        front = front.rstrip("0").rstrip(".") if "." in front else front
        return f"$10^{{{int(exponent)}}}$" if front == "1" else rf"${front}\times10^{{{int(exponent)}}}$"
    return f"{value:.{max(digits, 5) if abs(value) >= 1e4 else digits}g}".replace("-", "\N{MINUS SIGN}")


def equations(name: str, values: Any) -> list[str]:
    r"""Say of each of some values that a parameter has it, with so many digits that all differ.

    >>> equations("A", [0.02, 0.020001]), equations("c0", [1e-8]), equations("solver", ["exact"])
    (['$A$ = 0.02', '$A$ = 0.020001'], ['$c_0$ = 10 nm'], ['exact'])
    """
    listed = np.atleast_1d(values)
    if listed.dtype.kind not in "fiub":
        return [str(value) for value in listed]
    unit = unit_for(name, listed, log=True)
    symbol = f" {unit.symbol}" if unit.symbol else ""
    written = zip(unit.numbers(listed), listed, strict=True)
    return [f"{SYMBOLS[name]} = {one}{symbol if np.isfinite(value) else ''}" for one, value in written]


def label(name: str, unit: Unit | None = None) -> str:
    """Name a variable at an axis of a picture.

    >>> label("A"), label("R"), label("path_contact_radius_si", Unit(symbol="nm", power=-9))
    ('$A$', '$R$ (m)', 'contact radius $a$ (nm)')
    """
    symbol = unit.symbol if unit else _symbol(unit_of(name))
    return (SYMBOLS.get(name) or CURVE_SYMBOLS[name]) + (f" ({symbol})" if symbol else "")


def given(names: Any) -> list[str]:
    """List the keys among some names that give parameters; not the parameters that follow from others.

    >>> given(["k", "modulus", "lambda_over_R", "lambda_over_L", "pull_off_force"])
    ['k', 'modulus', 'lambda_over_L']
    """
    known = [key for name, key in INPUTS.items() if name in names]
    follow = {key.gives for key in known if not key.is_parameter}
    return [key.name for key in known if key.name not in follow]


def effective(dataset: Any) -> list[str]:
    """List the parameters that give the scenes of a dataset, without those that have no effect, as c0 where k = 0."""
    return [name for name in given(dataset.coords) if IDLE not in str(dataset[name].attrs.get("comment", ""))]


def fixed(dataset: Any) -> list[str]:
    """Write the parameters that have one value in all scenes of a dataset; of others that of the first scene."""
    written = []
    for name in effective(dataset):
        values = np.unique(dataset[name].values)
        first = equations(name, np.ravel(dataset[name].values)[:1])[0]
        written.append(first if values.size == 1 else f"{first} (first of {values.size})")
    return written
