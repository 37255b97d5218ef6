"""The form of a study of scenes: which keys there are, and which values each of them takes.

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
from gradhesion.core.problem.toughness import Rate, Toughness

Kind = Literal["map", "curve", "fit", "optimum"]
KINDS: Final[tuple[str, ...]] = get_args(Kind)
MOST_STATES: Final = 100
"""States of one study: their curves are for looking at."""
MOST_RESOLUTION: Final = 1_000_000
"""Points of a sweep along one input."""
MOST_SAMPLES: Final = 2**20
"""Samples of the inputs of one scene: all are in memory."""
OUTPUTS_OF: Final = {
    "map": tuple(OUTPUTS),
    "curve": tuple(dict.fromkeys((*CURVES, *(name for curve in CURVES.values() for name in curve.names)))),
}
"""What can be asked for, by the kind of study; studies of the other kinds have no outputs."""


class Table(BaseModel):
    """A table of a study: no unknown keys, no silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, defer_build=True)


def said(about: str | None, example: str, default: Any = ..., **limits: Any) -> Any:
    """Declare a key: what it is about, a value that would do, as TOML has it, and what holds where it is left out."""
    return Field(default, description=about, examples=[example], **limits)


class OfCore(Table):
    """A table whose keys are the settings of a class of the core."""

    made_as: ClassVar[type]

    def made(self) -> Any:
        """Make what it says."""
        own = {one.name: getattr(self, one.name) for one in dataclasses.fields(self.made_as)}
        given = {name: value for name, value in own.items() if value is not None}
        waves = {name: tuple(one.made() for one in value) for name, value in given.items() if isinstance(value, list)}
        return self.made_as(**given | waves)


def table_of(kind: type, name: str = "", **more: Any) -> Any:
    """Make the table of a study whose keys are the settings of a class of the core, and perhaps `more`."""
    hints, own = get_type_hints(kind), {}
    for one in dataclasses.fields(kind):
        hint, default, limits = hints[one.name], one.default, dict(one.metadata["bounds"])
        if items := get_args(hint):
            hint, limits = list[table_of(items[0])], {"min_length": 1, "max_length": MOST_HARMONICS}  # type: ignore[misc]
        elif one.metadata["choices"]:
            hint = Literal[one.metadata["choices"]]
        elif hint is float:
            limits["allow_inf_nan"] = False
        if default is None or (items and default is not dataclasses.MISSING):
            hint, default = Annotated[hint, Field(**limits)] | None, None
            limits = {}
        default = ... if default is dataclasses.MISSING else default
        own[one.name] = (hint, said(one.metadata["about"], one.metadata["example"], default, **limits))
    made: Any = create_model(
        name or kind.__name__, __base__=OfCore, __doc__=str(kind.__doc__).partition("\n")[0], **own | more
    )
    made.made_as = kind
    return made


# The inputs: a number, a list, a range or a file of points for each.


class Range(Table):
    """An axis by its ends and its number of values."""

    start: float
    stop: float
    num: int = said("the number of values", "50", ge=1)
    spacing: Literal["linear", "log"] = said("whether differences or ratios of neighbours are equal", '"log"', "linear")


Entry = float | list[float] | Range
"""What a study gives for an input: a number, a list, or a range; quantities in SI units."""


class File(Table):
    """A file with its fingerprint."""

    file: str = said(
        "path of a file, relative to the folder of the study; for loops, several with * or ?", '"tip.csv"', min_length=1
    )
    sha256: str = said("SHA-256 of the file; a file that differs is refused", '"0a1b..."', "", pattern="^[0-9a-f]{64}$")


def _tagged(which: Any, **forms: Any) -> Any:
    """Make the type of a value of several forms, told apart before any is tried."""
    own: Any = Union[tuple(Annotated[form, Tag(name)] for name, form in forms.items())]  # noqa: UP007 (at run time)
    return Annotated[own, Discriminator(which)]


def _form_of(value: object) -> str:
    """Report which form of a value is meant."""
    return "table" if isinstance(value, Mapping | Table) else "list" if isinstance(value, list) else "plain"


def _entry(own: Input) -> tuple[Any, Any]:
    """Make the key of an input: a number, a list of numbers, or a range table; quantities become numbers in SI."""
    number: Any
    end: Any
    limits: dict[str, Any] = {"strict": True, **own.bounds}
    if own.table == "physical":
        schema: Any = Field(json_schema_extra={"type": ["string", "number"]})
        number = Annotated[float, BeforeValidator(lambda value: si_value(value, own.name)), schema]
        end = Annotated[number, Field(allow_inf_nan=False)]
    else:
        end = Annotated[float, Field(allow_inf_nan=False, **limits)]
        number = Annotated[float, Field(**limits)] if own.infinite else end
    start, stop = ((end, said(f"the {which} value", own.value)) for which in ("first", "last"))
    made: Any = create_model(f"Range_{own.name}", __base__=Range, start=start, stop=stop)
    forms = _tagged(_form_of, plain=number, list=Annotated[list[number], Field(min_length=1)], table=made)
    return forms, said(own.about, own.value, ... if own.name in ("k", "nu") else None)


