"""Fig. 9: the energy lost in a cycle against amplitude and wavelength, by the envelopes and exactly."""

from functools import partial

import xarray
from matplotlib.axes import Axes

from figures.style import AMPLITUDE, DASHES, ENERGY, INK, WAVELENGTH, key, shades

LABELS = {"A": AMPLITUDE, "lambda_over_R": WAVELENGTH}
FIXED = {"A": (r"\lambda/R", "lambda_over_R"), "lambda_over_R": ("A", "A")}
"""What does not vary, for each abscissa: its symbol and its name."""
MAPPED = (0.0, 0.4)
LEVELS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)


def energies(axes: Axes, dataset: xarray.Dataset, x: str) -> None:
    """Draw the energy over one axis, two lines for each gradient exponent."""
    energy = dataset["dissipated_energy"]
    exponents = energy["k"].values
    handles = [key("exact", color=INK), key("envelopes", color=INK, ls=DASHES[1])]
    for value, colour in zip(exponents, shades(exponents.size), strict=True):
        for solver, dash in (("exact", "-"), ("envelope", DASHES[1])):
            line = energy.sel(k=value, solver=solver)
            axes.plot(line[x], line, color=colour, ls=dash)
        handles.append(key(f"$k = {value:g}$", color=colour))
    axes.set(xlabel=LABELS[x], ylabel=ENERGY, xlim=(0.0, float(energy[x].max())))
    axes.set_ylim(0.0, 1.35 * float(energy.max()))
    symbol, fixed = FIXED[x]
    title = f"${symbol} = {dataset[fixed].item():g}$"
    axes.legend(handles=handles, loc="upper left", title=title, alignment="left", ncols=3, columnspacing=1.2)


def contours(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw lines of equal energy over wavelength and amplitude, for two gradient exponents."""
    energy = dataset["dissipated_energy"].transpose(..., "A", "lambda_over_R")
    handles = [key("exact", color=INK), key("envelopes", color=INK, ls=DASHES[1])]
    for value, colour in zip(MAPPED, shades(3)[::2], strict=True):
        for solver, dash in (("exact", "-"), ("envelope", DASHES[1])):
            over = energy.sel(k=value, solver=solver)
            lines = axes.contour(
                over["lambda_over_R"], over["A"], over, LEVELS, colors=[colour], linestyles=[dash], linewidths=0.9
            )
            if solver == "exact":
                axes.clabel(lines, fontsize=6)
        handles.append(key(f"$k = {value:g}$", color=colour))
    axes.set(xscale="log", xlabel=WAVELENGTH, ylabel=AMPLITUDE)
    axes.set_ylim(0.0, 0.2)
    axes.legend(handles=handles, loc="upper center", title=ENERGY, ncols=4, columnspacing=1.0)


PICTURES = {"fig9": contours, "fig9a": partial(energies, x="A"), "fig9b": partial(energies, x="lambda_over_R")}
