"""Axes of a dataset as axes of a picture: their order, their spacing, and a place for infinity."""

from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.names import SYMBOLS, unit_of

UNIT_SYMBOLS: Final = {"m": "m", "Pa": "Pa", "J m-2": "J/m$^2$", "N": "N", "J": "J"}
"""Units as a picture writes them."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Scale:
    """Where the values of an axis go in a picture."""

    order: NDArray[np.intp]
    """The items of the axis in rising order."""
    positions: NDArray[np.float64]
    """The place of each, in that order; inf stands one step beyond the greatest finite value."""
    log: bool
    infinite: bool
    """Whether the last place is that of inf."""

    def dress(self, axes: Axes, which: Literal["x", "y"]) -> None:
        """Give an axis of a picture this scale, with ticks at plain numbers."""
        finite = self.positions[:-1] if self.infinite else self.positions
        first, last = float(finite[0]), float(finite[-1])
        axis = axes.xaxis if which == "x" else axes.yaxis
        (axes.set_xscale if which == "x" else axes.set_yscale)("log" if self.log else "linear")
        if self.log:
            subs = (1.0, 2.0, 5.0) if last < 200 * first else (1.0,)
            places = LogLocator(subs=subs, numticks=20).tick_values(first, last)
        else:
            places = MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]).tick_values(first, last)
        slack = 1e-9 * max(abs(first), abs(last))
        kept = [float(place) for place in places if first - slack <= place <= last + slack]
        labels = [number(place) for place in kept]
        if self.infinite:
            kept.append(float(self.positions[-1]))
            labels.append(number(np.inf))
        axis.set_minor_locator(NullLocator())
        axis.set_ticks(kept, labels)


def scale(values: NDArray[np.float64]) -> Scale:
    """
    Choose the scale of an axis: logarithmic where its values are nearer to that than to an even spacing.

    >>> scale(np.array([1.0, np.inf, 10.0, 100.0])).positions
    array([   1.,   10.,  100., 1000.])
    """
    order = np.argsort(values, kind="stable")
    places = values[order]
    finite = np.unique(places[np.isfinite(places)])
    log = _is_log(finite)
    infinite = np.isinf(places)
    if infinite.any():
        steps = max(1, finite.size - 1)
        if log:
            beyond = finite[-1] * (finite[-1] / finite[0]) ** (1 / steps)
        else:
            beyond = finite[-1] + ((finite[-1] - finite[0]) / steps or finite[-1])
        places = np.where(infinite, beyond, places)
    return Scale(order=order, positions=places, log=log, infinite=bool(infinite.any()))


def _is_log(finite: NDArray[np.float64]) -> bool:
    """Tell whether the ratios of rising values are more even than their differences."""
    if finite.size < 2 or finite[0] <= 0 or finite[-1] < 5 * finite[0]:
        return False
    steps, ratios = np.diff(finite), np.diff(np.log(finite))
    return bool(finite.size == 2 or np.std(ratios) / np.mean(ratios) < np.std(steps) / np.mean(steps))


def number(value: float) -> str:
    r"""
    Write a number for a picture.

    >>> number(0.25), number(1e-6), number(float("inf"))
    ('0.25', '$10^{-6}$', '$\\infty$')
    """
    if np.isinf(value):
        return r"$\infty$"
    text = f"{value:.4g}"
    if value and not 1e-3 <= abs(value) < 1e5:
        digits, exponent = f"{value:.3e}".split("e")
        digits = digits.rstrip("0").rstrip(".")
        text = f"$10^{{{int(exponent)}}}$" if digits == "1" else rf"${digits}\times10^{{{int(exponent)}}}$"
    return text


def equation(name: str, value: float | str) -> str:
    r"""
    Say in a picture which value a parameter has.

    >>> equation("A", 0.02), equation("solver", "exact")
    ('$A$ = 0.02', 'exact')
    """
    unit = UNIT_SYMBOLS.get(unit_of(name), "")
    if isinstance(value, str):
        return value
    return f"{SYMBOLS[name]} = {number(value)}" + (f" {unit}" if unit and np.isfinite(value) else "")


def label(name: str) -> str:
    """
    Name a variable at an axis of a picture.

    >>> label("A"), label("R")
    ('$A$', '$R$ (m)')
    """
    unit = UNIT_SYMBOLS.get(unit_of(name), "")
    return SYMBOLS[name] + (f" ({unit})" if unit else "")
