"""The text of a table: its lines, the cells of a line, and the names and units above the rows."""

import csv
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Final

from gradhesion.cli.tables.cells import ERRORS, is_number
from gradhesion.cli.tables.columns import ColumnsError, Wanted, tidy
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.wording import shown

MOST_COLUMNS: Final = 1_000
"""More of them are hardly meant as a table."""

LONGEST: Final = 2**15
"""Characters of a header: above any that is meant as one."""

_HEAD: Final = re.compile(r"\s*(.*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*")
"""A name, and in brackets its unit."""
_UNIT: Final = re.compile(r"[\[(]?\s*([^\W\d_][^\[\]()]{0,19}?|[%°\u2126-])\s*[\])]?")
"""A unit in a row of its own."""
_WHOLE: Final = re.compile(r"[-+]?\d*(?:[eE][-+]?\d+)?")
"""A part of a number that a comma has cut in two."""
_CLOSED: Final = re.compile(r'"[^"]*"|[\[(][^\])]*[\])]')
"""What may have any character within, a separator too."""
_UNQUOTED: Final = re.compile(rf'(?:[^"#]|"[^"]*"?|{ERRORS})*')
"""What stands before a comment."""
_BOMS: Final = {b"\xff\xfe\0\0": "utf-32", b"\0\0\xfe\xff": "utf-32", b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}
"""Marks at the beginning of a text, and what it is written in."""


@dataclass(frozen=True, kw_only=True)
class Text:
    """A text, and what it is written in."""

    content: bytes
    encoding: str = "utf-8-sig"

    def opened(self) -> io.TextIOWrapper:
        """Open it, whatever ends its lines."""
        return io.TextIOWrapper(io.BytesIO(self.content), encoding=self.encoding)

    def lines(self) -> Iterator[tuple[int, str]]:
        """Give the lines that are neither empty, nor separators or a comment alone, with their numbers from 1."""
        for number, line in enumerate(self.opened(), 1):
            own = line
            if "#" in line:
                found = _UNQUOTED.match(line)
                own = found[0] if found else line
            if own.strip(' \t\r\n,;"'):
                yield number, own


@dataclass(frozen=True, kw_only=True)
class Header:
    """What stands above the rows."""

    names: tuple[str, ...]
    units: dict[str, str]
    separator: str | None
    """What is between two cells; None for white space."""
    read: tuple[int, ...]
    """The columns that are read, counted from 0."""
    number: int
    """The line of the names."""
    last: int
    """The last line above the rows."""
    shown: frozenset[str]
    """The names that a message may repeat."""

    def label(self, column: int) -> str:
        """Call a column by its name if the name is known, else by its place."""
        return self.names[column] if self.names[column] in self.shown else f"column {column + 1}"


def text_of(content: bytes) -> Text:
    """Find what a text is written in, by the mark at its beginning."""
    encoding = next((name for mark, name in _BOMS.items() if content.startswith(mark)), "utf-8-sig")
    if encoding == "utf-8-sig" and b"\0" in content:
        raise ColumnsError("the file is not text; name a table of numbers in CSV or NetCDF")
    return Text(content=content, encoding=encoding)


def cells_of(number: int, line: str, separator: str | None) -> list[str]:
    """
    Cut a line into cells.

    >>> cells_of(1, '1; "2;3" ;', ";")
    ['1', '2;3', '']
    """
    if '"' not in line:
        return line.split() if separator is None else [cell.strip() for cell in line.split(separator)]
    try:
        cells = next(csv.reader([line.strip("\r\n")], delimiter=separator or " ", skipinitialspace=True))
    except csv.Error:
        raise ColumnsError(f"line {number} has a cell of more than 131,072 characters; shorten it") from None
    return [cell.strip() for cell in cells if cell or separator]


