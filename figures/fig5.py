"""Fig. 5: the exact curve and its asymptotic form for short waves, as printed and with the mean height of the waves."""

from functools import partial

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import dress, plane_of, values_of
from figures.style import INK, legend, shade


def comparison(axes: Axes, dataset: xarray.Dataset, item: int) -> None:
    """Draw load over depth at one of the wavelengths; the shortest, whose curves lie too close, has an inset."""
    scene = dataset.isel(lambda_over_R=item)
    _curves(axes, scene)
    dress(axes, "a")
    legend(axes, loc="upper left", title=rf"$\lambda/R = {scene['lambda_over_R'].item():g}$", alignment="left")
    if item == 2:
        axes.set_ylim(bottom=-1.75)
        _curves(enlarged(axes), scene)


def enlarged(axes: Axes) -> Axes:
    """Return an inset that shows the tip of one wave."""
    inset = axes.inset_axes((0.68, 0.05, 0.3, 0.34), xlim=(0.0221, 0.0245), ylim=(-0.14, 0.09))
    inset.set(xticks=[], yticks=[])
    axes.indicate_inset_zoom(inset, edgecolor="0.4", lw=0.5, alpha=1.0)
    return inset


def _curves(axes: Axes, scene: xarray.Dataset) -> None:
    """Draw the exact curve and both asymptotic ones."""
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


def _end(scene: xarray.Dataset) -> float:
    """Return the radius of the last fold that ends a stable branch: the curves are drawn up to there."""
    radius, stable = values_of(scene, "contact_radius", "stable")
    return float(radius[1 + np.flatnonzero((stable[:-1] > 0.5) & (stable[1:] < 0.5))[-1]])


PICTURES = {f"fig5{panel}": partial(comparison, item=item) for item, panel in enumerate("abc")}
