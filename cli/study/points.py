"""Points from a file: the scenes of a study are the rows of a table, a column a parameter."""

import json
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import OUTPUTS, SI
from gradhesion.cli.study.rules.axes import MOST_VALUES
from gradhesion.cli.study.rules.mistakes import Mistake
from gradhesion.cli.study.text import places
from gradhesion.cli.study.text.quantities import in_si
from gradhesion.cli.tables.columns import Columns, ColumnsError, changed
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.inputs import INPUTS

KEY: Final[places.Path] = ("parameters", "points")

COMMENT: Final = "a column of "
"""How the comment of a coordinate begins that is a column of a file."""

_ANY: Final = {"k": 0.5, "nu": 0.3}
"""Valid values of parameters of which 1 is none."""

OURS: Final = frozenset({*OUTPUTS, *(name + SI for name in OUTPUTS), "status"})
"""Names that a dataset has, and a file of points may not."""

_LINE: Final = re.compile(r"""(\s*(?:parameters\.)?points\s*=\s*)("[^"\\]*"|'[^']*')(\s*(?:\#.*)?)""")
"""The key on a line of its own, with what stands behind it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Points:
    """The points of a study; without a file there are none."""

    written: Any = None
    """What the study has for them."""
    file: str = ""
    sha256: str = ""
    columns: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    """The inputs that are columns and right, in SI units."""
    wrong: tuple[str, ...] = ()
    """Those that are columns and not right."""
    mistakes: tuple[Mistake, ...] = ()

    def beside(self, data: Mapping[str, Any]) -> dict[str, Any]:
        """
        Give the keys of a study with one valid value for each column.

        So that all that is known of a key is asked of what the study gives beside the file.
        """
        if self.written is None:
            return dict(data)
        whole = {**data, "layout": "points" if data.get("layout") == "grid" else data.get("layout", "points")}
        for name in (*self.columns, *self.wrong):
            key, values = INPUTS[name], self.columns.get(name)
            value = _ANY.get(name, 1.0) if values is None else float(values[0])
            table = whole.get(key.table, {})
            if isinstance(table, Mapping):
                entry = f"{value!r} {key.unit}" if key.table == "physical" and np.isfinite(value) else value
                whole[key.table] = {**table, name: str(entry) if key.table == "physical" else entry}
        return whole

    @property
    def unread(self) -> bool:
        """Whether the file could not be read, so that what it would give is not missing."""
        return bool(self.mistakes) and not self.file

    def stored(self, data: Mapping[str, Any], text: str) -> tuple[dict[str, Any], str]:
        """Give the keys and the text of a study with the fingerprint of the file; no text where it is to be made."""
        if not self.file:
            return dict(data), text
        named = {"file": self.file, "sha256": self.sha256}
        data = {**data, "parameters": {**data["parameters"], "points": named}}
        if text and self.written != named:
            number = places.lines_of(text).get(KEY, 0)
            lines = text.split("\n")
            found = _LINE.fullmatch(lines[number - 1]) if number else None
            table = f"{{ file = {json.dumps(self.file, ensure_ascii=False)}, sha256 = {json.dumps(self.sha256)} }}"
            lines[number - 1] = f"{found[1]}{table}{found[3]}" if found else ""
            text = "\n".join(lines)
            if not found or tomllib.loads(text) != data:
                text = ""
        return data, text


def points_of(
    data: Mapping[str, Any], folder: Path, columns: Mapping[str, NDArray[np.float64]] | None = None
) -> Points:
    """
    Read the points of a study.

    Parameters
    ----------
    data
        The keys of the study.
    folder
        Where the file is looked for.
    columns
        The columns of the file; it is then not read.
    """
    table = data.get("parameters")
    written = table.get("points") if isinstance(table, Mapping) else None
    named = {"file": written} if isinstance(written, str) else written
    if not isinstance(named, Mapping) or not all(isinstance(value, str) for value in named.values()):
        return Points()
    if named.keys() - {"file", "sha256"} or not named.get("file"):
        return Points()  # their form is refused
    file, expected = named["file"], named.get("sha256", "")
    if columns is not None:
        return Points(written=written, file=file, sha256=expected, columns=columns)
    try:
        found = read_columns(folder / file)
    except ColumnsError as error:
        return Points(written=written, mistakes=(Mistake(KEY, written, str(error)),))
    if expected and expected != found.sha256:
        remedy = f"write points = {json.dumps(file, ensure_ascii=False)}"
        sentence = changed(found.sha256, expected, remedy)
        return Points(written=written, mistakes=(Mistake(KEY, written, sentence),))
    mistakes = [Mistake(KEY, written, sentence) for sentence in _mistakes(data, found)]
    columns, wrong = {}, []
    for name, values in found.values.items():
        if name not in INPUTS:
            continue
        try:
            columns[name] = _column(name, values, found)
        except ColumnsError as error:
            mistakes.append(Mistake(KEY, written, str(error)))
            wrong.append(name)
    return Points(
        written=written,
        file=file,
        sha256=found.sha256,
        columns=columns,
        wrong=tuple(wrong),
        mistakes=tuple(mistakes),
    )


def _mistakes(data: Mapping[str, Any], found: Columns) -> Iterator[str]:
    """Check that the columns are parameters, each given once, and that the study has points."""
    for name in found.values:
        if name in OURS:
            yield f"its column {shown(name)} is an output, not a parameter; leave it out"
        elif name not in INPUTS:
            yield f"its column {shown(name)} is not a parameter; {did_you_mean(name, tuple(INPUTS))}"
        elif isinstance(table := data.get(INPUTS[name].table), Mapping) and name in table:
            yield f"{name} is given under [{INPUTS[name].table}] and as a column of the file; keep one of the two"
    if data.get("layout", "points") == "grid":
        yield 'the rows of a file are points, but layout = "grid"; write layout = "points" or leave it out'
    if found.rows > MOST_VALUES:
        yield f"the file has {found.rows:,} rows, but at most {MOST_VALUES:,} are read; split it"


def _column(name: str, given: NDArray[np.float64], found: Columns) -> NDArray[np.float64]:
    """
    Give a column in the unit of its key.

    Raises
    ------
    ColumnsError
        It has no unit, or one of another dimension; or its values are out of range.
    """
    key, unit = INPUTS[name], found.units.get(name, "")
    if key.table == "physical" and not unit:
        raise ColumnsError(
            f"its column {name} has no unit; write it after the name in brackets, as {name} [{key.unit}]"
        )
    try:
        values = in_si(given, unit or key.unit, name)
    except ValueError as error:
        raise ColumnsError(f"its column {name} [{unit}]: {error}") from None
    rows = np.flatnonzero(~key.admits(values))
    if rows.size:
        more = f", and {rows.size - 1:,} more rows are as well" if rows.size > 1 else ""
        value = float(given[rows[0]])
        what = "is missing (NaN)" if np.isnan(value) else f"= {value!r} is out of range"
        remedy = "give it, or remove the row" if np.isnan(value) else f"choose a value with {key.allowed}"
        raise ColumnsError(f"{found.place(int(rows[0]))}: {name} {what}{more}; {remedy}")
    return values
