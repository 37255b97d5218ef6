"""Axes as a picture shows them: numbers, units with prefixes, names, spacing, a place for infinity, ticks."""

import math
import re
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import EngFormatter, Formatter, FuncFormatter, Locator, LogLocator, MaxNLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import is_log
from gradhesion.cli.names.outputs import unit_of
from gradhesion.cli.names.scenes import IDLE
from gradhesion.cli.names.symbols import CURVE_SYMBOLS, SYMBOLS
from gradhesion.cli.picture.looks import limits_of
from gradhesion.core.problem.inputs import INPUTS

Side = Literal["x", "y"]
Ends = tuple[float, float]
Places = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Unit:
    """How values are written: in a unit with a prefix, which stands for a power of ten. What is drawn stays in SI."""

    symbol: str = ""
    power: int = 0

    def number(self, value: float, _: object = None) -> str:
        """Write a value in this unit; matplotlib gives the place of its tick too."""
        return number(value / 10.0**self.power)

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
        return [number(value / 10.0**self.power, digits) for value in listed]


def unit_for(name: str, values: Any, *, log: bool = False) -> Unit:
    """Choose a unit for values in SI: the greatest of them is 1 to 1000; on a logarithmic axis as many as can be.

    >>> unit_for("R", [5e-9, 5e-6]), unit_for("R", [5e-9, 5e-6], log=True), unit_for("A", [0.1])
    (Unit(symbol='µm', power=-6), Unit(symbol='nm', power=-9), Unit(symbol='', power=0))
    """
    unit = unit_of(name)
    symbol = "" if unit == "1" else re.sub(r"\^(\d)", r"$^\1$", unit)
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
    symbol = (unit or unit_for(name, [])).symbol
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


def numbers(unit: Unit) -> Formatter:
    """Write plain numbers in a unit; all ticks of an axis together, so that those which differ read differently."""
    formatter = FuncFormatter(unit.number)
    vars(formatter)["format_ticks"] = unit.numbers
    return formatter


def locator(low: float, high: float, *, log: bool) -> Locator:
    """Choose what finds ticks at round numbers between two ends: of a logarithmic axis some in each decade."""
    if log and high > 6.0 * low:
        steps = (1.0, 2.0, 5.0) if high < 50.0 * low else (1.0, 3.0) if high < 1000.0 * low else (1.0,)
        return LogLocator(subs=steps, numticks=20)
    return MaxNLocator("auto", steps=[1, 2, 2.5, 5, 10])


def dress(axes: Axes, side: Side, words: str, unit: Unit, ends: Ends, limits: Ends, *, log: bool = False) -> Axis:
    """Give an axis of a picture its name, scale, numbers in a unit at ticks between two ends, and limits if finite."""
    axes.set(**{f"{side}scale": "log" if log else "linear", f"{side}label": words})
    axis: Axis = getattr(axes, f"{side}axis")
    axis.set_major_locator(locator(*ends, log=log))
    axis.set_major_formatter(numbers(unit))
    axis.set_minor_locator(NullLocator())
    if np.isfinite(limits).any():
        axes.set(**{f"{side}lim": tuple(end if np.isfinite(end) else None for end in limits)})
    return axis


def suit(axes: Axes, side: Side, name: str, span: str = "") -> None:
    """Name an axis of a picture after a variable, and let its unit suit the limits: those chosen, if some are."""
    low, high = sorted(getattr(axes, f"get_{side}lim")())
    limits = limits_of(span, name, low, high)
    seen = max(low, limits[0]), min(high, limits[1])
    unit = unit_for(name, seen)
    dress(axes, side, label(name, unit), unit, seen, limits)


@dataclass(frozen=True, eq=False)
class Scale:
    """Where the values of an axis go in a picture, and between which of them it is drawn, if these are finite."""

    name: str
    positions: Places
    """The place of each; inf stands one step beyond the greatest finite value."""
    log: bool
    infinite: bool
    """Whether the last place is that of inf."""
    limits: Ends

    def edges(self) -> Places:
        """Give the edges of cells around the places, halfway between them."""
        places = np.log(self.positions) if self.log else self.positions
        middles = 0.5 * (places[1:] + places[:-1])
        edges = np.concatenate([2.0 * places[:1] - middles[:1], middles, 2.0 * places[-1:] - middles[-1:]])
        return np.exp(edges) if self.log else edges

    def dress(self, axes: Axes, side: Side) -> None:
        """Give an axis of a picture this scale and its limits, with ticks at plain numbers."""
        finite = self.positions[:-1] if self.infinite else self.positions
        first, last = np.clip((finite[0], finite[-1]), *self.limits).tolist()
        unit = unit_for(self.name, np.clip(finite, *self.limits), log=self.log)
        axis = dress(axes, side, label(self.name, unit), unit, (first, last), self.limits, log=self.log)
        if self.infinite and np.isinf(self.limits[1]):
            places = locator(first, last, log=self.log).tick_values(first, last)
            kept = [float(place) for place in places if first <= place <= last]
            axis.set_ticks([*kept, float(self.positions[-1])], [*unit.numbers(kept), r"$\infty$"])


def scale(values: Places, name: str = "", span: str = "") -> Scale:
    """Choose the scale of an axis of a name: logarithmic where its values are nearer to that than to an even spacing.

    Its values rise. Of a part of it, ticks and the unit suit what is seen.

    >>> scale(np.array([1.0, 10.0, 100.0, np.inf])).positions
    array([   1.,   10.,  100., 1000.])
    """
    finite = np.unique(values[np.isfinite(values)])
    log, infinite, steps = is_log(finite), np.isinf(values), max(1, finite.size - 1)
    first, last = finite[[0, -1]]
    beyond = last * (last / first) ** (1 / steps) if log else last + ((last - first) / steps or last)
    return Scale(name, np.where(infinite, beyond, values), log, bool(infinite.any()), limits_of(span, name, log=log))
