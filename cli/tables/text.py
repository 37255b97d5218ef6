"""Columns of numbers in a text: its lines, the names and units above the rows, and the cells of the rows."""

import csv
import io
import re
from array import array
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Final

from gradhesion.cli.tables.columns import ERRORS, Columns, ColumnsError, Wanted, converted, is_number, number, tidy
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.wording import shown

LONGEST: Final = 2**15
"""Characters of a header: above any that is meant as one."""
_HEAD: Final = re.compile(r"\s*(.*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*")
"""A name, and in brackets its unit."""
_UNIT: Final = re.compile(r"[\[(]?\s*([^\W\d_][^\[\]()]{0,19}?|[%°\u2126-])\s*[\])]?")
"""A unit in a row of its own."""
_WHOLE: Final = re.compile(r"[-+]?\d*(?:[eE][-+]?\d+)?")
"""A part of a number that a comma has cut in two."""
_COMMA: Final = re.compile(r"[-+]?\d*,\d+(?:[eE][-+]?\d+)?")
"""A number with a decimal comma."""
_THOUSANDS: Final = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}")
"""One that may be a whole number with a comma between thousands."""
_CLOSED: Final = re.compile(r'"[^"]*"|[\[(][^\])]*[\])]')
"""What may have any character within, a separator too."""
_UNQUOTED: Final = re.compile(rf'(?:[^"#]|"[^"]*"?|{ERRORS})*')
"""What stands before a comment."""
_BOMS: Final = {b"\xff\xfe\0\0": "utf-32", b"\0\0\xfe\xff": "utf-32", b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}
"""Marks at the beginning of a text, and what it is written in."""


@dataclass(frozen=True, kw_only=True)
class Header:
    """What stands above the rows."""

    names: tuple[str, ...]
    units: dict[str, str]
    separator: str | None
    """What is between two cells; None for white space."""
    read: tuple[int, ...]
    """The columns that are read, counted from 0."""
    last: int
    """The last line above the rows."""


def of_text(content: bytes, sha256: str, wanted: Wanted) -> Columns:
    """Read the columns of a text."""
    text = _decoded(content)
    header = _header_of(text, wanted)
    lines, columns = array("q"), {i: list[str]() for i in header.read}
    for line, cells in _rows(text, header):
        lines.append(line)
        for i, column in columns.items():
            column.append(cells[i])
    readers = {i: wanted.reader(header.names[i]) for i in header.read}
    numeric = {header.names[i]: columns[i] for i, read in readers.items() if read is number}
    if "," in text and (header.separator != "," or '"' in text) and _has_decimal_commas(numeric, lines):
        for i, column in columns.items():
            columns[i] = [cell.replace(",", ".") if _COMMA.fullmatch(cell) else cell for cell in column]

    def place(row: int) -> str:
        return f"line {lines[row]}"

    return Columns(
        values={header.names[i]: converted(header.names[i], own, readers[i], place) for i, own in columns.items()},
        units=header.units,
        sha256=sha256,
        place=place,
        others=tuple(name for i, name in enumerate(header.names) if i not in header.read),
    )


def _decoded(content: bytes) -> str:
    """Decode a text by the mark at its beginning, or as UTF-8."""
    encoding = next((name for mark, name in _BOMS.items() if content.startswith(mark)), "utf-8-sig")
    if encoding == "utf-8-sig" and b"\0" in content:
        raise ColumnsError("the file is not text; name a table of numbers in CSV or NetCDF")
    try:
        return content.decode(encoding)
    except UnicodeError:
        raise ColumnsError("the file is not text in UTF-8; save it as UTF-8, in a spreadsheet as CSV UTF-8") from None


def _lines(text: str) -> Iterator[tuple[int, str]]:
    """Give the lines that are neither empty, nor separators or a comment alone, with their numbers from 1."""
    for place, line in enumerate(io.StringIO(text, newline=None), 1):
        own = next(_UNQUOTED.finditer(line))[0] if "#" in line else line
        if own.strip(' \t\r\n,;"'):
            yield place, own


def _cells_of(place: int, line: str, separator: str | None, count: int) -> list[str]:
    """Cut a line into cells, without empty ones at its end beyond a number of columns."""
    cells = line.split(separator)
    if '"' in line:
        try:
            cells = next(csv.reader([line.strip("\r\n")], delimiter=separator or " ", skipinitialspace=True))
        except csv.Error:
            raise ColumnsError(f"line {place} has a cell of more than 131,072 characters; shorten it") from None
        cells = [cell for cell in cells if cell or separator]
    cells = [*map(str.strip, cells)]
    while len(cells) > count and not cells[-1]:
        cells.pop()
    return cells


