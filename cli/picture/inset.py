"""A part of a panel once more, enlarged, where nothing else is drawn."""

from collections.abc import Callable
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.spans import Span

Places = NDArray[np.float64]

SHARES: Final = ((0.5, 0.45), (0.45, 0.38), (0.38, 0.34), (0.32, 0.3), (0.27, 0.25), (0.23, 0.21))
"""Sides of an inset, over those of the panel, the best first."""

CORNERS: Final = ((1, 1), (0, 1), (1, 0), (0, 0), (0.5, 1), (0.5, 0), (1, 0.5), (0, 0.5))
"""Where in the room that it leaves an inset may stand: a corner, else the middle of a side."""

LEAST: Final = (0.7, 0.5)
"""The least sides of an inset, in inches: a smaller one shows nothing."""

LABELS: Final = (0.4, 0.24)
SPACE: Final = (0.06, 0.06)
"""The room for numbers left of an inset and below it, and the space on its other sides, in inches."""

STEP: Final = 0.005
"""The distance of points along a line, in panels."""

MARGIN: Final = 0.08
"""The space above and below what is seen, over its height."""


def add_inset(axes: Axes, again: Callable[[Axes], object], span: Span, name: str) -> None:
    """
    Draw a part of a panel once more, by what draws it into other axes; the layout of the figure must stand.

    Raises
    ------
    DatasetError
        The part lies outside the panel, nothing is drawn in it, or there is no room.
    """
    left, right = axes.get_xlim()
    ends = span.limits(name, left, right, log=axes.get_xscale() == "log")
    low, high = (end if np.isfinite(end) else limit for end, limit in zip(ends, (left, right), strict=True))
    if low < left or high > right:
        raise DatasetError(f"{span}: reaches beyond the axis of the panel; choose a part of it")
    in_panel = axes.transData - axes.transAxes
    foot = axes.get_ylim()[0]
    first, last = in_panel.transform([[low, foot], [high, foot]])[:, 0]
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


def along(line: Places, step: float) -> Places:
    """Give points of a line with others between them, at most 500 a piece and some step apart."""
    pieces = np.diff(line, axis=0)
    longest = np.nanmax(np.hypot(*pieces.T), initial=0.0)
    shares = np.linspace(0.0, 1.0, min(500, int(longest / step) + 2))[:-1, None, None]
    return np.vstack([(line[:-1] + shares * pieces).reshape(-1, 2), line[-1:]])


def _points(axes: Axes) -> Places:
    """List points of all that is drawn in a panel, in shares of its sides, so near that no inset falls between."""
    drawn = [
        (line.get_xydata(), line.get_transform(), line.get_linestyle() == "None")
        for line in axes.lines
        if line.get_zorder() > 0  # below are the lines of zero
    ]
    areas = [one for one in axes.collections if isinstance(one, LineCollection | PolyCollection)]
    drawn += [(path.vertices, area.get_transform(), False) for area in areas for path in area.get_paths()]
    found = [np.empty((0, 2))]
    for vertices, transform, single in drawn:
        places = (transform - axes.transAxes).transform(vertices)
        found.append(places if single else along(places, STEP))
    points = np.vstack(found)
    return points[np.isfinite(points).all(axis=1)]


def _seen(points: Places, first: float, last: float) -> tuple[float, float] | None:
    """Report from where to where points go up between two places along, with a margin; None where there is none."""
    heights = points[(points[:, 0] >= first) & (points[:, 0] <= last), 1]
    if not heights.size:
        return None
    margin = MARGIN * (float(np.ptp(heights)) or 1.0)
    return float(heights.min()) - margin, float(heights.max()) + margin


def _free(axes: Axes, points: Places) -> tuple[float, float, float, float] | None:
    """Find the largest free place in a panel, in shares of its sides: x, y, width and height of an inset."""
    sides = np.array(axes.get_window_extent().size) / axes.get_figure(root=True).dpi  # type: ignore[union-attr]
    labels, space = np.array(LABELS) / sides, np.array(SPACE) / sides
    for share in np.array(SHARES):
        if (share * sides < LEAST).any():
            continue
        room = share + labels + space
        for corner in np.array(CORNERS):
            start = corner * (1.0 - room)
            taken = ((points > start) & (points < start + room)).all(axis=1).any()
            if (start >= 0.0).all() and not taken:
                x, y = start + labels
                return float(x), float(y), float(share[0]), float(share[1])
    return None
