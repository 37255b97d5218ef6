"""What the keys of a study have to do with each other: for each rule where it is broken, and what to write instead."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import OF_LINEAR, SI, SPREADABLE
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.form import KINDS, OUTPUTS_OF, Entry, Range, list_of
from gradhesion.cli.study.mistakes import Checked, example, line_of
from gradhesion.cli.terminal.wording import did_you_mean, nearest, shown
from gradhesion.core.problem.control import CONTROLS
from gradhesion.core.problem.inputs import INPUTS, REDUCED, Input
from gradhesion.core.problem.names import GIVEN_UP, SENSITIVITIES, SOLVERS, WITHOUT_LOAD
from gradhesion.core.problem.outputs import CURVES, OUTPUTS
from gradhesion.core.problem.profile import MOST_HARMONICS, Profile
from gradhesion.core.problem.rate import MOST_WAVES
from gradhesion.core.problem.toughness import violation

Values = float | NDArray[np.float64]
"""The values of a parameter: a float is fixed, an array is an axis."""
Found = Iterator[tuple[str, str]]
"""Dotted keys, and what is wrong with each."""

MOST_VALUES: Final = 10_000_000
"""Values of one axis: it is held in memory, and so are its kin."""
DIGITS: Final = 12
"""Significant digits of the decimals that the values of a range are moved to, where these are within rounding."""
MOST_SCENES: Final = {"map": 2**31, "curve": 1_000, "optimum": 2**31, "pareto": 100_000}
"""Scenes of one study: beyond, a dataset is no longer one file; curves are for looking at; fronts are in memory."""
MOST_SEARCHED: Final = 3
"""Inputs that are searched at once: a sweep has a power of the resolution."""
MOST_POINTS: Final = 2**24
"""Points of the sweep of one cell: all are in memory."""
_MOST_AMPLITUDES: Final = 1000
"""Different amplitudes of points up to which each is looked at."""
MAY_MIX: Final = ("A", "closing_ratio", "machine_stiffness")
"""The ratios that may stand beside quantities with units."""


@dataclass(frozen=True, kw_only=True)
class Asked:
    """A study whose keys are right, or left out; its inputs expanded."""

    checked: Checked
    values: Mapping[str, Values]
    """Of the inputs that are right, those that are searched among them."""
    over: tuple[str, ...] = ()
    """The inputs that are searched."""
    written: Mapping[str, Any]
    """The study as it is written, before anything stood in the place of files and of what is searched."""

    @property
    def form(self) -> Any:
        """The form of what is right."""
        return self.checked.form

    @cached_property
    def kind(self) -> str:
        """The kind that is meant."""
        kind = self.checked.data.get("kind", "map")
        return (isinstance(kind, str) and nearest(kind, KINDS)) or "map"

    @property
    def points(self) -> bool:
        """Whether lists are combined item by item."""
        return nearest(str(self.checked.data.get("layout", "grid")), ("grid", "points")) == "points"

    @property
    def units(self) -> bool:
        """Whether there is a table [physical], right or wrong."""
        return isinstance(self.checked.data.get("physical"), Mapping)

    @property
    def axes(self) -> dict[str, Values]:
        """The values of the inputs that are not searched."""
        return {name: values for name, values in self.values.items() if name not in self.over}

    def given(self, name: str) -> bool:
        """Report whether an input is there, right or wrong."""
        return self.checked.has(INPUTS[name].table, name)

    def meant(self, name: str) -> bool:
        """Report whether an input is there, perhaps misspelt or in the wrong table."""
        return self.given(name) or (INPUTS[name].table, name) in self.checked.meant

    def sound(self, table: str) -> bool:
        """Report whether a table is there, and right as a whole."""
        return table in self.checked.data and not any(path[0] == table for path in self.checked.wrong)

    @property
    def turns(self) -> list[str]:
        """What gives where cycles turn before the rim."""
        return [name for name, own in INPUTS.items() if own.group == "turn" and self.given(name)]

    @property
    def rims(self) -> Values:
        """The radii of the punch, in whatever they are given; inf where they are not."""
        return next((values for name, values in self.values.items() if INPUTS[name].gives == "a_max_over_R"), math.inf)

    @property
    def ends(self) -> bool:
        """Whether every cycle turns somewhere."""
        return bool(self.turns) or bool(np.all(np.isfinite(self.rims)))

    @property
    def turn(self) -> str:
        """The key that would turn it at a depth."""
        return "indentation_max" if self.units else "indentation_max_over_R"


def home(name: str) -> str:
    """Write an input with its table."""
    return f"{INPUTS[name].table}.{name}"


def expanded(entry: Entry) -> Values:
    """
    Expand a valid input of a study; a range begins and ends at exactly its `start` and `stop`.

    >>> expanded(0.3)
    0.3
    >>> expanded(Range(start=0.01, stop=1.0, num=3, spacing="log"))
    array([0.01, 0.1 , 1.  ])
    """
    if isinstance(entry, Range):
        space = np.geomspace if entry.spacing == "log" else np.linspace
        low, high = sorted((entry.start, entry.stop))
        values = space(entry.start, entry.stop, entry.num)
        values = _shortest(values, np.abs(values) if entry.spacing == "log" else max(abs(entry.start), abs(entry.stop)))
        values = np.clip(values, low, high)
        values[0], values[-1] = entry.start, entry.stop
        return values + 0.0  # no negative zeros
    if isinstance(entry, list):
        return np.array(entry, dtype=np.float64) + 0.0
    return float(entry) + 0.0


def _shortest(values: NDArray[np.float64], size: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """
    Move values to decimals of a few digits that are within the rounding of a range of this `size`.

    So that a value can be selected by what one would write: 0.69 and not 0.6900000000000001.

    >>> float(_shortest(np.array([0.6900000000000001]), 1.0)[0])
    0.69
    """
    with np.errstate(all="ignore"):
        places = np.clip(DIGITS - 1 - np.floor(np.log10(size)), -22, 22)
        power = 10.0 ** np.abs(places)  # exact to 10^22
        decimals = np.where(places >= 0, np.rint(values * power) / power, np.rint(values / power) * power)
        near = np.abs(decimals - values) <= 4 * np.finfo(float).eps * size  # of a few roundings in making the range
    moved = np.where(near & np.isfinite(decimals), decimals, values)
    return moved if np.unique(moved).size == np.unique(values).size else values


def broken(asked: Asked) -> Found:
    """List what is wrong between the keys of a study of scenes."""
    for rule in (_kinds, _outputs, _method, _axes, _search, inputs, _punch, works, toughness, rate, _states, _range,
                 _uncertain, _size):  # fmt: skip
        yield from rule(asked)


def range_mistakes(name: str, entry: Entry, *, searched: bool) -> Found:
    """Check that a range makes sense as a whole, and that an axis can be held in memory."""
    at = home(name)
    if isinstance(entry, list) and len(entry) > MOST_VALUES:
        yield at, f"more than {MOST_VALUES:,} values in one list; split the study"
    if not isinstance(entry, Range):
        return
    start, stop = entry.start, entry.stop
    if entry.num > MOST_VALUES:
        yield f"{at}.num", f"more than {MOST_VALUES:,} values in one axis; split the study"
    elif entry.num == 1 and start != stop:
        yield f"{at}.num", "one value cannot be at both start and stop; use num = 2 or more, or a list of one value"
    elif entry.num > 1 and start == stop and not searched:
        yield at, f"start and stop are the same, so that the value repeats; write [{start:g}] or another stop"
    elif entry.spacing == "log" and min(start, stop) <= 0.0:
        end = "start" if start <= 0.0 else "stop"
        yield f"{at}.{end}", 'log spacing needs values > 0; raise it, or use spacing = "linear"'


def repeated(name: str, values: Values) -> Found:
    """Check that an axis has no value twice."""
    if isinstance(values, np.ndarray):
        unique, counts = np.unique(values, return_counts=True)
        if np.any(counts > 1):
            value = float(unique[np.argmax(counts > 1)])
            first, second = np.flatnonzero(values == value)[:2].tolist()
            unit = "" if INPUTS[name].unit == "1" else f" {INPUTS[name].unit}"
            yield home(name), f"the axis repeats the value {value!r}{unit} (items {first} and {second}); remove one"


def _axes(asked: Asked) -> Found:
    """Check the axes of a grid, or the lists of points: no value twice, one length; no material without stiffness."""
    stiff = "use nu = 0.5, or k below 1"
    if not asked.points:
        for name, values in asked.values.items():
            yield from repeated(name, values)
        others = [nu for nu in np.atleast_1d(asked.values.get("nu", 0.5)).tolist() if nu != 0.5]
        if others and np.any(asked.values.get("k", 0.0) == 1.0):
            yield "parameters.k", f"with k = 1 and nu = {others[0]} the surface has no stiffness; {stiff}"
        return
    lengths = {name: values.size for name, values in asked.axes.items() if isinstance(values, np.ndarray)}
    first = next(iter(lengths), "")
    for name, length in lengths.items():
        if length != lengths[first]:
            words = f'it has {length} values, but {first} has {lengths[first]}; with layout = "points" all lists have '
            yield home(name), words + "one length (a single number applies to all scenes)"
    if len({lengths[name] for name in ("k", "nu") if name in lengths}) <= 1:
        k, nu = np.broadcast_arrays(*(np.atleast_1d(asked.axes.get(name, 0.5)) for name in ("k", "nu")))
        scenes = np.flatnonzero((k == 1.0) & (nu != 0.5))
        if scenes.size:
            where = f"in scene {scenes[0]}" + (f" (and {scenes.size - 1} more)" if scenes.size > 1 else "")
            words = (
                f"with k = 1 and nu = {nu[scenes[0]]} {where}, counted from 0, the surface has no stiffness; {stiff}"
            )
            yield "parameters.k", words


def _kinds(asked: Asked) -> Found:
    """Check the title."""
    if not asked.form.title.isprintable():
        yield "title", "a title is one line of printable characters; remove the others"


def _curve_of(name: str) -> str:
    """Name the curve that an output is, or is a variable of; empty for another."""
    return next((curve for curve, own in CURVES.items() if name == curve or name in own.names), "")


def _outputs(asked: Asked) -> Found:
    """Check that each output belongs to the kind of the study, and is asked for once."""
    names: Any = asked.checked.data.get("outputs")
    known = OUTPUTS_OF.get(asked.kind)
    if not isinstance(names, list) or known is None:
        return
    other = "map" if asked.kind == "curve" else "curve"
    for i, name in enumerate(names):
        at = f"outputs[{i}]"
        if not isinstance(name, str):
            continue
        curve = _curve_of(name)
        if name in known and name in names[:i]:
            yield at, "this output is listed twice; remove one of the two"
        elif name in known and curve in names and curve != name:
            yield at, f'a variable of "{curve}", which is listed as a whole; remove one of the two'
        elif name not in known and name in OUTPUTS_OF[other]:
            words = f'an output of studies of kind "{other}", and this one is of kind "{asked.kind}"; '
            yield at, words + f'{did_you_mean(name, known)}, or write kind = "{other}"'
        elif name in GIVEN_UP and name not in known:
            yield at, f"this output is given up, remove it: {GIVEN_UP[name]}"
        elif name not in known:
            yield at, f"not an output; {did_you_mean(name, known)}"


def _method(asked: Asked) -> Found:
    """Check that each solver is known, named once and has all outputs, and that a study of curves has no method."""
    method = asked.form.method
    if asked.kind == "curve":
        if method.solver != "exact":
            words = "a curve study has no solver, since its outputs select the curves; remove this key"
            yield "method.solver", words + ', and add "asymptotic", "envelope" or "effective" to outputs'
        if not method.check_contact:
            yield "method.check_contact", "the path of a curve study is always checked; remove this key"
        return
    for i, one in enumerate(method.solvers):
        at = "method.solver" if isinstance(method.solver, str) else f"method.solver[{i}]"
        if one not in SOLVERS:
            yield at, f"not a solver; {did_you_mean(one, SOLVERS)}"
        elif one in method.solvers[:i]:
            yield at, "this solver is listed twice; remove one of the two"
    other = next((one for one in method.solvers if one in SOLVERS and one != "exact"), None)
    if other is None:
        return
    for i, name in enumerate(asked.form.outputs):
        if name in OUTPUTS and OUTPUTS[name].exact_alone:
            yield f"outputs[{i}]", f'the solver "{other}" has no such output; remove it, or write solver = "exact"'
    cannot = [f"[{table}]" for table in ("toughness", "rate") if asked.sound(table)] + asked.turns[:1]
    for what in cannot:
        yield "method.solver", f'the solver "{other}" does not support {what}; write solver = "exact", or remove {what}'
    if asked.form.loading.control != "displacement":
        words = f'the solver "{other}" is available only under displacement control: {WITHOUT_LOAD[other]}; '
        yield "method.solver", words + 'write solver = "exact", or remove [loading]'


def inputs(asked: Asked) -> Found:
    """Check that each parameter is given once, in the units of the others, and is given where every scene has it."""
    if "parameters" not in asked.checked.data:
        return
    for name, own in INPUTS.items():
        if own.is_parameter and name not in ("k", "nu"):
            yield from _ways(asked, own)
    turns = asked.turns
    for name in turns[1:]:
        yield home(name), f"a cycle turns at one depth or load, and {turns[0]} gives it already; remove one of the two"


def _ways(asked: Asked, own: Input) -> Found:
    """Check the inputs that give one parameter."""
    others = [one for one in INPUTS.values() if one.gives == own.name and one is not own]
    physical = [one.name for one in others if one.table == "physical"]
    idle = own.group in ("toughness", "rate") and own.group not in asked.checked.data
    apart = asked.units and own.name not in MAY_MIX and bool(physical) and not idle
    if apart and asked.given(own.name):
        words = "a ratio, where [physical] gives quantities with units, and the two cannot be combined; remove it and "
        words += f"give {', '.join(physical)} under [physical], or remove [physical]"
        yield home(own.name), words
        if own.name != "modulus":
            return
    if own.name == "modulus" and asked.units:
        ways = [["R"], ["E_star", "E"], ["work_of_adhesion"]]
    else:
        reduced = [one.name for one in others if one.name in REDUCED]
        united = [one for one in physical if INPUTS[one].follows] if asked.units else []
        ways = [[*united, *reduced] if apart else [own.name, *reduced, *united]]
    for names in ways:
        given = [name for name in names if asked.given(name)]
        for name in given[1:]:
            yield home(name), f"{given[0]} gives {own.about} already; keep one of the two and remove the other"
        if own.group or own.name == "a_max_over_R" or any(asked.meant(name) for name in names):
            continue
        zero = own.idle_without
        if not (zero and _is_zero(zero, asked.values)):
            unless = f"unless {zero} = 0 everywhere, " if zero else ""
            lines = [INPUTS[one].example + ("" if INPUTS[one].table == INPUTS[names[0]].table else
                     f" under [{INPUTS[one].table}]") for one in names]  # fmt: skip
            instead = f", or instead {' or '.join(lines[1:])}" if lines[1:] else ""
            yield home(names[0]), f"{unless}this is required; write for example {lines[0]}{instead}"


def left_out(values: Mapping[str, Values], *, with_units: bool) -> dict[str, float]:
    """
    Give the inputs that a valid study leaves out, with the values that they then have.

    >>> left_out({"k": 0.0, "nu": 0.3, "modulus": 500.0, "A": 0.1, "lambda_over_R": 0.2}, with_units=False)
    {'a_max_over_R': inf, 'c0_over_R': 1.0}
    """
    given = {INPUTS[name].gives for name in values}
    idle = {name: own.idle_without for name, own in INPUTS.items() if own.idle_without and name not in given}
    rim = {} if "a_max_over_R" in given else {"a_max" if with_units else "a_max_over_R": math.inf}
    return rim | {name: 1.0 for name, zero in idle.items() if _is_zero(zero, values)}


def _is_zero(parameter: str, values: Mapping[str, Values]) -> bool:
    """Report whether a parameter is given, and zero everywhere."""
    own = [one for name, one in values.items() if INPUTS[name].gives == parameter]
    return bool(own) and not any(np.any(np.asarray(one)) for one in own)


def waves(asked: Asked) -> Found:
    """Check the waves of a profile: each n once, and not all of them zero if A is not."""
    wrong = {mistake.path[:3] for mistake in asked.checked.mistakes}
    written = asked.checked.at(("profile", "harmonics"))
    if not isinstance(written, list) or ("profile", "harmonics") in wrong or ("profile",) in asked.checked.wrong:
        return
    right = {i: wave for i, wave in enumerate(written) if ("profile", "harmonics", i) not in wrong}
    yield from _each_once("profile", right)
    sizes = [abs(wave.get(name, 0.0)) for wave in right.values() for name in ("cos", "sin")]
    waved = [name for name in ("A", "chi", "amplitude") if np.any(np.asarray(asked.values.get(name, 0.0)) > 0.0)]
    given = all({"cos", "sin"} & wave.keys() for wave in right.values())
    if given and len(right) == len(written) and waved and max(sizes, default=1.0) == 0.0:
        words = f"all cos and sin are zero, so that {waved[0]} has no effect; give one a value, or use {waved[0]} = 0"
        yield "profile.harmonics", words


def _each_once(table: str, series: Mapping[int, Mapping[str, Any]]) -> Found:
    """Check that no wave of a series is given twice."""
    first: dict[int, int] = {}
    for i, wave in series.items():
        if wave["n"] in first:
            words = f"the wave n = {wave['n']} is given already, as item {first[wave['n']]}; join the two"
            yield f"{table}.harmonics[{i}].n", words
        first.setdefault(wave["n"], i)


def _punch(asked: Asked) -> Found:
    """Check the profile, the control, and what is asked of them."""
    form, written = asked.form, asked.written.get("profile")
    series = list(waves(asked))
    yield from series
    written = written if isinstance(written, Mapping) else {}
    if "file" not in written and ("profile", "file") not in asked.checked.meant:
        for name in ("sha256", "terms", "up_to"):
            if name in written:
                yield f"profile.{name}", f"this key needs a file; add file, or remove {name}"
        if written.get("exponent") == "fit":
            yield "profile.exponent", "there is no file to fit it to; add file, or write for example exponent = 2.0"
    if (spectrum := form.profile.spectrum) is not None:
        most = spectrum.first + MOST_HARMONICS - 1
        if not spectrum.first <= spectrum.last <= most:
            words = f"a series has 1 to {MOST_HARMONICS} waves, from first = {spectrum.first} on"
            yield "profile.spectrum.last", f"{words}; use last = {spectrum.first} to {most}, or another first"
        for other in ("harmonics", "file"):
            if other in written:
                yield f"profile.{other}", f"the waves come from spectrum; remove {other}, or remove spectrum"
        if asked.kind in ("curve", "optimum"):
            words = 'random roughness is available only in maps; write kind = "map", or give harmonics'
            yield "profile.spectrum", words
    yield from _control(asked)
    others = form.profile.file or spectrum or (form.profile.harmonics and not series) or form.profile.exponent != 2.0
    if others and "a_max_over_a2" in form.entries and not _is_plain(form.profile):
        words = "a_2 is defined only for one cosine on a paraboloid; give a_max_over_R or a_max_over_L"
        yield "parameters.a_max_over_a2", f"{words}, or remove [profile]"
    load = form.loading.control in CONTROLS[1:]
    for i, name in enumerate(form.outputs):
        curve = _curve_of(name) if asked.kind == "curve" else ""
        if load and curve and CURVES[curve].needs_depth:
            why = WITHOUT_LOAD.get(curve, WITHOUT_LOAD["envelope"])
            words = f"this curve is available only under displacement control: {why}; remove it, or remove [loading]"
            yield f"outputs[{i}]", words
        if name == "energy_residual" and form.loading.control == "load":
            words = 'under dead load the cycle is not closed; remove this output, or write control = "machine"'
            yield f"outputs[{i}]", words


def _is_plain(table: Any) -> bool:
    """Report whether a table says what holds without it."""
    return not table.file and table.spectrum is None and shape_of(table) == Profile()


def shape_of(table: Any) -> Profile:
    """Make the profile of a table that has no file and no spectrum."""
    exponent = 2.0 if isinstance(table.exponent, str) else table.exponent  # of a file, which is fitted
    if table.harmonics is None:
        return Profile(exponent=exponent)
    return Profile(exponent=exponent, harmonics=tuple(one.made() for one in table.harmonics))


def _control(asked: Asked) -> Found:
    """Check that a machine has one stiffness, and that nothing else has one."""
    if ("loading", "control") in asked.checked.wrong:
        return
    control, wrong = asked.form.loading.control, asked.checked.wrong
    names = [name for name, own in INPUTS.items() if own.group == "machine"]
    given = [name for name in names if name in asked.form.entries]
    if control != "machine":
        words = f'control = "{control}" has no machine; remove this key, or write control = "machine" under [loading]'
        yield from ((home(name), words) for name in given)
    elif not given and not any((INPUTS[name].table, name) in wrong for name in names):
        own = INPUTS["spring_constant" if asked.units else "machine_stiffness"]
        yield "loading.control", f"a machine needs its stiffness; write for example {own.example} under [{own.table}]"


def works(asked: Asked) -> Found:
    """Check that no edge closes at more work than it opens at, and that it turns."""
    key = "work_of_adhesion_closing"
    if asked.given(key) and not asked.given("work_of_adhesion"):
        words = "it closes at this work and opens at work_of_adhesion; write for example "
        yield home(key), words + INPUTS["work_of_adhesion"].example
    elif {key, "work_of_adhesion"} <= asked.values.keys() and not asked.given("closing_ratio"):
        closing, opening = (np.atleast_1d(asked.values[name]) for name in (key, "work_of_adhesion"))
        together = asked.points and (1 in (closing.size, opening.size) or closing.size == opening.size)
        above = np.any(closing > opening) if together else not asked.points and closing.max() > opening.min()
        if above:
            words = f"an edge cannot close at more work than it opens at, but here it is {closing.max():g} J/m^2, and "
            yield (
                home(key),
                f"work_of_adhesion {opening.min():g} J/m^2; lower it, or raise work_of_adhesion".join((words, "")),
            )
    if asked.turns or not (asked.given(key) or asked.given("closing_ratio")) or asked.ends:
        return
    if ("outputs",) in asked.checked.wrong or any(
        path[-1] == "a_max" or path[0] == "parameters" for path in asked.checked.wrong
    ):
        return
    if "closing_ratio" in asked.values and np.all(np.asarray(asked.values["closing_ratio"]) == 1.0):
        return
    wanted = [(f"outputs[{i}]", name) for i, name in enumerate(asked.form.outputs)]
    if asked.form.optimum is not None:
        wanted = [(f"optimum.{way}", name) for way, name in asked.form.optimum.goals]
    for at, name in wanted:
        own = OUTPUTS.get(name.removesuffix(SI))
        if own and own.needs_turn:
            words = (
                f"an unbounded punch that does not turn opens from ever larger radii, and {own.about.split(',')[0]} "
            )
            words += f"has no bound where it closes at less work; give {asked.turn} or a finite radius of the punch"
            yield at, f"{words}, or remove this output"
            return


def _needs_table(asked: Asked, table: str, line: str) -> Found:
    """Say which inputs have no effect without a table, and what the table needs."""
    names = [name for name, own in INPUTS.items() if own.group == table and name != "toughness_amplitude"]
    if table not in asked.checked.data:
        for name in (*names, *(("toughness_amplitude",) if table == "toughness" else ())):
            if asked.given(name):
                words = f"without [{table}] this has no effect; remove it, or add a table [{table}] with {line}"
                yield home(name), words
    elif not any(asked.meant(name) for name in names if name != "reference_speed"):
        own = INPUTS[names[0] if asked.units else names[-1]]
        yield table, f"it needs {own.example} under [{own.table}]; add it, or remove [{table}]"


def toughness(asked: Asked) -> Found:
    """Check a pattern of toughness: its keys, each wave once, and its sign everywhere on the punch."""
    if "toughness" in asked.checked.data and not asked.sound("toughness"):
        return
    yield from _needs_table(asked, "toughness", "harmonics = [{ n = 1, cos = 0.2 }]")
    if (table := asked.form.toughness) is None:
        return
    twice = list(_each_once("toughness", {i: {"n": wave.n} for i, wave in enumerate(table.harmonics)}))
    if twice:
        yield twice[0]
        return
    if "rate" in asked.checked.data:
        words = "a toughness that varies with the radius cannot be combined with a speed"
        yield "toughness", f"{words}; remove [toughness] or [rate]"
    known = [name for name, curve in CURVES.items() if curve.knows_pattern]
    for i, name in enumerate(asked.form.outputs if asked.kind == "curve" else ()):
        if _curve_of(name) not in known:
            yield f"outputs[{i}]", f"with [toughness] the only curves are {', '.join(known)}; remove this one"
    yield from _sign(asked)


def _sign(asked: Asked) -> Found:
    """Check that the toughness is not negative, and the work positive, anywhere on a punch."""
    length, rim = ("toughness_wavelength", "a_max") if asked.units else ("toughness_wavelength_over_R", "a_max_over_R")
    if length not in asked.values:
        return
    pattern, key = asked.form.toughness.made(), "toughness_amplitude"
    given = (asked.values.get(key, 1.0), asked.values[length], asked.values.get(rim, math.inf))
    amplitudes, wavelengths, rims = map(np.atleast_1d, given)
    if asked.points:
        if len({one.size for one in (amplitudes, wavelengths, rims)} - {1}) > 1:
            return  # which is said of the lists
        amplitudes, wavelengths, rims = np.broadcast_arrays(amplitudes, wavelengths, rims)
    unique = np.unique(amplitudes)
    each = asked.points and unique.size <= _MOST_AMPLITUDES
    for amplitude in (unique if each else np.unique(unique[[0, -1]])).tolist():
        own = amplitudes == amplitude if each else np.ones(amplitudes.size, bool)
        least = float((wavelengths[own] if asked.points else wavelengths).min())
        end = float((rims[own] / wavelengths[own]).max()) * least if asked.points else float(rims.max())
        radius = violation(pattern, amplitude, least, end)
        if radius is not None:
            what = {"toughness": "toughness is negative", "work": "work of adhesion is not positive"}[pattern.of]
            said = f"{key} = {amplitude:g}" if key in asked.values else "these waves"
            words = f"with {said} the {what} at the radius {radius:.6g}{' m' if asked.units else ' R'}"
            yield home(key) if key in asked.values else "toughness.harmonics", f"{words}; use smaller waves"
            return


def rate(asked: Asked) -> Found:
    """Check the law of a moving edge: its keys, what drives it, and what is known of it."""
    form = asked.form
    if "rate" in asked.checked.data and not asked.sound("rate"):
        return
    yield from _needs_table(asked, "rate", "exponent = 0.6")
    for i, name in enumerate(form.outputs):
        own, curve = OUTPUTS.get(name), _curve_of(name)
        if form.rate is None and own and own.needs == "rate":
            yield f"outputs[{i}]", "this belongs to an edge with a speed; add a table [rate], or remove it"
        known = not own or not (own.is_count or own.group in ("report", "sensitivity"))
        if form.rate is not None and not (known and (not curve or CURVES[curve].knows_rate)):
            yield f"outputs[{i}]", "this is not available for an edge with a speed; remove it, or remove [rate]"
    if form.rate is None:
        return
    if asked.given("speed") != asked.given("reference_speed"):
        there, absent = ("speed", "reference_speed") if asked.given("speed") else ("reference_speed", "speed")
        yield home(there), f"the two speeds go together; add {INPUTS[absent].example} under [physical]"
    if form.loading.control == "load":
        words = 'under a falling load the energy of this law has no bound; write control = "machine" with a soft spring'
        yield "loading.control", f"{words}, or remove [rate]"
    if form.rate.closing == "same":
        for name in ("closing_ratio", "work_of_adhesion_closing"):
            if np.any(np.asarray(asked.values.get(name, 1.0)) == 0.0):
                words = 'without adhesion on approach there is no such law; write closing = "quasi-static"'
                yield home(name), f"{words}, or a larger value"
        for name in asked.turns:
            if INPUTS[name].gives == "load_max":
                yield home(name), f'with closing = "same" a cycle turns at a depth; give {asked.turn} instead'
    lengths = ("wavelength", "a_max") if asked.units else ("lambda_over_R", "a_max_over_R")
    waved = any(np.any(np.asarray(asked.values.get(name, 0.0)) != 0.0) for name in ("A", "chi", "amplitude"))
    if waved and {*lengths} <= asked.values.keys() and not asked.turns:
        longest, least = float(np.max(asked.values[lengths[0]])), float(np.min(asked.values[lengths[1]]))
        count = least / longest * max((wave.n for wave in form.profile.harmonics or ()), default=1)
        if MOST_WAVES < count < math.inf:
            words = (
                f"{count:,.0f} waves within the punch are more than the {MOST_WAVES:,.0f} that can be followed at a "
            )
            yield home(lengths[1]), words + "speed; use a smaller punch or longer waves"
    if not asked.ends and not asked.checked.wrong:
        words = f"an edge with a speed opens from a radius; give {asked.turn} or a finite radius of the punch"
        yield "rate", words


def _states(asked: Asked) -> Found:
    """Check that the radii of states are drawn, differ, and lie within every punch."""
    radii, at = asked.form.states.contact_radius_over_R or [], "states.contact_radius_over_R"
    drawn = any(curve and CURVES[curve].of_a_state for curve in map(_curve_of, asked.form.outputs))
    if radii and not drawn and ("outputs",) not in asked.checked.wrong:
        words = 'no curve of states is requested; add "pressure" or "surface" to the outputs of a curve study'
        yield at, f"{words}, or remove [states]"
    rim = float(np.min(asked.values.get("a_max_over_R", math.inf)))
    for i, radius in enumerate(radii):
        if radius in radii[:i]:
            yield f"{at}[{i}]", "this radius is given twice; remove one of the two"
        elif radius > rim:
            words = f"a contact cannot be wider than its punch, a_max_over_R = {rim:g}; use a radius in (0, {rim:g}]"
            yield f"{at}[{i}]", words


def _range(asked: Asked) -> Found:
    """Check that the range of the attraction is given where it is needed, and not where it has no effect."""
    names = [name for name, own in INPUTS.items() if own.group == "range"]
    given = [name for name in names if asked.given(name)]
    needing = [i for i, name in enumerate(asked.form.outputs) if name in OUTPUTS and OUTPUTS[name].needs == "range"]
    known = [name for name, own in OUTPUTS.items() if own.needs == "range"]
    if given and not needing and ("outputs",) not in asked.checked.wrong and not (asked.units and names[1] in given):
        yield home(given[0]), f"no output needs this key; remove it, or add {' or '.join(map(shown, known))} to outputs"
    elif needing and not any(asked.meant(name) for name in names):
        own = INPUTS[names[0] if asked.units else names[1]]
        words = f"this output needs the range of the attraction; add {own.example} under [{own.table}]"
        yield f"outputs[{needing[0]}]", words


def _uncertain(asked: Asked) -> Found:
    """Check that what is uncertain is there, has a deviation in every scene, and that an output has a spread."""
    table, form = asked.form.uncertainty, asked.form
    if table is None:
        return
    if asked.kind != "map":
        yield "uncertainty", 'only maps have uncertain inputs; write kind = "map", or remove [uncertainty]'
        return
    own = {name: one for name in INPUTS if (one := getattr(table, name)) is not None}
    if not own and not any(path[0] == "uncertainty" for path in asked.checked.wrong):
        yield "uncertainty", 'no input is uncertain; add for example modulus = "5 %", or remove [uncertainty]'
    for name, one in own.items():
        at, values = f"uncertainty.{name}", np.atleast_1d(asked.values.get(name, 1.0))
        if name not in form.entries:
            kin = [other for other in form.entries if INPUTS[other].gives == INPUTS[name].gives]
            near = kin[0] if kin else nearest(name, [*form.entries])
            remedy = f'use "{near}"' if near else f"name one that it gives, {', '.join(form.entries)}"
            yield at, f"the study gives no {name} that could be uncertain; {remedy}, or remove this key"
            continue
        if name not in asked.values:
            continue
        if one.relative and np.any(values == 0.0):
            yield at, f"{name} is 0 in some scene, and a percentage of 0 is 0; give a number instead"
        if np.any(np.isinf(values)):
            yield at, f"{name} is inf in some scene, which has no deviation; use finite values, or remove this key"
        if one.uniform and np.any((values < one.low) | (values > one.high)):
            words = (
                f"some scene has {name} outside of it, and a uniform distribution is the same in all of them; widen "
            )
            yield at, words + 'it, or give a standard deviation such as "5 %"'
    if form.profile.spectrum and {*form.outputs} & {*OF_LINEAR}:
        words = "standard deviations apply to one punch, but a spectrum draws many; remove [uncertainty]"
        yield "uncertainty", words
    spread = [name for name in form.outputs if name in SPREADABLE]
    exact = form.method.solver == "exact" and form.rate is None
    if own and ("outputs",) not in asked.checked.wrong and not spread:
        yield "outputs", f"none of these has a spread; add for example {', '.join(map(shown, OF_LINEAR))}"
    wrong = {("outputs",), ("uncertainty", "samples")} & asked.checked.wrong
    if own and spread and not table.samples and not (exact and {*spread} & {*OF_LINEAR}) and not wrong:
        words = "no sensitivity of the outputs is known, so that their spread needs samples; write samples = 1024"
        yield "uncertainty.samples", f"{words} under [uncertainty]"


def _search(asked: Asked) -> Found:
    """Check that what is sought goes together with the rest of a study."""
    data, table = asked.checked.data, asked.form.optimum
    if asked.kind != "optimum" or "optimum" not in data:
        if asked.kind == "optimum":
            yield "optimum", "this table is required; write for example " + line_of(("optimum",))
        elif "optimum" in data:
            yield "optimum", 'the study is of another kind; write kind = "optimum", or remove [optimum]'
        return
    if ("optimum",) in asked.checked.wrong or table is None:
        return
    if "outputs" in asked.written:
        yield "outputs", "[optimum] names the outputs; remove this key"
    yield from _goals(asked)
    if ("optimum", "over") not in asked.checked.wrong:
        yield from _over(asked)
    if ("optimum", "require") not in asked.checked.wrong:
        yield from _required(asked)
    if not isinstance(asked.form.method.solver, str):
        yield "method.solver", "an optimum has one solver; choose one of these"


def _goals(asked: Asked) -> Found:
    """Check that one goal or two are named, each an output with one value a scene."""
    goals = asked.form.optimum.goals
    if (asked.checked.wrong | asked.checked.meant) & {("optimum", "maximise"), ("optimum", "minimise")}:
        return
    if not goals:
        yield "optimum.maximise", f"there is no goal; {example(('optimum', 'maximise'))}"
    if len(goals) > 2:
        yield f"optimum.{goals[2][0]}", "at most two goals are possible; remove the others"
    in_si = [name + SI for name in SPREADABLE if name in UNITS and asked.units]
    known = [*SPREADABLE, "contact_slope", *in_si]
    for i, (way, name) in enumerate(goals):
        if name in [other for _, other in goals[:i]]:
            yield f"optimum.{way}", f"{shown(name)} is named twice; remove one of the two"
        elif name not in known:
            words = (
                "a count changes in steps and has no optimum; " if name in OUTPUTS and OUTPUTS[name].is_count else ""
            )
            yield f"optimum.{way}", f"{shown(name)} cannot be a goal; {words}{did_you_mean(name, known)}"


def _over(asked: Asked) -> Found:
    """Check that all that is searched has bounds, and that the other axes have values."""
    table, data = asked.form.optimum, asked.written
    if not table.over:
        yield "optimum.over", f"no input is searched; {example(('optimum', 'over'))}"
    for i, name in enumerate(table.over):
        at, own = f"optimum.over[{i}]", data.get(INPUTS[name].table) if name in INPUTS else None
        own = own if isinstance(own, Mapping) else {}
        entry = own.get(name)
        if name in table.over[:i]:
            yield at, "this input is named twice; remove one of the two"
        elif entry is None:
            if not any(str(one) not in INPUTS and nearest(str(one), (*INPUTS,)) == name for one in own):
                known = [one for one, its in INPUTS.items() if asked.checked.has(its.table, one)]
                remedy = (
                    did_you_mean(name, known) if nearest(name, known) else f"add {name} = {{ start = .., stop = .. }}"
                )
                yield at, f"the study gives no {name} to search; {remedy}"
        elif not isinstance(entry, Mapping) or "num" in entry:
            words = f"a searched input has bounds without num, not {home(name)} = {shown(entry)}"
            yield at, f"{words}; write {name} = {{ start = .., stop = .. }}, or remove it here"
        elif name in asked.values and np.ptp(np.asarray(asked.values[name])) == 0.0:
            yield home(name), "the bounds are the same; write another stop, or a number"
    if len(table.over) > MOST_SEARCHED:
        yield "optimum.over", f"at most {MOST_SEARCHED} inputs are searched at once; fix the others"
    elif (2 * table.resolution - 1) ** len(table.over) > MOST_POINTS:
        most = int(0.5 * (1 + MOST_POINTS ** (1.0 / len(table.over))))
        words = f"a sweep over {len(table.over)} inputs has a resolution of at most {most}; use that or less"
        yield "optimum.resolution", words
    for name, values in asked.axes.items():
        if not asked.points and isinstance(values, np.ndarray) and values.size == 1:
            words = f"an axis of one value cannot be combined with searched inputs; write {name} = {values[0]!s}"
            yield home(name), words


def _required(asked: Asked) -> Found:
    """Check what is required."""
    table, method = asked.form.optimum.require, asked.form.method
    known = tuple(name for name in OUTPUTS if name not in SENSITIVITIES)
    for word in ("minimum", "maximum"):
        for name, value in getattr(table, word).items():
            at = f"optimum.require.{word}.{name}"
            if name not in known:
                yield at, f"not an output; {did_you_mean(name, known)}"
            elif word == "maximum" and table.minimum.get(name, -math.inf) > value:
                yield at, f"the maximum is below the minimum, {table.minimum[name]:g}; exchange the two"
    if table.one_disc and (method.solver != "exact" or not method.check_contact):
        words = 'this needs solver = "exact" and check_contact = true; change [method], or remove this key'
        yield "optimum.require.one_disc", words


def _size(asked: Asked) -> Found:
    """Check that a study is not too large for its kind."""
    lengths = [np.size(values) for values in asked.axes.values()]
    spectrum, table = asked.form.profile.spectrum, asked.form.optimum
    scenes = max(lengths, default=1) if asked.points else math.prod(lengths)
    scenes *= 1 if spectrum is None else spectrum.realisations
    kind = "pareto" if asked.kind == "optimum" and table is not None and len(table.goals) > 1 else asked.kind
    if scenes > MOST_SCENES[kind]:
        words = (
            f"a {kind} study has at most {MOST_SCENES[kind]:,} scenes, and this one has {scenes:,}; use fewer values"
        )
        more = ' or write kind = "map"' if kind == "curve" else ""
        yield "kind" if kind in ("curve", "pareto") else "parameters", f"{words}, split the study{more}"


_STEPS: Final = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


def steps_of(path: str) -> tuple[str | int, ...]:
    """
    Take a dotted key apart.

    >>> steps_of("parameters.k[3]")
    ('parameters', 'k', 3)
    """
    return tuple(int(item) if item else name for name, item in _STEPS.findall(path))


__all__ = ["Asked", "Values", "broken", "expanded", "left_out", "list_of", "range_mistakes", "repeated", "steps_of"]
