"""Fig. 4: the pull-off force against the wavelength and the radius of the punch."""

from itertools import cycle

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from figures.style import DASHES, FORCE, INK, RIM, WAVELENGTH, shades


def _lines(axes: Axes, force: xarray.DataArray, x: str, second: str, label: str) -> None:
    """Draw the force over one axis, a line for each value of the other."""
    values = force[second].values
    for value, colour, dash in zip(values, shades(values.size), cycle(DASHES), strict=False):
        line = force.sel({second: value})
        axes.plot(line[x], line, color=colour, ls=dash, label=f"{label}{value:g}$")


def _over_wavelength(axes: Axes, dataset: xarray.Dataset, second: str, label: str) -> None:
    """Draw the force over the wavelength."""
    _lines(axes, dataset["pull_off_force"], "lambda_over_R", second, label)
    axes.set(xscale="log", xlabel=WAVELENGTH, ylabel=FORCE, xlim=_ends(dataset["lambda_over_R"]))
    axes.set_ylim(bottom=0.0)
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.legend(loc="upper left")


def exponents(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw a line for each gradient exponent, with the best exponent marked at its maximum."""
    _over_wavelength(axes, dataset, "k", "$k = ")
    force = dataset["pull_off_force"]
    best = force.isel({str(name): index for name, index in force.argmax(...).items()})
    axes.plot(best["lambda_over_R"], best, "o", mfc="white", mec=INK, mew=0.7, ms=3.5, zorder=3)
    axes.annotate(
        f"$k = {best['k'].item():g}$", (best["lambda_over_R"].item(), best.item()), (6, 1), textcoords="offset points"
    )


def depths(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw a line for each depth of the gradient."""
    _over_wavelength(axes, dataset, "c0_over_R", "$c_0/R = ")


def rims(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the force over the radius of the punch, and mark the radius beyond which none of the lines changes."""
    force = dataset["pull_off_force"]
    _lines(axes, force, "a_max_over_R", "lambda_over_R", r"$\lambda/R = ")
    threshold = threshold_of(force)
    axes.axvline(threshold, color="0.5", lw=0.6, ls=(0, (4, 2)), zorder=0)
    axes.set(xlabel=RIM, ylabel=FORCE, xlim=(0, _ends(force["a_max_over_R"])[1]))
    axes.set_ylim(bottom=0.0)
    label = rf"$a_{{\max}}/R = {threshold:.2f}$"
    axes.annotate(label, (threshold, 0.52), (4, 0), xycoords=("data", "axes fraction"), textcoords="offset points")
    axes.legend(loc="upper left")


def threshold_of(force: xarray.DataArray) -> float:
    """Return the least radius of the punch from which on the force of every line is that of the widest punch."""
    widest = force.isel(a_max_over_R=-1)
    changes = (abs(force - widest) > 1e-9 * abs(widest)).any("lambda_over_R").values
    return float(force["a_max_over_R"].values[np.flatnonzero(changes)[-1] + 1])


def _ends(values: xarray.DataArray) -> tuple[float, float]:
    """Return the ends of an axis."""
    return float(values.min()), float(values.max())


PICTURES = {"fig4a": exponents, "fig4b": depths, "fig4c": rims}
