"""What is known of the spread of uncertain values, as a band around a line or as bars at its points."""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI, SPREADABLE, SPREADS
from gradhesion.cli.picture.doubts import BAND_WORDS, INK
from gradhesion.cli.picture.looks import Looks

Values = NDArray[np.float64]
Edges = tuple[Values, Values]
"""The lower and the upper edge of a band."""

FEW: Final = 20
"""Values along an axis up to which a band is drawn as bars: between them nothing is known."""

ABOVE_GRID: Final = 1.8
"""The order of bars: above the lines of the grid, which matplotlib puts at 1.5, and below the values, at 2."""

LIGHT: Final = 0.2
"""How opaque a band is."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Band:
    """The edges of a band around a variable, over its own dimensions."""

    low: xarray.DataArray
    high: xarray.DataArray
    how: str
    """"quantiles" or "std"."""

    def extremes(self) -> Values:
        """List the finite edges."""
        edges: Values = np.append(self.low.values, self.high.values)
        finite: Values = edges[np.isfinite(edges)]
        return finite


def band_of(dataset: xarray.Dataset, name: str, selection: Selection, looks: Looks) -> Band | None:
    """
    Find the band of a variable: what is asked for, else its quantiles, else its standard deviation; None without one.

    Raises
    ------
    DatasetError
        A band is asked for that the variable does not have, or of values that are taken over an axis.
    """
    requested = looks.band
    if requested == "none":
        return None
    if selection.over:
        looks.refuse(["band"], f"{name} is taken over {next(iter(selection.over))}, and its spread is that of a scene")
        return None
    plain, unit = name.removesuffix(SI), SI if name.endswith(SI) else ""
    stem = plain.removesuffix("_mean").removesuffix("_p50") if plain in SPREADS else plain
    for how, endings in (("quantiles", ("_p05", "_p95")), ("std", ("_std",))):
        parts = [f"{stem}{ending}{unit}" for ending in endings]
        if requested in (None, how) and all(part in dataset for part in parts):
            status = dataset["status"]
            edges = [selection.taken(dataset[part], status).values for part in parts]
            if how == "std":
                middle = selection.taken(dataset[name], status).values
                edges = [middle - edges[0], middle + edges[0]]
            return Band(low=edges[0], high=edges[1], how=how)
    if requested:
        raise DatasetError(f"--band {requested}: {_missing(dataset, name, stem + '_std' + unit, requested)}")
    return None


def _missing(dataset: xarray.Dataset, name: str, std: str, requested: str) -> str:
    """Say why a variable has no band, and what to do."""
    if name.removesuffix(SI) not in SPREADABLE:
        return f"{name} has none; choose an output with --variable, or leave --band out"
    if requested == "quantiles" and std in dataset:
        return f"{name} has no quantiles in this dataset; write --band std, or add samples = 1024 to [uncertainty]"
    return f"{name} has no spread in this dataset; add [uncertainty] to its study, or leave --band out"


def draw_band(axes: Axes, positions: Values, edges: Edges, colour: Any) -> None:
    """Draw a band around a line; where it has few values, a bar at each of them."""
    if positions.size > FEW:
        axes.fill_between(positions, *edges, color=colour, alpha=LIGHT, lw=0.0, zorder=1)
    elif positions.size:
        draw_bars(axes, positions, edges, colour)


def draw_bars(axes: Axes, positions: Values, edges: Edges, colour: Any) -> None:
    """Draw a bar at each value."""
    axes.vlines(positions, *edges, colors=colour, lw=0.8, zorder=ABOVE_GRID)
    for edge in edges:
        axes.plot(positions, edge, ls="", marker="_", ms=4, mew=0.8, color=colour, zorder=ABOVE_GRID)


def band_entry(band: Band, size: int) -> Patch | Line2D:
    """Make the entry of a legend."""
    words = BAND_WORDS[band.how]
    if size > FEW:
        return Patch(facecolor=INK, alpha=LIGHT, lw=0.0, label=words)
    return Line2D([], [], ls="", marker="|", ms=7, mew=0.8, color=INK, label=words)
