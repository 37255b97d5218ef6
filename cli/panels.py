"""The panels of a picture: a map, lines, or points, each drawn into axes that are given."""

from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.contour import QuadContourSet
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from gradhesion.cli.scales import Scale

Values = NDArray[np.float64]

COLOURS = colormaps["viridis"]  # perceptual, and rising in lightness, so that it survives a grey print

_STEPS = (
    (30, (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)),
    (1e3, (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)),
    (1e5, (1.0, 2.0, 5.0)),
)
"""Levels in a decade, for values that differ by less than each factor."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Levels:
    """The contour levels that all panels of a variable share."""

    levels: Values
    norm: Normalize


def levels_of(least: float, greatest: float) -> Levels:
    """
    Choose round contour levels between two values, rising by ratios where they differ much.

    >>> levels_of(1.0, 2.0).levels
    array([1. , 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2. ])
    """
    if greatest - least <= 1e-12 * max(abs(least), abs(greatest)):
        pad = 0.05 * max(abs(least), 1e-300)
        least, greatest = least - pad, greatest + pad
    log = least > 0 and greatest > 8 * least
    if log:
        decades = range(int(np.floor(np.log10(least))), int(np.ceil(np.log10(greatest))) + 1)
        steps = next((steps for most, steps in _STEPS if greatest < most * least), (1.0,))
        rising = np.array([step * 10.0**decade for decade in decades for step in steps])
    else:
        rising = np.asarray(MaxNLocator(11, steps=[1, 2, 2.5, 5, 10]).tick_values(least, greatest))
    first = max(0, int(np.searchsorted(rising, least, side="right")) - 1)
    levels = rising[first : int(np.searchsorted(rising, greatest)) + 1]
    return Levels(levels=levels, norm=(LogNorm if log else Normalize)(levels[0], levels[-1]))


def draw_map(axes: Axes, x: Scale, y: Scale, values: Values, levels: Levels) -> QuadContourSet:
    """Draw values[y, x] as filled contours with labelled lines; what has no value stays hatched."""
    axes.patch.set(facecolor="0.92", edgecolor="0.6", hatch="////")
    filled = axes.contourf(
        x.positions, y.positions, values, levels=levels.levels, norm=levels.norm, cmap=COLOURS, extend="neither"
    )
    filled.set_edgecolor("face")  # no white seams between the bands
    inner = levels.levels[1:-1]
    inner = inner[1::2] if inner.size > 5 else inner  # the others show as edges of the bands
    if inner.size and np.isfinite(values).any():
        shades = ["white" if levels.norm(level) < 0.6 else "black" for level in inner]
        lines = axes.contour(x.positions, y.positions, values, levels=inner, colors=shades, linewidths=0.4)
        axes.clabel(lines, inner, fmt="%g", fontsize=6, inline_spacing=2)
    x.dress(axes, "x")
    y.dress(axes, "y")
    return filled


def draw_lines(axes: Axes, x: Scale, curves: dict[str, Values]) -> None:
    """Draw a line for each curve, told apart by shade and by dash; a value between two gaps shows as a dot."""
    dashes = ("-", "--", "-.", ":")
    for i, (label, values) in enumerate(curves.items()):
        colour = COLOURS(0.85 * i / max(1, len(curves) - 1))
        marks = "." if values.size <= 40 else ""
        finite = x.positions[:-1] if x.infinite else x.positions
        axes.plot(
            finite,
            values[: finite.size],
            dashes[i % len(dashes)],
            color=colour,
            marker=marks,
            ms=3,
            lw=1.1,
            label=label,
        )
        if x.infinite:
            axes.plot(x.positions[-1:], values[-1:], "o", color=colour, ms=3)
    x.dress(axes, "x")
    axes.grid(color="0.9", lw=0.5)
    axes.margins(x=0.02)


def draw_points(axes: Axes, x: Scale, series: dict[str, Values]) -> None:
    """Draw a dot for each scene; several series are told apart by shade and by mark."""
    marks = ("o", "^", "s")
    for i, (label, values) in enumerate(series.items()):
        colour = COLOURS(0.25 + 0.6 * i / max(1, len(series) - 1))
        mark = marks[i % len(marks)]
        axes.plot(x.positions, values, mark, color=colour, ms=3, mec="white", mew=0.3, label=label)
    if len(series) > 1:
        axes.legend(fontsize=7, framealpha=0.9)
    x.dress(axes, "x")
    axes.grid(color="0.9", lw=0.5)
