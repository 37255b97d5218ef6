"""What is read from a table of numbers: which of its columns, and what its cells and columns are then."""

import math
import re
from array import array
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.terminal.wording import did_you_mean, shown

_NUMBER: Final = re.compile(
    r"[+-]?(?:(?:\d+(?:\.\d*)?|\.\d+)(?:e[+-]?\d+)?|inf(?:inity)?|nan)", re.ASCII | re.IGNORECASE
)
"""A number as files have it: what Python reads besides (`1_000`, digits of other scripts) is a mistake there."""
ERRORS: Final = r"#(?:N/A|DIV/0!|VALUE!|REF!|NUM!|NAME\?|NULL!)"
"""What a spreadsheet writes where it has no number."""
_FORM: Final = ", with a point for the decimals, nothing between thousands, and its unit in the header"
"""How a number is written."""
_LARGEST: Final = 2.0**53
"""From here on not every whole number is a float."""


def number(cell: str) -> float:
    """Give the number in a cell; NaN if it is empty, or an error of a spreadsheet."""
    cell = cell.strip()
    if _NUMBER.fullmatch(cell):
        value = float(cell)
        if math.isinf(value) and "n" not in cell.lower():
            raise ValueError("is beyond 1.8e308, the largest number; write it in a larger unit, or inf")
        return value
    if cell and not re.fullmatch(ERRORS, cell):
        raise ValueError("is not a number; write one" + (_FORM if any(map(str.isdigit, cell)) else ""))
    return math.nan


def is_number(cell: str) -> bool:
    """Tell whether a cell is a number."""
    return _NUMBER.fullmatch(cell.strip()) is not None


def word(cell: str, words: Mapping[str, float]) -> float:
    """Give the number for a word, or that in its place; NaN if there is none."""
    found = cell.strip().lower()
    if found in words:
        return words[found]
    value = number(found) if not found or is_number(found) else math.inf
    if math.isnan(value) or value in words.values():
        return value
    raise ValueError(f"is not one of its words; {did_you_mean(found, tuple(words))}")


def whole_number(cell: str) -> float:
    """Give the whole number in a cell; NaN if there is none."""
    value = number(cell)
    if math.isnan(value) or (value.is_integer() and abs(value) < _LARGEST):
        return value
    raise ValueError("is not a whole number of at most 15 digits; write one")


class ColumnsError(ValueError):
    """A file has no columns of numbers: the message says why, and what to do, without the name of the file."""


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """Which columns are read, and as what."""

    only: Collection[str] | None = None
    """The names of the columns that are read, of those that are there; the others may hold anything. All if None."""
    words: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    """Of columns of words: the number for each word that they may have (or which they have in its place)."""
    whole: Collection[str] = ()
    """The columns of whole numbers."""

    def named(self, names: Sequence[str], heads: Sequence[str] = ()) -> tuple[str, ...]:
        """Give the columns of a file the names that are wanted of them, where these differ in case or have a unit."""
        found = [*names]
        for wanted in self.only or ():
            both = ((name.lower(), head.lower()) for name, head in zip(names, heads or names, strict=True))
            alike = [i for i, own in enumerate(both) if wanted.lower() in own]
            if wanted not in names and len(alike) == 1:
                found[alike[0]] = wanted
        return tuple(found)

    def reader(self, name: str) -> Callable[[str], float]:
        """Give what reads a cell of a column."""
        if name in self.words:
            return partial(word, words=self.words[name])
        return whole_number if name in self.whole else number


@dataclass(frozen=True, kw_only=True, eq=False)
class Columns:
    """The columns of a file, all of one length; NaN where a value is missing."""

    values: dict[str, NDArray[np.float64]]
    """By the names in the header."""
    units: dict[str, str]
    """Of the columns that have one."""
    sha256: str
    place: Callable[[int], str]
    """Says where a row is, counted from 0."""
    others: tuple[str, ...] = ()
    """The columns that are not read."""


def converted(
    name: str, cells: Sequence[str], read: Callable[[str], float], place: Callable[[int], str]
) -> NDArray[np.float64]:
    """Read the cells of a column; ColumnsError names the place of the first one that is wrong."""
    if read is number and (whole := "".join(cells)).isascii() and "_" not in whole:
        with suppress(ValueError):
            plain = np.array(cells, dtype=np.float64)  # all at once, which is ten times as fast
            if not np.isinf(plain).any():
                return plain
    found = array("d")
    for row, cell in enumerate(cells):
        try:
            found.append(read(cell))
        except ValueError as error:
            raise ColumnsError(f"{place(row)}: {name} = {shown(cell)} {error}") from None
    return np.array(found)


def tidy(units: Mapping[str, str]) -> dict[str, str]:
    """Leave out what says that there is no unit."""
    return {name: unit for name, unit in units.items() if unit not in ("", "1", "-")}


def changed(found: str, expected: str, remedy: str) -> str:
    """Say that what a study names is not what it was written for, by the fingerprints."""
    fingerprints = f"its sha256 is {found[:12]}..., not {expected[:12]}..."
    return f"this is not what the study was written for: {fingerprints}; put that back, or {remedy}"
