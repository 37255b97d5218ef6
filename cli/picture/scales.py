"""Axes of a dataset as axes of a picture: their order, their spacing, a place for infinity, and numbers at ticks."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import Formatter, LogLocator, MaxNLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import is_log
from gradhesion.cli.picture.labels import Unit, number, unit_for
from gradhesion.cli.picture.spans import ALL, Span


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
    unit: Unit
    """How its values are written."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Between which values it is drawn; all of them where they are infinite."""

    def edges(self) -> NDArray[np.float64]:
        """Give the edges of cells around the places, halfway between them."""
        places = np.log(self.positions) if self.log else self.positions
        middles = 0.5 * (places[1:] + places[:-1])
        edges = np.concatenate([2.0 * places[:1] - middles[:1], middles, 2.0 * places[-1:] - middles[-1:]])
        return np.exp(edges) if self.log else edges

    def dress(self, axes: Axes, which: Literal["x", "y"]) -> None:
        """Give an axis of a picture this scale and its limits, with ticks at plain numbers."""
        finite = self.positions[:-1] if self.infinite else self.positions
        low, high = self.limits
        first, last = max(low, float(finite[0])), min(high, float(finite[-1]))
        axis = axes.xaxis if which == "x" else axes.yaxis
        (axes.set_xscale if which == "x" else axes.set_yscale)("log" if self.log else "linear")
        if self.log:
            subs = (1.0, 2.0, 5.0) if last < 200 * first else (1.0,)
            places = LogLocator(subs=subs, numticks=20).tick_values(first, last)
        else:
            places = MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]).tick_values(first, last)
        slack = 1e-9 * max(abs(first), abs(last))
        kept = [float(place) for place in places if first - slack <= place <= last + slack]
        labels = self.unit.numbers(kept)
        if self.infinite and np.isinf(high):
            kept.append(float(self.positions[-1]))
            labels.append(number(np.inf))
        axis.set_minor_locator(NullLocator())
        axis.set_ticks(kept, labels)
        limit(axes, which, self.limits)


def limit(axes: Axes, which: Literal["x", "y"], limits: tuple[float, float]) -> None:
    """Give an axis of a picture limits; an infinite one stays to suit the values."""
    if np.isfinite(limits).any():
        low, high = ((end if np.isfinite(end) else None) for end in limits)
        axes.set(**{f"{which}lim": (low, high)})


def scale(values: NDArray[np.float64], name: str = "", span: Span = ALL) -> Scale:
    """
    Choose the scale of an axis of a name: logarithmic where its values are nearer to that than to an even spacing.

    Of a span of it, ticks and the unit suit what is seen.

    >>> scale(np.array([1.0, np.inf, 10.0, 100.0])).positions
    array([   1.,   10.,  100., 1000.])
    """
    order = np.argsort(values, kind="stable")
    places = values[order]
    finite = np.unique(places[np.isfinite(places)])
    log = is_log(finite)
    infinite = np.isinf(places)
    if infinite.any():
        steps = max(1, finite.size - 1)
        if log:
            beyond = finite[-1] * (finite[-1] / finite[0]) ** (1 / steps)
        else:
            beyond = finite[-1] + ((finite[-1] - finite[0]) / steps or finite[-1])
        places = np.where(infinite, beyond, places)
    low, high = span.limits(name, log=log)
    seen = np.clip(finite, low, high)
    return Scale(
        order=order,
        positions=places,
        log=log,
        infinite=bool(infinite.any()),
        unit=unit_for(name, seen, log=log),
        limits=(low, high),
    )


class Numbers(Formatter):
    """Plain numbers in a unit; all ticks of an axis together, so that those which differ read differently."""

    def __init__(self, unit: Unit) -> None:
        self.unit = unit

    def __call__(self, value: float, pos: Any = None) -> str:  # noqa: ARG002 (matplotlib gives it)
        """Write one number."""
        return self.unit.number(value)

    def format_ticks(self, values: Sequence[float]) -> list[str]:
        """Write the numbers of an axis."""
        return self.unit.numbers(values)


def few_ticks(axis: Axis, unit: Unit, count: int = 3) -> None:
    """Put about so many ticks at round numbers between the limits of an axis, whatever its scale."""
    low, high = sorted(axis.get_view_interval())
    slack = 1e-9 * (high - low)  # an end that is a round number is one of them
    found = MaxNLocator(count, steps=[1, 2, 5, 10]).tick_values(low, high)
    places = [float(place) for place in found if low - slack <= place <= high + slack]
    axis.set_minor_locator(NullLocator())
    axis.set_ticks(places, unit.numbers(places))
    axis.set_view_interval(low, high, ignore=True)
