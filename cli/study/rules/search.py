"""What is asked beyond scenes: what is sought, and how far inputs may be off."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from gradhesion.cli.names.outputs import OF_LINEAR, SI, SPREADABLE
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.rules.asked import Asked, Found, home
from gradhesion.cli.study.rules.form import Optimum
from gradhesion.cli.study.rules.mistakes import line_of, required
from gradhesion.cli.study.text.written import steps_of
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
    own = table.deviations
    if not own and asked.right("uncertainty"):
        yield "uncertainty", 'no input is uncertain; add for example modulus = "5 %", or remove [uncertainty]'
    for name, one in own.items():
        at, values = f"uncertainty.{name}", np.atleast_1d(asked.values.get(name, 1.0))
        if not asked.meant(name):
            kin = next((other for other in form.entries if INPUTS[other].gives == INPUTS[name].gives), name)
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


def search(asked: Asked) -> Found:
    """Check that what is sought goes together with the rest of a study."""
    table, method = asked.form.optimum, asked.form.method
    if asked.kind != "optimum" or table is None:
        if asked.kind == "optimum" and "optimum" not in asked.data:
            yield "optimum", required("optimum")
        return
    yield from _goals(asked, table)
    if asked.right("optimum.over"):
        yield from _over(asked, table)
    known = tuple(name for name in OUTPUTS if name not in SENSITIVITIES)
    for word in ("minimum", "maximum"):
        for name, value in getattr(table.require, word).items():
            if name not in known:
                yield f"optimum.require.{word}.{name}", f"not an output; {did_you_mean(name, known)}"
            elif word == "maximum" and table.require.minimum.get(name, value) > value:
                yield f"optimum.require.maximum.{name}", "the maximum is below the minimum; exchange the two"
    if table.require.one_disc and (method.solver != ["exact"] or not method.check_contact):
        yield "optimum.require.one_disc", "this needs the exact solver and check_contact = true; change [method]"
    if asked.lists_solvers:
        yield "method.solver", "an optimum has one solver; choose one of these"


def _goals(asked: Asked, table: Optimum) -> Found:
    """Check that one goal or two are named, each an output with one value a scene."""
    ways, goals = ("optimum.maximise", "optimum.minimise"), table.goals
    if not goals and asked.right(*ways) and not {*map(steps_of, ways)} & {*asked.misspelt}:
        yield ways[0], f"there is no goal; write for example {line_of('optimum', 'maximise')}"
    if len(goals) > 2:
        yield ways[len(table.maximise) < 3], "at most two goals are possible; remove the others"
    known = [*SPREADABLE, "contact_slope", *(name + SI for name in SPREADABLE if name in UNITS and asked.units)]
    for i, name in enumerate(goals):
        way = ways[i >= len(table.maximise)]
        if name in goals[:i]:
            yield way, f"{shown(name)} is named twice; remove one of the two"
        elif name not in known:
            yield way, f"{shown(name)} cannot be a goal (counts cannot); {did_you_mean(name, known)}"


def _over(asked: Asked, table: Optimum) -> Found:
    """Check that all that is searched has bounds, and that the other axes have values."""
    if not table.over:
        yield "optimum.over", f"no input is searched; write for example {line_of('optimum', 'over')}"
    for i, name in enumerate(table.over):
        at, entry = f"optimum.over[{i}]", asked.at(home(name)) if name in INPUTS else None
        if name in table.over[:i]:
            yield at, "this input is named twice; remove one of the two"
        elif entry is None and not (name in INPUTS and asked.meant(name)):
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
