"""What is read from a table of numbers: which of its columns, and what they are then."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


class ColumnsError(ValueError):
    """
    A file has no columns of numbers: the message says why, and what to do, without the name of the file.

    It never has a line of a file that is no table (the file may be a key, or a list of passwords, named by mistake). Of
    the header it has only names that the study or the program knows, of the cells only what looks like a mistyped
    number; all names and units of a file may be repeated only when it has been read as a table of numbers.
    """


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """Which columns are read, and as what."""

    only: Collection[str] | None = None
    """The names of the columns that are read, of those that are there; the others may hold anything. All if None."""
    known: Collection[str] = ()
    """Names that a message may repeat, beside `only`."""
    words: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    """Of columns of words: the number for each word that they may have (or which they have in its place)."""
    whole: Collection[str] = ()
    """The columns of whole numbers."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Columns:
    """The columns of a file, all of one length; NaN where a value is missing."""

    values: dict[str, NDArray[np.float64]]
    """By the names in the header."""
    units: dict[str, str]
    """Of the columns that have one."""
    sha256: str
    """The fingerprint of the file."""
    place: Callable[[int], str]
    """Says where a row is, counted from 0."""
    others: tuple[str, ...] = ()
    """The columns that are not read."""
    whole: Mapping[str, NDArray[np.int64]] = field(default_factory=dict)
    """Of the columns of whole numbers, the numbers (0 where one is missing); their ranks from 1 where one of them has
    more than 64 bits. Their `values` are numbers from 0, equal where these are."""

    @property
    def rows(self) -> int:
        """The number of rows."""
        return next(iter(self.values.values())).size


def tidy(unit: str) -> str:
    """
    Give a unit as it is written; nothing for what says that there is none.

    >>> tidy("um"), tidy("-"), tidy("1")
    ('um', '', '')
    """
    return "" if unit in ("", "1", "-") else unit


def changed(found: str, expected: str, remedy: str, *, several: bool = False) -> str:
    """Say that a file is not the one that a study was written for, or that several are not, by their fingerprints."""
    what, back = ("files are not the ones", "those") if several else ("file is not the one", "that file")
    fingerprints = f"its sha256 is {found[:12]}..., not {expected[:12]}..."
    return f"the {what} that this study was written for: {fingerprints}; put {back} back, or {remedy}"
