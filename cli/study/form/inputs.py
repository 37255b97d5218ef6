"""The form of the inputs: a number, a list, a range or a file of points for each."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any, Literal, Union

from pydantic import BeforeValidator, Discriminator, Field, Tag, create_model

from gradhesion.cli.keys import INPUTS, KEYS, MACHINE, Key
from gradhesion.cli.study.form.table import Table, of_key
from gradhesion.cli.study.text.quantities import si_value


class Range(Table):
    """An axis by its ends and its number of values."""

    start: float
    stop: float
    num: Annotated[int, Field(ge=1, description=KEYS["num"].about)]
    spacing: Annotated[Literal["linear", "log"], Field(description=KEYS["spacing"].about)] = "linear"


Entry = float | list[float] | Range
"""What a study gives for an input: a number, a list, or a range; quantities in SI units."""


def _shape_of(value: object) -> str:
    """Report which of the three forms of an input is meant."""
    return "range" if isinstance(value, Mapping) else "list" if isinstance(value, list) else "number"


def _input(key: Key) -> Any:
    """Make the type of an input: a number, a list of numbers, or a range table; quantities become numbers in SI."""
    bounds: dict[str, Any] = dict(key.bounds)
    number: Any
    end: Any
    if key.table == "physical":
        schema: Any = Field(json_schema_extra={"type": ["string", "number"]})
        number = Annotated[float, BeforeValidator(lambda value: si_value(value, key.name)), schema]
        end = Annotated[number, Field(allow_inf_nan=False)]
    else:
        end = Annotated[float, Field(strict=True, allow_inf_nan=False, **bounds)]
        number = Annotated[float, Field(strict=True, **bounds)] if key.infinite else end
    range_table: Any = create_model(
        f"Range_{key.name}", __base__=Range, start=(of_key("start", end), ...), stop=(of_key("stop", end), ...)
    )
    shapes: Any = Union[  # noqa: UP007 (made at run time)
        Annotated[number, Tag("number")],
        Annotated[list[number], Field(min_length=1), Tag("list")],
        Annotated[range_table, Tag("range")],
    ]
    return of_key(key.name, Annotated[shapes, Discriminator(_shape_of)])


class FileTable(Table):
    """A file with its fingerprint."""

    file: Annotated[str, Field(min_length=1, description=KEYS["file"].about)]
    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$", description=KEYS["sha256"].about)] = ""


File = Annotated[
    Annotated[str, Field(min_length=1), Tag("name")] | Annotated[FileTable, Tag("table")],
    Discriminator(lambda value: "table" if isinstance(value, Mapping | FileTable) else "name"),
]
"""A file by its name, or with its fingerprint."""


def _table(name: str, *, required: tuple[str, ...] = ()) -> type[Table]:
    """Make the table of inputs of one name."""
    fields: Any = {
        key.name: (_input(key), ... if key.name in required else None) for key in INPUTS.values() if key.table == name
    }
    if name == KEYS["points"].table:
        fields["points"] = (of_key("points", File), None)
    return create_model(name.capitalize(), __base__=Table, **fields)


if TYPE_CHECKING:  # made from the keys, which the types cannot show

    class ParametersTable(Table):
        """The inputs without units."""

    class PhysicalTable(Table):
        """The inputs with units."""

    MachineStiffness = Entry | None
else:
    ParametersTable = _table("parameters", required=("k", "nu"))
    PhysicalTable = _table("physical")
    MachineStiffness = _input(INPUTS[MACHINE])
