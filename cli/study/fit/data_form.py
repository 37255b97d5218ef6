"""The form of [data]: the files of a measured loop and their columns."""

from collections.abc import Mapping
from typing import Annotated, Any, Final

from pydantic import BeforeValidator, Field, StringConstraints, WithJsonSchema

from gradhesion.cli.keys import KEYS
from gradhesion.cli.study.form.table import Table
from gradhesion.cli.terminal.wording import did_you_mean, example

WAYS: Final = ("loading", "unloading")
"""The branches of a cycle."""
PAUSES: Final = ("pause", "hold", "dwell", "creep", "modulate")
"""What instruments call a stretch between branches, in which the punch waits: such rows are left out."""


class ColumnTable(Table):
    """A column of the data, with its unit."""

    column: Annotated[str, Field(min_length=1, description=KEYS["column"].about)]
    unit: Annotated[str, Field(description=KEYS["unit"].about)] = ""
    sign: Annotated[int, Field(description=KEYS["sign"].about)] = 1


def _column(value: Any) -> Any:
    """Read a column: its name, or a table with its name, its unit and its sign."""
    if isinstance(value, str) and value:
        return {"column": value}
    if isinstance(value, Mapping) and value.get("sign", 1) not in (1, -1):
        raise ValueError("sign is 1 or -1; write -1 to change the sign of the column")
    words = {name: item for name, item in value.items() if name != "sign"} if isinstance(value, Mapping) else {}
    sound = isinstance(words.get("column"), str) and words["column"]
    if not sound or not all(isinstance(item, str) for item in words.values()) or {*words} - {"column", "unit"}:
        raise ValueError(f"this must name a column of the file, with its unit; {example(('data', 'load'))}")
    return dict(words, sign=int(value.get("sign", 1)))


def _which(value: object) -> object:
    """Check which branch is fitted."""
    if value not in WAYS:
        raise ValueError(f'the branch is "loading" or "unloading"; {did_you_mean(str(value), WAYS)}')
    return value


def _leave_out(value: object) -> object:
    """Check the words of rows that are left out."""
    if not isinstance(value, list) or not all(isinstance(word, str) and word.strip() for word in value):
        raise ValueError(f"this must be a list of words of the column branch; {example(('data', 'leave_out'))}")
    return value


Column = Annotated[ColumnTable, BeforeValidator(_column)]
Word = Annotated[str, StringConstraints(min_length=1)]
_WORDS: Final = WithJsonSchema({"type": "array", "items": {"type": "string"}})


class DataTable(Table):
    """The measured loop."""

    file: Annotated[str, Field(min_length=1, description=KEYS["file"].about)]
    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$", description=KEYS["sha256"].about)] = ""
    indentation: Annotated[Column | None, Field(description=KEYS["indentation"].about)] = None
    displacement: Annotated[Column | None, Field(description=KEYS["displacement"].about)] = None
    load: Annotated[Column | None, Field(description=KEYS["load"].about)] = None
    branch: Annotated[Word | None, Field(description=KEYS["branch"].about)] = None
    leave_out: Annotated[
        list[str], BeforeValidator(_leave_out), _WORDS, Field(description=KEYS["leave_out"].about, default_factory=list)
    ]
    which: Annotated[
        str | None,
        BeforeValidator(lambda value: None if value is None else _which(value)),
        Field(description=KEYS["which"].about),
    ] = None
    cycle: Annotated[Word | None, Field(description=KEYS["cycle"].about)] = None

    @property
    def names_columns(self) -> bool:
        """Whether it names any column of depths or loads."""
        return any((self.indentation, self.displacement, self.load))
