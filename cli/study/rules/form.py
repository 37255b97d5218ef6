"""The form of a study: which keys there are, and which values each of them takes.

The tables of inputs are made from `INPUTS`, those of the punch and of what its edge meets from the classes of the core;
pydantic checks the whole study at once and gives its JSON Schema. Its findings become sentences in mistakes.py; what
keys have to do with each other is in the other modules.
"""

import dataclasses
import math
import re
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal, Union, get_args, get_type_hints

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    WithJsonSchema,
    create_model,
)

from gradhesion.cli.study.rules.answers import Deviation
from gradhesion.cli.study.text.quantities import QUANTITIES, ratio_sentence, si_value
from gradhesion.core.answers.spectrum import Spectrum
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS, Input
from gradhesion.core.problem.outputs import CURVES, OUTPUTS
from gradhesion.core.problem.profile import MOST_HARMONICS, Profile
from gradhesion.core.problem.toughness import EXPONENTS, Rate, Toughness

Kind = Literal["map", "curve", "fit", "optimum"]
KINDS: Final[tuple[str, ...]] = get_args(Kind)
OUTPUTS_OF: Final = {
    "map": tuple(OUTPUTS),
    "curve": tuple(dict.fromkeys((*CURVES, *(name for curve in CURVES.values() for name in curve.names)))),
}
"""What can be asked for, by the kind of study; studies of the other kinds have no outputs."""
DATA: Final = "data"
"""What stands for the deepest point of the data of a fit, where the cycle turns."""