def _header_of(text: str, wanted: Wanted) -> Header:
    """Read the names and units of the columns, and find what separates them."""
    lines = _lines(text)
    place, line = next(lines, (0, ""))
    if given := re.fullmatch(r"sep=([;,|\t])\s*", line):  # as spreadsheets write it
        place, line = next(lines, (0, ""))
    if not place:
        raise ColumnsError("the file has comments only; name a table with a header and a row of numbers")
    if len(line) > LONGEST:
        raise ColumnsError(f"line {place} is too long for a header, {len(line):,} characters; name a table of numbers")
    cells, separator = _heads_of(place, line, given[1] if given else None)
    if all(is_number(cell) for cell in cells if cell):
        place, cells = _names_in_a_comment(text, place, len(cells), separator)
    last = place
    heads = [_HEAD.fullmatch(cell) for cell in cells]
    names = wanted.named([head[1] if head else cell for head, cell in zip(heads, cells, strict=True)], cells)
    units = tidy({name: head[2] or "" for name, head in zip(names, heads, strict=True) if head})
    read = tuple(i for i, name in enumerate(names) if wanted.only is None or name in wanted.only)
    rows = [row for row in islice(_lines(text), 4) if row[0] > place]
    if not rows:
        raise ColumnsError(f"the header on line {place} has no row of numbers below it; add one")
    if len(rows) > 1 and not units:
        below = _units_below(_cells_of(*rows[0], separator, len(names)), names, read, wanted)
        units, last = (units, last) if below is None else (below, rows[0][0])
    for i in read:
        if not names[i]:
            raise ColumnsError(f"column {i + 1} of the header on line {place} has no name; name it or remove it")
        if (first := names.index(names[i])) < i:
            words = f"columns {first + 1} and {i + 1} of the header on line {place} have one name, {shown(names[i])}"
            raise ColumnsError(f"{words}; rename one")
    return Header(names=names, units=units, separator=separator, read=read, last=last)


def _heads_of(place: int, line: str, separator: str | None) -> tuple[list[str], str | None]:
    """Cut a header into cells: at what is most often outside quotes and brackets, or at white space (None)."""
    bare = _CLOSED.sub("", line)
    most = max(";\t,", key=bare.count)
    separator = separator or (most if most in bare else None)
    cells = _cells_of(place, line, separator, 0)
    if separator is None and len(cells) > 1 and any(cell[0] in "[(" for cell in cells):  # a unit after a space
        cells = re.findall(r"[^\s\[(]+\s*(?:[\[(][^\])]*[\])])?", line)
    return cells, separator


def _names_in_a_comment(text: str, before: int, columns: int, separator: str | None) -> tuple[int, list[str]]:
    """Find the names in the last comment above the first row that has as many words, as instruments write them."""
    comments = list(islice(enumerate(io.StringIO(text, newline=None), 1), before - 1))
    for place, line in reversed(comments):
        cells, own = _heads_of(place, line.strip().lstrip("#").removeprefix(" columns:").strip(), None)
        if own == separator and len(cells) == columns and not any(map(is_number, cells)):
            return place, cells
    words = f"line {before} has numbers where the names of the columns are expected"
    raise ColumnsError(f"{words}; add a header line above it")


def _units_below(cells: list[str], names: Sequence[str], read: Sequence[int], wanted: Wanted) -> dict[str, str] | None:
    """Read a row of units below the names; None if it is none."""
    if len(cells) != len(names) or any(is_number(cell) for cell in cells):
        return None
    if any(cells[i].lower() in wanted.words.get(names[i], {}) for i in read):
        return None
    own = {names[i]: cells[i] for i in read if cells[i] and names[i] not in (*wanted.words, *wanted.whole)}
    units = {name: unit[1] for name, cell in own.items() if (unit := _UNIT.fullmatch(cell))}
    return tidy(units) if own and len(units) == len(own) else None


def _rows(text: str, header: Header) -> Iterator[tuple[int, list[str]]]:
    """Give the cells of each row, with the number of its line."""
    count = len(header.names)
    for place, line in _lines(text):
        if place <= header.last:
            continue
        cells = _cells_of(place, line, header.separator, count)
        if len(cells) != count:
            remedy = "give each row one value per column; lines above the header begin with #"
            whole = sum(bool(cell and _WHOLE.fullmatch(cell)) for cell in cells)
            if header.separator == "," and whole >= 2 * (len(cells) - count) > 0:  # each such comma parts two
                remedy = "if its numbers have decimal commas, write points, or separate the columns by semicolons"
            values = f"{counted(len(cells), 'value')} under {counted(count, 'name')}"
            raise ColumnsError(f"line {place} has {values}; {remedy}")
        yield place, cells


def _has_decimal_commas(columns: Mapping[str, Sequence[str]], lines: Sequence[int]) -> bool:
    """Tell whether numbers have decimal commas (ColumnsError where that cannot be told)."""
    commas, points = list[tuple[int, str, str]](), list[int]()
    for name, column in columns.items():
        for line, cell in zip(lines, column, strict=True):
            if "." in cell and is_number(cell):
                points.append(line)
            elif "," in cell and _COMMA.fullmatch(cell):
                commas.append((line, name, cell))
    remedy = "write points for the decimals, and nothing between thousands"
    if commas and points:
        raise ColumnsError(f"line {min(commas)[0]} has a comma and line {min(points)} a point in a number; {remedy}")
    if commas and all(_THOUSANDS.fullmatch(cell) for *_, cell in commas):
        line, name, cell = min(commas)
        doubt = "may be a decimal or thousands, like every number of the file with a comma"
        raise ColumnsError(f"line {line}: {name} = {shown(cell)} {doubt}; {remedy}")
    return bool(commas)
