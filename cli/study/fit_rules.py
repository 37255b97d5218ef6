"""What the keys of a fit have to do with each other, in sentences that say what to write instead."""

from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli.keys import INPUTS, SPRING, TURNS, keys_of
from gradhesion.cli.study.axes import Values
from gradhesion.cli.study.fit_form import AT_THE_TOP, FitForm, Search
from gradhesion.cli.study.mistakes import Checked, Mistake
from gradhesion.cli.study.punch import mistakes_of_series
from gradhesion.cli.study.roles import mistakes_of_roles
from gradhesion.cli.terminal.wording import example

ONE_NUMBER: Final = ("E_star", "E", "c0", "nu")
"""What acts on a loop through one number."""
_INSTEAD: Final = {
    "outputs": "a fit gives the parameters that have a range; remove this key",
    "layout": "a fit has no scenes; remove this key",
    "loading": "the cycle is under controlled depth, or through a machine where [data] has displacement; remove this",
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
        if not isinstance(entry, str) and (INPUTS[name].table, name) not in checked.wrong
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
    own = [name for name in form_of(checked).entries if INPUTS[name].gives in TURNS]
    for name in own:
        if INPUTS[name].table == "parameters":
            sentence = 'a ratio, where [physical] has units; write indentation_max = "data" or preload there'
            yield Mistake(("parameters", name), checked.data["parameters"][name], sentence)
    united = [name for name in own if INPUTS[name].table == "physical"]
    for name in united[1:]:
        sentence = f"a cycle turns at one depth or load, and {united[0]} gives it already; remove one of the two"
        yield Mistake(("physical", name), checked.data["physical"][name], sentence)


def _mistakes_of_data(checked: Checked) -> Iterator[Mistake]:
    """Check that depths come from one column, and that a machine has its stiffness."""
    form, wrong = form_of(checked), checked.wrong
    table = checked.data.get("data")
    if ("data",) in wrong or not isinstance(table, Mapping):
        return
    given = [name for name in ("indentation", "displacement") if name in table]
    if not given:
        yield Mistake(
            ("data", "indentation"), None, f"the column of the depths is required; {example(('data', 'indentation'))}"
        )
    elif len(given) == 2:
        sentence = "indentation gives the depths already; remove one of the two"
        yield Mistake(("data", "displacement"), table["displacement"], sentence)
    through_machine = given == ["displacement"]
    spring = SPRING in form.entries
    if through_machine and not spring and ("physical", SPRING) not in wrong:
        sentence = f"the displacement of a machine is depth + load/stiffness; {example(('physical', SPRING))}"
        yield Mistake(("physical", SPRING), None, f"{sentence}, or a range that is searched")
    if spring and not through_machine:
        sentence = "the data have depths, on which a machine has no effect; remove it, or name a column displacement"
        yield Mistake(("physical", SPRING), checked.data["physical"][SPRING], sentence)
    noise = form.fit.noise
    if noise is not None and given and given[0] not in noise:
        sentence = f"the data have {given[0]}; give the noise of {given[0]} and of load"
        yield Mistake(("fit", "noise"), checked.data["fit"]["noise"], sentence)


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
