"""Variables beside or below each other share the edges of their panels, whatever their labels need."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.transforms import Bbox
from numpy.typing import NDArray

ROUNDING = 9
"""Decimals of a side of panels, in figures, that tell two edges apart."""


class Aligned(ConstrainedLayoutEngine):
    """
    The constrained layout of matplotlib, with common edges for the parts of a figure.

    Each part first gets the room that its own labels need; then the edges of what stands in one row or column move to
    the innermost of all, row by row of panels if all parts have equally many.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> layout = Aligned()
    >>> figure = Figure(layout=layout)
    >>> parts = figure.subfigures(1, 2, squeeze=False)
    >>> layout.parts = parts.tolist()
    >>> one, other = (part.subplots() for part in parts[0])
    >>> _ = other.set_title("a title takes room")
    >>> figure.draw_without_rendering()
    >>> bool(one.get_position().y1 == other.get_position().y1)
    True
    """

    parts: Sequence[Sequence[SubFigure]] = ()
    """The parts of the figure, row by row."""

    def execute(self, fig: Figure) -> None:
        """Lay out the figure, then move the edges of its parts together."""
        super().execute(fig)
        rows = [[part for part in row if part.axes] for row in self.parts]
        for row in rows:
            _share(row, ("y0", "y1"))
        for column in range(max(map(len, rows), default=0)):
            _share([row[column] for row in rows if column < len(row)], ("x0", "x1"))


def _share(parts: Sequence[SubFigure], sides: tuple[str, str]) -> None:
    """Move the axes of each part so that all take the room that is common to all."""
    if len(parts) < 2:
        return
    edges = [_edges(part, sides) for part in parts]
    if len({own.size for own in edges}) > 1 or edges[0].size % 2:  # other grids: only the outer edges can meet
        edges = [own[[0, -1]] for own in edges]
    common = np.where(np.arange(edges[0].size) % 2, np.min(edges, axis=0), np.max(edges, axis=0))
    if (np.diff(common) <= 0.0).any():  # too little room for any layout: lay_out reports it
        return
    for part, own in zip(parts, edges, strict=True):
        for axes in part.axes:
            _move(axes, sides, np.interp([getattr(axes.get_position(), side) for side in sides], own, common))


def _edges(part: SubFigure, sides: tuple[str, str]) -> NDArray[np.float64]:
    """List the edges of the panels of a part, each once, from below or from the left."""
    ends = [getattr(axes.get_position(), side) for axes in part.axes for side in sides]
    rounded, first = np.unique(np.round(ends, ROUNDING), return_index=True)
    return np.array(ends)[first] if rounded.size else rounded


def _move(axes: Axes, sides: tuple[str, str], ends: NDArray[np.float64]) -> None:
    """Move two sides of axes; the next layout moves them like others."""
    place = {side: getattr(axes.get_position(), side) for side in ("x0", "y0", "x1", "y1")}
    place |= dict(zip(sides, ends, strict=True))
    axes.set_position(Bbox.from_extents(place["x0"], place["y0"], place["x1"], place["y1"]))
    axes.set_in_layout(True)
