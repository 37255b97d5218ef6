"""Pictures that are not the paper's: amplitudes, the rim, energies over amplitude and wavelength, random roughness."""

import tomllib
from functools import partial
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.contour import ContourSet
from matplotlib.patches import Patch

from figures.curves import draw_equilibrium, dress
from figures.fig4 import draw_lines, ends_of
from figures.style import AMPLITUDE, DASHES, ENERGY, FORCE, INK, RIM, WAVELENGTH, key, shades
from gradhesion.core import doubts_about
from gradhesion.core.answers.spectrum import Spectrum

LABELS = {"A": AMPLITUDE, "lambda_over_R": WAVELENGTH}
FIXED = {"A": (r"\lambda/R", "lambda_over_R"), "lambda_over_R": ("A", "A")}
"""What does not vary, for each abscissa: its symbol and its name."""
MAPPED = (0.0, 0.4)
BOUND = 1e-9
"""An exponent up to which it is at the lower bound of its range."""
EXPONENT = "gradient exponent $k$"
TICKS = (0.05, 0.1, 0.2, 0.4, 0.6)
NINE_TENTHS = 1.6448536269514722
"""Standard deviations on either side of nine tenths of a normal distribution."""
LEVELS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)
BAND = Patch(facecolor=INK, alpha=0.2, lw=0, label="90 % of samples")
OPEN: dict[str, Any] = {"marker": "o", "ms": 2.8, "mfc": "white", "mew": 0.7}
SHORT = 40
"""Points of a contour that is too short for a label."""


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


def rims(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the force over the radius of the punch, and mark the radius beyond which none of the lines changes."""
    force = dataset["pull_off_force"]
    draw_lines(axes, force, "a_max_over_R", "lambda_over_R", r"$\lambda/R = ")
    threshold = threshold_of(force)
    axes.axvline(threshold, color="0.5", lw=0.6, ls=(0, (4, 2)), zorder=0)
    axes.set(xlabel=RIM, ylabel=FORCE, xlim=(0, ends_of(force["a_max_over_R"])[1]))
    axes.set_ylim(bottom=0.0)
    label = rf"$a_{{\max}}/R = {threshold:.2f}$"
    axes.annotate(label, (threshold, 0.52), (4, 0), xycoords=("data", "axes fraction"), textcoords="offset points")
    axes.legend(loc="upper left")


def threshold_of(force: xarray.DataArray) -> float:
    """Return the least radius of the punch from which on the force of every line is that of the widest punch."""
    widest = force.isel(a_max_over_R=-1)
    changes = (abs(force - widest) > 1e-9 * abs(widest)).any("lambda_over_R").values
    return float(force["a_max_over_R"].values[np.flatnonzero(changes)[-1] + 1])


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
    wavelength, amplitude = energy["lambda_over_R"], energy["A"]
    axes.set(xscale="log", xlabel=WAVELENGTH, ylabel=AMPLITUDE, xlim=ends_of(wavelength), ylim=ends_of(amplitude))
    handles = [key("exact", color=INK), key("envelopes", color=INK, ls=DASHES[1])]
    for value, colour in zip(MAPPED, shades(3)[::2], strict=True):
        unnamed = set(LEVELS)
        for solver, dash in (("exact", "-"), ("envelope", DASHES[1])):
            over = energy.sel(k=value, solver=solver)
            looks: dict[str, Any] = {"colors": [colour], "linestyles": [dash], "linewidths": 0.9}
            lines = axes.contour(wavelength, amplitude, over, LEVELS, **looks)
            where = _places(lines)
            named = [level for level in LEVELS if level in unnamed & set(where)]
            places = [where[level] for level in named]
            for text in axes.clabel(lines, named, fontsize=6, fmt="%g", manual=places, inline_spacing=2):
                text.set_bbox({"fc": "white", "ec": "none", "pad": 0.3})
            unnamed -= set(named)
        handles.append(key(f"$k = {value:g}$", color=colour))
    looks = {"ncols": 4, "columnspacing": 1.0, "handlelength": 1.8, "borderaxespad": 0.1}
    axes.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), title=ENERGY, **looks)


def _places(lines: ContourSet) -> dict[float, tuple[float, float]]:
    """Return where each level has its name, a third along its contour; one that only touches a corner has none."""
    longest = [max(parts, key=len, default=()) for parts in lines.allsegs]
    return {
        float(level): (float(part[len(part) // 3][0]), float(part[len(part) // 3][1]))
        for level, part in zip(lines.levels, longest, strict=True)
        if len(part) > SHORT
    }


def roughness(force: Axes, energy: Axes, dataset: xarray.Dataset) -> None:
    """Draw force and energy over the rms slope of random roughness: the mean, and a band of nine tenths."""
    written = tomllib.loads(dataset.attrs["study"])["profile"]["spectrum"]
    slope = Spectrum(**written).rms_slope * dataset["A"].values
    for axes, name, label in ((force, "pull_off_force", FORCE), (energy, "dissipated_energy", ENERGY)):
        for k, colour, dash in zip(dataset["k"].values, shades(3)[::2], DASHES[:2], strict=True):
            values = dataset[name].sel(k=k)
            low, high = (values.quantile(share, "realisation") for share in (0.05, 0.95))
            axes.fill_between(slope, low, high, color=colour, alpha=0.2, lw=0)
            mean = values.mean("realisation")
            axes.plot(slope, mean, color=colour, ls=dash, label=f"$k = {k:g}$")
            many = (dataset["status"].sel(k=k) & doubts_about(name)).astype(bool).mean("realisation").values > 0.5
            axes.plot(slope[many], mean.values[many], ls="none", mec=colour, **OPEN)
        axes.set(xlabel=r"rms slope $\sqrt{\langle (df_2/d\xi)^2\rangle}$", ylabel=label, xlim=(0.0, slope.max()))
        axes.set_ylim(bottom=0.0)
        handles = [*axes.get_legend_handles_labels()[0], BAND]
        handles += [] if name == "pull_off_force" else [key("most not one disc", color=INK, ls="none", **OPEN)]
        axes.legend(handles=handles, loc="upper left")


def best_exponent(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the best exponent over the depth of the gradient, a line for each Poisson's ratio."""
    ratios = dataset["nu"].values
    for value, colour, dash in zip(ratios, shades(ratios.size), DASHES, strict=False):
        line = dataset["best_k"].sel(nu=value)
        axes.plot(line["c0_over_R"], line, color=colour, ls=dash, label=rf"$\nu = {value:g}$")
        ends = line.where(line <= BOUND)
        axes.plot(ends["c0_over_R"], ends, ls="none", mec=colour, clip_on=False, **OPEN)
    axes.plot([], [], color=INK, ls="none", label="at the bound $k = 0$", **OPEN)
    axes.set(xscale="log", xlabel="depth of the gradient $c_0/R$", ylabel="best gradient exponent $k$")
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="lower left")


