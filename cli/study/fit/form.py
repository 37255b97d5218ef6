"""The form of a study of kind "fit": which keys there are, and which values each of them takes."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, create_model

from gradhesion.cli.keys import ADHESION_RANGE, CLOSING, INPUTS, INTERACTION, KEYS, MACHINE, PATTERN, Key
from gradhesion.cli.study.fit.data_form import DataTable
from gradhesion.cli.study.fit.offset_form import offsets_of
from gradhesion.cli.study.form.edge import FASTEST, SLOWEST, ToughnessTable
from gradhesion.cli.study.form.form import LoadingTable, MethodTable
from gradhesion.cli.study.form.profile import ProfileTable
from gradhesion.cli.study.form.table import Table
from gradhesion.cli.study.text.quantities import ratio_sentence, si_value
from gradhesion.cli.terminal.wording import did_you_mean, example

DATA: Final = "data"
"""What stands for the deepest point of the data, where the cycle turns."""
INTERVALS: Final = ("profile", "linear")
"""Where the intervals of a fit come from."""
MOST_STARTS: Final = 4096
"""Refinements of one fit."""
LEFT_OUT: Final = (MACHINE, PATTERN[0], ADHESION_RANGE)
"""Inputs that a fit has no use for: the ratios of what has a unit there."""
LINEAR: Final = ("k", "nu", "indentation_max", CLOSING, PATTERN[1], "exponent")
"""What is searched as it is, so that its range may begin at 0; all else is by its logarithm."""
NUMBER_ALONE: Final = (INTERACTION,)
"""What no loop depends on, and is a number."""
AT_THE_TOP: Final = (
    "title",
    "kind",
    "data",
    "parameters",
    "physical",
    "profile",
    "loading",
    "toughness",
    "rate",
    "fit",
)
"""The keys of such a study."""


@dataclass(frozen=True)
class Search:
    """The ends of the range of a parameter that is fitted."""

    start: float
    stop: float


Given = float | Search | Literal["data"]
"""What is given for an input: a number is fixed, a range is searched."""


def _number(value: object, key: Key) -> float:
    """Read a number or a quantity, within the bounds of its key."""
    if key.table == "physical":
        return si_value(value, key.name)
    if isinstance(value, str) and (sentence := ratio_sentence(value, key.name)):
        raise ValueError(sentence)
    if not isinstance(value, int | float) or isinstance(value, bool):
        what = "a number, or a range { start, stop } that is searched"
        raise ValueError(f"this must be {what}; {_example(key)}")  # noqa: TRY004 (pydantic hears no other)
    tests = {"ge": value >= key.bounds.get("ge", value), "gt": value > key.bounds.get("gt", value - 1.0)}
    inside = all(tests[bound] for bound in tests if bound in key.bounds) and value <= key.bounds.get("le", value)
    if not inside or value != value or (abs(value) == float("inf") and not key.infinite):  # noqa: PLR0124 (NaN)
        raise ValueError(f"out of range; choose a value with {key.allowed}")
    return float(value) + 0.0


def _example(key: Key) -> str:
    """Show a range that would do."""
    ends = '"0.1 GPa", stop = "10 GPa"' if key.name in ("E_star", "E") else "..., stop = ..."
    ends = "0.0, stop = 1.0" if key.name == "k" else "0.005, stop = 0.1" if key.name in ("A", "chi") else ends
    return f"write for example {key.name} = {{ start = {ends} }}"


def given_of(value: object, name: str) -> Given:
    """
    Read what a study gives for an input.

    Raises
    ------
    ValueError
        It is neither a number nor a range in bounds; the message says what to write.

    >>> given_of({"start": "0.1 GPa", "stop": "10 GPa"}, "E_star")
    Search(start=100000000.0, stop=10000000000.0)
    """
    key = INPUTS[name]
    if value == DATA and name == "indentation_max":
        return "data"
    if isinstance(value, list):
        what = "a fit has no axes: a number is fixed, a range { start, stop } is searched; write one of them"
        raise ValueError(what)  # noqa: TRY004 (pydantic hears no other)
    if not isinstance(value, Mapping):
        return _number(value, key)
    if name in NUMBER_ALONE:
        raise ValueError(f"no loop depends on it; give it as a number, {key.example}")
    unknown = [str(word) for word in value if word not in ("start", "stop")]
    if unknown:
        raise ValueError(
            f'a searched range has only start and stop; remove "{unknown[0]}" (values between are all tried)'
        )
    if missing := [word for word in ("start", "stop") if word not in value]:
        raise ValueError(f"a searched range needs {' and '.join(missing)}; {_example(key)}")
    start, stop = _number(value["start"], key), _number(value["stop"], key)
    if not abs(start) < float("inf") or not abs(stop) < float("inf"):
        raise ValueError("a searched range has finite ends; write a finite value")
    if not start < stop:
        raise ValueError("the stop of a searched range is above its start; exchange the two, or give a number")
    if start <= 0.0 and name not in LINEAR:
        raise ValueError("it is searched on a logarithmic scale; begin the range above 0")
    return Search(start, stop)


def _entry(key: Key) -> Any:
    """Make the type of an input."""
    kind = "string" if key.table == "physical" else "number"
    ends = {word: {"type": [kind, "number"]} for word in ("start", "stop")}
    search = {"type": "object", "properties": ends, "required": ["start", "stop"], "additionalProperties": False}
    schema = {"anyOf": [{"type": ["string", "number"] if kind == "string" else "number"}, search]}
    read = BeforeValidator(lambda value: None if value is None else given_of(value, key.name))
    return Annotated[Any, read, WithJsonSchema(schema), Field(description=key.about)]


def _inputs(table: str) -> dict[str, Any]:
    """Make the fields of a table of inputs."""
    own = (key for key in INPUTS.values() if key.table == table and key.name not in LEFT_OUT)
    return {key.name: (_entry(key), None) for key in own}


def noise_of(value: object) -> dict[str, float]:
    """
    Read the noise: a length and a force.

    Raises
    ------
    ValueError
        It is not; the message says what to write.

    >>> noise_of({"load": "0.5 nN", "indentation": "0.1 nm"})
    {'load': 5e-10, 'indentation': 1e-10}
    """
    keys = {"load": "preload", "indentation": "R", "displacement": "R"}
    what = f"noise has the standard deviations of load and of indentation; {example(('fit', 'noise'))}"
    if not isinstance(value, Mapping) or {*value} - {*keys} or "load" not in value or len(value) != 2:
        raise ValueError(what)
    found = {}
    for name, item in value.items():
        try:
            found[str(name)] = si_value(item, keys[str(name)])
        except ValueError as error:
            raise ValueError(f"{name}: {str(error).partition(';')[0]}; {what}") from None
    return found


def _intervals(value: object) -> object:
    """Check where the intervals come from."""
    if value not in INTERVALS:
        raise ValueError(f'intervals are "profile" or "linear"; {did_you_mean(str(value), INTERVALS)}')
    return value


def _starts(value: object) -> object:
    """Check the number of starts."""
    if not isinstance(value, int) or isinstance(value, bool) or not 1 <= value <= MOST_STARTS:
        what = f"the number of starts is an integer from 1 to {MOST_STARTS:,}"
        raise ValueError(f"{what}; {example(('fit', 'starts'))}")
    return value


def _average(value: object) -> object:
    """Check whether points are averaged."""
    if not isinstance(value, bool):
        raise ValueError(f"this must be true or false; {example(('fit', 'average'))}")  # noqa: TRY004 (for pydantic)
    return value


def _exponent(value: object) -> Given:
    """Read the power of the speed: a number, or a range."""
    ends = [value] if not isinstance(value, Mapping) else [value.get("start"), value.get("stop")]
    numbers = [float(end) for end in ends if isinstance(end, int | float) and not isinstance(end, bool)]
    known = not isinstance(value, Mapping) or set(value) == {"start", "stop"}
    if not known or len(numbers) != len(ends) or not all(SLOWEST <= end <= FASTEST for end in numbers):
        what = f"the power n of the speed is a number from {SLOWEST:g} to {FASTEST:g}, or a range within"
        raise ValueError(f"{what}; write for example exponent = 0.6, or exponent = {{ start = 0.3, stop = 0.9 }}")
    if len(numbers) == 1:
        return numbers[0]
    if not numbers[0] < numbers[1]:
        raise ValueError("the stop of a searched range is above its start; exchange the two, or give a number")
    return Search(*numbers)


def _kind(value: object) -> object:
    """Check the kind, which is meant to be a fit."""
    if value != "fit":
        raise ValueError('not a kind; did you mean "fit"?')
    return value


class FitTable(Table):
    """What is fitted beside the parameters, and how."""

    offsets: Annotated[
        Any,
        BeforeValidator(offsets_of),
        WithJsonSchema({"anyOf": [{"type": "boolean"}, {"type": "object"}]}),
        Field(description=KEYS["offsets"].about, validate_default=True),
    ] = True
    average: Annotated[bool, BeforeValidator(_average), Field(description=KEYS["average"].about)] = True
    noise: Annotated[
        dict[str, float] | None,
        BeforeValidator(lambda value: None if value is None else noise_of(value)),
        WithJsonSchema({"type": "object", "additionalProperties": {"type": "string"}}),
        Field(description=KEYS["noise"].about),
    ] = None
    intervals: Annotated[
        Literal["profile", "linear"], BeforeValidator(_intervals), Field(description=KEYS["intervals"].about)
    ] = "profile"
    starts: Annotated[int, BeforeValidator(_starts), Field(ge=1, le=MOST_STARTS, description=KEYS["starts"].about)] = 32


class FitRateTable(Table):
    """An edge whose work grows with its speed."""

    exponent: Annotated[
        Any,
        BeforeValidator(_exponent),
        WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "object"}]}),
        Field(description="power n of the speed of the edge in its work, 1 + (v/v*)^n"),
    ]
    closing: Annotated[str, Field(description=KEYS["closing"].about)] = "quasi-static"


if TYPE_CHECKING:

    class FitParametersTable(Table):
        """The inputs without units."""

    class FitPhysicalTable(Table):
        """The inputs with units."""
else:
    FitParametersTable = create_model("FitParameters", __base__=Table, **_inputs("parameters"))
    FitPhysicalTable = create_model("FitPhysical", __base__=Table, **_inputs("physical"))


class FitForm(Table):
    """A whole study of a fit, each key for itself."""

    title: Annotated[str, Field(description=KEYS["title"].about)] = ""
    kind: Annotated[Literal["fit"], BeforeValidator(_kind), Field(description=KEYS["kind"].about)]
    data: Annotated[DataTable, Field(description=KEYS["data"].about)]
    parameters: Annotated[FitParametersTable, Field(description=KEYS["parameters"].about)]
    physical: Annotated[FitPhysicalTable, Field(description=KEYS["physical"].about)]
    profile: Annotated[ProfileTable, Field(description=KEYS["profile"].about, default_factory=ProfileTable)]
    loading: Annotated[LoadingTable, Field(description=KEYS["loading"].about, default_factory=LoadingTable)]
    toughness: Annotated[ToughnessTable | None, Field(description=KEYS["toughness"].about)] = None
    rate: Annotated[FitRateTable | None, Field(description=KEYS["rate"].about)] = None
    fit: Annotated[FitTable, Field(description=KEYS["fit"].about, default_factory=FitTable)]

    method: ClassVar = MethodTable()
    """The exact solver alone; rules of other studies ask."""
    outputs: ClassVar = ()
    optimum: ClassVar = None

    @property
    def entries(self) -> dict[str, Given]:
        """What is given for the inputs, in the order of a dataset's dimensions; the power of the speed is the last."""
        tables = {"parameters": self.parameters, "physical": self.physical}
        given = {name: getattr(tables[key.table], name, None) for name, key in INPUTS.items() if key.table in tables}
        given |= {"exponent": self.rate.exponent} if self.rate else {}
        return {name: entry for name, entry in given.items() if entry is not None}


REQUIRED: Final[dict[tuple[str | int, ...], Any]] = {
    ("kind",): "fit",
    ("data",): {},
    ("data", "file"): "loop.csv",
    ("parameters",): {},
    ("physical",): {},
}
"""The keys that the form needs, with valid values that stand for wrong ones."""