def _table(name: str, **more: Any) -> Any:
    """Make the table of inputs of one name; k and nu are required."""
    own: dict[str, Any] = {one.name: _entry(one) for one in INPUTS.values() if one.table == name}
    return create_model(name.capitalize(), __base__=Table, **own, **more)


# How far they may be off.

_PERCENTAGE: Final = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*%\s*")
_LONGEST: Final = 60
"""Characters of a percentage."""


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
    forms = f'write for example {name} = "5 %" of the value, a standard deviation in its unit, or '
    forms += "{ low = .., high = .. }"
    if isinstance(value, Mapping):
        if {*value} != {"low", "high"}:
            raise ValueError(f"a uniform distribution has both low and high, and nothing else; {forms}")
        low, high = (_number(value[end], name, forms) for end in ("low", "high"))
        if not (own.admits(low) and own.admits(high) and math.isfinite(high)):
            raise ValueError(f"out of range; choose low and high with {own.allowed}, both finite")
        if not low < high:
            raise ValueError("low is not below high; exchange the two, or remove this key")
        return Deviation(low=low, high=high, uniform=True)
    low = own.bounds.get("ge", own.bounds.get("gt", -math.inf))
    share = _PERCENTAGE.fullmatch(value) if isinstance(value, str) and len(value) <= _LONGEST else None
    number = float(share[1]) / 100.0 if share else _number(value, name, forms)
    if not 0.0 < number < math.inf or (share and number > 1.0):
        raise ValueError(f"a deviation is above 0 and finite, a percentage at most 100; {forms}, or remove this key")
    return Deviation(deviation=number, relative=share is not None, low=low, high=own.bounds.get("le", math.inf))


def _number(value: object, name: str, forms: str) -> float:
    """Read a number in the unit of an input."""
    plain = isinstance(value, int | float) and not isinstance(value, bool)
    if INPUTS[name].table == "physical":
        if plain:
            raise ValueError(f"a number without a unit; {forms}")
        return si_value(value, name)
    if plain:
        return float(value)  # type: ignore[arg-type]
    raise ValueError((isinstance(value, str) and ratio_sentence(value, name)) or f"not a deviation; {forms}")


def _samples(value: object) -> object:
    """Check the number of samples."""
    if isinstance(value, int) and not isinstance(value, bool) and value in (0, *(2**n for n in range(1, 21))):
        return value
    words = f"the number of samples is a power of two up to {MOST_SAMPLES:,}, or 0 for none"
    raise ValueError(f"{words}; write for example samples = 1024")


def _deviation(own: Input) -> tuple[Any, Any]:
    """Make the key of the deviation of an input."""
    read = BeforeValidator(lambda value: None if value is None else deviation_of(value, own.name))
    schema = WithJsonSchema({"type": ["number", "string", "object"]})
    return Annotated[Deviation | None, read, schema], said(f"uncertainty of {own.name}: {own.about}", '"5 %"', None)


# The punch, its loading and what its edge meets.


def _exponent(value: object) -> object:
    """Check the power of a punch."""
    if value == "fit" or (isinstance(value, int | float) and not isinstance(value, bool) and 1.0 <= value < math.inf):
        return float(value) if isinstance(value, int) else value
    words = "the power of the punch is a number of 1 or more, and finite (1 is a cone)"
    raise ValueError(f"{words}; write for example exponent = 2.0")


if TYPE_CHECKING:  # made when this is run, which the types cannot show
    Parameters = Any
    Physical = Any
    Shape = Any
    SpectrumTable = Any
    LoadingTable = Any
    ToughnessTable = Any
    RateTable = Any
    Deviations = Any
    Words = str | list[str]
else:
    _file = _tagged(_form_of, plain=Annotated[str, Field(min_length=1)], table=File)
    _about = "scenes from a file (CSV or NetCDF): one row per scene, one column per parameter"
    Parameters = _table("parameters", points=(_file, said(_about, '"samples.csv"', None)))
    Physical = _table("physical")
    Shape = table_of(Profile)
    SpectrumTable = table_of(Spectrum)
    LoadingTable = table_of(Loading, machine_stiffness=_entry(INPUTS["machine_stiffness"]))
    ToughnessTable = table_of(Toughness)
    RateTable = table_of(Rate)
    Deviations = create_model("Deviations", __base__=Table, **{one.name: _deviation(one) for one in INPUTS.values()})
    Words = _tagged(_form_of, plain=str, list=Annotated[list[str], Field(min_length=1)])


class Uncertainty(Deviations):  # type: ignore[misc]
    """How far the inputs may be off."""

    samples: Annotated[int, BeforeValidator(_samples)] = said(
        "number of quasi-random samples, a power of two; 0: standard deviations by sensitivities only", "1024", 0
    )
    seed: int = said("seed of the random numbers", "1", 0, ge=0, lt=2**63)


