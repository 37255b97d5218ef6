"""
Columns of numbers in a text.

NumPy's reader takes a plain table (fast and strict: pandas fills short rows with NaN, and cuts long ones where columns
are chosen); whatever it refuses is read once more by the csv module of Python, which knows quotes, and line by line,
which gives decimal commas, empty cells and trailing separators their meaning, or a mistake its line.
"""

import re
from array import array
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.tables.cells import WholeNumbers, is_number, number, quoted, word
from gradhesion.cli.tables.columns import Columns, ColumnsError, Wanted
from gradhesion.cli.tables.header import Header, Text, header_of, looks_like_a_table, rows_of, text_of

_Readers = Mapping[int, Callable[[str], float]]
"""For each column that is read, by its place: what reads a cell."""

_HUGE: Final = re.compile(rb"\d{300}|[eE]\+?\d{3}")
"""What may be beyond the largest number."""
_COMMA: Final = re.compile(r"[-+]?\d*,\d+(?:[eE][-+]?\d+)?")
"""A number with a decimal comma."""
_THOUSANDS: Final = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}")
"""One that may be a whole number with a comma between thousands."""


def of_text(content: bytes, sha256: str, wanted: Wanted) -> Columns:
    """
    Read the columns of a text.

    Raises
    ------
    ColumnsError
        It is no table of numbers.
    """
    text = text_of(content)
    try:
        header = header_of(text, wanted)
        others = tuple(name for i, name in enumerate(header.names) if i not in header.read)
        if not header.read:
            if not looks_like_a_table(text, header):
                raise ColumnsError(
                    "the file is not a table of numbers; name one whose first line has the names of its columns"
                )
            return Columns(values={}, units=header.units, sha256=sha256, place=str, others=others)
        numbers = {name: WholeNumbers() for name in wanted.whole}
        readers: dict[int, Callable[[str], float]] = {}
        for i in header.read:
            name = header.names[i]
            readers[i] = numbers[name].code if name in numbers else number
            if name in wanted.words:
                readers[i] = partial(word, words=wanted.words[name])
        columns = _plain(text, header, readers) or _line_by_line(text, header, readers)
    except UnicodeError:
        raise ColumnsError("the file is not text in UTF-8; save it as UTF-8, in a spreadsheet as CSV UTF-8") from None

    def place(row: int) -> str:
        for at, (line, _) in enumerate(rows_of(text, header)):
            if at == row:
                return f"line {line}"
        return f"row {row}"

    values = {header.names[i]: column for i, column in columns.items()}
    return Columns(
        values=values,
        units=header.units,
        sha256=sha256,
        place=place,
        others=others,
        whole={name: own.numbers(values[name]) for name, own in numbers.items() if name in values},
    )


def _plain(text: Text, header: Header, readers: _Readers) -> dict[int, NDArray[np.float64]] | None:
    """Read the columns of a table of numbers alone, with as many cells in each row; None if it is none."""
    if b'"' in text.content:
        return None
    file = text.opened()
    for _ in range(header.last):
        file.readline()
    kinds = np.dtype([(str(i), "f8" if i in readers else "U1") for i in range(len(header.names))])
    own: dict[int | str, Callable[[str], Any]] = {i: read for i, read in readers.items() if read is not number}
    try:
        table = np.loadtxt(
            file, kinds, delimiter=header.separator, comments="#", ndmin=1, converters=own or None, encoding=None
        )
    except UnicodeError:
        raise
    except ValueError:
        return None
    found = {i: np.ascontiguousarray(table[str(i)]) for i in readers}
    if any(np.isinf(column).any() for column in found.values()) and (
        text.encoding != "utf-8-sig" or _HUGE.search(text.content)
    ):
        return None
    return found


def _line_by_line(text: Text, header: Header, readers: _Readers) -> dict[int, NDArray[np.float64]]:
    """Read the columns of any table."""
    commas = _has_decimal_commas(text, header, [i for i, read in readers.items() if not isinstance(read, partial)])
    found = {i: array("d") for i in readers}
    for line, cells in rows_of(text, header):
        for i, read in readers.items():
            cell = cells[i].replace(",", ".") if commas and _COMMA.fullmatch(cells[i]) else cells[i]
            try:
                found[i].append(read(cell))
            except ValueError as error:
                raise ColumnsError(f"line {line}: {header.label(i)}{quoted(cells[i])} {error}") from None
    return {i: np.array(values) for i, values in found.items()}


def _has_decimal_commas(text: Text, header: Header, columns: list[int]) -> bool:
    """
    Tell whether the numbers of a table have decimal commas.

    Raises
    ------
    ColumnsError
        Some have and others do not, or the commas may as well stand between thousands.
    """
    points = commas = sure = 0
    first = ""
    for line, cells in rows_of(text, header):
        for i in columns:
            if "." in cells[i] and is_number(cells[i]):
                points = points or line
            elif "," in cells[i] and _COMMA.fullmatch(cells[i]):
                sure = sure or (0 if _THOUSANDS.fullmatch(cells[i]) else line)
                first = first or f"{header.label(i)}{quoted(cells[i])}"
                commas = commas or line
    if commas and points:
        raise ColumnsError(
            f"line {commas} has a comma and line {points} a point in a number; write points for the decimals, and "
            "nothing between thousands"
        )
    if commas and not sure:
        raise ColumnsError(
            f"line {commas}: {first} may be a decimal or thousands, like every number of the file with a comma; "
            "write a point for the decimals, and nothing between thousands"
        )
    return bool(commas)
