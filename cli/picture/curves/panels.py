"""The lines of a curve dataset, and how each is drawn into axes that are given."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, to_rgb
from numpy.typing import NDArray

from gradhesion.cli.picture.doubts import Doubt
from gradhesion.cli.picture.looks import PLAIN

Values = NDArray[np.float64]
Steps = NDArray[np.bool_]
Colour = tuple[float, float, float]
Dash = str | tuple[float, tuple[float, ...]]

JUMP: Final[Dash] = (0, (3, 2))
"""The dash of a jump."""

THIN: Final = 0.8
"""The width of a jump, in points."""

ARROW: Final = 0.06
"""The length of an arrow on a line, over the side of a panel."""

FEWEST: Final = 0.1
"""The length of a part of a line, over the side of a panel, that has room for an arrow."""

APART: Final = 0.12
"""How far apart open markers stand along a line, in diagonals of the panel."""

SHARES: Final = (0.5, 0.62, 0.38, 0.75, 0.25)
"""Where along a part of a line an arrow may stand, the best place first."""

LIGHT: Final = 0.6
"""How far unstable parts are faded to white."""


@dataclass(frozen=True, kw_only=True)
class Track:
    """One line: its curve, the variables that give its points, and how it looks."""

    curve: str
    label: str
    contact_radius: str
    indentation: str
    load: str
    dash: Dash
    width: float
    colour: Colour
    """Its colour where colours do not distinguish scenes."""
    shade: float | None
    """Where that is among the colours of a colour map; None: it is grey in all."""
    unloading: bool | None = None
    """Whether it is the loading or the unloading part of its curve, if it is a part."""


def _track(
    curve: str, label: str, stem: str, dash: Dash, width: float, shade: float, *, unloading: bool | None = None
) -> Track:
    """Make a track whose variables have a common stem; the lighter, the higher its shade from 0 to 1."""
    return Track(
        curve=curve,
        label=label,
        contact_radius="envelope_contact_radius" if curve == "envelope" else f"{stem}contact_radius",
        indentation=f"{stem}indentation",
        load=f"{stem}load",
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


MARKERS: Final = ("o", "s", "D", "P", "X")
"""What distinguishes scenes where colours do not print."""

MARKED: Final = 0.22
"""How far apart these markers stand along a line, in diagonals of the panel."""


def coloured(tracks: Sequence[Track], colours: Colormap) -> tuple[Track, ...]:
    """Give lines the colours of a colour map."""
    return tuple(
        track if track.shade is None else replace(track, colour=to_rgb(colours(track.shade))) for track in tracks
    )


def _seen(along: Values, up: Values) -> bool:
    """Report whether a line has a point: matplotlib fails to mark one that has none."""
    return bool((np.isfinite(along) & np.isfinite(up)).any())


def draw_marks(
    axes: Axes, track: Track, scene: Mapping[str, Values], x: str, y: str, colour: Colour, item: int
) -> None:
    """Put the markers of a scene along a line, evenly in the panel, those of the next scene beside them."""
    along, up = scene[getattr(track, x)], scene[getattr(track, y)]
    if not _seen(along, up):
        return
    start = MARKED * (0.15 + item / len(MARKERS))
    axes.plot(
        along,
        up,
        ls="",
        marker=MARKERS[item % len(MARKERS)],
        ms=3.2,
        color=colour,
        mew=0.0,
        markevery=(start, MARKED),
    )


def draw_track(axes: Axes, track: Track, scene: Mapping[str, Values], x: str, y: str, colour: Colour) -> None:
    """Draw one line of a scene; its jumps are thin and dashed, its unstable parts light."""
    along, up = scene[getattr(track, x)], scene[getattr(track, y)]
    jumps, falls = jumps_of(track, scene), falls_of(track, scene)
    own = np.ones(max(0, along.size - 1), bool)
    if track.unloading is not None and "path_unloading" in scene:
        own = (scene["path_unloading"][1:] == 1.0) == track.unloading
    looks = (
        (own & jumps, JUMP, THIN, colour),
        (own & falls & ~jumps, track.dash, track.width, faded(colour)),
        (own & ~falls & ~jumps, track.dash, track.width, colour),
    )
    for steps, dash, width, shown in looks:
        if steps.any():
            axes.plot(*_only(steps, along, up), ls=dash, lw=width, color=shown, solid_capstyle="butt")


def draw_arrows(
    axes: Axes, track: Track, scene: Mapping[str, Values], x: str, y: str, colour: Colour, taken: list[Values]
) -> None:
    """
    Put arrows along a path: one on each jump, one on the longest part without jump on loading and on unloading.

    The limits of the panel must stand. An arrow gives way to those of `taken`, the places in the panel of others.
    """
    if track.curve != "path":
        return
    points = np.column_stack([scene[getattr(track, x)], scene[getattr(track, y)]])
    limits = np.array([axes.get_xlim(), axes.get_ylim()])
    places = (points - limits[:, 0]) / (limits[:, 1] - limits[:, 0])
    sides = scene["path_unloading"][1:] if "path_unloading" in scene else np.zeros(max(0, len(points) - 1))
    jumps = np.broadcast_to(jumps_of(track, scene), sides.shape)
    for run in np.split(np.arange(sides.size), np.flatnonzero((np.diff(sides) != 0) | jumps[1:] | jumps[:-1]) + 1):
        if not run.size or (track.unloading is not None and (sides[run[0]] == 1.0) != track.unloading):
            continue
        line = places[run[0] : run[-1] + 2]
        lengths = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
        if not lengths[-1] > FEWEST:
            continue
        for share in SHARES:
            ends = [
                np.array([np.interp(share * lengths[-1] + step, lengths, row) for row in line.T])
                for step in (-0.5 * ARROW, 0.5 * ARROW)
            ]
            inside = all(((end >= 0.0) & (end <= 1.0)).all() for end in ends)
            if inside and all(np.hypot(*(ends[1] - other)) > ARROW for other in taken):
                break
        else:
            continue
        taken.append(ends[1])
        looks = {"arrowstyle": "-|>", "color": colour, "lw": 0.0, "shrinkA": 0.0, "shrinkB": 0.0, "mutation_scale": 8.0}
        axes.annotate("", tuple(ends[1]), tuple(ends[0]), "axes fraction", "axes fraction", arrowprops=looks)


def draw_doubt(
    axes: Axes, track: Track, scene: Mapping[str, Values], x: str, y: str, colour: Colour, doubt: Doubt
) -> None:
    """Put the open markers of a doubt along the loading part of a path, evenly in the panel."""
    along, up = scene[getattr(track, x)], scene[getattr(track, y)]
    loading = scene["path_unloading"] == 0.0 if "path_unloading" in scene else np.ones(along.size, bool)
    if not _seen(along[loading], up[loading]):
        return
    axes.plot(
        along[loading],
        up[loading],
        ls="",
        marker=doubt.mark,
        ms=doubt.size,
        mfc="white",
        mec=colour,
        mew=0.8,
        markevery=(0.5 * APART, APART),
    )


def jumps_of(track: Track, scene: Mapping[str, Values]) -> Steps:
    """Report which steps from point to point are jumps (none if the dataset does not know)."""
    flags = scene.get(f"{track.curve}_jump")
    return np.zeros(1, bool) if flags is None else flags[1:] == 1.0


def falls_of(track: Track, scene: Mapping[str, Values]) -> Steps:
    """Report which steps of the equilibrium curve are unstable: the depth falls (none if the dataset does not know)."""
    depths = scene.get(track.indentation) if track.curve.endswith("equilibrium") else None
    return np.zeros(1, bool) if depths is None else np.diff(depths) < 0.0


def faded(colour: Colour) -> Colour:
    """Fade a colour to white."""
    red, green, blue = (LIGHT + (1.0 - LIGHT) * one for one in colour)
    return red, green, blue


def _only(steps: Steps, along: Values, up: Values) -> tuple[Values, Values]:
    """
    Keep some steps of a line, with gaps between their runs.

    >>> _only(np.array([True, False, True]), np.array([0.0, 1.0, 2.0, 3.0]), np.zeros(4))[0]
    array([ 0.,  1., nan,  2.,  3., nan])
    """
    places = np.flatnonzero(steps)
    kept = []
    for run in np.split(places, np.flatnonzero(np.diff(places) > 1) + 1):
        kept += [np.arange(run[0], run[-1] + 2), np.array([along.size])]
    chosen = np.concatenate(kept)
    return np.append(along, np.nan)[chosen], np.append(up, np.nan)[chosen]
