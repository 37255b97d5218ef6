"""The picture of a dataset of values: variables side by side, each in panels, with what is said around them."""

from collections.abc import Sequence
from typing import Final

import xarray
from matplotlib.artist import Artist
from matplotlib.figure import Figure

from gradhesion.cli.dataset.selection import Selection
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names import SCENE, SI
from gradhesion.cli.picture.doubts import ORDER
from gradhesion.cli.picture.grid_picture import draw_grid, shape_of
from gradhesion.cli.picture.layout import placed, plan_of
from gradhesion.cli.picture.pictured import heading, styled
from gradhesion.cli.picture.points_picture import draw_scenes
from gradhesion.cli.terminal.wording import did_you_mean

LINE: Final = 0.16
"""The height of an entry of the legend below the panels, in inches."""

WHOLE: Final = Selection()
"""All of a dataset."""


def drawn(
    dataset: xarray.Dataset,
    asked: Sequence[str],
    selection: Selection = WHOLE,
    *,
    x: str | None = None,
    y: str | None = None,
) -> Figure:
    """
    Draw variables of a dataset side by side; without any asked for, the force and the energy.

    Parameters
    ----------
    dataset
        A dataset of values, grid or points.
    asked
        Names of variables.
    selection
        Which axes are fixed or reduced.
    x, y
        The axes along the sides of a panel; None: the finest ones.

    Raises
    ------
    DatasetError
        A variable is not there or has no value, or nothing varies that it could be drawn over.
    """
    chosen = _chosen(dataset, asked)
    narrow = placed(selection.narrowed(dataset), selection, x, y)
    points = SCENE in narrow.dims
    gone = {*selection.over, *(one.axis for one in selection.between)}
    sizes = {str(axis): size for axis, size in narrow["status"].sizes.items() if axis not in gone}
    plan = None if points else plan_of(sizes, x, y)
    if plan is None and not points:
        raise DatasetError(
            f"{chosen[0]}: nothing varies, so there is nothing to draw it over; "
            + ("fix or reduce fewer axes" if gone or selection.fixed else "`gradhesion info` tells its value")
        )
    with styled():
        figure = Figure(layout="constrained")
        shape = shape_of(sizes, plan) if plan else (1, 1)
        below = len(chosen) if shape[1] > 1 and shape[0] == 1 else 1  # strips of panels stand below each other
        parts = figure.subfigures(below, len(chosen) // below, squeeze=False).ravel()
        told: dict[str, Artist] = {}
        wide, high = [0.0], [0.0]
        for part, name in zip(parts, chosen, strict=True):
            if plan:
                width, height, more = draw_grid(part, narrow, name, plan, selection)
            else:
                width, height, more = draw_scenes(part, narrow, name, x)
            wide.append(width)
            high.append(height)
            told |= {str(entry.get_label()): entry for entry in more}
        words = heading(dataset)
        lines = LINE * (len(told) + words.count("\n"))
        figure.set_size_inches(max(wide) * len(chosen) / below, max(high) * below + 0.5 + lines)
        if told:
            handles = [told[words] for words in ORDER if words in told]
            figure.legend(handles=handles, loc="outside lower center", fontsize=7)
        figure.suptitle(words, fontsize=10, wrap=True)
    return figure


def _chosen(dataset: xarray.Dataset, asked: Sequence[str]) -> list[str]:
    """Check the variables that are asked for; otherwise take force and energy, in SI units if they have them."""
    known = [str(name) for name in dataset.data_vars]
    for name in asked:
        if name not in known:
            raise DatasetError(f"--variable {name}: not in this dataset; {did_you_mean(name, known)}")
    usual = [name + SI if name + SI in known else name for name in ("pull_off_force", "dissipated_energy")]
    return [*dict.fromkeys(asked)] or [name for name in usual if name in known] or known[:1]
