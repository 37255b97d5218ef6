"""Fig. 5: the exact curve and its asymptotic form for short waves, as printed and with the mean height of the waves."""

from functools import partial

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import dress, plane_of, values_of
from figures.style import INK, shade


def comparison(axes: Axes, dataset: xarray.Dataset, item: int) -> None:
    """Draw load over depth at one of the wavelengths."""
    scene = dataset.isel(lambda_over_R=item)
    last = _end(scene)
    mean = float(scene["A"] * scene["lambda_over_R"])
    for prefix, shift, looks in (
        ("", 0.0, {"color": shade(0.75), "lw": 2.0, "label": "exact"}),
        (
            "asymptotic_",
            -mean,
            {"color": shade(0.25), "lw": 0.7, "ls": (0, (1.5, 1)), "label": "asymptotic, as printed"},
        ),
        ("asymptotic_", 0.0, {"color": INK, "lw": 0.8, "ls": (0, (4, 1.5)), "label": "with the mean height"}),
    ):
        (radius,) = values_of(scene, f"{prefix}contact_radius")
        depth, load = plane_of(scene, prefix, "a")
        shown = radius <= last
        axes.plot(depth[shown] + shift, load[shown], **looks)
    dress(axes, "a")
    axes.legend(loc="upper left", title=rf"$\lambda/R = {scene['lambda_over_R'].item():g}$", alignment="left")


def _end(scene: xarray.Dataset) -> float:
    """Return the radius of the last fold that ends a stable branch: the curves are drawn up to there."""
    radius, stable = values_of(scene, "contact_radius", "stable")
    return float(radius[1 + np.flatnonzero((stable[:-1] > 0.5) & (stable[1:] < 0.5))[-1]])


PICTURES = {f"fig5{panel}": partial(comparison, item=item) for item, panel in enumerate("abc")}
