"""A part of a panel once more, enlarged, where nothing else is drawn."""

from collections.abc import Callable
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.picture.scales import few_ticks
from gradhesion.cli.picture.spans import Span

Places = NDArray[np.float64]

SHARES: Final = ((0.5, 0.45), (0.45, 0.38), (0.38, 0.34), (0.32, 0.3), (0.27, 0.25), (0.23, 0.21))
"""Sides of an inset, over those of the panel, the best first."""

CORNERS: Final = ((1, 1), (0, 1), (1, 0), (0, 0), (0.5, 1), (0.5, 0), (1, 0.5), (0, 0.5))
"""Where in the room that it leaves an inset may stand: a corner, else the middle of a side."""

LEAST: Final = (0.7, 0.5)
"""The least sides of an inset, in inches: a smaller one shows nothing."""

LABELS: Final = (0.38, 0.22)
"""The room for numbers left of an inset and below it, in inches."""

SPACE: Final = 0.03
"""The space around an inset, over the side of the panel."""

MARGIN: Final = 0.08
"""The space above and below what is seen, over its height."""

STEP: Final = 0.01
"""The distance of points along a line, in panels."""

BACKGROUND: Final = 0
"""The order of what may lie below an inset, such as the lines of zero."""


def add_inset(axes: Axes, again: Callable[[Axes], object], span: Span, name: str, along: Unit, up: Unit) -> None:
    """
    Draw a part of a panel once more; the layout of the figure must stand.

    Parameters
    ----------
    axes
        The panel.
    again
        What draws the panel into other axes.
    span
        The part of the horizontal axis.
    name
        What is along it.
    along, up
        The units of its numbers; values are in SI.

    Raises
    ------
    DatasetError
        The part cannot be read or lies outside the panel, nothing is drawn in it, or there is no room.
    """
    log = axes.get_xscale() == "log"
    left, right = axes.get_xlim()
    ends = span.within(name, left, right, log=log)
    low, high = (end if np.isfinite(end) else limit for end, limit in zip(ends, (left, right), strict=True))
    if low < left or high > right:
        written = f"{along.number(left)} to {along.number(right)} {along.symbol}".strip()
        raise DatasetError(f"{span}: reaches beyond the axis of the panel, which is {written}; choose a part of it")
    points = _points(axes)
    first, last = _in_panel(axes, np.array([[low, 0.0], [high, 0.0]]))[:, 0]
    found = _seen(points, first, last)
    if found is None:
        raise DatasetError(f"{span}: nothing is drawn there; choose another part of the axis")
    bottom, top = max(0.0, found[0]), min(1.0, found[1])  # the frame stays in the panel
    corner = _free(axes, points, np.array([[first, bottom], [last, top]]))
    if corner is None:
        raise DatasetError(
            f"{span}: no corner or side of the panel has room for an inset; make room with --ylim, --width or --height"
        )
    inset = axes.inset_axes(corner)
    again(inset)
    inset.set(xlabel="", ylabel="", xlim=(low, high), ylim=_values(axes, bottom, top))
    inset.set_in_layout(False)
    inset.tick_params(labelsize="x-small")
    few_ticks(inset.xaxis, along)
    few_ticks(inset.yaxis, up)
    axes.indicate_inset_zoom(inset, edgecolor="0.4", lw=0.6)


def fit_heights(axes: Axes) -> None:
    """Let the vertical limits of a panel suit what is drawn between the horizontal ones."""
    found = _seen(_points(axes), 0.0, 1.0, hidden=True)
    if found:
        axes.set_ylim(*_values(axes, *found))


def _points(axes: Axes) -> Places:
    """List points of all that is drawn in a panel."""
    return np.vstack([np.empty((0, 2)), *map(_places, _drawn(axes))])


def _seen(points: Places, first: float, last: float, *, hidden: bool = False) -> tuple[float, float] | None:
    """Report from where to where points go up between two places along, with a margin; also those that are hidden."""
    along, up = points.T
    inside = up[(along >= first) & (along <= last) & (hidden | (up >= 0.0) & (up <= 1.0))]
    if not inside.size:
        return None
    margin = MARGIN * (float(np.ptp(inside)) or 1.0)
    return float(inside.min()) - margin, float(inside.max()) + margin


def _drawn(axes: Axes) -> list[Places]:
    """List the lines, the bars and the edges of the bands of a panel, as points of the panel; a NaN parts pieces."""
    found = []
    for artist in axes.get_children():
        if isinstance(artist, Line2D) and artist.zorder > BACKGROUND:
            path = artist.get_transform().transform(artist.get_xydata())
            single = artist.get_linestyle() in ("None", "", " ")
            found.append(np.insert(path, np.arange(1, len(path)), np.nan, axis=0) if single else path)
        elif isinstance(artist, LineCollection | PolyCollection):
            found += [artist.get_transform().transform(path.vertices) for path in artist.get_paths()]
    return [axes.transAxes.inverted().transform(path) for path in found if len(path)]


def _places(line: Places) -> Places:
    """Give points along a line so near to each other that no inset falls between them."""
    steps = np.hypot(*np.diff(line, axis=0).T)
    made = [line]
    for item in np.flatnonzero(steps > STEP):
        share = np.linspace(0.0, 1.0, min(500, int(steps[item] / STEP) + 2))[1:-1, None]
        made.append(line[item] + share * (line[item + 1] - line[item]))
    points = np.vstack(made)
    return points[np.isfinite(points).all(axis=1)]


def _free(axes: Axes, points: Places, zoomed: Places) -> tuple[float, float, float, float] | None:
    """Find the largest free place in a panel: x, y, width and height of an inset; None without one."""
    sides = np.array(axes.get_window_extent().size) / axes.get_figure(root=True).dpi  # type: ignore[union-attr]
    labels = np.array(LABELS) / sides
    for share in SHARES:
        size = np.array(share)
        if (size * sides < LEAST).any():
            continue
        room = size + labels + 2.0 * SPACE
        for corner in CORNERS:
            start = np.array(corner) * (1.0 - room)
            if (start < 0.0).any() or _meet(points, start, room):
                continue
            if (zoomed[0] < start + room).all() and (zoomed[1] > start).all():
                continue
            x, y = start + labels + SPACE
            return float(x), float(y), float(size[0]), float(size[1])
    return None


def _meet(points: Places, start: Places, size: Places) -> bool:
    """Report whether a point is in a box."""
    return bool(((points > start) & (points < start + size)).all(axis=1).any())


def _in_panel(axes: Axes, points: Places) -> Places:
    """Give points of the data as points of the panel."""
    return np.asarray(axes.transAxes.inverted().transform(axes.transData.transform(points)))


def _values(axes: Axes, *heights: float) -> tuple[float, float]:
    """Give two heights in the panel as values."""
    points = np.column_stack([np.zeros(2), heights])
    low, high = axes.transData.inverted().transform(axes.transAxes.transform(points))[:, 1]
    return float(low), float(high)
