"""What the edge of a contact meets: unequal works, a toughness that varies with the radius, a speed."""

import math
from collections.abc import Iterable
from typing import Final

import numpy as np

from gradhesion.cli.study.rules.asked import Asked, Found, home
from gradhesion.cli.study.rules.form import Range
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.toughness import MOST_WAVES, violation

_MOST_AMPLITUDES: Final = 1000
"""Different amplitudes of points up to which each is looked at."""
_EXAMPLES: Final = {"toughness": "harmonics = [{ n = 1, cos = 0.2 }]", "rate": "exponent = 0.6"}


def works(asked: Asked) -> Found:
    """Check that no edge closes at more work than it opens at."""
    key, other = "work_of_adhesion_closing", "work_of_adhesion"
    if asked.given(key) and not asked.given(other):
        words = "it closes at this work and opens at work_of_adhesion; write for example "
        yield home(key), words + INPUTS[other].example
    elif {key, other} <= asked.values.keys() and not asked.given("closing_ratio"):
        closing, opening = (np.atleast_1d(asked.values[name]) for name in (key, other))
        if asked.points:
            together = 1 in (closing.size, opening.size) or closing.size == opening.size
            above = together and np.any(closing > opening)
        else:
            above = (closing.min() if asked.kind == "fit" else closing.max()) > (
                opening.max() if asked.kind == "fit" else opening.min()
            )
        if above:
            words = f"an edge cannot close at more work than it opens at, but {closing.max():g} J/m^2 exceeds "
            yield home(key), f"{words}{opening.min():g} J/m^2; lower it, or raise work_of_adhesion"


def _needs_table(asked: Asked, table: str) -> Found:
    """Say which inputs have no effect without a table, and what the table needs."""
    if table not in asked.data:
        for name in asked.of(table):
            words = f"without [{table}] this has no effect; remove it, or add a table [{table}] with {_EXAMPLES[table]}"
            yield home(name), words
        return
    names = [name for name, own in INPUTS.items() if own.group == table]
    enough = [name for name in names if name not in ("toughness_amplitude", "reference_speed")]
    if not asked.meant(*enough):
        own = INPUTS[enough[0] if asked.units else enough[-1]]
        yield table, f"it needs {own.example} under [{own.table}]; add it, or remove [{table}]"


def toughness(asked: Asked) -> Found:
    """Check a pattern of toughness: its keys, each wave once, and its sign everywhere on the punch."""
    yield from _needs_table(asked, "toughness")
    if (table := asked.form.toughness) is None:
        return
    numbers = [wave.n for wave in table.harmonics]
    if len({*numbers}) < len(numbers):
        yield from each_once("toughness", numbers)
        return
    if "rate" in asked.data:
        words = "a toughness that varies with the radius cannot be combined with a speed"
        yield "toughness", f"{words}; remove [toughness] or [rate]"
    length, rim = ("toughness_wavelength", "a_max") if asked.units else ("toughness_wavelength_over_R", "a_max_over_R")
    key, pattern = "toughness_amplitude", table.made()
    given = (asked.values.get(key, 1.0), asked.values.get(length, math.nan), asked.values.get(rim, math.inf))
    for amplitude, wavelength, end in _patterns(asked, *map(np.atleast_1d, given)):
        radius = violation(pattern, amplitude, wavelength, end)
        if radius is not None:
            what = {"toughness": "toughness is negative", "work": "work of adhesion is not positive"}[pattern.of]
            said = f"{key} = {amplitude:g}" if key in asked.values else "these waves"
            words = f"with {said} the {what} at the radius {radius:.6g}{' m' if asked.units else ' R'}"
            yield home(key) if key in asked.values else "toughness.harmonics", f"{words}; use smaller waves"
            return


def _patterns(asked: Asked, *given: np.ndarray) -> Iterable[tuple[float, float, float]]:
    """Give the amplitudes, wavelengths and rims of punches that are the worst of a study."""
    amplitudes, wavelengths, rims = given
    if np.isnan(wavelengths).any():
        return
    if asked.points:
        if len({one.size for one in given} - {1}) > 1:
            return  # which is said of the lists
        amplitudes, wavelengths, rims = np.broadcast_arrays(*given)
    unique = np.unique(amplitudes)
    if not asked.points or unique.size > _MOST_AMPLITUDES:
        least = float(wavelengths.min())
        end = float((rims / wavelengths).max()) * least if asked.points else float(rims.max())
        yield from ((amplitude, least, end) for amplitude in np.unique(unique[[0, -1]]).tolist())
        return
    for amplitude in unique.tolist():
        own = amplitudes == amplitude
        least = float(wavelengths[own].min())
        yield amplitude, least, float((rims[own] / wavelengths[own]).max()) * least


def rate(asked: Asked) -> Found:
    """Check the law of a moving edge: its keys, what drives it, and what is known of it."""
    yield from _needs_table(asked, "rate")
    form = asked.form
    if form.rate is None:
        return
    if asked.kind != "fit" and isinstance(form.rate.exponent, Range):
        yield "rate.exponent", "only a fit searches it; write a number, for example exponent = 0.6"
    speeds = asked.given("speed", "reference_speed")
    if len(speeds) == 1:
        absent = INPUTS["reference_speed" if speeds == ["speed"] else "speed"]
        yield home(speeds[0]), f"the two speeds go together; add {absent.example} under [physical]"
    if form.loading.control == "load":
        words = 'under a falling load the energy of this law has no bound; write control = "machine" with a soft spring'
        yield "loading.control", f"{words}, or remove [rate]"
    if form.rate.closing == "same":
        everywhere = np.all if asked.kind == "fit" else np.any
        for name in asked.given("closing_ratio", "work_of_adhesion_closing"):
            if everywhere(np.asarray(asked.values.get(name, 1.0)) == 0.0):
                words = 'without adhesion on approach there is no such law; write closing = "quasi-static"'
                yield home(name), f"{words}, or a larger value"
        for name in asked.given("load_max", "preload"):
            yield home(name), f'with closing = "same" a cycle turns at a depth; give {asked.turn} instead'
    longest, rim = ("wavelength", "a_max") if asked.units else ("lambda_over_R", "a_max_over_R")
    if asked.waved and {longest, rim} <= asked.values.keys() and not asked.turns:
        count = float(np.min(asked.values[rim])) / float(np.max(asked.values[longest]))
        count *= max((wave.n for wave in form.profile.harmonics or ()), default=1)
        if MOST_WAVES < count < math.inf:
            words = (
                f"{count:,.0f} waves within the punch are more than the {MOST_WAVES:,.0f} that can be followed at a "
            )
            yield home(rim), words + "speed; use a smaller punch or longer waves"
    if not asked.ends and not asked.wrong:
        words = f"an edge with a speed opens from a radius; give {asked.turn} or a finite radius of the punch"
        yield "rate", words


def each_once(table: str, numbers: list[int]) -> Found:
    """Check that no wave of a series is given twice."""
    for i, n in enumerate(numbers):
        if n in numbers[:i]:
            words = f"the wave n = {n} is given already, as item {numbers.index(n)}; join the two"
            yield f"{table}.harmonics[{i}].n", words
