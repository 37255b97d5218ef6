"""Fig. 4: the pull-off force against the wavelength, for gradient exponents, depths of the gradient, and rims."""

from itertools import cycle

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from figures.style import DASHES, FORCE, INK, WAVELENGTH, key, shades
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC

GREATEST = r"greatest $F\,/\,1.5\,\pi R\Delta\gamma$ over the wavelength"
LINES = (0.0, 0.2, 0.4, 0.6, 0.8, 0.9)
"""The exponents of the lines in Fig. 4a; the panel of maxima has all."""


def draw_lines(axes: Axes, force: xarray.DataArray, x: str, second: str, label: str) -> None:
    """Draw the force over one axis, a line for each value of the other; one without end broad, below those upon it."""
    values = force[second].values
    for value, colour, dash in zip(values, shades(values.size), cycle(DASHES), strict=False):
        line = force.sel({second: value})
        if np.isinf(value):
            axes.plot(line[x], line, color="0.8", lw=3.0, zorder=1, label=rf"{label}\infty$")
        else:
            axes.plot(line[x], line, color=colour, ls=dash, label=f"{label}{value:g}$")


def _over_wavelength(axes: Axes, force: xarray.DataArray, second: str, label: str) -> None:
    """Draw the force over the wavelength."""
    draw_lines(axes, force, "lambda_over_R", second, label)
    axes.set(xscale="log", xlabel=WAVELENGTH, ylabel=FORCE, xlim=ends_of(force["lambda_over_R"]))
    axes.set_ylim(bottom=0.0)
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.legend(loc="upper left")


def exponents(lines: Axes, others: Axes, maxima: Axes, dataset: xarray.Dataset) -> None:
    """Draw a line for each of some exponents, at both Poisson's ratios, and the maxima of all over the exponent."""
    force = dataset["pull_off_force"]
    chosen = force.sel(k=list(LINES), method="nearest")
    for axes, nu in zip((lines, others), force["nu"].values, strict=True):
        _over_wavelength(axes, chosen.sel(nu=nu), "k", "$k = ")
        axes.legend(loc="upper left", title=rf"$\nu = {nu:g}$", alignment="left")
        axes.set_ylim(0.0, 1.04 * float(chosen.max()))
    greatest = force.max("lambda_over_R")
    place = force.argmax("lambda_over_R")
    doubtful = (dataset["status"].isel(lambda_over_R=place) & LOADING_NOT_ONE_DISC) > 0
    handles = []
    for nu, colour, dash in zip(force["nu"].values, shades(3), DASHES, strict=False):
        line, flagged = greatest.sel(nu=nu), doubtful.sel(nu=nu)
        maxima.plot(line["k"], line, color="0.75", lw=2.4, zorder=1)
        maxima.plot(line["k"], line, color=colour, ls=dash, zorder=2)
        maxima.plot(line["k"], line.where(~flagged), color=colour, lw=2.4, zorder=3)
        best = int(line.argmax("k"))
        inside = best + 1 < line.sizes["k"]
        top = (line["k"][best].item(), line[best].item())
        if inside:
            maxima.plot(*top, "o", mfc="white", mec=INK, mew=0.7, ms=3.5, zorder=4)
        said = f"greatest at $k = {top[0]:.2g}$" if inside else f"rising to the end, $k = {top[0]:.2g}$"
        maxima.annotate(
            said, top, (0, 6) if inside else (-4, 2), textcoords="offset points", ha="center" if inside else "right"
        )
        handles.append(key(rf"$\nu = {nu:g}$", color=colour, ls=dash))
    maxima.set(xlabel="gradient exponent $k$", ylabel=GREATEST, xlim=(0.0, 1.0))
    maxima.set_ylim(0.0, 1.1 * float(greatest.max()))
    handles.append(key("loading not one disc", color="0.75", lw=2.4))
    handles.append(key("loading one disc", color=shades(3)[0], lw=2.4))
    maxima.legend(handles=handles, loc="upper left")


def depths(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw a line for each depth of the gradient."""
    _over_wavelength(axes, dataset["pull_off_force"], "c0_over_R", "$c_0/R = ")


def radii(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw a line for each radius of the punch."""
    _over_wavelength(axes, dataset["pull_off_force"], "a_max_over_R", r"$a_{\max}/R = ")


def ends_of(values: xarray.DataArray) -> tuple[float, float]:
    """Return the ends of an axis."""
    return float(values.min()), float(values.max())


PICTURES = {"fig4a": exponents, "fig4b": depths, "fig4c": radii}
