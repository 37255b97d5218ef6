"""What the keys of a fit have to do with each other, in sentences that say what to write instead."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Final

import numpy as np

from gradhesion.cli.keys import CLOSING_WORK, INPUTS, SPEED, SPRING, TURNS, keys_of
from gradhesion.cli.study.fit.afm_file import is_force_file
from gradhesion.cli.study.fit.form import AT_THE_TOP, DATA, FitForm, Search
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.rules.edge import mistakes_of_rate, mistakes_of_toughness
from gradhesion.cli.study.rules.punch import mistakes_of_series
from gradhesion.cli.study.rules.roles import is_given, mistakes_of_roles
from gradhesion.cli.study.rules.turn import KEYS as TURN_KEYS
from gradhesion.cli.study.rules.works import mistakes_of_works
from gradhesion.cli.terminal.wording import did_you_mean, example
from gradhesion.core.problem.control import CONTROLS

ONE_NUMBER: Final = ("E_star", "E", "c0", "nu")
"""What acts on a loop through one number."""
_DEPTHS: Final = ("indentation", "displacement")
"""The columns of which one has the depths."""
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
    others = [name for name in data if name in keys_of("") and name not in AT_THE_TOP]
    sentence = "a fit does not use this key; remove it"
    mistakes = [Mistake((name,), data[name], _INSTEAD.get(name, sentence)) for name in others]
    return {name: value for name, value in data.items() if name not in others}, mistakes


def form_of(checked: Checked) -> FitForm:
    """Give the form that a fit was checked by."""
    form: Any = checked.form
    if not isinstance(form, FitForm):
        raise TypeError("not the form of a fit")
    return form


def mistakes_of_fit(checked: Checked) -> Iterator[Mistake]:
    """List what is wrong between the keys of a fit."""
    form = form_of(checked)
    sound: dict[str, Values] = {
        name: np.array([entry.start, entry.stop]) if isinstance(entry, Search) else float(entry)
        for name, entry in form.entries.items()
        if name in INPUTS and not isinstance(entry, str) and (INPUTS[name].table, name) not in checked.wrong
    }
    if ("physical",) not in checked.wrong:
        yield from mistakes_of_roles(checked, sound)
    for name in ("k", "nu"):
        if name not in form.entries and not {("parameters", name), ("parameters",)} & checked.wrong:
            yield Mistake(("parameters", name), None, f"this parameter is required; {_line(name)}")
    yield from mistakes_of_series(checked, sound)
    yield from _mistakes_of_profile(checked)
    yield from _mistakes_of_turn(checked)
    yield from _mistakes_of_data(checked)
    yield from _mistakes_of_machine(checked)
    yield from _mistakes_of_edge(checked, sound)
    yield from _mistakes_of_search(checked, form.entries)


def _line(name: str) -> str:
    """Show a number that would do."""
    return f"write for example {name} = {'0.0' if name == 'k' else '0.3'}"


def _mistakes_of_profile(checked: Checked) -> Iterator[Mistake]:
    """Check that the punch is one that a loop is drawn of."""
    written = checked.data.get("profile")
    for name in ("file", "spectrum", "sha256", "terms", "up_to"):
        if isinstance(written, Mapping) and name in written:
            sentence = "a fit needs harmonics; write the table that `gradhesion profile FILE.csv` prints instead"
            if name == "spectrum":
                sentence = "a spectrum draws many punches, and a loop belongs to one; give its harmonics"
            yield Mistake(("profile", name), written[name], sentence)
    if form_of(checked).profile.exponent == "fit":
        yield Mistake(("profile", "exponent"), "fit", "there is no file to fit it to; write a number")


def _mistakes_of_turn(checked: Checked) -> Iterator[Mistake]:
    """Check that the cycle turns at one depth or load, in units."""
    own = [name for name in form_of(checked).entries if name in INPUTS and INPUTS[name].gives in TURNS]
    for name in own:
        if INPUTS[name].table == "parameters":
            sentence = 'a ratio, where [physical] has units; write indentation_max = "data" or preload there'
            yield Mistake(("parameters", name), checked.data["parameters"][name], sentence)
    united = [name for name in own if INPUTS[name].table == "physical"]
    for name in united[1:]:
        sentence = f"a cycle turns at one depth or load, and {united[0]} gives it already; remove one of the two"
        yield Mistake(("physical", name), checked.data["physical"][name], sentence)


def control_of(form: FitForm) -> str:
    """Give what is prescribed in the measured cycle: the depth, unless the study or its columns say otherwise."""
    if "control" in form.loading.model_fields_set:
        return form.loading.control
    return "machine" if form.data.displacement else "displacement"


def _mistakes_of_data(checked: Checked) -> Iterator[Mistake]:
    """Check that depths and loads come from one column each."""
    form = form_of(checked)
    table = checked.data.get("data")
    if ("data",) in checked.wrong or not isinstance(table, Mapping):
        return
    columns = [name for name in _DEPTHS if name in table]
    alone = is_force_file(form.data.file, form.data) and not columns and "load" not in table
    if not alone:
        if not columns:
            sentence = f"the column of the depths is required; {example(('data', 'indentation'))}"
            yield Mistake(("data", "indentation"), None, sentence)
        if "load" not in table:
            yield Mistake(("data", "load"), None, f"this key is required; {example(('data', 'load'))}")
    if len(columns) == 2:
        sentence = "indentation gives the depths already; remove one of the two"
        yield Mistake(("data", "displacement"), table["displacement"], sentence)
    if form.data.leave_out and "branch" not in table and not alone:
        sentence = f"rows are left out by the words of a column; {example(('data', 'branch'))}"
        yield Mistake(("data", "leave_out"), table["leave_out"], sentence)
    noise = form.fit.noise
    depth = columns[0] if columns else "displacement" if control_of(form) == "machine" else "indentation"
    if noise is not None and (columns or alone) and depth not in noise:
        sentence = f"the data have {depth}; give the noise of {depth} and of load"
        yield Mistake(("fit", "noise"), checked.data["fit"]["noise"], sentence)


def _mistakes_of_machine(checked: Checked) -> Iterator[Mistake]:
    """Check that what drives the cycle is what the data have, and that a machine has its stiffness."""
    form, table = form_of(checked), checked.data.get("data")
    table = table if isinstance(table, Mapping) else {}
    control, columns = control_of(form), [name for name in _DEPTHS if name in table]
    if len(columns) == 2:
        return
    if isinstance(given := checked.data.get("loading"), Mapping):
        if control not in CONTROLS:
            yield Mistake(("loading", "control"), control, f"not a control; {did_you_mean(control, CONTROLS)}")
            return
        if "machine_stiffness" in given:
            sentence = "a ratio, where [physical] has units; give spring_constant there and remove it"
            yield Mistake(("loading", "machine_stiffness"), given["machine_stiffness"], sentence)
        if control == "machine" and columns == ["indentation"]:
            sentence = "through a machine the data have its displacement; name that column displacement, or remove this"
            yield Mistake(("loading", "control"), control, sentence)
            return
        if control != "machine" and columns == ["displacement"]:
            sentence = 'a displacement is that of a machine; write control = "machine", or name a column indentation'
            yield Mistake(("loading", "control"), control, sentence)
            return
    spring = SPRING in form.entries
    if control == "machine" and not spring and ("physical", SPRING) not in checked.wrong:
        sentence = f"the displacement of a machine is depth + load/stiffness; {example(('physical', SPRING))}"
        yield Mistake(("physical", SPRING), None, f"{sentence}, or a range that is searched")
    if spring and control != "machine":
        sentence = "the data have depths, on which a machine has no effect; remove it, or name a column displacement"
        yield Mistake(("physical", SPRING), checked.data["physical"][SPRING], sentence)


def _mistakes_of_edge(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check what the edge meets, by the rules of other studies: every cycle that is fitted turns."""
    turned = dict(checked.data)
    if isinstance(turned.get("physical"), Mapping) and not any(is_given(checked, path) for path in TURN_KEYS):
        turned["physical"] = {"indentation_max": DATA, **turned["physical"]}
    every = replace(checked, data=turned)
    least = {name: np.min(values) if name == CLOSING_WORK else np.max(values) for name, values in sound.items()}
    yield from mistakes_of_works(every, least, points=False)
    yield from mistakes_of_toughness(every, sound, points=False)
    ratio = is_given(checked, ("parameters", SPEED)) and not any(is_given(checked, ("physical", n)) for n in _SPEEDS)
    for mistake in mistakes_of_rate(every, sound):
        if not (ratio and mistake.path == ("parameters", SPEED)) or "rate" not in checked.data:
            yield mistake
    entries = form_of(checked).entries
    if all(isinstance(entries.get(name), Search) for name in _SPEEDS):
        sentence = "a loop depends on the ratio of the two speeds alone; give one of them as a number"
        yield Mistake(("physical", _SPEEDS[1]), checked.data["physical"][_SPEEDS[1]], sentence)


def _mistakes_of_search(checked: Checked, entries: Mapping[str, Any]) -> Iterator[Mistake]:
    """Check that something is searched, and that a loop can tell it apart."""
    free = [name for name, entry in entries.items() if isinstance(entry, Search)]
    wrong = [path for path in checked.wrong if path[0] in ("parameters", "physical")]
    if not free and not wrong:
        sentence = "no parameter is fitted; give a range to one, as "
        yield Mistake(("physical",), None, sentence + 'E_star = { start = "0.1 GPa", stop = "10 GPa" }')
    stiff = [name for name in free if name in ONE_NUMBER]
    for name in stiff[1:]:
        sentence = (
            f"a loop cannot determine both {stiff[0]} and {name}: it depends on E_star, c0 and nu through one number; "
            "give all but one of them as numbers"
        )
        yield Mistake((INPUTS[name].table, name), checked.data[INPUTS[name].table][name], sentence)
    k = entries.get("k")
    if (k.stop if isinstance(k, Search) else k) == 1.0 and entries.get("nu") not in (0.5, None):
        sentence = "with k = 1 and nu other than 0.5 the surface has no stiffness; use nu = 0.5, or stay below 1"
        yield Mistake(("parameters", "k"), checked.data["parameters"]["k"], sentence)
