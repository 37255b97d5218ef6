"""Axes as a picture shows them: numbers, units with prefixes, names, spacing, a place for infinity, ticks."""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import EngFormatter, Formatter, Locator, LogLocator, MaxNLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reductions import FLAT
from gradhesion.cli.dataset.read.selection import is_log
from gradhesion.cli.names.outputs import unit_of
from gradhesion.cli.names.scenes import IDLE, REALISATION, SOLVER
from gradhesion.cli.names.symbols import CURVE_SYMBOLS, SYMBOLS
from gradhesion.cli.picture.looks import limits_of
from gradhesion.core.problem.inputs import INPUTS

Side = Literal["x", "y"]
Ends = tuple[float, float]
Values = NDArray[np.float64]


class Unit(Formatter):
    """How values are written: in a unit with a prefix, which stands for a power of ten. What is drawn stays in SI.

    One place of an axis may stand for `infinity`.
    """

    def __init__(self, symbol: str = "", power: int = 0, infinity: float = math.nan) -> None:
        self.symbol, self.power, self.infinity = symbol, power, infinity

    def __call__(self, value: float, _: object = None) -> str:
        """Write a value in this unit."""
        return self.format_ticks([value])[0]

    def format_ticks(self, values: Any) -> list[str]:
        """Write values in this unit, with so many digits that what differs reads differently.

        >>> Unit().format_ticks([1.0, 1.00001]), Unit("nm", -9).format_ticks([2e-6, 2.00025e-6])
        (['1', '1.00001'], ['2000', '2000.25'])
        """
        listed = np.where(np.equal(values, self.infinity), np.inf, np.asarray(values, dtype=float))
        different = np.unique(listed[np.isfinite(listed)])
        near = 0.005 * float(np.min(np.diff(different), initial=np.inf))
        digits = 4
        while digits < 15 and any(abs(float(f"{value:.{digits}g}") - value) > near for value in different):
            digits += 1
        return [number(value / 10.0**self.power, digits) for value in listed]


def unit_for(name: str, values: Any, *, log: bool = False) -> Unit:
    """Choose a unit for values in SI: the greatest of them is 1 to 1000, or that in their middle on a logarithmic axis.

    >>> [unit_for("R", [5e-9, 5e-6], log=log).symbol for log in (False, True)], unit_for("A", [0.1]).symbol
    (['µm', 'nm'], '')
    """
    symbol = "" if unit_of(name) == "1" else re.sub(r"\^(\d)", r"$^\1$", unit_of(name))
    sizes = np.abs(np.asarray(values, dtype=float))
    sizes = sizes[np.isfinite(sizes) & (sizes > 0.0)]
    if not symbol or not sizes.size:
        return Unit(symbol)
    least, most = np.log10([sizes.min(), sizes.max()])
    size = 0.5 * (least + most) if log else most
    power = 3 * math.floor((size + 1e-9) / 3)  # a value this short of a power counts as it: 10^-6 m is 1 µm
    power = int(np.clip(power, min(EngFormatter.ENG_PREFIXES), max(EngFormatter.ENG_PREFIXES)))
    return Unit(EngFormatter.ENG_PREFIXES[power] + symbol, power)


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
    written = zip(unit.format_ticks(listed), listed, strict=True)
    return [f"{SYMBOLS[name]} = {one}{symbol if np.isfinite(value) else ''}" for one, value in written]


def label(name: str, unit: Unit) -> str:
    """Name a variable at an axis of a picture.

    >>> label("A", Unit()), label("path_contact_radius_si", Unit("nm", -9))
    ('$A$', 'contact radius $a$ (nm)')
    """
    return (SYMBOLS.get(name) or CURVE_SYMBOLS[name]) + (f" ({unit.symbol})" if unit.symbol else "")


def called(words: str, unit: Unit) -> tuple[str, Unit]:
    """Name an axis in words of one's own: in the unit that they end with, or with its own, which is added.

    >>> called("force (N)", Unit("mN", -3))[1].power, called("force", Unit("mN", -3))[0], called("waves", Unit())[0]
    (0, 'force (mN)', 'waves')
    """
    if not (unit.symbol and words):
        return words, unit
    base = unit.symbol.removeprefix(EngFormatter.ENG_PREFIXES[unit.power])
    known = {prefix + base: power for power, prefix in EngFormatter.ENG_PREFIXES.items()}
    known |= {f"u{base}": -6}
    _, _, last = words.rstrip(" )").rpartition("(")
    symbol = re.sub(r"\^(\d)", r"$^\1$", last)
    if symbol not in known:
        return f"{words} ({unit.symbol})", unit
    return words, Unit(symbol, known[symbol], unit.infinity)


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


