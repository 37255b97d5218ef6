"""Fig. 6: the exact curve between its envelopes."""

from functools import partial

import xarray
from matplotlib.axes import Axes

from figures.curves import PLANES, dress, plane_of, values_of
from figures.style import DASHES, shade


def envelopes(axes: Axes, dataset: xarray.Dataset, plane: str) -> None:
    """Draw the exact curve and both envelopes in a plane."""
    axes.plot(*plane_of(dataset, "", plane), color="0.45", lw=0.7, label="exact")
    abscissa, ordinate = PLANES[plane]
    for way, colour, dash in (("loading", shade(0.8), "-"), ("unloading", shade(0.1), DASHES[1])):
        names = [f"{way}_envelope_{name}" for name in (abscissa, ordinate)]
        if abscissa == "contact_radius":
            names[0] = "envelope_contact_radius"
        axes.plot(*values_of(dataset, *names), color=colour, lw=1.2, ls=dash, label=f"{way} envelope")
    dress(axes, plane)
    axes.legend(loc="upper left")


PICTURES = {f"fig6{plane}": partial(envelopes, plane=plane) for plane in "ab"}
