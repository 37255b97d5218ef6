"""Measured points on a picture of curves: read from a file, and drawn into its panels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.study.text.quantities import factor_of_column, scaled
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.wording import nearest, shown

Values = NDArray[np.float64]

NAMES: Final = {
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
        found = read_columns(file, only=[word for own in NAMES.values() for word in own])
        there = {quantity: word for quantity, own in NAMES.items() for word in reversed(own) if word in found.values}
        values = {quantity: _scaled(found, quantity, word, si=si) for quantity, word in there.items()}
    except ColumnsError as error:
        raise DatasetError(f"--data {file}: {error}") from None
    sound = np.isfinite([*values.values()]).all(axis=0)
    if len(there) < 2:
        raise DatasetError(f"--data {file}: {_missing(found, [*there.values()])}")
    if not any({*plane} <= there.keys() for plane in planes):
        has = " and ".join(there)
        raise DatasetError(f"--data {file}: has {has}, which no panel has along and up; choose others with --x and --y")
    if not sound.any():
        raise DatasetError(f"--data {file}: no row has numbers in all of {', '.join(there.values())}; add some")
    left_out = int(np.count_nonzero(~sound))
    note = f"{file}: {counted(left_out, 'row')} left out, without a number in each column"
    return Points(values={name: row[sound] for name, row in values.items()}, notes=(note,) if left_out else ())


def _missing(found: Columns, there: Sequence[str]) -> str:
    """Say which columns are wanted, and which one may be meant."""
    known = [word for own in NAMES.values() for word in own if len(word) > 1]
    others = [name for name in found.others if nearest(name, known)]
    meant = f'; rename {shown(others[0])} to "{nearest(others[0], known)}"' if others else "; name them in the header"
    has = f"has {there[0]} alone" if there else "has none of them"
    return f"two of the columns indentation, load and contact_radius are drawn, and the file {has}{meant}"


def _scaled(found: Columns, quantity: str, word: str, *, si: bool) -> Values:
    """Give a column in the units of the dataset."""
    if si:
        return scaled(found.values[word], factor_of_column(found, word, KEYS[quantity]))
    if unit := found.units.get(word):
        remedy = "give the study its units, or write the ratio without one"
        raise ColumnsError(f"{word} [{unit}] has a unit, and the curves have none; {remedy}")
    return found.values[word]
