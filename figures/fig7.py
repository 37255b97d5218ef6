"""Fig. 7: the effective path along the envelopes, and the exact path."""

from functools import partial

import xarray
from matplotlib.axes import Axes

from figures.curves import PLANES, draw_path, dress, plane_of
from figures.style import INK, key, shade

LOADING, UNLOADING = shade(0.85), shade(0.3)


def paths(axes: Axes, dataset: xarray.Dataset, plane: str) -> None:
    """Draw both paths in a plane."""
    draw_path(axes, dataset, plane, LOADING, UNLOADING, width=0.7)
    axes.plot(*plane_of(dataset, "effective_", plane), color=INK, lw=1.2)
    dress(axes, plane)
    handles = [
        key("effective path", color=INK, lw=1.2),
        key("exact, loading", color=LOADING, lw=1.7),
        key("exact, unloading", color=UNLOADING, lw=0.7),
    ]
    axes.legend(handles=handles, loc="upper left")


PICTURES = {f"fig7{plane}": partial(paths, plane=plane) for plane in PLANES}
