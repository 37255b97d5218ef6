"""The picture of a curve dataset: load over depth, depth over contact radius, load over contact radius."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final

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
from gradhesion.cli.picture.inset import add_inset, fit_heights
from gradhesion.cli.picture.labels import effective, equation, given
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.measured import Points, read_points
from gradhesion.cli.picture.pictured import finish, styled
from gradhesion.cli.picture.scales import suit
from gradhesion.cli.picture.states import draw_states
from gradhesion.cli.picture.tracks import (
    JUMP,
    MARKED,
    MARKERS,
    QUANTITIES,
    THIN,
    TRACKS,
    TRACKS_OF_MANY,
    Colour,
    Dash,
    Track,
    Values,
    draw_arrows,
    draw_doubts,
    draw_marks,
    draw_track,
    faded,
    points_of,
    tracks_in,
)
from gradhesion.cli.terminal.wording import did_you_mean

Plane = tuple[str, str]

PLANES: Final[tuple[Plane, ...]] = (
    ("indentation", "load"),
    ("contact_radius", "indentation"),
    ("contact_radius", "load"),
)
"""What each panel has along and up, unless that is chosen."""

NARROW: Final = 1.7
"""The width of a panel, in inches, below which panels stand below each other if a width is given."""

SCENES: Final = 5
"""Scenes in one picture: more could not be distinguished."""

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
    item: int = 0
    """Which of the scenes it is."""

    def colour_of(self, track: Track) -> Colour:
        """Give the colour of one of its lines."""
        return self.colour or track.colour


def drawn_curves(
    dataset: xarray.Dataset,
    requested: Sequence[str],
    *,
    x: str | None = None,
    y: str | None = None,
    looks: Looks = PLAIN,
    data: Path | None = None,
    notes: Callable[[str], None] = lambda _: None,
) -> Figure:
    """
    Draw curves of a dataset into three panels, in units if it has them; without any asked for, all of them.

    With x or y, the contact radius, indentation or load, those panels alone are drawn that have it there. Curves of
    states, over the distance from the axis, are drawn where they alone are asked for or there. Measured points come
    from a file, `data`; what is left out of it goes to `notes`.

    Raises
    ------
    DatasetError
        A curve is not there, has no value, or lacks two variables to draw over each other.
    """
    if looks.kind == "map" or looks.levels is not None:
        option = "--map" if looks.kind == "map" else "--levels"
        raise DatasetError(f"{option}: curves are drawn as lines; leave it out")
    looks.refuse(["band"], "curves have no spread")
    planes = _planes(x, y)
    chosen = _chosen(dataset, requested)
    if of_states := [curve for curve in chosen if curve in STATE_CURVES]:
        others = [curve for curve in chosen if curve not in of_states]
        if requested and others:
            raise DatasetError(
                f"--variable {of_states[0]} is drawn over the distance from the axis, and {others[0]} is not: they "
                "have no axis in common; draw one after the other"
            )
        if not others:
            for option, value in (("data", data), ("x", x), ("y", y)):
                if value:
                    what = "over the distance from the axis; leave it out, or draw another curve with --variable"
                    raise DatasetError(f"--{option} {value}: this picture has curves of states, {what}")
            return draw_states(dataset, chosen, looks)
        chosen = others
    scenes, caption = _scenes_of(dataset, looks)
    si = wants_si(map(str, dataset.data_vars), requested)
    own = [track for track in (TRACKS_OF_MANY if len(scenes) > 1 else TRACKS) if track.curve in chosen]
    known = tracks_in(dataset, own, si=si, colours=looks.colours)
    there = {
        plane: [track for track in known if all(track.variables[one] in dataset for one in plane)] for plane in planes
    }
    panels = [(plane, tracks) for plane, tracks in there.items() if tracks]
    if not panels:
        wanted = " ".join(f"--{side} {name}" for side, name in (("x", x), ("y", y)) if name) or "a picture"
        raise DatasetError(
            f"{wanted}: {', '.join(chosen)} of this dataset lacks two of contact radius, indentation and load to draw "
            f'over each other; name whole curves in the outputs of the study, as in outputs = ["{chosen[0]}"]'
        )
    rows = [points_of(track, scene.values, plane) for plane, tracks in panels for track in tracks for scene in scenes]
    if not any(np.isfinite(row).all(axis=0).any() for row in rows):
        raise DatasetError("no value in any scene drawn; `gradhesion info` reports why")
    points = None if data is None else read_points(data, [plane for plane, _ in panels], si=si)
    for note in points.notes if points else ():
        notes(note)
    _check(looks, [plane for plane, _ in panels])
    with styled(looks):
        width = looks.width or max(4.0, 2.5 * len(panels))
        below = len(panels) if width < NARROW * len(panels) else 1
        figure = Figure(figsize=(width, looks.height or 2.4 * below + 1.1), layout="constrained")
        grid = figure.subplots(below, len(panels) // below, squeeze=False).ravel()
        for axes, (plane, tracks) in zip(grid, panels, strict=True):
            again = partial(_draw_panel, plane=plane, tracks=tracks, scenes=scenes, points=points, looks=looks)
            again(axes)
            arrows: list[Values] = []
            for track in (one for one in tracks if one.curve == "path"):
                for scene in scenes:
                    draw_arrows(axes, track, scene.values, plane, scene.colour_of(track), arrows)
        used = [track for track in known if any(track in tracks for _, tracks in panels)]
        handles = [*_handles(scenes, used), *([Line2D([], [], **points.looks)] if points else [])]
        size = width, 2.4 * below + 0.6
        finish(figure, looks, dataset=dataset, caption=caption, entries=handles, size=size, panels=grid)
        if looks.inset:
            add_inset(axes, again, looks.inset, panels[0][1][0].variables[panels[0][0][0]])
    return figure


def wants_si(there: Iterable[str], requested: Sequence[str]) -> bool:
    """
    Choose whether curves are drawn in units: they are if the dataset has them, unless variables without are asked for.

    >>> wants_si(["path_load", "path_load_si"], ["path"]), wants_si(["path_load", "path_load_si"], ["path_load"])
    (True, False)

    Raises
    ------
    DatasetError
        Some variables with a unit and some without are asked for: they have no axis in common.
    """
    plain = [name for name in requested if name in UNITS]
    units = [name for name in requested if name.endswith(SI)]
    if plain and units:
        raise DatasetError(
            f"--variable {plain[0]} has no unit and {units[0]} has one: they have no axis in common; "
            f"ask for {plain[0]}{SI} instead"
        )
    return not plain and any(name.endswith(SI) for name in there)


def _planes(x: str | None, y: str | None) -> Sequence[Plane]:
    """List the planes that have a quantity along and one up, as they are chosen."""
    for side, name in (("x", x), ("y", y)):
        if name and name not in QUANTITIES:
            raise DatasetError(
                f"--{side} {name}: curves are drawn over contact_radius, indentation or load; "
                f"{did_you_mean(name, QUANTITIES)}"
            )
    if x and x == y:
        raise DatasetError(f"--x {x} --y {y}: one quantity cannot be both sides; choose another for one of them")
    if x and y:
        return ((x, y),)
    planes = [(along, up) for along, up in PLANES if x in (None, along) and y in (None, up)]
    return planes or [(name, y) if y else (str(x), name) for name in QUANTITIES if name not in (x, y)]


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


def _check(looks: Looks, planes: Sequence[Plane]) -> None:
    """Refuse limits that panels do not share, and an inset that has several to choose from."""
    for span, several in (
        (looks.xlim, len({along for along, _ in planes}) > 1),
        (looks.ylim, len({up for _, up in planes}) > 1),
        (looks.inset, len(planes) > 1),
    ):
        if span and several:
            raise DatasetError(f"{span}: the panels have different axes; choose one with --x indentation --y load")


def _scenes_of(dataset: xarray.Dataset, looks: Looks) -> tuple[list[Scene], list[str]]:
    """Choose the scenes to draw, along the last axis with more than one value, and write what they have in common."""
    axes = [str(axis) for axis, size in dataset["status"].sizes.items() if size > 1]
    last = axes[-1] if axes else None
    first = dataset.isel({axis: 0 for axis in dataset["status"].dims if axis != last})
    caption = []
    for name in effective(dataset):
        values = np.unique(dataset[name].values)
        if values.size == 1:
            caption.append(equation(name, values[0].item()))
        elif name in axes[:-1]:
            caption.append(f"{equation(name, dataset[name].values[0].item())} (first of {values.size})")
    if last is None:
        caption += slope_warnings(dataset)
        return [_scene(first, "", None)], caption
    size = dataset.sizes[last]
    items = np.unique(np.linspace(0, size - 1, min(size, SCENES)).round().astype(int)).tolist()
    varying = [last]
    if last == SCENE:
        varying = [name for name in given(dataset.coords) if np.unique(dataset[name].values).size > 1]
    scenes = []
    for place, item in enumerate(items):
        scene = first.isel({last: item})
        label = ", ".join(equation(name, scene[name].item()) for name in varying[:2]) or f"scene {item}"
        scenes.append(_scene(scene, label, to_rgb(looks.colours(0.75 * place / (len(items) - 1))), place))
    caption += [f"{SCENES} of {size} scenes"] if size > SCENES else []
    return scenes, [*caption, *slope_warnings(dataset)]


def _scene(scene: xarray.Dataset, label: str, colour: Colour | None, item: int = 0) -> Scene:
    """Make a scene; one that has no value is grey and says so."""
    names = [name + end for track in TRACKS for name in track.variables.values() for end in ("", SI)]
    if label and not any(np.isfinite(scene[name].values).any() for name in names if name in scene):
        label, colour = f"{label} (no value)", to_rgb(CROSS)
    scene = scene.load()
    doubts = doubts_in(scene["status"].values, "path", scene)
    return Scene(label=label, colour=colour, values=scene, doubts=doubts, item=item)


def _draw_panel(
    axes: Axes, plane: Plane, tracks: Sequence[Track], scenes: Sequence[Scene], points: Points | None, looks: Looks
) -> None:
    """Draw the lines of all scenes into a panel, measured points below them, and mark where depth and load are zero."""
    for track in tracks:
        for scene in scenes:
            colour = scene.colour_of(track)
            draw_track(axes, track, scene.values, plane, colour)
            if scene.colour:
                start = MARKED * (0.15 + scene.item / len(MARKERS))  # beside those of the scene before
                marker = MARKERS[scene.item % len(MARKERS)]
                own = points_of(track, scene.values, plane)
                draw_marks(axes, own, (start, MARKED), marker=marker, ms=3.2, color=colour, mew=0.0)
            if track.curve == "path" and not track.unloading:
                draw_doubts(axes, track, scene.values, plane, scene.doubts, colour)
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
        fit_heights(axes)
    suit(axes, "y", tracks[0].variables[up], looks.ylim)


def _handles(scenes: Sequence[Scene], tracks: Sequence[Track]) -> list[Artist]:
    """Make the entries of the legend."""

    def entry(label: str, colour: Colour, dash: Dash = "-", width: float = 1.6) -> Line2D:
        return Line2D([], [], color=colour, ls=dash, lw=width, label=label)

    made: list[Artist] = []
    for scene in scenes:
        if scene.colour:
            line = entry(scene.label, scene.colour)
            line.set(marker=MARKERS[scene.item % len(MARKERS)], ms=3.2, mew=0.0)
            made.append(line)
    inked = bool(made)
    for track in tracks:
        colour = INK if inked else track.colour
        made.append(entry(track.label, colour, track.dash, track.width))
        if any(track.falls(scene.values).any() for scene in scenes):
            words = track.label.replace(", stable", "") + ", unstable"
            made.append(entry(words, faded(colour), track.dash, track.width))
    if any(track.jumps(scene.values).any() for track in tracks for scene in scenes):
        made.append(entry("jump", INK, JUMP, THIN))
    if any(track.curve == "path" for track in tracks):
        found = [doubt for doubt in DOUBTS if any(doubt in scene.doubts for scene in scenes)]
        made += entries(found, in_map=False, gaps=False)
    return made
