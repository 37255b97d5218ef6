"""Axes of a dataset as axes of a picture: spacing, a place for infinity, numbers at ticks; a part of them enlarged."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import Formatter, Locator, LogLocator, MaxNLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import is_log
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.labels import Unit, label, unit_for
from gradhesion.cli.picture.looks import ALL, Span

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


def suit(axes: Axes, side: Side, name: str, span: Span = ALL) -> None:
    """Name an axis of a picture after a variable, and let its unit suit the limits: those chosen, if some are."""
    low, high = sorted(getattr(axes, f"get_{side}lim")())
    limits = span.limits(name, low, high)
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


def scale(values: Places, name: str = "", span: Span = ALL) -> Scale:
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
    low, high = span.limits(name, log=log)
    return Scale(
        name=name,
        positions=np.where(infinite, beyond, values),
        log=log,
        infinite=bool(infinite.any()),
        unit=unit_for(name, np.clip(finite, low, high), log=log),
        limits=(low, high),
    )


SHARES: Final = ((0.5, 0.45), (0.45, 0.38), (0.38, 0.34), (0.32, 0.3), (0.27, 0.25), (0.23, 0.21))
"""Sides of an inset, over those of the panel, the best first."""

CORNERS: Final = ((1, 1), (0, 1), (1, 0), (0, 0), (0.5, 1), (0.5, 0), (1, 0.5), (0, 0.5))
"""Where in the room that it leaves an inset may stand: a corner, else the middle of a side."""


def add_inset(axes: Axes, again: Callable[[Axes], object], span: Span, name: str) -> None:
    """Draw a part of a panel once more, by what draws it into other axes; the layout of the figure must stand."""
    left, right = axes.get_xlim()
    ends = span.limits(name, left, right, log=axes.get_xscale() == "log")
    low, high = (end if np.isfinite(end) else limit for end, limit in zip(ends, (left, right), strict=True))
    if low < left or high > right:
        raise DatasetError(f"{span}: reaches beyond the axis of the panel; choose a part of it")
    in_panel = axes.transData - axes.transAxes
    first, last = in_panel.transform([[low, axes.get_ylim()[0]], [high, axes.get_ylim()[0]]])[:, 0]
    points = _points(axes)
    found = _seen(points[(points[:, 1] >= 0.0) & (points[:, 1] <= 1.0)], first, last)
    if found is None:
        raise DatasetError(f"{span}: nothing is drawn there; choose another part of the axis")
    bottom, top = np.clip(found, 0.0, 1.0)  # the frame stays in the panel
    frame = np.array([[x, y] for x in np.linspace(first, last, 50) for y in np.linspace(bottom, top, 50)])
    place = _free(axes, np.vstack([points, frame]))
    if place is None:
        raise DatasetError(
            f"{span}: no corner or side of the panel has room for an inset; make room with --ylim, --width or --height"
        )
    inset = axes.inset_axes(place)
    again(inset)
    up = in_panel.inverted().transform([[first, bottom], [first, top]])[:, 1]
    inset.set(xlabel="", ylabel="", xlim=(low, high), ylim=up)
    inset.set_in_layout(False)
    inset.tick_params(labelsize="x-small")
    for axis in (inset.xaxis, inset.yaxis):
        axis.set_major_locator(MaxNLocator(3, steps=[1, 2, 5, 10]))
    axes.indicate_inset_zoom(inset, edgecolor="0.4", lw=0.6)


def fit_heights(axes: Axes) -> None:
    """Let the vertical limits of a panel suit what is drawn between the horizontal ones."""
    found = _seen(_points(axes), 0.0, 1.0)
    if found:
        axes.set_ylim(*(axes.transAxes - axes.transData).transform([[0.0, end] for end in found])[:, 1])


def _points(axes: Axes) -> Places:
    """List points of all that is drawn in a panel, in shares of its sides, so near that no inset falls between."""
    lines = [line for line in axes.lines if line.get_zorder() > 0]  # below are the lines of zero
    drawn = [(line.get_xydata(), line.get_transform(), line.get_linestyle() == "None") for line in lines]
    areas = [one for one in axes.collections if isinstance(one, LineCollection | PolyCollection)]
    drawn += [(path.vertices, area.get_transform(), False) for area in areas for path in area.get_paths()]
    found = [np.empty((0, 2))]
    for vertices, transform, single in drawn:
        places = (transform - axes.transAxes).transform(vertices)
        pieces = np.diff(places, axis=0)
        between = np.linspace(0.0, 1.0, min(500, int(np.nanmax(np.hypot(*pieces.T), initial=0.0) / 0.005) + 2))[:-1]
        found += [places] if single else [(places[:-1] + between[:, None, None] * pieces).reshape(-1, 2), places[-1:]]
    points = np.vstack(found)
    return points[np.isfinite(points).all(axis=1)]


def _seen(points: Places, first: float, last: float) -> tuple[float, float] | None:
    """Report from where to where points go up between two places along, with a margin; None where there is none."""
    heights = points[(points[:, 0] >= first) & (points[:, 0] <= last), 1]
    if not heights.size:
        return None
    margin = 0.08 * (float(np.ptp(heights)) or 1.0)
    return float(heights.min()) - margin, float(heights.max()) + margin


def _free(axes: Axes, points: Places) -> tuple[float, float, float, float] | None:
    """Find the largest free place in a panel, in shares of its sides: x, y, width and height of an inset."""
    sides = np.array(axes.get_window_extent().size) / axes.figure.dpi
    labels, space = np.array([0.4, 0.24]) / sides, 0.06 / sides  # inches for numbers, and on the other sides
    for share in (one for one in np.array(SHARES) if (one * sides >= (0.7, 0.5)).all()):  # smaller ones show nothing
        room = share + labels + space
        for start in np.array(CORNERS) * (1.0 - room):
            if (start >= 0.0).all() and not ((points > start) & (points < start + room)).all(axis=1).any():
                x, y = start + labels
                return float(x), float(y), float(share[0]), float(share[1])
    return None
