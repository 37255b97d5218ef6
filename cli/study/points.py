"""Points from a file: the scenes of a study are the rows of a table, a column a parameter."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import OUTPUTS, SI
from gradhesion.cli.study.rules.asked import REQUIRED
from gradhesion.cli.study.rules.axes import MOST_VALUES
from gradhesion.cli.study.rules.mistakes import Mistake
from gradhesion.cli.study.text.places import Path as Key
from gradhesion.cli.study.text.quantities import factor_of_column, scaled
from gradhesion.cli.study.text.written import value_of, with_fingerprint
from gradhesion.cli.tables.columns import Columns, ColumnsError, changed
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.inputs import INPUTS

KEY: Final[Key] = ("parameters", "points")
COMMENT: Final = "a column of "
"""How the comment of a coordinate begins that is a column of a file."""
_OURS: Final = frozenset({*OUTPUTS, *(name + SI for name in OUTPUTS), "status"})
"""Names that a dataset has, and a file of points may not."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Points:
    """The points of a study; without a file there are none."""

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
        if not self.file and not self.mistakes:
            return dict(data)
        whole = {**data, "layout": "points" if data.get("layout") == "grid" else data.get("layout", "points")}
        for name in (*self.columns, *self.wrong):
            key = INPUTS[name]
            value = float(self.columns[name][0]) if name in self.columns else REQUIRED.get(name, 1.0)
            unit = f" {key.unit}" if np.isfinite(value) else ""
            table = whole.get(key.table, {})
            if isinstance(table, Mapping):
                whole[key.table] = {**table, name: f"{value!r}{unit}" if key.table == "physical" else value}
        return whole

    @property
    def unread(self) -> bool:
        """Whether the file could not be read, so that what it would give is not missing."""
        return bool(self.mistakes) and not self.file

    def stored(self, data: Mapping[str, Any], text: str) -> tuple[dict[str, Any], str]:
        """Give the keys and the text of a study with the fingerprint of the file; no text where it is to be made."""
        return with_fingerprint(data, text, KEY, self.sha256) if self.file else (dict(data), text)


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
    if not isinstance(named, Mapping) or not named.get("file") or not {*named} <= {"file", "sha256"}:
        return Points()  # their form is refused
    file, expected = named["file"], named.get("sha256", "")
    if not isinstance(file, str) or not isinstance(expected, str):
        return Points()
    if columns is not None:
        return Points(file=file, sha256=expected, columns=columns)
    try:
        found = read_columns(folder / file)
    except ColumnsError as error:
        return Points(mistakes=(Mistake(KEY, written, str(error)),))
    if expected and expected != found.sha256:
        sentence = changed(found.sha256, expected, f"write points = {value_of(file)}")
        return Points(mistakes=(Mistake(KEY, written, sentence),))
    sentences, own, wrong = [*_mistakes(data, found)], {}, []
    for name in (name for name in found.values if name in INPUTS):
        try:
            own[name] = _column(name, found)
        except ColumnsError as error:
            sentences.append(str(error))
            wrong.append(name)
    mistakes = tuple(Mistake(KEY, written, sentence) for sentence in sentences)
    return Points(file=file, sha256=found.sha256, columns=own, wrong=tuple(wrong), mistakes=mistakes)


def _mistakes(data: Mapping[str, Any], found: Columns) -> Iterator[str]:
    """Check that the columns are parameters, each given once, and that the study has points."""
    for name in found.values:
        if name in _OURS:
            yield f"its column {shown(name)} is an output, not a parameter; leave it out"
        elif name not in INPUTS:
            yield f"its column {shown(name)} is not a parameter; {did_you_mean(name, tuple(INPUTS))}"
        elif isinstance(table := data.get(INPUTS[name].table), Mapping) and name in table:
            yield f"{name} is given under [{INPUTS[name].table}] and as a column of the file; keep one of the two"
    if data.get("layout", "points") == "grid":
        yield 'the rows of a file are points, but layout = "grid"; write layout = "points" or leave it out'
    if found.rows > MOST_VALUES:
        yield f"the file has {found.rows:,} rows, but at most {MOST_VALUES:,} are read; split it"


def _column(name: str, found: Columns) -> NDArray[np.float64]:
    """
    Give a column in the unit of its key.

    Raises
    ------
    ColumnsError
        It has no unit, or one of another dimension; or its values are out of range.
    """
    key, given = INPUTS[name], found.values[name]
    values = scaled(given, factor_of_column(found, name, name))
    rows = np.flatnonzero(~key.admits(values))
    if rows.size:
        more = f", and {rows.size - 1:,} more rows are as well" if rows.size > 1 else ""
        value = float(given[rows[0]])
        what = "is missing (NaN)" if np.isnan(value) else f"= {value!r} is out of range"
        remedy = "give it, or remove the row" if np.isnan(value) else f"choose a value with {key.allowed}"
        raise ColumnsError(f"{found.place(int(rows[0]))}: {name} {what}{more}; {remedy}")
    return values
