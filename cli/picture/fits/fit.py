"""The picture of a fit: the measured points with the fitted path, and what is left of them."""

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.figure import Figure

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.labels import Unit, number, unit_for
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import CAPTION, heading, in_lines, styled

COLOURS: Final = ("C0", "C3")
"""Of loading and of unloading."""
WIDTH: Final = 4.8
"""Of the picture, in inches."""
_LABELS: Final = {"indentation": "depth", "load": "load"}
PATHS: Final = {"indentation": "path_indentation_si", "load": "path_load_si"}
"""The curves that have the units of depth and load."""
OFFSET: Final = "_offset"
"""The end of the name of a zero that is fitted."""
SLOPE: Final = "load_slope"
"""A tilt of the base line that is fitted, in the unit of a spring."""
LONGEST: Final = 8
"""Decimals of a value that has no power of ten."""


def drawn_fit(dataset: xarray.Dataset, looks: Looks = PLAIN, choices: Sequence[str] = ()) -> Figure:
    """
    Draw a fit: load over depth with the path through the points, and below it the residuals over depth.

    Parameters
    ----------
    dataset
        That of a fit.
    looks
        Sizes, style, title and caption; all else is for maps.
    choices
        What was chosen of axes and variables, by the names of the options.

    Raises
    ------
    DatasetError
        Something was chosen: a fit is drawn as a whole.
    """
    if choices:
        raise DatasetError(f"{choices[0]}: a fit is drawn as a whole; leave it out")
    looks.refuse(["xlim", "ylim", "inset", "band"], "a fit is drawn as a whole")
    units = {name: _unit(dataset, name) for name in _LABELS}
    depth, load = (dataset[f"measured_{name}"].values / 10.0 ** units[name].power for name in _LABELS)
    along, up = (dataset[f"fitted_{name}"].values / 10.0 ** units[name].power for name in _LABELS)
    back, ways = dataset["measured_unloading"].values > 0, dataset["fitted_unloading"].values > 0
    margin = 0.08 * float(np.ptp(depth))
    width = looks.width or WIDTH
    with styled(looks):
        figure = Figure(figsize=(width, looks.height or 1.05 * width), layout="constrained")
        top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
        dots: dict[str, Any] = {"ls": "", "marker": ".", "ms": 2.5, "alpha": 0.5, "mew": 0.0, "rasterized": True}
        turn = int(np.count_nonzero(~ways))
        for way, words in enumerate(("loading", "unloading")):
            own = back == bool(way)
            if own.any():
                top.plot(depth[own], load[own], color=COLOURS[way], **dots)
                bottom.plot(depth[own], dataset["residual"].values[own], color=COLOURS[way], **dots)
            part = slice(0, turn) if way == 0 else slice(turn - 1, None)
            top.plot(along[part], up[part], color=COLOURS[way], lw=0.9, label=f"fit, {words}")
        top.plot([], [], **(dots | {"color": "0.4", "alpha": 1.0}), label="measured")
        top.legend(fontsize="small")
        top.set_xlim(float(depth.min()) - margin, float(depth.max()) + margin)
        top.set_ylabel(_axis("load", units["load"]))
        bottom.axhline(0.0, color="0.3", lw=0.6)
        bottom.set_ylabel("residual (sd)")
        bottom.set_xlabel(_axis("indentation", units["indentation"]))
        words_above = [heading(dataset)] if looks.title else []
        words_above += [in_lines(_found(dataset), width)] if looks.caption else []
        if words_above:
            figure.suptitle("\n".join(words_above), fontsize=CAPTION if len(words_above) > 1 else None)
    return figure


def _unit(dataset: xarray.Dataset, quantity: str) -> Unit:
    """Choose the unit of an axis."""
    values = dataset[f"measured_{quantity}"].values
    return unit_for(PATHS[quantity], [float(np.max(np.abs(values)))])


def _axis(quantity: str, unit: Unit) -> str:
    return f"{_LABELS[quantity]} ({unit.symbol})"


def _found(dataset: xarray.Dataset) -> list[str]:
    """Write the values with their standard deviations, in units that suit them."""
    return [
        in_words(str(name), *(float(dataset[column].values[i]) for column in ("value", "standard_deviation")))
        for i, name in enumerate(dataset[PARAMETER].values)
    ] + [rf"reduced $\chi^2$ = {float(dataset['chi_square']) / int(dataset['degrees_of_freedom']):.3g}"]


def named(name: str, values: Any) -> tuple[str, Unit]:
    """
    Name what is fitted, with a unit that suits its values.

    >>> named("load_slope", [2e-3]), named("exponent", [0.5])
    (('tilt of the load', Unit(symbol='mN/m', power=-3)), ('exponent', Unit(symbol='', power=0)))
    """
    quantity = name.removesuffix(OFFSET)
    if quantity != name:
        return f"offset of the {_LABELS[quantity]}", unit_for(PATHS[quantity], values)
    if name == SLOPE:
        return "tilt of the load", unit_for("spring_constant", values)
    return SYMBOLS.get(name, name), unit_for(name, values)


def in_words(name: str, value: float, deviation: float) -> str:
    r"""
    Write a fitted value to the digits of its standard deviation.

    >>> in_words("wavelength", 4.99918e-7, 9.3e-11), in_words("A", 0.0120055, 2.04e-5)
    ('$\\lambda$ = 499.918 ± 0.093 nm', '$A$ = 0.012006 ± 0.000020')
    >>> in_words("load_offset", 8.894e-9, 1.2e-9), in_words("work_of_adhesion", 0.03, 0.0)
    ('offset of the load = 8.9 ± 1.2 nN', '$\\Delta\\gamma$ = 30 ± 0 mJ/m$^2$')
    """
    words, unit = named(name, value)
    value, deviation = value / 10.0**unit.power, deviation / 10.0**unit.power
    decimals = 1 - math.floor(math.log10(deviation)) if 1e-9 * abs(value) < deviation < math.inf else None
    if decimals is None or decimals > LONGEST:
        written = f"{number(value)} ± {number(deviation)}"
    else:
        written = f"{value:.{max(0, decimals)}f} ± {deviation:.{max(0, decimals)}f}"
    return f"{words} = {written} {unit.symbol}".strip().replace("-", "\N{MINUS SIGN}")
