"""The picture of a dataset of values: variables side by side, each in panels of lines, points or maps."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.artist import Artist
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.dataset.read.sensitivities import parts_of, spread, with_influence
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import BEST, ON_BOUND, PARETO_POINT, SI
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.doubts import INK, entries
from gradhesion.cli.picture.fronts import draw_fronts
from gradhesion.cli.picture.inset import add_inset
from gradhesion.cli.picture.labels import Unit, effective, equation, equations, label
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.panels import FEW, LIGHT, draw_density, draw_lines, draw_map, number_contours
from gradhesion.cli.picture.pictured import finish, styled
from gradhesion.cli.picture.plan import Plan, in_order, items_of, placed, plan_of, plan_of_points, seen
from gradhesion.cli.picture.scales import Numbers, locator, scale
from gradhesion.cli.picture.shown import Shown, shown_of
from gradhesion.cli.terminal.wording import did_you_mean

NARROW: Final = 2.4
"""The width of a variable, in inches, below which variables stand below each other if a width is given."""

BESIDE: Final = 3
"""Variables that stand in one line."""

APART: Final = 0.17
"""The least distance of numbers at a colour bar, in inches."""

WHOLE: Final = Selection()
"""All of a dataset."""


def drawn(
    dataset: xarray.Dataset,
    requested: Sequence[str],
    selection: Selection = WHOLE,
    *,
    x: str | None = None,
    y: str | None = None,
    looks: Looks = PLAIN,
) -> Figure:
    """
    Draw variables of a grid of scenes, or of points, side by side; without any asked for, the force and the energy.

    Raises
    ------
    DatasetError
        A variable is not there or has no value, or nothing varies that it could be drawn over.
    """
    if PARETO_POINT in dataset.dims:
        return draw_fronts(dataset, requested, selection, x, y, looks)
    dataset, names = _chosen(dataset, requested)
    narrow = placed(selection.narrowed(dataset), selection, x, y)
    plan = _planned(narrow, names, selection, x, y, looks)
    _check(looks, names, plan)
    narrow = seen(in_order(narrow, plan), plan.x, looks.xlim)
    narrow = seen(narrow, plan.second, looks.ylim) if plan.is_map and plan.second else narrow
    items = items_of(narrow, plan)
    part = narrow.isel(items)
    shown = [shown_of(part, name, plan, selection, looks) for name in names]
    rows, columns = (part.sizes[axis] if axis else 1 for axis in (plan.rows, plan.columns))
    beside = _beside(len(names), columns, looks)
    below = -(-len(names) // beside)
    width, height = (2.1, 1.8) if columns > 1 else (3.6, 2.9)
    room = 2.2 if any(one.names for one in shown) else 1.2
    with styled(looks):
        figure = Figure(layout="constrained")
        grid = figure.subplots(rows * below, columns * beside, squeeze=False)
        parts = [half for band in np.split(grid, below) for half in np.split(band, beside, axis=1)]
        for axes in [axes for empty in parts[len(names) :] for axes in empty.flat]:
            axes.remove()
        size = beside * (width * columns + room), below * (height * rows + 0.6)
        share = (looks.height or size[1]) / size[1]
        contours = []
        for one, panels in zip(shown, parts, strict=False):
            contours += _draw(figure, panels, one, plan, looks, share * height * rows)
        finish(
            figure,
            looks,
            dataset=dataset,
            caption=dict.fromkeys(
                [*_caption(part, narrow, plan, selection, items), *(w for one in shown for w in one.caption)]
            ),
            entries=_entries(shown, grid[0, 0].get_legend_handles_labels()[0], plan, part.sizes[plan.x]),
            size=size,
            panels=[axes for panels in parts[: len(names)] for axes in panels.flat],
            laid_out=bool(contours) and looks.labels,
        )
        for lines, one in contours if looks.labels else ():
            number_contours(lines, one)
        if looks.inset:
            again = partial(draw_lines, shown=shown[0], plan=plan, looks=looks)
            add_inset(grid[0, 0], again, looks.inset, plan.x)
    return figure


def _chosen(dataset: xarray.Dataset, requested: Sequence[str]) -> tuple[xarray.Dataset, list[str]]:
    """
    Check the variables that are asked for; otherwise take force and energy, in SI units if they have them.

    Of an optimum it is what is best, and where. A sensitivity becomes a variable for each thing that it is to.
    """
    of_each = {str(name): parts_of(dataset, str(name)) for name in dataset.data_vars}
    dataset = spread(dataset)
    known = [str(name) for name in dataset.data_vars]
    parts = {name: with_influence(dataset, name, [*own]) if own else [name] for name, own in of_each.items()}
    chosen = [one for name in requested for one in parts.get(name, [name])]
    for name in chosen:
        if name not in known:
            raise DatasetError(f"--variable {name}: not in this dataset; {did_you_mean(name, known)}")
    if not chosen and ON_BOUND in parts:
        chosen = [name for name in parts if name.startswith(BEST) and not of_each[name] and name + SI not in parts]
    usual = [name + SI if name + SI in known else name for name in ("pull_off_force", "dissipated_energy")]
    chosen = chosen or [name for name in usual if name in known] or next(iter(parts.values()))
    return dataset, [*dict.fromkeys(chosen)]


def _planned(
    narrow: xarray.Dataset, names: Sequence[str], selection: Selection, x: str | None, y: str | None, looks: Looks
) -> Plan:
    """Choose which axis goes where."""
    if SCENE in narrow.dims:
        if looks.kind:
            raise DatasetError(f"--{looks.kind}: points are drawn as points; leave it out")
        return plan_of_points(narrow, names[0], x)
    gone = {*selection.over, *(one.axis for one in selection.between)}
    sizes = {str(axis): size for axis, size in narrow["status"].sizes.items() if axis not in gone}
    plan = plan_of(sizes, x, y, looks.kind)
    if plan is None:
        remedy = "fix or reduce fewer axes" if gone or selection.fixed else "`gradhesion info` shows its value"
        raise DatasetError(f"{names[0]}: nothing varies, so there is nothing to draw it over; {remedy}")
    return plan


def _check(looks: Looks, names: Sequence[str], plan: Plan) -> None:
    """Refuse what a picture of these variables has no place for."""
    listed = isinstance(looks.levels, tuple)
    if looks.levels is not None and not plan.is_map:
        raise DatasetError("--levels: contour levels are for a map, and this picture has none; leave them out")
    if plan.is_map:
        looks.refuse(["band", "inset"], "this picture is a map, and has no lines")
    if plan.is_dense:
        looks.refuse(["band"], f"{plan.points:,} points are drawn as their density, which has no bars")
    if len(names) > 1 and ((looks.ylim and not plan.is_map) or listed):
        words = "--levels" if listed else looks.ylim
        what = "levels" if listed else "an axis"
        raise DatasetError(f"{words}: {' and '.join(names[:2])} have {what} each; choose one of them with --variable")
    if looks.inset and (len(names) > 1 or plan.columns or plan.rows or plan.points):
        raise DatasetError(
            f"{looks.inset}: an inset goes into a single panel of lines; choose one variable with --variable, and fix "
            "axes with --at"
        )


def _beside(count: int, columns: int, looks: Looks) -> int:
    """Choose how many variables stand in one line: those with several columns of panels do on a flat page alone."""
    page = looks.width or np.inf
    is_flat = looks.height is not None and page > 2.0 * looks.height
    below_each_other = page < NARROW * count or (columns > 1 and not is_flat)
    return 1 if below_each_other else min(count, BESIDE)


def _draw(figure: Figure, panels: Any, shown: Shown, plan: Plan, looks: Looks, height: float) -> list[Any]:
    """Draw a variable into its panels, with a bar of its colours; the contours are returned, for numbers on them."""
    coloured, contours = [], []
    titles = {axis: equations(axis, shown.values[axis].values) for axis in (plan.columns, plan.rows) if axis}
    along = label(plan.x, scale(shown.values[plan.x].values, plan.x, looks.xlim).unit)
    up = shown.label.replace(" $", "\n$", 1) if len(panels) > 1 else shown.label  # a row may be lower than it is long
    if plan.is_map and plan.second:
        up = label(plan.second, scale(shown.values[plan.second].values, plan.second, looks.ylim).unit)
    for (i, j), axes in np.ndenumerate(panels):
        if axes is not panels[0, 0]:
            axes.sharex(panels[0, 0])
            axes.sharey(panels[0, 0])
        one = shown.at({axis: item for axis, item in ((plan.rows, i), (plan.columns, j)) if axis})
        if plan.is_map:
            filled, lines = draw_map(axes, one, plan, looks)
            coloured += [filled] if filled else []
            contours += [(lines, shown)] if lines else []
        elif plan.is_dense and not shown.names:
            coloured.append(draw_density(axes, one, plan, looks))
        else:
            draw_lines(axes, one, plan, looks)
        last, first = i == len(panels) - 1, j == 0
        axes.set_xlabel(along if last else "")
        middle = first and (plan.is_map or i == (len(panels) - 1) // 2)  # words are longer than a row is high
        axes.set_ylabel(up if middle and not (shown.names and not plan.is_map) else "")
        axes.tick_params(labelbottom=last, labelleft=first)
        if plan.columns and i == 0:
            axes.set_title(titles[plan.columns][j])
        if plan.rows and j == panels.shape[1] - 1:
            axes.annotate(titles[plan.rows][i], (1.03, 0.5), xycoords="axes fraction", rotation=-90, va="center")
    if coloured:
        _add_bar(figure, panels, coloured, shown, height)
    return contours


def _add_bar(figure: Figure, panels: Any, coloured: Sequence[Any], shown: Shown, height: float) -> None:
    """Put a bar of colours beside the panels of a variable, with numbers at some levels and at both ends."""
    bar = figure.colorbar(coloured[0], ax=panels, fraction=0.06, aspect=30)
    bar.ax.yaxis.set_minor_locator(NullLocator())
    if shown.names:
        bar.ax.set_title(shown.label, loc="left")
        bar.ax.set_yticks(range(len(shown.names)), shown.names, fontsize="small")
    elif not hasattr(coloured[0], "levels"):
        most = max(2.0, *(float(np.max(cells.get_array())) for cells in coloured if cells.get_array().size))
        for cells in coloured:
            cells.set_norm(LogNorm(1.0, most))
        bar.set_label("scenes in a cell")
        bar.locator = locator(1.0, most, log=True)
        bar.formatter = Numbers(Unit())
    else:
        levels = coloured[0].levels
        step = -(-levels.size // max(2, int(height / APART)))
        some = [*levels[: levels.size - step : step], levels[-1]]
        bar.set_label(shown.label)
        bar.ax.set_yticks(some, shown.unit.numbers(some))


def _entries(shown: Sequence[Shown], lines: Sequence[Artist], plan: Plan, size: int) -> list[Artist]:
    """Make the entries of the legend, each once: lines, bands and doubts."""
    made: list[Artist] = [line for line in lines if line.get_label()]
    bar = Line2D([], [], ls="", marker="|", ms=7, mew=0.8, color=INK)
    for one in shown:
        if one.band_words:
            area = Patch(facecolor=INK, alpha=LIGHT, lw=0.0) if size > FEW and not plan.points else bar
            area.set_label(one.band_words)
            made.append(area)
        if not plan.is_dense:
            made += entries([doubt for doubt, _ in one.marks], in_map=plan.is_map, gaps=one.gaps)
    return [*{str(entry.get_label()): entry for entry in made}.values()]


def _caption(
    part: xarray.Dataset, whole: xarray.Dataset, plan: Plan, selection: Selection, items: Mapping[str, Any]
) -> list[str]:
    """Write the parameters that are not drawn, and what stands for the axes that are fixed or reduced."""
    written = []
    between = {one.axis: one.value for one in selection.between}
    others = []
    for name in (SOLVER, *effective(part)):
        values = np.unique(part[name].values) if name in part.coords else np.empty(0)
        if name in between:
            written.append(f"{equation(name, between[name])} (interpolated)")
        elif name in plan.middle:
            written.append(f"{equation(name, part[name].item())} (one of {whole.sizes[name]})")
        elif name in (*plan.places, *selection.over):
            continue
        elif values.size == 1:
            written.append(equation(name, values[0].item()))
        elif plan.points and values.size:
            others.append(SYMBOLS[name])
    written += ["varying too: " + ", ".join(others)] if others else []
    written += [f"{how} over {SYMBOLS[axis]}" for axis, how in selection.over.items()]
    for axis in (plan.x, plan.second):
        if axis and axis in items:
            written.append(f"{len(items[axis]):,} of {whole.sizes[axis]:,} values of {SYMBOLS[axis]}")
    return [*written, *slope_warnings(part)]
