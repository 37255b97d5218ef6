"""The panels of a picture of values: a map, lines, points or their density, each drawn into axes that are given."""

from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.contour import QuadContourSet
from matplotlib.font_manager import FontProperties
from matplotlib.transforms import Bbox
from numpy.typing import NDArray

from gradhesion.cli.picture.doubts import CROSS, GREY, INK
from gradhesion.cli.picture.inset import along
from gradhesion.cli.picture.labels import equations
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.plan import Plan
from gradhesion.cli.picture.scales import Scale, dress, limit, scale
from gradhesion.cli.picture.shown import Shown, Values, levels_of, padded

Flags = NDArray[np.bool_]

DASHES: Final[tuple[Any, ...]] = ("-", "--", "-.", ":", (0, (8, 4)), (0, (6, 1.5, 1, 1.5, 1, 1.5)))
"""What distinguishes lines where colours do not print; the gaps of those on top show what is below."""

POINTS: Final = ("o", "^", "s")
"""What distinguishes series of points."""

MARKS: Final = 40
"""Markers along a line, about: more would hide it."""

FEW: Final = 20
"""Values along an axis up to which a band is drawn as bars: between them nothing is known."""

LIGHT: Final = 0.2
"""How opaque a band is."""

ABOVE_GRID: Final = 1.8
"""The order of bars: above the lines of the grid, which matplotlib puts at 1.5, and below the values, at 2."""

ASIDE: Final = 0.4
"""The height within a category over which lines are spread, so that none hides another."""

ROOM: Final = 3.0
"""The length of a line that has room for a number, in widths of the number."""

SHARES: Final = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9)
"""Where along a line a number may stand, the best place first."""

WIDE: Final = 0.5
"""The width of a letter of a number over its size."""

CELLS: Final = (60, 34)
"""Hexagons along the sides of a panel of many points."""

DARK: Final = 0.4
MIDDLE: Final = 0.5
"""The lightness up to which colours need white hatches, and white lines."""


def draw_map(axes: Axes, shown: Shown, plan: Plan, looks: Looks) -> tuple[Any, QuadContourSet | None]:
    """
    Draw values as filled contours; doubtful ones are hatched, what has none is grey.

    Returns
    -------
    What has the colours, for their bar (None where no value is), and the lines, for numbers on them.
    """
    x = scale(shown.values[plan.x].values, plan.x, looks.xlim)
    y = scale(shown.values[str(plan.second)].values, str(plan.second), looks.ylim)
    axes.set_facecolor(GREY)
    drawn: tuple[Any, QuadContourSet | None] = (None, None)
    if shown.names:
        count = len(shown.names)
        colours: Any = {"cmap": looks.colours.resampled(count), "vmin": -0.5, "vmax": count - 0.5}
        drawn = axes.pcolormesh(x.edges(), y.edges(), shown.values.values, edgecolors="face", **colours), None
    elif bool(shown.values.notnull().any()):
        drawn = _draw_contours(axes, (x.positions, y.positions), shown, looks)
    x.dress(axes, "x")
    y.dress(axes, "y")
    return drawn


