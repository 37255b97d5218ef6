"""Fig. 6: the exact curve between its envelopes."""

import xarray
from matplotlib.axes import Axes

from figures.curves import PLANES, dress, plane_of, values_of
from figures.style import DASHES, shade


def envelopes(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the exact curve and both envelopes: load over depth, and in the corner depth over contact radius."""
    _between(axes, dataset, "a")
    axes.legend(loc="lower right")
    inset = axes.inset_axes((0.19, 0.55, 0.4, 0.43))
    inset.tick_params(labelsize=6, pad=2)
    inset.xaxis.label.set_fontsize(7)
    inset.yaxis.label.set_fontsize(7)
    _between(inset, dataset, "b", width=0.8)


def _between(axes: Axes, dataset: xarray.Dataset, plane: str, width: float = 1.0) -> None:
    """Draw the curves in a plane."""
    axes.plot(*plane_of(dataset, "", plane), color="0.45", lw=0.7 * width, label="exact")
    abscissa, ordinate = PLANES[plane]
    for way, colour, dash in (("loading", shade(0.8), "-"), ("unloading", shade(0.1), DASHES[1])):
        names = [f"{way}_envelope_{name}" for name in (abscissa, ordinate)]
        if abscissa == "contact_radius":
            names[0] = "envelope_contact_radius"
        axes.plot(*values_of(dataset, *names), color=colour, lw=1.2 * width, ls=dash, label=f"{way} envelope")
    dress(axes, plane)


PICTURES = {"fig6": envelopes}
