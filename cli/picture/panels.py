"""The panels of a picture of values: a map, lines, points or their density, each drawn into axes that are given."""

import itertools
from collections.abc import Iterable, Sequence
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.contour import QuadContourSet
from matplotlib.path import Path
from scipy.spatial import cKDTree

from gradhesion.cli.picture.labels import Scale, Unit, suit
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.plan import Plan
from gradhesion.cli.picture.shown import CROSS, GREY, INK, Shown

DASHES: Final[tuple[Any, ...]] = ("-", "--", "-.", ":", (0, (8, 4)), (0, (6, 1.5, 1, 1.5, 1, 1.5)))
POINTS: Final = ("o", "^", "s")
"""What distinguishes lines, and points, where colours do not print; the gaps of those on top show what is below."""
MARKS: Final = 40
"""Markers along a line, about: more would hide it."""
FEW: Final = 20
"""Values along an axis up to which a band is drawn as bars: between them nothing is known."""
LIGHT: Final = 0.2


Place = tuple[int, int]
"""The row and the column of a panel."""


def draw_map(
    axes: Axes, shown: Shown, place: Place, x: Scale, y: Scale, looks: Looks
) -> tuple[Any, QuadContourSet | None]:
    """Draw values as filled contours with lines at some levels; doubtful ones are hatched, what has none is grey.

    Returns
    -------
    What has the colours, for their bar (None where no value is), and the lines, for numbers on them.
    """
    filled: Any = None
    lines = None
    values = shown.values[place]
    sides = x.positions, y.positions
    axes.set_facecolor(GREY)
    if shown.names:
        own: Any = {"cmap": looks.colours.resampled(len(shown.names)), "vmin": -0.5, "vmax": len(shown.names) - 0.5}
        filled = axes.pcolormesh(x.edges(), y.edges(), values, edgecolors="face", **own)
    elif shown.levels and np.isfinite(values).any():
        levels, inner, norm = shown.levels
        filled = axes.contourf(*sides, values, levels=levels, norm=norm, cmap=looks.colours)
        filled.set_edgecolor("face")  # no white seams between the bands
        if inner.size:
            shades = np.where(_lightness(looks.colours(norm(inner))) < 0.5, "white", "black").tolist()
            lines = axes.contour(*sides, values, levels=inner, colors=shades, linewidths=0.4)
        dark = _lightness(looks.colours(np.ma.filled(norm(values), 0.0))) < 0.4
        for doubt, marked in shown.marks:
            flags, gaps = marked[place], np.where(np.isnan(values), np.nan, 0.0)
            for shade, part in (("white", flags & dark), (INK, flags & ~dark)):
                if part.any():
                    hatched = axes.contourf(*sides, part + gaps, (0.5, 1.5), colors="none", hatches=[doubt.hatch])
                    hatched.set(edgecolor=shade, linewidth=0.0)
            if flags.any() and not flags.all():
                axes.contour(*sides, flags + gaps, (0.5,), colors=INK, linewidths=0.8)
    x.dress(axes, "x", looks.xlim)
    y.dress(axes, "y", looks.ylim)
    return filled, lines


def _lightness(colours: Any) -> Any:
    """Give the lightness of colours, from 0 to 1, as a grey print shows them (ITU-R BT.601)."""
    return np.asarray(colours)[..., :3] @ (0.299, 0.587, 0.114)


def number_contours(lines: QuadContourSet, unit: Unit) -> None:
    """Put a number on each line where it has most room, on a piece that is long enough; the layout must stand.

    On a steep flank, where lines crowd, there is none: it would hide the lines beside.
    """
    frame, transform, inch = lines.axes.get_window_extent(), lines.get_transform(), lines.axes.figure.dpi
    pieces: list[list[Any]] = [
        [Path(transform.transform(piece)).interpolated(10).vertices for piece in path.to_polygons(closed_only=False)]
        for path in lines.get_paths()
    ]
    taken: list[Any] = []
    for i, own in enumerate(pieces):
        places = _joined(piece for piece in own if np.ptp(piece, axis=0).max() >= 0.5 * inch)
        others = _joined(itertools.chain(*pieces[:i], *pieces[i + 1 :]))
        inside = np.minimum(places - frame.min, frame.max - places).min(axis=1)
        apart = [cKDTree(np.reshape(one, (-1, 2))).query(places)[0] for one in (others, taken)]
        room = np.min([inside / 0.125, apart[0] / 0.1, apart[1] / 0.4], axis=0)
        if room.max(initial=0.0) > inch:
            taken.append(places[np.argmax(room)])
    if taken:
        places = transform.inverted().transform(taken).tolist()
        lines.clabel(manual=places, fmt=unit, fontsize="x-small", inline_spacing=2)


