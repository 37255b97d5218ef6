"""What the keys of a study of scenes have to do with each other: where a rule is broken, and what to write instead."""

import math
from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from gradhesion.cli.names.outputs import OF_LINEAR, SI, SPREADABLE, UNITS
from gradhesion.cli.study.rules.asked import Asked, Found, home, repeated
from gradhesion.cli.study.rules.form import OUTPUTS_OF, Optimum
from gradhesion.cli.study.rules.inputs import inputs, rate, shape_of, together, toughness, waves, works
from gradhesion.cli.study.rules.mistakes import line_of, required
from gradhesion.cli.study.text.toml import steps_of
from gradhesion.cli.terminal.wording import did_you_mean, nearest, shown
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import GIVEN_UP, INTEGERS, SENSITIVITIES, SOLVERS, WITHOUT_LOAD
from gradhesion.core.problem.outputs import CURVES, OUTPUTS
from gradhesion.core.problem.profile import MOST_HARMONICS, Profile

MOST_SCENES: Final = {"map": 2**31, "curve": 1_000, "optimum": 2**31, "pareto": 100_000}
"""Scenes of one study: beyond, a dataset is no longer one file; curves are for looking at; fronts are in memory."""
MOST_SEARCHED: Final = 3
"""Inputs that are searched at once: a sweep has a power of the resolution."""
MOST_POINTS: Final = 2**24
"""Points of the sweep of one cell: all are in memory."""
CURVE_OF: Final = {name: curve.name for curve in CURVES.values() for name in (curve.name, *curve.names)}
"""The curve that an output is, or is a variable of."""


def broken(asked: Asked) -> Found:
    """List what is wrong between the keys of a study of scenes."""
    for rule in (together, _outputs, _method, _axes, _optimum, inputs, waves, _punch, _machine, works, toughness, rate,
                 _states, _range, _uncertain, _size):  # fmt: skip
        yield from rule(asked)


def _axes(asked: Asked) -> Found:
    """Check the axes of a grid, or the lists of points: no value twice, or one length."""
    if not asked.points:
        for name, values in asked.values.items():
            yield from repeated(name, values)
        return
    lengths = {name: values.size for name, values in asked.axes.items() if isinstance(values, np.ndarray)}
    first = next(iter(lengths), "")
    for name, length in lengths.items():
        if length != lengths[first]:
            yield home(name), f"it has {length} values, but {first} has {lengths[first]}; give all lists one length"


def _outputs(asked: Asked) -> Found:
    """Check that each output belongs to the kind of the study, is asked for once, and is known of its scenes."""
    names, known = asked.data.get("outputs"), OUTPUTS_OF.get(asked.kind, ())
    if known and names is None:
        yield "outputs", required("outputs")
    listed = [name if isinstance(name, str) else "" for name in names] if isinstance(names, list) and known else []
    other = "map" if asked.kind == "curve" else "curve"
    for i, name in enumerate(listed):
        at, curve = f"outputs[{i}]", CURVE_OF.get(name)
        if name in GIVEN_UP:
            yield at, f"this output is given up, remove it: {GIVEN_UP[name]}"
        elif name and name not in known:
            what = f'an output of kind "{other}": write that kind' if name in OUTPUTS_OF[other] else "not an output"
            yield at, f"{what}; {did_you_mean(name, known)}"
        elif name and (name in listed[:i] or (curve in listed and curve != name)):
            yield at, "this output is listed twice, by its own name or that of its curve; remove one of the two"
        yield from ((at, words) for words in _unknown_of(name, asked))
    for way in ("maximise", "minimise"):
        for name in getattr(asked.form.optimum, way, ()):
            yield from ((f"optimum.{way}", words) for words in _unknown_of(name, asked))


def _unknown_of(name: str, asked: Asked) -> Iterator[str]:
    """Say why an output is not known of the scenes of a study."""
    form, own, curve = asked.form, OUTPUTS.get(name.removesuffix(SI)), CURVES.get(CURVE_OF.get(name, ""))
    if own and own.exact_alone and (other := _approximate(asked)):
        yield f'the solver "{other}" has no such output; remove it, or write solver = "exact"'
    if own and own.needs == "range" and not asked.of("range"):
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
    equal = np.all(np.asarray(asked.values.get("closing_ratio", 0.0)) == 1.0)
    if own and own.needs_turn and unequal and not equal and not asked.ends and asked.right("parameters", "physical"):
        yield f"on an unbounded punch that closes at less work this has no bound; give {asked.turn} or a finite radius"


def _approximate(asked: Asked) -> str:
    """Name the first solver that is an approximation; empty if there is none."""
    return next((one for one in asked.form.method.solver if one in SOLVERS and one != "exact"), "")


