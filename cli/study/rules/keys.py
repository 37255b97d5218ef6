"""What the tables of a study are made of: keys with a meaning and an example, of inputs and of classes of the core."""

import math
import re
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from typing import Annotated, Any, ClassVar, Final, Literal, Union, get_args, get_type_hints

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    ValidationInfo,
    WithJsonSchema,
    WrapValidator,
    create_model,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticCustomError

from gradhesion.cli.study.text.quantities import ratio_sentence, si_value
from gradhesion.core.problem.inputs import Input
from gradhesion.core.problem.profile import MOST_HARMONICS

Finite = Annotated[float, Field(allow_inf_nan=False)]
MOST_VALUES: Final = 10_000_000
"""Values of one axis: it is held in memory, and so are its kin."""
_ONE_VALUE: Final = re.compile(r'"[^"]+"|\d[\d.e-]*')
"""A quantity or a finite number, as TOML has it."""
_PERCENTAGE: Final = re.compile(r"\s*([+-]?(?:\d{1,20}\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*%\s*")


class Table(BaseModel):
    """A table of a study: no unknown keys, no silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, defer_build=True)


def said(about: str | None, example: str, default: Any = ..., **limits: Any) -> Any:
    """Declare a key: what it is about, a value that would do, as TOML has it, and what holds where it is left out."""
    return Field(default, description=about, examples=[example], **limits)


def read_by(read: Any, schema: Mapping[str, Any], kind: Any = Any) -> Any:
    """Make the type of a value that a function reads, which raises ValueError with a sentence."""
    return Annotated[
        kind, BeforeValidator(lambda value: value if value is None else read(value)), WithJsonSchema({**schema})
    ]


def quantity(name: str) -> Any:
    """Make the type of a quantity, which becomes a number in SI units."""
    return read_by(lambda value: si_value(value, name), {"type": "string"}, float)


class OfCore(Table):
    """A table whose keys are the settings of a class of the core."""

    made_as: ClassVar[type]

    def made(self, **instead: Any) -> Any:
        """Make what it says, with some values in the place of its own."""
        own = {one.name: getattr(self, one.name) for one in fields(self.made_as)} | instead
        given = {name: value for name, value in own.items() if value is not None}
        waves = {name: tuple(one.made() for one in value) for name, value in given.items() if isinstance(value, list)}
        return self.made_as(**given | waves)


def table_of(kind: type, **more: Any) -> Any:
    """Make the table of a study whose keys are the settings of a class of the core, and perhaps `more`."""
    hints, own = get_type_hints(kind), {}
    for one in fields(kind):
        hint, default, limits = hints[one.name], one.default, dict(one.metadata["bounds"])
        if items := get_args(hint):
            hint, limits = list[table_of(items[0])], {"min_length": 1, "max_length": MOST_HARMONICS}  # type: ignore[misc]
        elif one.metadata["choices"]:
            hint = Literal[one.metadata["choices"]]
        elif hint is float:
            limits["allow_inf_nan"] = False
        if default is None or (items and default is not MISSING):
            hint, default, limits = Annotated[hint, Field(**limits)] | None, None, {}
        default = ... if default is MISSING else default
        own[one.name] = (hint, said(one.metadata["about"], one.metadata["example"], default, **limits))
    made: Any = create_model(kind.__name__, __base__=OfCore, __doc__=str(kind.__doc__).partition("\n")[0], **own | more)
    made.made_as = kind
    return made


# The inputs: a number, a list or a range for each.


class Range(Table):
    """An axis by its ends and its number of values, or the ends between which an input is searched."""

    is_axis: ClassVar[bool] = True
    """Whether it has values unless it is searched; else it is always searched."""

    start: float
    stop: float
    num: int | None = said(
        "the number of values, required unless the input is searched",
        "50",
        None,
        ge=1,
        le=MOST_VALUES,
        validate_default=True,
        json_schema_extra={"type": "integer", "minimum": 1, "maximum": MOST_VALUES},
    )
    spacing: Literal["linear", "log"] = said("whether differences or ratios of neighbours are equal", '"log"', "linear")

    @model_validator(mode="before")
    @classmethod
    def _refuse_foreign(cls, table: dict[str, Any]) -> dict[str, Any]:
        """Say what keys of other tools' ranges are called here."""
        if "values" in table:
            raise ValueError("a list of values stands alone, for example [0.1, 0.2, 0.5]")
        if table.keys() & {"step", "by", "increment", "delta"}:
            raise ValueError('a range has no step; write num, the number of its values, and spacing = "log" for ratios')
        return table

    @field_validator("num")
    @classmethod
    def _require(cls, num: int | None, about: ValidationInfo) -> int | None:
        """Ask for the number of values where nothing is searched, by the kind of the study."""
        if cls.is_axis and num is None and about.context and about.context["kind"] in ("map", "curve"):
            raise PydanticCustomError("missing", "required")
        return num

    @property
    def ends(self) -> tuple[float, float]:
        """The bounds of what is searched, the lower first."""
        low, high = sorted((self.start + 0.0, self.stop + 0.0))  # no negative zeros
        return low, high


