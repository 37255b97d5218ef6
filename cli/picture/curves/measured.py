"""Measured points on a picture of curves: read from a file, in the units of the picture, and drawn into its panels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.curves.panels import Values
from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.study.text.quantities import si_value
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import nearest, shown

NAMES: Final = {
    "contact_radius": ("contact_radius", "radius", "a"),
    "indentation": ("indentation", "depth", "delta"),
    "load": ("load", "force", "P"),
}
"""What a column of each quantity may be called."""

UNITS: Final = {"contact_radius": ("c0", "nm"), "indentation": ("c0", "nm"), "load": ("preload", "nN")}
"""For each quantity a key of its dimension, and a unit to name."""

POINTS: Final[dict[str, Any]] = {
    "ls": "",
    "marker": "o",
    "mfc": "white",
    "mec": "0.1",
    "mew": 0.5,
    "ms": 2.8,
    "zorder": 3,
}
"""How points look: on top of the lines, which are wider than they."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Points:
    """Measured points."""

    name: str
    values: Mapping[str, Values]
    """By the quantity, in SI units or, of a picture without, as the dataset has them."""
    notes: tuple[str, ...] = field(default=())
    """What was left out."""


def read_points(file: Path, *, si: bool) -> Points:
    """
    Read measured points.

    Parameters
    ----------
    file
        A table (CSV or NetCDF) with two or more of the columns indentation, load (positive presses) and
        contact_radius; others are left aside, and so are rows without a number.
    si
        Whether the picture has units; then the columns have one in the header, else they are delta/R,
        P/(1.5 pi R dgamma) and a/R without one.

    Raises
    ------
    DatasetError
        The file cannot be read, or has other columns or units.
    """
    words = [word for own in NAMES.values() for word in own]
    try:
        found = read_columns(file, only=words)
    except ColumnsError as error:
        raise DatasetError(f"--data {file}: {error}") from None
    columns = {quantity: next((word for word in own if word in found.values), "") for quantity, own in NAMES.items()}
    there = {quantity: word for quantity, word in columns.items() if word}
    if len(there) < 2:
        raise DatasetError(f"--data {file}: {_missing(found, there)}")
    values = {quantity: _scaled(found, quantity, word, file, si=si) for quantity, word in there.items()}
    sound = np.all([np.isfinite(row) for row in values.values()], axis=0)
    left_out = int(np.count_nonzero(~sound))
    if not sound.any():
        raise DatasetError(f"--data {file}: no row has numbers in all of {', '.join(there.values())}; add some")
    rows = "row was" if left_out == 1 else "rows were"
    notes = (f"{file}: {left_out:,} {rows} left out, without a number in each column",) if left_out else ()
    return Points(name=file.name, values={name: row[sound] for name, row in values.items()}, notes=notes)


def _missing(found: Columns, there: Mapping[str, str]) -> str:
    """Say which columns are wanted, and which one may be meant."""
    known = [word for own in NAMES.values() for word in own if len(word) > 1]
    others = [name for name in found.others if nearest(name, known)]
    meant = f'; rename {shown(others[0])} to "{nearest(others[0], known)}"' if others else "; name them in the header"
    has = f"has {next(iter(there.values()))} alone" if there else "has none of them"
    return f"two of the columns indentation, load and contact_radius are drawn, and the file {has}{meant}"


def _scaled(found: Columns, quantity: str, word: str, file: Path, *, si: bool) -> Values:
    """Give a column in the units of the dataset."""
    unit, (key, example) = found.units.get(word, ""), UNITS[quantity]
    if not si and unit:
        raise DatasetError(
            f"--data {file}: {word} [{unit}] has a unit, and the curves have none; give the study its units, with "
            "[physical], or write the ratio without a unit"
        )
    if not si:
        return found.values[word]
    if not unit:
        raise DatasetError(
            f"--data {file}: the column {word} has no unit, and the curves have; write it after the name in brackets, "
            f"as {word} [{example}]"
        )
    try:
        return found.values[word] * si_value(f"1 {unit}", key)
    except ValueError:
        what = "force" if quantity == "load" else "length"
        raise DatasetError(
            f"--data {file}: the unit of {word} [{unit}] is no {what}; write for example {word} [{example}]"
        ) from None


def planes_of(points: Points, planes: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    """
    List the planes that points can be drawn in.

    Raises
    ------
    DatasetError
        There is none.
    """
    there = [plane for plane in planes if {*plane} <= points.values.keys()]
    if not there:
        raise DatasetError(
            f"--data {points.name}: has {' and '.join(points.values)}, which no panel of this picture has along and "
            "up; choose another panel with --x and --y"
        )
    return there


def draw_points(axes: Axes, points: Points, along: str, up: str, units: Mapping[str, Unit]) -> None:
    """Draw the points into a panel, if they have both of its quantities."""
    if {along, up} <= points.values.keys():
        x, y = (points.values[name] / 10.0 ** units[name].power for name in (along, up))
        axes.plot(x, y, **POINTS)


def legend_entry() -> Line2D:
    """Make the entry of the legend."""
    return Line2D([], [], **POINTS, label="measured")
