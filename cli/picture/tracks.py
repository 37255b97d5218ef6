"""The lines of a dataset of curves, and measured points: which there are, how each looks, how it is drawn."""

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, to_rgb
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.picture.pictured import finite
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

QUANTITIES: Final = ("contact_radius", "indentation", "load")
"""What a panel may have along or up."""

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


def unloads(scene: xarray.Dataset, count: int) -> Steps:
    """Report which of the points of a path are on unloading; none if the dataset does not know."""
    return scene["path_unloading"].values == 1 if "path_unloading" in scene else np.zeros(count, bool)


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
        return np.stack([finite(scene[self.variables[quantity]].values) for quantity in plane])

    def falls(self, scene: xarray.Dataset) -> Steps:
        """Report which steps from point to point are unstable: the depth of an equilibrium falls."""
        name = self.variables["indentation"]
        known = self.curve.endswith("equilibrium") and name in scene
        return np.diff(finite(scene[name].values)) < 0.0 if known else np.zeros(1, bool)

    def jumps(self, scene: xarray.Dataset) -> Steps:
        """Report which steps from point to point are jumps; none if the dataset does not know."""
        flag = f"{self.curve}_jump"
        return scene[flag].values[1:] == 1 if flag in scene else np.zeros(1, bool)

    def draw(self, axes: Axes, scene: xarray.Dataset, plane: Plane, colour: Colour) -> None:
        """Draw one line of a scene; its jumps are thin and dashed, its unstable parts light."""
        points = self.points(scene, plane)
        jumps, falls = self.jumps(scene), self.falls(scene)
        own = np.ones(points.shape[1] - 1, bool)
        if self.unloading is not None and "path_unloading" in scene:
            own = unloads(scene, 0)[1:] == self.unloading
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
        ways = unloads(scene, len(places))[1:]
        jumps = np.broadcast_to(self.jumps(scene), ways.shape)
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


COLUMNS: Final = {
    "contact_radius": ("contact_radius", "radius", "a"),
    "indentation": ("indentation", "depth", "delta"),
    "load": ("load", "force", "P"),
}
"""What a column of each quantity may be called."""

KEYS: Final = {"contact_radius": "c0", "indentation": "indentation", "load": "load"}
"""For each quantity a key of its dimension."""

FEW: Final = 60
"""Points that are circles on top of the lines; more are grey dots below them, which would hide the lines."""

CIRCLES: Final[dict[str, Any]] = {"mfc": "white", "mec": "0.1", "mew": 0.5, "ms": 2.8, "zorder": 3}
DOTS: Final[dict[str, Any]] = {"mfc": "0.6", "mec": "none", "ms": 2.6, "zorder": 1.8, "rasterized": True}


@dataclass(frozen=True, kw_only=True, eq=False)
class Points:
    """Measured points."""

    values: Mapping[str, Values]
    """By the quantity, in SI units or, of a picture without, as the dataset has them."""
    notes: tuple[str, ...] = ()
    """What was left out."""

    @property
    def looks(self) -> dict[str, Any]:
        """How they look."""
        few = next(iter(self.values.values())).size <= FEW
        return {"ls": "", "marker": "o", "label": "measured"} | (CIRCLES if few else DOTS)


def read_points(file: Path, planes: Sequence[tuple[str, str]], *, si: bool) -> Points:
    """Read measured points for a picture with some planes, from a table (CSV or NetCDF).

    It has two or more of the columns indentation, load (positive presses) and contact_radius; other columns are left
    aside, and so are rows without a number. The header has units if the picture has; else the columns are delta/R,
    P/(1.5 pi R dgamma) and a/R.
    """
    try:
        found = read_columns(file, only=[word for own in COLUMNS.values() for word in own])
        there = {quantity: word for quantity, own in COLUMNS.items() for word in reversed(own) if word in found.values}
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
    left_out = int(np.count_nonzero(~sound))
    note = f"{file}: {counted(left_out, 'row')} left out, without a number in each column"
    return Points(values={name: row[sound] for name, row in values.items()}, notes=(note,) if left_out else ())


def _scaled(found: Columns, quantity: str, word: str, *, si: bool) -> Values:
    """Give a column in the units of the dataset."""
    if si:
        return scaled(found.values[word], factor_of_column(found, word, KEYS[quantity]))
    if unit := found.units.get(word):
        remedy = "give the study its units, or write the ratio without one"
        raise ColumnsError(f"{word} [{unit}] has a unit, and the curves have none; {remedy}")
    return found.values[word]
