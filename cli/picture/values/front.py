"""The Pareto front of two outputs: one against the other, a line for each scene."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, Literal

import numpy as np
import xarray
from matplotlib.figure import Figure

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import BEST, PARETO_POINT, SI
from gradhesion.cli.picture.labels import effective, equation, equations, label, unit_for
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.pictured import CAPTION, heading, in_lines, styled
from gradhesion.cli.picture.scales import limit
from gradhesion.cli.picture.spans import Span
from gradhesion.cli.picture.values.panels import DASHES
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core.problem.inputs import INPUTS

MOST: Final = 10
"""Lines of one picture."""
MARKED: Final = 40
"""Points of a line that are marked one by one; more are a line."""


def draw_fronts(
    dataset: xarray.Dataset, requested: Sequence[str], selection: Selection, x: str | None, y: str | None, looks: Looks
) -> Figure:
    """
    Draw Pareto fronts.

    Parameters
    ----------
    dataset
        Of a study of two goals.
    requested
        Two variables to draw instead, the one along and the one up.
    selection
        Which axes are fixed.
    x, y
        The same by name.
    looks
        What is chosen of how it looks.

    Raises
    ------
    DatasetError
        A variable is not there, an axis is reduced, or there are too many lines.
    """
    if selection.over or selection.between or looks.kind:
        raise DatasetError("Pareto fronts are drawn as they are; choose scenes with --at")
    looks.refuse(["inset", "band"], "Pareto fronts are drawn as they are")
    narrow = selection.narrowed(dataset)
    along, up = _sides(narrow, requested, x, y)
    scenes = [str(axis) for axis in narrow["status"].dims if narrow.sizes[axis] > 1]
    flat = narrow.stack(line=scenes) if scenes else narrow.squeeze().expand_dims("line")
    flat = flat.squeeze([axis for axis in narrow["status"].dims if axis in flat.dims], drop=False)
    if flat.sizes["line"] > MOST:
        raise DatasetError(f"{flat.sizes['line']} scenes are too many lines for one picture; choose some with --at")
    units = {name: unit_for(name, narrow[name].values) for name in (along, up)}
    of_scenes = [equations(name, flat[name].values) for name in scenes]
    with styled(looks):
        figure = Figure(layout="constrained")
        figure.set_size_inches(looks.width or 4.2, looks.height or 3.4)
        axes = figure.subplots()
        for i in range(flat.sizes["line"]):
            one = flat.isel(line=i)
            first, second = (one[name].values / 10.0 ** units[name].power for name in (along, up))
            there = np.isfinite(first) & np.isfinite(second)
            named = ", ".join(words[i] for words in of_scenes)
            axes.plot(
                first[there],
                second[there],
                ls=DASHES[i % len(DASHES)],
                color=looks.colours(0.85 * i / max(1, flat.sizes["line"] - 1)),
                marker="." if there.sum() <= MARKED else "",
                ms=4,
                lw=1.1,
                label=named,
            )
        sides: tuple[tuple[Literal["x", "y"], Span, str], ...] = (("x", looks.xlim, along), ("y", looks.ylim, up))
        for which, span, name in sides:
            ends = axes.get_xlim() if which == "x" else axes.get_ylim()
            limit(axes, which, replace(span, power=units[name].power).within(name, *ends))
        axes.set_xlabel(label(along, units[along]).removeprefix("best "))
        axes.set_ylabel(label(up, units[up]).removeprefix("best "))
        axes.grid(color="0.9", lw=0.5)
        if scenes:
            axes.legend(fontsize="small")
        fixed = [equation(name, float(narrow[name])) for name in effective(narrow) if narrow[name].size == 1]
        fixed += slope_warnings(narrow)
        words = [heading(dataset)] if looks.title else []
        words += [in_lines(fixed, looks.width or 4.2)] if looks.caption and fixed else []
        if words:
            figure.suptitle("\n".join(words), fontsize=CAPTION if len(words) > 1 else None, wrap=True)
    return figure


def _sides(dataset: xarray.Dataset, requested: Sequence[str], x: str | None, y: str | None) -> tuple[str, str]:
    """Choose the two variables: the goals, in SI units if they have them."""
    known = [str(name) for name in dataset.data_vars if PARETO_POINT in dataset[name].dims]
    for name in (*requested, *(one for one in (x, y) if one is not None)):
        if name not in known:
            raise DatasetError(f"--variable {name}: not a variable of the Pareto front; {did_you_mean(name, known)}")
    goals = [name for name in known if not name.endswith(SI) and name.removeprefix(BEST) not in INPUTS]
    goals = [name + SI if name + SI in known else name for name in goals[:2]]
    first, second = [*requested, *goals[len(requested) :]][:2]
    return x or first, y or second
