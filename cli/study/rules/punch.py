"""The punch and its loading: which profiles and controls are allowed, and what goes with them."""

from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli.keys import MACHINE, SPRING, Path
from gradhesion.cli.names.curves import CURVES
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.form.profile import ProfileTable
from gradhesion.cli.terminal.wording import did_you_mean, example
from gradhesion.core.answers.spectrum import Spectrum, random_profile
from gradhesion.core.problem.control import CONTROLS
from gradhesion.core.problem.names import WITHOUT_LOAD
from gradhesion.core.problem.outputs import CURVES as DECLARED
from gradhesion.core.problem.profile import MOST_HARMONICS, Harmonic, Profile

_SERIES: Final[Path] = ("profile", "harmonics")
_SPECTRUM: Final[Path] = ("profile", "spectrum")
_CONTROL: Final[Path] = ("loading", "control")


def spectrum_of(table: ProfileTable) -> Spectrum | None:
    """Make the random roughness of the punch; None if it has none, or none that can be drawn."""
    try:
        return Spectrum(**dict(table.spectrum)) if table.spectrum else None
    except ValueError:  # which mistakes_of_punch reports
        return None


def profile_of(table: ProfileTable) -> Profile:
    """
    Make the shape of the punch; of random roughness the first.

    >>> profile_of(ProfileTable.model_validate({"harmonics": [{"n": 2, "sin": 0.5}]})).harmonics
    (Harmonic(n=2, cos=0.0, sin=0.5),)
    """
    exponent = 2.0 if isinstance(table.exponent, str) else table.exponent  # of a file, which is fitted
    if (spectrum := spectrum_of(table)) is not None:
        return random_profile(spectrum, 0, exponent)
    if table.harmonics is None:
        return Profile(exponent=exponent)
    waves = (Harmonic(n=wave.n, cos=wave.cos, sin=wave.sin) for wave in table.harmonics)
    return Profile(exponent=exponent, harmonics=tuple(waves))


