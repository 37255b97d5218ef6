"""What a picture of curves draws: lines, of which scenes, and measured points; how each looks and is drawn."""

from collections.abc import Collection, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

import numpy as np
import xarray
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, to_rgb
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.scenes import SCENE
from gradhesion.cli.picture.labels import Values, equations, fixed, given, suit
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.pictured import make_room
from gradhesion.cli.picture.shown import CROSS, DOUBTS, INK, Doubt, doubts_in, entries

Colour = tuple[float, float, float]
Steps = NDArray[np.bool_]
Dash = str | tuple[float, tuple[float, ...]]
Plane = tuple[str, str]
Points = Mapping[str, Values]
"""Measured points by the quantity, in SI units or as the curves have them."""
MARKERS: Final = ("o", "s", "D", "P", "X")
"""What distinguishes scenes where colours do not print; more of them could not be distinguished."""
JUMP: Final[Dash] = (0, (3, 2))
THIN: Final = 0.8
"""The dash of a jump, and its width in points."""
ARROW: Final = 0.06
FEWEST: Final = 0.1
"""The length of an arrow on a line, and of the part of a line that has room for one, over the side of a panel."""
APART: Final = 0.12
MARKED: Final = 0.22
"""How far apart the marks of doubts and of scenes stand along a line, in diagonals of the panel."""
FEW: Final = 60
"""Measured points that are circles."""
CIRCLES: Final[dict[str, Any]] = {"mfc": "white", "mec": "0.1", "mew": 0.5, "ms": 2.8, "zorder": 3}
DOTS: Final[dict[str, Any]] = {"mfc": "0.6", "mec": "none", "ms": 2.6, "zorder": 1.8, "rasterized": True}
QUANTITIES: Final = {
    "contact_radius": ("contact_radius", "radius", "a"),
    "indentation": ("indentation", "depth", "delta"),
    "load": ("load", "force", "P"),
}
"""What a panel may have along or up, and what a column of measured points may be called."""


class Scene(NamedTuple):
    """One scene of a dataset: its colour (None if it is the only one), its marker, and what makes it doubtful."""

    label: str
    colour: Colour | None
    marker: str
    values: xarray.Dataset
    doubts: Sequence[Doubt]


def scenes_of(dataset: xarray.Dataset, looks: Looks, drawn: Collection[str]) -> tuple[list[Scene], list[str]]:
    """Choose the scenes to draw, along the last axis with more than one value, and write what they have in common.

    One of which no variable that is drawn has a value is grey and named so; DatasetError says that none has.
    """
    dims = [str(axis) for axis in dataset["status"].dims]
    last = next((axis for axis in reversed(dims) if dataset.sizes[axis] > 1), None)
    some = dataset.isel({axis: 0 for axis in dims if axis != last})
    varying = [last] if last else []
    if last == SCENE:
        varying = [name for name in given(some.coords) if np.unique(some[name].values).size > 1]
    caption = [*fixed(some.isel({last: [0]} if last else {}), dataset, varying)]
    size = dataset.sizes[last] if last else 1
    items = np.unique(np.linspace(0, size - 1, min(size, len(MARKERS))).round().astype(int)).tolist()
    scenes = []
    for place, item in enumerate(items):
        scene = finite(some.isel({last: item}) if last else some)
        colour = to_rgb(looks.colours(0.75 * place / (len(items) - 1))) if last else None
        label = ", ".join(equations(name, scene[name].item())[0] for name in varying[:2]) or f"scene {item}"
        if not any(scene[name].notnull().any() for name in drawn):
            label, colour = f"{label} (no value)", to_rgb(CROSS)
        doubts = doubts_in(scene["status"].values, "path", scene)
        scenes.append(Scene(label, colour, MARKERS[place], scene, doubts))
    if all(scene.label.endswith("(no value)") for scene in scenes):
        raise DatasetError("no value in any scene drawn; `gradhesion info` reports why")
    return scenes, caption + ([f"{len(MARKERS)} of {size} scenes"] if size > len(MARKERS) else [])


def finite(scene: xarray.Dataset) -> xarray.Dataset:
    """Load a scene, with NaN where a value has no place on an axis: it leaves a gap."""
    return scene.load().map(lambda one: one.where(np.isfinite(one)) if one.dtype.kind == "f" else one)


def faded(colour: Colour) -> Colour:
    """Fade a colour to white."""
    red, green, blue = (0.6 + 0.4 * one for one in colour)
    return red, green, blue


def flagged(scene: xarray.Dataset, name: str, count: int = 1) -> Steps:
    """Report which of the points of a curve have a flag; none if the dataset does not know."""
    return scene[name].values == 1 if name in scene else np.zeros(count, bool)