def _draw_contours(
    axes: Axes, places: tuple[Values, Values], shown: Shown, looks: Looks
) -> tuple[QuadContourSet, QuadContourSet | None]:
    """Fill the bands between levels, with lines at some of them, and hatch what is in doubt."""
    values = shown.values.values.astype(float)
    levels, norm = levels_of(shown, looks)
    filled = axes.contourf(*places, values, levels=levels, norm=norm, cmap=looks.colours)
    filled.set_edgecolor("face")  # no white seams between the bands
    inner = levels[1:-1]
    if isinstance(looks.levels, tuple):
        inner = levels[np.isin(levels, looks.levels)]
    elif inner.size > 5:  # the others show as edges of the bands
        inner = inner[1::2]
    lines = None
    if inner.size:
        shades = ["white" if _lightness(looks.colours(norm(level))) < MIDDLE else "black" for level in inner]
        lines = axes.contour(*places, values, levels=inner, colors=shades, linewidths=0.4)
    dark = _lightness(looks.colours(np.ma.filled(norm(values), 0.0))) < DARK
    for doubt, marked in shown.marks:
        flags = marked.values
        for shade, part in (("white", flags & dark), (INK, flags & ~dark)):
            if part.any():
                there = np.where(np.isnan(values), np.nan, part)
                hatched = axes.contourf(*places, there, levels=(0.5, 1.5), colors="none", hatches=[doubt.hatch])
                hatched.set(edgecolor=shade, linewidth=0.0)
        if flags.any() and not flags.all():
            there = np.where(np.isnan(values), np.nan, flags)
            axes.contour(*places, there, levels=(0.5,), colors=INK, linewidths=0.8)
    return filled, lines


def number_contours(lines: QuadContourSet, shown: Shown) -> None:
    """
    Put a number on the longest piece of each line where it fits; the layout of the figure must stand.

    It fits where it is whole and clear of other lines and numbers, and not on a small island, which it would hide.
    """
    frame, transform = lines.axes.get_window_extent(), lines.get_transform()
    letter = FontProperties(size="x-small").get_size_in_points() * lines.axes.get_figure(root=True).dpi / 72 * WIDE  # type: ignore[union-attr]
    pieces = [
        [along(transform.transform(one), 2.0) for one in path.to_polygons(closed_only=False)]
        for path in lines.get_paths()
    ]
    taken = [np.vstack([np.empty((0, 2)), *own]) for own in pieces]
    places = []
    for item, level in enumerate(lines.levels):
        side = letter * (len(shown.unit.number(level).replace("$", "")) + 1)
        others = np.vstack([np.empty((0, 2)), *taken[:item], *taken[item + 1 :]])
        long = [
            piece for piece in sorted(pieces[item], key=len, reverse=True) if np.ptp(piece, axis=0).max() > ROOM * side
        ]
        for place in (piece[int(share * (len(piece) - 1))] for piece in long for share in SHARES):
            box = Bbox([place - 0.5 * side, place + 0.5 * side])
            if frame.contains(*box.min) and frame.contains(*box.max) and not box.count_contains(others):
                places.append(transform.inverted().transform(place).tolist())
                taken.append(box.corners())
                break
    if places:
        lines.clabel(manual=places, fmt=shown.unit.number, fontsize="x-small", inline_spacing=2)


def _lightness(colours: Any) -> Any:
    """Give the lightness of colours, from 0 to 1, as a grey print shows them (ITU-R BT.601)."""
    return np.asarray(colours)[..., :3] @ (0.299, 0.587, 0.114)


