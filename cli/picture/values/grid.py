"""One variable of a grid of scenes: a map, lines, or panels of them over further axes."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.contour import QuadContourSet
from matplotlib.figure import SubFigure
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.model_range import beyond_by
from gradhesion.cli.dataset.read.reader import is_turned
from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.dataset.read.sensitivities import parameters_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import SOLVER
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.doubts import BEYOND, BOUND, END, Doubt, at_bound, doubts_in, entries
from gradhesion.cli.picture.labels import Unit, equations, label, unit_for
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.scales import scale
from gradhesion.cli.picture.values import panels
from gradhesion.cli.picture.values.bands import Band, band_entry, band_of
from gradhesion.cli.picture.values.grid_words import axis_of_place, caption_of, named_in
from gradhesion.cli.picture.values.layout import PANELS, Plan, items_of
from gradhesion.cli.picture.values.levels import Levels, levels_of, levels_of_flags, levels_of_names, limited
from gradhesion.cli.picture.values.part import Part

APART: Final = 0.17
"""The least distance of numbers at a colour bar, in inches."""


def shape_of(sizes: Mapping[str, int], plan: Plan) -> tuple[int, int]:
    """Report the rows and columns of panels."""
    rows, columns = (min(PANELS, sizes[axis]) if axis else 1 for axis in (plan.rows, plan.columns))
    return rows, columns


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

    def kept_of(one: xarray.DataArray) -> xarray.DataArray:
        return one.squeeze([axis for axis in one.dims if axis not in kept])

    cut, status = kept_of(taken.values), kept_of(taken.status)
    cut = cut.where(np.isfinite(cut))
    status = status.where(np.isfinite(cut), 0)
    finite = cut.values[np.isfinite(cut.values)]
    if not finite.size and taken.flat:
        (axis, how), *_ = ((one, how) for one, how in selection.over.items() if how.startswith("arg"))
        raise DatasetError(
            f"{name}: its values along {axis} are equal, so that no place is that of {how}; draw them instead"
        )
    if not finite.size:
        raise DatasetError(f"{name}: no value in any scene drawn; `gradhesion info` reports why")
    doubts = doubts_in(status.values, name, turned=is_turned(dataset))
    marks = [(doubt, (status & doubt.bit) != 0) for doubt in doubts]
    marks += _beyond(dataset.isel(items), cut, name)
    met = at_bound(dataset.isel(items), name)
    marks += [] if met is None else _marked(BOUND, met, cut)
    if taken.at_end is not None and bool(taken.at_end.any()):
        marks.append((END, kept_of(taken.at_end)))
    kind = axis_of_place(selection) or name
    rows, columns = shape_of(sizes, plan)
    grid = part.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    whole = dataset[name].dtype.kind == "i" and bool((finite == np.round(finite)).all())
    if whole and name == "status":
        codes = np.unique(finite)
        cut = cut.copy(data=np.searchsorted(codes, cut)).where(cut.notnull())
        levels = levels_of_flags(codes, looks)
    elif labels := parameters_of(dataset[name]):
        codes = np.unique(finite)
        cut = cut.copy(data=np.searchsorted(codes, cut)).where(cut.notnull())
        levels = levels_of_names([SYMBOLS[labels[int(code)]] for code in codes], looks)
    else:
        levels = levels_of(float(finite.min()), float(finite.max()), whole=whole, looks=looks)
    band = None if plan.is_map or levels.names else band_of(dataset.isel(items), name, selection, looks)
    if band:
        band = Band(low=kept_of(band.low), high=kept_of(band.high), how=band.how)
    if not plan.is_map:
        levels = limited(levels, np.append(finite, band.extremes()) if band else finite, kind)
    log = isinstance(levels.norm, LogNorm) if plan.is_map else levels.log
    unit = unit_for(kind, levels.extremes if not levels.names else finite, log=log)
    titles = {axis: equations(axis, cut[axis].values) for axis in (plan.columns, plan.rows) if axis}
    contours = []
    for i, line in enumerate(grid):
        for j, axes in enumerate(line):
            place = {axis: item for axis, item in ((plan.columns, j), (plan.rows, i)) if axis}
            marked = [(doubt, flags.isel(place)) for doubt, flags in marks]
            own = band and Band(low=band.low.isel(place), high=band.high.isel(place), how=band.how)
            again = partial(
                _draw_panel, panel=cut.isel(place), marks=marked, plan=plan, levels=levels, unit=unit, band=own
            )
            lines = again(axes)
            contours += [(lines, unit)] if lines else []
            if plan.columns and i == 0:
                axes.set_title(titles[plan.columns][j])
            if plan.rows and j == columns - 1:
                axes.annotate(titles[plan.rows][i], (1.03, 0.5), xycoords="axes fraction", rotation=-90, va="center")
            axes.label_outer()
    width, height = (2.1, 1.8) if columns > 1 else (3.6, 2.9)
    named = named_in(name, selection, unit)
    scale_of = (looks.height / (height * rows + 0.6)) if looks.height else 1.0
    up = scale(cut[plan.second].values, plan.second, looks.ylim).unit if plan.is_map and plan.second else unit
    along = scale(cut[plan.x].values, plan.x, looks.xlim).unit
    _dress(part, grid, plan, named, (along, up, unit), levels, height * rows * min(1.0, scale_of))
    width = width * columns + (2.2 if levels.names else 1.2)
    caption = caption_of(dataset, plan, items, selection, taken)
    more = 0.0 if plan.is_map or not plan.second else 0.3
    shown = entries([doubt for doubt, _ in marks], in_map=plan.is_map, gaps=finite.size < cut.size - taken.flat)
    shown += [band_entry(band, cut.sizes[plan.x])] if band else []
    named_lines = [] if plan.is_map or not plan.second else grid[0, 0].get_legend_handles_labels()[0]
    return Part(
        width=width,
        height=height * rows + 0.6 + more,
        entries=shown,
        lines=named_lines,
        contours=contours,
        caption=caption,
        again=again if rows * columns == 1 and not plan.is_map and not levels.names else None,
        units=(plan.x, along, unit),
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
        marks += _marked(doubt, beyond, cut)
    return marks


def _marked(doubt: Doubt, flags: xarray.DataArray, cut: xarray.DataArray) -> list[tuple[Doubt, xarray.DataArray]]:
    """Mark the scenes of what is drawn that have a flag, if there are some."""
    flags = flags.any([axis for axis in flags.dims if axis not in cut.dims])
    there = flags & cut.notnull()
    return [(doubt, there.transpose(*cut.dims))] if bool(there.any()) else []


def _draw_panel(
    axes: Axes,
    panel: xarray.DataArray,
    marks: Sequence[tuple[Doubt, xarray.DataArray]],
    plan: Plan,
    levels: Levels,
    unit: Unit,
    band: Band | None = None,
) -> QuadContourSet | None:
    """Draw one panel of a variable; what has no value has no mark. The contours of a map are returned."""
    marks = [(doubt, flags & panel.notnull()) for doubt, flags in marks]
    looks = levels.looks
    x = scale(panel[plan.x].values, plan.x, looks.xlim)
    edges = [band.low, band.high] if band else []
    if plan.second is None:
        doubtful = [(doubt, {"": flags.values[x.order]}) for doubt, flags in marks]
        low_high = {"": _pair([edge.values[x.order] for edge in edges])} if band else None
        panels.draw_lines(axes, x, {"": panel.values[x.order].astype(float)}, levels, unit, doubtful, low_high)
        return None
    items = panel[plan.second].values
    values = panel.transpose(plan.second, plan.x).values.astype(float)[:, x.order]
    turned = [(doubt, flags.transpose(plan.second, plan.x).values[:, x.order]) for doubt, flags in marks]
    if plan.is_map:
        second = scale(items, plan.second, looks.ylim)
        marked = [(doubt, flags[second.order]) for doubt, flags in turned]
        return panels.draw_map(axes, x, second, values[second.order], levels, marked)
    order = range(items.size) if plan.second == SOLVER else np.argsort(items)
    labels = dict(zip(equations(plan.second, [items[i] for i in order]), order, strict=True))
    rows = [edge.transpose(plan.second, plan.x).values[:, x.order] for edge in edges]
    bands = {label: _pair([row[i] for row in rows]) for label, i in labels.items()} if band else None
    doubtful = [(doubt, {label: flags[i] for label, i in labels.items()}) for doubt, flags in turned]
    panels.draw_lines(axes, x, {label: values[i] for label, i in labels.items()}, levels, unit, doubtful, bands)
    return None


def _pair(edges: Sequence[NDArray[np.float64]]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Take the two edges of a band."""
    low, high = edges
    return low, high


def _dress(
    part: SubFigure,
    grid: NDArray[Any],
    plan: Plan,
    named: str,
    units: tuple[Unit, Unit, Unit],
    levels: Levels,
    height: float,
) -> None:
    """Put labels, and the colour bar or the legend, around the panels of a variable; units of x, y and values."""
    along, up, unit = units
    for axes in grid[-1]:
        axes.set_xlabel(label(plan.x, along))
    named_up = label(plan.second, up) if plan.is_map and plan.second else "" if levels.names else named
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
        bar.ax.set_yticks(some, unit.numbers(some))
