"""Axes of a dataset as axes of a picture: spacing, a place for infinity, numbers at ticks."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import Formatter, Locator, LogLocator, MaxNLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import is_log
from gradhesion.cli.picture.labels import Unit, label, unit_for
from gradhesion.cli.picture.looks import limits_of

Side = Literal["x", "y"]
Places = NDArray[np.float64]


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


def locator(low: float, high: float, *, log: bool) -> Locator:
    """Choose what finds ticks at round numbers between two ends: of a logarithmic axis some in each decade."""
    if log and high > 6.0 * low:
        steps = (1.0, 2.0, 5.0) if high < 50.0 * low else (1.0, 3.0) if high < 1000.0 * low else (1.0,)
        return LogLocator(subs=steps, numticks=20)
    return MaxNLocator("auto", steps=[1, 2, 2.5, 5, 10])


def dress(
    axes: Axes,
    side: Side,
    unit: Unit,
    ends: tuple[float, float],
    limits: tuple[float, float] = (-np.inf, np.inf),
    *,
    log: bool = False,
) -> None:
    """Give an axis of a picture its scale, numbers in a unit at ticks between two ends, and limits that are finite."""
    axes.set(**{f"{side}scale": "log" if log else "linear"})
    axis = axes.xaxis if side == "x" else axes.yaxis
    axis.set_major_locator(locator(*ends, log=log))
    axis.set_major_formatter(Numbers(unit))
    axis.set_minor_locator(NullLocator())
    if np.isfinite(limits).any():
        axes.set(**{f"{side}lim": tuple(end if np.isfinite(end) else None for end in limits)})


def suit(axes: Axes, side: Side, name: str, span: str = "") -> None:
    """Name an axis of a picture after a variable, and let its unit suit the limits: those chosen, if some are."""
    low, high = sorted(getattr(axes, f"get_{side}lim")())
    limits = limits_of(span, name, low, high)
    seen = max(low, limits[0]) if limits[0] > -np.inf else low, min(high, limits[1]) if limits[1] < np.inf else high
    unit = unit_for(name, seen)
    dress(axes, side, unit, seen, limits)
    axes.set(**{f"{side}label": label(name, unit)})


@dataclass(frozen=True, kw_only=True, eq=False)
class Scale:
    """Where the values of an axis go in a picture."""

    name: str
    positions: Places
    """The place of each; inf stands one step beyond the greatest finite value."""
    log: bool
    infinite: bool
    """Whether the last place is that of inf."""
    unit: Unit
    """How its values are written."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Between which values it is drawn; all of them where they are infinite."""

    @property
    def label(self) -> str:
        """What the axis is called."""
        return label(self.name, self.unit)

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
        dress(axes, side, self.unit, (first, last), self.limits, log=self.log)
        if self.infinite and np.isinf(self.limits[1]):
            places = locator(first, last, log=self.log).tick_values(first, last)
            kept = [float(place) for place in places if first <= place <= last]
            axis = axes.xaxis if side == "x" else axes.yaxis
            axis.set_ticks([*kept, float(self.positions[-1])], [*self.unit.numbers(kept), r"$\infty$"])


def scale(values: Places, name: str = "", span: str = "") -> Scale:
    """Choose the scale of an axis of a name: logarithmic where its values are nearer to that than to an even spacing.

    Its values rise. Of a span of it, ticks and the unit suit what is seen.

    >>> scale(np.array([1.0, 10.0, 100.0, np.inf])).positions
    array([   1.,   10.,  100., 1000.])
    """
    finite = np.unique(values[np.isfinite(values)])
    log, infinite = is_log(finite), np.isinf(values)
    beyond, steps = 0.0, max(1, finite.size - 1)
    if infinite.any() and log:
        beyond = finite[-1] * (finite[-1] / finite[0]) ** (1 / steps)
    elif infinite.any():
        beyond = finite[-1] + ((finite[-1] - finite[0]) / steps or finite[-1])
    low, high = limits_of(span, name, log=log)
    return Scale(
        name=name,
        positions=np.where(infinite, beyond, values),
        log=log,
        infinite=bool(infinite.any()),
        unit=unit_for(name, np.clip(finite, low, high), log=log),
        limits=(low, high),
    )
