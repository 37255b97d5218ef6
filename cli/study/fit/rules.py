"""What the keys of a fit have to do with each other: for each rule where it is broken, and what to write instead."""

import math
from typing import Any, Final

import numpy as np

from gradhesion.cli.study.fit.columns import is_force_file
from gradhesion.cli.study.rules.asked import Asked, Found, home
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.inputs import inputs, rate, together, toughness, waves, works
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.rules.mistakes import line_of, required
from gradhesion.core.problem.inputs import INPUTS

LINEAR: Final = ("k", "nu", "indentation_max", "closing_ratio", "toughness_amplitude", "exponent")
"""What is searched as it is, so that its range may begin at 0; all else is by its logarithm."""
NUMBER_ALONE: Final = ("adhesion_range",)
"""What no loop depends on, and is a number."""
ONE_NUMBER: Final = ("E_star", "E", "c0", "nu")
"""What acts on a loop through one number."""
_SPEEDS: Final = ("speed", "reference_speed")
"""The speeds whose ratio counts."""
_DEPTHS: Final = ("indentation", "displacement")
"""The columns of depths, of the contact or of a machine."""


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
    if not asked.right("kind") or "physical" not in asked.data:
        return
    for rule in (together, inputs, waves, _profile, _columns, _machine, works, toughness, rate, _searched):
        yield from rule(asked)


def _profile(asked: Asked) -> Found:
    """Check that the punch is one that a loop is drawn of."""
    for name in ("file", "spectrum", "sha256", "terms", "up_to"):
        if asked.has(f"profile.{name}"):
            yield f"profile.{name}", "a loop has one punch; give the harmonics that `gradhesion profile` prints"


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
        table, key = (INPUTS[name].table, name) if name in INPUTS else ("rate", name)
        at = f"{table}.{key}"
        if isinstance(entry, list):
            yield at, "a fit has no axes: write a number, which is fixed, or a range { start, stop }, which is searched"
        elif not isinstance(entry, Range):
            continue
        elif {*asked.data[table][key]} != {"start", "stop"}:
            yield at, "a searched range has start and stop, and nothing else; remove the other keys"
        elif name in NUMBER_ALONE:
            yield at, f"no loop depends on it; give it as a number, {INPUTS[name].example}"
        elif entry.start >= entry.stop:
            yield at, "the stop of a searched range is above its start; exchange the two, or give a number"
        elif entry.start <= 0.0 and name not in LINEAR:
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
    if {*_SPEEDS} <= {*free}:
        yield home(_SPEEDS[1]), "a loop depends on the ratio of the two speeds alone; give one of them as a number"
