"""The Pareto front of two outputs: one against the other, points of each scene."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray
from matplotlib.figure import Figure

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import BEST, PARETO_POINT, SI
from gradhesion.cli.picture.labels import effective, equation, equations
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.panels import MARKS
from gradhesion.cli.picture.pictured import finish, styled
from gradhesion.cli.picture.scales import suit
from gradhesion.cli.picture.tracks import MARKERS
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core.problem.inputs import INPUTS

MOST: Final = 10
"""Lines of one picture."""


def draw_fronts(
    dataset: xarray.Dataset, requested: Sequence[str], selection: Selection, x: str | None, y: str | None, looks: Looks
) -> Figure:
    """Draw the Pareto fronts of two goals, or of two variables asked for: the one along, the other up."""
    if selection.over or selection.between or looks.kind:
        raise DatasetError("Pareto fronts are drawn as they are; choose scenes with --at")
    looks.refuse(["inset", "band"], "Pareto fronts are drawn as they are")
    narrow = selection.narrowed(dataset)
    along, up = _sides(narrow, requested, x, y)
    scenes = [str(axis) for axis in narrow["status"].dims if narrow.sizes[axis] > 1]
    narrow = narrow.squeeze([axis for axis in narrow["status"].dims if axis not in scenes])
    flat = narrow.stack(line=scenes) if scenes else narrow.expand_dims("line")
    lines = flat.sizes["line"]
    if lines > MOST:
        raise DatasetError(f"{lines} scenes are too many lines for one picture; choose some with --at")
    words = [equations(name, flat[name].values) for name in scenes]
    with styled(looks):
        figure = Figure(layout="constrained")
        axes = figure.subplots()
        for i in range(lines):
            first, second = (flat[name].isel(line=i).values for name in (along, up))
            there = np.isfinite(first) & np.isfinite(second)
            axes.plot(
                first[there],
                second[there],
                ls="",  # there is nothing in a gap
                color=looks.colours(0.85 * i / max(1, lines - 1)),
                marker=MARKERS[i % len(MARKERS)],
                ms=3.5 if there.sum() <= MARKS else 2.0,
                mew=0.0,
                label=", ".join(own[i] for own in words),
            )
        suit(axes, "x", along, looks.xlim)
        suit(axes, "y", up, looks.ylim)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_label_text(axis.get_label_text().removeprefix("best "))
        axes.grid(color="0.9", lw=0.5)
        if scenes:
            axes.legend(markerscale=1.5)
        caption = [equation(name, float(narrow[name])) for name in effective(narrow) if narrow[name].size == 1]
        caption += slope_warnings(narrow)
        finish(figure, looks, dataset=dataset, caption=caption, entries=[], size=(4.2, 3.0), panels=[axes])
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
