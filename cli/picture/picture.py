"""The picture of a dataset: of values in panels of lines, points or maps, fronts of two goals; of curves; of fits."""

from collections.abc import Callable, Mapping, Sequence
from itertools import chain
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.artist import Artist
from matplotlib.colors import LogNorm
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from gradhesion.cli.dataset.read.reader import has_curves, is_fit
from gradhesion.cli.dataset.read.selection import Selection, selection_of
from gradhesion.cli.dataset.read.sensitivities import part_of, spread
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import BEST, ON_BOUND, PARETO_POINT, SI
from gradhesion.cli.picture.curves import drawn_curves
from gradhesion.cli.picture.fits import drawn_fits
from gradhesion.cli.picture.labels import Scale, Unit, called, equations, label, locator, scale, suit, unit_for
from gradhesion.cli.picture.looks import Looks, check_dimensions, check_names
from gradhesion.cli.picture.panels import FEW, LIGHT, MARKS, draw_density, draw_lines, draw_map, number_contours
from gradhesion.cli.picture.pictured import finish, styled
from gradhesion.cli.picture.plan import Plan, caption_of, planned, some_of, within
from gradhesion.cli.picture.shown import INK, Shown, entries, shown_of
from gradhesion.cli.picture.tracks import scenes_of
from gradhesion.core.problem.inputs import INPUTS

NARROW: Final = 1.5
"""Inches along a panel and its numbers below which the numbers stand upright: they would run into each other."""


def picture_of(dataset: xarray.Dataset, looks: Looks, notes: Callable[[str], None] = lambda _: None) -> Figure:
    """Draw a dataset of any kind, as `gradhesion plot` does; `notes` takes what is to be known of fixed axes."""
    with styled(looks):
        if is_fit(dataset):
            return drawn_fits(dataset, looks)
        check_dimensions(dataset)
        if looks.x and looks.x == looks.y:
            raise DatasetError(f"--x {looks.x} --y {looks.y}: one axis cannot be both sides; choose another for one")
        selection = selection_of(dataset, looks.at, looks.over, interpolate=looks.interpolate)
        for note in selection.notes:
            notes(note)
        if has_curves(dataset):
            looks.refuse(["over", "interpolate"], "curves are drawn as they are, of scenes that --at chooses")
            return drawn_curves(selection.narrowed(dataset), looks, notes)
        looks.refuse(["data"], "measured points go on curves, and this is a map")
        draw = _drawn_fronts if PARETO_POINT in dataset.dims else _drawn_values
        return draw(dataset, selection, looks)


