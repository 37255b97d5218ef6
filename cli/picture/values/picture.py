"""The picture of a dataset of values: variables side by side, each in panels, with what is said around them."""

from collections.abc import Sequence
from typing import Final

import xarray
from matplotlib.figure import Figure

from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.dataset.read.sensitivities import parts_of, spread, with_influence
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import BEST, ON_BOUND, PARETO_POINT, SI
from gradhesion.cli.names.scenes import SCENE
from gradhesion.cli.picture.doubts import ORDER
from gradhesion.cli.picture.inset import add_inset
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import CAPTION, heading, in_lines, lay_out, styled
from gradhesion.cli.picture.values.alignment import Aligned
from gradhesion.cli.picture.values.contour_numbers import number_contours
from gradhesion.cli.picture.values.front import draw_fronts
from gradhesion.cli.picture.values.grid import draw_grid, shape_of
from gradhesion.cli.picture.values.layout import placed, plan_of, seen
from gradhesion.cli.picture.values.part import add_legends
from gradhesion.cli.picture.values.points import draw_scenes
from gradhesion.cli.terminal.wording import did_you_mean

LINE: Final = 0.16
"""The height of an entry of the legend below the panels, in inches."""

TITLE: Final = 0.5
"""The height of the title with the space around it, in inches."""

NARROW: Final = 2.4
"""The width of a variable, in inches, below which variables stand below each other if a width is given."""

MOST_BESIDE: Final = 3
"""Variables that stand in one line."""

ROW: Final = 3
"""Variables in a line where there are more."""

