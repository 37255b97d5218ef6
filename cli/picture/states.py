"""The picture of states of contact: the pressure under the punch, and the surface around it."""

from collections.abc import Sequence
from itertools import cycle
from typing import Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import STATE
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.picture.labels import fixed, number, suit
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.pictured import finish, finite, stacked, styled

PANELS: Final = {"pressure": ("pressure_radius", "pressure"), "surface": ("surface_radius", "surface_displacement")}
"""What each curve has along and up."""

DASHES: Final = ("-", (0, (5, 1.5)), (0, (2, 1)), (0, (6, 1.5, 1, 1.5)))
"""What distinguishes states where colours do not print."""


def draw_states(dataset: xarray.Dataset, chosen: Sequence[str], looks: Looks) -> Figure:
    """Draw pressure and surface of the states of a scene, the first of several; in units if the dataset has them."""
    looks.refuse(["xlim", "ylim"], "curves of states are drawn whole")
    scene = dataset.isel(dict.fromkeys(dataset["status"].dims, 0)).load()
    panels = [names for curve, names in PANELS.items() if curve in chosen and {*names} <= {*scene}]
    if not panels:
        raise DatasetError(
            f"{chosen[0]}: lacks the radius or the value of a state; run a study with this curve as a whole"
        )
    if not any((scene[x].notnull() & scene[y].notnull()).any() for x, y in panels):
        raise DatasetError("no value in any state drawn; `gradhesion info` reports why")
    with styled(looks):
        below = stacked(len(panels), 2.4, looks)
        figure = Figure(layout="constrained")
        grid = figure.subplots(below, len(panels) // below, squeeze=False).ravel()
        for axes, (x, y) in zip(grid, panels, strict=True):
            si = SI if x + SI in scene and y + SI in scene else ""
            _draw(axes, scene, x + si, y + si, "surface_gap" + si, looks)
        caption, (handles, _) = [*fixed(dataset), *slope_warnings(dataset)], grid[-1].get_legend_handles_labels()
        size = looks.width or 4.0 * len(panels), 2.5 * below + 0.2
        finish(figure, dataset, looks, grid, caption, handles, size=size, rows=below)
    return figure


def _draw(axes: Axes, scene: xarray.Dataset, x: str, y: str, gap: str, looks: Looks) -> None:
    """Draw one curve of every state, and the punch itself where it does not touch."""
    along, up = (np.atleast_2d(finite(scene[name].values)) for name in (x, y))
    gaps = np.atleast_2d(finite(scene[gap].values)) if gap in scene and "surface" in y else np.full(up.shape, np.nan)
    seen = []
    states = scene[STATE].values.tolist()
    for i, (state, dash) in enumerate(zip(states, cycle(DASHES), strict=False)):
        words = state.replace("_", " ") if isinstance(state, str) else f"$a/R$ = {number(float(state))}"
        there = np.isfinite(along[i]) & np.isfinite(up[i])
        colour = looks.colours(0.75 * i / max(1, len(states) - 1))
        axes.plot(along[i], up[i], color=colour, ls=dash, lw=1.2, label=words if there.any() else f"{words} (absent)")
        punch = np.where(gaps[i] > 0.0, up[i] - gaps[i], np.nan)
        axes.plot(along[i], punch, color=colour, lw=0.6, ls=(0, (1, 1.5)))
        seen.append(up[i][there & (along[i] <= 0.95 * np.max(along[i][there], initial=0.0))])
    axes.axhline(0.0, color="0.85", lw=0.6, zorder=0)
    axes.set_xlim(left=0.0)
    inner = np.concatenate(seen)
    if "surface" in y:
        axes.invert_yaxis()  # into the half-space is downwards
    elif inner.size:
        room = 0.08 * float(np.ptp(inner)) or 1.0
        axes.set_ylim(inner.min() - room, inner.max() + room)
    suit(axes, "x", x)
    suit(axes, "y", y)
