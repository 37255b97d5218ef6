"""What the keys of a fit have to do with each other: for each rule where it is broken, and what to write instead."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

import numpy as np

from gradhesion.cli.study.fit.afm_file import is_force_file
from gradhesion.cli.study.fit.form import DATA, FitForm, Search
from gradhesion.cli.study.rules.asked import Asked, steps_of
from gradhesion.cli.study.rules.axes import Found, home
from gradhesion.cli.study.rules.edge import rate, toughness, works
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.mistakes import Checked, Mistake, example
from gradhesion.cli.study.rules.scenes import inputs, waves
from gradhesion.core.problem.inputs import INPUTS

ONE_NUMBER: Final = ("E_star", "E", "c0", "nu")
"""What acts on a loop through one number."""
_SPEEDS: Final = ("speed", "reference_speed")
"""The speeds whose ratio counts."""
_INSTEAD: Final = {
    "outputs": "a fit gives the parameters that have a range; remove this key",
    "layout": "a fit has no scenes; remove this key",
    "states": "a fit draws no states; run a curve study with what it finds, and remove this table",
    "method": "a loop is fitted by the exact solver; remove this table",
}
"""What to do about the keys of other kinds."""


def sound_keys(data: Mapping[str, Any]) -> tuple[dict[str, Any], list[Mistake]]:
    """Leave out the keys of studies of other kinds, with what is wrong about them."""
    others = [name for name in data if name in Form.model_fields and name not in FitForm.model_fields]
    sentence = "a fit does not use this key; remove it"
    mistakes = [Mistake((name,), data[name], _INSTEAD.get(name, sentence)) for name in others]
    return {name: value for name, value in data.items() if name not in others}, mistakes


def control_of(form: FitForm) -> str:
    """Give what is prescribed in the measured cycle: the depth, unless the study or its columns say otherwise."""
    if "control" in form.loading.model_fields_set:
        return str(form.loading.control)
    return "machine" if form.data.displacement else "displacement"


def broken(checked: Checked) -> Found:
    """List what is wrong between the keys of a fit."""
    form = checked.form
    values = {
        name: np.array([entry.start, entry.stop]) if isinstance(entry, Search) else float(entry)
        for name, entry in form.entries.items()
        if name in INPUTS and not isinstance(entry, str) and (INPUTS[name].table, name) not in checked.wrong
    }
    asked = Asked(checked=checked, values=values, written=checked.data)
    if ("physical",) not in checked.wrong:
        ratio = home("speed_over_reference")  # of which a loop depends alone
        alone = not any(asked.given(name) for name in _SPEEDS)
        found = (one for one in inputs(asked) if steps_of(one[0]) not in checked.wrong)
        yield from (one for one in found if not (alone and one[0] == ratio))
    for name in ("k", "nu"):
        if name not in form.entries and not {("parameters", name), ("parameters",)} & checked.wrong:
            yield home(name), f"this key is required; write for example {name} = 0.3"
    yield from waves(asked)
    yield from _profile(checked)
    for name in asked.turns:
        if INPUTS[name].table == "parameters" and not asked.units:
            yield (
                home(name),
                'a ratio, where a fit has units; write indentation_max = "data" or preload under [physical]',
            )
    yield from _columns(checked)
    yield from _machine(checked)
    yield from _edge(asked)
    yield from _searched(checked, form.entries)


def _profile(checked: Checked) -> Found:
    """Check that the punch is one that a loop is drawn of."""
    for name in ("file", "spectrum", "sha256", "terms", "up_to"):
        if checked.has("profile", name):
            words = "a fit needs harmonics; write the table that `gradhesion profile FILE.csv` prints instead"
            several = "a spectrum draws many punches, and a loop belongs to one; give its harmonics"
            yield f"profile.{name}", several if name == "spectrum" else words
    if checked.form.profile.exponent == "fit":
        yield "profile.exponent", "there is no file to fit it to; write a number"


def _columns(checked: Checked) -> Found:
    """Check that depths and loads come from one column each."""
    form = checked.form
    if ("data",) in checked.wrong or not isinstance(checked.data.get("data"), Mapping):
        return
    columns = [name for name in ("indentation", "displacement") if checked.has("data", name)]
    alone = is_force_file(form.data.file, form.data) and not columns and not checked.has("data", "load")
    if not alone and not columns:
        yield "data.indentation", f"the column of the depths is required; {example(('data', 'indentation'), FitForm)}"
    if not alone and not checked.has("data", "load"):
        yield "data.load", f"this key is required; {example(('data', 'load'), FitForm)}"
    if len(columns) == 2:
        yield "data.displacement", "indentation gives the depths already; remove one of the two"
    if form.data.leave_out and not checked.has("data", "branch") and not alone:
        yield "data.leave_out", f"rows are left out by the words of a column; {example(('data', 'branch'), FitForm)}"
    depth = columns[0] if columns else "displacement" if control_of(form) == "machine" else "indentation"
    if form.fit.noise is not None and (columns or alone) and depth not in form.fit.noise:
        yield "fit.noise", f"the data have {depth}; give the noise of {depth} and of load"


def _machine(checked: Checked) -> Found:
    """Check that what drives the cycle is what the data have, and that a machine has its stiffness."""
    form, spring = checked.form, "spring_constant"
    columns = [name for name in ("indentation", "displacement") if checked.has("data", name)]
    if len(columns) == 2 or ("loading", "control") in checked.wrong:
        return
    control = control_of(form)
    if checked.has("loading", "machine_stiffness"):
        words = "a ratio, where [physical] has units; give spring_constant there and remove it"
        yield "loading.machine_stiffness", words
    if "loading" in checked.data and control == "machine" and columns == ["indentation"]:
        words = "through a machine the data have its displacement; name that column displacement, or remove this"
        yield "loading.control", words
        return
    if "loading" in checked.data and control != "machine" and columns == ["displacement"]:
        words = 'a displacement is that of a machine; write control = "machine", or name a column indentation'
        yield "loading.control", words
        return
    if control == "machine" and spring not in form.entries and ("physical", spring) not in checked.wrong:
        words = f"the displacement of a machine is depth + load/stiffness; write for example {INPUTS[spring].example}"
        yield home(spring), f"{words}, or a range that is searched"
    if control != "machine" and spring in form.entries:
        words = "the data have depths, on which a machine has no effect; remove it, or name a column displacement"
        yield home(spring), words


def _edge(asked: Asked) -> Found:
    """Check what the edge meets, by the rules of other studies: every cycle that is fitted turns."""
    checked, data = asked.checked, dict(asked.checked.data)
    if asked.units and not asked.turns:
        data["physical"] = {"indentation_max": DATA, **data["physical"]}
    every = replace(asked, checked=replace(checked, data=data))
    key = "work_of_adhesion_closing"
    least = {name: np.min(values) if name == key else np.max(values) for name, values in asked.values.items()}
    yield from works(replace(every, values=least))
    yield from toughness(every)
    yield from rate(every)
    if all(isinstance(checked.form.entries.get(name), Search) for name in _SPEEDS):
        words = "a loop depends on the ratio of the two speeds alone; give one of them as a number"
        yield home(_SPEEDS[1]), words


def _searched(checked: Checked, entries: Mapping[str, Any]) -> Found:
    """Check that something is searched, and that a loop can tell it apart."""
    free = [name for name, entry in entries.items() if isinstance(entry, Search)]
    if not free and not any(path[0] in ("parameters", "physical") for path in checked.wrong):
        words = "no parameter is fitted; give a range to one, as "
        yield "physical", words + 'E_star = { start = "0.1 GPa", stop = "10 GPa" }'
    stiff = [name for name in free if name in ONE_NUMBER]
    for name in stiff[1:]:
        words = f"a loop cannot determine both {stiff[0]} and {name}: it depends on E_star, c0 and nu through one "
        yield home(name), words + "number; give all but one of them as numbers"
    k = entries.get("k")
    if (k.stop if isinstance(k, Search) else k) == 1.0 and entries.get("nu") not in (0.5, None):
        words = "with k = 1 and nu other than 0.5 the surface has no stiffness; use nu = 0.5, or stay below 1"
        yield "parameters.k", words
