"""What the keys of a study have to do with each other: for each rule where it is broken, and what to write instead."""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli.study.rules.asked import Asked, curve_of
from gradhesion.cli.study.rules.axes import Found, Values, home, repeated
from gradhesion.cli.study.rules.edge import each_once, rate, toughness, works
from gradhesion.cli.study.rules.form import OUTPUTS_OF
from gradhesion.cli.study.rules.search import search, uncertain
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.control import CONTROLS
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL, REDUCED, Input
from gradhesion.core.problem.names import GIVEN_UP, SOLVERS, WITHOUT_LOAD
from gradhesion.core.problem.outputs import CURVES, OUTPUTS
from gradhesion.core.problem.profile import MOST_HARMONICS, Profile

MOST_SCENES: Final = {"map": 2**31, "curve": 1_000, "optimum": 2**31, "pareto": 100_000}
"""Scenes of one study: beyond, a dataset is no longer one file; curves are for looking at; fronts are in memory."""
_KIN: Final = {
    name: [kin for kin, its in INPUTS.items() if its.gives == name]
    for name, own in INPUTS.items()
    if own.is_parameter and name not in ("k", "nu")
}
"""The inputs that give each parameter, but for those that only it can give."""
MAY_MIX: Final = ("A", "closing_ratio", "machine_stiffness")
"""The ratios that may stand beside quantities with units."""


def broken(asked: Asked) -> Found:
    """List what is wrong between the keys of a study of scenes."""
    for rule in (_outputs, _method, _axes, search, inputs, _punch, works, toughness, rate, _states, _range,
                 uncertain, _size):  # fmt: skip
        yield from rule(asked)


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
        curve = curve_of(name)
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
    for name, kin in _KIN.items():
        if not INPUTS[name].group or any(map(asked.given, kin)):
            yield from _ways(asked, INPUTS[name])
    turns = asked.turns
    for name in turns[1:]:
        yield home(name), f"a cycle turns at one depth or load, and {turns[0]} gives it already; remove one of the two"


def _ways(asked: Asked, own: Input) -> Found:
    """Check the inputs that give one parameter."""
    physical = [name for name in _KIN[own.name] if name in PHYSICAL]
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
        reduced = [name for name in _KIN[own.name] if name in REDUCED]
        united = [one for one in physical if INPUTS[one].follows] if asked.units else []
        ways = [[*united, *reduced] if apart else [own.name, *reduced, *united]]
    for names in ways:
        given = [name for name in names if asked.given(name)]
        for name in given[1:]:
            yield home(name), f"{given[0]} gives this already; keep one of the two and remove the other"
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
    yield from each_once("profile", right)
    sizes = [abs(wave.get(name, 0.0)) for wave in right.values() for name in ("cos", "sin")]
    waved = [name for name in ("A", "chi", "amplitude") if np.any(np.asarray(asked.values.get(name, 0.0)) > 0.0)]
    given = all({"cos", "sin"} & wave.keys() for wave in right.values())
    if given and len(right) == len(written) and waved and max(sizes, default=1.0) == 0.0:
        words = f"all cos and sin are zero, so that {waved[0]} has no effect; give one a value, or use {waved[0]} = 0"
        yield "profile.harmonics", words


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
    series_only = not form.profile.file and spectrum is None
    if "a_max_over_a2" in form.entries and not (series_only and (series or shape_of(form.profile) == Profile())):
        words = "a_2 is defined only for one cosine on a paraboloid; give a_max_over_R or a_max_over_L"
        yield "parameters.a_max_over_a2", f"{words}, or remove [profile]"
    load = form.loading.control in CONTROLS[1:]
    for i, name in enumerate(form.outputs):
        curve = curve_of(name) if asked.kind == "curve" else ""
        if load and curve and CURVES[curve].needs_depth:
            why = WITHOUT_LOAD.get(curve, WITHOUT_LOAD["envelope"])
            words = f"this curve is available only under displacement control: {why}; remove it, or remove [loading]"
            yield f"outputs[{i}]", words
        if name == "energy_residual" and form.loading.control == "load":
            words = 'under dead load the cycle is not closed; remove this output, or write control = "machine"'
            yield f"outputs[{i}]", words


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


def _states(asked: Asked) -> Found:
    """Check that the radii of states are drawn, differ, and lie within every punch."""
    radii, at = asked.form.states.contact_radius_over_R or [], "states.contact_radius_over_R"
    drawn = any(curve and CURVES[curve].of_a_state for curve in map(curve_of, asked.form.outputs))
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
