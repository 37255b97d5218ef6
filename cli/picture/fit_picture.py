"""The picture of a fit: the measured points with the fitted path, and what is left of them."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.figure import Figure

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names import PARAMETER, PARAMETER_UNITS
from gradhesion.cli.picture.labels import Unit, unit_for
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import CAPTION, heading, in_lines, styled

COLOURS: Final = ("C0", "C3")
"""Of loading and of unloading."""
WIDTH: Final = 4.8
"""Of the picture, in inches."""
_LABELS: Final = {"indentation": "depth", "load": "load"}


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
    name = "path_indentation_si" if quantity == "indentation" else "path_load_si"
    return unit_for(name, [float(np.max(np.abs(values)))])


def _axis(quantity: str, unit: Unit) -> str:
    return f"{_LABELS[quantity]} ({unit.symbol})"


def _found(dataset: xarray.Dataset) -> list[str]:
    """Write the values with their standard deviations."""
    found = []
    for i, name in enumerate(map(str, dataset[PARAMETER].values)):
        unit = str(dataset[PARAMETER_UNITS].values[i])
        value, deviation = (float(dataset[column].values[i]) for column in ("value", "standard_deviation"))
        written = name.replace("_", r"\_")
        found.append(rf"$\mathrm{{{written}}}$ = {value:.4g} $\pm$ {deviation:.2g}{'' if unit == '1' else ' ' + unit}")
    return found
