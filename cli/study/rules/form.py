"""The form of a study: which keys there are, and which values each of them takes.

The tables of inputs are made from `INPUTS`, those of the punch and of what its edge meets from the classes of the core;
pydantic checks the whole study at once and gives its JSON Schema. Its findings become sentences in mistakes.py; what
keys have to do with each other is in the other modules.
"""

from dataclasses import fields
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, Field, WithJsonSchema, create_model

from gradhesion.cli.names.outputs import OF_LINEAR, SI
from gradhesion.cli.study.rules.fit_form import DataTable, FitTable
from gradhesion.cli.study.rules.keys import (
    Deviation,
    File,
    Finite,
    Range,
    Table,
    deviation_key,
    input_key,
    quantity,
    range_of,
    said,
    table_of,
    tagged,
)
from gradhesion.cli.study.text.quantities import QUANTITIES
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
Entry = float | list[float] | Range | NDArray[np.float64] | Literal["data"]
"""What a study gives for an input: a number, a list, a range, or a column of a file; quantities in SI units."""

if TYPE_CHECKING:  # made when this is run, which the types cannot show
    Words = list[str]
    Parameters = Any
    Physical = Any
    Deviations = Any
    Shape = Any
    SpectrumTable = Any
    ToughnessTable = Any
    LoadingTable = Any
    RateTable = Any
else:
    Words = Annotated[
        tagged(plain=str, list=Annotated[list[str], Field(min_length=1)]),
        AfterValidator(lambda value: [value] if isinstance(value, str) else value),
    ]
    _power = Annotated[Finite, Field(ge=EXPONENTS[0], le=EXPONENTS[1])]
    _powers = Annotated[
        tagged(plain=_power, table=range_of(Input("exponent", "", "", "0.3"), _power, is_axis=False)),
        WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "object"}], "minimum": 0.1, "maximum": 2.0}),
    ]
    _points = (
        tagged(plain=Annotated[str, Field(min_length=1)], table=File),
        said("scenes from a file (CSV or NetCDF): one row per scene, one column per parameter", '"samples.csv"', None),
    )
    _parameters, _physical = (
        {one.name: input_key(one) for one in INPUTS.values() if one.table == name}
        for name in ("parameters", "physical")
    )
    Parameters = create_model("Parameters", __base__=Table, **_parameters, points=_points)
    Physical = create_model("Physical", __base__=Table, **_physical)
    Deviations = create_model("Deviations", __base__=Table, **{one.name: deviation_key(one) for one in INPUTS.values()})
    Shape, SpectrumTable, ToughnessTable = table_of(Profile), table_of(Spectrum), table_of(Toughness)
    LoadingTable = table_of(Loading, machine_stiffness=input_key(INPUTS["machine_stiffness"]))
    RateTable = table_of(Rate, exponent=(_powers, said(fields(Rate)[0].metadata["about"], "0.6")))


def _power_of_two(value: int) -> int:
    """Check the number of samples."""
    if value in (0, *(2**n for n in range(1, 21))):
        return value
    raise ValueError(f"the number of samples is a power of two up to {2**20:,}, or 0; write for example samples = 1024")


class Uncertainty(Deviations):  # type: ignore[misc]
    """How far the inputs may be off."""

    samples: Annotated[int, AfterValidator(_power_of_two)] = said(
        "number of quasi-random samples, a power of two; 0: standard deviations by sensitivities only", "1024", 0
    )
    seed: int = said("seed of the random numbers", "1", 0, ge=0, lt=2**63)

    def __bool__(self) -> bool:
        """Report whether anything is uncertain."""
        return bool(self.deviations)

    @property
    def deviations(self) -> dict[str, Deviation]:
        """The uncertain inputs, in the order of a dataset's dimensions."""
        return {name: one for name in INPUTS if (one := getattr(self, name)) is not None}


class ProfileTable(Shape):  # type: ignore[misc]
    """The shape of the punch: that of a series, of random waves or of heights in a file."""

    exponent: Annotated[Finite, Field(ge=1.0)] | Literal["fit"] = said(
        fields(Profile)[0].metadata["about"], "2.0", 2.0, json_schema_extra={"minimum": 1.0}
    )
    spectrum: SpectrumTable | None = said(
        "random self-affine waves for harmonics; A is their rms height over lambda", "{ hurst = 0.8, last = 32 }", None
    )
    file: str | None = said(File.model_fields["file"].description, '"tip.csv"', None, min_length=1)
    sha256: str = said(File.model_fields["sha256"].description, '"0a1b..."', "", pattern="^[0-9a-f]{64}$")
    terms: int | None = said("number of harmonics to fit to the file [16]", "16", None, ge=1, le=MOST_HARMONICS)
    up_to: quantity("up_to") | None = said(QUANTITIES["up_to"].about, QUANTITIES["up_to"].value, None)  # type: ignore[valid-type]


class States(Table):
    """The states whose pressure and surface are drawn."""

    contact_radius_over_R: list[Annotated[Finite, Field(gt=0.0)]] | None = said(  # noqa: N815 (the key of a study)
        "contact radii a/R [turning point, pull-off and jump-out]", "[0.1, 0.2]", None, min_length=1, max_length=100
    )


