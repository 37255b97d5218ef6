"""A study: what is asked for, as it is read from TOML or made in Python."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names import outputs as names
from gradhesion.cli.names.outputs import PARAMETER, PHYSICAL_PARAMETER, SI, UNITS, labels_of
from gradhesion.cli.names.scenes import REALISATION, SCENE, SOLVER
from gradhesion.cli.study.files import FromFile
from gradhesion.cli.study.rules.asked import Values
from gradhesion.cli.study.rules.form import Optimum, Uncertainty
from gradhesion.cli.study.rules.given import Given
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.tiling import Block, Tiling, cells_of_chunk
from gradhesion.core.answers.spectrum import Spectrum, random_profile
from gradhesion.core.closed.reach import depends_on_contact
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import CLOSING, MACHINE, PARAMETERS, PATTERN, RANGE, SENSITIVITIES, TURNS
from gradhesion.core.problem.profile import Profile

FEW_SAMPLES: Final = 32
"""Samples of each scene that check a linear standard deviation."""


@dataclass(frozen=True, kw_only=True)
class Method:
    """How the scenes are solved."""

    solver: str | tuple[str, ...] = "exact"
    """One solver, or several that stand side by side in the dataset."""
    check_contact: bool = True
    """Whether `status` shall report where loading does not keep the contact one disc."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Study(Given):
    """A valid study of scenes, its parameters expanded: a float is fixed, an array is an axis, or in points a list."""

    layout: str
    outputs: tuple[str, ...]
    """What is asked for beside `status`, in the order of the dataset."""
    parameters: Mapping[str, Values]
    """A value for each parameter, under the key that gives it, in the order of the dataset's dimensions."""
    method: Method
    search: Optimum = field(default_factory=Optimum)
    searched: Mapping[str, Range] = field(default_factory=dict)
    """The inputs that are searched for it, which are no parameters of the study."""
    uncertainty: Uncertainty = field(default_factory=Uncertainty)
    states: tuple[float, ...] = ()
    """The contact radii a/R whose pressure and surface are drawn; empty: the named states of the cycle."""
    left_out: frozenset[str] = frozenset()
    """The parameters that it does not give since they have no effect; they have a value all the same."""
    chunk: int = field(default_factory=cells_of_chunk)
    """Cells of a chunk of the dataset of a map, at most; a block that is computed at a time has two."""
    points: FromFile = field(default_factory=FromFile)
    """The file with its scenes, and the parameters that are columns of it."""
    measured: FromFile = field(default_factory=FromFile)
    """The file with the heights of its punch, and the fit of them."""
    spectrum: Spectrum | None = None
    """Of random roughness: `profile` is its first realisation."""

    @property
    def in_si(self) -> tuple[str, ...]:
        """The outputs that its dataset has in SI units as well: those that have a unit, if the study has units."""
        return tuple(name for name in self.outputs if name in UNITS) if "R" in self.parameters else ()

    @property
    def linear(self) -> tuple[str, ...]:
        """The outputs whose standard deviation follows from sensitivities."""
        known = self.uncertainty and self.knows_slopes
        return tuple(name for name in self.outputs if name in names.OF_LINEAR) if known else ()

    @property
    def spreads(self) -> tuple[str, ...]:
        """The variables with the spread of its outputs, those in SI units last."""
        own = tuple(f"{name}_std" for name in self.linear)
        if self.uncertainty.samples and self.uncertainty:
            ways = ((name, way) for name in self.outputs if name in names.SPREADABLE for way in names.SPREAD)
            own = tuple(f"{name}_{way}" for name, way in ways if way != "std_linear" or name in self.linear)
        return (*own, *(name + SI for name in own if name in UNITS and "R" in self.parameters))

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """The names of all variables of its dataset except `status`."""
        if search := self.search:
            in_si = [name + SI for name in search.reported if name in UNITS and "R" in self.given]
            slopes = [search.slope] if self.has_slopes else []
            whole = [*search.reported, *in_si, *self.searched, *slopes]
            return (*(names.BEST + name for name in whole), *(() if search.is_front else (names.ON_BOUND,)))
        united = self.outputs if "R" in self.parameters else ()
        physical = [name + names.OF_PHYSICAL for name in united if name in SENSITIVITIES]
        return (*self.outputs, *(name + SI for name in self.in_si), *physical, *self.spreads)

    @property
    def has_slopes(self) -> bool:
        """Whether the exact slopes of what is sought are known."""
        return bool(self.search.slope) and self.knows_slopes

    @property
    def knows_slopes(self) -> bool:
        """Whether there are sensitivities."""
        return self.method.solver == "exact" and self.rate is None

    @property
    def given(self) -> tuple[str, ...]:
        """The names of its parameters, and of the inputs that are searched."""
        return (*self.parameters, *self.searched)

    @property
    def solved(self) -> tuple[str, ...]:
        """The outputs that its scenes are solved for."""
        if self.search:
            return (*self.search.solved, *((self.search.slope,) if self.has_slopes else ()))
        return (*self.outputs, *(f"{name}_sensitivity" for name in self.linear))

    @property
    def has_answers(self) -> bool:
        """Whether `status` has flags beside those of a scene."""
        return bool(self.uncertainty or self.search)

    @property
    def follows_waves(self) -> bool:
        """Whether its waves are followed one by one, so that there may be too many of them."""
        return self.toughness is not None or self.rate is not None

    @property
    def status_type(self) -> str:
        """The type of `status`: as many bits as its flags need."""
        return "i2" if self.has_answers or self.turn == TURNS[0] or self.follows_waves else "i1"

    @property
    def watches_slope(self) -> bool:
        """Whether a contact may reach radii at which the punch is no longer shallow (core/closed/reach.py)."""
        if {"a_max", "R"} <= self.parameters.keys():
            return self.may_reach(np.max(self.parameters["a_max"]) / np.min(self.parameters["R"]))
        return self.kind != "curve" and self.may_reach(self.parameters.get("a_max_over_R", math.inf))

    def may_reach(self, rims: Values) -> bool:
        """Report whether a contact within one of these rims a_max/R may be steep, and anything depends on it."""
        return not self.is_cone and bool(np.max(rims) > 1.0) and depends_on_contact(self.solved)

    @property
    def is_cone(self) -> bool:
        """Whether its punch is a cone, whose slope is 1 at every radius."""
        return self.profile.exponent == 1.0

    @cached_property
    def labels(self) -> dict[str, tuple[str, ...]]:
        """What its sensitivities are to, by the dimension along which they stand; nothing if it has none."""
        requested = {labels_of(name) for name in self.variables} - {""}
        more = [MACHINE] if self.loading.control == "machine" else []
        more += [self.turn] if self.turn else []
        more += [name for name in (CLOSING, *PATTERN) if any(INPUTS[one].gives == name for one in self.given)]
        united = [name for name in self.parameters if INPUTS[name].table == "physical" and INPUTS[name].gives != RANGE]
        units = [name for name in united if not np.all(np.isinf(self.parameters[name]))]
        found = {PARAMETER: (*PARAMETERS, *more), PHYSICAL_PARAMETER: tuple(units)}
        return {name: own for name, own in found.items() if name in requested}

    @cached_property
    def made(self) -> tuple[str, ...]:
        """The parameters that are not given, but follow from what is."""
        wanted = {INPUTS[name].gives for name in self.parameters} - self.parameters.keys()
        made = tuple(name for name in INPUTS if name in wanted)
        if not self.search:
            return made
        from gradhesion.core.closed.reduced import sources_of  # noqa: PLC0415 (300 ms for SciPy)

        given = dict.fromkeys(self.given)
        return tuple(name for name in made if not {*self.searched} & {*sources_of(name, given)})

    @property
    def turn(self) -> str:
        """The parameter at which its cycles turn before the rim; empty if they turn there."""
        return next((INPUTS[name].gives for name in self.given if INPUTS[name].gives in TURNS), "")

    @cached_property
    def sizes(self) -> dict[str, int]:
        """The dimensions of its dataset, with their lengths: that of several solvers, its axes, and realisations."""
        solvers = self.method.solver
        several = {} if isinstance(solvers, str) else {SOLVER: len(solvers)}
        return several | self.axes | ({} if self.spectrum is None else {REALISATION: self.spectrum.realisations})

    @cached_property
    def axes(self) -> dict[str, int]:
        """The dimensions along which its parameters vary, with their lengths."""
        axes = {name: values.size for name, values in self.parameters.items() if isinstance(values, np.ndarray)}
        return {SCENE: next(iter(axes.values()), 1)} if self.layout == "points" else axes

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of its dimensions."""
        return tuple(self.sizes.values())

    @property
    def scenes(self) -> int:
        """The number of its scenes."""
        return math.prod(self.shape)

    @property
    def in_blocks(self) -> bool:
        """Whether it is computed in blocks, and finished ones are kept, so that a run resumes where it stopped."""
        return self.kind in ("map", "optimum") and not self.search.is_front

    @property
    def has_parts(self) -> bool:
        """Whether finished blocks are kept: one block is done or not."""
        return self.in_blocks and len(self.tiling) > 1

    @cached_property
    def tiling(self) -> Tiling:
        """The blocks of its scenes; of curves, each of which has chunks of its own, a block is one scene."""
        return Tiling(self.shape, 1, 1) if self.kind == "curve" else Tiling(self.shape, self.cells)

    @property
    def cells(self) -> int:
        """Cells of a chunk of the dataset, at most: fewer where each of them takes many scenes."""
        return max(1, self.chunk // self.solutions)

    @property
    def solutions(self) -> int:
        """How often each scene is solved, about: itself, with samples of its inputs, or beside them."""
        if self.search:
            return int((2 * self.search.resolution - 1) ** len(self.searched))
        return 1 + (self.uncertainty.samples or FEW_SAMPLES) if self.uncertainty else 1

    def shape_of(self, name: str, scenes: tuple[int, ...]) -> tuple[int, ...]:
        """Give the lengths of a variable of a map for scenes of a shape: sensitivities have one dimension more."""
        own = labels_of(name)
        return (*scenes, len(self.labels[own])) if own else scenes

    def apart(self, block: Block) -> tuple[Block, Block, tuple[Profile, ...]]:
        """Take a block apart: along the solvers, along the axes, and the profiles of its punches."""
        first = len(block) - len(self.axes) - (self.spectrum is not None)
        solvers, axes = block[:first], block[first : first + len(self.axes)]
        if self.spectrum is None:
            return solvers, axes, (self.profile,)
        numbers = range(block[-1].start, block[-1].stop)
        return solvers, axes, tuple(random_profile(self.spectrum, n, self.profile.exponent) for n in numbers)

    def parameters_of(self, block: Block) -> dict[str, NDArray[np.float64]]:
        """Cut a block out of the axes: the parameters as arrays that broadcast to the block's shape."""
        axes, cut = [*self.axes], {}
        for name, values in self.parameters.items():
            if isinstance(values, float):
                cut[name] = np.full((1,) * len(axes), values)
            elif self.layout == "points":
                cut[name] = values[block[0]]
            else:
                axis = axes.index(name)
                cut[name] = values[block[axis]].reshape([-1 if i == axis else 1 for i in range(len(axes))])
        return cut