def header_of(text: Text, wanted: Wanted) -> Header:
    """
    Read the names and units of the columns, and find what separates them.

    Raises
    ------
    ColumnsError
        There is none above a row.
    """
    lines = text.lines()
    number, line = next(lines, (0, ""))
    given = re.fullmatch(r"sep=([;,|\t])\s*", line)  # as spreadsheets write it
    if given:
        number, line = next(lines, (0, ""))
    if not number:
        raise ColumnsError("the file has comments only; name a table with a header and a row of numbers")
    if len(line) > LONGEST:
        raise ColumnsError(f"line {number} is too long for a header, {len(line):,} characters; name a table of numbers")
    separator = given[1] if given else _separator(line)
    cells = cells_of(number, line, separator)
    if separator is None and len(cells) > 1 and any(cell[0] in "[(" for cell in cells):  # a unit after a space
        cells = re.findall(r"[^\s\[(]+\s*(?:[\[(][^\])]*[\])])?", line)
    while cells and not cells[-1]:
        cells.pop()
    if len(cells) > MOST_COLUMNS:
        raise ColumnsError(f"line {number} has {len(cells):,} columns, and {MOST_COLUMNS:,} are read; leave some out")
    heads = [_HEAD.fullmatch(cell) for cell in cells]
    names = tuple(head[1] if head else cell for head, cell in zip(heads, cells, strict=True))
    units = {name: tidy(head[2] or "") for name, head in zip(names, heads, strict=True) if head}
    if all(is_number(name) for name in names if name):
        above = _names_in_a_comment(text, number, len(cells))
        remedy = f"remove the # before those on line {above}" if above else "add a header line above it"
        raise ColumnsError(f"line {number} has numbers where the names of the columns are expected; {remedy}")
    read = tuple(i for i, name in enumerate(names) if wanted.only is None or name in wanted.only)
    last = number
    first = next(lines, None)
    if first and not any(units.values()) and next(lines, None):
        below = _units_below(cells_of(*first, separator), names, read, wanted)
        units, last = (below, first[0]) if below else (units, last)
    elif not first:
        raise ColumnsError(f"the header on line {number} has no row of numbers below it; add one")
    found = Header(
        names=names,
        units={name: unit for name, unit in units.items() if unit},
        separator=separator,
        read=read,
        number=number,
        last=last,
        shown=frozenset({*(wanted.only or ()), *wanted.known}),
    )
    _check_names(found)
    return found


def _names_in_a_comment(text: Text, before: int, columns: int) -> int:
    """Find the comment just above a row that has as many words as the row has cells, as numpy.savetxt writes names."""
    comment = next((line for number, line in enumerate(text.opened(), 1) if number == before - 1), "").strip()
    bare = comment.removeprefix("#").strip()
    if bare == comment:
        return 0
    words = cells_of(before - 1, bare, _separator(bare))
    return before - 1 if len(words) == columns and not any(is_number(word) for word in words) else 0


def _separator(line: str) -> str | None:
    """Find what separates the cells of a header: what is most often outside quotes and brackets; None: white space."""
    bare = _CLOSED.sub("", line)
    most = max(";\t,", key=bare.count)
    return most if most in bare else None


def _check_names(header: Header) -> None:
    """Check that each column that is read has a name of its own."""
    for i in header.read:
        if not header.names[i]:
            raise ColumnsError(
                f"column {i + 1} of the header on line {header.number} has no name; name it or remove it"
            )
        before = header.names.index(header.names[i])
        if before < i:
            name = f", {shown(header.names[i])}" if header.names[i] in header.shown else ""
            raise ColumnsError(
                f"columns {before + 1} and {i + 1} of the header on line {header.number} have one name{name}; "
                "rename one"
            )


def _units_below(cells: list[str], names: tuple[str, ...], read: tuple[int, ...], wanted: Wanted) -> dict[str, str]:
    """Read a row of units below the names; nothing if it is none."""
    while len(cells) > len(names) and not cells[-1]:
        cells.pop()
    if len(cells) != len(names) or any(is_number(cell) for cell in cells):
        return {}
    if any(cells[i].lower() in words for i in read if (words := wanted.words.get(names[i], {}))):
        return {}
    own = {names[i]: cells[i] for i in read if cells[i] and names[i] not in (*wanted.words, *wanted.whole)}
    found = {name: _UNIT.fullmatch(cell) for name, cell in own.items()}
    units = {name: tidy(unit[1]) for name, unit in found.items() if unit}
    return units if len(units) == len(own) else {}


def rows_of(text: Text, header: Header) -> Iterator[tuple[int, list[str]]]:
    """
    Give the cells of each row, with the number of its line.

    Raises
    ------
    ColumnsError
        A row is longer or shorter than the header.
    """
    count = len(header.names)
    for number, line in text.lines():
        if number <= header.last:
            continue
        cells = cells_of(number, line, header.separator)
        while len(cells) > count and not cells[-1]:
            cells.pop()
        if len(cells) != count:
            remedy = "give each row one value per column, separated as the header is"
            whole = sum(bool(cell and _WHOLE.fullmatch(cell)) for cell in cells)
            if header.separator == "," and whole >= 2 * (len(cells) - count) > 0:  # each such comma parts two
                remedy = "if its numbers have decimal commas, write points, or separate the columns by semicolons"
            values = f"{counted(len(cells), 'value')} under {counted(count, 'name')}"
            raise ColumnsError(f"line {number} has {values}; {remedy}")
        yield number, cells


def looks_like_a_table(text: Text, header: Header, rows: int = 100) -> bool:
    """Tell whether the first rows are as long as the header, and two columns have but numbers below a name."""
    try:
        first = [cells for _, cells in islice(rows_of(text, header), rows)]
    except ColumnsError:
        return False
    found = 0
    for name, column in zip(header.names, zip(*first, strict=True), strict=True):
        cells = [cell.replace(",", ".") for cell in column if cell]
        found += bool(cells) and not is_number(name) and all(map(is_number, cells))
    return found > 1
