"""Fig. 3: the path of loading and unloading with its jumps, its corners named A, B, ... in order."""

from functools import partial
from itertools import chain, repeat
from string import ascii_uppercase
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import Values, draw_equilibrium, draw_path, dress, plane_of, values_of
from figures.style import INK, key, legend, shade

LOADING, UNLOADING = shade(0.8), shade(0.1)

_ABOVE = (6, 5)
PLACES = {
    "a": ((-5, 6), (-12, -2), (6, 4), (5, -6), (5, 5), (7, -3), (-6, 2), (7, -3), (7, 0), (6, -4), (-7, 0), (5, 6)),
    "b": ((6, 5), (6, -5), (-3, 6), (7, -2), (-3, 6), (7, -3), (-6, 3), (7, -3), (-4, 6), (6, -5), (-6, -5), (6, -5)),
    "c": ((13, 6), (0, 6), (2, 6), (7, -3), (-5, 5), (7, -3), (-7, 2), (6, -5), (4, -7), (6, -5), (-5, -6), (5, 6)),
}
"""Where the letter of each corner stands beside it, in points."""

NAME: dict[str, Any] = {
    "textcoords": "offset points",
    "ha": "center",
    "va": "center",
    "fontsize": 7,
    "fontstyle": "italic",
}


def corners_of(dataset: xarray.Dataset) -> list[int]:
    """Return the points of the path where it starts, jumps, lands, turns, is pulled most and ends."""
    load, jump, back = values_of(dataset, "path_load", "path_jump", "path_unloading")
    landings = np.flatnonzero(jump > 0.5)
    turn = np.flatnonzero(back > 0.5)[0] - 1
    return sorted({0, turn, int(np.argmin(load)), *(landings - 1), *landings})


def path(axes: Axes, dataset: xarray.Dataset, plane: str) -> None:
    """Draw the path in a plane, over the equilibrium curve."""
    draw_equilibrium(axes, dataset, plane, color="0.5", lw=0.6)
    draw_path(axes, dataset, plane, LOADING, UNLOADING)
    x, y = plane_of(dataset, "path_", plane)
    corners = corners_of(dataset)
    axes.plot(x[corners], y[corners], "o", ms=2.2, color=INK, zorder=3, clip_on=False)
    for letter, i, place in zip(ascii_uppercase, corners, chain(PLACES[plane], repeat(_ABOVE)), strict=False):
        axes.annotate(letter, (x[i], y[i]), place, **NAME)
    _arrows(axes, x, y, dataset)
    axes.margins(x=0.07)  # room for the letters at the ends
    dress(axes, plane)
    handles = [
        key("loading", color=LOADING, lw=1.9),
        key("unloading", color=UNLOADING, lw=0.8),
        key("jump", color=INK, lw=0.8, ls=(0, (3, 1.5))),
        key("equilibrium", color="0.5", lw=0.6),
        key("unstable", color="0.5", lw=0.6, ls=(0, (1, 1))),
    ]
    legend(axes, handles=handles, loc="upper left")


def _arrows(axes: Axes, x: Values, y: Values, dataset: xarray.Dataset) -> None:
    """Put an arrow head on the middle of each jump."""
    jump, back = values_of(dataset, "path_jump", "path_unloading")
    for i in np.flatnonzero(jump > 0.5):
        start, middle = (x[i - 1], y[i - 1]), (0.45 * x[i - 1] + 0.55 * x[i], 0.45 * y[i - 1] + 0.55 * y[i])
        head = {
            "arrowstyle": "-|>,head_width=0.22,head_length=0.45",
            "mutation_scale": 8,
            "lw": 0,
            "shrinkA": 0,
            "shrinkB": 0,
        }
        colour = UNLOADING if back[i] > 0.5 else LOADING
        axes.annotate("", middle, start, arrowprops=head | {"color": colour}, zorder=2.5)


PICTURES = {f"fig3{plane}": partial(path, plane=plane) for plane in PLACES}
