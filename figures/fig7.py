"""Fig. 7: the effective path and the exact path, where they turn and where they end."""

from functools import partial
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import PLANES, draw_path, dress, values_of
from figures.effective import effective_path
from figures.style import INK, key, shade

LOADING, UNLOADING = shade(0.85), shade(0.3)


def paths(axes: Axes, dataset: xarray.Dataset, plane: str) -> None:
    """Draw both paths in a plane, with a_am and a_max, and both least depths."""
    draw_path(axes, dataset, plane, LOADING, UNLOADING, width=0.7)
    path, turn = effective_path(dataset)
    axes.plot(*(path[name] for name in PLANES[plane]), color=INK, lw=1.0)
    dress(axes, plane)
    if plane != "a":
        axes.set_xlim(right=1.07 * turn)
    radius, depth = values_of(dataset, "path_contact_radius", "path_indentation")
    marks = {
        "contact_radius": ((turn, INK, "$a_{am}$"), (float(radius.max()), UNLOADING, r"$a_{\max}$")),
        "indentation": (
            (float(path["indentation"][-1]), INK, r"$\delta_{\min}^{\mathrm{ef}}$"),
            (float(np.min(depth)), UNLOADING, r"$\delta_{\min}$"),
        ),
    }
    for name, draw in zip(PLANES[plane], (axes.axvline, axes.axhline), strict=True):
        pair = sorted(marks.get(name, ()))
        for i, (at, colour, symbol) in enumerate(pair):
            draw(at, color=colour, lw=0.5, ls=(0, (3, 2)), zorder=1)
            looks: dict[str, Any] = {"textcoords": "offset points", "fontsize": 7, "color": colour}
            if draw == axes.axhline:
                axes.annotate(symbol, (0.02 + 0.15 * i, at), (0, 4), xycoords=("axes fraction", "data"), **looks)
            elif name == "indentation":
                axes.annotate(symbol, (at, 0.05 + 0.1 * i), (4, 0), xycoords=("data", "axes fraction"), **looks)
            else:
                axes.annotate(symbol, (at, 0.05), (16 * i - 15, 0), xycoords=("data", "axes fraction"), **looks)
    handles = [
        key("effective path", color=INK, lw=1.0),
        key("exact, loading", color=LOADING, lw=1.7),
        key("exact, unloading", color=UNLOADING, lw=0.7),
    ]
    axes.legend(handles=handles, loc="upper left")


PICTURES = {f"fig7{plane}": partial(paths, plane=plane) for plane in PLANES}
