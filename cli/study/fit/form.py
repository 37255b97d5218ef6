"""The form of a study of kind "fit": which keys there are, and which values each of them takes."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, create_model

from gradhesion.cli.study.rules.form import (
    ABOUT_KIND,
    ABOUT_PARAMETERS,
    ABOUT_PHYSICAL,
    ABOUT_RATE,
    Common,
    File,
    Method,
    Table,
    said,
    table_of,
)
from gradhesion.cli.study.text.quantities import ratio_sentence, si_value
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.loops.paths.offsets import NO_OFFSETS, Offsets
from gradhesion.core.problem.inputs import INPUTS, Input
from gradhesion.core.problem.toughness import EXPONENTS, Rate

DATA: Final = "data"
"""What stands for the deepest point of the data, where the cycle turns."""
MOST_STARTS: Final = 4096
"""Refinements of one fit."""
LEFT_OUT: Final = ("machine_stiffness", "toughness_wavelength_over_R", "adhesion_range_over_R")
"""Inputs that a fit has no use for: the ratios of what has a unit there."""
LINEAR: Final = ("k", "nu", "indentation_max", "closing_ratio", "toughness_amplitude", "exponent")
"""What is searched as it is, so that its range may begin at 0; all else is by its logarithm."""
NUMBER_ALONE: Final = ("adhesion_range",)
"""What no loop depends on, and is a number."""
PAUSES: Final = ("pause", "hold", "dwell", "creep", "modulate")
"""What instruments call a stretch between branches, in which the punch waits: such rows are left out."""


@dataclass(frozen=True)
class Search:
    """The ends of the range of a parameter that is fitted."""

    start: float
    stop: float


Given = float | Search | Literal["data"]
"""What is given for an input: a number is fixed, a range is searched."""


def _number(value: object, own: Input) -> float:
    """Read a number or a quantity, within the bounds of its key."""
    if own.table == "physical":
        return si_value(value, own.name)
    if isinstance(value, str) and (sentence := ratio_sentence(value, own.name)):
        raise ValueError(sentence)
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise ValueError(f"this must be a number, or a range {{ start, stop }} that is searched; {_example(own)}")  # noqa: TRY004 (pydantic hears no other)
    if not own.admits(value):
        raise ValueError(f"out of range; choose a value with {own.allowed}")
    return float(value) + 0.0


def _example(own: Input) -> str:
    """Show a range that would do."""
    ends = {"E_star": '"0.1 GPa", stop = "10 GPa"', "k": "0.0, stop = 1.0", "A": "0.005, stop = 0.1"}
    return f"write for example {own.name} = {{ start = {ends.get(own.name, '.., stop = ..')} }}"


def given_of(value: object, own: Input) -> Given:
    """
    Read what a study gives for an input.

    Raises
    ------
    ValueError
        It is neither a number nor a range in bounds; the message says what to write.

    >>> given_of({"start": "0.1 GPa", "stop": "10 GPa"}, INPUTS["E_star"])
    Search(start=100000000.0, stop=10000000000.0)
    """
    if value == DATA and own.name == "indentation_max":
        return "data"
    if isinstance(value, list):
        what = "a fit has no axes: a number is fixed, a range { start, stop } is searched; write one of them"
        raise ValueError(what)  # noqa: TRY004 (pydantic hears no other)
    if not isinstance(value, Mapping):
        return _number(value, own)
    if own.name in NUMBER_ALONE:
        raise ValueError(f"no loop depends on it; give it as a number, {own.example}")
    if {*value} != {"start", "stop"}:
        raise ValueError(f"a searched range has start and stop, and nothing else; {_example(own)}")
    start, stop = (_number(value[end], own) for end in ("start", "stop"))
    if not (math.isfinite(start) and math.isfinite(stop)):
        raise ValueError("a searched range has finite ends; write a finite value")
    if not start < stop:
        raise ValueError("the stop of a searched range is above its start; exchange the two, or give a number")
    if start <= 0.0 and own.name not in LINEAR:
        raise ValueError("it is searched on a logarithmic scale; begin the range above 0")
    return Search(start, stop)


def _entry(own: Input) -> Any:
    """Make the type of an input."""
    forms = ["string", "number"] if own.table == "physical" else ["number"]
    ends = {word: {"type": forms} for word in ("start", "stop")}
    search = {"type": "object", "properties": ends, "required": ["start", "stop"], "additionalProperties": False}
    schema = WithJsonSchema({"anyOf": [{"type": forms}, search]})
    read = BeforeValidator(lambda value: None if value is None else given_of(value, own))
    return Annotated[Any, read, schema, said(own.about, own.value)]


def _inputs(table: str) -> dict[str, Any]:
    """Make the fields of a table of inputs."""
    own = [one for one in INPUTS.values() if one.table == table and one.name not in LEFT_OUT]
    return {one.name: (_entry(one), None) for one in own}


_POWER: Final = Input("exponent", "", "", "0.6", dict(zip(("ge", "le"), EXPONENTS, strict=True)))
"""The power of the speed, as an input that may be searched."""


def _column(value: Any) -> Any:
    """Read a column: its name, or a table with its name, its unit and its sign."""
    if isinstance(value, str) and value:
        return {"column": value}
    if isinstance(value, Mapping) and value.get("sign", 1) not in (1, -1):
        raise ValueError("sign is 1 or -1; write -1 to change the sign of the column")
    words = {name: item for name, item in value.items() if name != "sign"} if isinstance(value, Mapping) else {}
    sound = isinstance(words.get("column"), str) and words["column"]
    if not sound or not all(isinstance(item, str) for item in words.values()) or {*words} - {"column", "back", "unit"}:
        what = 'write for example load = { column = "force", unit = "nN" }'
        raise ValueError(f"this must name a column of the file, with its unit; {what}")
    return dict(words, sign=int(value.get("sign", 1)))


class ColumnTable(Table):
    """A column of the data, with its unit."""

    column: str = said("name of the column in the header", '"depth"', min_length=1)
    back: str = said("column of unloading, where it stands beside that of loading", '"depth_retract"', "")
    unit: str = said("unit of the column [from the header]", '"nm"', "")
    sign: int = said(
        "-1 changes the sign of the column, so that depth grows into the half-space and positive loads press", "-1", 1
    )


Column = Annotated[ColumnTable, BeforeValidator(_column)]
Word = Annotated[str, Field(min_length=1)]


class DataTable(File):
    """The measured loop."""

    indentation: Column | None = said("column of the depth, with its unit", '{ column = "depth", unit = "nm" }', None)
    displacement: Column | None = said(
        "instead of indentation: column of depth + load/stiffness, the displacement of a machine",
        '{ column = "piezo", unit = "nm" }',
        None,
    )
    load: Column | None = said(
        "column of the load, with its unit; positive loads press", '{ column = "force", unit = "nN" }', None
    )
    branch: Word | None = said(
        'column with "loading" or "unloading", "approach" or "retract", 0 or 1 [from the order of the points]',
        '"branch"',
        None,
    )
    leave_out: list[Word] = said(
        'more words of branch whose rows are left out, beside "pause", "hold", "dwell", "creep" and "modulate"',
        '["pause"]',
        [],
    )
    which: Literal["loading", "unloading"] | None = said(
        'the branch that is fitted: "loading" or "unloading" [both]', '"unloading"', None
    )
    cycle: Word | None = said("column with the number of the cycle, a whole number", '"cycle"', None)

    @property
    def names_columns(self) -> bool:
        """Whether it names any column of depths or loads."""
        return any((self.indentation, self.displacement, self.load))


_ZEROS: Final[Mapping[str, tuple[tuple[str, ...], str]]] = {
    "indentation": (("free", "contact"), '["-1 um", "2 um"]'),
    "load": (("free",), '["-5 nN", "5 nN"]'),
}
"""For each zero of an instrument its words, and a range to show."""


def offsets_of(value: object) -> Offsets:
    """
    Read which zeros are fitted.

    Raises
    ------
    ValueError
        It is neither true, false nor a table of them; the message says what to write.

    >>> offsets_of({"indentation": ["-1 um", "2 um"], "slope": True})
    Offsets(indentation=(-1e-06, 2e-06), load='free', slope=True)
    >>> offsets_of(False).names
    ()
    """
    if isinstance(value, Offsets):
        return value
    if isinstance(value, bool):
        return Offsets() if value else NO_OFFSETS
    if not isinstance(value, Mapping):
        raise ValueError("this must be true or false, or a table; write for example offsets = { slope = true }")  # noqa: TRY004
    known = (*_ZEROS, "slope")
    for name in value:
        if name not in known:
            raise ValueError(f"{shown(name)} is not a zero of an instrument; {did_you_mean(str(name), known)}")
    slope = value.get("slope", False)
    if not isinstance(slope, bool):
        raise ValueError("slope must be true or false; write slope = true to fit a tilt")  # noqa: TRY004
    return Offsets(**{name: _zero(name, value[name]) for name in _ZEROS if name in value}, slope=slope)


def _zero(name: str, value: object) -> Any:
    """Read one zero: a word, false, or the ends of a range."""
    words, ends = _ZEROS[name]
    if value is False or (isinstance(value, str) and value in words):
        return value
    what = f"write {name} = {', '.join(map(shown, words))}, false, or a range of two quantities as {ends}"
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError(f"{name} = {shown(value)} is not a zero that can be fitted; {what}")
    try:
        low, high = (si_value(end, name) for end in value)
    except ValueError as error:
        raise ValueError(f"{name}: {str(error).partition(';')[0]}; {what}") from None
    if not low < high:
        raise ValueError(f"{name} = {shown(value)}: the ends of a range must rise; exchange the two")
    return low, high


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
    what = "noise has the standard deviations of load and of indentation; write for example "
    what += 'noise = { load = "0.5 nN", indentation = "0.1 nm" }'
    if not isinstance(value, Mapping) or {*value} - {*keys} or "load" not in value or len(value) != 2:
        raise ValueError(what)
    found = {}
    for name, item in value.items():
        try:
            found[str(name)] = si_value(item, keys[str(name)])
        except ValueError as error:
            raise ValueError(f"{name}: {str(error).partition(';')[0]}; {what}") from None
    return found


class FitTable(Table):
    """What is fitted beside the parameters, and how."""

    offsets: Annotated[
        Any, BeforeValidator(offsets_of), WithJsonSchema({"anyOf": [{"type": "boolean"}, {"type": "object"}]})
    ] = said(
        "whether the zeros are also fitted; as a table `indentation`, `load` and, for a tilt, `slope`",
        '{ indentation = ["-1 um", "2 um"], load = "free", slope = true }',
        default=True,
        validate_default=True,
    )
    average: bool = said(
        "whether more than 2,000 points are averaged along the path, never across a jump", "false", default=True
    )
    noise: Annotated[
        dict[str, float] | None,
        BeforeValidator(lambda value: None if value is None else noise_of(value)),
        WithJsonSchema({"type": "object", "additionalProperties": {"type": "string"}}),
    ] = said(
        "standard deviations of the measured depth and load [estimated from the data]",
        '{ load = "0.5 nN", indentation = "0.1 nm" }',
        None,
    )
    intervals: Literal["profile", "linear"] = said(
        "95 % intervals from profile likelihoods, or from the linearised problem", '"profile"', "profile"
    )
    starts: int = said("maximum number of refinements, each from other starting values", "32", 32, ge=1, le=MOST_STARTS)


def _rate() -> Any:
    """Make the table of a moving edge, whose power may be searched."""
    about = fields(Rate)[0].metadata
    read = BeforeValidator(lambda value: given_of(value, _POWER))
    schema = WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "object"}]})
    own = Annotated[Any, read, schema, said(about["about"], about["example"])]
    return table_of(Rate, "FitRate", exponent=(own, ...))


def _is_fit(value: object) -> object:
    """Check the kind, which is meant to be a fit."""
    if value != "fit":
        raise ValueError('not a kind; did you mean "fit"?')
    return value


if TYPE_CHECKING:  # made when this is run
    FitParameters = Any
    FitPhysical = Any
    FitRate = Any
else:
    FitParameters = create_model("FitParameters", __base__=Table, **_inputs("parameters"))
    FitPhysical = create_model("FitPhysical", __base__=Table, **_inputs("physical"))
    FitRate = _rate()


class FitForm(Common):
    """A whole study of a fit, each key for itself."""

    kind: Annotated[Literal["fit"], BeforeValidator(_is_fit)] = said(*ABOUT_KIND)
    data: DataTable = said('measured loop, for kind = "fit"', '{ file = "loop.csv", indentation = "d", load = "F" }')
    parameters: FitParameters = said(*ABOUT_PARAMETERS)
    physical: FitPhysical = said(*ABOUT_PHYSICAL)
    rate: FitRate | None = said(*ABOUT_RATE, None)
    fit: FitTable = said("further options of the fit", "{ offsets = true }", FitTable())

    method: ClassVar = Method()
    """The exact solver alone; rules of other studies ask."""
    outputs: ClassVar = ()
    optimum: ClassVar = None

    @property
    def entries(self) -> dict[str, Given]:
        """What is given for the inputs, in the order of a dataset's dimensions; the power of the speed is the last."""
        given = {name: getattr(getattr(self, own.table, None), name, None) for name, own in INPUTS.items()}
        given |= {"machine_stiffness": None, "exponent": self.rate.exponent if self.rate else None}
        return {name: entry for name, entry in given.items() if entry is not None}


REQUIRED: Final[dict[tuple[str | int, ...], Any]] = {
    ("kind",): "fit",
    ("data",): {},
    ("data", "file"): "loop.csv",
    ("parameters",): {},
    ("physical",): {},
}
"""The keys that the form needs, with valid values that stand for wrong ones."""
