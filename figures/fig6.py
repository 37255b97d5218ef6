"""Fig. 6: the exact curve and its path between the envelopes, with the line of early unloading."""

import xarray
from matplotlib.axes import Axes

from figures.curves import draw_equilibrium, draw_path, dress, values_of
from figures.effective import EARLY, effective_path
from figures.style import DASHES, INK, key, legend, shade

LOADING, UNLOADING = shade(0.85), shade(0.1)


def envelopes(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw load over depth."""
    draw_equilibrium(axes, dataset, "a", color="0.6", lw=0.6)
    draw_path(axes, dataset, "a", LOADING, UNLOADING, width=0.7)
    for way, dash in (("loading", DASHES[2]), ("unloading", DASHES[1])):
        names = (f"{way}_envelope_{name}" for name in ("indentation", "load"))
        axes.plot(*values_of(dataset, *names), color=shade(0.5), lw=1.2, ls=dash)
    path, _ = effective_path(dataset)
    axes.plot(path["indentation"][EARLY], path["load"][EARLY], color=INK, lw=1.6, marker="o", ms=2.5)
    dress(axes, "a")
    handles = [
        key("equilibrium", color="0.6", lw=0.6),
        key("path, loading", color=LOADING, lw=1.7),
        key("path, unloading", color=UNLOADING, lw=0.7),
        key("loading envelope", color=shade(0.5), lw=1.2, ls=DASHES[2]),
        key("unloading envelope", color=shade(0.5), lw=1.2, ls=DASHES[1]),
        key("early unloading", color=INK, lw=1.6, marker="o", ms=2.5),
    ]
    legend(axes, handles=handles, loc="upper left")


PICTURES = {"fig6": envelopes}
