"""The picture of a dataset: of values in panels of lines, points or maps, fronts of two goals; of curves; of fits."""

from collections.abc import Callable, Sequence
from itertools import chain
from pathlib import Path
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
from gradhesion.cli.picture.labels import Scale, Unit, effective, equations, locator, numbers, scale, suit
from gradhesion.cli.picture.looks import Looks, check_dimensions, check_names
from gradhesion.cli.picture.panels import FEW, LIGHT, MARKS, draw_density, draw_lines, draw_map, number_contours
from gradhesion.cli.picture.pictured import MARKERS, finish, stacked, styled
from gradhesion.cli.picture.plan import Plan, caption_of, planned, some_of, within
from gradhesion.cli.picture.shown import INK, Shown, entries, shown_of
from gradhesion.core.problem.inputs import INPUTS

NARROW: Final = 1.5
"""Inches along a panel and its numbers below which the numbers stand upright: they would run into each other."""
FRONTS: Final = 10
"""Pareto fronts in one picture: more could not be distinguished."""


def picture_of(
    dataset: xarray.Dataset,
    variables: Sequence[str],
    looks: Looks,
    *,
    at: Sequence[str] = (),
    over: Sequence[str] = (),
    interpolate: bool = False,
    x: str | None = None,
    y: str | None = None,
    data: Path | None = None,
    notes: Callable[[str], None] = lambda _: None,
) -> Figure:
    """Draw a dataset of any kind, as `gradhesion plot` does; `notes` takes what is to be known of fixed axes."""
    if is_fit(dataset):
        choices = {"--over": over, "--variable": variables, "--x": x, "--y": y, "--data": data}
        return drawn_fits(dataset, looks, [word for word, value in choices.items() if value], at)
    check_dimensions(dataset)
    if x and x == y:
        raise DatasetError(f"--x {x} --y {y}: one axis cannot be both sides; choose another for one of them")
    selection = selection_of(dataset, at, over, interpolate=interpolate)
    for note in selection.notes:
        notes(note)
    if not has_curves(dataset):
        if data is not None:
            raise DatasetError(f"--data {data}: measured points go on curves, and this is a map; leave it out")
        draw = _drawn_fronts if PARETO_POINT in dataset.dims else _drawn_values
        return draw(dataset, variables, selection, x, y, looks)
    if of_maps := [word for word, on in (("--over", over), ("--interpolate", interpolate)) if on]:
        raise DatasetError(f"{of_maps[0]}: curves are drawn as they are; choose scenes with --at")
    return drawn_curves(selection.narrowed(dataset), variables, x, y, looks, data, notes)