@dataclass(frozen=True)
class Track:
    """One line: its curve, what the names of its variables begin and end with, and how it looks."""

    curve: str
    label: str
    stem: str
    dash: Dash
    width: float
    shade: float
    """Where its colour is in a colour map, from dark to light, unless colours distinguish scenes."""
    unloading: bool | None = None
    """Whether it is the loading or the unloading part of its curve, if it is a part."""
    end: str = ""

    @property
    def variables(self) -> Mapping[str, str]:
        """Name its variables by the quantity that each is; both envelopes are known at the same radii."""
        radius = "envelope_" if self.curve == "envelope" else self.stem
        stems = dict.fromkeys(QUANTITIES, self.stem) | {"contact_radius": radius}
        return {quantity: stem + quantity + self.end for quantity, stem in stems.items()}

    def colour(self, colours: Colormap) -> Colour:
        """Give its colour where colours do not distinguish scenes; that of the smooth punch is grey."""
        return to_rgb("0.55" if self.curve == "smooth" else colours(self.shade))

    def points(self, scene: xarray.Dataset, plane: Plane) -> Values:
        """Give its points in a plane, along and up; NaN where there is none."""
        return np.stack([scene[self.variables[quantity]].values for quantity in plane])

    def falls(self, scene: xarray.Dataset) -> Steps:
        """Report which steps from point to point are unstable: the depth of an equilibrium falls."""
        name = self.variables["indentation"]
        known = self.curve.endswith("equilibrium") and name in scene
        return np.diff(scene[name].values) < 0.0 if known else np.zeros(1, bool)

    def draw(self, axes: Axes, scene: xarray.Dataset, points: Values, colour: Colour) -> None:
        """Draw the line of a scene through its points; jumps are thin and dashed, unstable parts light."""
        jumps, falls = flagged(scene, f"{self.curve}_jump", points.shape[1])[1:], self.falls(scene)
        own = np.ones(points.shape[1] - 1, bool)
        if self.unloading is not None and "path_unloading" in scene:
            own = flagged(scene, "path_unloading")[1:] == self.unloading
        for steps, dash, width, tone in (
            (own & jumps, JUMP, THIN, colour),
            (own & falls & ~jumps, self.dash, self.width, faded(colour)),
            (own & ~falls & ~jumps, self.dash, self.width, colour),
        ):
            if steps.any():
                kept = np.insert(points, np.flatnonzero(~steps) + 1, np.nan, axis=1)  # gaps for the others
                axes.plot(*kept, ls=dash, lw=width, color=tone, solid_capstyle="butt")

    def draw_arrows(self, axes: Axes, scene: xarray.Dataset, points: Values, colour: Colour, taken: list[Any]) -> None:
        """Put an arrow on each jump of a path, and on each part between two of them, where it has room.

        The limits of the panel must stand. An arrow gives way to those of `taken`, the places in the panel of others.
        """
        places = (axes.transData - axes.transAxes).transform(points.T)
        ways, jumps = (flagged(scene, name, len(places))[1:] for name in ("path_unloading", f"{self.curve}_jump"))
        looks = {"arrowstyle": "-|>", "color": colour, "lw": 0.0, "shrinkA": 0.0, "shrinkB": 0.0, "mutation_scale": 8.0}
        for run in np.split(np.arange(ways.size), np.flatnonzero(np.diff(ways) | jumps[1:] | jumps[:-1]) + 1):
            line = places[run[0] : run[-1] + 2]
            lengths = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
            if not lengths[-1] > FEWEST or self.unloading not in (None, bool(ways[run[0]])):
                continue
            ends = 0.5 * lengths[-1] + np.array([-0.5, 0.5]) * ARROW
            tail, head = np.stack([np.interp(ends, lengths, row) for row in line.T], axis=1)
            inside = min(*tail, *head) >= 0.0 and max(*tail, *head) <= 1.0
            if inside and all(np.hypot(*(head - other)) > ARROW for other in taken):
                taken.append(head)
                axes.annotate("", tuple(head), tuple(tail), "axes fraction", "axes fraction", arrowprops=looks)


TRACKS: Final = (
    Track("smooth", "without waviness", "smooth_", (0, (7, 2)), 0.8, 0.9),
    Track("envelope", "loading envelope", "loading_envelope_", (0, (5, 1.5, 1, 1.5)), 0.9, 0.75),
    Track("envelope", "unloading envelope", "unloading_envelope_", (0, (5, 1.5, 1, 1.5, 1, 1.5)), 0.9, 0.6),
    Track("closing_equilibrium", "equilibrium, closing", "closing_", (0, (6, 1)), 0.9, 0.55),
    Track("equilibrium", "equilibrium, stable", "", "-", 0.9, 0.4),
    Track("asymptotic", "asymptotic", "asymptotic_", (0, (1, 1.2)), 1.0, 0.7),
    Track("effective", "effective path", "effective_", (0, (3, 1)), 1.1, 0.3),
    Track("path", "loading", "path_", "-", 2.6, 0.75, unloading=False),
    Track("path", "unloading", "path_", "-", 1.3, 0.0, unloading=True),
)
"""Every line of a single scene, those on top last: loading is wider, so that unloading does not hide it."""
TRACKS_OF_MANY: Final = (
    *(replace(track, width=0.75 * track.width) for track in TRACKS if track.curve != "path"),
    Track("path", "path", "path_", "-", 1.2, 0.0),
)
"""Every line where there are several scenes: finer, and the path in one."""


