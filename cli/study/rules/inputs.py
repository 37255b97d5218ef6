"""What the inputs of a scene have to do with each other in every kind of study: each given once, and its edge."""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli.study.rules.asked import Asked, Found, Values, home
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.rules.mistakes import line_of
from gradhesion.cli.study.text.toml import steps_of
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL, REDUCED, Input
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import MOST_WAVES, violation

NEEDS: Final = {
    **dict.fromkeys(("profile.sha256", "profile.terms", "profile.up_to"), "profile.file"),
    "physical.work_of_adhesion_closing": "physical.work_of_adhesion",
}
"""Keys that mean nothing without another one."""
EITHER: Final = {
    "profile.file": ("profile.spectrum",),
    "profile.harmonics": ("profile.spectrum", "profile.file"),
    "toughness": ("rate",),
}
"""Keys that cannot stand beside others."""
_MAY_MIX: Final = ("A", "closing_ratio", "machine_stiffness")
"""The ratios that may stand beside quantities with units."""
_MOST_AMPLITUDES: Final = 1000
"""Different amplitudes of points up to which each is looked at."""


def together(asked: Asked) -> Found:
    """Check the keys that need, or exclude, each other."""
    for key, other in NEEDS.items():
        table, name = steps_of(other)
        if asked.has(key) and not asked.has(other):
            yield key, f"this needs {name}; add {line_of(table, name)} under [{table}], or remove this key"
    for key, others in EITHER.items():
        beside = next(filter(asked.has, others), "")
        if beside and asked.has(key):
            yield key, f"this cannot be combined with {beside}; remove one of the two"
    if asked.form.profile.exponent == "fit" and not asked.has("profile.file"):
        yield "profile.exponent", "there is no file to fit it to; write a number, for example exponent = 2.0"
    k, nu = asked.beside(*(asked.axes.get(name, 0.5) for name in ("k", "nu")))
    if np.any((k == 1.0) & (nu != 0.5)):
        yield "parameters.k", "with k = 1 the surface has no stiffness unless nu = 0.5; use that, or k below 1"


def inputs(asked: Asked) -> Found:
    """Check that each parameter is given once, in the units of the others, and is given where every scene has it."""
    if ("parameters",) in asked.wrong:
        return
    for name, own in INPUTS.items():
        kin = [one for one, its in INPUTS.items() if its.gives == name]
        if own.is_parameter and name not in ("k", "nu") and (not own.group or asked.given(*kin)):
            yield from _ways(asked, own, kin)
    if isinstance(asked.form.entries.get("indentation_max"), str) and asked.kind != "fit":
        yield home("indentation_max"), f"only a fit has data; write for example {INPUTS['indentation_max'].example}"
    first, *others = asked.of("turn") or [""]
    for name in others:
        yield home(name), f"a cycle turns at one depth or load, and {first} gives it already; remove one of the two"


def _ways(asked: Asked, own: Input, kin: list[str]) -> Found:
    """Check the inputs that give one parameter."""
    physical, reduced = ([name for name in kin if name in group] for group in (PHYSICAL, REDUCED))
    idle = own.group in ("toughness", "rate") and own.group not in asked.data
    alone = asked.kind == "fit" and own.group == "rate" and not asked.given(*physical)  # a loop knows the ratio only
    apart = asked.units and own.name not in _MAY_MIX and bool(physical) and not idle and not alone
    if apart and asked.given(own.name):
        there = asked.given(*(name for name in physical if INPUTS[name].follows))
        remedy = f"remove it: {there[0]} is given" if there else f"remove it and give {', '.join(physical)} there"
        yield home(own.name), f"a ratio, where [physical] gives quantities with units; {remedy}, or remove [physical]"
        if own.name != "modulus":
            return
    united = [name for name in physical if INPUTS[name].follows and asked.units]
    ways = [[*united, *reduced] if apart else [own.name, *reduced, *united]]
    if own.name == "modulus" and asked.units:
        ways = [["R"], ["E_star", "E"], ["work_of_adhesion"]]
    for names in ways:
        first, *others = asked.given(*names) or [""]
        for name in others:
            yield home(name), f"{first} gives this already; keep one of the two and remove the other"
        zero, table = own.idle_without, asked.form.uncertainty
        varied = bool(zero) and any(INPUTS[name].gives == zero for name in (table.deviations if table else ()))
        unneeded = bool(zero) and not varied and is_zero(zero, asked.values)
        if own.group or own.name == "a_max_over_R" or asked.given(*names) or unneeded:
            continue
        instead = "".join(f", or instead {INPUTS[name].example} under [{INPUTS[name].table}]" for name in names[1:])
        unless = f"{zero} is uncertain: " if varied else f"unless {zero} = 0 everywhere, " if zero else ""
        yield home(names[0]), f"{unless}this is required; write for example {INPUTS[names[0]].example}{instead}"


def left_out(values: Mapping[str, Values], *, with_units: bool) -> dict[str, float]:
    """Give the inputs that a valid study leaves out, with the values that they then have."""
    given = {INPUTS[name].gives for name in values}
    rim = {} if "a_max_over_R" in given else {"a_max" if with_units else "a_max_over_R": math.inf}
    idle = (name for name, own in INPUTS.items() if name not in given and is_zero(own.idle_without, values))
    return rim | dict.fromkeys(idle, 1.0)


def is_zero(parameter: str, values: Mapping[str, Values]) -> bool:
    """Report whether a parameter is given, and zero everywhere."""
    own = [one for name, one in values.items() if INPUTS[name].gives == parameter]
    return bool(own) and not any(np.any(np.asarray(one)) for one in own)


