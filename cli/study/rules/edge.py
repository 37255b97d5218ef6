"""What the edge of a contact meets: unequal works, a toughness that varies with the radius, a speed."""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli.names.outputs import SI
from gradhesion.cli.study.rules.asked import Asked, curve_of
from gradhesion.cli.study.rules.axes import Found, home
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import CURVES, OUTPUTS
from gradhesion.core.problem.toughness import MOST_WAVES, violation

_MOST_AMPLITUDES: Final = 1000
"""Different amplitudes of points up to which each is looked at."""


def works(asked: Asked) -> Found:
    """Check that no edge closes at more work than it opens at, and that it turns."""
    key = "work_of_adhesion_closing"
    if asked.given(key) and not asked.given("work_of_adhesion"):
        words = "it closes at this work and opens at work_of_adhesion; write for example "
        yield home(key), words + INPUTS["work_of_adhesion"].example
    elif {key, "work_of_adhesion"} <= asked.values.keys() and not asked.given("closing_ratio"):
        closing, opening = (np.atleast_1d(asked.values[name]) for name in (key, "work_of_adhesion"))
        together = asked.points and (1 in (closing.size, opening.size) or closing.size == opening.size)
        above = np.any(closing > opening) if together else not asked.points and closing.max() > opening.min()
        if above:
            words = f"an edge cannot close at more work than it opens at, but {closing.max():g} J/m^2 exceeds "
            yield home(key), f"{words}{opening.min():g} J/m^2; lower it, or raise work_of_adhesion"
    if asked.turns or not (asked.given(key) or asked.given("closing_ratio")) or asked.ends:
        return
    wrong = asked.checked.wrong  # and perhaps the radius of the punch
    if ("outputs",) in wrong or any(path[-1] == "a_max" or path[0] == "parameters" for path in wrong):
        return
    if "closing_ratio" in asked.values and np.all(np.asarray(asked.values["closing_ratio"]) == 1.0):
        return
    wanted = [(f"outputs[{i}]", name) for i, name in enumerate(asked.form.outputs)]
    if asked.form.optimum is not None:
        wanted = [(f"optimum.{way}", name) for way, name in asked.form.optimum.goals]
    for at, name in wanted:
        own = OUTPUTS.get(name.removesuffix(SI))
        if own and own.needs_turn:
            words = (
                f"an unbounded punch that does not turn opens from ever larger radii, and {own.about.split(',')[0]} "
            )
            words += f"has no bound where it closes at less work; give {asked.turn} or a finite radius of the punch"
            yield at, f"{words}, or remove this output"
            return


def _needs_table(asked: Asked, table: str, line: str) -> Found:
    """Say which inputs have no effect without a table, and what the table needs."""
    names = [name for name, own in INPUTS.items() if own.group == table and name != "toughness_amplitude"]
    if table not in asked.checked.data:
        for name in (*names, *(("toughness_amplitude",) if table == "toughness" else ())):
            if asked.given(name):
                words = f"without [{table}] this has no effect; remove it, or add a table [{table}] with {line}"
                yield home(name), words
    elif isinstance(asked.checked.data[table], Mapping) and not any(
        asked.meant(name) for name in names if name != "reference_speed"
    ):
        own = INPUTS[names[0] if asked.units else names[-1]]
        yield table, f"it needs {own.example} under [{own.table}]; add it, or remove [{table}]"


def toughness(asked: Asked) -> Found:
    """Check a pattern of toughness: its keys, each wave once, and its sign everywhere on the punch."""
    yield from _needs_table(asked, "toughness", "harmonics = [{ n = 1, cos = 0.2 }]")
    if (table := asked.form.toughness) is None:
        return
    twice = list(each_once("toughness", {i: {"n": wave.n} for i, wave in enumerate(table.harmonics)}))
    if twice:
        yield twice[0]
        return
    if "rate" in asked.checked.data:
        words = "a toughness that varies with the radius cannot be combined with a speed"
        yield "toughness", f"{words}; remove [toughness] or [rate]"
    known = [name for name, curve in CURVES.items() if curve.knows_pattern]
    for i, name in enumerate(asked.form.outputs if asked.kind == "curve" else ()):
        if curve_of(name) not in known:
            yield f"outputs[{i}]", f"with [toughness] the only curves are {', '.join(known)}; remove this one"
    yield from _sign(asked)


