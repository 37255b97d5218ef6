"""What a picture of curves draws: lines, of which scenes, and measured points; how each looks and is drawn."""

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, to_rgb
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.scenes import SCENE
from gradhesion.cli.picture.labels import equations, fixed, given
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.pictured import MARKERS
from gradhesion.cli.picture.shown import CROSS, Doubt, doubts_in
from gradhesion.cli.study.text.quantities import factor_of_column, scaled
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.wording import shown

Values = NDArray[np.float64]
Steps = NDArray[np.bool_]
Colour = tuple[float, float, float]
Dash = str | tuple[float, tuple[float, ...]]
Plane = tuple[str, str]
JUMP: Final[Dash] = (0, (3, 2))
THIN: Final = 0.8
"""The dash of a jump, and its width in points."""
ARROW: Final = 0.06
FEWEST: Final = 0.1
"""The length of an arrow on a line, and of the part of a line that has room for one, over the side of a panel."""


def faded(colour: Colour) -> Colour:
    """Fade a colour to white."""
    red, green, blue = (0.6 + 0.4 * one for one in colour)
    return red, green, blue


def flagged(scene: xarray.Dataset, name: str, count: int = 1) -> Steps:
    """Report which of the points of a curve have a flag; none if the dataset does not know."""
    return scene[name].values == 1 if name in scene else np.zeros(count, bool)


@dataclass(frozen=True)
class Track:
    """One line: its curve, the variables that give its points, and how it looks."""

    curve: str
    label: str
    stem: str
    """What the names of its variables begin with."""
    dash: Dash
    width: float
    shade: float
    """Where its colour is in a colour map, from dark to light, unless colours distinguish scenes."""
    unloading: bool | None = None
    """Whether it is the loading or the unloading part of its curve, if it is a part."""
    end: str = ""
    """What the names of its variables end with: those in SI units have one."""

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

    def draw(self, axes: Axes, scene: xarray.Dataset, plane: Plane, colour: Colour) -> None:
        """Draw one line of a scene; its jumps are thin and dashed, its unstable parts light."""
        points = self.points(scene, plane)
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

    def draw_arrows(self, axes: Axes, scene: xarray.Dataset, plane: Plane, colour: Colour, taken: list[Values]) -> None:
        """Put an arrow on each jump of a path, and on each part between two of them, where it has room.

        The limits of the panel must stand. An arrow gives way to those of `taken`, the places in the panel of others.
        """
        places = (axes.transData - axes.transAxes).transform(self.points(scene, plane).T)
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


def tracks_in(names: Container[Any], tracks: Sequence[Track], *, si: bool) -> list[Track]:
    """List the lines of which two variables are among some names, in SI units or without."""
    known = [replace(track, end=SI if si else "") for track in tracks]
    return [track for track in known if sum(name in names for name in track.variables.values()) > 1]


SCENES: Final = len(MARKERS)
"""Scenes in one picture: more could not be distinguished."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """One scene of a dataset: its colour (None: each line has its own), what makes it doubtful, and its marker."""

    label: str
    colour: Colour | None
    values: xarray.Dataset
    doubts: Sequence[Doubt]
    item: int

    @property
    def marker(self) -> dict[str, Any]:
        """Give what distinguishes it in a grey print."""
        return {"marker": MARKERS[self.item], "ms": 3.2, "mew": 0.0}


def scenes_of(dataset: xarray.Dataset, looks: Looks) -> tuple[list[Scene], list[str]]:
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
        scene = finite(some.isel({last: item}) if last else some)
        colour = to_rgb(looks.colours(0.75 * place / (len(items) - 1))) if last else None
        label = ", ".join(equations(name, scene[name].item())[0] for name in varying[:2]) or f"scene {item}"
        names = [name + end for track in TRACKS for name in track.variables.values() for end in ("", SI)]
        if not any(np.isfinite(scene[name].values).any() for name in names if name in scene):
            label, colour = f"{label} (no value)", to_rgb(CROSS)
        doubts = doubts_in(scene["status"].values, "path", scene)
        scenes.append(Scene(label=label, colour=colour, values=scene, doubts=doubts, item=place))
    caption += [f"{SCENES} of {size} scenes"] if size > SCENES else []
    return scenes, [*caption, *slope_warnings(dataset)]


def finite(scene: xarray.Dataset) -> xarray.Dataset:
    """Load a scene, with NaN where a value has no place on an axis: it leaves a gap."""
    return scene.load().map(lambda one: one.where(np.isfinite(one)) if one.dtype.kind == "f" else one)


QUANTITIES: Final = {
    "contact_radius": ("contact_radius", "radius", "a"),
    "indentation": ("indentation", "depth", "delta"),
    "load": ("load", "force", "P"),
}
"""What a panel may have along or up, and what a column of measured points may be called."""
FEW: Final = 60
"""Points that are circles on top of the lines; more are grey dots below them, which would hide the lines."""
CIRCLES: Final[dict[str, Any]] = {"mfc": "white", "mec": "0.1", "mew": 0.5, "ms": 2.8, "zorder": 3}
DOTS: Final[dict[str, Any]] = {"mfc": "0.6", "mec": "none", "ms": 2.6, "zorder": 1.8, "rasterized": True}


class Points(NamedTuple):
    """Measured points, by the quantity, in SI units or as the curves have them; their looks; and what was left out."""

    values: Mapping[str, Values]
    looks: Mapping[str, Any]
    left_out: str


def read_points(file: Path, planes: Sequence[Plane], *, si: bool) -> Points:
    """Read measured points for a picture with some planes, from a table (CSV or NetCDF).

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
    count = int(np.count_nonzero(~sound))
    left_out = f"{file}: {counted(count, 'row')} left out, without a number in each column" if count else ""
    looks = {"ls": "", "marker": "o", "label": "measured"} | (CIRCLES if sound.sum() <= FEW else DOTS)
    return Points({name: row[sound] for name, row in values.items()}, looks, left_out)


def _scaled(found: Columns, quantity: str, word: str, *, si: bool) -> Values:
    """Give a column in the units of the dataset; a radius is a length as a depth is."""
    if si:
        key = "load" if quantity == "load" else "indentation"
        return scaled(found.values[word], factor_of_column(found, word, key))
    if unit := found.units.get(word):
        remedy = "give the study its units, or write the ratio without one"
        raise ColumnsError(f"{word} [{unit}] has a unit, and the curves have none; {remedy}")
    return found.values[word]