class File(Table):
    """A file with its fingerprint."""

    file: str = said(
        "path of a file, relative to the folder of the study; for loops, several with * or ?", '"tip.csv"', min_length=1
    )
    sha256: str = said("SHA-256 of the file; a file that differs is refused", '"0a1b..."', "", pattern="^[0-9a-f]{64}$")


def tagged(**forms: Any) -> Any:
    """Make the type of a value of several forms (plain, list, table), told apart before any is tried."""

    def form_of(value: object) -> str:
        own = "table" if isinstance(value, Mapping) else "list" if isinstance(value, list) else "plain"
        return own if own in forms else "plain"

    own: Any = Union[tuple(Annotated[form, Tag(name)] for name, form in forms.items())]  # noqa: UP007 (at run time)
    return Annotated[own, Discriminator(form_of)]


def range_of(own: Input, number: Any, *, is_axis: bool = True) -> Any:
    """Make the table of a range of a number."""
    value = _ONE_VALUE.search(own.value)  # of a range or a list, its first
    example = value[0] if value else "1.0"
    start, stop = ((number, said(f"the {which} value", example)) for which in ("first", "last"))
    made: Any = create_model(f"Range_{own.name}", __base__=Range, start=start, stop=stop)
    made.is_axis = is_axis
    return made


def input_key(own: Input) -> tuple[Any, Any]:
    """Make the key of an input: a number, a list of numbers, or a range table; quantities become numbers in SI.

    An array is a column of a file, in SI units and within the bounds.
    """
    limits: dict[str, Any] = {"strict": True, "allow_inf_nan": own.infinite, **own.bounds}
    number: Any = Annotated[float, Field(**limits)]
    if own.table == "physical":
        number = read_by(lambda value: si_value(value, own.name), {"type": ["string", "number"]}, float)
    plain = number
    if own.name == "indentation_max":  # of a fit it may be the deepest point of its data
        read = BeforeValidator(lambda value: value if value == "data" else si_value(value, own.name))
        plain = Annotated[float | Literal["data"], read]
    ends = range_of(own, Annotated[number, Field(allow_inf_nan=False)])
    forms = tagged(plain=plain, list=Annotated[list[number], Field(min_length=1, max_length=MOST_VALUES)], table=ends)
    forms = Annotated[forms, WrapValidator(lambda value, read: value if isinstance(value, np.ndarray) else read(value))]
    return forms, said(own.about, own.value, ... if own.name in ("k", "nu") else None)


# How far they may be off.


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """The distribution of one input, in SI units: normal about the value of each scene, or uniform."""

    deviation: float = 1.0
    relative: bool = False
    """Whether it is a share of the value."""
    low: float = -math.inf
    high: float = math.inf
    """The bounds of the input, or the ends of a uniform distribution."""
    uniform: bool = False


def deviation_key(own: Input) -> tuple[Any, Any]:
    """Make the key of the deviation of an input."""
    forms = f'write for example {own.name} = "5 %", a standard deviation in its unit, or {{ low = .., high = .. }}'

    def number(one: object) -> float:
        if own.table == "physical":
            return si_value(one, own.name)
        if isinstance(one, int | float) and not isinstance(one, bool):
            return float(one)
        raise ValueError((isinstance(one, str) and ratio_sentence(one, own.name)) or f"not a deviation; {forms}")

    def read(value: object) -> Deviation:
        if isinstance(value, Mapping):
            if {*value} != {"low", "high"}:
                raise ValueError(f"a uniform distribution has both low and high, and nothing else; {forms}")
            low, high = number(value["low"]), number(value["high"])
            if not (low < high < math.inf and own.admits(low) and own.admits(high)):
                raise ValueError(f"out of range; choose low below high with {own.allowed}, both finite")
            return Deviation(low=low, high=high, uniform=True)
        low, high = own.bounds.get("ge", own.bounds.get("gt", -math.inf)), own.bounds.get("le", math.inf)
        share = _PERCENTAGE.fullmatch(value) if isinstance(value, str) else None
        deviation = float(share[1]) / 100.0 if share else number(value)
        if not 0.0 < deviation < math.inf or (share and deviation > 1.0):
            raise ValueError(f"a deviation is above 0 and finite, at most 100 %; {forms}, or remove this key")
        return Deviation(deviation=deviation, relative=share is not None, low=low, high=high)

    kind = read_by(read, {"type": ["number", "string", "object"]}, Deviation | None)
    return kind, said(f"uncertainty of {own.name}: {own.about}", '"5 %"', None)
