"""The form of a study: which keys there are, and which values each of them takes.

pydantic checks the form of the whole study at once and gives its JSON Schema; a valid form is what a `Study` is made
from. Its findings become sentences in `mistakes.py`. What two keys have to do with each other is in `cli/study/rules`.
"""

import math
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal, Union

from pydantic import BaseModel, BeforeValidator, ConfigDict, Discriminator, Field, Tag, WithJsonSchema, create_model

from gradhesion.cli.keys import INPUTS, KEYS, MACHINE, Key
from gradhesion.cli.study.form.deviation import Deviation, deviation_of
from gradhesion.cli.study.text.quantities import si_value
from gradhesion.cli.terminal.wording import example
from gradhesion.core.problem.profile import MOST_HARMONICS
from gradhesion.core.problem.rate import EXPONENTS

MOST_WAVES: Final = 10_000
"""The shortest wave of a series, in waves a wavelength: beyond it hardly any scene can be followed."""


SLOWEST, FASTEST = EXPONENTS
"""The range of the power of the speed."""

MOST_REALISATIONS: Final = 100_000
"""Profiles of one study: each is solved by itself."""

MOST_SAMPLES: Final = 2**20
"""Samples of the inputs of one scene: all are in memory."""

MOST_RESOLUTION: Final = 1_000_000
"""Points of a sweep along one input."""

MOST_STATES: Final = 100
"""States of one study: their curves are for looking at."""


