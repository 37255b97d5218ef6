"""The lines of a dataset of curves: which there are, how each looks, and how it is drawn into a panel."""

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, to_rgb
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import SI
from gradhesion.cli.picture.looks import PLAIN
from gradhesion.cli.picture.pictured import finite

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


@dataclass(frozen=True, kw_only=True)
class Track:
    """One line: its curve, the variables that give its points, and how it looks."""

    curve: str
    label: str
    variables: Mapping[str, str]
    """Its variables by the quantity that each is."""
    dash: Dash
    width: float
    colour: Colour
    """Its colour where colours do not distinguish scenes."""
    shade: float | None
    """Where that is among the colours of a colour map; None: it is grey in all."""
    unloading: bool | None = None
    """Whether it is the loading or the unloading part of its curve, if it is a part."""

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


def _track(
    curve: str, label: str, stem: str, dash: Dash, width: float, shade: float, *, unloading: bool | None = None
) -> Track:
    """Make a track whose variables have a common stem; the lighter, the higher its shade from 0 to 1."""
    radius = "envelope_" if curve == "envelope" else stem  # both envelopes are known at the same radii
    return Track(
        curve=curve,
        label=label,
        variables={name: (radius if name == "contact_radius" else stem) + name for name in QUANTITIES},
        dash=dash,
        width=width,
        colour=to_rgb("0.55" if curve == "smooth" else PLAIN.colours(shade)),
        shade=None if curve == "smooth" else shade,
        unloading=unloading,
    )


TRACKS: Final = (
    _track("smooth", "without waviness", "smooth_", (0, (7, 2)), 0.8, 0.9),
    _track("envelope", "loading envelope", "loading_envelope_", (0, (5, 1.5, 1, 1.5)), 0.9, 0.75),
    _track("envelope", "unloading envelope", "unloading_envelope_", (0, (5, 1.5, 1, 1.5, 1, 1.5)), 0.9, 0.6),
    _track("closing_equilibrium", "equilibrium, closing", "closing_", (0, (6, 1)), 0.9, 0.55),
    _track("equilibrium", "equilibrium, stable", "", "-", 0.9, 0.4),
    _track("asymptotic", "asymptotic", "asymptotic_", (0, (1, 1.2)), 1.0, 0.7),
    _track("effective", "effective path", "effective_", (0, (3, 1)), 1.1, 0.3),
    _track("path", "loading", "path_", "-", 2.6, 0.75, unloading=False),
    _track("path", "unloading", "path_", "-", 1.3, 0.0, unloading=True),
)
"""Every line of a single scene, those on top last: loading is wider, so that unloading does not hide it."""

TRACKS_OF_MANY: Final = tuple(
    replace(track, width=0.75 * track.width)
    if track.unloading is None
    else replace(track, width=1.2, label="path", unloading=None)
    for track in TRACKS
    if track.unloading is not True
)
"""Every line where there are several scenes: finer, and the path in one."""


def tracks_in(
    names: Container[Any], tracks: Sequence[Track], *, si: bool, colours: Colormap | None = None
) -> list[Track]:
    """List the lines of which two variables are among some names, in SI units or without, in the colours of a map."""
    found = []
    for track in tracks:
        own = {quantity: name + (SI if si else "") for quantity, name in track.variables.items()}
        colour = track.colour if colours is None or track.shade is None else to_rgb(colours(track.shade))
        if sum(name in names for name in own.values()) > 1:
            found.append(replace(track, variables=own, colour=colour))
    return found


def faded(colour: Colour) -> Colour:
    """Fade a colour to white."""
    red, green, blue = (0.6 + 0.4 * one for one in colour)
    return red, green, blue


def unloads(scene: xarray.Dataset, count: int) -> Steps:
    """Report which of the points of a path are on unloading; none if the dataset does not know."""
    return scene["path_unloading"].values == 1 if "path_unloading" in scene else np.zeros(count, bool)


def draw_track(axes: Axes, track: Track, scene: xarray.Dataset, plane: Plane, colour: Colour) -> None:
    """Draw one line of a scene; its jumps are thin and dashed, its unstable parts light."""
    points = track.points(scene, plane)
    jumps, falls = track.jumps(scene), track.falls(scene)
    own = np.ones(points.shape[1] - 1, bool)
    if track.unloading is not None and "path_unloading" in scene:
        own = unloads(scene, 0)[1:] == track.unloading
    for steps, dash, width, shown in (
        (own & jumps, JUMP, THIN, colour),
        (own & falls & ~jumps, track.dash, track.width, faded(colour)),
        (own & ~falls & ~jumps, track.dash, track.width, colour),
    ):
        if steps.any():
            kept = np.insert(points, np.flatnonzero(~steps) + 1, np.nan, axis=1)  # gaps for the others
            axes.plot(*kept, ls=dash, lw=width, color=shown, solid_capstyle="butt")


def draw_marks(axes: Axes, points: Values, start: float, apart: float, **looks: Any) -> None:
    """Put markers along a line, evenly in the panel: from where on, and how far apart, in its diagonals."""
    if np.isfinite(points).all(axis=0).any():  # matplotlib fails to mark a line without a point
        axes.plot(*points, **({"markevery": (start, apart), "ls": ""} | looks))


def draw_arrows(
    axes: Axes, track: Track, scene: xarray.Dataset, plane: Plane, colour: Colour, taken: list[Values]
) -> None:
    """Put an arrow on each jump of a path, and on each part between two of them, where it has room.

    The limits of the panel must stand. An arrow gives way to those of `taken`, the places in the panel of others.
    """
    places = (axes.transData - axes.transAxes).transform(track.points(scene, plane).T)
    ways = unloads(scene, len(places))[1:]
    jumps = np.broadcast_to(track.jumps(scene), ways.shape)
    looks: dict[str, Any] = {"arrowstyle": "-|>", "color": colour, "lw": 0.0, "shrinkA": 0.0, "shrinkB": 0.0}
    for run in np.split(np.arange(ways.size), np.flatnonzero(np.diff(ways) | jumps[1:] | jumps[:-1]) + 1):
        line = places[run[0] : run[-1] + 2]
        lengths = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
        if not lengths[-1] > FEWEST or track.unloading not in (None, bool(ways[run[0]])):
            continue
        ends = 0.5 * lengths[-1] + np.array([-0.5, 0.5]) * ARROW
        tail, head = np.stack([np.interp(ends, lengths, row) for row in line.T], axis=1)
        inside = min(*tail, *head) >= 0.0 and max(*tail, *head) <= 1.0
        if inside and all(np.hypot(*(head - other)) > ARROW for other in taken):
            taken.append(head)
            arrow = looks | {"mutation_scale": 8.0}
            axes.annotate("", tuple(head), tuple(tail), "axes fraction", "axes fraction", arrowprops=arrow)
