"""Fig. 2: equilibrium curves of a wavy punch, beside the smooth one and for several amplitudes."""

import xarray
from matplotlib.axes import Axes

from figures.curves import draw_equilibrium, dress, plane_of
from figures.style import DASHES, INK, key, shade, shades


def beside_smooth(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw load over depth of the wavy punch and of the smooth one."""
    smooth = shade(0.75)
    axes.plot(*plane_of(dataset, "smooth_", "a"), color=smooth, lw=1.2, ls=DASHES[1])
    draw_equilibrium(axes, dataset, "a", color=INK)
    dress(axes, "a")
    handles = [
        key("wavy, stable", color=INK),
        key("wavy, unstable", color=INK, lw=0.8, ls=(0, (1, 1))),
        key("smooth, $A = 0$", color=smooth, lw=1.2, ls=DASHES[1]),
    ]
    axes.legend(handles=handles, loc="upper left")


def amplitudes(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw depth over contact radius for several amplitudes."""
    values = dataset["A"].values
    handles = []
    for value, colour in zip(values, shades(values.size)[::-1], strict=True):
        draw_equilibrium(axes, dataset.sel(A=value), "b", color=colour)
        handles.append(key(f"$A = {value:g}$", color=colour))
    dress(axes, "b")
    handles.append(key("unstable", color="0.4", lw=0.8, ls=(0, (1, 1))))
    axes.legend(handles=handles, loc="upper left")


PICTURES = {"fig2a": beside_smooth, "fig2b": amplitudes}