def best_wavelength(best: Axes, slopes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the best wavelength and its force over the exponent, and the sensitivities of that force."""
    k = dataset["k"]
    best.plot(k, dataset["best_lambda_over_R"], color=INK, label=WAVELENGTH)
    best.set(xlabel=EXPONENT, ylabel="best " + WAVELENGTH, xlim=(0.0, float(k.max())))
    sensitivity = dataset["best_pull_off_force_sensitivity"]
    named = {
        "A": "$A$",
        "modulus": r"$E^{\ast}R/\Delta\gamma$",
        "c0_over_R": "$c_0/R$",
        "lambda_over_R": r"$\lambda/R$",
    }
    for (name, label), colour, dash in zip(named.items(), shades(len(named)), DASHES, strict=False):
        slopes.plot(k, sensitivity.sel(parameter=name), color=colour, ls=dash, label=label)
    slopes.set(xlabel=EXPONENT, ylabel=r"sensitivity $d\,\ln F/d\,\ln p$ of the best force", xlim=(0.0, float(k.max())))
    slopes.set_ylim(top=0.9)
    slopes.legend(loc="upper left", ncols=2)


def error_bars(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the force over the wavelength with the band of the samples, and the linear estimate of the same band."""
    wavelength = dataset["lambda_over_R"]
    handles: list[Any] = []
    for value, colour in zip(dataset["k"].values, shades(3)[::2], strict=True):
        one = dataset.sel(k=value)
        force, deviation = one["pull_off_force"], one["pull_off_force_std"]
        low, high = one["pull_off_force_p05"], one["pull_off_force_p95"]
        axes.fill_between(wavelength, low, high, color=colour, alpha=0.2, lw=0)
        axes.plot(wavelength, force, color=colour)
        for side in (-1.0, 1.0):
            axes.plot(wavelength, force + side * NINE_TENTHS * deviation, color=colour, lw=0.8, ls=DASHES[4])
        handles.append(key(f"$k = {value:g}$", color=colour))
    handles += [BAND, key("linear", color=INK, lw=0.8, ls=DASHES[4])]
    axes.set(xscale="log", xlabel=WAVELENGTH, ylabel=FORCE, xlim=(float(wavelength.min()), float(wavelength.max())))
    axes.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axes.minorticks_off()
    axes.set_ylim(bottom=0.0)
    axes.legend(handles=handles, loc="lower left", ncols=3)


def front(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the best compromises of force and energy, a line for each exponent."""
    exponents = dataset["k"].values
    for value, colour, mark in zip(exponents, shades(exponents.size), "os^D", strict=False):
        one = dataset.sel(k=value)
        looks = {"ls": "none", "marker": mark, "ms": 1.6, "mew": 0.0, "color": colour}  # there is nothing in a gap
        axes.plot(one["best_pull_off_force"], one["best_dissipated_energy"], label=f"$k = {value:g}$", **looks)
    axes.set(xlabel=FORCE, ylabel=ENERGY)
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="upper right", markerscale=2.0)


PICTURES = {
    "extra_best_exponent": best_exponent,
    "extra_best_wavelength": best_wavelength,
    "extra_error_bars": error_bars,
    "extra_front": front,
    "extra_amplitudes": amplitudes,
    "extra_rim": rims,
    "extra_energy_map": contours,
    "extra_energy_amplitude": partial(energies, x="A"),
    "extra_energy_wavelength": partial(energies, x="lambda_over_R"),
    "extra_roughness": roughness,
}
