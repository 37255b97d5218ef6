"""The picture of a curve dataset: planes of load, depth and contact radius; or states of contact over the distance."""

from collections.abc import Callable, Iterable, Sequence
from itertools import cycle
from pathlib import Path
from typing import Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import RAGGED, STATE, STATE_CURVES, variables_of_curves
from gradhesion.cli.names.outputs import SI, UNITS
from gradhesion.cli.picture.labels import Values, fixed, number, suit
from gradhesion.cli.picture.looks import Looks, check_names
from gradhesion.cli.picture.pictured import finish, make_room, side_by_side
from gradhesion.cli.picture.tracks import QUANTITIES, Plane, Points, draw_panel, finite, legend_of, scenes_of, tracks_in
from gradhesion.cli.study.text.quantities import factor_of_column, scaled
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.wording import shown

PLANES: Final = (("indentation", "load"), ("contact_radius", "indentation"), ("contact_radius", "load"))
OF_STATES: Final = {"pressure": ("pressure_radius", "pressure"), "surface": ("surface_radius", "surface_displacement")}
"""What each panel has along and up, unless that is chosen; and each curve of a state."""
JUMPS: Final = 'jumps are not drawn, but listed by `gradhesion info --jumps`; draw the cycle: add "path" to the outputs'
DASHES: Final = ("-", (0, (5, 1.5)), (0, (2, 1)), (0, (6, 1.5, 1, 1.5)))
"""What distinguishes states where colours do not print."""


def drawn_curves(dataset: xarray.Dataset, looks: Looks, note: Callable[[str], None]) -> Figure:
    """Draw curves of a dataset into three panels, or those with x and y, in units if it has them; all if none is asked.

    Curves of states, over the distance from the axis, are drawn where they alone are asked for or there. `note` takes
    what is left out of measured points.
    """
    options = ["levels", "clabel", "band", *(["kind"] if looks.kind == "map" else [])]
    looks.refuse(options, "curves are drawn as lines, without colours or a spread")
    planes, chosen = _planes(looks.x, looks.y), _chosen(dataset, looks.variables)
    of_states = [curve for curve in chosen if curve in STATE_CURVES]
    chosen = [curve for curve in chosen if curve not in of_states]
    if of_states and (looks.variables or not chosen):
        why = f"{of_states[0]} is drawn over the distance from the axis"
        looks.refuse(["data", "x", "y"], why)
        if chosen:
            raise DatasetError(f"--variable {chosen[0]}: {why}; leave one of them out")
        return _drawn_states(dataset, of_states, looks)
    si = wants_si(map(str, dataset.data_vars), looks.variables)
    known = [one for one in tracks_in(dataset, si=si, many=dataset["status"].size > 1) if one.curve in chosen]
    there = {plane: [one for one in known if {one.variables[side] for side in plane} <= {*dataset}] for plane in planes}
    panels = {plane: tracks for plane, tracks in there.items() if tracks}
    if not panels:
        wanted = f"--x {looks.x or 'any'} --y {looks.y or 'any'}"
        raise DatasetError(
            f"{wanted}: {', '.join(chosen)} lacks two of contact radius, depth and load; "
            f'name whole curves in the outputs of the study, as in outputs = ["{chosen[0]}"]'
        )
    for choice, sides in zip(("xlim", "ylim"), zip(*panels, strict=True), strict=True):
        if len({*sides}) > 1:
            looks.refuse([choice], "the panels differ; choose one with --x indentation --y load")
    drawn = {one.variables[side] for plane, tracks in panels.items() for one in tracks for side in plane}
    scenes, caption = scenes_of(dataset, looks, drawn)
    points, left_out = read_points(looks.data, [*panels], si=si) if looks.data else ({}, 0)
    if left_out:
        note(f"{looks.data}: {counted(left_out, 'row')} left out, without a number in each column")
    figure, grid, below = side_by_side(len(panels), 1.7, looks)
    for axes, (plane, tracks) in zip(grid, panels.items(), strict=True):
        draw_panel(axes, plane, tracks, scenes, looks, points)
    used = [track for track in known if any(track in tracks for tracks in panels.values())]
    size = looks.width or max(4.0, 2.5 * len(panels)), 2.4 * below + 0.6
    finish(figure, dataset, looks, grid, caption, [*legend_of(scenes, used, looks, points)], size=size)
    return figure


def wants_si(there: Iterable[str], requested: Sequence[str]) -> bool:
    """Choose whether curves are drawn in units: they are if the dataset has them, and no variable without is asked for.

    >>> wants_si(["path_load", "path_load_si"], ["path"]), wants_si(["path_load", "path_load_si"], ["path_load"])
    (True, False)
    """
    plain = [name for name in requested if name in UNITS]
    units = [name for name in requested if name.endswith(SI)]
    if plain and units:
        raise DatasetError(f"--variable {plain[0]}: has no unit, and {units[0]} has one; ask for {plain[0]}{SI}")
    return not plain and any(name.endswith(SI) for name in there)


def _planes(x: str | None, y: str | None) -> Sequence[Plane]:
    """List the planes that have a quantity along and one up, as they are chosen."""
    for side, name in (("x", x), ("y", y)):
        check_names(side, [name] if name else [], [*QUANTITIES], "not what curves are drawn over")
    every = [(along, up) for along in ([x] if x else QUANTITIES) for up in ([y] if y else QUANTITIES) if along != up]
    return [plane for plane in PLANES if plane in every] or every