class Table(BaseModel):
    """A table of a study: no unknown keys, no silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, defer_build=True)


def said(about: str | None, example: str, default: Any = ..., **limits: Any) -> Any:
    """Declare a key: what it is about, a value that would do, as TOML has it, and what holds where it is left out."""
    return Field(default, description=about, examples=[example], **limits)


def _checked_by(read: Any, schema: Mapping[str, Any], type_: Any = Any) -> Any:
    """Make the type of a value that a function reads, which raises ValueError with a sentence."""
    once = BeforeValidator(lambda value: value if value is None else read(value))
    return Annotated[type_, once, WithJsonSchema({**schema})]


class OfCore(Table):
    """A table whose keys are the settings of a class of the core."""

    made_as: ClassVar[type]

    def made(self, **instead: Any) -> Any:
        """Make what it says, with some values in the place of its own."""
        own = {one.name: getattr(self, one.name) for one in dataclasses.fields(self.made_as)} | instead
        given = {name: value for name, value in own.items() if value is not None}
        waves = {name: tuple(one.made() for one in value) for name, value in given.items() if isinstance(value, list)}
        return self.made_as(**given | waves)


def _table_of(kind: type, **more: Any) -> Any:
    """Make the table of a study whose keys are the settings of a class of the core, and perhaps `more`."""
    hints, own = get_type_hints(kind), {}
    for one in dataclasses.fields(kind):
        hint, default, limits = hints[one.name], one.default, dict(one.metadata["bounds"])
        if items := get_args(hint):
            hint, limits = list[_table_of(items[0])], {"min_length": 1, "max_length": MOST_HARMONICS}  # type: ignore[misc]
        elif one.metadata["choices"]:
            hint = Literal[one.metadata["choices"]]
        elif hint is float:
            limits["allow_inf_nan"] = False
        if default is None or (items and default is not dataclasses.MISSING):
            hint, default, limits = Annotated[hint, Field(**limits)] | None, None, {}
        default = ... if default is dataclasses.MISSING else default
        own[one.name] = (hint, said(one.metadata["about"], one.metadata["example"], default, **limits))
    made: Any = create_model(kind.__name__, __base__=OfCore, __doc__=str(kind.__doc__).partition("\n")[0], **own | more)
    made.made_as = kind
    return made


# The inputs: a number, a list, a range or a file of points for each.


class Range(Table):
    """An axis by its ends and its number of values, or the ends between which an input is searched."""

    start: float
    stop: float
    num: int | None = said(
        "the number of values, required unless the input is searched",
        "50",
        None,
        ge=1,
        json_schema_extra={"type": "integer", "minimum": 1},
    )
    spacing: Literal["linear", "log"] = said("whether differences or ratios of neighbours are equal", '"log"', "linear")


Entry = float | list[float] | Range | Literal["data"]
"""What a study gives for an input: a number, a list, or a range; quantities in SI units."""


class File(Table):
    """A file with its fingerprint."""

    file: str = said(
        "path of a file, relative to the folder of the study; for loops, several with * or ?", '"tip.csv"', min_length=1
    )
    sha256: str = said("SHA-256 of the file; a file that differs is refused", '"0a1b..."', "", pattern="^[0-9a-f]{64}$")


def _tagged(**forms: Any) -> Any:
    """Make the type of a value of several forms (plain, list, table), told apart before any is tried."""
    own: Any = Union[tuple(Annotated[form, Tag(name)] for name, form in forms.items())]  # noqa: UP007 (at run time)
    return Annotated[own, Discriminator(_form_of)]


def _form_of(value: object) -> str:
    """Report which form of a value is meant."""
    return "table" if isinstance(value, Mapping | Table) else "list" if isinstance(value, list) else "plain"


def _quantity(name: str, **schema: Any) -> Any:
    """Make the type of a quantity, which becomes a number in SI units."""
    read = BeforeValidator(lambda value: value if value is None else si_value(value, name))
    return Annotated[float, read, Field(json_schema_extra=schema or {"type": ["string", "number"]})]


def _ranged(own: Input, number: Any) -> Any:
    """Make the table of a range of a number."""
    start, stop = ((number, said(f"the {which} value", own.value)) for which in ("first", "last"))
    return create_model(f"Range_{own.name}", __base__=Range, start=start, stop=stop)


def _entry(own: Input) -> tuple[Any, Any]:
    """Make the key of an input: a number, a list of numbers, or a range table; quantities become numbers in SI."""
    number: Any
    end: Any
    limits: dict[str, Any] = {"strict": True, **own.bounds}
    if own.table == "physical":
        number = _quantity(own.name)
        end = Annotated[number, Field(allow_inf_nan=False)]
    else:
        number = Annotated[float, Field(allow_inf_nan=own.infinite, **limits)]
        end = Annotated[float, Field(allow_inf_nan=False, **limits)]
    plain: Any = number
    if own.name == "indentation_max":
        read = BeforeValidator(lambda value: value if value == DATA else si_value(value, own.name))
        plain = Annotated[float | Literal["data"], read]
    forms = _tagged(plain=plain, list=Annotated[list[number], Field(min_length=1)], table=_ranged(own, end))
    return forms, said(own.about, own.value, ... if own.name in ("k", "nu") else None)


def _table(name: str, **more: Any) -> Any:
    """Make the table of inputs of one name; k and nu are required."""
    own: dict[str, Any] = {one.name: _entry(one) for one in INPUTS.values() if one.table == name}
    return create_model(name.capitalize(), __base__=Table, **own, **more)


# How far they may be off.

_PERCENTAGE: Final = re.compile(r"\s*([+-]?(?:\d{1,20}\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*%\s*")


def deviation_of(value: object, name: str) -> Deviation:
    """
    Read the deviation of an input.

    Raises
    ------
    ValueError
        It is none; the message says what to write.

    >>> deviation_of("5 %", "modulus").deviation, deviation_of("20 nm", "c0").deviation
    (0.05, 2e-08)
    >>> nu = deviation_of({"low": 0.28, "high": 0.32}, "nu")
    >>> nu.uniform, nu.low, nu.high
    (True, 0.28, 0.32)
    """
    if isinstance(value, Deviation):
        return value
    own = INPUTS[name]
    forms = f'write for example {name} = "5 %", a standard deviation in its unit, or {{ low = .., high = .. }}'

    def number(one: object) -> float:
        if isinstance(one, int | float) and not isinstance(one, bool):
            if own.table == "physical":
                raise ValueError(f"a number without a unit; {forms}")
            return float(one)
        if own.table == "physical":
            return si_value(one, name)
        raise ValueError((isinstance(one, str) and ratio_sentence(one, name)) or f"not a deviation; {forms}")

    if isinstance(value, Mapping):
        if {*value} != {"low", "high"}:
            raise ValueError(f"a uniform distribution has both low and high, and nothing else; {forms}")
        low, high = number(value["low"]), number(value["high"])
        if not (low < high < math.inf and own.admits(low) and own.admits(high)):
            raise ValueError(f"out of range; choose low below high with {own.allowed}, both finite")
        return Deviation(low=low, high=high, uniform=True)
    low = own.bounds.get("ge", own.bounds.get("gt", -math.inf))
    share = _PERCENTAGE.fullmatch(value) if isinstance(value, str) else None
    deviation = float(share[1]) / 100.0 if share else number(value)
    if not 0.0 < deviation < math.inf or (share and deviation > 1.0):
        raise ValueError(f"a deviation is above 0 and finite, a percentage at most 100; {forms}, or remove this key")
    return Deviation(deviation=deviation, relative=share is not None, low=low, high=own.bounds.get("le", math.inf))


def _samples(value: object) -> object:
    """Check the number of samples."""
    if isinstance(value, int) and not isinstance(value, bool) and value in (0, *(2**n for n in range(1, 21))):
        return value
    words = f"the number of samples is a power of two up to {2**20:,}, or 0 for none"
    raise ValueError(f"{words}; write for example samples = 1024")


def _deviation(own: Input) -> tuple[Any, Any]:
    """Make the key of the deviation of an input."""
    kind = _checked_by(
        lambda value: deviation_of(value, own.name), {"type": ["number", "string", "object"]}, Deviation | None
    )
    return kind, said(f"uncertainty of {own.name}: {own.about}", '"5 %"', None)


# The punch, its loading and what its edge meets.


Words = Annotated[
    list[str],
    Field(min_length=1),
    BeforeValidator(lambda value: [value] if isinstance(value, str) else value),
    WithJsonSchema({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}, "minItems": 1}]}),
]
"""One word, or a list of some."""
if TYPE_CHECKING:  # made when this is run, which the types cannot show
    Parameters = Any
    Physical = Any
    Shape = Any
    SpectrumTable = Any
    LoadingTable = Any
    ToughnessTable = Any
    RateTable = Any
    Deviations = Any
else:
    _file = _tagged(plain=Annotated[str, Field(min_length=1)], table=File)
    _about = "scenes from a file (CSV or NetCDF): one row per scene, one column per parameter"
    Parameters = _table("parameters", points=(_file, said(_about, '"samples.csv"', None)))
    Physical = _table("physical")
    Shape = _table_of(Profile)
    SpectrumTable = _table_of(Spectrum)
    LoadingTable = _table_of(Loading, machine_stiffness=_entry(INPUTS["machine_stiffness"]))
    ToughnessTable = _table_of(Toughness)
    _about, *_ = dataclasses.fields(Rate)
    _least, _most = EXPONENTS
    _power = Annotated[float, Field(ge=_least, le=_most, allow_inf_nan=False)]
    _power = Annotated[
        _tagged(plain=_power, table=_ranged(Input("exponent", "", "", "0.3"), _power)),
        WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "object"}], "minimum": _least, "maximum": _most}),
    ]
    RateTable = _table_of(Rate, exponent=(_power, said(_about.metadata["about"], _about.metadata["example"])))
    Deviations = create_model("Deviations", __base__=Table, **{one.name: _deviation(one) for one in INPUTS.values()})


class Uncertainty(Deviations):  # type: ignore[misc]
    """How far the inputs may be off."""

    samples: Annotated[int, BeforeValidator(_samples)] = said(
        "number of quasi-random samples, a power of two; 0: standard deviations by sensitivities only", "1024", 0
    )
    seed: int = said("seed of the random numbers", "1", 0, ge=0, lt=2**63)


class ProfileTable(Shape):  # type: ignore[misc]
    """The shape of the punch: that of a series, of random waves or of heights in a file."""

    exponent: Annotated[float, Field(ge=1.0, allow_inf_nan=False)] | Literal["fit"] = said(
        dataclasses.fields(Profile)[0].metadata["about"], "2.0", 2.0, json_schema_extra={"minimum": 1.0}
    )
    spectrum: SpectrumTable | None = said(
        "random self-affine waves instead of harmonics; A is then their rms height over lambda",
        "{ hurst = 0.8, first = 1, last = 32, realisations = 100, seed = 1 }",
        None,
    )
    file: str | None = said(File.model_fields["file"].description, '"tip.csv"', None, min_length=1)
    sha256: str = said(File.model_fields["sha256"].description, '"0a1b..."', "", pattern="^[0-9a-f]{64}$")
    terms: int | None = said(
        "number of harmonics to fit to the heights in the file [16]", "16", None, ge=1, le=MOST_HARMONICS
    )
    up_to: _quantity("up_to", type="string") | None = said(  # type: ignore[valid-type]
        QUANTITIES["up_to"].about, QUANTITIES["up_to"].value, None
    )


Radius = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]


class States(Table):
    """The states whose pressure and surface are drawn."""

    contact_radius_over_R: list[Radius] | None = said(  # noqa: N815 (the key of a study)
        "contact radii a/R of equilibrium states [turning point, pull-off and jump-out]",
        "[0.1, 0.2]",
        None,
        min_length=1,
        max_length=100,
    )


class Method(Table):
    """How the scenes are solved."""

    solver: Words = said(
        "the exact solution, or an approximation for short waves; a list compares several",
        '["exact", "envelope"]',
        "exact",
        validate_default=True,
    )
    check_contact: bool = said(
        "whether `status` reports that the contact on loading is not one disc", "false", default=True
    )


Limits = dict[str, Annotated[float, Field(allow_inf_nan=False)]]


class Require(Table):
    """What an optimum has to meet."""

    one_disc: bool = said("whether contact on loading must be one disc", "true", default=False)
    minimum: Limits = said("minimum values of other outputs", "{ dissipated_energy = 0.1 }", {})
    maximum: Limits = said("maximum values of other outputs", "{ pull_off_radius = 0.2 }", {})


class Optimum(Table):
    """What is sought."""

    maximise: Words = said("output to maximise; two outputs: their Pareto front", '"pull_off_force"', [])
    minimise: Words = said("output to minimise, instead or as a second goal", '"dissipated_energy"', [])
    over: list[str] = said("inputs to search between bounds: { start, stop } without num", '["lambda_over_R"]', [])
    resolution: int = said(
        "points of the sweep along each input; narrower peaks may be missed", "200", 200, ge=3, le=1_000_000
    )
    require: Require = said(
        "conditions that an optimum must meet", "{ one_disc = true, minimum = { dissipated_energy = 0.1 } }", Require()
    )

    @property
    def goals(self) -> list[tuple[str, str]]:
        """Every goal, behind the key that names it."""
        return [(way, name) for way in ("maximise", "minimise") for name in getattr(self, way)]


# Measured loops, and how they are fitted.


class ColumnTable(Table):
    """A column of the data, with its unit."""

    column: str = said("name of the column in the header", '"depth"', min_length=1)
    back: str = said("column of unloading, where it stands beside that of loading", '"depth_retract"', "")
    unit: str = said("unit of the column [from the header]", '"nm"', "")
    sign: Literal[1, -1] = said(
        "-1 changes the sign of the column, so that depth grows into the half-space and positive loads press", "-1", 1
    )


Column = Annotated[ColumnTable, BeforeValidator(lambda value: {"column": value} if isinstance(value, str) else value)]
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
    def depths(self) -> str:
        """The key that names the column of the depths; empty where none does."""
        return "displacement" if self.displacement else "indentation" if self.indentation else ""


def _zero(name: str, *words: str) -> Any:
    """Make the type of a zero of an instrument: a word, false, or the ends of the range in which it is searched."""

    def read(value: object) -> Any:
        if value is False or (isinstance(value, str) and value in words) or isinstance(value, tuple):
            return value
        ends = QUANTITIES[name].value.strip('"')
        known = " or ".join(f'"{word}"' for word in words)
        what = f'this must be {known}, false, or a range ["-{ends}", "{ends}"]; write for example {name} = "free"'
        if not isinstance(value, list) or len(value) != 2:
            raise ValueError(what)
        low, high = (si_value(end, name) for end in value)
        if not low < high:
            raise ValueError("the ends of a range must rise; exchange the two")
        return low, high

    return _checked_by(read, {"anyOf": [{"type": one} for one in ("string", "boolean", "array")]})


class OffsetsTable(Table):
    """Which zeros are fitted."""

    indentation: _zero("indentation", "free", "contact") = said("the zero of depth", '"contact"', "free")  # type: ignore[valid-type]
    load: _zero("load", "free") = said("the zero of load", '["-5 nN", "5 nN"]', "free")  # type: ignore[valid-type]
    slope: bool = said("whether a tilt of the load is fitted", "true", default=False)


def _offsets(value: object) -> object:
    """Read whether all zeros are fitted, or none."""
    if isinstance(value, bool):
        return dict.fromkeys(("indentation", "load"), "free" if value else False)
    if not isinstance(value, Mapping | Table):
        what = "this must be true or false, or a table; write for example offsets = { slope = true }"
        raise ValueError(what)  # noqa: TRY004 (pydantic hears no other)
    return value


class Noise(Table):
    """Standard deviations of the measured load, and of depth or displacement."""

    load: _quantity("load", type="string") = said("of the load", '"0.5 nN"', gt=0.0)  # type: ignore[valid-type]
    indentation: _quantity("indentation", type="string") | None = said("of the depth", '"0.1 nm"', None, gt=0.0)  # type: ignore[valid-type]
    displacement: _quantity("indentation", type="string") | None = said("of the displacement", '"0.1 nm"', None, gt=0.0)  # type: ignore[valid-type]


class FitTable(Table):
    """What is fitted beside the parameters, and how."""

    offsets: Annotated[
        OffsetsTable, BeforeValidator(_offsets), WithJsonSchema({"anyOf": [{"type": "boolean"}, {"type": "object"}]})
    ] = said(
        "whether the zeros are also fitted; as a table `indentation`, `load` and, for a tilt, `slope`",
        '{ indentation = ["-1 um", "2 um"], load = "free", slope = true }',
        default=True,
        validate_default=True,
    )
    average: bool = said(
        "whether more than 2,000 points are averaged along the path, never across a jump", "false", default=True
    )
    noise: Noise | None = said(
        "standard deviations of the measured depth and load [estimated from the data]",
        '{ load = "0.5 nN", indentation = "0.1 nm" }',
        None,
    )
    intervals: Literal["profile", "linear"] = said(
        "95 % intervals from profile likelihoods, or from the linearised problem", '"profile"', "profile"
    )
    starts: int = said("maximum number of refinements, each from other starting values", "32", 32, ge=1, le=4096)


def _one_line(title: str) -> str:
    """Check a title."""
    if not title.isprintable():
        raise ValueError("a title is one line of printable characters; remove the others")
    return title


class Form(Table):
    """A whole study, each key for itself."""

    include: str = said(
        "path of a study, from the folder of this one, whose keys hold where this one has none, also within its tables",
        '"base.toml"',
        "",
    )
    title: Annotated[str, AfterValidator(_one_line)] = said(
        "title of the dataset [name of the file]", '"Pull-off force against wavelength"', ""
    )
    kind: Kind = said(
        "one value per scene, curves of each scene, optima, or parameters from a measured loop", '"map"', "map"
    )
    layout: Literal["grid", "points"] = said(
        "every combination of the axes is a scene, or the lists are combined item by item", '"grid"', "grid"
    )
    outputs: list[str] = said(
        "quantities to compute for each scene, required for maps and curves",
        '["pull_off_force", "dissipated_energy"]',
        [],
        min_length=1,
    )
    parameters: Parameters = said("the parameters of a scene, each a number or an axis", "{ k = 0.5, nu = 0.3, .. }")
    physical: Physical | None = said("quantities with units instead of ratios", '{ R = "1 mm", .. }', None)
    profile: ProfileTable = said(
        "the shape of the punch: a power, and a series of waves", "{ exponent = 2.0 }", ProfileTable()
    )
    loading: LoadingTable = said("control of the punch", '{ control = "load" }', LoadingTable())
    toughness: ToughnessTable | None = said(
        "a toughness that varies with the radius: a series of waves", "{ harmonics = [{ n = 1, cos = 0.2 }] }", None
    )
    rate: RateTable | None = said(
        "a work of adhesion that grows with the speed of the edge", "{ exponent = 0.6 }", None
    )
    states: States = said(
        'states of contact for pressure and surface, for kind = "curve"',
        "{ contact_radius_over_R = [0.1, 0.2] }",
        States(),
    )
    optimum: Optimum | None = said(
        'goal, searched inputs and requirements, for kind = "optimum"',
        '{ maximise = "pull_off_force", over = ["lambda_over_R"] }',
        None,
    )
    uncertainty: Uncertainty | None = said(
        "uncertainties of the inputs: outputs get standard deviations and, with samples, quantiles",
        '{ modulus = "5 %" }',
        None,
    )
    method: Method = said("how the scenes are solved", '{ solver = "exact" }', Method())
    data: DataTable | None = said(
        'measured loop, for kind = "fit"', '{ file = "loop.csv", indentation = "d", load = "F" }', None
    )
    fit: FitTable = said("further options of the fit", "{ offsets = true }", FitTable())

    @cached_property
    def entries(self) -> dict[str, Entry]:
        """What is given for the inputs, in the order of a dataset's dimensions."""
        given = {name: getattr(getattr(self, own.table, None), name, None) for name, own in INPUTS.items()}
        return {name: entry for name, entry in given.items() if entry is not None}
