"""The picture of a curve dataset: load over depth, depth over contact radius, load over contact radius."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Final

import xarray
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import RAGGED, STATE_CURVES, variables_of_curves
from gradhesion.cli.picture.curves.axes import (
    axis_label,
    in_si,
    in_unit,
    in_units,
    set_limits,
    spans_of,
    units_of,
    wants_si,
)
from gradhesion.cli.picture.curves.measured import Points, draw_points, legend_entry, planes_of, read_points
from gradhesion.cli.picture.curves.panels import (
    JUMP,
    MARKERS,
    THIN,
    TRACKS,
    TRACKS_OF_MANY,
    Colour,
    Dash,
    Track,
    Values,
    coloured,
    draw_arrows,
    draw_doubt,
    draw_marks,
    draw_track,
    faded,
    falls_of,
    jumps_of,
)
from gradhesion.cli.picture.curves.scenes import Scene, scenes_of
from gradhesion.cli.picture.curves.states import draw_states
from gradhesion.cli.picture.doubts import DOUBTS, entries
from gradhesion.cli.picture.inset import add_inset
from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import heading, in_lines, lay_out, styled
from gradhesion.cli.terminal.wording import did_you_mean

QUANTITIES: Final = ("contact_radius", "indentation", "load")
"""What a panel may have along or up."""

PLANES: Final = (("indentation", "load"), ("contact_radius", "indentation"), ("contact_radius", "load"))
"""What each panel has along and up, unless that is chosen."""

NARROW: Final = 1.7
"""The width of a panel, in inches, below which panels stand below each other if a width is given."""

INK: Final = to_rgb("0.25")
"""The colour of lines in a legend where colours distinguish scenes."""


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
    _check(looks)
    planes = _planes(x, y)
    chosen = _chosen(dataset, requested)
    of_states = [curve for curve in chosen if curve in STATE_CURVES]
    if of_states == chosen:
        if data is not None:
            raise DatasetError(
                f"--data {data}: measured points go on curves over contact radius, depth and load, and this picture "
                "has curves of states; ask for others with --variable, as in --variable path"
            )
        if x or y:
            raise DatasetError(
                f"--{'x' if x else 'y'} {x or y}: curves of states are drawn over the distance from the axis; "
                f"leave it out, or choose the panel with --variable, as in --variable {chosen[0]}"
            )
        looks.refuse(["xlim", "ylim", "inset"], "curves of states are drawn whole")
        return draw_states(dataset, chosen, looks)
    if of_states and requested:
        other = next(curve for curve in chosen if curve not in of_states)
        raise DatasetError(
            f"--variable {of_states[0]} is drawn over the distance from the axis, and {other} is not: they have no "
            "axis in common; draw one after the other"
        )
    chosen = [curve for curve in chosen if curve not in of_states]
    scenes, caption = scenes_of(dataset, looks)
    known = coloured(TRACKS_OF_MANY if len(scenes) > 1 else TRACKS, looks.colours)
    si = wants_si(map(str, dataset.data_vars), requested)
    known = tuple(in_si(track) for track in known) if si else known
    points = None if data is None else read_points(data, si=si)
    panels = []
    for along, up in planes:
        there = [
            one for one in known if one.curve in chosen and {getattr(one, along), getattr(one, up)} <= dataset.keys()
        ]
        if there:
            panels.append((along, up, there))
    if not panels and (x or y):
        wanted = " ".join(f"--{side} {name}" for side, name in (("x", x), ("y", y)) if name)
        raise DatasetError(
            f"{wanted}: {', '.join(chosen)} of this dataset {'has' if len(chosen) == 1 else 'have'} no such plane; "
            f'leave it out, or name whole curves in the outputs of the study, as in outputs = ["{chosen[0]}"]'
        )
    if not panels:
        raise DatasetError(
            f"{', '.join(chosen)}: a picture needs two of contact radius, indentation and load, and this dataset has "
            f'not; name whole curves in the outputs of the study, as in outputs = ["{chosen[0]}"]'
        )
    tracks = [track for track in known if any(track in there for _, _, there in panels)]
    if not any(values.size for scene in scenes for values in scene.values.values()):
        raise DatasetError("no value in any scene drawn; `gradhesion info` reports why")
    if points is not None:
        planes_of(points, [(along, up) for along, up, _ in panels])
        for note in points.notes:
            notes(note)
    planes = [(along, up) for along, up, _ in panels]
    units = units_of(tracks, [scene.values for scene in scenes], spans_of(looks, planes))
    spans = in_units(looks, planes, units)
    scenes = [replace(scene, values=in_unit(tracks, scene.values, units)) for scene in scenes]
    with styled(looks):
        width = looks.width or max(4.0, 2.5 * len(panels))
        below = len(panels) if width < NARROW * len(panels) else 1
        handles = [*_handles(scenes, tracks), *([legend_entry()] if points else [])]
        rows = -(-len(handles) // max(1, int(width / 1.7)))
        columns = -(-len(handles) // rows)
        more = 0.16 * (rows - 1)
        figure = Figure(figsize=(width, looks.height or 2.4 * below + 1.1 + more), layout="constrained")
        grid = figure.subplots(below, len(panels) // below, squeeze=False).ravel()
        for axes, (along, up, there) in zip(grid, panels, strict=True):
            again = partial(_draw_panel, plane=(along, up), tracks=there, scenes=scenes, units=units, points=points)
            again(axes)
            set_limits(axes, [getattr(there[0], one) for one in (along, up)], spans)
            arrows: list[Values] = []
            for track in there:
                for scene in scenes:
                    draw_arrows(axes, track, scene.values, along, up, scene.colour or track.colour, arrows)
        figure.legend(handles=handles, loc="outside lower center", ncols=columns)
        words = [heading(dataset) if looks.title else "", in_lines(caption, width) if looks.caption else ""]
        if any(words):
            figure.suptitle("\n".join(filter(None, words)), fontsize="medium", wrap=True)
        if looks.width or looks.height or looks.inset:
            lay_out(figure)
        if looks.inset:
            add_inset(axes, again, spans["inset"], getattr(tracks[0], along), Unit(), Unit())
    return figure


def _draw_panel(
    axes: Axes,
    plane: tuple[str, str],
    tracks: Sequence[Track],
    scenes: Sequence[Scene],
    units: Mapping[str, Unit],
    points: Points | None,
) -> None:
    """Draw the lines of all scenes into a panel."""
    along, up = plane
    for track in tracks:
        for scene in scenes:
            draw_track(axes, track, scene.values, along, up, scene.colour or track.colour)
            if scene.colour:
                draw_marks(axes, track, scene.values, along, up, scene.colour, scene.item)
            if track.curve == "path" and not track.unloading:
                for doubt in reversed(scene.doubts):  # the larger ones below
                    draw_doubt(axes, track, scene.values, along, up, scene.colour or track.colour, doubt)
    _dress(axes, along, up, units)
    if points is not None:
        draw_points(axes, points, along, up, units)


def _check(looks: Looks) -> None:
    """Refuse what curves do not have."""
    if looks.kind == "map":
        raise DatasetError("--map: curves are drawn as lines; leave it out")
    if looks.levels is not None:
        raise DatasetError("--levels: contour levels are for a map, and curves have none; leave them out")
    looks.refuse(["band"], "curves have no spread")


def _planes(x: str | None, y: str | None) -> Sequence[tuple[str, str]]:
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
        made.append(entry(track.label, INK if inked else track.colour, track.dash, track.width))
        if any(falls_of(track, scene.values).any() for scene in scenes):
            name = "closing" if track.curve.startswith("closing") else "equilibrium"
            made.append(entry(f"{name}, unstable", faded(INK if inked else track.colour), track.dash, track.width))
    if any(jumps_of(track, scene.values).any() for track in tracks for scene in scenes):
        made.append(entry("jump", INK, JUMP, THIN))
    if any(track.curve == "path" for track in tracks):
        found = [doubt for doubt in DOUBTS if any(doubt in scene.doubts for scene in scenes)]
        made += entries(found, in_map=False, gaps=False)
    return made


def _dress(axes: Axes, x: str, y: str, units: Mapping[str, Unit]) -> None:
    """Label a panel, and mark where depth and load are zero."""
    axes.set_xlabel(axis_label(x, units[x]))
    axes.set_ylabel(axis_label(y, units[y]))
    axes.axhline(0.0, color="0.85", lw=0.6, zorder=0)
    if x == "indentation":
        axes.axvline(0.0, color="0.85", lw=0.6, zorder=0)
    else:
        axes.set_xlim(left=0.0)
    axes.locator_params(nbins=5)
