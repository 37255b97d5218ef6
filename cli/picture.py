"""The picture of a dataset: which axes go where, and the figure around the panels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure, SubFigure
from numpy.typing import NDArray

from gradhesion.cli import panels
from gradhesion.cli.doubts import ORDER, Doubt, doubts_in, entries
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names import KEYS, SCENE, SOLVER
from gradhesion.cli.scales import equation, label, number, scale
from gradhesion.cli.schema import did_you_mean

STYLE: Final[dict[Any, Any]] = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.linewidth": 0.6,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "hatch.linewidth": 0.4,
    "svg.hashsalt": "gradhesion",  # the same picture for the same dataset
    "savefig.dpi": 200,
}

PANELS: Final = 3
"""Panels along a row or a column: the ends of an axis and its middle."""

LINE: Final = 0.16
"""The height of an entry of the legend below the panels, in inches."""

LINES: Final = 5
"""An axis of no more values than this is a set of lines rather than a side of a map."""


def drawn(dataset: xarray.Dataset, asked: Sequence[str]) -> Figure:
    """
    Draw variables of a dataset side by side; without any asked for, the force and the energy.

    Raises
    ------
    DatasetError
        A variable is not there or has no value, or nothing varies that it could be drawn over.
    """
    known = [str(name) for name in dataset.data_vars]
    for name in asked:
        if name not in known:
            raise DatasetError(f"--variable {name}: not in this dataset; {did_you_mean(name, known)}")
    chosen = list(asked) or [name for name in ("pull_off_force", "dissipated_energy") if name in known] or known[:1]
    with mpl.rc_context(STYLE):
        figure = Figure(layout="constrained")
        parts = figure.subfigures(1, len(chosen), squeeze=False)[0]
        width = height = 0.0
        told: dict[str, Any] = {}
        for part, name in zip(parts, chosen, strict=True):
            width, height, more = _draw_variable(part, dataset, name)
            told |= {str(entry.get_label()): entry for entry in more}
        figure.set_size_inches(width * len(chosen), height + 0.5 + LINE * len(told))
        if told:
            handles = [told[words] for words in ORDER if words in told]
            figure.legend(handles=handles, loc="outside lower center", fontsize=7, frameon=False)
        figure.suptitle(dataset.attrs["title"], fontsize=10, wrap=True)
    return figure


def save(figure: Figure, file: Path, form: str) -> None:
    """Save a picture as "png", "svg" or "pdf"; the same picture gives the same file."""
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with mpl.rc_context(STYLE):
        figure.savefig(file, format=form, metadata=undated.get(form))


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Which axis of a dataset goes where in its picture."""

    x: str
    second: str | None
    """The other side of a map, or what tells the lines of a panel apart."""
    is_map: bool
    columns: str | None
    rows: str | None
    middle: tuple[str, ...]
    """Axes with no place of their own: they stay at their middle value."""


def plan_of(sizes: Mapping[str, int]) -> Plan | None:
    """
    Give the finest axes to the panels, the next two to columns and rows; None if nothing varies.

    Solvers are the lines of a panel if nothing else is, and columns otherwise.

    >>> plan_of({"k": 6, "A": 1, "lambda_over_R": 200})
    Plan(x='lambda_over_R', second='k', is_map=True, columns=None, rows=None, middle=())
    """
    varying = sorted((name for name, size in sizes.items() if size > 1), key=lambda name: -sizes[name])
    free = [name for name in varying if name != SOLVER]
    if not free:
        return None
    if SOLVER in varying:
        free.insert(2, SOLVER)
    places: list[str | None] = [*free, None, None, None]
    x, second, columns, rows = free[0], *places[1:4]
    is_map = second not in (None, SOLVER) and sizes[second] > LINES
    return Plan(x=x, second=second, is_map=is_map, columns=columns, rows=rows, middle=tuple(free[4:]))