def _method(asked: Asked) -> Found:
    """Check that each solver is known, named once, and solves what is asked; and that a study of curves has none."""
    method, form = asked.form.method, asked.form
    if asked.kind == "curve":
        for key in ("solver", "check_contact"):
            if getattr(method, key) != getattr(type(method)(), key):
                yield f"method.{key}", "curves are selected by outputs, and always checked; remove this key"
        return
    for i, one in enumerate(method.solver):
        at = f"method.solver[{i}]" if isinstance(asked.at("method.solver"), list) else "method.solver"
        if one not in SOLVERS:
            yield at, f"not a solver; {did_you_mean(one, SOLVERS)}"
        elif one in method.solver[:i]:
            yield at, "this solver is listed twice; remove one of the two"
    if not (other := _approximate(asked)):
        return
    cannot = {"[toughness]": form.toughness, "[rate]": form.rate, **dict.fromkeys(asked.turns[:1], True)}
    for what in (what for what, there in cannot.items() if there):
        yield "method.solver", f'the solver "{other}" does not support {what}; write solver = "exact", or remove {what}'
    if form.loading.control != "displacement":
        words = f'the solver "{other}" is available only under displacement control: {WITHOUT_LOAD[other]}'
        yield "method.solver", f'{words}; write solver = "exact", or remove [loading]'


def _punch(asked: Asked) -> Found:
    """Check what goes with each source of the waves of a profile."""
    table = asked.form.profile
    if (spectrum := table.spectrum) is not None:
        if not 0 <= spectrum.last - spectrum.first < MOST_HARMONICS:
            yield "profile.spectrum.last", f"a series has 1 to {MOST_HARMONICS} waves, from first on; use another last"
        if asked.kind != "map":
            yield "profile.spectrum", 'only maps have random roughness; write kind = "map", or give harmonics'
    single = not table.file and not spectrum and len(table.harmonics or (1,)) == 1
    if asked.given("a_max_over_a2") and not (single and shape_of(table) == Profile()):
        yield "parameters.a_max_over_a2", "only one cosine on a paraboloid has a radius a_2; give a_max_over_R instead"


def _machine(asked: Asked) -> Found:
    """Check that a machine has one stiffness, and that nothing else has one."""
    control, given = asked.form.loading.control, asked.of("machine")
    if not asked.right("loading.control"):
        return
    for name in (one for one in given if control != "machine" and one in asked.form.entries):
        yield home(name), f'control = "{control}" has no machine; remove this key, or write control = "machine"'
    if control == "machine" and not given:
        own = INPUTS["spring_constant" if asked.units else "machine_stiffness"]
        yield "loading.control", f"a machine needs its stiffness; write for example {own.example} under [{own.table}]"


def _states(asked: Asked) -> Found:
    """Check that the radii of states are drawn, differ, and lie within every punch."""
    radii, at = asked.form.states.contact_radius_over_R or [], "states.contact_radius_over_R"
    drawn = any(CURVES[CURVE_OF[name]].of_a_state for name in asked.form.outputs if name in CURVE_OF)
    if radii and asked.form.outputs and not drawn:
        yield at, 'no curve of states is requested; add "pressure" or "surface" to outputs, or remove [states]'
    rim = float(np.min(asked.values.get("a_max_over_R", math.inf)))
    for i, radius in enumerate(radii):
        if radius in radii[:i]:
            yield f"{at}[{i}]", "this radius is given twice; remove one of the two"
        elif radius > rim:
            yield f"{at}[{i}]", f"a contact cannot be wider than its punch; use a radius in (0, {rim:g}]"


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
        words = f"at most {MOST_SCENES[kind]:,} scenes are in one {kind} study, and this one has {scenes:,}; split it"
        yield "kind" if kind in ("curve", "pareto") else "parameters", words


def _uncertain(asked: Asked) -> Found:
    """Check that what is uncertain is there, has a deviation in every scene, and that an output has a spread."""
    table, form = asked.form.uncertainty, asked.form
    if table is None:
        return
    own = table.deviations
    if not own and asked.right("uncertainty"):
        yield "uncertainty", 'no input is uncertain; add for example modulus = "5 %", or remove [uncertainty]'
    for name, one in own.items():
        at, values = f"uncertainty.{name}", np.atleast_1d(asked.values.get(name, 1.0))
        if not asked.given(name):
            same = [other for other in form.entries if INPUTS[other].gives == INPUTS[name].gives]
            near = [other for other in same if INPUTS[name].instead_of == other or INPUTS[other].instead_of == name]
            kin = (*near, *same, name)[0]
            yield at, f"the study gives no {name}; {did_you_mean(kin, [*form.entries])}, or remove this key"
        elif name in asked.values:
            if one.relative and np.any(values == 0.0):
                yield at, f"{name} is 0 in some scene, and a percentage of 0 is 0; give a number instead"
            if np.any(np.isinf(values)):
                yield at, f"{name} is inf in some scene, which has no deviation; use finite values, or remove this key"
            if one.uniform and np.any((values < one.low) | (values > one.high)):
                yield at, f'some scene has {name} outside of it; widen it, or give a standard deviation such as "5 %"'
    spread, linear = {*form.outputs} & {*SPREADABLE}, {*form.outputs} & {*OF_LINEAR}
    if form.profile.spectrum and linear:
        yield "uncertainty", "a spectrum draws many punches, and deviations are of one; remove one of the two"
    known = linear and form.method.solver == ["exact"] and form.rate is None
    if own and form.outputs and not spread:
        yield "outputs", f"none of these has a spread; add for example {', '.join(map(shown, OF_LINEAR))}"
    if own and spread and not table.samples and not known and asked.right("outputs", "uncertainty.samples"):
        yield "uncertainty.samples", "without sensitivities of the outputs it needs samples; write samples = 1024"