def _drawn_values(
    dataset: xarray.Dataset, requested: Sequence[str], selection: Selection, x: str | None, y: str | None, looks: Looks
) -> Figure:
    """Draw variables of a grid of scenes, or of points, side by side; of none asked for the force and the energy."""
    dataset, names = _chosen(dataset, requested)
    narrow, plan = planned(selection.narrowed(dataset), selection, looks, x, y)
    _check(looks, names, plan)
    narrow = within(narrow, plan, looks)
    part = some_of(narrow, plan)
    shown = [shown_of(part, name, plan, selection, looks) for name in names]
    along = scale(part[plan.x].values, plan.x, looks.xlim)
    up = scale(part[plan.second].values, plan.second, looks.ylim) if plan.is_map and plan.second else None
    rows, columns = (part.sizes[axis] if axis else 1 for axis in (plan.rows, plan.columns))
    is_flat = looks.height is not None and (looks.width or np.inf) > 2.0 * looks.height
    is_high = stacked(len(names), 2.4, looks) > 1 or (columns > 1 and not is_flat)  # several columns need a line each
    beside = 1 if is_high else min(len(names), 3)
    below = -(-len(names) // beside)
    width, height = (2.1, 1.8) if columns > 1 else (3.6, 2.9)
    room = 2.2 if any(one.names for one in shown) else 1.2
    size = beside * (width * columns + room), below * (height * rows + 0.6)
    words = dict.fromkeys([*caption_of(part, narrow, plan, selection), *chain(*(one.caption for one in shown))])
    with styled(looks):
        figure = Figure(layout="constrained")
        grid = figure.subplots(rows * below, columns * beside, squeeze=False)
        parts = [half for band in np.split(grid, below) for half in np.split(band, beside, axis=1)]
        for axes in chain(*(empty.flat for empty in parts[len(names) :])):
            axes.remove()
        numbered: list[tuple[QuadContourSet, Unit]] = []
        for one, panels in zip(shown, parts, strict=False):
            found = _draw(panels, one, along, up, plan, looks)
            numbered += [(lines, one.unit) for _, lines in found if lines and one.unit and looks.labels]
            if coloured := [filled for filled, _ in found if filled]:
                _add_bar(figure, panels, coloured, one, looks.clabel, int((looks.height or size[1]) / below / 0.2))
        used = [*chain(*(panels.flat for panels in parts[: len(names)]))]
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
    panels: Any, shown: Shown, x: Scale, y: Scale | None, plan: Plan, looks: Looks
) -> list[tuple[Any, QuadContourSet | None]]:
    """Draw a variable into its panels; of each what has colours is returned, for a bar, and contours, for numbers."""
    drawn: list[tuple[Any, QuadContourSet | None]] = []
    titles = {axis: equations(axis, shown.values[axis].values) for axis in (plan.columns, plan.rows) if axis}
    up = shown.label.replace(" $", "\n$", 1) if len(panels) > 1 else shown.label  # a row may be lower than it is long
    narrow = (looks.width or np.inf) < NARROW * panels.shape[1]
    for (i, j), axes in np.ndenumerate(panels):
        if axes is not panels[0, 0]:
            axes.sharex(panels[0, 0])
            axes.sharey(panels[0, 0])
        one = shown.at({axis: item for axis, item in ((plan.rows, i), (plan.columns, j)) if axis})
        if y:
            drawn.append(draw_map(axes, one, x, y, looks))
        elif plan.is_dense and not shown.names:
            drawn.append((draw_density(axes, one, x, looks), None))
        else:
            draw_lines(axes, one, x, plan, looks)
        last, first = i == len(panels) - 1, j == 0
        middle = first and (y or i == (len(panels) - 1) // 2)  # words are longer than a row is high
        axes.set_xlabel(axes.get_xlabel() if last else "")
        axes.set_ylabel((axes.get_ylabel() if y else "" if shown.names else up) if middle else "")
        axes.tick_params(labelbottom=last, labelleft=first)
        axes.tick_params(axis="x", labelrotation=90.0 if narrow else 0.0)
        if plan.columns and i == 0:
            axes.set_title(titles[plan.columns][j])
        if plan.rows and j == panels.shape[1] - 1:
            axes.annotate(titles[plan.rows][i], (1.03, 0.5), xycoords="axes fraction", rotation=-90, va="center")
    return drawn


def _add_bar(figure: Figure, panels: Any, coloured: Sequence[Any], shown: Shown, name: str | None, most: int) -> None:
    """Put a bar of colours beside the panels of a variable, with a name, numbers at some levels and at both ends."""
    bar = figure.colorbar(coloured[0], ax=panels, fraction=0.06, aspect=30)
    bar.ax.yaxis.set_minor_locator(NullLocator())
    if shown.names:
        bar.ax.set_title(name or shown.label, loc="left")
        bar.ax.set_yticks(range(len(shown.names)), shown.names, fontsize="small")
    elif hasattr(coloured[0], "levels"):
        levels = coloured[0].levels
        step = -(-levels.size // max(2, most))
        some = [*levels[: levels.size - step : step], levels[-1]]
        bar.set_label(name or shown.label)
        bar.ax.set_yticks(some, (shown.unit or Unit()).numbers(some))
    else:
        greatest = max(2.0, *(max(cells.get_array(), default=0.0) for cells in coloured))
        for cells in coloured:
            cells.set_norm(LogNorm(1.0, greatest))
        bar.set_label("scenes in a cell")
        bar.locator = locator(1.0, greatest, log=True)
        bar.formatter = numbers(Unit())


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


def _drawn_fronts(
    dataset: xarray.Dataset, requested: Sequence[str], selection: Selection, x: str | None, y: str | None, looks: Looks
) -> Figure:
    """Draw the Pareto fronts of two goals, or of two variables asked for: the one along, the other up."""
    if selection.over or selection.between or looks.kind:
        raise DatasetError("Pareto fronts are drawn as they are; choose scenes with --at")
    looks.refuse(["band"], "Pareto fronts are drawn as they are")
    narrow = selection.narrowed(dataset)
    along, up = _sides(narrow, requested, x, y)
    scenes = [str(axis) for axis in narrow["status"].dims if narrow.sizes[axis] > 1]
    narrow = narrow.squeeze([axis for axis in narrow["status"].dims if axis not in scenes])
    flat = narrow.stack(line=scenes) if scenes else narrow.expand_dims("line")
    if (count := flat.sizes["line"]) > FRONTS:
        raise DatasetError(f"{count} scenes are too many lines for one picture; choose some with --at")
    words = [", ".join(own) for own in zip(*(equations(name, flat[name].values) for name in scenes), strict=True)]
    with styled(looks):
        figure = Figure(layout="constrained")
        axes = figure.subplots()
        for i in range(count):
            line = flat[[along, up]].isel(line=i, drop=True).reset_coords(drop=True).dropna(PARETO_POINT)
            own: dict[str, Any] = {"marker": MARKERS[i % len(MARKERS)], "ms": 3.5 if line[up].size <= MARKS else 2.0}
            own |= {"color": looks.colours(0.85 * i / max(1, count - 1)), "label": words[i] if words else ""}
            axes.plot(line[along], line[up], ls="", mew=0.0, **own)  # there is nothing in a gap
        suit(axes, "x", along, looks.xlim)
        suit(axes, "y", up, looks.ylim)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_label_text(axis.get_label_text().removeprefix("best "))
        axes.grid(color="0.9", lw=0.5)
        if scenes:
            axes.legend(markerscale=1.5)
        caption = [equations(name, narrow[name].item())[0] for name in effective(narrow) if narrow[name].size == 1]
        finish(figure, narrow, looks, [axes], caption, size=(4.2, 3.0))
    return figure


def _sides(dataset: xarray.Dataset, requested: Sequence[str], x: str | None, y: str | None) -> tuple[str, str]:
    """Choose the two variables: the goals, in SI units if they have them."""
    known = [str(name) for name in dataset.data_vars if PARETO_POINT in dataset[name].dims]
    check_names("variable", (*requested, *filter(None, (x, y))), known, "not a variable of the Pareto front")
    goals = [name for name in known if not name.endswith(SI) and name.removeprefix(BEST) not in INPUTS]
    goals = [name + SI if name + SI in known else name for name in goals[:2]]
    first, second = [*requested, *goals[len(requested) :]][:2]
    return x or first, y or second