def _draw_variable(part: SubFigure, dataset: xarray.Dataset, name: str) -> tuple[float, float, list[Any]]:
    """Draw one variable; tell the width and height it wants, in inches, and what the legend shall tell of it."""
    variable = dataset[name]
    if SCENE in dataset.dims:
        return _draw_scenes(part, variable, dataset["status"])
    plan = plan_of({str(axis): size for axis, size in variable.sizes.items()})
    if plan is None:
        raise DatasetError(
            f"{name}: nothing varies, so there is nothing to draw it over; `gradhesion info` tells its value"
        )
    columns, rows = _representatives(variable, plan.columns), _representatives(variable, plan.rows)
    places = {axis: variable.sizes[axis] // 2 for axis in plan.middle}
    places |= {**_chosen(plan.columns, columns), **_chosen(plan.rows, rows)}
    cut, status = (_cut(one, places) for one in (variable, dataset["status"]))
    cut = cut.where(np.isfinite(cut))
    status = status.where(np.isfinite(cut), 0)
    doubts = doubts_in(status.values, name)
    finite = cut.values[np.isfinite(cut.values)]
    if not finite.size:
        raise DatasetError(f"{name}: no value in any scene drawn; `gradhesion info` tells why")
    grid = part.subplots(len(rows), len(columns), sharex=True, sharey=True, squeeze=False)
    levels = panels.levels_of(float(finite.min()), float(finite.max()))
    for i, line in enumerate(grid):
        for j, axes in enumerate(line):
            place = {**_chosen(plan.columns, j), **_chosen(plan.rows, i)}
            _draw_panel(axes, cut.isel(place), status.isel(place), plan, levels, doubts)
            if plan.columns and i == 0:
                axes.set_title(_told(cut, plan.columns, j))
            if plan.rows and j == len(columns) - 1:
                axes.annotate(
                    _told(cut, plan.rows, i), (1.03, 0.5), xycoords="axes fraction", rotation=-90, va="center"
                )
            axes.label_outer()
    _dress(part, grid, plan, variable, levels)
    more = entries(doubts, in_map=plan.is_map, gaps=finite.size < cut.size)
    width, height = (2.1, 1.8) if len(columns) > 1 else (3.6, 2.9)
    return width * len(columns) + 1.2, height * len(rows) + 0.6, more


def _cut(variable: xarray.DataArray, places: Mapping[str, Any]) -> xarray.DataArray:
    """Load what is drawn of a variable, without axes of a single value."""
    kept = variable.isel(places)
    return kept.squeeze([axis for axis in kept.dims if variable.sizes[axis] == 1]).load()


def _draw_panel(
    axes: Axes,
    panel: xarray.DataArray,
    status: xarray.DataArray,
    plan: Plan,
    levels: panels.Levels,
    doubts: Sequence[Doubt],
) -> None:
    """Draw one panel of a variable."""
    x = scale(panel[plan.x].values)
    if plan.second is None:
        flags = status.values[x.order]
        doubtful = [(doubt, {"": doubt.marks(flags)}) for doubt in doubts]
        panels.draw_lines(axes, x, {"": panel.values[x.order].astype(float)}, doubtful)
        return
    items = panel[plan.second].values
    values = panel.transpose(plan.second, plan.x).values.astype(float)[:, x.order]
    flags = status.transpose(plan.second, plan.x).values[:, x.order]
    if plan.is_map:
        second = scale(items)
        marked = [(doubt, doubt.marks(flags)[second.order]) for doubt in doubts]
        panels.draw_map(axes, x, second, values[second.order], levels, marked)
        return
    order = range(items.size) if plan.second == SOLVER else np.argsort(items)
    labels = {equation(plan.second, items[i]): i for i in order}
    doubtful = [(doubt, {label: doubt.marks(flags[i]) for label, i in labels.items()}) for doubt in doubts]
    panels.draw_lines(axes, x, {label: values[i] for label, i in labels.items()}, doubtful)


def _dress(
    part: SubFigure,
    grid: NDArray[Any],
    plan: Plan,
    variable: xarray.DataArray,
    levels: panels.Levels,
) -> None:
    """Put labels, the colour bar or legend, and the fixed values around the panels of a variable."""
    name = str(variable.name)
    for axes in grid[-1]:
        axes.set_xlabel(label(plan.x))
    for axes in grid[:, 0]:
        axes.set_ylabel(label(plan.second) if plan.is_map and plan.second else label(name))
    if plan.is_map:
        filled = ScalarMappable(norm=levels.norm, cmap=panels.COLOURS)
        bar = part.colorbar(filled, ax=grid, label=label(name), boundaries=levels.levels, fraction=0.06, aspect=30)
        bar.ax.minorticks_off()
        bar.ax.set_yticks(levels.levels, [number(level) for level in levels.levels])
    elif plan.second:
        grid[0, -1].legend(fontsize=7, framealpha=0.9)
    part.suptitle(_caption(variable, plan), fontsize=8)


def _caption(variable: xarray.DataArray, plan: Plan) -> str:
    """Tell the parameters that are not drawn."""
    told = []
    for name in (SOLVER, *KEYS):
        values = np.atleast_1d(variable[name].values) if name in variable.coords else np.empty(0)
        if values.size == 1:
            told.append(equation(name, values.item()))
        elif name in plan.middle:
            told.append(f"{equation(name, values[values.size // 2])} (one of {values.size})")
    return ",  ".join(told)


def _draw_scenes(
    part: SubFigure, variable: xarray.DataArray, status: xarray.DataArray
) -> tuple[float, float, list[Any]]:
    """Draw a variable of a dataset of points over the first parameter that varies."""
    known = [name for name in KEYS if name in variable.coords]
    varying = [name for name in known if np.unique(variable[name].values).size > 1]
    if not varying:
        raise DatasetError(
            f"{variable.name}: no parameter varies, so there is nothing to draw over; `gradhesion info` tells its value"
        )
    values = variable.values.astype(float)
    if not np.isfinite(values).any():
        raise DatasetError(f"{variable.name}: no value in any scene; `gradhesion info` tells why")
    x = scale(variable[varying[0]].values)
    axes = part.subplots()
    solvers = variable[SOLVER].values if SOLVER in variable.dims else [""]
    values = np.where(np.isfinite(values), values, np.nan)
    flags = np.atleast_2d(np.where(np.isnan(values), 0, status.values))[:, x.order]
    doubts = doubts_in(flags, str(variable.name))
    doubtful = [(doubt, dict(zip(solvers, doubt.marks(flags), strict=True))) for doubt in doubts]
    panels.draw_points(axes, x, dict(zip(solvers, np.atleast_2d(values)[:, x.order], strict=True)), doubtful)
    axes.set_xlabel(label(varying[0]))
    axes.set_ylabel(label(str(variable.name)))
    told = [equation(name, variable[name].values[0]) for name in known if name not in varying]
    if varying[1:]:
        told.append("varying too: " + ", ".join(label(name) for name in varying[1:]))
    part.suptitle(",  ".join(told), fontsize=8)
    return 4.2, 3.1, entries(doubts, in_map=False, gaps=bool(np.isnan(values).any()))


def _representatives(variable: xarray.DataArray, axis: str | None) -> list[int]:
    """Choose the items of an axis to make panels of: its ends and its middle."""
    if axis is None:
        return [0]
    size = variable.sizes[axis]
    return sorted({round(item) for item in np.linspace(0, size - 1, min(size, PANELS))})


def _chosen(axis: str | None, items: Any) -> dict[str, Any]:
    """Choose items of an axis, if there is that axis."""
    return {} if axis is None else {axis: items}


def _told(variable: xarray.DataArray, axis: str, item: int) -> str:
    """Tell the value of an axis at an item."""
    return equation(axis, variable[axis].values[item])
