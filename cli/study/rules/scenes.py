"""What the keys of a study have to do with each other: for each rule where it is broken, and what to write instead."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli.names.outputs import SI
from gradhesion.cli.study.rules.asked import Asked, Found, curve_of, home
from gradhesion.cli.study.rules.axes import Values, repeated
from gradhesion.cli.study.rules.edge import each_once, rate, toughness, works
from gradhesion.cli.study.rules.form import OUTPUTS_OF
from gradhesion.cli.study.rules.mistakes import required
from gradhesion.cli.study.rules.search import search, uncertain
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL, REDUCED, Input
from gradhesion.core.problem.names import GIVEN_UP, SOLVERS, WITHOUT_LOAD
from gradhesion.core.problem.outputs import CURVES, OUTPUTS
from gradhesion.core.problem.profile import MOST_HARMONICS, Profile

MOST_SCENES: Final = {"map": 2**31, "curve": 1_000, "optimum": 2**31, "pareto": 100_000}
"""Scenes of one study: beyond, a dataset is no longer one file; curves are for looking at; fronts are in memory."""
_MAY_MIX: Final = ("A", "closing_ratio", "machine_stiffness")
"""The ratios that may stand beside quantities with units."""
_STIFF: Final = "the surface has no stiffness; use nu = 0.5, or k below 1"


def broken(asked: Asked) -> Found:
    """List what is wrong between the keys of a study of scenes."""
    for rule in (_outputs, _method, _axes, search, inputs, _punch, control, works, toughness, rate, _states, _range,
                 uncertain, _size):  # fmt: skip
        yield from rule(asked)


def _axes(asked: Asked) -> Found:
    """Check the axes of a grid, or the lists of points: no value twice, one length; no material without stiffness."""
    for name, own in INPUTS.items():
        entry = asked.data[own.table][name] if asked.has(own.table, name) else None
        if isinstance(entry, Mapping) and "num" not in entry and name not in asked.over:
            yield f"{home(name)}.num", required(own.table, name, "num")
    k, nu = (np.atleast_1d(asked.axes.get(name, 0.5)) for name in ("k", "nu"))
    soft = bool(np.any(k == 1.0) and np.any(nu != 0.5))
    if not asked.points:
        for name, values in asked.values.items():
            yield from repeated(name, values)
    elif soft:  # in one scene, unless the lists differ in length, as is said below
        soft = (1 in (k.size, nu.size) or k.size == nu.size) and bool(np.any((k == 1.0) & (nu != 0.5)))
    if soft:
        yield "parameters.k", f"with k = 1 and nu other than 0.5 {_STIFF}"
    lengths = {name: values.size for name, values in asked.axes.items() if isinstance(values, np.ndarray)}
    first = next(iter(lengths), "")
    for name, length in lengths.items() if asked.points else ():
        if length != lengths[first]:
            words = f'it has {length} values, but {first} has {lengths[first]}; with layout = "points" all lists have '
            yield home(name), words + "one length (a single number applies to all scenes)"


def _outputs(asked: Asked) -> Found:
    """Check that each output belongs to the kind of the study, is asked for once, and is known of its scenes."""
    names, known = asked.data.get("outputs"), OUTPUTS_OF.get(asked.kind, ())
    if known and names is None:
        yield "outputs", required("outputs")
    listed = names if isinstance(names, list) and known else []
    for i, name in enumerate(listed):
        if not isinstance(name, str):
            continue
        at, curve, other = f"outputs[{i}]", curve_of(name), "map" if asked.kind == "curve" else "curve"
        if name not in known and name in OUTPUTS_OF[other]:
            words = f'an output of studies of kind "{other}", and this one is of kind "{asked.kind}"; '
            yield at, words + f'{did_you_mean(name, known)}, or write kind = "{other}"'
        elif name in GIVEN_UP:
            yield at, f"this output is given up, remove it: {GIVEN_UP[name]}"
        elif name not in known:
            yield at, f"not an output; {did_you_mean(name, known)}"
        elif name in listed[:i]:
            yield at, "this output is listed twice; remove one of the two"
        elif curve in listed and curve != name:
            yield at, f'a variable of "{curve}", which is listed as a whole; remove one of the two'
        yield from ((at, words) for words in _unknown_of(name, asked))
    goals = asked.form.optimum.goals if asked.form.optimum else []
    yield from ((f"optimum.{way}", words) for way, name in goals for words in _unknown_of(name, asked))


def _unknown_of(name: str, asked: Asked) -> Iterator[str]:
    """Say why an output is not known of the scenes of a study."""
    form, own, curve = asked.form, OUTPUTS.get(name.removesuffix(SI)), CURVES.get(curve_of(name))
    other = _approximate(asked)
    if own and own.exact_alone and other:
        yield f'the solver "{other}" has no such output; remove it, or write solver = "exact"'
    if own and own.needs == "range" and not asked.meant("adhesion_range", "adhesion_range_over_R"):
        key = INPUTS["adhesion_range" if asked.units else "adhesion_range_over_R"]
        yield f"this output needs the range of the attraction; add {key.example} under [{key.table}]"
    if own and own.needs == "rate" and form.rate is None and asked.right("rate"):
        yield "this belongs to an edge with a speed; add a table [rate], or remove it"
    still = (own and (own.is_count or own.group in ("report", "sensitivity"))) or (curve and not curve.knows_rate)
    if form.rate is not None and still:
        yield "this is not available for an edge with a speed; remove it, or remove [rate]"
    if form.toughness and curve and not curve.knows_pattern:
        patterns = ", ".join(one for one, its in CURVES.items() if its.knows_pattern)
        yield f"with [toughness] the only curves are {patterns}; remove this one"
    if form.loading.control != "displacement" and curve and curve.needs_depth:
        why = WITHOUT_LOAD.get(curve.name, WITHOUT_LOAD["envelope"])
        yield f"this curve is available only under displacement control: {why}; remove it, or remove [loading]"
    if name == "energy_residual" and form.loading.control == "load":
        yield 'under dead load the cycle is not closed; remove this output, or write control = "machine"'
    unequal = asked.given("work_of_adhesion_closing", "closing_ratio")
    equal = "closing_ratio" in asked.values and bool(np.all(np.asarray(asked.values["closing_ratio"]) == 1.0))
    if own and own.needs_turn and unequal and not equal and not asked.ends and asked.right("parameters", "physical"):
        yield (
            f"an unbounded punch that does not turn opens from ever larger radii, and {own.about.split(',')[0]} has no "
            f"bound where it closes at less work; give {asked.turn} or a finite radius of the punch, or remove this"
        )


def _approximate(asked: Asked) -> str:
    """Name the first solver that is an approximation; empty if there is none."""
    return next((one for one in asked.form.method.solver if one in SOLVERS and one != "exact"), "")


def _method(asked: Asked) -> Found:
    """Check that each solver is known, named once, and solves what is asked; and that a study of curves has none."""
    method = asked.form.method
    if asked.kind == "curve":
        if method.solver != ["exact"]:
            words = "a curve study has no solver, since its outputs select the curves; remove this key"
            yield "method.solver", words + ', and add "asymptotic", "envelope" or "effective" to outputs'
        if not method.check_contact:
            yield "method.check_contact", "the path of a curve study is always checked; remove this key"
        return
    for i, one in enumerate(method.solver):
        at = f"method.solver[{i}]" if asked.lists_solvers else "method.solver"
        if one not in SOLVERS:
            yield at, f"not a solver; {did_you_mean(one, SOLVERS)}"
        elif one in method.solver[:i]:
            yield at, "this solver is listed twice; remove one of the two"
    other, form = _approximate(asked), asked.form
    cannot = {"[toughness]": form.toughness, "[rate]": form.rate, **dict.fromkeys(asked.turns[:1], True)}
    for what in (what for what, there in cannot.items() if there and other):
        yield "method.solver", f'the solver "{other}" does not support {what}; write solver = "exact", or remove {what}'
    if other and form.loading.control != "displacement":
        words = f'the solver "{other}" is available only under displacement control: {WITHOUT_LOAD[other]}; '
        yield "method.solver", words + 'write solver = "exact", or remove [loading]'


def inputs(asked: Asked) -> Found:
    """Check that each parameter is given once, in the units of the others, and is given where every scene has it."""
    if ("parameters",) in asked.wrong:
        return
    for name, own in INPUTS.items():
        kin = [one for one, its in INPUTS.items() if its.gives == name]
        if own.is_parameter and name not in ("k", "nu") and (not own.group or asked.given(*kin)):
            yield from _ways(asked, own, kin)
    turns = asked.of("turn")
    if asked.form.entries.get("indentation_max") == "data" and asked.kind != "fit":
        yield home("indentation_max"), f"only a fit has data; write for example {INPUTS['indentation_max'].example}"
    for name in turns[1:]:
        yield home(name), f"a cycle turns at one depth or load, and {turns[0]} gives it already; remove one of the two"


def _ways(asked: Asked, own: Input, kin: list[str]) -> Found:
    """Check the inputs that give one parameter."""
    physical, reduced = ([name for name in kin if name in group] for group in (PHYSICAL, REDUCED))
    idle = own.group in ("toughness", "rate") and own.group not in asked.data
    alone = asked.kind == "fit" and own.group == "rate" and not asked.given(*physical)  # a loop knows the ratio only
    apart = asked.units and own.name not in _MAY_MIX and bool(physical) and not idle and not alone
    if apart and asked.given(own.name):
        there = asked.given(*(name for name in physical if INPUTS[name].follows))
        remedy = f"remove it: {there[0]} is given" if there else f"remove it and give {', '.join(physical)} there"
        yield home(own.name), f"a ratio, where [physical] gives quantities with units; {remedy}, or remove [physical]"
        if own.name != "modulus":
            return
    united = [name for name in physical if INPUTS[name].follows and asked.units]
    ways = [[*united, *reduced] if apart else [own.name, *reduced, *united]]
    if own.name == "modulus" and asked.units:
        ways = [["R"], ["E_star", "E"], ["work_of_adhesion"]]
    for names in ways:
        given = asked.given(*names)
        for name in given[1:]:
            yield home(name), f"{given[0]} gives this already; keep one of the two and remove the other"
        zero = own.idle_without
        if own.group or own.name == "a_max_over_R" or asked.meant(*names) or (zero and is_zero(zero, asked.values)):
            continue
        table = INPUTS[names[0]].table
        lines = [(INPUTS[name].example, INPUTS[name].table) for name in names]
        first, *others = [line if its == table else f"{line} under [{its}]" for line, its in lines]
        instead = f", or instead {' or '.join(others)}" if others else ""
        unless = f"unless {zero} = 0 everywhere, " if zero else ""
        yield home(names[0]), f"{unless}this is required; write for example {first}{instead}"


def left_out(values: Mapping[str, Values], *, with_units: bool) -> dict[str, float]:
    """
    Give the inputs that a valid study leaves out, with the values that they then have.

    >>> left_out({"k": 0.0, "nu": 0.3, "modulus": 500.0, "A": 0.1, "lambda_over_R": 0.2}, with_units=False)
    {'a_max_over_R': inf, 'c0_over_R': 1.0}
    """
    given = {INPUTS[name].gives for name in values}
    rim = {} if "a_max_over_R" in given else {"a_max" if with_units else "a_max_over_R": math.inf}
    idle = (name for name, own in INPUTS.items() if name not in given and is_zero(own.idle_without, values))
    return rim | dict.fromkeys(idle, 1.0)


def is_zero(parameter: str, values: Mapping[str, Values]) -> bool:
    """Report whether a parameter is given, and zero everywhere."""
    own = [one for name, one in values.items() if INPUTS[name].gives == parameter]
    return bool(own) and not any(np.any(np.asarray(one)) for one in own)


def waves(asked: Asked) -> Found:
    """Check the waves of a profile: each n once, and not all of them zero if A is not."""
    table = asked.form.profile
    numbers = [wave.n for wave in table.harmonics or ()]
    yield from each_once("profile", numbers)
    flat = len({*numbers}) == len(numbers) > 0 and not any(
        one.cos or one.sin for one in table.made(exponent=2.0).harmonics
    )
    for name in asked.waved[:1] if flat else ():
        words = f"all cos and sin are zero, so that {name} has no effect; give one a value, or use {name} = 0"
        yield "profile.harmonics", words


def _punch(asked: Asked) -> Found:
    """Check that the waves of a profile come from one source, and what goes with each."""
    table = asked.form.profile
    yield from waves(asked)
    if not asked.has("profile", "file"):
        for name in ("sha256", "terms", "up_to"):
            if asked.has("profile", name):
                yield f"profile.{name}", f"this key needs a file; add file, or remove {name}"
        if table.exponent == "fit":
            yield "profile.exponent", "there is no file to fit it to; add file, or write for example exponent = 2.0"
    if (spectrum := table.spectrum) is not None:
        if not 0 <= spectrum.last - spectrum.first < MOST_HARMONICS:
            words = f"a series has 1 to {MOST_HARMONICS} waves, from first = {spectrum.first} on"
            yield "profile.spectrum.last", f"{words}; use another last, or another first"
        for other in ("harmonics", "file"):
            if asked.has("profile", other):
                yield f"profile.{other}", f"the waves come from spectrum; remove {other}, or remove spectrum"
        if asked.kind in ("curve", "optimum"):
            words = 'random roughness is available only in maps; write kind = "map", or give harmonics'
            yield "profile.spectrum", words
    single = not table.file and not spectrum and len(table.harmonics or (1,)) == 1
    one_cosine = single and shape_of(table) == Profile()
    if asked.given("a_max_over_a2") and not one_cosine:
        words = "a_2 is defined only for one cosine on a paraboloid; give a_max_over_R or a_max_over_L"
        yield "parameters.a_max_over_a2", f"{words}, or remove [profile]"


def shape_of(table: Any) -> Profile:
    """Make the profile of a table that has no file and no spectrum; one of a file is fitted."""
    made: Profile = table.made(exponent=2.0 if table.exponent == "fit" else table.exponent)
    return made


def control(asked: Asked) -> Found:
    """Check that a machine has one stiffness, and that nothing else has one."""
    if not asked.right("loading.control"):
        return
    control, given = asked.form.loading.control, asked.of("machine")
    for name in (one for one in given if control != "machine" and one in asked.form.entries):
        words = f'control = "{control}" has no machine; remove this key, or write control = "machine" under [loading]'
        yield home(name), words
    if control == "machine" and not given:
        own = INPUTS["spring_constant" if asked.units else "machine_stiffness"]
        yield "loading.control", f"a machine needs its stiffness; write for example {own.example} under [{own.table}]"


def _states(asked: Asked) -> Found:
    """Check that the radii of states are drawn, differ, and lie within every punch."""
    radii, at = asked.form.states.contact_radius_over_R or [], "states.contact_radius_over_R"
    drawn = any(CURVES[curve].of_a_state for curve in map(curve_of, asked.form.outputs) if curve)
    if radii and asked.form.outputs and not drawn:
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
    """Check that the range of the attraction is not given where it has no effect."""
    known = [name for name, own in OUTPUTS.items() if own.needs == "range"]
    for name in asked.of("range"):
        alone = INPUTS[name].table == "parameters" and asked.units  # a ratio, which is refused as such
        if asked.form.outputs and not alone and not {*known} & {*asked.form.outputs}:
            yield home(name), f"no output needs this key; remove it, or add {' or '.join(map(shown, known))} to outputs"


def _size(asked: Asked) -> Found:
    """Check that a study is not too large for its kind."""
    lengths = [np.size(values) for values in asked.axes.values()]
    spectrum, table = asked.form.profile.spectrum, asked.form.optimum
    scenes = max(lengths, default=1) if asked.points else math.prod(lengths)
    scenes *= 1 if spectrum is None else spectrum.realisations
    kind = "pareto" if asked.kind == "optimum" and table is not None and len(table.goals) > 1 else asked.kind
    if scenes > MOST_SCENES[kind]:
        words = f"a {kind} study has at most {MOST_SCENES[kind]:,} scenes, and this one has {scenes:,}; use fewer "
        words += "values, split the study" + (' or write kind = "map"' if kind == "curve" else "")
        yield "kind" if kind in ("curve", "pareto") else "parameters", words