def _chosen(dataset: xarray.Dataset, requested: Sequence[str]) -> list[str]:
    """List the curves to draw; a variable stands for its curve."""
    there = {curve: own for curve, own in variables_of_curves(dataset).items() if curve not in RAGGED}
    if not there:
        raise DatasetError(JUMPS)
    known = [word for curve, own in there.items() for word in (curve, *own)]
    check_names("variable", requested, known, "not a curve of this dataset")
    return [curve for curve, own in there.items() if not requested or {curve, *own} & {*requested}]


def read_points(file: Path, planes: Sequence[Plane], *, si: bool) -> tuple[Points, int]:
    """Read measured points for a picture with some planes, from a table (CSV or NetCDF); count rows that are left out.

    It has two or more of the columns indentation, load (positive presses) and contact_radius; other columns are left
    aside, and so are rows without a number. The header has units if the picture has; else the columns are delta/R,
    P/(1.5 pi R dgamma) and a/R.
    """
    try:
        found = read_columns(file, only=[word for own in QUANTITIES.values() for word in own])
        there = {one: word for one, own in QUANTITIES.items() for word in reversed(own) if word in found.values}
        values = {quantity: _scaled(found, quantity, word, si=si) for quantity, word in there.items()}
    except ColumnsError as error:
        raise DatasetError(f"--data {file}: {error}") from None
    if not any({*plane} <= there.keys() for plane in planes):
        wanted = " or ".join(f"{along} and {up}" for along, up in planes)
        has = ", ".join(map(shown, [*there.values(), *found.others]))
        raise DatasetError(f"--data {file}: the panels need the columns {wanted}, and it has {has}; rename some")
    sound = np.isfinite([*values.values()]).all(axis=0)
    if not sound.any():
        raise DatasetError(f"--data {file}: no row has numbers in all of {', '.join(there.values())}; add some")
    return {name: row[sound] for name, row in values.items()}, int(np.count_nonzero(~sound))


def _scaled(found: Columns, quantity: str, word: str, *, si: bool) -> Values:
    """Give a column in the units of the dataset; a radius is a length as a depth is."""
    if si:
        key = "load" if quantity == "load" else "indentation"
        return scaled(found.values[word], factor_of_column(found, word, key))
    if unit := found.units.get(word):
        remedy = "give the study its units, or write the ratio without one"
        raise ColumnsError(f"{word} [{unit}] has a unit, and the curves have none; {remedy}")
    return found.values[word]


def _drawn_states(dataset: xarray.Dataset, chosen: Sequence[str], looks: Looks) -> Figure:
    """Draw pressure and surface of the states of a scene, the first of several; in units if the dataset has them."""
    looks.refuse(["xlim", "ylim"], "curves of states are drawn whole")
    scene = finite(dataset.isel(dict.fromkeys(dataset["status"].dims, 0)))
    panels = [names for curve, names in OF_STATES.items() if curve in chosen and {*names} <= {*scene}]
    if not any((scene[x].notnull() & scene[y].notnull()).any() for x, y in panels):
        raise DatasetError(
            f"{chosen[0]}: no value in any state drawn, `gradhesion info` reports why; or its radius or value is "
            "missing: run a study with this curve as a whole"
        )
    figure, grid, below = side_by_side(len(panels), 2.4, looks)
    for axes, (x, y) in zip(grid, panels, strict=True):
        si = SI if x + SI in scene and y + SI in scene else ""
        _draw_states(axes, scene, x + si, y + si, "surface_gap" + si, looks)
    handles, _ = grid[-1].get_legend_handles_labels()
    size = looks.width or 4.0 * len(panels), 2.5 * below + 0.2
    finish(figure, dataset, looks, grid, fixed(scene, dataset), handles, size=size)
    return figure


def _draw_states(axes: Axes, scene: xarray.Dataset, x: str, y: str, gap: str, looks: Looks) -> None:
    """Draw one curve of every state, and the punch itself where it does not touch."""
    along, up = (np.atleast_2d(scene[name].values) for name in (x, y))
    is_surface, states = y.startswith("surface"), scene[STATE].values.tolist()
    gaps = np.atleast_2d(scene[gap].values) if gap in scene and is_surface else np.full(up.shape, np.nan)
    for i, (state, dash) in enumerate(zip(states, cycle(DASHES), strict=False)):
        words = state.replace("_", " ") if isinstance(state, str) else f"$a/R$ = {number(float(state))}"
        there = np.isfinite(along[i] + up[i]).any()
        colour = looks.colours(0.75 * i / max(1, len(states) - 1))
        axes.plot(along[i], up[i], color=colour, ls=dash, lw=1.2, label=words if there else f"{words} (absent)")
        punch = np.where(gaps[i] > 0.0, up[i] - gaps[i], np.nan)
        axes.plot(along[i], punch, color=colour, lw=0.6, ls=(0, (1, 1.5)))
    axes.axhline(0.0, color="0.85", lw=0.6, zorder=0)
    axes.set_xlim(left=0.0)
    if is_surface:
        axes.invert_yaxis()  # into the half-space is downwards
    else:  # at its edge a pressure has no bound
        make_room(axes, "y", up[along <= 0.95 * np.nanmax(along, axis=1, keepdims=True, initial=0.0)])
    suit(axes, "x", x)
    suit(axes, "y", y)
