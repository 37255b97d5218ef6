"""The panels of a picture: a map, lines, or points, each drawn into axes that are given."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.picture.doubts import CROSS, GREY, INK, Doubt
from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.picture.scales import Numbers, Scale, limit
from gradhesion.cli.picture.values.bands import Edges, draw_band, draw_bars
from gradhesion.cli.picture.values.levels import FLAT, Levels, Values

Flags = NDArray[np.bool_]

DASHES: Final[tuple[Any, ...]] = ("-", "--", "-.", ":", (0, (8, 4)), (0, (6, 1.5, 1, 1.5, 1, 1.5)))
"""What distinguishes lines where colours do not print; the gaps of those on top show what is below."""

MARKS: Final = 40
"""Markers along a line, about: more would hide it."""

ASIDE: Final = 0.4
"""The height within a category over which series are spread."""

_DARK: Final = 0.4
"""The lightness up to which colours need white hatches."""

MIDDLE: Final = 0.5
"""The lightness up to which colours need white lines."""


def draw_map(
    axes: Axes,
    x: Scale,
    y: Scale,
    values: Values,
    levels: Levels,
    doubtful: Sequence[tuple[Doubt, Flags]] = (),
) -> QuadContourSet | None:
    """
    Draw values[y, x] as filled contours; doubtful ones are hatched, what has none is grey.

    Returns
    -------
    The lines among them, if there are some, for numbers on them.
    """
    colours = levels.looks.colours
    axes.patch.set_facecolor(GREY)
    if levels.names:
        cells = axes.pcolormesh(x.edges(), y.edges(), values, norm=levels.norm, cmap=colours)
        cells.set_edgecolor("face")
        x.dress(axes, "x")
        y.dress(axes, "y")
        return None
    filled = axes.contourf(
        x.positions, y.positions, values, levels=levels.levels, norm=levels.norm, cmap=colours, extend="neither"
    )
    filled.set_edgecolor("face")  # no white seams between the bands
    inner = levels.inner()
    lines = None
    if inner.size and np.isfinite(values).any():
        shades = ["white" if _lightness(colours(levels.norm(level))) < MIDDLE else "black" for level in inner]
        lines = axes.contour(x.positions, y.positions, values, levels=inner, colors=shades, linewidths=0.4)
    dark = _lightness(colours(np.ma.filled(levels.norm(values), 0.0))) < _DARK
    for doubt, flags in doubtful:
        for shade, part in (("white", flags & dark), (INK, flags & ~dark)):
            if part.any():
                shown = np.where(np.isnan(values), np.nan, part)
                hatched = axes.contourf(
                    x.positions, y.positions, shown, levels=(0.5, 1.5), colors="none", hatches=[doubt.hatch]
                )
                hatched.set_edgecolor(shade)
                hatched.set_linewidth(0.0)
        if flags.any() and not flags.all():
            shown = np.where(np.isnan(values), np.nan, flags)
            axes.contour(x.positions, y.positions, shown, levels=(0.5,), colors=INK, linewidths=0.8)
    x.dress(axes, "x")
    y.dress(axes, "y")
    return lines


def _lightness(colours: Any) -> Any:
    """Give the lightness of colours, from 0 to 1, as a grey print shows them (ITU-R BT.601)."""
    return np.asarray(colours)[..., :3] @ (0.299, 0.587, 0.114)


def draw_lines(
    axes: Axes,
    x: Scale,
    curves: dict[str, Values],
    levels: Levels,
    unit: Unit,
    doubtful: Sequence[tuple[Doubt, dict[str, Flags]]] = (),
    bands: Mapping[str, Edges] | None = None,
) -> None:
    """
    Draw a line for each curve, distinguished by shade and by dash; a value between two gaps shows as a dot.

    Doubtful values have open markers, and a cross at the foot of the panel stands where there is none.
    """
    for i, (label, values) in enumerate(curves.items()):
        colour = levels.looks.colours(0.85 * i / max(1, len(curves) - 1))
        if levels.names:
            values = values + _aside(i, len(curves))
        marks = "." if values.size <= MARKS or levels.names else ""
        finite = x.positions[:-1] if x.infinite else x.positions
        axes.plot(
            finite,
            values[: finite.size],
            ls="" if levels.names else DASHES[i % len(DASHES)],  # there is nothing between categories
            color=colour,
            marker=marks,
            ms=3,
            lw=1.1,
            label=label,
        )
        if x.infinite:
            axes.plot(x.positions[-1:], values[-1:], "o", color=colour, ms=3)
        if bands:
            for part in (slice(finite.size), slice(finite.size, None)):
                low, high = (edge[part] for edge in bands[label])
                draw_band(axes, x.positions[part], (low, high), colour)
        for doubt, flags in reversed(doubtful):  # the larger ones below
            _draw_marks(axes, doubt, x.positions, values, _some(flags[label]), colour)
        _draw_gaps(axes, x, values)
    axes.margins(x=0.02)
    x.dress(axes, "x")
    dress_values(axes, levels, unit)


def draw_points(
    axes: Axes,
    x: Scale,
    series: dict[str, Values],
    levels: Levels,
    unit: Unit,
    doubtful: Sequence[tuple[Doubt, dict[str, Flags]]] = (),
    bands: Mapping[str, Edges] | None = None,
) -> None:
    """
    Draw a dot for each scene; several series are distinguished by shade and by mark.

    Doubtful values have open markers, and a cross at the foot of the panel stands where there is none.
    """
    marks = ("o", "^", "s")
    for i, (label, values) in enumerate(series.items()):
        colour = levels.looks.colours(0.25 + 0.6 * i / max(1, len(series) - 1))
        mark = marks[i % len(marks)]
        if levels.names:
            values = values + _aside(i, len(series))
        axes.plot(x.positions, values, mark, color=colour, ms=3, mec="white", mew=0.3, label=label)
        if bands:
            draw_bars(axes, x.positions, bands[label], colour)
        for doubt, flags in reversed(doubtful):  # the larger ones below
            _draw_marks(axes, doubt, x.positions, values, flags[label], colour)
        _draw_gaps(axes, x, values)
    if len(series) > 1:
        axes.legend()
    x.dress(axes, "x")
    dress_values(axes, levels, unit)


def _aside(item: int, count: int) -> float:
    """Give each of several series a height of its own within a category, so that none hides another."""
    return ASIDE * (item - 0.5 * (count - 1)) / max(1, count - 1)


def dress_values(axes: Axes, levels: Levels, unit: Unit) -> None:
    """Give the values of lines or points their scale: logarithmic where they differ by a factor of `FAR` or more."""
    axes.grid(color="0.9", lw=0.5)
    least, greatest = levels.extremes
    if levels.names:
        axes.set_ylim(levels.levels[0], levels.levels[-1])
        axes.set_yticks(range(len(levels.names)), levels.names, fontsize="small")
        return
    if levels.log:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if greatest < 200 * least else (1.0,)))
        axes.yaxis.set_minor_locator(NullLocator())
    elif greatest - least <= FLAT * max(abs(least), abs(greatest)):
        axes.set_ylim(levels.levels[0], levels.levels[-1])
    if axes.get_yscale() == "log" and greatest > 1e4 * least:
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"$10^{{{np.log10(value) - unit.power:.0f}}}$"))
    elif unit.power or axes.get_yscale() == "log":
        axes.yaxis.set_major_formatter(Numbers(unit))
    limit(axes, "y", levels.limits)


def _draw_marks(axes: Axes, doubt: Doubt, positions: Values, values: Values, flags: Flags, colour: Any) -> None:
    """Put the open markers of a doubt over some values."""
    axes.plot(positions[flags], values[flags], doubt.mark, ms=doubt.size, mfc="white", mec=colour, mew=0.9)


def _draw_gaps(axes: Axes, x: Scale, values: Values) -> None:
    """Put a cross at the foot of a panel where there is no value."""
    places = x.positions[np.isnan(values)]
    if places.size:  # a line of no points would have no place in the layout
        foot = np.zeros(places.size)
        axes.plot(places, foot, "x", ms=4, color=CROSS, transform=axes.get_xaxis_transform(), clip_on=False, zorder=3)


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