class ProfileTable(Shape):  # type: ignore[misc]
    """The shape of the punch: that of a series, of random waves or of heights in a file."""

    exponent: Annotated[float | Literal["fit"], BeforeValidator(_exponent)] = said(
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
    up_to: Annotated[float | None, BeforeValidator(lambda value: si_value(value, "up_to"))] = said(
        QUANTITIES["up_to"].about, QUANTITIES["up_to"].value, None, json_schema_extra={"type": "string"}
    )


Radius = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]


class States(Table):
    """The states whose pressure and surface are drawn."""

    contact_radius_over_R: list[Radius] | None = said(  # noqa: N815 (the key of a study)
        "contact radii a/R of equilibrium states [turning point, pull-off and jump-out]",
        "[0.1, 0.2]",
        None,
        min_length=1,
        max_length=MOST_STATES,
    )


class Method(Table):
    """How the scenes are solved."""

    solver: Words = said(
        "the exact solution, or an approximation for short waves; a list compares several",
        '["exact", "envelope"]',
        "exact",
    )
    check_contact: bool = said(
        "whether `status` reports that the contact on loading is not one disc", "false", default=True
    )

    @property
    def solvers(self) -> list[str]:
        """All solvers that are asked for."""
        return list_of(self.solver)


Limits = dict[str, Annotated[float, Field(allow_inf_nan=False)]]


class Require(Table):
    """What an optimum has to meet."""

    one_disc: bool = said("whether contact on loading must be one disc", "true", default=False)
    minimum: Limits = said("minimum values of other outputs", "{ dissipated_energy = 0.1 }", {})
    maximum: Limits = said("maximum values of other outputs", "{ pull_off_radius = 0.2 }", {})


class Optimum(Table):
    """What is sought."""

    maximise: Words | None = said("output to maximise; two outputs: their Pareto front", '"pull_off_force"', None)
    minimise: Words | None = said("output to minimise, instead or as a second goal", '"dissipated_energy"', None)
    over: list[str] = said("inputs to search between bounds: { start, stop } without num", '["lambda_over_R"]', [])
    resolution: int = said(
        "points of the sweep along each input; narrower peaks may be missed", "200", 200, ge=3, le=MOST_RESOLUTION
    )
    require: Require = said(
        "conditions that an optimum must meet", "{ one_disc = true, minimum = { dissipated_energy = 0.1 } }", Require()
    )

    @property
    def goals(self) -> list[tuple[str, str]]:
        """Every goal, behind the key that names it."""
        return [(way, name) for way in ("maximise", "minimise") for name in list_of(getattr(self, way))]


def list_of(words: str | list[str] | None) -> list[str]:
    """Give the words of a key that takes one of them, or a list."""
    return [] if words is None else [words] if isinstance(words, str) else words


ABOUT_KIND: Final = ("one value per scene, curves of each scene, optima, or parameters from a measured loop", '"map"')
ABOUT_PARAMETERS: Final = ("the parameters of a scene, each a number or an axis", "{ k = 0.5, nu = 0.3, .. }")
ABOUT_PHYSICAL: Final = ("quantities with units instead of ratios", '{ R = "1 mm", .. }')
ABOUT_RATE: Final = ("a work of adhesion that grows with the speed of the edge", "{ exponent = 0.6 }")


def one_line(title: str) -> str:
    """Check a title."""
    if not title.isprintable():
        raise ValueError("a title is one line of printable characters; remove the others")
    return title


class Common(Table):
    """The keys of studies of every kind."""

    include: str = said(
        "path of a study, from the folder of this one, whose keys hold where this one has none, also within its tables",
        '"base.toml"',
        "",
    )
    title: Annotated[str, AfterValidator(one_line)] = said(
        "title of the dataset [name of the file]", '"Pull-off force against wavelength"', ""
    )
    profile: ProfileTable = said(
        "the shape of the punch: a power, and a series of waves", "{ exponent = 2.0 }", ProfileTable()
    )
    loading: LoadingTable = said("control of the punch", '{ control = "load" }', LoadingTable())
    toughness: ToughnessTable | None = said(
        "a toughness that varies with the radius: a series of waves", "{ harmonics = [{ n = 1, cos = 0.2 }] }", None
    )


class Form(Common):
    """A whole study of scenes, each key for itself."""

    kind: Kind = said(*ABOUT_KIND, "map")
    layout: Literal["grid", "points"] = said(
        "every combination of the axes is a scene, or the lists are combined item by item", '"grid"', "grid"
    )
    outputs: list[str] = said(
        "quantities to compute for each scene", '["pull_off_force", "dissipated_energy"]', min_length=1
    )
    parameters: Parameters = said(*ABOUT_PARAMETERS)
    physical: Physical | None = said(*ABOUT_PHYSICAL, None)
    rate: RateTable | None = said(*ABOUT_RATE, None)
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

    @cached_property
    def entries(self) -> dict[str, Entry]:
        """What is given for the inputs, in the order of a dataset's dimensions."""
        given = {name: getattr(getattr(self, own.table, None), name, None) for name, own in INPUTS.items()}
        return {name: entry for name, entry in given.items() if entry is not None}