class Table(BaseModel):
    """A table of a study: no unknown keys, no silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, defer_build=True)


def _of(name: str, kind: Any, **limits: Any) -> Any:
    """Make the type of a key, with what it is about."""
    return Annotated[kind, Field(description=KEYS[name].about, **limits)]


class Range(Table):
    """An axis by its ends and its number of values."""

    start: float
    stop: float
    num: Annotated[int, Field(ge=1, description=KEYS["num"].about)]
    spacing: Annotated[Literal["linear", "log"], Field(description=KEYS["spacing"].about)] = "linear"


Entry = float | list[float] | Range
"""What a study gives for an input: a number, a list, or a range; quantities in SI units."""


class FileTable(Table):
    """A file with its fingerprint."""

    file: Annotated[str, Field(min_length=1, description=KEYS["file"].about)]
    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$", description=KEYS["sha256"].about)] = ""


class MethodTable(Table):
    """How the scenes are solved."""

    solver: Annotated[
        Annotated[str, Tag("name")] | Annotated[list[str], Field(min_length=1), Tag("list")],
        Discriminator(lambda value: "list" if isinstance(value, list) else "name"),
        Field(description=KEYS["solver"].about),
    ] = "exact"
    check_contact: Annotated[bool, Field(description=KEYS["check_contact"].about)] = True

    @property
    def solvers(self) -> list[str]:
        """All solvers that are asked for."""
        return [self.solver] if isinstance(self.solver, str) else self.solver


class Wave(Table):
    """One wave of the series of a profile."""

    n: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["n"].about)]
    cos: Annotated[float | None, Field(allow_inf_nan=False, description=KEYS["cos"].about)] = None
    sin: Annotated[float | None, Field(allow_inf_nan=False, description=KEYS["sin"].about)] = None


def _exponent(value: object) -> object:
    """Check the power of a punch."""
    if value == "fit" or (isinstance(value, int | float) and not isinstance(value, bool) and 1.0 <= value < math.inf):
        return float(value) if isinstance(value, int) else value
    raise ValueError(
        f"the power of the punch is a number of 1 or more, and finite (1 is a cone); {example(('profile', 'exponent'))}"
    )


class SpectrumTable(Table):
    """Random self-affine roughness."""

    hurst: Annotated[float, Field(ge=0.0, le=1.0, description=KEYS["hurst"].about)]
    first: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["first"].about)] = 1
    last: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["last"].about)]
    realisations: Annotated[int, Field(ge=1, le=MOST_REALISATIONS, description=KEYS["realisations"].about)] = 1
    seed: Annotated[int, Field(ge=0, lt=2**63, description=KEYS["seed"].about)] = 0


class ProfileTable(Table):
    """The shape of the punch."""

    exponent: Annotated[
        float | Literal["fit"],
        BeforeValidator(_exponent),
        Field(description=KEYS["exponent"].about, json_schema_extra={"minimum": 1.0}),
    ] = 2.0
    harmonics: Annotated[
        Annotated[list[Wave], Field(min_length=1, max_length=MOST_HARMONICS)] | None,
        Field(description=KEYS["harmonics"].about),
    ] = None
    spectrum: Annotated[SpectrumTable | None, Field(description=KEYS["spectrum"].about)] = None
    file: Annotated[str | None, Field(min_length=1, description=KEYS["file"].about)] = None
    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$", description=KEYS["sha256"].about)] = ""
    terms: Annotated[int | None, Field(ge=1, le=MOST_HARMONICS, description=KEYS["terms"].about)] = None
    up_to: Annotated[
        float | None,
        BeforeValidator(lambda value: si_value(value, "up_to")),
        Field(description=KEYS["up_to"].about, json_schema_extra={"type": "string"}),
    ] = None


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
        f"Range_{key.name}", __base__=Range, start=(_of("start", end), ...), stop=(_of("stop", end), ...)
    )
    shapes: Any = Union[  # noqa: UP007 (made at run time)
        Annotated[number, Tag("number")],
        Annotated[list[number], Field(min_length=1), Tag("list")],
        Annotated[range_table, Tag("range")],
    ]
    return _of(key.name, Annotated[shapes, Discriminator(_shape_of)])


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
        fields["points"] = (_of("points", File), None)
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


def _deviation(key: Key) -> Any:
    """Make the type of the deviation of an input."""
    schema = {"type": ["number", "string", "object"]}
    read = BeforeValidator(lambda value: None if value is None else deviation_of(value, key.name))
    about = f"uncertainty of {key.name}: {key.about}"
    return Annotated[Deviation | None, read, WithJsonSchema(schema), Field(description=about)]


def _samples(value: object) -> object:
    """Check the number of samples."""
    if (
        isinstance(value, int)
        and not isinstance(value, bool)
        and (value == 0 or (2 <= value <= MOST_SAMPLES and value & (value - 1) == 0))
    ):
        return value
    raise ValueError(
        f"the number of samples is a power of two up to {MOST_SAMPLES:,}, or 0 for none; "
        f"{example(('uncertainty', 'samples'))}"
    )


def _uncertainty() -> type[Table]:
    """Make the table of uncertain inputs."""
    fields: Any = {
        **{name: (_deviation(key), None) for name, key in INPUTS.items()},
        "samples": (_of("samples", Annotated[int, BeforeValidator(_samples)]), 0),
        "seed": (_of("seed", int, ge=0, lt=2**63), 0),
    }
    return create_model("UncertaintyTable", __base__=Table, **fields)


if TYPE_CHECKING:

    class UncertaintyTable(Table):
        """How far the inputs may be off."""

        samples: int
        seed: int
else:
    UncertaintyTable = _uncertainty()


Limit = Annotated[float, Field(allow_inf_nan=False)]


class RequireTable(Table):
    """What an optimum has to meet."""

    one_disc: Annotated[bool, Field(description=KEYS["one_disc"].about)] = False
    minimum: Annotated[dict[str, Limit], Field(description=KEYS["minimum"].about, default_factory=dict)]
    maximum: Annotated[dict[str, Limit], Field(description=KEYS["maximum"].about, default_factory=dict)]


Goals = Annotated[
    Annotated[str, Tag("name")] | Annotated[list[str], Field(min_length=1), Tag("list")],
    Discriminator(lambda value: "list" if isinstance(value, list) else "name"),
]


class OptimumTable(Table):
    """What is sought."""

    maximise: Annotated[Goals | None, Field(description=KEYS["maximise"].about)] = None
    minimise: Annotated[Goals | None, Field(description=KEYS["minimise"].about)] = None
    over: Annotated[list[str], Field(description=KEYS["over"].about, default_factory=list)]
    resolution: Annotated[int, Field(ge=3, le=MOST_RESOLUTION, description=KEYS["resolution"].about)] = 200
    require: Annotated[RequireTable, Field(description=KEYS["require"].about, default_factory=RequireTable)]

    def goals(self, key: str) -> tuple[str, ...]:
        """Give what is named under one of the two keys."""
        value = getattr(self, key)
        return () if value is None else (value,) if isinstance(value, str) else tuple(value)


class LoadingTable(Table):
    """What drives the punch."""

    control: Annotated[str, Field(description=KEYS["control"].about)] = "displacement"
    machine_stiffness: MachineStiffness = None


class StatesTable(Table):
    """The states whose pressure and surface are drawn."""

    contact_radius_over_R: Annotated[  # noqa: N815 (the key of a study)
        list[Annotated[float, Field(gt=0.0, allow_inf_nan=False)]] | None,
        Field(min_length=1, max_length=MOST_STATES, description=KEYS["contact_radius_over_R"].about),
    ] = None

    @property
    def radii(self) -> tuple[float, ...]:
        """The contact radii that are given."""
        return tuple(self.contact_radius_over_R or ())


class ToughnessWave(Table):
    """One wave of a pattern of toughness."""

    n: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["n"].about)]
    cos: Annotated[float, Field(allow_inf_nan=False, description="cosine of the wave, in units of the amplitude")] = 0.0
    sin: Annotated[float, Field(allow_inf_nan=False, description=KEYS["sin"].about)] = 0.0


class ToughnessTable(Table):
    """A toughness that varies with the radius."""

    harmonics: Annotated[
        list[ToughnessWave],
        Field(min_length=1, max_length=MOST_HARMONICS, description="waves of the series, a sum that is added to 1"),
    ]
    of: Annotated[str, Field(description=KEYS["of"].about)] = "toughness"


class RateTable(Table):
    """An edge whose work grows with its speed."""

    exponent: Annotated[
        float, Field(ge=SLOWEST, le=FASTEST, description="power n of the speed of the edge in its work, 1 + (v/v*)^n")
    ]
    closing: Annotated[str, Field(description=KEYS["closing"].about)] = "quasi-static"


class Form(Table):
    """A whole study, each key for itself."""

    title: Annotated[str, Field(description=KEYS["title"].about)] = ""
    kind: Annotated[str, Field(description=KEYS["kind"].about)] = "map"
    layout: Annotated[str, Field(description=KEYS["layout"].about)] = "grid"
    outputs: Annotated[list[str], Field(min_length=1, description=KEYS["outputs"].about)]
    parameters: Annotated[ParametersTable, Field(description=KEYS["parameters"].about)]
    physical: Annotated[PhysicalTable, Field(description=KEYS["physical"].about, default_factory=PhysicalTable)]
    profile: Annotated[ProfileTable, Field(description=KEYS["profile"].about, default_factory=ProfileTable)]
    loading: Annotated[LoadingTable, Field(description=KEYS["loading"].about, default_factory=LoadingTable)]
    toughness: Annotated[ToughnessTable | None, Field(description=KEYS["toughness"].about)] = None
    rate: Annotated[RateTable | None, Field(description=KEYS["rate"].about)] = None
    states: Annotated[StatesTable, Field(description=KEYS["states"].about, default_factory=StatesTable)]
    optimum: Annotated[OptimumTable | None, Field(description=KEYS["optimum"].about)] = None
    uncertainty: Annotated[
        UncertaintyTable, Field(description=KEYS["uncertainty"].about, default_factory=UncertaintyTable)
    ]
    method: Annotated[MethodTable, Field(description=KEYS["method"].about, default_factory=MethodTable)]

    @cached_property
    def entries(self) -> dict[str, Entry]:
        """What is given for the inputs, in the order of a dataset's dimensions."""
        tables = {"parameters": self.parameters, "physical": self.physical, "loading": self.loading}
        given = {name: getattr(tables[key.table], name, None) for name, key in INPUTS.items()}
        return {name: entry for name, entry in given.items() if entry is not None}
