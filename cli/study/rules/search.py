"""What is asked beyond scenes: what is sought, and how far inputs may be off."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from gradhesion.cli.names.outputs import OF_LINEAR, SI, SPREADABLE
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.rules.asked import Asked
from gradhesion.cli.study.rules.axes import Found, home
from gradhesion.cli.study.rules.mistakes import example, line_of
from gradhesion.cli.terminal.wording import did_you_mean, nearest, shown
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import SENSITIVITIES
from gradhesion.core.problem.outputs import OUTPUTS

MOST_SEARCHED: Final = 3
"""Inputs that are searched at once: a sweep has a power of the resolution."""
MOST_POINTS: Final = 2**24
"""Points of the sweep of one cell: all are in memory."""


def uncertain(asked: Asked) -> Found:
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


def search(asked: Asked) -> Found:
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