class Method(Table):
    """How the scenes are solved."""

    solver: Words = said(
        "exact, or an approximation for short waves; a list compares several", '"exact"', "exact", validate_default=True
    )
    check_contact: bool = said(
        "whether `status` reports contact that is not one disc on loading", "false", default=True
    )


class Require(Table):
    """What an optimum has to meet."""

    one_disc: bool = said("whether contact on loading must be one disc", "true", default=False)
    minimum: dict[str, Finite] = said(
        "minimum values of other outputs, which end in _si if they are in SI units", "{ dissipated_energy = 0.1 }", {}
    )
    maximum: dict[str, Finite] = said("maximum values of other outputs", "{ pull_off_radius = 0.2 }", {})


class Optimum(Table):
    """What is sought."""

    maximise: Words = said("output to maximise; two outputs: their Pareto front", '"pull_off_force"', [])
    minimise: Words = said("output to minimise, instead or as a second goal", '"dissipated_energy"', [])
    over: list[str] = said("inputs to search between bounds: { start, stop } without num", '["lambda_over_R"]', [])
    resolution: int = said(
        "points of the sweep along each input; it may miss narrower peaks", "200", 200, ge=3, le=10**6
    )
    require: Require = said(
        "conditions that an optimum must meet", "{ one_disc = true, minimum = { dissipated_energy = 0.1 } }", Require()
    )

    def __bool__(self) -> bool:
        """Report whether anything is sought."""
        return bool(self.goals)

    @property
    def goals(self) -> list[str]:
        """One output, or two whose best compromises are sought; those in SI units end so."""
        return [*self.maximise, *self.minimise]

    @property
    def signs(self) -> list[int]:
        """1 where a goal is to be as large as possible, -1 where as small."""
        return [1] * len(self.maximise) + [-1] * len(self.minimise)

    @property
    def is_front(self) -> bool:
        """Whether the best compromises of two goals are sought."""
        return len(self.goals) > 1

    @property
    def reported(self) -> tuple[str, ...]:
        """The outputs that are reported of an optimum: the goals, and what is limited."""
        names = (*self.goals, *self.require.minimum, *self.require.maximum)
        return tuple(dict.fromkeys(name.removesuffix(SI) for name in names))

    @property
    def solved(self) -> tuple[str, ...]:
        """The outputs that are solved for on the way; `delta_max` follows the loading path, where nothing else does."""
        return (*self.reported, *(("delta_max",) if self.require.one_disc else ()))

    @property
    def slope(self) -> str:
        """The sensitivity that belongs to the goal; empty if it has none, or there are two."""
        plain = self.goals[0].removesuffix(SI) if len(self.goals) == 1 else ""
        return f"{plain}_sensitivity" if plain in OF_LINEAR else ""


def _one_line(title: str) -> str:
    """Check a title."""
    if not title.isprintable():
        raise ValueError("a title is one line of printable characters; remove the others")
    return title


class Form(Table):
    """A whole study, each key for itself."""

    include: str = said(
        "path of a study from the folder of this one; its keys hold where this one has none", '"base.toml"', ""
    )
    title: Annotated[str, AfterValidator(_one_line)] = said(
        "title of the dataset [name of the file]", '"Pull-off force against wavelength"', ""
    )
    kind: Kind = said("one value per scene, curves of each scene, optima, or a fit of measured loops", '"map"', "map")
    layout: Literal["grid", "points"] = said(
        "every combination of the axes is a scene, or the lists are combined item by item", '"grid"', "grid"
    )
    outputs: list[str] = said(
        "quantities to compute, required for maps and curves", '["pull_off_force", "delta_max"]', [], min_length=1
    )
    parameters: Parameters = said("the parameters of a scene, each a number or an axis", "{ k = 0.5, nu = 0.3, .. }")
    physical: Physical | None = said("quantities with units instead of ratios", '{ R = "1 mm", .. }', None)
    profile: ProfileTable = said("the shape of the punch: a power and waves", "{ exponent = 2.0 }", ProfileTable())
    loading: LoadingTable = said("control of the punch", '{ control = "load" }', LoadingTable())
    toughness: ToughnessTable | None = said(
        "a toughness that varies with the radius: a series of waves", "{ harmonics = [{ n = 1, cos = 0.2 }] }", None
    )
    rate: RateTable | None = said(
        "a work of adhesion that grows with the speed of the edge", "{ exponent = 0.6 }", None
    )
    states: States = said(
        'states for pressure and surface, for kind = "curve"', "{ contact_radius_over_R = [0.1, 0.2] }", States()
    )
    optimum: Optimum | None = said(
        'goal and searched inputs, for kind = "optimum"', '{ maximise = "pull_off_force", over = ["A"] }', None
    )
    uncertainty: Uncertainty | None = said(
        "uncertainties of inputs, for deviations of outputs and, with samples, quantiles", '{ modulus = "5 %" }', None
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