ONE_PANEL: Final = (
    "an inset goes into a single panel of lines; choose one variable with --variable, and fix axes with --at"
)
"""Why a picture has no inset."""

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
    Draw variables of a dataset side by side; without any asked for, the force and the energy.

    Parameters
    ----------
    dataset
        A dataset of values, grid or points.
    requested
        Names of variables.
    selection
        Which axes are fixed or reduced.
    x, y
        The axes along the sides of a panel; None: the finest ones.
    looks
        What is chosen of how it looks.

    Raises
    ------
    DatasetError
        A variable is not there or has no value, or nothing varies that it could be drawn over.
    """
    if PARETO_POINT in dataset.dims:
        return draw_fronts(dataset, requested, selection, x, y, looks)
    of_each = {str(name): parts_of(dataset, str(name)) for name in dataset.data_vars}
    dataset = spread(dataset)
    parts = {name: with_influence(dataset, name, [*own]) if own else [name] for name, own in of_each.items()}
    if not requested and ON_BOUND in parts:  # of an optimum what is best, and where, in units if it has them
        requested = [name for name in parts if name.startswith(BEST) and not of_each[name] and name + SI not in parts]
    elif not requested and not {"pull_off_force", "dissipated_energy"} & {*parts}:
        requested = next(iter(parts.values()))
    elif requested:
        requested = [one for name in requested for one in parts.get(name, [name])]
    chosen = _chosen(dataset, requested)
    narrow = placed(selection.narrowed(dataset), selection, x, y)
    points = SCENE in narrow.dims
    gone = {*selection.over, *(one.axis for one in selection.between)}
    sizes = {str(axis): size for axis, size in narrow["status"].sizes.items() if axis not in gone}
    plan = None if points else plan_of(sizes, x, y, looks.kind)
    if points and looks.kind:
        raise DatasetError(f"--{looks.kind}: points are drawn as points; leave it out")
    if plan is None and not points:
        raise DatasetError(
            f"{chosen[0]}: nothing varies, so there is nothing to draw it over; "
            + ("fix or reduce fewer axes" if gone or selection.fixed else "`gradhesion info` shows its value")
        )
    if looks.levels is not None and not (plan and plan.is_map):
        raise DatasetError("--levels: contour levels are for a map, and this picture has none; leave them out")
    if plan:
        narrow = seen(narrow, plan.x, looks.xlim)
        narrow = seen(narrow, plan.second, looks.ylim) if plan.is_map and plan.second else narrow
    _check(looks, chosen, is_map=bool(plan and plan.is_map))
    with styled(looks):
        layout = Aligned()
        figure = Figure(layout=layout)
        body = figure.add_subfigure(figure.add_gridspec()[0])  # with the legend of lines; that of flags is outside
        shape = shape_of(sizes, plan) if plan else (1, 1)
        strips = shape[1] > 1 and shape[0] == 1  # strips of panels stand below each other
        narrow_page = looks.width is not None and looks.width < NARROW * len(chosen)
        below = len(chosen) if strips or narrow_page else 1 if len(chosen) <= MOST_BESIDE else -(-len(chosen) // ROW)
        beside = -(-len(chosen) // below)
        layout.parts = body.subfigures(below, beside, squeeze=False).tolist()
        figures = [part for row in layout.parts for part in row]
        made = []
        for part, name in zip(figures, chosen, strict=False):
            if plan:
                made.append(draw_grid(part, narrow, name, plan, selection, looks))
            else:
                made.append(draw_scenes(part, narrow, name, x, looks))
        entries = {str(entry.get_label()): entry for one in made for entry in one.entries}
        width = looks.width or max(one.width for one in made) * beside
        add_legends(body, figures, [one.lines for one in made], width, beside)
        words = [heading(dataset)] if looks.title else []
        captions = [in_lines(one.caption, width / beside) for one in made] if looks.caption else []
        if captions and len({*captions}) == 1:  # said once
            captions = []
            words += [in_lines(made[0].caption, width)] if made[0].caption else []
        more = 0.0
        for part, caption in zip(figures, captions, strict=False):
            if caption:
                part.suptitle(caption, fontsize=CAPTION)
                more = max(more, LINE * (1 + caption.count("\n")))
        more = more * below + LINE * (len(entries) + "\n".join(words).count("\n")) + (TITLE if words else 0.0)
        height = max(one.height for one in made) * below
        if looks.width:
            height *= min(1.0, width / (max(one.width for one in made) * beside))
        figure.set_size_inches(width, looks.height or height + more)
        if entries:
            handles = [entries[words] for words in ORDER if words in entries]
            figure.legend(handles=handles, loc="outside lower center", fontsize="small")
        if words:
            figure.suptitle("\n".join(words), fontsize=None if len(words) == 1 else "medium", wrap=True)
        contours = [lines for one in made for lines in one.contours] if looks.labels else []
        if contours or looks.width or looks.height or looks.inset:
            lay_out(figure)
        number_contours(contours)
        if looks.inset:
            again = made[0].again
            if again is None:
                raise DatasetError(f"{looks.inset}: {ONE_PANEL}")
            add_inset(figures[0].axes[0], again, looks.inset, *made[0].units)
    return figure


def _check(looks: Looks, chosen: Sequence[str], *, is_map: bool) -> None:
    """Refuse what a picture of these variables has no place for."""
    if is_map:
        looks.refuse(["band", "inset"], "this picture is a map, and has no lines")
    elif looks.ylim and len(chosen) > 1:
        raise DatasetError(
            f"{looks.ylim}: {' and '.join(chosen[:2])} have an axis each; choose one of them with --variable"
        )
    if looks.inset and len(chosen) > 1:
        raise DatasetError(f"{looks.inset}: {ONE_PANEL}")


def _chosen(dataset: xarray.Dataset, requested: Sequence[str]) -> list[str]:
    """Check the variables that are asked for; otherwise take force and energy, in SI units if they have them."""
    known = [str(name) for name in dataset.data_vars]
    for name in requested:
        if name not in known:
            raise DatasetError(f"--variable {name}: not in this dataset; {did_you_mean(name, known)}")
    usual = [name + SI if name + SI in known else name for name in ("pull_off_force", "dissipated_energy")]
    return [*dict.fromkeys(requested)] or [name for name in usual if name in known] or known[:1]