def _joined(pieces: Iterable[Any]) -> Any:
    """Give the places of some pieces of lines in one list."""
    return np.vstack([np.empty((0, 2)), *pieces])


def draw_lines(
    axes: Axes, shown: Shown, place: Place, x: Scale, labels: Sequence[str], plan: Plan, looks: Looks
) -> None:
    """Draw a line for each value of the second axis, which has labels, or points of a colour, with their bands.

    A value between two gaps shows as a dot. Doubtful values have open markers, and a cross at the foot of the panel
    stands where there is none.
    """
    on_line = slice(0, x.finite.size)  # inf stands apart
    for i, (words, values) in enumerate(zip(labels, shown.values[place], strict=True)):
        share = i / max(1, len(labels) - 1)
        colour = looks.colours(0.25 + 0.6 * share if plan.points else 0.85 * share)
        if shown.names:  # side by side
            values = values + 0.4 * (share - 0.5 if len(labels) > 1 else 0.0)
        own: dict[str, Any] = {"color": colour, "ms": 3, "label": words}
        if plan.points:
            axes.plot(x.positions, values, POINTS[i % len(POINTS)], mec="white", mew=0.3, **own)
        else:
            own["marker"] = "." if values.size <= MARKS or shown.names else ""
            own["ls"] = "" if shown.names else DASHES[i % len(DASHES)]  # there is nothing between categories
            axes.plot(x.positions[on_line], values[on_line], lw=1.1, **own)
            if x.infinite:
                axes.plot(x.positions[-1:], values[-1:], "o", color=colour, ms=3)
        if shown.band:  # around a line; where it has few values, and at infinity, a bar at each of them
            low, high = (edge[place][i] for edge in shown.band)
            line = 0 if plan.points or x.positions.size <= FEW else x.finite.size
            axes.fill_between(x.positions[:line], low[:line], high[:line], color=colour, alpha=LIGHT, lw=0.0, zorder=1)
            bars: dict[str, Any] = {"fmt": "none", "ecolor": colour, "elinewidth": 0.8, "capsize": 2, "zorder": 1.8}
            axes.errorbar(x.positions[line:], 0.5 * (low + high)[line:], 0.5 * (high - low)[line:], **bars)
        for doubt, marked in reversed(shown.marks):  # the larger ones below
            flags, every = marked[place][i], 1 if plan.points else -(-values.size // MARKS)
            axes.plot(x.positions[flags], values[flags], mew=0.9, markevery=every, **doubt.marker(colour))
        gaps = x.positions[np.isnan(values)]
        if gaps.size:  # a line of no points would have no place in the layout
            foot: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "clip_on": False, "zorder": 3}
            axes.plot(gaps, np.zeros(gaps.size), "x", ms=4, color=CROSS, **foot)
    axes.margins(x=0.02 if not plan.points else None)
    _dress(axes, shown, x, looks)


def draw_density(axes: Axes, shown: Shown, place: Place, x: Scale, looks: Looks) -> PolyCollection:
    """Colour each cell of a panel by the number of points in it; empty cells stay white."""
    values = shown.values[place][0]
    there = np.isfinite(values)
    scales: Any = {"xscale": "log" if x.log else "linear", "yscale": "log" if shown.log else "linear"}
    cells = axes.hexbin(
        x.positions[there], values[there], gridsize=(60, 34), mincnt=1, cmap=looks.colours, linewidths=0.1, **scales
    )
    _dress(axes, shown, x, looks)
    axes.grid(visible=False)
    return cells


def _dress(axes: Axes, shown: Shown, x: Scale, looks: Looks) -> None:
    """Give a panel of lines or points its scales, or the names of categories."""
    x.dress(axes, "x", looks.xlim)
    axes.grid(color="0.9", lw=0.5)
    if shown.names:
        axes.set_ylim(-0.5, len(shown.names) - 0.5)
        axes.set_yticks(range(len(shown.names)), shown.names, fontsize="small")
    else:
        suit(axes, "y", shown.name, looks.ylim, ends=shown.ends, log=shown.log, after=shown.after)