def _sign(asked: Asked) -> Found:
    """Check that the toughness is not negative, and the work positive, anywhere on a punch."""
    length, rim = ("toughness_wavelength", "a_max") if asked.units else ("toughness_wavelength_over_R", "a_max_over_R")
    if length not in asked.values:
        return
    pattern, key = asked.form.toughness.made(), "toughness_amplitude"
    given = (asked.values.get(key, 1.0), asked.values[length], asked.values.get(rim, math.inf))
    amplitudes, wavelengths, rims = map(np.atleast_1d, given)
    if asked.points:
        if len({one.size for one in (amplitudes, wavelengths, rims)} - {1}) > 1:
            return  # which is said of the lists
        amplitudes, wavelengths, rims = np.broadcast_arrays(amplitudes, wavelengths, rims)
    unique = np.unique(amplitudes)
    each = asked.points and unique.size <= _MOST_AMPLITUDES
    for amplitude in (unique if each else np.unique(unique[[0, -1]])).tolist():
        own = amplitudes == amplitude if each else np.ones(amplitudes.size, bool)
        least = float((wavelengths[own] if asked.points else wavelengths).min())
        end = float((rims[own] / wavelengths[own]).max()) * least if asked.points else float(rims.max())
        radius = violation(pattern, amplitude, least, end)
        if radius is not None:
            what = {"toughness": "toughness is negative", "work": "work of adhesion is not positive"}[pattern.of]
            said = f"{key} = {amplitude:g}" if key in asked.values else "these waves"
            words = f"with {said} the {what} at the radius {radius:.6g}{' m' if asked.units else ' R'}"
            yield home(key) if key in asked.values else "toughness.harmonics", f"{words}; use smaller waves"
            return


def rate(asked: Asked) -> Found:
    """Check the law of a moving edge: its keys, what drives it, and what is known of it."""
    form = asked.form
    yield from _needs_table(asked, "rate", "exponent = 0.6")
    if "rate" in asked.checked.data and not asked.sound("rate"):
        return
    for i, name in enumerate(form.outputs):
        own, curve = OUTPUTS.get(name), curve_of(name)
        if form.rate is None and own and own.needs == "rate":
            yield f"outputs[{i}]", "this belongs to an edge with a speed; add a table [rate], or remove it"
        known = not own or not (own.is_count or own.group in ("report", "sensitivity"))
        if form.rate is not None and not (known and (not curve or CURVES[curve].knows_rate)):
            yield f"outputs[{i}]", "this is not available for an edge with a speed; remove it, or remove [rate]"
    if form.rate is None:
        return
    if asked.given("speed") != asked.given("reference_speed"):
        there, absent = ("speed", "reference_speed") if asked.given("speed") else ("reference_speed", "speed")
        yield home(there), f"the two speeds go together; add {INPUTS[absent].example} under [physical]"
    if form.loading.control == "load":
        words = 'under a falling load the energy of this law has no bound; write control = "machine" with a soft spring'
        yield "loading.control", f"{words}, or remove [rate]"
    if form.rate.closing == "same":
        for name in ("closing_ratio", "work_of_adhesion_closing"):
            if np.any(np.asarray(asked.values.get(name, 1.0)) == 0.0):
                words = 'without adhesion on approach there is no such law; write closing = "quasi-static"'
                yield home(name), f"{words}, or a larger value"
        for name in asked.turns:
            if INPUTS[name].gives == "load_max":
                yield home(name), f'with closing = "same" a cycle turns at a depth; give {asked.turn} instead'
    lengths = ("wavelength", "a_max") if asked.units else ("lambda_over_R", "a_max_over_R")
    waved = any(np.any(np.asarray(asked.values.get(name, 0.0)) != 0.0) for name in ("A", "chi", "amplitude"))
    if waved and {*lengths} <= asked.values.keys() and not asked.turns:
        longest, least = float(np.max(asked.values[lengths[0]])), float(np.min(asked.values[lengths[1]]))
        count = least / longest * max((wave.n for wave in form.profile.harmonics or ()), default=1)
        if MOST_WAVES < count < math.inf:
            words = (
                f"{count:,.0f} waves within the punch are more than the {MOST_WAVES:,.0f} that can be followed at a "
            )
            yield home(lengths[1]), words + "speed; use a smaller punch or longer waves"
    if not asked.ends and not asked.checked.wrong:
        words = f"an edge with a speed opens from a radius; give {asked.turn} or a finite radius of the punch"
        yield "rate", words


def each_once(table: str, series: Mapping[int, Mapping[str, Any]]) -> Found:
    """Check that no wave of a series is given twice."""
    first: dict[int, int] = {}
    for i, wave in series.items():
        if wave["n"] in first:
            words = f"the wave n = {wave['n']} is given already, as item {first[wave['n']]}; join the two"
            yield f"{table}.harmonics[{i}].n", words
        first.setdefault(wave["n"], i)