def draw_lines(axes: Axes, shown: Shown, plan: Plan, looks: Looks) -> None:
    """
    Draw a line for each value of the second axis, or points of a colour, with their bands.

    A value between two gaps shows as a dot. Doubtful values have open markers, and a cross at the foot of the panel
    stands where there is none.
    """
    x = scale(shown.values[plan.x].values, plan.x, looks.xlim)
    rows = np.atleast_2d(shown.values.values.astype(float))
    labels = equations(plan.second, shown.values[plan.second].values) if plan.second else [""]
    bands = [np.atleast_2d(edge.values) for edge in shown.band]
    marks = [(doubt, np.atleast_2d(flags.values)) for doubt, flags in shown.marks]
    on_line = slice(0, x.positions.size - x.infinite)  # inf stands apart
    for i, (words, values) in enumerate(zip(labels, rows, strict=True)):
        share = i / max(1, len(rows) - 1)
        colour = looks.colours(0.25 + 0.6 * share if plan.points else 0.85 * share)
        if shown.names:  # side by side
            values = values + ASIDE * (i - 0.5 * (len(rows) - 1)) / max(1, len(rows) - 1)
        own: dict[str, Any] = {"color": colour, "ms": 3, "label": words}
        if plan.points:
            axes.plot(x.positions, values, POINTS[i % len(POINTS)], mec="white", mew=0.3, **own)
        else:
            own["marker"] = "." if values.size <= MARKS or shown.names else ""
            own["ls"] = "" if shown.names else DASHES[i % len(DASHES)]  # there is nothing between categories
            axes.plot(x.positions[on_line], values[on_line], lw=1.1, **own)
            if x.infinite:
                axes.plot(x.positions[-1:], values[-1:], "o", color=colour, ms=3)
        if bands:
            _draw_band(axes, x, bands[0][i], bands[1][i], colour, bars=plan.points > 0)
        for doubt, flags in reversed(marks):  # the larger ones below
            some = flags[i] if plan.points else _some(flags[i])
            open_ones: dict[str, Any] = {"ms": doubt.size, "mfc": "white", "mec": colour, "mew": 0.9}
            axes.plot(x.positions[some], values[some], doubt.mark, **open_ones)
        gaps = x.positions[np.isnan(values)]
        if gaps.size:  # a line of no points would have no place in the layout
            foot: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "clip_on": False, "zorder": 3}
            axes.plot(gaps, np.zeros(gaps.size), "x", ms=4, color=CROSS, **foot)
    axes.margins(x=0.02 if not plan.points else None)
    x.dress(axes, "x")
    _dress_values(axes, shown)


def _draw_band(axes: Axes, x: Scale, low: Values, high: Values, colour: Any, *, bars: bool) -> None:
    """Draw a band around a line; where it has few values, and at infinity, a bar at each of them."""
    line = 0 if bars or x.positions.size <= FEW else x.positions.size - x.infinite
    axes.fill_between(x.positions[:line], low[:line], high[:line], color=colour, alpha=LIGHT, lw=0.0, zorder=1)
    middle, half = 0.5 * (low + high)[line:], 0.5 * (high - low)[line:]
    axes.errorbar(
        x.positions[line:], middle, half, fmt="none", ecolor=colour, elinewidth=0.8, capsize=2, zorder=ABOVE_GRID
    )


def draw_density(axes: Axes, shown: Shown, plan: Plan, looks: Looks) -> PolyCollection:
    """Colour each cell of a panel by the number of points in it; empty cells stay white."""
    x = scale(shown.values[plan.x].values, plan.x, looks.xlim)
    values = shown.values.values.astype(float)
    there = ~np.isnan(values)
    scales: Any = {"xscale": "log" if x.log else "linear", "yscale": "log" if shown.log else "linear"}
    places = x.positions[there], values[there]
    cells = axes.hexbin(*places, gridsize=CELLS, mincnt=1, cmap=looks.colours, linewidths=0.1, **scales)
    x.dress(axes, "x")
    _dress_values(axes, shown)
    axes.grid(visible=False)
    return cells


def _dress_values(axes: Axes, shown: Shown) -> None:
    """Give the values of lines or points their scale, or the names of categories."""
    axes.grid(color="0.9", lw=0.5)
    if shown.names:
        axes.set_ylim(-0.5, len(shown.names) - 0.5)
        axes.set_yticks(range(len(shown.names)), shown.names, fontsize="small")
        return
    dress(axes, "y", shown.unit, shown.ends, log=shown.log)
    if padded(*shown.ends) != shown.ends:
        axes.set_ylim(*padded(*shown.ends))
    limit(axes, "y", shown.limits)


def _some(flags: Flags) -> Flags:
    """
    Choose about `MARKS` of the flags of a line, the ends of each run among them.

    >>> _some(np.array([True, False, True, True])).tolist()
    [True, False, True, True]
    """
    before, after = np.append(False, flags[:-1]), np.append(flags[1:], False)
    regular = np.arange(flags.size) % -(-flags.size // MARKS) == 0
    some: Flags = flags & (regular | ~before | ~after)
    return some
