"""One variable of a grid of scenes: a map, lines, or panels of them over further axes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.contour import QuadContourSet
from matplotlib.figure import SubFigure
from numpy.typing import NDArray

from gradhesion.cli.dataset.model_range import beyond_by, slope_warnings
from gradhesion.cli.dataset.reader import is_turned
from gradhesion.cli.dataset.reductions import Taken
from gradhesion.cli.dataset.selection import Selection
from gradhesion.cli.dataset.sensitivities import parameters_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names import SOLVER, SYMBOLS
from gradhesion.cli.picture import panels
from gradhesion.cli.picture.doubts import BEYOND, END, Doubt, doubts_in, entries
from gradhesion.cli.picture.labels import Unit, effective, equation, label, unit_for
from gradhesion.cli.picture.layout import PANELS, Plan, items_of
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import LETTER, letters_of
from gradhesion.cli.picture.scales import scale

APART: Final = 0.17
"""The least distance of numbers at a colour bar, in inches."""

LINE: Final = 0.55
"""The width of a line in a legend with the space around it, in inches."""


def shape_of(sizes: Mapping[str, int], plan: Plan) -> tuple[int, int]:
    """Report the rows and columns of panels."""
    rows, columns = (min(PANELS, sizes[axis]) if axis else 1 for axis in (plan.rows, plan.columns))
    return rows, columns


@dataclass(frozen=True, kw_only=True, eq=False)
class Part:
    """What is drawn of a variable, as the figure around it needs it."""

    width: float
    height: float
    """The size that suits it, in inches."""
    entries: Sequence[Artist]
    """The marks of doubtful scenes that a legend explains."""
    lines: Sequence[Artist] = ()
    """The lines that a legend names, if there are several."""
    contours: Sequence[tuple[QuadContourSet, Unit]] = ()
    """Contours that want numbers."""
    caption: Sequence[str] = ()
    """What is said above it."""


def draw_grid(
    part: SubFigure,
    dataset: xarray.Dataset,
    name: str,
    plan: Plan,
    selection: Selection,
    looks: Looks = PLAIN,
) -> Part:
    """Draw one variable of a narrowed dataset."""
    sizes = {str(axis): size for axis, size in dataset["status"].sizes.items()}
    items = items_of(sizes, plan)
    taken = selection.taken(*(dataset[one].isel(items) for one in (name, "status")))
    kept = [axis for axis in (plan.x, plan.second, plan.columns, plan.rows) if axis]
    cut, status = (one.squeeze([axis for axis in one.dims if axis not in kept]) for one in (taken.values, taken.status))
    cut = cut.where(np.isfinite(cut))
    status = status.where(np.isfinite(cut), 0)
    finite = cut.values[np.isfinite(cut.values)]
    if not finite.size:
        raise DatasetError(f"{name}: no value in any scene drawn; `gradhesion info` reports why")
    doubts = doubts_in(status.values, name, turned=is_turned(dataset))
    marks = [(doubt, (status & doubt.bit) != 0) for doubt in doubts]
    marks += _beyond(dataset.isel(items), cut, name)
    if taken.at_end is not None and bool(taken.at_end.any()):
        marks.append((END, taken.at_end.squeeze([axis for axis in taken.at_end.dims if axis not in kept])))
    kind = _axis_of_place(selection) or name
    unit = unit_for(kind, finite)
    rows, columns = shape_of(sizes, plan)
    grid = part.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    whole = dataset[name].dtype.kind == "i" and bool((finite == np.round(finite)).all())
    if whole and name == "status":
        codes = np.unique(finite)
        cut = cut.copy(data=np.searchsorted(codes, cut)).where(cut.notnull())
        levels = panels.levels_of_flags(codes, looks)
    elif labels := parameters_of(dataset[name]):
        codes = np.unique(finite)
        cut = cut.copy(data=np.searchsorted(codes, cut)).where(cut.notnull())
        levels = panels.levels_of_names([SYMBOLS[labels[int(code)]] for code in codes], looks)
    else:
        levels = panels.levels_of(float(finite.min()), float(finite.max()), whole=whole, looks=looks)
    contours = []
    for i, line in enumerate(grid):
        for j, axes in enumerate(line):
            place = {axis: item for axis, item in ((plan.columns, j), (plan.rows, i)) if axis}
            marked = [(doubt, flags.isel(place)) for doubt, flags in marks]
            lines = _draw_panel(axes, cut.isel(place), marked, plan, levels, unit)
            contours += [(lines, unit)] if lines else []
            if plan.columns and i == 0:
                axes.set_title(equation(plan.columns, cut[plan.columns].values[j]))
            if plan.rows and j == columns - 1:
                written = equation(plan.rows, cut[plan.rows].values[i])
                axes.annotate(written, (1.03, 0.5), xycoords="axes fraction", rotation=-90, va="center")
            axes.label_outer()
    width, height = (2.1, 1.8) if columns > 1 else (3.6, 2.9)
    named = _named(name, selection, unit)
    scale_of = (looks.height / (height * rows + 0.6)) if looks.height else 1.0
    _dress(part, grid, plan, cut, named, unit, levels, height * rows * min(1.0, scale_of))
    width = width * columns + (2.2 if levels.names else 1.2)
    caption = _caption(dataset, plan, items, selection, taken)
    more = 0.0 if plan.is_map or not plan.second else 0.3
    shown = entries([doubt for doubt, _ in marks], in_map=plan.is_map, gaps=finite.size < cut.size - taken.flat)
    named_lines = [] if plan.is_map or not plan.second else grid[0, 0].get_legend_handles_labels()[0]
    return Part(
        width=width,
        height=height * rows + 0.6 + more,
        entries=shown,
        lines=named_lines,
        contours=contours,
        caption=caption,
    )


def _beyond(dataset: xarray.Dataset, cut: xarray.DataArray, name: str) -> list[tuple[Doubt, xarray.DataArray]]:
    """Mark the scenes of what is drawn that leave the range of the model, by each number that says so.

    A validity number itself shows its own limit alone; what is taken over an axis is marked if any scene on it is.
    """
    marks = []
    for number, doubt in BEYOND.items():
        beyond = None if name in BEYOND and number != name else beyond_by(number, dataset)
        if beyond is None:
            continue
        beyond = beyond.any([axis for axis in beyond.dims if axis not in cut.dims])
        if bool((beyond & cut.notnull()).any()):
            marks.append((doubt, (beyond & cut.notnull()).transpose(*cut.dims)))
    return marks


def _draw_panel(
    axes: Axes,
    panel: xarray.DataArray,
    marks: Sequence[tuple[Doubt, xarray.DataArray]],
    plan: Plan,
    levels: panels.Levels,
    unit: Unit,
) -> QuadContourSet | None:
    """Draw one panel of a variable; what has no value has no mark. The contours of a map are returned."""
    marks = [(doubt, flags & panel.notnull()) for doubt, flags in marks]
    x = scale(panel[plan.x].values, plan.x)
    if plan.second is None:
        doubtful = [(doubt, {"": flags.values[x.order]}) for doubt, flags in marks]
        panels.draw_lines(axes, x, {"": panel.values[x.order].astype(float)}, levels, unit, doubtful)
        return None
    items = panel[plan.second].values
    values = panel.transpose(plan.second, plan.x).values.astype(float)[:, x.order]
    turned = [(doubt, flags.transpose(plan.second, plan.x).values[:, x.order]) for doubt, flags in marks]
    if plan.is_map:
        second = scale(items, plan.second)
        marked = [(doubt, flags[second.order]) for doubt, flags in turned]
        return panels.draw_map(axes, x, second, values[second.order], levels, marked)
    order = range(items.size) if plan.second == SOLVER else np.argsort(items)
    labels = {equation(plan.second, items[i]): i for i in order}
    doubtful = [(doubt, {label: flags[i] for label, i in labels.items()}) for doubt, flags in turned]
    panels.draw_lines(axes, x, {label: values[i] for label, i in labels.items()}, levels, unit, doubtful)
    return None


def _dress(
    part: SubFigure,
    grid: NDArray[Any],
    plan: Plan,
    cut: xarray.DataArray,
    named: str,
    unit: Unit,
    levels: panels.Levels,
    height: float,
) -> None:
    """Put labels, and the colour bar or the legend, around the panels of a variable."""
    for axes in grid[-1]:
        axes.set_xlabel(label(plan.x, unit_for(plan.x, cut[plan.x].values)))
    if plan.is_map and plan.second:
        named_up = label(plan.second, unit_for(plan.second, cut[plan.second].values))
    else:
        named_up = "" if levels.names else named
    if grid.shape[0] > 1 and not plan.is_map:  # a label of its own would be longer than a row is high
        part.supylabel(named_up, fontsize="medium")
    else:
        for axes in grid[:, 0]:
            axes.set_ylabel(named_up)
    if plan.is_map:
        filled = ScalarMappable(norm=levels.norm, cmap=levels.looks.colours)
        bar = part.colorbar(
            filled, ax=grid, label="" if levels.names else named, boundaries=levels.levels, fraction=0.06, aspect=30
        )
        bar.ax.minorticks_off()
        if levels.names:
            bar.ax.set_title(named, loc="left")
            bar.ax.set_yticks(range(len(levels.names)), levels.names, fontsize="small")
            return
        some = levels.ticks(int(height / APART))
        bar.ax.set_yticks(some, [unit.number(level) for level in some])


def add_legends(
    body: SubFigure, parts: Sequence[SubFigure], lines: Sequence[Sequence[Artist]], width: float, beside: int
) -> None:
    """Put one legend below all variables, `beside` of them in a width, if their lines mean the same, else one each."""
    meant = {tuple(str(line.get_label()) for line in own) for own in lines}
    shared = len(lines) > 1 and len(meant) == 1
    for part, own in [(body, lines[0])] if shared else zip(parts, lines, strict=False):
        if own:
            longest = max(letters_of(str(line.get_label())) for line in own)
            room = (width if shared else width / beside) / (LINE + LETTER * longest)
            part.legend(handles=own, loc="outside lower center", ncols=int(min(len(own), max(1.0, room))))


def _axis_of_place(selection: Selection) -> str | None:
    """Report the axis whose value is drawn, where the place of an extreme is asked for."""
    return next((axis for axis, how in selection.over.items() if how.startswith("arg")), None)


def _named(name: str, selection: Selection, unit: Unit) -> str:
    """Name what is drawn of a variable."""
    axis = _axis_of_place(selection)
    if axis is None:
        return label(name, unit)
    extreme = "maximum" if selection.over[axis] == "argmax" else "minimum"
    return f"{label(axis, unit)} at {extreme} {SYMBOLS[name].split(' $')[0]}"


def _caption(
    dataset: xarray.Dataset, plan: Plan, items: Mapping[str, Any], selection: Selection, taken: Taken
) -> list[str]:
    """Write the parameters that are not drawn, and what stands for the axes that are fixed or reduced."""
    written = []
    between = {one.axis: one.value for one in selection.between}
    follows = {plan.x, plan.second, plan.columns, plan.rows, *selection.over}
    for name in (SOLVER, *effective(dataset)):
        values = np.atleast_1d(dataset[name].values) if name in dataset.coords else np.empty(0)
        if name in between:
            written.append(f"{equation(name, between[name])} (interpolated)")
        elif name in plan.middle:
            written.append(f"{equation(name, values[values.size // 2])} (one of {values.size})")
        elif values.size == 1 and name not in follows:
            written.append(equation(name, values.item()))
    written += [f"{how} over {SYMBOLS[axis]}" for axis, how in selection.over.items()]
    if taken.left_out:
        written.append(f"{taken.left_out:,} failed {'scene' if taken.left_out == 1 else 'scenes'} left out")
    if taken.flat:
        written.append(f"{taken.flat:,} left out where all values are equal")
    for axis in (plan.x, plan.second):
        if axis and axis in items and axis not in (plan.columns, plan.rows):
            written.append(f"{len(items[axis]):,} of {dataset.sizes[axis]:,} values of {SYMBOLS[axis]}")
    return [*written, *slope_warnings(dataset)]
