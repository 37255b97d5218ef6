"""What is read from a table of numbers: which of its columns, and what they are then."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.tables.cells import number, whole_number, word


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
        """Give the columns of a file the names that are wanted of them, where they differ in case or have their unit.

        >>> Wanted(only=("height", "Load (nN)")).named(["Height", "Load"], ["Height (nm)", "Load (nN)"])
        ('height', 'Load (nN)')
        """
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
    """The fingerprint of the file."""
    place: Callable[[int], str]
    """Says where a row is, counted from 0."""
    others: tuple[str, ...] = ()
    """The columns that are not read."""

    @property
    def rows(self) -> int:
        """The number of rows."""
        return next(iter(self.values.values())).size


def tidy(unit: str) -> str:
    """Give a unit as it is written; nothing for what says that there is none.

    >>> tidy("um"), tidy("-"), tidy("1")
    ('um', '', '')
    """
    return "" if unit in ("", "1", "-") else unit


def changed(found: str, expected: str, remedy: str, *, several: bool = False) -> str:
    """Say that a file is not the one that a study was written for, or that several are not, by their fingerprints."""
    what, back = ("files are not the ones", "those") if several else ("file is not the one", "that file")
    fingerprints = f"its sha256 is {found[:12]}..., not {expected[:12]}..."
    return f"the {what} that this study was written for: {fingerprints}; put {back} back, or {remedy}"
