"""Many points: how many of them are in each small cell of a panel, as single dots would hide each other."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import SubFigure
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullLocator

from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.picture.scales import Scale
from gradhesion.cli.picture.values.levels import Levels, Values
from gradhesion.cli.picture.values.panels import dress_values

CELLS: Final = (60, 34)
"""Hexagons along the sides of a panel."""

TICKED: Final = 1000
"""The greatest number in a cell up to which a decade has three ticks at the bar."""


def draw_density(axes: Axes, x: Scale, values: Values, levels: Levels, unit: Unit) -> None:
    """Colour each cell of a panel by the number of points in it, on a logarithmic scale; empty cells stay white."""
    there = ~np.isnan(values)
    dress_values(axes, levels, unit)
    axes.hexbin(
        x.positions[there],
        values[there],
        gridsize=CELLS,
        xscale="log" if x.log else "linear",
        yscale="log" if axes.get_yscale() == "log" else "linear",
        mincnt=1,
        cmap=levels.looks.colours,
        linewidths=0.1,
    )
    x.dress(axes, "x")
    dress_values(axes, levels, unit)
    axes.grid(visible=False)


def number_scenes(part: SubFigure, grid: Sequence[Axes]) -> None:
    """Give the cells of all panels one scale of colours, and a bar of it."""
    cells = [axes.collections[0] for axes in grid]
    counts = [cell.get_array() for cell in cells]
    most = max((float(np.max(count)) for count in counts if count is not None and np.size(count)), default=1.0)
    most = max(most, 2.0)
    norm = LogNorm(1.0, most)
    for cell in cells:
        cell.set_norm(norm)
    filled = ScalarMappable(norm=norm, cmap=cells[0].get_cmap())
    bar = part.colorbar(filled, ax=[*grid], label="scenes in a cell", fraction=0.06, aspect=30)
    bar.locator = LogLocator(subs=(1.0, 2.0, 5.0) if most < TICKED else (1.0,))
    bar.formatter = FormatStrFormatter("%g")
    bar.minorlocator = NullLocator()
