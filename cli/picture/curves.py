"""The picture of a curve dataset: load over depth, depth over contact radius, load over contact radius."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import RAGGED, STATE_CURVES, variables_of_curves
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.scenes import SCENE
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.picture.doubts import CROSS, DOUBTS, Doubt, doubts_in, entries
from gradhesion.cli.picture.labels import equations, fixed, given, suit
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.pictured import MARKERS, finish, stacked, styled
from gradhesion.cli.picture.states import draw_states
from gradhesion.cli.picture.tracks import (
    JUMP,
    QUANTITIES,
    THIN,
    TRACKS,
    TRACKS_OF_MANY,
    Colour,
    Dash,
    Plane,
    Points,
    Track,
    Values,
    faded,
    read_points,
    tracks_in,
    unloads,
)
from gradhesion.cli.terminal.wording import did_you_mean

PLANES: Final[tuple[Plane, ...]] = (
    ("indentation", "load"),
    ("contact_radius", "indentation"),
    ("contact_radius", "load"),
)
"""What each panel has along and up, unless that is chosen."""

SCENES: Final = 5
"""Scenes in one picture: more could not be distinguished."""

APART: Final = 0.12
MARKED: Final = 0.22
"""How far apart the marks of doubts and of scenes stand along a line, in diagonals of the panel."""

INK: Final = to_rgb("0.25")
"""The colour of lines in a legend where colours distinguish scenes."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """One scene of a dataset."""

    label: str
    colour: Colour | None
    """The colour of all its lines (None: each line has its own)."""
    values: xarray.Dataset
    doubts: Sequence[Doubt]
    """What makes its path doubtful."""
    item: int
    """Which of the scenes it is."""


def drawn_curves(
    dataset: xarray.Dataset,
    requested: Sequence[str],
    x: str | None,
    y: str | None,
    looks: Looks,
    data: Path | None,
    notes: Callable[[str], None],
) -> Figure:
    """Draw curves of a dataset into three panels, in units if it has them; without any asked for, all of them.

    With x or y, the contact radius, indentation or load, those panels alone are drawn that have it there. Curves of
    states, over the distance from the axis, are drawn where they alone are asked for or there. Measured points come
    from a file, `data`; what is left out of it goes to `notes`.
    """
    if looks.kind == "map":
        raise DatasetError("--map: curves are drawn as lines; leave it out")
    looks.refuse(["levels", "clabel", "band"], "curves are drawn as lines, without a spread")
    planes, chosen = _planes(x, y), _chosen(dataset, requested)
    of_states = [curve for curve in chosen if curve in STATE_CURVES]
    chosen = [curve for curve in chosen if curve not in of_states]
    if of_states and (requested or not chosen):
        others = [*chosen, *(f"--{name} {value}" for name, value in (("data", data), ("x", x), ("y", y)) if value)]
        if others:
            raise DatasetError(
                f"{of_states[0]}, over the distance from the axis, goes into no picture with {others[0]}; leave it out"
            )
        return draw_states(dataset, of_states, looks)
    scenes, caption = _scenes_of(dataset, looks)
    si = wants_si(map(str, dataset.data_vars), requested)
    own = [track for track in (TRACKS_OF_MANY if len(scenes) > 1 else TRACKS) if track.curve in chosen]
    known = tracks_in(dataset, own, si=si)
    there = {plane: [one for one in known if {one.variables[side] for side in plane} <= {*dataset}] for plane in planes}
    panels = {plane: tracks for plane, tracks in there.items() if tracks}
    if not panels:
        wanted = " ".join(f"--{side} {name}" for side, name in (("x", x), ("y", y)) if name) or "a picture"
        raise DatasetError(
            f"{wanted}: {', '.join(chosen)} lacks two of contact radius, indentation and load; name whole curves in "
            f'the outputs of the study, as in outputs = ["{chosen[0]}"]'
        )
    rows = [track.points(scene.values, plane) for plane, own in panels.items() for track in own for scene in scenes]
    if not any(np.isfinite(row).all(axis=0).any() for row in rows):
        raise DatasetError("no value in any scene drawn; `gradhesion info` reports why")
    for choice, sides in zip(("xlim", "ylim"), zip(*panels, strict=True), strict=True):
        if len({*sides}) > 1:
            looks.refuse([choice], "the panels differ; choose one with --x indentation --y load")
    points = None if data is None else read_points(data, [*panels], si=si)
    for note in points.notes if points else ():
        notes(note)
    below = stacked(len(panels), 1.7, looks)
    size = looks.width or max(4.0, 2.5 * len(panels)), 2.4 * below + 0.6
    with styled(looks):
        figure = Figure(layout="constrained")
        grid = figure.subplots(below, len(panels) // below, squeeze=False).ravel()
        for axes, (plane, tracks) in zip(grid, panels.items(), strict=True):
            _draw_panel(axes, plane, tracks, scenes, points, looks)
        used = [track for track in known if any(track in tracks for tracks in panels.values())]
        handles = [*_handles(scenes, used, looks), *([Line2D([], [], **points.looks)] if points else [])]
        finish(figure, dataset, looks, grid, caption, handles, size=size, rows=below)
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
        if name and name not in QUANTITIES:
            raise DatasetError(f"--{side} {name}: not what curves are drawn over; {did_you_mean(name, QUANTITIES)}")
    if x and x == y:
        raise DatasetError(f"--x {x} --y {y}: one quantity cannot be both sides; choose another for one of them")
    every = [(along, up) for along in ([x] if x else QUANTITIES) for up in ([y] if y else QUANTITIES) if along != up]
    return [plane for plane in PLANES if plane in every] or every


def _chosen(dataset: xarray.Dataset, requested: Sequence[str]) -> list[str]:
    """List the curves to draw; a variable stands for its curve."""
    there = {curve: own for curve, own in variables_of_curves(dataset).items() if curve not in RAGGED}
    if not there:
        raise DatasetError(
            "jumps are not drawn: `gradhesion info --jumps` lists them; "
            'for a picture of the cycle add "path" to the outputs of the study'
        )
    known = [word for curve, own in there.items() for word in (curve, *own)]
    for name in requested:
        if name not in known:
            raise DatasetError(f"--variable {name}: not a curve of this dataset; {did_you_mean(name, known)}")
    return [curve for curve, own in there.items() if not requested or {curve, *own} & {*requested}]


def _scenes_of(dataset: xarray.Dataset, looks: Looks) -> tuple[list[Scene], list[str]]:
    """Choose the scenes to draw, along the last axis with more than one value, and write what they have in common."""
    dims = [str(axis) for axis in dataset["status"].dims]
    last = next((axis for axis in reversed(dims) if dataset.sizes[axis] > 1), None)
    some = dataset.isel({axis: 0 for axis in dims if axis != last})
    varying = [last] if last else []
    if last == SCENE:
        varying = [name for name in given(some.coords) if np.unique(some[name].values).size > 1]
    caption = fixed(dataset.drop_vars(varying, errors="ignore"))
    size = dataset.sizes[last] if last else 1
    items = np.unique(np.linspace(0, size - 1, min(size, SCENES)).round().astype(int)).tolist()
    scenes = []
    for place, item in enumerate(items):
        scene = (some.isel({last: item}) if last else some).load()
        colour = to_rgb(looks.colours(0.75 * place / (len(items) - 1))) if last else None
        label = ", ".join(equations(name, scene[name].item())[0] for name in varying[:2]) or f"scene {item}"
        names = [name + end for track in TRACKS for name in track.variables.values() for end in ("", SI)]
        if not any(np.isfinite(scene[name].values).any() for name in names if name in scene):
            label, colour = f"{label} (no value)", to_rgb(CROSS)
        doubts = doubts_in(scene["status"].values, "path", scene)
        scenes.append(Scene(label=label, colour=colour, values=scene, doubts=doubts, item=place))
    caption += [f"{SCENES} of {size} scenes"] if size > SCENES else []
    return scenes, [*caption, *slope_warnings(dataset)]


def _draw_panel(
    axes: Axes, plane: Plane, tracks: Sequence[Track], scenes: Sequence[Scene], points: Points | None, looks: Looks
) -> None:
    """Draw the lines of all scenes into a panel, measured points, lines of zero, and arrows along the paths."""
    for track in tracks:
        for scene in scenes:
            colour, own = scene.colour or track.colour(looks.colours), track.points(scene.values, plane)
            track.draw(axes, scene.values, plane, colour)
            if scene.colour:
                start = MARKED * (0.15 + scene.item / len(MARKERS))  # beside those of the scene before
                _draw_marks(axes, own, start, MARKED, color=colour, **_marker(scene))
            if track.curve == "path" and not track.unloading:
                loading = own[:, ~unloads(scene.values, own.shape[1])]
                for doubt in reversed(scene.doubts):  # the larger ones below
                    _draw_marks(axes, loading, 0.5 * APART, APART, mew=0.8, **doubt.marker(colour))
    if points is not None and {*plane} <= points.values.keys():
        axes.plot(*(points.values[quantity] for quantity in plane), **points.looks)
    along, up = plane
    axes.axhline(0.0, color="0.85", lw=0.6, zorder=0)
    if along == "indentation":
        axes.axvline(0.0, color="0.85", lw=0.6, zorder=0)
    else:
        axes.set_xlim(left=0.0)
    suit(axes, "x", tracks[0].variables[along], looks.xlim)
    if looks.xlim and not looks.ylim:
        _fit_heights(axes)
    suit(axes, "y", tracks[0].variables[up], looks.ylim)
    arrows: list[Values] = []
    for track in (one for one in tracks if one.curve == "path"):
        for scene in scenes:
            colour = scene.colour or track.colour(looks.colours)
            track.draw_arrows(axes, scene.values, plane, colour, arrows)


def _draw_marks(axes: Axes, points: Values, start: float, apart: float, **looks: Any) -> None:
    """Put markers along a line, evenly in the panel: from where on, and how far apart, in its diagonals."""
    if np.isfinite(points).all(axis=0).any():  # matplotlib fails to mark a line without a point
        axes.plot(*points, **({"markevery": (start, apart), "ls": ""} | looks))


def _fit_heights(axes: Axes) -> None:
    """Let the vertical limits of a panel suit what is drawn between the horizontal ones."""
    first, last = axes.get_xlim()
    lines = [line.get_path().interpolated(20).vertices for line in axes.lines if line.get_zorder() > 0.0]  # of no zero
    points = np.vstack([np.empty((0, 2)), *lines])
    seen = points[np.isfinite(points).all(axis=1) & (points[:, 0] >= first) & (points[:, 0] <= last), 1]
    if seen.size:
        margin = 0.08 * float(np.ptp(seen)) or 1.0
        axes.set_ylim(float(seen.min()) - margin, float(seen.max()) + margin)


def _marker(scene: Scene) -> dict[str, Any]:
    """Give what distinguishes a scene in a grey print."""
    return {"marker": MARKERS[scene.item % len(MARKERS)], "ms": 3.2, "mew": 0.0}


def _handles(scenes: Sequence[Scene], tracks: Sequence[Track], looks: Looks) -> list[Artist]:
    """Make the entries of the legend."""

    def entry(label: str, colour: Colour, dash: Dash = "-", width: float = 1.6, **more: Any) -> Line2D:
        return Line2D([], [], color=colour, ls=dash, lw=width, label=label, **more)

    coloured = [scene for scene in scenes if scene.colour]
    made: list[Artist] = [entry(scene.label, scene.colour or INK, **_marker(scene)) for scene in coloured]
    for track in tracks:
        colour = INK if coloured else track.colour(looks.colours)
        made.append(entry(track.label, colour, track.dash, track.width))
        if any(track.falls(scene.values).any() for scene in scenes):
            words = track.label.replace(", stable", "") + ", unstable"
            made.append(entry(words, faded(colour), track.dash, track.width))
    if any(track.jumps(scene.values).any() for track in tracks for scene in scenes):
        made.append(entry("jump", INK, JUMP, THIN))
    if any(track.curve == "path" for track in tracks):
        made += entries([doubt for doubt in DOUBTS if any(doubt in scene.doubts for scene in scenes)])
    return made
