"""The form of a study: which keys there are, and which values each of them takes.

pydantic checks the form of the whole study at once and gives its JSON Schema; a valid form is what a `Study` is made
from. Its findings become sentences in `mistakes.py`. What two keys have to do with each other is in `cli/study/rules`.
"""

from functools import cached_property
from typing import Annotated, Final

from pydantic import Discriminator, Field, Tag

from gradhesion.cli.keys import INPUTS, KEYS
from gradhesion.cli.study.form.edge import RateTable, ToughnessTable
from gradhesion.cli.study.form.inputs import Entry, MachineStiffness, ParametersTable, PhysicalTable
from gradhesion.cli.study.form.optimum import OptimumTable
from gradhesion.cli.study.form.profile import ProfileTable
from gradhesion.cli.study.form.table import Table
from gradhesion.cli.study.form.uncertainty import UncertaintyTable

MOST_STATES: Final = 100
"""States of one study: their curves are for looking at."""


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
