"""Fig. 2: equilibrium curves of a wavy punch beside the smooth one."""

import xarray
from matplotlib.axes import Axes

from figures.curves import draw_equilibrium, dress, plane_of
from figures.style import DASHES, INK, key, legend, shade


def beside_smooth(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw load over depth of the wavy punch and of the smooth one."""
    smooth = shade(0.75)
    axes.plot(*plane_of(dataset, "smooth_", "a"), color=smooth, lw=1.2, ls=DASHES[1])
    draw_equilibrium(axes, dataset, "a", color=INK)
    dress(axes, "a")
    axes.text(0.97, 0.05, f"$k = {dataset['k'].item():g}$", transform=axes.transAxes, ha="right")
    handles = [
        key("wavy, stable", color=INK),
        key("wavy, unstable", color=INK, lw=0.8, ls=(0, (1, 1))),
        key("smooth, $A = 0$", color=smooth, lw=1.2, ls=DASHES[1]),
    ]
    legend(axes, handles=handles, loc="upper left")


PICTURES = {"fig2a": beside_smooth, "fig2b": beside_smooth}