def mistakes_of_punch(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the profile, the control, and what is asked of them."""
    series = list(mistakes_of_series(checked, sound))
    yield from series
    yield from _mistakes_without_a_file(checked)
    yield from _mistakes_of_spectrum(checked)
    yield from _mistakes_of_control(checked)
    yield from _mistakes_of_default_only(checked, sound_series=not series)


def mistakes_of_series(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the waves of a profile: each n once, and not all of them zero if A is not."""
    wrong = {mistake.path[:3] for mistake in checked.mistakes}
    if _SERIES in wrong or ("profile",) in checked.wrong:
        return
    waves: list[Any] = (checked.data.get("profile") or {}).get("harmonics", [])
    first: dict[int, int] = {}
    sizes = []
    for i, wave in enumerate(waves):
        if (*_SERIES, i) in wrong:
            sizes.append(1.0)  # not known
            continue
        if wave["n"] in first:
            sentence = f"the wave n = {wave['n']} is given already, as item {first[wave['n']]}; join the two"
            yield Mistake((*_SERIES, i, "n"), wave["n"], sentence)
        first.setdefault(wave["n"], i)
        sizes += [abs(wave[name]) for name in ("cos", "sin") if name in wave] or [1.0]
    for name in ("A", "chi", "amplitude"):
        if sizes and max(sizes) == 0.0 and name in sound and np.any(np.asarray(sound[name]) > 0.0):
            sentence = f"all cos and sin are zero, so that {name} has no effect; give one a value, or use {name} = 0"
            yield Mistake(_SERIES, waves, sentence)


def _mistakes_of_spectrum(checked: Checked) -> Iterator[Mistake]:
    """Check random roughness: its waves can be drawn, and it stands alone, in a map."""
    table = checked.form.profile.spectrum
    if table is None or _SPECTRUM in checked.wrong:
        return
    written = checked.data["profile"]
    first, last = table.first, table.last
    if first > last:
        sentence = f"the shortest wave comes before the longest, first = {first}; use last = {first} or more"
        yield Mistake((*_SPECTRUM, "last"), last, sentence)
    elif last - first + 1 > MOST_HARMONICS:
        sentence = f"{last - first + 1:,} waves, but a series has at most {MOST_HARMONICS}; use last = "
        yield Mistake((*_SPECTRUM, "last"), last, f"{sentence}{first + MOST_HARMONICS - 1}, or a larger first")
    for other in ("harmonics", "file"):
        if other in written:
            sentence = f"the waves come from spectrum; remove {other}, or remove spectrum"
            yield Mistake(("profile", other), written[other], sentence)
    if checked.form.kind == "curve":
        sentence = 'random roughness is available only in maps; write kind = "map", '
        sentence += "or give harmonics to draw the curves of one punch"
        yield Mistake(_SPECTRUM, dict(table), sentence)


def _mistakes_without_a_file(checked: Checked) -> Iterator[Mistake]:
    """Check that what goes with a file stands beside one."""
    table = checked.data.get("profile")
    if not isinstance(table, Mapping) or "file" in table or ("profile", "file") in checked.meant:
        return
    for name in ("sha256", "terms", "up_to"):
        if name in table and ("profile", name) not in checked.wrong:
            yield Mistake(("profile", name), table[name], f"this key needs a file; add file, or remove {name}")
    if table.get("exponent") == "fit":
        sentence = "there is no file to fit it to; add file, or write for example exponent = 2.0"
        yield Mistake(("profile", "exponent"), "fit", sentence)


def _mistakes_of_control(checked: Checked) -> Iterator[Mistake]:
    """Check the control of the loading, and that one stiffness of a machine goes with it alone."""
    if _CONTROL in checked.wrong:
        return
    control, with_units = checked.form.loading.control, "physical" in checked.data
    keys: tuple[Path, ...] = (("loading", MACHINE), ("physical", SPRING))
    given = [path for path in keys if path not in checked.wrong and path[1] in checked.form.entries]
    if control not in CONTROLS:
        yield Mistake(_CONTROL, control, f"not a control; {did_you_mean(control, CONTROLS)}")
    elif control == "machine" and not given and not checked.wrong & {*keys}:
        key = f"{example(keys[1])} under [physical]" if with_units else f"add {MACHINE} = 10.0 to [loading]"
        yield Mistake(_CONTROL, control, f"a machine needs its stiffness {'S' if with_units else 'S/(E* R)'}; {key}")
    elif control == "machine":
        for path in given[1:]:
            sentence = f"{MACHINE} gives the stiffness of the machine already; keep one of the two and remove the other"
            yield Mistake(path, checked.data[str(path[0])][path[1]], sentence)
    else:
        for path in given:
            sentence = (
                f'control = "{control}" has no machine; remove this key, or write control = "machine" under [loading]'
            )
            yield Mistake(path, checked.data[str(path[0])][path[1]], sentence)


def _mistakes_of_default_only(checked: Checked, *, sound_series: bool) -> Iterator[Mistake]:
    """Check that another profile or control is asked for only where it is known."""
    form = checked.form
    others = ["[profile]"] if sound_series and (form.profile.file or profile_of(form.profile) != Profile()) else []
    others += ["[loading]"] if form.loading.control in CONTROLS[1:] else []
    if not others:
        return
    special = {name: one for one, own in CURVES.items() if DECLARED[one].needs_depth for name in (one, *own)}
    for i, name in enumerate(form.outputs):
        if name in special and form.kind == "curve" and "[loading]" in others:
            why = WITHOUT_LOAD.get(special[name], WITHOUT_LOAD["envelope"])
            sentence = f"this curve is available only under displacement control: {why}; remove it, or remove [loading]"
            yield Mistake(("outputs", i), name, sentence)
        if name == "energy_residual" and form.loading.control == "load":
            sentence = 'under dead load the cycle is not closed; remove this output, or write control = "machine"'
            yield Mistake(("outputs", i), name, sentence)
    for one in form.method.solvers:
        if one in WITHOUT_LOAD and "[loading]" in others:
            sentence = f'the solver "{one}" is available only under displacement control: {WITHOUT_LOAD[one]}; '
            sentence += 'write solver = "exact", or remove [loading]'
            yield Mistake(("method", "solver"), form.method.solver, sentence)
    if "[profile]" in others and "a_max_over_a2" in form.entries:
        sentence = (
            "a_2 is defined only for one cosine on a paraboloid; give a_max_over_R or a_max_over_L, or remove [profile]"
        )
        yield Mistake(("parameters", "a_max_over_a2"), checked.data["parameters"]["a_max_over_a2"], sentence)