def _drawn_values(dataset: xarray.Dataset, selection: Selection, looks: Looks) -> Figure:
    """Draw variables of a grid of scenes, or of points, side by side; of none asked for the force and the energy."""
    dataset, names = _chosen(dataset, looks.variables)
    narrow, plan = planned(selection.narrowed(dataset), selection, looks)
    _check(looks, names, plan)
    narrow = within(narrow, plan, looks)
    part = some_of(narrow, plan)
    shown = [shown_of(part, name, plan, selection, looks) for name in names]
    along = scale(part[plan.x].values, plan.x)
    up = scale(part[plan.second].values, plan.second) if plan.is_map and plan.second else None
    rows, columns = shown[0].values.shape[:2]
    labels = {axis: equations(axis, part[axis].values) for axis in plan.places if axis != plan.x}
    wide = looks.width or np.inf  # several columns need a line each, unless the picture is flat
    is_high = wide < 2.4 * len(names) or (columns > 1 and not (looks.height and wide > 2.0 * looks.height))
    beside = 1 if is_high else min(len(names), 3)
    below = -(-len(names) // beside)
    width, height = (2.1, 1.8) if columns > 1 else (3.6, 2.9)
    room = 2.2 if any(one.names for one in shown) else 1.2
    size = beside * (width * columns + room), below * (height * rows + 0.6)
    figure = Figure(layout="constrained")
    grid = figure.subplots(rows * below, columns * beside, squeeze=False)
    parts = [half for band in np.split(grid, below) for half in np.split(band, beside, axis=1)]
    for axes in chain(*(empty.flat for empty in parts[len(names) :])):
        axes.remove()
    numbered: list[tuple[QuadContourSet, Unit]] = []
    for one, panels in zip(shown, parts, strict=False):
        found = _draw(panels, one, along, up, labels, plan, looks)
        unit = unit_for(one.name, one.ends, log=one.log)
        numbered += [(lines, unit) for _, lines in found if lines and looks.labels]
        if coloured := [filled for filled, _ in found if filled]:
            _add_bar(figure, panels, coloured, one, unit, looks, int((looks.height or size[1]) / below / 0.2))
    used = [*chain(*(panels.flat for panels in parts[: len(names)]))]
    words = dict.fromkeys([*caption_of(part, narrow, plan, selection), *chain(*(one.caption for one in shown))])
    handles = _entries(shown, grid[0, 0].get_legend_handles_labels()[0], plan, along.positions.size)
    finish(figure, part, looks, used, words, handles, size=size, laid_out=bool(numbered))
    for lines, unit in numbered:
        number_contours(lines, unit)
    return figure


def _chosen(dataset: xarray.Dataset, requested: Sequence[str]) -> tuple[xarray.Dataset, list[str]]:
    """Check the variables asked for, else take force and energy, or what is best and where; spread sensitivities."""
    dataset, parts = spread(dataset)
    known = [str(name) for name in dataset.data_vars]
    usual = [name + SI if name + SI in known else name for name in ("pull_off_force", "dissipated_energy")]
    chosen = requested or [name for name in usual if name in known] or known[:1]
    if not requested and ON_BOUND in known:
        plain = [name for name in known if name.startswith(BEST) and name not in parts and not part_of(name)]
        chosen = [name for name in plain if name + SI not in known]
    check_names("variable", chosen, known, "not in this dataset")
    own = {name: [one for one in parts.get(name, []) if np.any(np.nan_to_num(dataset[one].values))] for name in chosen}
    return dataset, [*dict.fromkeys(one for name in chosen for one in (name, *own[name]))]  # parts with an influence


def _check(looks: Looks, names: Sequence[str], plan: Plan) -> None:
    """Refuse what a picture of these variables has no place for."""
    if plan.is_map:
        looks.refuse(["band"], "this picture is a map, and has no lines")
    else:
        looks.refuse(["levels", "clabel"], "contour levels and their colours are for a map, and this picture has none")
    if plan.is_dense:
        looks.refuse(["band"], f"{plan.points:,} points are drawn as their density, which has no bars")
    if len(names) > 1:
        why = f"{names[0]} and {names[1]} have values of their own; choose one of them with --variable"
        looks.refuse([] if plan.is_map else ["ylim"], why)
        looks.refuse(["levels", "clabel"] if isinstance(looks.levels, tuple) else ["clabel"], why)


def _draw(
    panels: Any, shown: Shown, x: Scale, y: Scale | None, labels: Mapping[str, list[str]], plan: Plan, looks: Looks
) -> list[tuple[Any, QuadContourSet | None]]:
    """Draw a variable into its panels; of each what has colours is returned, for a bar, and contours, for numbers."""
    drawn: list[tuple[Any, QuadContourSet | None]] = []
    narrow = (looks.width or np.inf) < NARROW * panels.shape[1]
    for place, axes in np.ndenumerate(panels):
        if axes is not panels[0, 0]:
            axes.sharex(panels[0, 0])
            axes.sharey(panels[0, 0])
        if y:
            drawn.append(draw_map(axes, shown, place, x, y, looks))
        elif plan.is_dense and not shown.names:
            drawn.append((draw_density(axes, shown, place, x, looks), None))
        else:
            draw_lines(axes, shown, place, x, labels[plan.second] if plan.second else [""], plan, looks)
        i, j = place
        last, first = i == len(panels) - 1, j == 0
        if not last:
            axes.set_xlabel("")
        if not (first and (y or i == (len(panels) - 1) // 2)):  # words are longer than a row is high
            axes.set_ylabel("")
        elif not y and len(panels) > 1:  # a row may be lower than they are long
            axes.set_ylabel(axes.get_ylabel().replace(" $", "\n$", 1))
        axes.tick_params(labelbottom=last, labelleft=first)
        axes.tick_params(axis="x", labelrotation=90.0 if narrow else 0.0)
        if plan.columns and i == 0:
            axes.set_title(labels[plan.columns][j])
        if plan.rows and j == panels.shape[1] - 1:
            axes.annotate(labels[plan.rows][i], (1.03, 0.5), xycoords="axes fraction", rotation=-90, va="center")
    return drawn


def _add_bar(
    figure: Figure, panels: Any, coloured: Sequence[Any], shown: Shown, unit: Unit, looks: Looks, most: int
) -> None:
    """Put a bar of colours beside the panels of a variable, with a name, numbers at some levels and at both ends."""
    bar = figure.colorbar(coloured[0], ax=panels, fraction=0.06, aspect=30)
    bar.ax.yaxis.set_minor_locator(NullLocator())
    words, unit = called(looks.clabel, unit) if looks.clabel else (label(shown.name, unit) + shown.after, unit)
    if shown.names:
        bar.ax.set_title(words, loc="left")
        bar.ax.set_yticks(range(len(shown.names)), shown.names, fontsize="small")
    elif shown.levels:
        levels = shown.levels[0]
        step = -(-levels.size // max(2, most))
        some = [*levels[: levels.size - step : step], levels[-1]]
        bar.set_label(words)
        bar.ax.set_yticks(some, unit.format_ticks(some))
    else:
        greatest = max(2.0, *(max(cells.get_array(), default=0.0) for cells in coloured))
        for cells in coloured:
            cells.set_norm(LogNorm(1.0, greatest))
        bar.set_label("scenes in a cell")
        bar.locator, bar.formatter = locator(1.0, greatest, log=True), Unit()


def _entries(shown: Sequence[Shown], lines: Sequence[Artist], plan: Plan, size: int) -> list[Artist]:
    """Make the entries of the legend, each once: lines, bands and doubts."""
    made: list[Artist] = [line for line in lines if line.get_label()]
    for one in shown:
        if one.band_words and size > FEW and not plan.points:
            made.append(Patch(facecolor=INK, alpha=LIGHT, lw=0.0, label=one.band_words))
        elif one.band_words:
            made.append(Line2D([], [], ls="", marker="|", ms=7, mew=0.8, color=INK, label=one.band_words))
        if not plan.is_dense:
            made += entries([doubt for doubt, _ in one.marks], in_map=plan.is_map, gaps=one.gaps)
    return [*{str(entry.get_label()): entry for entry in made}.values()]


def _drawn_fronts(dataset: xarray.Dataset, selection: Selection, looks: Looks) -> Figure:
    """Draw the Pareto fronts of two goals, or of two variables asked for: the one along, the other up."""
    looks.refuse(["over", "interpolate", "kind", "band"], "Pareto fronts are drawn as they are")
    known = [str(name) for name in dataset.data_vars if PARETO_POINT in dataset[name].dims]
    asked = [*looks.variables, *filter(None, (looks.x, looks.y))]
    check_names("variable", asked, known, "not a variable of the Pareto front")
    goals = [name for name in known if not name.endswith(SI) and name.removeprefix(BEST) not in INPUTS]
    goals = [name + SI if name + SI in known else name for name in goals[:2]]
    first, second = [*looks.variables, *goals[len(looks.variables) :]][:2]
    along, up = looks.x or first, looks.y or second
    scenes, caption = scenes_of(selection.narrowed(dataset), looks, [along, up])
    figure = Figure(layout="constrained")
    axes = figure.subplots()
    for one in scenes:
        front = one.values[[along, up]].dropna(PARETO_POINT)
        own: dict[str, Any] = {"marker": one.marker, "ms": 3.5 if front[up].size <= MARKS else 2.0, "mew": 0.0}
        axes.plot(front[along], front[up], ls="", label=one.label, color=one.colour or looks.colours(0.0), **own)
    suit(axes, "x", along, looks.xlim)
    suit(axes, "y", up, looks.ylim)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_label_text(axis.get_label_text().removeprefix("best "))
    axes.grid(color="0.9", lw=0.5)
    if len(scenes) > 1:
        axes.legend(markerscale=1.5)
    finish(figure, dataset, looks, [axes], caption, size=(4.2, 3.0))
    return figure