def tracks_in(names: Container[Any], *, si: bool, many: bool = False) -> list[Track]:
    """List the lines of which two variables are among some names, in SI units or without, for one scene or many."""
    known = [replace(track, end=SI if si else "") for track in (TRACKS_OF_MANY if many else TRACKS)]
    return [track for track in known if sum(name in names for name in track.variables.values()) > 1]


def draw_panel(
    axes: Axes, plane: Plane, tracks: Sequence[Track], scenes: Sequence[Scene], looks: Looks, points: Points
) -> None:
    """Draw the lines of all scenes into a panel, measured points, lines of zero, and arrows along the paths."""
    along, up = plane
    lines = [
        (track, scene, track.points(scene.values, plane), scene.colour or track.colour(looks.colours))
        for track in tracks
        for scene in scenes
    ]
    for track, scene, own, colour in lines:
        track.draw(axes, scene.values, own, colour)
        if scene.colour:
            start = MARKED * (0.15 + MARKERS.index(scene.marker) / len(MARKERS))  # beside those of the scene before
            _draw_marks(axes, own, start, MARKED, color=colour, marker=scene.marker, ms=3.2, mew=0.0)
        if track.curve == "path" and not track.unloading:
            loading = own[:, ~flagged(scene.values, "path_unloading", own.shape[1])]
            for doubt in reversed(scene.doubts):  # the larger ones below
                _draw_marks(axes, loading, 0.5 * APART, APART, mew=0.8, **doubt.marker(colour))
    if {*plane} <= points.keys():
        axes.plot(points[along], points[up], **looks_of_points(points))
    axes.axhline(0.0, color="0.85", lw=0.6, zorder=0)
    if along == "contact_radius":
        axes.set_xlim(left=0.0)
    else:
        axes.axvline(0.0, color="0.85", lw=0.6, zorder=0)
    suit(axes, "x", tracks[0].variables[along], looks.xlim)
    if looks.xlim and not looks.ylim:  # the heights suit what is drawn between these limits
        first, last = axes.get_xlim()
        drawn = [line.get_path().interpolated(20).vertices for line in axes.lines if line.get_zorder() > 0.0]
        places = np.vstack([np.empty((0, 2)), *drawn])
        make_room(axes, "y", places[(places[:, 0] >= first) & (places[:, 0] <= last), 1])
    suit(axes, "y", tracks[0].variables[up], looks.ylim)
    arrows: list[Any] = []
    for track, scene, own, colour in lines:
        if track.curve == "path":
            track.draw_arrows(axes, scene.values, own, colour, arrows)


def looks_of_points(points: Points) -> dict[str, Any]:
    """Give the looks of measured points: circles on top of the lines, or dots below that many of them hide less."""
    few = next(iter(points.values())).size <= FEW
    return {"ls": "", "marker": "o", "label": "measured"} | (CIRCLES if few else DOTS)


def _draw_marks(axes: Axes, points: Values, start: float, apart: float, **looks: Any) -> None:
    """Put markers along a line, evenly in the panel: from where on, and how far apart, in its diagonals."""
    if np.isfinite(points).all(axis=0).any():  # matplotlib fails to mark a line without a point
        axes.plot(*points, **({"markevery": (start, apart), "ls": ""} | looks))


def legend_of(scenes: Sequence[Scene], tracks: Sequence[Track], looks: Looks, points: Points) -> Iterator[Artist]:
    """Make the entries of the legend."""

    def entry(label: str, colour: Any, dash: Dash = "-", width: float = 1.6, **more: Any) -> Line2D:
        return Line2D([], [], color=colour, ls=dash, lw=width, label=label, **more)

    coloured = [scene for scene in scenes if scene.colour]
    for scene in coloured:
        yield entry(scene.label, scene.colour, marker=scene.marker, ms=3.2, mew=0.0)
    for track in tracks:
        colour = to_rgb(INK) if coloured else track.colour(looks.colours)
        yield entry(track.label, colour, track.dash, track.width)
        if any(track.falls(scene.values).any() for scene in scenes):
            yield entry(track.label.replace(", stable", "") + ", unstable", faded(colour), track.dash, track.width)
    if any(flagged(scene.values, f"{track.curve}_jump")[1:].any() for track in tracks for scene in scenes):
        yield entry("jump", INK, JUMP, THIN)
    if any(track.curve == "path" for track in tracks):
        yield from entries([doubt for doubt in DOUBTS.values() if any(doubt in scene.doubts for scene in scenes)])
    if points:
        yield Line2D([], [], **looks_of_points(points))
