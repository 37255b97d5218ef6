"""Fig. 5: the exact curve and the asymptotic one for short waves."""

from functools import partial

import xarray
from matplotlib.axes import Axes

from figures.curves import dress, plane_of
from figures.style import INK, shade


def comparison(axes: Axes, dataset: xarray.Dataset, item: int) -> None:
    """Draw load over depth at one of the wavelengths, exact and asymptotic."""
    scene = dataset.isel(lambda_over_R=item)
    light = shade(0.75)
    axes.plot(*plane_of(scene, "", "a"), color=light, lw=1.8, label="exact")
    axes.plot(*plane_of(scene, "asymptotic_", "a"), color=INK, lw=0.8, ls=(0, (4, 1.5)), label="asymptotic")
    dress(axes, "a")
    axes.legend(loc="upper left", title=rf"$\lambda/R = {scene['lambda_over_R'].item():g}$", alignment="left")


PICTURES = {f"fig5{panel}": partial(comparison, item=item) for item, panel in enumerate("abc")}
