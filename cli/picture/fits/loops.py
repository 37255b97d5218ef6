"""The picture of the fits of several loops: where the values of each parameter lie."""

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.loop_choice import one_loop
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.fits import LOOP
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.picture.fits.fit import COLOURS, drawn_fit, named
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import CAPTION, heading, in_lines, styled
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT

FEW: Final = 24
"""Loops that are drawn one by one, with their intervals; of more a histogram is."""
LISTED: Final = 12
"""Loops that have room for the names of their files."""
ACROSS: Final = 3
"""Panels beside each other."""
PANEL: Final = 2.6
"""Width of a panel, in inches."""
WIDE: Final = 20.0
"""Greatest over least value from which on an axis is logarithmic."""


def drawn_fits(
    dataset: xarray.Dataset, looks: Looks = PLAIN, choices: Sequence[str] = (), at: Sequence[str] = ()
) -> Figure:
    """
    Draw a fit, or of several loops a panel for each parameter: values with intervals, or a histogram of many.

    Parameters
    ----------
    dataset
        That of a fit, or of fits of several loops.
    looks
        Sizes, style, title and caption; all else is for maps.
    choices
        What else was chosen of axes and variables, by the names of the options.
    at
        Which one of several loops is drawn alone: `loop=FILE` or `loop=NUMBER`.

    Raises
    ------
    DatasetError
        Something was chosen that fits do not have, or there is no such loop.
    """
    if LOOP not in dataset.dims:
        return drawn_fit(dataset, looks, [*(["--at"] if at else []), *choices])
    if at and not choices:
        return drawn_fit(one_loop(dataset, at), looks)
    if choices:
        raise DatasetError(f"{choices[0]}: fits are drawn as a whole, or one with --at {LOOP}=0; leave it out")
    looks.refuse(["xlim", "ylim", "inset", "band"], f"fits are drawn as a whole, or one with --at {LOOP}=0")
    names = list(map(str, dataset[PARAMETER].values))
    values = dataset["value"].values
    sound = np.flatnonzero(~np.isnan(values).any(axis=1))
    across = 2 if len(names) == 4 else min(ACROSS, len(names))
    down = math.ceil(len(names) / across)
    width = looks.width or PANEL * across + 1.0
    few = dataset.sizes[LOOP] <= FEW
    with styled(looks):
        figure = Figure(figsize=(width, looks.height or (2.2 * down + 0.6)), layout="constrained")
        grid = figure.subplots(down, across, squeeze=False, sharey=few)
        for place, (axes, name) in enumerate(zip(grid.flat, names, strict=False)):
            words, unit = named(name, values[sound, place])
            axes.set_xlabel(f"{words} ({unit.symbol})" if unit.symbol else words)
            scaled = {
                column: dataset[column].values[sound, place] / 10.0**unit.power for column in ("value", "low", "high")
            }
            if scaled["value"].min() > 0.0 and scaled["value"].max() > WIDE * scaled["value"].min():
                axes.set_xscale("log")
            (_draw_each if few else _draw_many)(axes, sound, scaled, doubtful(dataset)[sound])
        for axes in list(grid.flat)[len(names) :]:
            axes.set_visible(False)
        if few:
            _name_loops(grid, list(map(str, dataset["file"].values)))
        else:
            for row in grid:
                row[0].set_ylabel("loops")
        lines = [heading(dataset)] if looks.title else []
        lines += [in_lines(_counts(dataset, sound), width)] if looks.caption else []
        if lines:
            figure.suptitle("\n".join(lines), fontsize=CAPTION if len(lines) > 1 else None)
    return figure


def doubtful(dataset: xarray.Dataset) -> NDArray[np.bool_]:
    """Say of each loop whether its fit is not to be trusted."""
    flagged = (dataset["status"].values & (POOR_FIT | ANOTHER_MINIMUM)) != 0
    return np.asarray(flagged | (dataset["on_bound"].values > 0).any(axis=1) | (dataset["converged"].values == 0))


def _draw_each(
    axes: Axes, loops: NDArray[np.intp], scaled: dict[str, NDArray[np.float64]], doubts: NDArray[np.bool_]
) -> None:
    """Draw each value with its interval."""
    for which, colour in ((~doubts, COLOURS[0]), (doubts, COLOURS[1])):
        value, low, high = (scaled[column][which] for column in ("value", "low", "high"))
        ends: Any = np.maximum([value - low, high - value], 0.0)
        axes.errorbar(value, loops[which], xerr=ends, ls="", marker="o", ms=3.0, lw=0.9, color=colour)


def _draw_many(
    axes: Axes, loops: NDArray[np.intp], scaled: dict[str, NDArray[np.float64]], doubts: NDArray[np.bool_]
) -> None:
    """Draw how many values lie where, those in doubt on top."""
    value, bins = scaled["value"], max(8, min(40, round(1.5 * math.sqrt(loops.size))))
    edges: Any = np.histogram_bin_edges(np.log(value) if axes.get_xscale() == "log" else value, bins)
    edges = np.exp(edges) if axes.get_xscale() == "log" else edges
    axes.hist([value[~doubts], value[doubts]], bins=edges, stacked=True, color=list(COLOURS))
    axes.axvline(float(np.median(value)), color="0.2", lw=0.8, ls="--")


def _name_loops(grid: Any, files: list[str]) -> None:
    """Name the loops beside the first panels, the first on top."""
    for row in grid:
        if len(files) <= LISTED:
            row[0].set_yticks(range(len(files)), files, fontsize="x-small")
        else:
            row[0].set_ylabel("loop")
    grid[0][0].set_ylim(len(files) - 0.5, -0.5)


def _counts(dataset: xarray.Dataset, sound: NDArray[np.intp]) -> list[str]:
    """Say how many loops are drawn, and how many are in doubt or have no value."""
    doubts = int(doubtful(dataset)[sound].sum())
    missing = dataset.sizes[LOOP] - sound.size
    how = "bars: 95 % intervals" if dataset.sizes[LOOP] <= FEW else "dashed: median"
    told = [counted(sound.size, "loop"), how]
    told += [f"red: {counted(doubts, 'fit')} in doubt"] if doubts else []
    return [*told, *([f"{counted(missing, 'loop')} without a fit"] if missing else [])]
