"""A study of kind "fit", parameters from measured loops: it has no scenes, and its keys have rules of their own."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from gradhesion.cli.study.fit.loops import LoopFile, LoopFileError, fingerprint, is_force_file, read_loops
from gradhesion.cli.study.rules.asked import Asked, Found, home
from gradhesion.cli.study.rules.fit_form import DataTable
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.given import Given, given_by
from gradhesion.cli.study.rules.inputs import inputs, rate, shape_of, together, toughness, waves, works
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.rules.mistakes import line_of, required
from gradhesion.cli.study.text.toml import Source
from gradhesion.cli.tables.columns import changed
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.loops.fitted import OFFSETS, Offsets
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS

ONE_NUMBER: Final = ("E_star", "E", "c0", "nu")
"""What acts on a loop through one number."""
_DEPTHS: Final = ("indentation", "displacement")
"""The columns of depths, of the contact or of a machine."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FitStudy(Given):
    """A valid study of a fit; the power of its law of speed is searched where `free` has it."""

    file: str
    """The file of the loop, or the pattern of several, as the study names them."""
    loops: tuple[LoopFile, ...]
    """The loops, one fit each, sorted by the names of their files."""
    fixed: dict[str, float]
    """What is given as a number, in SI units."""
    free: dict[str, tuple[float, float]]
    """What is searched, with the ends of its range."""
    offsets: Offsets
    average: bool
    given_noise: tuple[float, float] | None
    """Standard deviations of depth and load, in SI units, where the study has them."""
    intervals: str
    starts: int
    adhesion_range: float | None = None
    """The range of the attraction in m, for the Tabor number, where the study has it."""

    @property
    def loop(self) -> LoopFile:
        """The first loop, which is the only one unless the study names several files."""
        return self.loops[0]

    @property
    def is_of_one(self) -> bool:
        """Whether there is one loop, named without a pattern."""
        return len(self.loops) == 1 and self.file == self.loop.file

    def noise_of(self, loop: LoopFile) -> tuple[float, float]:
        """Give the standard deviations of depth and load of one of its loops, in SI units."""
        return self.given_noise or loop.noise

    @property
    def in_words(self) -> str:
        """What is fitted, in numbers of points, cycles and loops."""
        points, cycles = (sum(getattr(loop, name) for loop in self.loops) for name in ("points", "cycles"))
        counts = f"{counted(points, 'point')} in {counted(cycles, 'cycle')}"
        return counts if self.is_of_one else f"{counts} of {counted(len(self.loops), 'loop')}"

    @property
    def parameters(self) -> tuple[str, ...]:
        """What is fitted, in the order of the dataset."""
        return (*self.free, *self.offsets.names)

    @property
    def notes(self) -> tuple[str, ...]:
        """What there is to say of the data before they are fitted."""
        sentences = []
        for loop in self.loops:
            sentences += loop.notes
            if self.given_noise is None and not loop.problem:
                depth, load = (1e9 * one for one in loop.noise)
                words = f"{loop.file}: noise estimated from differences of neighbours: {depth:.3g} nm, {load:.3g} nN"
                sentences.append(f"{words}; give it under [fit] where it is known")
        return tuple(sentences)


def loops_of(folder: Path, form: Form, table: DataTable) -> tuple[LoopFile, ...]:
    """Read the loops that a fit names in its table [data], which is right; LoopFileError says what is wrong."""
    fitted = [name for name, entry in given_in(form).items() if isinstance(entry, Range)]
    fitted += Offsets(**dict(form.fit.offsets)).names
    through_machine = control_of(form) == "machine"
    loops = read_loops(folder, table, fitted, average=form.fit.average, through_machine=through_machine)
    if table.sha256 not in ("", sha256 := fingerprint(loops)):
        raise LoopFileError("file", changed(sha256, table.sha256, "remove sha256"))
    return loops


def fit_of(source: Source, form: Form, loops: tuple[LoopFile, ...]) -> FitStudy:
    """Make the study of a fit from a form that is right, and its loops."""
    noise, given = form.fit.noise, given_in(form)
    free = {name: (entry.start, entry.stop) for name, entry in given.items() if isinstance(entry, Range)}
    fixed = {name: float(entry) for name, entry in given.items() if isinstance(entry, int | float)}
    exponent = fixed.pop("exponent", 0.0) or sum(free.get("exponent", ())) / 2.0
    return FitStudy(
        **given_by(source, form, {("data",): fingerprint(loops)}),
        file=source.data["data"]["file"],
        loops=loops,
        adhesion_range=fixed.pop("adhesion_range", None),
        fixed=fixed,
        free=free,
        offsets=Offsets(**dict(form.fit.offsets)),
        average=form.fit.average,
        given_noise=None if noise is None else (noise.indentation or noise.displacement or 0.0, noise.load),
        intervals=form.fit.intervals,
        starts=form.fit.starts,
        profile=shape_of(form.profile),
        loading=Loading(control=control_of(form)),
        rate=form.rate.made(exponent=exponent) if form.rate else None,
    )


def unit_of_parameter(name: str) -> str:
    """Give the unit in SI of what is fitted."""
    own = dict(zip(OFFSETS, ("m", "N", "N/m"), strict=True), exponent="1")
    return own.get(name) or INPUTS[name].unit


