"""What the edge of a contact meets: a toughness that varies with the radius, and a work that grows with its speed."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from gradhesion.cli.keys import CLOSING, INPUTS, PATTERN, SPEED, Path
from gradhesion.cli.names.curves import CURVES, STATE_CURVES
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.edge import RateTable, ToughnessTable
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.rules.roles import has_units, is_given, mixed
from gradhesion.cli.study.rules.turn import KEYS as TURN_KEYS
from gradhesion.cli.terminal.wording import did_you_mean, line_of
from gradhesion.core.problem.names import PATTERN_CURVES, RATE, REPORTS, SENSITIVITIES
from gradhesion.core.problem.rate import CLOSINGS, MOST_WAVES, Rate
from gradhesion.core.problem.toughness import OF, Toughness, ToughnessHarmonic, violation

_WITHOUT_RATE: Final = (
    *("loading_jumps", "unloading_jumps", *SENSITIVITIES, *REPORTS),
    *(name for curve in ("jumps", *STATE_CURVES) for name in (curve, *CURVES[curve])),
)
"""What is known of an edge without a speed alone."""
_PATTERN_PATHS: Final[tuple[Path, ...]] = (
    ("physical", "toughness_wavelength"),
    *(("parameters", name) for name in PATTERN),
)
_SPEED_PATHS: Final[tuple[Path, ...]] = (
    ("physical", "speed"),
    ("physical", "reference_speed"),
    ("parameters", SPEED),
)
_MOST: Final = 1000
"""Different amplitudes of points up to which each is looked at."""


def toughness_of(table: ToughnessTable | None) -> Toughness | None:
    """
    Make the pattern of toughness of a valid table.

    >>> toughness_of(ToughnessTable.model_validate({"harmonics": [{"n": 1, "cos": 0.5}]})).of
    'toughness'
    """
    if table is None:
        return None
    return Toughness(tuple(ToughnessHarmonic(n=one.n, cos=one.cos, sin=one.sin) for one in table.harmonics), table.of)


def rate_of(table: RateTable | None) -> Rate | None:
    """Make the law of a moving edge of a valid table."""
    return None if table is None else Rate(exponent=table.exponent, closing=table.closing)


def _tables(checked: Checked, name: str) -> bool:
    """Report whether a table is there and right."""
    return name in checked.data and not any(path[:1] == (name,) for path in checked.wrong)


def _stray(checked: Checked, paths: tuple[Path, ...], table: str, example: str) -> Iterator[Mistake]:
    """Say which keys have no effect without a table."""
    for path in paths:
        if is_given(checked, path):
            sentence = f"without [{table}] this has no effect; remove it, or add a table [{table}] with {example}"
            yield Mistake(path, checked.data[str(path[0])][path[1]], sentence)


def _exact_alone(checked: Checked, table: str) -> Iterator[Mistake]:
    """Check that the exact solver is the only one."""
    other = next((one for one in checked.form.method.solvers if one in ("asymptotic", "envelope")), None)
    if other:
        sentence = f'the solver "{other}" does not support [{table}]; write solver = "exact", or remove [{table}]'
        yield Mistake(("method", "solver"), checked.form.method.solver, sentence)


def _one_of(checked: Checked, paths: tuple[Path, Path], table: str) -> Iterator[Mistake]:
    """Check that a quantity or its ratio is there, and not both."""
    given = [path for path in paths if is_given(checked, path)]
    if has_units(checked) and paths[1] in given:
        own = [key.name for key in INPUTS.values() if key.gives == paths[1][1] and key.table == "physical"]
        yield mixed(paths[1], checked, own)
    elif not given and not checked.meant & {*paths}:
        path = paths[0] if has_units(checked) else paths[1]
        yield Mistake((table,), None, f"it needs {line_of(path)} under [{path[0]}]; add it, or remove [{table}]")


def mistakes_of_toughness(checked: Checked, sound: Mapping[str, Values], *, points: bool) -> Iterator[Mistake]:
    """Check a pattern of toughness: its keys, each wave once, and its sign everywhere on the punch."""
    if "toughness" not in checked.data:
        yield from _stray(checked, _PATTERN_PATHS, "toughness", "harmonics = [{ n = 1, cos = 0.2 }]")
        return
    if not _tables(checked, "toughness"):
        return
    table = checked.form.toughness
    assert table is not None  # noqa: S101 (it is there, and right)
    yield from _exact_alone(checked, "toughness")
    yield from _one_of(checked, (_PATTERN_PATHS[0], _PATTERN_PATHS[1]), "toughness")
    if table.of not in OF:
        yield Mistake(("toughness", "of"), table.of, f"not what a pattern multiplies; {did_you_mean(table.of, OF)}")
        return
    numbers = [one.n for one in table.harmonics]
    for i, n in enumerate(numbers):
        if n in numbers[:i]:
            sentence = f"the wave n = {n} is given already, as item {numbers.index(n)}; join the two"
            yield Mistake(("toughness", "harmonics", i, "n"), n, sentence)
            return
    if "rate" in checked.data:
        sentence = (
            "a toughness that varies with the radius cannot be combined with a speed; remove [toughness] or [rate]"
        )
        yield Mistake(("toughness",), None, sentence)
    if checked.form.kind == "curve":
        own = {name for curve in PATTERN_CURVES for name in (curve, *CURVES[curve])}
        for i, name in enumerate(checked.form.outputs):
            if name not in own:
                sentence = f"with [toughness] the only curves are {', '.join(PATTERN_CURVES)}; remove this one"
                yield Mistake(("outputs", i), name, sentence)
    yield from _mistakes_of_sign(checked, sound, points=points)


def _mistakes_of_sign(checked: Checked, sound: Mapping[str, Values], *, points: bool) -> Iterator[Mistake]:
    """Check that the toughness is not negative, and the work positive, anywhere on a punch."""
    lengths = ("toughness_wavelength", "a_max") if has_units(checked) else (PATTERN[0], "a_max_over_R")
    toughness = toughness_of(checked.form.toughness)
    if toughness is None or lengths[0] not in sound:
        return
    amplitudes = np.atleast_1d(sound.get(PATTERN[1], 1.0))
    wavelengths = np.atleast_1d(sound[lengths[0]])
    rims = np.atleast_1d(sound.get(lengths[1], np.inf))
    if points and len({one.size for one in (amplitudes, wavelengths, rims)} - {1}) > 1:
        return  # which is said of the lists
    if points:
        amplitudes, wavelengths, rims = np.broadcast_arrays(amplitudes, wavelengths, rims)
    unique = np.unique(amplitudes)
    chosen = unique if points and unique.size <= _MOST else np.unique(unique[[0, -1]])
    for amplitude in chosen.tolist():
        own = amplitudes == amplitude if points and unique.size <= _MOST else slice(None)
        least = float((wavelengths[own] if points else wavelengths).min())
        ends = rims[own] / wavelengths[own] if points else np.array([rims.max() / least])
        radius = violation(toughness, amplitude, least, float(ends.max()) * least)
        if radius is None:
            continue
        what = {"toughness": "toughness is negative", "work": "work of adhesion is not positive"}[toughness.of]
        given = f"{PATTERN[1]} = {amplitude:g}" if PATTERN[1] in sound else "these waves"
        unit = " m" if has_units(checked) else " R"
        sentence = f"with {given} the {what} at the radius {radius:.6g}{unit}; use smaller waves"
        path: Path = ("parameters", PATTERN[1]) if PATTERN[1] in sound else ("toughness", "harmonics")
        yield Mistake(path, checked.data[str(path[0])][path[1]], sentence)
        return


def mistakes_of_rate(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the law of a moving edge: its keys, what drives it, and what is known of it."""
    if "rate" not in checked.data:
        yield from _stray(checked, _SPEED_PATHS, "rate", "exponent = 0.6")
        for i, name in enumerate(checked.form.outputs):
            if name in RATE:
                sentence = "this belongs to an edge with a speed; add a table [rate], or remove it"
                yield Mistake(("outputs", i), name, sentence)
        return
    if not _tables(checked, "rate"):
        return
    form, table = checked.form, checked.form.rate
    assert table is not None  # noqa: S101 (it is there, and right)
    yield from _exact_alone(checked, "rate")
    yield from _one_of(checked, (_SPEED_PATHS[0], _SPEED_PATHS[2]), "rate")
    if is_given(checked, _SPEED_PATHS[0]) != is_given(checked, _SPEED_PATHS[1]):
        absent = _SPEED_PATHS[1 if is_given(checked, _SPEED_PATHS[0]) else 0]
        sentence = f"the two speeds go together; add {line_of(absent)} under [physical]"
        other = _SPEED_PATHS[0 if absent == _SPEED_PATHS[1] else 1]
        yield Mistake(other, checked.data["physical"][other[1]], sentence)
    if table.closing not in CLOSINGS:
        yield Mistake(
            ("rate", "closing"), table.closing, f"not a way to close; {did_you_mean(table.closing, CLOSINGS)}"
        )
    if form.loading.control == "load":
        sentence = (
            "under a falling load the energy of this law has no bound; "
            'write control = "machine" with a soft spring, or remove [rate]'
        )
        yield Mistake(("loading", "control"), "load", sentence)
    for i, name in enumerate(form.outputs):
        if name in _WITHOUT_RATE:
            sentence = "an edge with a speed passes every radius once and has no jumps, so that this is not available"
            sentence = sentence if "jump" in name else "this is not available for an edge with a speed"
            yield Mistake(("outputs", i), name, f"{sentence}; remove it, or remove [rate]")
    yield from _mistakes_of_closing(checked, table, sound)
    yield from _mistakes_of_waves(checked, sound)
    turned = any(is_given(checked, path) for path in TURN_KEYS)
    rims = [values for name, values in sound.items() if INPUTS[name].gives == "a_max_over_R"]
    if not turned and not (rims and np.all(np.isfinite(rims[0]))) and not checked.wrong:
        turn = "indentation_max" if has_units(checked) else "indentation_max_over_R"
        sentence = f"an edge with a speed opens from a radius; give {turn} or a finite radius of the punch"
        yield Mistake(("rate",), None, sentence)