def shape_of(table: Any) -> Profile:
    """Make the profile of a table that has no file and no spectrum; one of a file is fitted."""
    made: Profile = table.made(exponent=2.0 if table.exponent == "fit" else table.exponent)
    return made


def waves(asked: Asked) -> Found:
    """Check the waves of a profile and of a pattern: each n once, and not all of them zero if the punch has some."""
    for name in ("profile", "toughness"):
        numbers = [wave.n for wave in getattr(asked.form, name).harmonics or ()] if getattr(asked.form, name) else []
        for i, n in enumerate(numbers):
            if n in numbers[:i]:
                yield f"{name}.harmonics[{i}].n", f"item {numbers.index(n)} is the wave n = {n} already; join the two"
    made = [one.made() for one in asked.form.profile.harmonics or ()]
    if made and asked.waved and not any(one.cos or one.sin for one in made):
        yield "profile.harmonics", f"all cos and sin are zero; give one a value, or write {asked.waved[0]} = 0"


def works(asked: Asked) -> Found:
    """Check that no edge closes at more work than it opens at."""
    key, other = "work_of_adhesion_closing", "work_of_adhesion"
    if {key, other} <= asked.values.keys() and not asked.given("closing_ratio"):
        closing, opening = asked.beside(asked.values[key], asked.values[other])
        if (np.all if asked.kind == "fit" else np.any)(closing > opening):
            yield home(key), "an edge cannot close at more work than it opens at; lower it, or raise work_of_adhesion"


def _needs_table(asked: Asked, table: str) -> Found:
    """Say which inputs have no effect without a table, and what the table needs."""
    if table not in asked.data:
        for name in asked.of(table):
            yield home(name), f"without [{table}] this has no effect; remove it, or add {line_of(table)}"
        return
    names = [name for name, own in INPUTS.items() if own.group == table]
    enough = [name for name in names if name not in ("toughness_amplitude", "reference_speed")]
    if not asked.given(*enough):
        own = INPUTS[enough[0] if asked.units else enough[-1]]
        yield table, f"it needs {own.example} under [{own.table}]; add it, or remove [{table}]"


def toughness(asked: Asked) -> Found:
    """Check a pattern of toughness: what gives it, and its sign everywhere on the punch."""
    yield from _needs_table(asked, "toughness")
    table = asked.form.toughness
    if table is None or len({wave.n for wave in table.harmonics}) < len(table.harmonics):
        return
    length, rim = ("toughness_wavelength", "a_max") if asked.units else ("toughness_wavelength_over_R", "a_max_over_R")
    if length not in asked.values:
        return
    key, pattern = "toughness_amplitude", table.made()
    given = (asked.values.get(key, 1.0), asked.values[length], asked.values.get(rim, math.inf))
    amplitudes, wavelengths, rims = asked.beside(*given)
    unique = np.unique(amplitudes).tolist()
    each = len(unique) <= _MOST_AMPLITUDES
    for amplitude in unique if each else (unique[0], unique[-1]):
        own = amplitudes == amplitude if each else slice(None)
        least = float(wavelengths[own].min())
        radius = violation(pattern, amplitude, least, float((rims[own] / wavelengths[own]).max()) * least)
        if radius is not None:
            what = {"toughness": "toughness is negative", "work": "work of adhesion is not positive"}[pattern.of]
            words = f"with the amplitude {amplitude:g} the {what} at {radius:.6g}{' m' if asked.units else ' R'}"
            yield home(key) if key in asked.values else "toughness.harmonics", f"{words}; use smaller waves"
            return


def rate(asked: Asked) -> Found:
    """Check the law of a moving edge: its keys, what drives it, and what is known of it."""
    yield from _needs_table(asked, "rate")
    form = asked.form
    if form.rate is None:
        return
    if asked.kind != "fit" and isinstance(form.rate.exponent, Range):
        yield "rate.exponent", "only a fit searches it; write a number, for example exponent = 0.6"
    for one, other in (("speed", "reference_speed"), ("reference_speed", "speed")):
        if asked.given(one) and not asked.given(other):
            yield home(one), f"the two speeds go together; add {INPUTS[other].example} under [physical]"
    if form.loading.control == "load":
        yield "loading.control", 'with [rate] the energy of a falling load has no bound; write control = "machine"'
    if form.rate.closing == "same":
        everywhere = np.all if asked.kind == "fit" else np.any
        for name in asked.given("closing_ratio", "work_of_adhesion_closing"):
            if everywhere(np.asarray(asked.values.get(name, 1.0)) == 0.0):
                yield home(name), 'closing = "same" needs a value above 0; raise it, or write closing = "quasi-static"'
        for name in asked.given("load_max", "preload"):
            yield home(name), f'with closing = "same" a cycle turns at a depth; give {asked.turn} instead'
    longest, rim = ("wavelength", "a_max") if asked.units else ("lambda_over_R", "a_max_over_R")
    if asked.waved and {longest, rim} <= asked.values.keys() and not asked.turns:
        count = float(np.min(asked.values[rim])) / float(np.max(asked.values[longest]))
        count *= max((wave.n for wave in form.profile.harmonics or ()), default=1)
        if MOST_WAVES < count < math.inf:
            most = f"at a speed up to {MOST_WAVES:,.0f} waves are followed, and the punch has {count:,.0f}"
            yield home(rim), f"{most}; use a smaller punch or longer waves"
    if not asked.ends and not asked.wrong:
        yield "rate", f"an edge with a speed opens from a radius; give {asked.turn} or a finite radius of the punch"