def fixed(part: Any, whole: Any, drawn: Sequence[str] = ()) -> Iterator[str]:
    """Write the parameters with one value in a part of a dataset that are not drawn, and the names of the others."""
    others = []
    for name in (SOLVER, REALISATION, *effective(part)):
        if name in part.coords and name not in drawn:
            values, known = np.unique(part[name].values), np.unique(whole[name].values)
            if values.size == 1:
                place = "first" if values[0] == whole[name].values.flat[0] else "one"
                yield equations(name, values)[0] + (f" ({place} of {known.size})" if known.size > 1 else "")
            else:
                others.append(SYMBOLS[name])
    if others:
        yield "varying too: " + ", ".join(others)


def locator(low: float, high: float, *, log: bool) -> Locator:
    """Choose what finds ticks at round numbers between two ends: of a logarithmic axis some in each decade."""
    if log and high > 6.0 * low:
        steps = (1.0, 2.0, 5.0) if high < 50.0 * low else (1.0, 3.0) if high < 1000.0 * low else (1.0,)
        return LogLocator(subs=steps, numticks=20)
    return MaxNLocator("auto", steps=[1, 2, 2.5, 5, 10])


def padded(least: float, greatest: float) -> Ends:
    """Move the ends of values apart that are equal but for rounding."""
    if greatest - least > FLAT * max(abs(least), abs(greatest)):
        return least, greatest
    pad = 0.05 * max(abs(least), 1e-300)
    return least - pad, greatest + pad


def suit(
    axes: Axes, side: Side, name: str, span: str = "", *, ends: Ends | None = None, log: bool = False, after: str = ""
) -> Unit:
    """Name an axis after a variable, give it its scale and limits, and let unit and ticks suit what is seen.

    The variable has values between two `ends`, or is all that the axis shows; a `span` is a part of it that is chosen.
    """
    axes.set(**{f"{side}scale": "log" if log else "linear"})
    low, high = ends or sorted(getattr(axes, f"get_{side}lim")())
    limits = limits_of(span, name, *padded(low, high), log=log)
    seen = max(low, limits[0]), min(high, limits[1])
    if not span and padded(*seen) != seen:
        limits = padded(*seen)
    unit = unit_for(name, seen, log=log)
    axis = axes.xaxis if side == "x" else axes.yaxis
    axis.set_label_text(label(name, unit) + after)
    axis.set_major_locator(locator(*seen, log=log))
    axis.set_major_formatter(unit)
    axis.set_minor_locator(NullLocator())
    if np.isfinite(limits).any():
        axes.set(**{f"{side}lim": [end if np.isfinite(end) else None for end in limits]})
    return unit


@dataclass(frozen=True, eq=False)
class Scale:
    """Where the values of an axis go in a picture."""

    name: str
    positions: Values
    """The place of each; inf stands one step beyond the greatest finite value."""
    log: bool
    infinite: int
    """How many of the last places are those of inf."""

    @property
    def finite(self) -> Values:
        """The places of finite values."""
        return self.positions[: self.positions.size - self.infinite]

    def edges(self) -> Values:
        """Give the edges of cells around the places, halfway between them."""
        places = np.log(self.positions) if self.log else self.positions
        middles = 0.5 * (places[1:] + places[:-1])
        edges = np.concatenate([2.0 * places[:1] - middles[:1], middles, 2.0 * places[-1:] - middles[-1:]])
        return np.exp(edges) if self.log else edges

    def dress(self, axes: Axes, side: Side, span: str) -> None:
        """Give an axis of a picture this scale, with ticks at plain numbers and a place for infinity."""
        first, last = float(self.finite[0]), float(self.finite[-1])
        unit = suit(axes, side, self.name, span, ends=(first, last) if first < last else None, log=self.log)
        if self.infinite:
            axis = axes.xaxis if side == "x" else axes.yaxis
            places = locator(first, last, log=self.log).tick_values(first, last)
            kept = [float(place) for place in places if first <= place <= last]
            unit.infinity = float(self.positions[-1])
            axis.set_ticks([*kept, unit.infinity])


def scale(values: Values, name: str = "") -> Scale:
    """Choose the scale of an axis of a name: logarithmic where its values are nearer to that than to an even spacing.

    Its values rise.

    >>> scale(np.array([1.0, 10.0, 100.0, np.inf])).positions
    array([   1.,   10.,  100., 1000.])
    """
    finite = np.unique(values[np.isfinite(values)])
    log, infinite, steps = is_log(finite), np.isinf(values), max(1, finite.size - 1)
    first, last = finite[[0, -1]]
    beyond = last * (last / first) ** (1 / steps) if log else last + ((last - first) / steps or last)
    return Scale(name, np.where(infinite, beyond, values), log, int(infinite.sum()))
