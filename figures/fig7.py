"""Fig. 7: the effective path and the exact path, where they turn and where they end."""

from functools import partial
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import PLANES, draw_path, dress, values_of
from figures.effective import effective_path
from figures.style import INK, key, legend, shade

LOADING, UNLOADING = shade(0.85), shade(0.3)
MARK: Final = (0, (3, 2))


def paths(axes: Axes, dataset: xarray.Dataset, plane: str) -> None:
    """Draw both paths in a plane, and mark a_am and a_max and the least depth where it has their axes."""
    draw_path(axes, dataset, plane, LOADING, UNLOADING, width=0.7)
    path, turn = effective_path(dataset)
    axes.plot(*(path[name] for name in PLANES[plane]), color=INK, lw=1.0)
    dress(axes, plane)
    radius, depth = values_of(dataset, "path_contact_radius", "path_indentation")
    if plane != "a":
        axes.set_xlim(right=1.07 * turn)
        _radii(axes, turn, float(radius.max()))
    if plane != "c":
        _least_depths(axes, float(path["indentation"][-1]), float(np.min(depth)), upright=plane == "a")
    handles = [
        key("effective path", color=INK, lw=1.0),
        key("exact, loading", color=LOADING, lw=1.7),
        key("exact, unloading", color=UNLOADING, lw=0.7),
    ]
    legend(axes, handles=handles, loc="upper left")


def _radii(axes: Axes, turn: float, greatest: float) -> None:
    """Mark where the paths turn, the names above the frame: a_am left of its line, a_max right of it."""
    left, right = sorted((turn, greatest))
    for at, colour, name in ((turn, INK, r"$a_{\mathrm{am}}$"), (greatest, UNLOADING, r"$a_{\max}$")):
        axes.axvline(at, color=colour, lw=0.5, ls=MARK, zorder=1)
        side, shift = ("right", 1) if at == left != right else ("left", -1)
        place: dict[str, Any] = {
            "xycoords": ("data", "axes fraction"),
            "textcoords": "offset points",
            "ha": side,
            "va": "bottom",
        }
        axes.annotate(name, (at, 1.0), (shift, 2), color=colour, fontsize=8, **place)


def _least_depths(axes: Axes, effective: float, exact: float, *, upright: bool) -> None:
    """Mark where the paths end: one line, as the two depths cannot be told apart at this size."""
    name = r"$\delta_{\min}^{\mathrm{ef}} \approx \delta_{\min}$"
    looks: dict[str, Any] = {"textcoords": "offset points", "fontsize": 8, "color": INK}
    middle = 0.5 * (effective + exact)
    if upright:
        axes.axvline(middle, ymax=0.16, color=INK, lw=0.5, ls=MARK, zorder=1)
        axes.annotate(name, (middle, 0.04), (3, 0), xycoords=("data", "axes fraction"), **looks)
    else:
        axes.axhline(middle, color=INK, lw=0.5, ls=MARK, zorder=1)
        axes.annotate(name, (0.03, middle), (0, 4), xycoords=("axes fraction", "data"), **looks)


PICTURES = {f"fig7{plane}": partial(paths, plane=plane) for plane in PLANES}