def control_of(form: Form) -> str:
    """Give what is prescribed in the measured cycle: the depth, unless the study or its columns say otherwise."""
    if "control" in form.loading.model_fields_set:
        return str(form.loading.control)
    return "machine" if form.data and form.data.displacement else "displacement"


def given_in(form: Form) -> dict[str, Any]:
    """Give what a fit has for its inputs, a number or a range; the power of the speed is the last."""
    given = {name: entry for name, entry in form.entries.items() if entry != "data"}
    return given | ({"exponent": form.rate.exponent} if form.rate else {})


def broken(asked: Asked) -> Found:
    """List what is wrong between the keys of a fit."""
    for table in ("data", "physical"):
        if table not in asked.data:
            yield table, required(table)
    for name in ("file", "spectrum", "sha256", "terms", "up_to"):
        if asked.has(f"profile.{name}"):
            yield f"profile.{name}", "a loop has one punch; give the harmonics that `gradhesion profile` prints"
    yield from _columns(asked)
    if "physical" in asked.data:
        for rule in (together, inputs, waves, _machine, works, toughness, rate, _searched):
            yield from rule(asked)


def _columns(asked: Asked) -> Found:
    """Check that depths and loads come from one column each."""
    data, noise = asked.form.data, asked.form.fit.noise
    if data is None:
        return
    columns = [name for name in _DEPTHS if asked.has(f"data.{name}")]
    alone = is_force_file(data) and not columns and not asked.has("data.load")
    if not alone and not columns:
        yield "data.indentation", required("data", "indentation")
    if not alone and not asked.has("data.load"):
        yield "data.load", required("data", "load")
    if len(columns) == 2:
        yield "data.displacement", "indentation gives the depths already; remove one of the two"
    if data.leave_out and not asked.has("data.branch") and not alone:
        yield "data.leave_out", f"rows are left out by the words of a column; write {line_of('data', 'branch')}"
    depth = columns[0] if columns else _DEPTHS[control_of(asked.form) == "machine"]
    if noise and (columns or alone) and [name for name in _DEPTHS if getattr(noise, name)] != [depth]:
        yield "fit.noise", f"the data have {depth}; give the noise of {depth} and of load, and of nothing else"


def _machine(asked: Asked) -> Found:
    """Check that what drives the cycle is what the data have, and that a machine has its stiffness."""
    spring, control = "spring_constant", control_of(asked.form)
    columns = [name for name in _DEPTHS if asked.has(f"data.{name}")]
    if asked.has("loading.machine_stiffness"):
        yield "loading.machine_stiffness", "a ratio; give spring_constant under [physical] instead"
    if len(columns) == 2 or not asked.right("loading.control"):
        return
    if "loading" in asked.data and columns == [_DEPTHS[control != "machine"]]:
        yield "loading.control", "a machine, and nothing else, has a column of its displacement; change one of the two"
    elif control == "machine" and not asked.given(spring):
        yield home(spring), f"a machine has a stiffness, or a range of it; write for example {INPUTS[spring].example}"
    elif control != "machine" and asked.given(spring):
        yield home(spring), "a machine has no effect on depths; remove it, or name a column displacement"


def _searched(asked: Asked) -> Found:
    """Check that something is searched, within sensible ends, and that a loop can tell it apart."""
    given = given_in(asked.form)
    for name, entry in given.items():
        at = home(name) if name in INPUTS else f"rate.{name}"
        if isinstance(entry, list):
            yield at, "a fit has no axes: write a number, which is fixed, or a range { start, stop }, which is searched"
        elif not isinstance(entry, Range):
            continue
        elif {*asked.at(at)} != {"start", "stop"}:
            yield at, "a searched range has start and stop, and nothing else; remove the other keys"
        elif name == "adhesion_range":
            yield at, f"no loop depends on it; give it as a number, {INPUTS[name].example}"
        elif entry.start >= entry.stop:
            yield at, "the stop of a searched range is above its start; exchange the two, or give a number"
        elif entry.start <= 0.0 and not (name == "exponent" or INPUTS[name].is_linear):
            yield at, "it is searched on a logarithmic scale; begin the range above 0"
    free = [name for name, entry in given.items() if isinstance(entry, Range)]
    if not free and asked.right("parameters", "physical"):
        yield "physical", 'nothing is fitted; write for example E_star = { start = "0.1 GPa", stop = "10 GPa" }'
    for name in [name for name in free if name in ONE_NUMBER][1:]:
        yield home(name), "a loop depends on E_star, c0 and nu through one number; give all but one of them as numbers"
    sizes = ["R", next((name for name in free if name in ONE_NUMBER), "E_star"), "work_of_adhesion"]
    endless = np.all(np.isinf(asked.values.get("a_max", math.inf)))
    if {*sizes} <= {*free} and endless and not (asked.waved or asked.form.toughness or asked.form.rate):
        words = "the loop of a smooth punch, which has no length of its own, does not tell"
        yield home("R"), f"{words} {sizes[0]}, {sizes[1]} and {sizes[2]} apart; give one of them as a number"
    if {"speed", "reference_speed"} <= {*free}:
        yield home("reference_speed"), "a loop depends on the ratio of the two speeds; give one of them as a number"
