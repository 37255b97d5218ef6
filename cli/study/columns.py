"""
Columns of numbers in a file: text with a header (CSV), or variables of one dimension in NetCDF.

The bytes of a file are read once; its fingerprint is theirs.
"""

import csv
import hashlib
import io
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.files import read_at_most
from gradhesion.cli.terminal.wording import did_you_mean, shown

MOST_BYTES: Final = 2**29
"""The largest file that is read: ten million rows of some columns."""

MOST_COLUMNS: Final = 1_000
"""More of them are hardly meant as a table."""

_HEAD: Final = re.compile(r"\s*(.*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*")
"""A name, and in brackets its unit."""

_MAGIC: Final = (b"\x89HDF\r\n\x1a\n", b"CDF")
"""How files in NetCDF begin."""


class ColumnsError(ValueError):
    """A file has no columns of numbers; the message says why, and what to do, without the name of the file."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Columns:
    """The columns of a file, all of one length."""

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


Words = Mapping[str, Mapping[str, float]]
"""Of columns of words: the number for each word that they may have."""


def read_columns(path: Path, only: Collection[str] | None = None, words: Words | None = None) -> Columns:
    """
    Read a file.

    Parameters
    ----------
    path
        Of a file in NetCDF, whose variables of one dimension are the columns; or of a text in UTF-8: lines that begin
        with # are left out, the first other one is the header, `name` or `name [unit]` between commas, semicolons or
        tabs (or else spaces), and each one that follows is a row of numbers, nan and inf among them.
    only
        The names of the columns that are read, of those that are there; the others may hold anything. All if None.
    words
        The columns of a text that have words, with the number for each of them.

    Returns
    -------
    The columns, each of one row or more; what is missing in NetCDF is NaN.

    Raises
    ------
    ColumnsError
        It cannot be read, or has no columns of numbers.

    Notes
    -----
    10^6 rows of six columns take 0.8 s.
    """
    try:
        size = path.stat().st_size
        if path.is_file() and size > MOST_BYTES:
            raise ColumnsError(f"the file is larger than {MOST_BYTES >> 20} MiB; split it")
        content = read_at_most(path, MOST_BYTES)
    except (OSError, ValueError) as error:
        if isinstance(error, ColumnsError):
            raise
        reason = getattr(error, "strerror", None) or str(error)
        raise ColumnsError(f"the file cannot be read ({reason}); name a table of numbers in CSV or NetCDF") from None
    if not content.strip():
        what = f"has {size:,} bytes of white space" if content else "has 0 bytes"
        raise ColumnsError(f"the file {what}; name a table with a header and a row of numbers")
    sha256 = hashlib.sha256(content).hexdigest()
    if content.startswith(_MAGIC):
        return _of_netcdf(content, sha256, only)
    return _of_text(content, sha256, only, words)


def _of_text(content: bytes, sha256: str, only: Collection[str] | None = None, words: Words | None = None) -> Columns:
    """Read the columns of a text."""
    words = words or {}
    lines = _lines(content)
    try:
        number, header = next(lines)
    except StopIteration:
        raise ColumnsError("the file has comments only; name a table with a header and a row of numbers") from None
    except UnicodeDecodeError:
        raise ColumnsError("the file is not text in UTF-8; name a table of numbers in CSV or NetCDF") from None
    names, units, delimiter = _header(header, number)
    read = [i for i, name in enumerate(names) if only is None or name in only]
    others = tuple(name for i, name in enumerate(names) if i not in read)
    if not read:
        return Columns(values={}, units=units, sha256=sha256, place=str, others=others)
    text = io.TextIOWrapper(io.BytesIO(content), encoding="utf-8-sig")
    for _ in range(number):
        text.readline()
    try:
        if next(lines, None) is None:
            raise ColumnsError(f"the header on line {number} has no row of numbers below it; add one")
        wanted = None if only is None else read
        coded: dict[int | str, Callable[[str], Any]] = {
            i: partial(_number_of, known=words[name]) for i, name in enumerate(names) if name in words and i in read
        }
        table = np.loadtxt(
            text, delimiter=delimiter, comments="#", ndmin=2, quotechar='"', usecols=wanted, converters=coded or None
        )
    except UnicodeDecodeError:
        raise ColumnsError("the file is not text in UTF-8; save it as UTF-8") from None
    except ValueError as error:
        if isinstance(error, ColumnsError):
            raise
        raise ColumnsError(_sentence(content, number, names, delimiter, read, words)) from None
    if table.shape[1] != len(read):
        raise ColumnsError(_sentence(content, number, names, delimiter, read, words))

    def place(row: int) -> str:
        for at, (line, _) in enumerate(_lines(content)):
            if at == row + 1:  # below the header
                return f"line {line}"
        return f"row {row}"

    return Columns(
        values={names[one]: np.ascontiguousarray(table[:, i]) for i, one in enumerate(read)},
        units=units,
        sha256=sha256,
        place=place,
        others=others,
    )


def _lines(content: bytes) -> Iterator[tuple[int, str]]:
    """Give the lines that are neither empty nor a comment, with their numbers from 1."""
    for number, line in enumerate(io.TextIOWrapper(io.BytesIO(content), encoding="utf-8-sig"), 1):
        if line.partition("#")[0].strip():
            yield number, line.partition("#")[0]


def _cells(line: str, delimiter: str | None) -> list[str]:
    """Cut a line into cells."""
    if delimiter is None:
        return line.split()
    return [cell.strip() for cell in next(csv.reader([line.strip("\r\n")], delimiter=delimiter), [])]


def _header(line: str, number: int) -> tuple[list[str], dict[str, str], str | None]:
    """Read the names and units of the columns, and find what separates them."""
    delimiter = max(",;\t", key=line.count)
    separated = delimiter if delimiter in line else None
    cells = _cells(line, separated)
    if separated is None and len(cells) > 1 and any(cell[0] in "[(" for cell in cells):  # a unit after a space
        cells = re.findall(r"[^\s\[(]+\s*(?:[\[(][^\])]*[\])])?", line)
    if len(cells) > MOST_COLUMNS:
        raise ColumnsError(f"line {number} has {len(cells):,} columns, and {MOST_COLUMNS:,} are read; leave some out")
    names: list[str] = []
    units = {}
    for i, cell in enumerate(cells):
        found = _HEAD.fullmatch(cell)
        name, unit = (found[1], found[2]) if found else (cell, None)
        if not name:
            raise ColumnsError(f"column {i + 1} of the header on line {number} has no name; name it or remove it")
        if name in names:
            raise ColumnsError(f"the header on line {number} names the column {shown(name)} twice; rename one")
        names.append(name)
        if unit:
            units[name] = unit
    if all(_is_number(name) for name in names):
        raise ColumnsError(
            f"line {number} has numbers where the names of the columns are expected; add a header line above it"
        )
    return names, units, separated


def _is_number(cell: str) -> bool:
    """Tell whether a cell is a number."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _number_of(cell: str, known: Mapping[str, float]) -> float:
    """Give the number for a word; what says that there is none is NaN."""
    word = cell.strip().lower()
    return known[word] if word in known else float("nan" if word == "nan" else "no number")


