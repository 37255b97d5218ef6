"""The panels of a picture: a map, lines, or points, each drawn into axes that are given."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, LogNorm, Normalize
from matplotlib.contour import QuadContourSet
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.bands import Edges, draw_band, draw_bars
from gradhesion.cli.picture.doubts import CROSS, GREY, INK, Doubt
from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.scales import Scale, limit
from gradhesion.cli.picture.ticks import Numbers
from gradhesion.core.answers.flags import FLAGS

Values = NDArray[np.float64]
Flags = NDArray[np.bool_]

DASHES: Final[tuple[Any, ...]] = ("-", "--", "-.", ":", (0, (8, 4)), (0, (6, 1.5, 1, 1.5, 1, 1.5)))
"""What distinguishes lines where colours do not print; the gaps of those on top show what is below."""

MARKS: Final = 40
"""Markers along a line, about: more would hide it."""

ASIDE: Final = 0.4
"""The height within a category over which series are spread."""

FAR: Final = 50.0
"""The ratio of the greatest value to the least from which lines are drawn over a logarithm."""

FLAT: Final = 1e-9
"""Values that differ by less, over their size, are drawn as equal: what is left is rounding."""

_DARK: Final = 0.4
"""The lightness up to which colours need white hatches."""

MIDDLE: Final = 0.5
"""The lightness up to which colours need white lines."""

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
    extremes: tuple[float, float]
    """The least and the greatest of the values."""
    names: tuple[str, ...] = ()
    """What 0, 1, 2, ... stand for, where values are no more than that."""
    looks: Looks = PLAIN
    asked: bool = False
    """Whether a user has listed the levels; the ends may then be those of the values."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Between which values lines and points are drawn; all of them where they are infinite."""

    @property
    def log(self) -> bool:
        """Report whether lines and points are drawn over a logarithm."""
        return not self.names and self.extremes[0] > 0 and self.extremes[1] >= FAR * self.extremes[0]

    def inner(self) -> Values:
        """Choose the levels that have lines."""
        inner = self.levels[1:-1]
        if self.asked:
            return np.array([level for level in self.levels if level in self._listed()])
        return inner[1::2] if inner.size > 5 else inner  # the others show as edges of the bands

    def ticks(self, room: int) -> Values:
        """Choose the levels that have numbers at a colour bar with room for so many."""
        own = self.inner() if self.asked else self.levels
        return own[:: max(1, -(-own.size // max(1, room)))]

    def _listed(self) -> tuple[float, ...]:
        return self.looks.levels if isinstance(self.looks.levels, tuple) else ()


def levels_of(least: float, greatest: float, *, whole: bool = False, looks: Looks = PLAIN) -> Levels:
    """
    Choose round contour levels between two values, rising by ratios where they differ much; whole ones for numbers.

    Those that are listed are taken as they are, with the ends of the values beyond them.

    >>> levels_of(1.0, 2.0).levels
    array([1. , 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2. ])
    """
    extremes = least, greatest
    if isinstance(looks.levels, tuple):
        listed = np.array(looks.levels)
        if not ((listed >= least) & (listed <= greatest)).any():
            written = ",".join(f"{level:g}" for level in listed)
            raise DatasetError(
                f"--levels {written}: none is among the values, which are {least:.4g} to {greatest:.4g}; choose "
                "some between"
            )
        levels = np.unique(np.concatenate([listed, [least, greatest]]))
        norm = (LogNorm if levels[0] > 0 and levels[-1] > 8 * levels[0] else Normalize)(levels[0], levels[-1])
        return Levels(levels=levels, norm=norm, extremes=extremes, looks=looks, asked=True)
    if greatest - least <= FLAT * max(abs(least), abs(greatest)):
        pad = 0.05 * max(abs(least), 1e-300)
        least, greatest = least - pad, greatest + pad
    log = least > 0 and greatest > 8 * least
    if log:
        decades = range(int(np.floor(np.log10(least))), int(np.ceil(np.log10(greatest))) + 1)
        steps = next((steps for most, steps in _STEPS if greatest < most * least), (1.0,))
        rising = np.array([step * 10.0**decade for decade in decades for step in steps])
    else:
        rising = np.asarray(MaxNLocator(looks.levels or 11, steps=[1, 2, 2.5, 5, 10]).tick_values(least, greatest))
    if whole:
        rising = np.unique(np.append(np.round(rising), np.ceil(greatest) + 1.0))
    first = max(0, int(np.searchsorted(rising, least, side="right")) - 1)
    levels = rising[first : int(np.searchsorted(rising, greatest)) + 1]
    if looks.levels and levels.size > looks.levels + 1:  # ratios have steps of their own
        kept = np.unique(np.round(np.linspace(0, levels.size - 1, max(2, looks.levels + 1))).astype(int))
        levels = levels[kept]
    norm = (LogNorm if log else Normalize)(levels[0], levels[-1])
    return Levels(levels=levels, norm=norm, extremes=extremes, looks=looks)


def limited(levels: Levels, values: Values, name: str) -> Levels:
    """Give lines and points the limits that are chosen; scale and unit then suit what is between them."""
    span = levels.looks.ylim
    if levels.names:
        levels.looks.refuse(["ylim"], f"{name} is drawn as categories")
        return levels
    least, greatest = float(values.min()), float(values.max())
    low, high = span.within(name, *((least, greatest) if least < greatest else levels.levels[[0, -1]].tolist()))
    extremes = (low if np.isfinite(low) else least, high if np.isfinite(high) else greatest)
    return replace(levels, extremes=extremes, limits=(low, high))


def levels_of_flags(codes: Values, looks: Looks = PLAIN) -> Levels:
    """Give each code of a status a level of its own, named by its flags; values are to be places among the codes."""
    names = []
    for code in codes:
        flags = [name.replace("_", " ") for name, bit in FLAGS.items() if int(code) & bit]
        names.append("\n+ ".join(flags) or "nothing to report")
    return levels_of_names(names, looks)


def levels_of_names(names: Sequence[str], looks: Looks = PLAIN) -> Levels:
    """Give each of some names a level of its own; values are to be places among them."""
    edges: Values = np.arange(len(names) + 1, dtype=np.float64) - 0.5
    norm = BoundaryNorm(edges, looks.colours.N)
    return Levels(levels=edges, norm=norm, extremes=(0.0, len(names) - 1.0), names=tuple(names), looks=looks)


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