def _optimum(asked: Asked) -> Found:
    """Check that what is sought goes together with the rest of a study."""
    table, method = asked.form.optimum, asked.form.method
    if table is None:
        if asked.kind == "optimum" and "optimum" not in asked.data:
            yield "optimum", required("optimum")
        return
    yield from _goals(asked, table)
    if asked.right("optimum.over"):
        yield from _over(asked, table)
    known = [name for name in OUTPUTS if name not in SENSITIVITIES]
    known += [name + SI for name in known if name in UNITS and asked.units]
    for word in ("minimum", "maximum"):
        for name, value in getattr(table.require, word).items():
            if name not in known:
                yield f"optimum.require.{word}.{name}", f"not an output; {did_you_mean(name, known)}"
            elif word == "maximum" and table.require.minimum.get(name, value) > value:
                yield f"optimum.require.maximum.{name}", "the maximum is below the minimum; exchange the two"
    if table.require.one_disc and (method.solver != ["exact"] or not method.check_contact):
        yield "optimum.require.one_disc", "this needs the exact solver and check_contact = true; change [method]"
    if isinstance(asked.at("method.solver"), list):
        yield "method.solver", "an optimum has one solver; choose one of these"


def _goals(asked: Asked, table: Optimum) -> Found:
    """Check that one goal or two are named, each an output with one value a scene."""
    ways, goals = ("optimum.maximise", "optimum.minimise"), table.goals
    if not goals and asked.right(*ways):
        yield ways[0], f"there is no goal; write for example {line_of('optimum', 'maximise')}"
    if len(goals) > 2:
        yield ways[len(table.maximise) < 3], "at most two goals are possible; remove the others"
    known = [*SPREADABLE, "contact_slope", *(name + SI for name in SPREADABLE if name in UNITS and asked.units)]
    for i, name in enumerate(goals):
        way = ways[i >= len(table.maximise)]
        if name in goals[:i]:
            yield way, f"{shown(name)} is named twice; remove one of the two"
        elif name not in known:
            why = " (counts cannot)" if name in INTEGERS else ""
            yield way, f"{shown(name)} cannot be a goal{why}; {did_you_mean(name, known)}"


def _over(asked: Asked, table: Optimum) -> Found:
    """Check that all that is searched has bounds, and that the other axes have values."""
    if not table.over:
        yield "optimum.over", f"no input is searched; write for example {line_of('optimum', 'over')}"
    for i, name in enumerate(table.over):
        at, entry = f"optimum.over[{i}]", asked.at(home(name)) if name in INPUTS else None
        if name in table.over[:i]:
            yield at, "this input is named twice; remove one of the two"
        elif entry is None and not (name in INPUTS and asked.given(name)):
            near = nearest(name, asked.given(*INPUTS))
            remedy = f'did you mean "{near}"?' if near else f"add {name} = {{ start = .., stop = .. }}"
            yield at, f"the study gives no {name} to search; {remedy}"
        elif entry is not None and (not isinstance(entry, Mapping) or "num" in entry):
            yield at, f"a searched input has two bounds; write {home(name)} = {{ start = .., stop = .. }}, without num"
    if INPUTS.keys() >= {*table.over}:
        for name in (name for name in asked.over if name not in table.over):
            yield f"{home(name)}.num", f"{required(*steps_of(home(name)), 'num')}, or name {name} in over"
    if len(table.over) > MOST_SEARCHED:
        yield "optimum.over", f"at most {MOST_SEARCHED} inputs are searched at once; fix the others"
    elif (2 * table.resolution - 1) ** len(table.over) > MOST_POINTS:
        most = int(0.5 * (1 + MOST_POINTS ** (1.0 / len(table.over))))
        yield "optimum.resolution", f"with {len(table.over)} searched inputs it is at most {most}; use that or less"
    for name, values in asked.axes.items():
        if not asked.points and isinstance(values, np.ndarray) and values.size == 1:
            yield home(name), f"beside searched inputs an axis has several values; write {name} = {values[0]!s}"