def _sentence(
    content: bytes, header: int, names: list[str], delimiter: str | None, read: Sequence[int], words: Words
) -> str:
    """Say in which line a text is no table of numbers."""
    for number, line in _lines(content):
        if number <= header:
            continue
        cells = _cells(line, delimiter)
        if len(cells) != len(names):
            short = f"{len(cells):,} values under {len(names):,} names"
            return f"line {number} has {short}; give each row one value per column, separated as the header is"
        for name, cell in ((names[i], cells[i]) for i in read):
            if name in words and cell.lower() not in (*words[name], "nan"):
                return f"line {number}: {name} = {shown(cell)}; {did_you_mean(cell, [*words[name]])}"
            if name in words:
                continue
            if not cell:
                return f"line {number} has no value of {shown(name)}; give it one or remove the row"
            if not _is_number(cell):
                comma = ", with a point and not a comma" if re.fullmatch(r"[-+]?\d+,\d+", cell) else ""
                return f"line {number}: {name} = {shown(cell)} is not a number; write one{comma}"
    return "the rows are not numbers; write one value per column, separated as the header is"


def _of_netcdf(content: bytes, sha256: str, only: Collection[str] | None) -> Columns:
    """Read the variables of one dimension of a file in NetCDF."""
    import netCDF4  # noqa: PLC0415 (180 ms that a table in text does not need)

    try:
        with netCDF4.Dataset("columns", memory=content) as file:
            found = {
                name: variable
                for name, variable in file.variables.items()
                if variable.ndim == 1 and getattr(variable.dtype, "kind", "") in tuple("iuf")
            }
            others = tuple(name for name in file.variables if only is not None and name not in only)
            found = {name: variable for name, variable in found.items() if name not in others}
            lengths = {name: variable.size for name, variable in found.items()}
            whole = len({*lengths.values()}) == 1
            values = {
                name: np.ma.filled(variable[...].astype(np.float64), np.nan)
                for name, variable in found.items()
                if whole
            }
            units = {name: str(getattr(variable, "units", "1")) for name, variable in found.items()}
    except (OSError, RuntimeError, ValueError, AttributeError, MemoryError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ColumnsError(f"the file cannot be read as NetCDF ({reason}); write it again") from None
    if others and not found:
        return Columns(values={}, units={}, sha256=sha256, place=str, others=others)
    if not any(lengths.values()):
        raise ColumnsError("the file has no variable of numbers along one dimension; write columns into it")
    if not whole:
        sizes = ", ".join(f"{name} {size:,}" for name, size in list(lengths.items())[:8])
        raise ColumnsError(f"the columns differ in length ({sizes}); leave one dimension in the file")
    return Columns(
        values=values,
        units={name: unit for name, unit in units.items() if unit not in ("", "1")},
        sha256=sha256,
        place=lambda row: f"row {row}, counted from 0",
        others=others,
    )