def _mistakes_of_waves(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that waves can be followed in some scene, where an edge opens from the rim."""
    lengths = ("wavelength", "a_max") if has_units(checked) else ("lambda_over_R", "a_max_over_R")
    smooth = all(np.all(np.asarray(sound.get(name, 0.0)) == 0.0) for name in ("A", "chi", "amplitude"))
    if smooth or not {*lengths} <= sound.keys() or any(is_given(checked, path) for path in TURN_KEYS):
        return
    series = checked.form.profile.harmonics
    shortest = max((wave.n for wave in series or ()), default=1)
    least = float(np.min(sound[lengths[1]])) / float(np.max(sound[lengths[0]])) * shortest
    if MOST_WAVES < least < np.inf:
        name = lengths[1]
        sentence = (
            f"{least:,.0f} waves within the punch are more than the {MOST_WAVES:,.0f} that can be followed at a speed"
        )
        path: Path = (INPUTS[name].table, name)
        yield Mistake(path, checked.data[str(path[0])][name], f"{sentence}; use a smaller punch or longer waves")


def _mistakes_of_closing(checked: Checked, table: RateTable, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check what closing by the same law needs."""
    if table.closing != "same":
        return
    zero = [name for name in (CLOSING, "work_of_adhesion_closing") if np.any(np.asarray(sound.get(name, 1.0)) == 0.0)]
    for name in zero:
        path: Path = (INPUTS[name].table, name)
        sentence = (
            'without adhesion on approach there is no such law; write closing = "quasi-static", or a larger value'
        )
        yield Mistake(path, checked.data[str(path[0])][name], sentence)
    for path in TURN_KEYS:
        if is_given(checked, path) and INPUTS[str(path[1])].gives == "load_max":
            turn = "indentation_max" if has_units(checked) else "indentation_max_over_R"
            sentence = f'with closing = "same" a cycle turns at a depth; give {turn} instead'
            yield Mistake(path, checked.data[str(path[0])][path[1]], sentence)
