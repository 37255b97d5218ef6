"""The lines of a dataset of curves: which there are, how each looks, and how it is drawn into a panel."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, to_rgb
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import SI
from gradhesion.cli.picture.doubts import Doubt
from gradhesion.cli.picture.looks import PLAIN
from gradhesion.cli.picture.pictured import finite

Values = NDArray[np.float64]
Steps = NDArray[np.bool_]
Colour = tuple[float, float, float]
Dash = str | tuple[float, tuple[float, ...]]

QUANTITIES: Final = ("contact_radius", "indentation", "load")
"""What a panel may have along or up."""

JUMP: Final[Dash] = (0, (3, 2))
THIN: Final = 0.8
"""The dash of a jump, and its width in points."""

ARROW: Final = 0.06
FEWEST: Final = 0.1
"""The length of an arrow on a line, and of the part of a line that has room for one, over the side of a panel."""

APART: Final = 0.12
MARKED: Final = 0.22
"""How far apart the marks of doubts and of scenes stand along a line, in diagonals of the panel."""

MARKERS: Final = ("o", "s", "D", "P", "X")
"""What distinguishes scenes where colours do not print."""

LIGHT: Final = 0.6
"""How far unstable parts are faded to white."""


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


def tracks_in(names: Any, tracks: Sequence[Track], *, si: bool, colours: Colormap | None = None) -> list[Track]:
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
    red, green, blue = (LIGHT + (1.0 - LIGHT) * one for one in colour)
    return red, green, blue


def points_of(track: Track, scene: xarray.Dataset, plane: tuple[str, str]) -> tuple[Values, Values]:
    """Give the points of a line in a plane; NaN where there is none."""
    along, up = (finite(scene[track.variables[quantity]].values) for quantity in plane)
    return along, up


def draw_track(axes: Axes, track: Track, scene: xarray.Dataset, plane: tuple[str, str], colour: Colour) -> None:
    """Draw one line of a scene; its jumps are thin and dashed, its unstable parts light."""
    points = points_of(track, scene, plane)
    jumps, falls = track.jumps(scene), track.falls(scene)
    own = np.ones(points[0].size - 1, bool)
    if track.unloading is not None and "path_unloading" in scene:
        own = (scene["path_unloading"].values[1:] == 1) == track.unloading
    looks = (
        (own & jumps, JUMP, THIN, colour),
        (own & falls & ~jumps, track.dash, track.width, faded(colour)),
        (own & ~falls & ~jumps, track.dash, track.width, colour),
    )
    for steps, dash, width, shown in looks:
        if steps.any():
            kept = [np.insert(row, np.flatnonzero(~steps) + 1, np.nan) for row in points]  # gaps for the others
            axes.plot(*kept, ls=dash, lw=width, color=shown, solid_capstyle="butt")


def draw_marks(axes: Axes, points: tuple[Values, Values], apart: tuple[float, float], **looks: Any) -> None:
    """Put markers along a line, evenly in the panel: from where on, and how far apart, in its diagonals."""
    if np.isfinite(points).all(axis=0).any():  # matplotlib fails to mark a line without a point
        axes.plot(*points, ls="", markevery=apart, **looks)


def draw_doubts(
    axes: Axes, track: Track, scene: xarray.Dataset, plane: tuple[str, str], doubts: Sequence[Doubt], colour: Colour
) -> None:
    """Put the open markers of doubts along the loading part of a path."""
    points = points_of(track, scene, plane)
    loading = scene["path_unloading"].values == 0 if "path_unloading" in scene else np.ones(points[0].size, bool)
    for doubt in reversed(doubts):  # the larger ones below
        looks: dict[str, Any] = {"marker": doubt.mark, "ms": doubt.size, "mfc": "white", "mec": colour, "mew": 0.8}
        draw_marks(axes, (points[0][loading], points[1][loading]), (0.5 * APART, APART), **looks)


def draw_arrows(
    axes: Axes, track: Track, scene: xarray.Dataset, plane: tuple[str, str], colour: Colour, taken: list[Values]
) -> None:
    """
    Put an arrow on each jump of a path, and on each part between two of them, where it has room.

    The limits of the panel must stand. An arrow gives way to those of `taken`, the places in the panel of others.
    """
    places = (axes.transData - axes.transAxes).transform(np.column_stack(points_of(track, scene, plane)))
    ways = scene["path_unloading"].values[1:] if "path_unloading" in scene else np.zeros(len(places) - 1)
    jumps = np.broadcast_to(track.jumps(scene), ways.shape)
    for run in np.split(np.arange(ways.size), np.flatnonzero((np.diff(ways) != 0) | jumps[1:] | jumps[:-1]) + 1):
        line = places[run[0] : run[-1] + 2]
        lengths = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
        if not lengths[-1] > FEWEST or track.unloading not in (None, ways[run[0]] == 1):
            continue
        middle = 0.5 * lengths[-1]
        tail, head = (
            [np.interp(middle + step, lengths, row) for row in line.T] for step in (-0.5 * ARROW, 0.5 * ARROW)
        )
        inside = min(*tail, *head) >= 0.0 and max(*tail, *head) <= 1.0
        if inside and all(np.hypot(*np.subtract(head, other)) > ARROW for other in taken):
            taken.append(np.array(head))
            looks = {
                "arrowstyle": "-|>",
                "color": colour,
                "lw": 0.0,
                "shrinkA": 0.0,
                "shrinkB": 0.0,
                "mutation_scale": 8.0,
            }
            axes.annotate("", tuple(head), tuple(tail), "axes fraction", "axes fraction", arrowprops=looks)
