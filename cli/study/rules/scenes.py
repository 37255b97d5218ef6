"""What the keys of a study of scenes have to do with each other: where a rule is broken, and what to write instead."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np

from gradhesion.cli.names import curves
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.study.rules.asked import Asked, Found, home, repeated
from gradhesion.cli.study.rules.form import OUTPUTS_OF
from gradhesion.cli.study.rules.inputs import inputs, rate, shape_of, together, toughness, waves, works
from gradhesion.cli.study.rules.mistakes import required
from gradhesion.cli.study.rules.search import search, uncertain
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import GIVEN_UP, SOLVERS, WITHOUT_LOAD
from gradhesion.core.problem.outputs import CURVES, OUTPUTS
from gradhesion.core.problem.profile import MOST_HARMONICS, Profile

MOST_SCENES: Final = {"map": 2**31, "curve": 1_000, "optimum": 2**31, "pareto": 100_000}
"""Scenes of one study: beyond, a dataset is no longer one file; curves are for looking at; fronts are in memory."""


def broken(asked: Asked) -> Found:
    """List what is wrong between the keys of a study of scenes."""
    for rule in (together, _outputs, _method, _axes, search, inputs, waves, _punch, _machine, works, toughness, rate,
                 _states, _range, uncertain, _size):  # fmt: skip
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


def _curve_of(name: str) -> str:
    """Name the curve that an output is, or is a variable of; empty for another."""
    return name if name in CURVES else curves.curve_of(name) or ""


def _outputs(asked: Asked) -> Found:
    """Check that each output belongs to the kind of the study, is asked for once, and is known of its scenes."""
    names, known = asked.data.get("outputs"), OUTPUTS_OF.get(asked.kind, ())
    if known and names is None:
        yield "outputs", required("outputs")
    listed = names if isinstance(names, list) and known else []
    other = "map" if asked.kind == "curve" else "curve"
    for i, name in enumerate(listed):
        if not isinstance(name, str):
            continue
        at, curve = f"outputs[{i}]", _curve_of(name)
        if name not in known and name in OUTPUTS_OF[other]:
            yield at, f'an output of studies of kind "{other}"; {did_you_mean(name, known)}, or write that kind'
        elif name in GIVEN_UP:
            yield at, f"this output is given up, remove it: {GIVEN_UP[name]}"
        elif name not in known:
            yield at, f"not an output; {did_you_mean(name, known)}"
        elif name in listed[:i]:
            yield at, "this output is listed twice; remove one of the two"
        elif curve in listed and curve != name:
            yield at, f'a variable of "{curve}", which is listed as a whole; remove one of the two'
        yield from ((at, words) for words in _unknown_of(name, asked))
    for way in ("maximise", "minimise"):
        for name in getattr(asked.form.optimum, way, ()):
            yield from ((f"optimum.{way}", words) for words in _unknown_of(name, asked))


def _unknown_of(name: str, asked: Asked) -> Iterator[str]:
    """Say why an output is not known of the scenes of a study."""
    form, own, curve = asked.form, OUTPUTS.get(name.removesuffix(SI)), CURVES.get(_curve_of(name))
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
    equal = np.all(np.asarray(asked.values.get("closing_ratio", 0.0)) == 1.0)
    if own and own.needs_turn and unequal and not equal and not asked.ends and asked.right("parameters", "physical"):
        words = f"{own.about.split(',')[0]} has no bound on an unbounded punch that closes at less work"
        yield f"{words}; give {asked.turn} or a finite radius of the punch, or remove this"


def _approximate(asked: Asked) -> str:
    """Name the first solver that is an approximation; empty if there is none."""
    return next((one for one in asked.form.method.solver if one in SOLVERS and one != "exact"), "")


def _method(asked: Asked) -> Found:
    """Check that each solver is known, named once, and solves what is asked; and that a study of curves has none."""
    method, form = asked.form.method, asked.form
    if asked.kind == "curve":
        if method.solver != ["exact"]:
            yield "method.solver", "outputs select the curves of a curve study; name them there, and remove this key"
        if not method.check_contact:
            yield "method.check_contact", "the path of a curve study is always checked; remove this key"
        return
    for i, one in enumerate(method.solver):
        at = f"method.solver[{i}]" if asked.lists_solvers else "method.solver"
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
            words = f"a series has 1 to {MOST_HARMONICS} waves, from first on; use another last, or another first"
            yield "profile.spectrum.last", words
        if asked.kind != "map":
            yield "profile.spectrum", 'only maps have random roughness; write kind = "map", or give harmonics'
    single = not table.file and not spectrum and len(table.harmonics or (1,)) == 1
    if asked.given("a_max_over_a2") and not (single and shape_of(table) == Profile()):
        words = "only one cosine on a paraboloid has a radius a_2; give a_max_over_R, or remove [profile]"
        yield "parameters.a_max_over_a2", words


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
    drawn = any(CURVES[curve].of_a_state for curve in map(_curve_of, asked.form.outputs) if curve)
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
