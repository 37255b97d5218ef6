"""What the keys of a study have to do with each other."""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any, Final

import numpy as np

from gradhesion.cli.names import CURVES, GENERAL_CURVES, MACHINE, OUTPUTS, SPRING, table_of
from gradhesion.cli.study.axes import Values, expanded, mistake_of_range, mistakes_of_grid, mistakes_of_points
from gradhesion.cli.study.mistakes import Mistake
from gradhesion.cli.study.places import Path
from gradhesion.cli.study.schema import KINDS, LAYOUTS
from gradhesion.cli.study.wording import did_you_mean, example, nearest
from gradhesion.core.loading_control import CONTROLS
from gradhesion.core.profile import Harmonic, Profile

MOST_CURVES: Final = 1_000
"""Scenes of one curve study: curves are for looking at, and each has thousands of values."""

EXACT_ONLY: Final = tuple(OUTPUTS)[7:]
"""The outputs that come with the exact solver alone."""

VARIABLES: Final = tuple(name for variables in CURVES.values() for name in variables)
"""Every variable of every curve."""


def mistakes_between_keys(
    data: Mapping[str, Any],
    entries: Mapping[str, Any],
    wrong: Sequence[Path],
    outputs: Sequence[str],
    solvers: Sequence[str],
) -> Iterator[Mistake]:
    """
    List what is wrong between the keys of a study, leaving out those whose form is `wrong` already.

    `entries` are the parameters in plain numbers, under the keys that give them.
    """
    sound_tables = {key: table for key, table in data.items() if (key,) not in wrong}
    named = {path[:2] for path in wrong}
    yield from _mistakes_of_choice(sound_tables, named, outputs, solvers)
    sound = {}
    for name, entry in entries.items():
        path = (table_of(name), name)
        if path not in named and path[:1] not in wrong:
            mistake = mistake_of_range(path, data[path[0]][name], entry)
            if mistake:
                yield mistake
            else:
                sound[name] = expanded(entry)
    points = nearest(str(data.get("layout", "grid")), LAYOUTS) == "points"
    yield from mistakes_of_points(sound) if points else mistakes_of_grid(sound)
    yield from _mistakes_of_series(sound_tables.get("profile", {}), {*wrong}, sound)
    yield from _mistakes_of_control(sound_tables, named)
    yield from _mistakes_of_default_only(sound_tables, solvers)
    if kind_of(sound_tables) == "curve":
        yield from _mistakes_of_curves(sound_tables, [np.size(values) for values in sound.values()], points=points)


def profile_of(table: Mapping[str, Any]) -> Profile:
    """
    Make the shape of the punch of a valid table [profile]; what a wave does not have is zero.

    >>> profile_of({"harmonics": [{"n": 2, "sin": 0.5}]}).harmonics
    (Harmonic(n=2, cos=0.0, sin=0.5),)
    """
    exponent = float(table.get("exponent", 2.0))
    if "harmonics" not in table:
        return Profile(exponent=exponent)
    waves = (
        Harmonic(n=wave["n"], cos=float(wave.get("cos", 0.0)), sin=float(wave.get("sin", 0.0)))
        for wave in table["harmonics"]
    )
    return Profile(exponent=exponent, harmonics=tuple(waves))


def kind_of(data: Mapping[str, Any]) -> str:
    """Tell which kind of study is meant."""
    return nearest(str(data.get("kind", "map")), KINDS) or "map"


def _mistakes_of_choice(
    data: Mapping[str, Any], named: set[Path], outputs: Sequence[str], solvers: Sequence[str]
) -> Iterator[Mistake]:
    """Check the keys whose value is one of a few words, and the title."""
    choices: list[tuple[Path, Any, Sequence[str]]] = [
        (("kind",), data.get("kind", "map"), KINDS),
        (("layout",), data.get("layout", "grid"), LAYOUTS),
    ]
    for path, value, known in choices:
        if path not in named and value not in known:
            yield Mistake(path, value, f"not a {path[-1]}; {did_you_mean(value, known)}")
    yield from _mistakes_of_outputs(kind_of(data), data.get("outputs", []), named, outputs)
    if ("method", "solver") not in named:
        solver = data.get("method", {}).get("solver", "exact")
        yield from _mistakes_of_solver(kind_of(data), solver, solvers)
        yield from _mistakes_of_reports(data.get("outputs", []), solver, solvers)
    if ("method", "check_contact") not in named and kind_of(data) == "curve":
        checked = data.get("method", {}).get("check_contact", True)
        if not checked:
            sentence = "the path of a curve study is always checked; remove this key"
            yield Mistake(("method", "check_contact"), checked, sentence)
    if not data.get("title", "").isprintable():
        yield Mistake(("title",), data["title"], "a title is one line of printable characters; remove the others")


def _mistakes_of_outputs(
    kind: str, asked: Sequence[str], named: set[Path], outputs: Sequence[str]
) -> Iterator[Mistake]:
    """Check that each output belongs to the kind of the study, and is asked for once."""
    curves = (*CURVES, *VARIABLES)
    known, others = (curves, outputs) if kind == "curve" else (outputs, curves)
    for i, name in enumerate(asked):
        path = ("outputs", i)
        if path in named:
            continue
        if name in others:
            other = "map" if kind == "curve" else "curve"
            sentence = f'an output of studies of kind "{other}", and this one is of kind "{kind}"; '
            yield Mistake(path, name, f'{sentence}{did_you_mean(name, known)}, or write kind = "{other}"')
        elif name not in known:
            yield Mistake(path, name, f"not an output; {did_you_mean(name, known)}")
        elif name in asked[:i]:
            yield Mistake(path, name, "this output is asked for twice; remove one of the two")
        else:
            curve = next((one for one, own in CURVES.items() if name in own and one in asked), None)
            if curve is not None:
                yield Mistake(
                    path, name, f'a variable of "{curve}", which is asked for as a whole; remove one of the two'
                )


def _mistakes_of_series(table: Mapping[str, Any], wrong: set[Path], sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the waves of a profile: each n once, each with an amplitude, and not all of them zero if A is not."""
    path: Path = ("profile", "harmonics")
    waves = table.get("harmonics", [])
    if path in wrong:
        return
    sizes = []
    for i, wave in enumerate(waves):
        if any(one[:3] == (*path, i) for one in wrong):
            sizes.append(1.0)  # not known
            continue
        earlier = [j for j, other in enumerate(waves[:i]) if isinstance(other, Mapping) and other.get("n") == wave["n"]]
        if earlier:
            sentence = f"the wave n = {wave['n']} is given already, as item {earlier[0]}; join the two"
            yield Mistake((*path, i, "n"), wave["n"], sentence)
        if not wave.keys() & {"cos", "sin"}:
            sentence = "the wave has no amplitude; add cos, sin or both, as in { n = 1, cos = 1.0 }"
            yield Mistake((*path, i), wave, sentence)
            sizes.append(1.0)
        sizes += [abs(wave.get(name, 0.0)) for name in ("cos", "sin")]
    for name in ("A", "chi", "amplitude"):
        if sizes and max(sizes) == 0.0 and name in sound and np.any(np.asarray(sound[name]) > 0.0):
            sentence = f"all cos and sin are zero, so that {name} has no effect; give one a value, or use {name} = 0"
            yield Mistake(path, waves, sentence)


def _mistakes_of_control(tables: Mapping[str, Any], named: set[Path]) -> Iterator[Mistake]:
    """Check the control of the loading, and that one stiffness of a machine goes with it alone."""
    control = tables.get("loading", {}).get("control", "displacement")
    keys = (("loading", MACHINE), ("physical", SPRING))
    given = [path for path in keys if path[1] in tables.get(path[0], {})]
    if ("loading", "control") in named:
        return
    if control not in CONTROLS:
        yield Mistake(("loading", "control"), control, f"not a control; {did_you_mean(control, CONTROLS)}")
    elif control == "machine" and not given and not named & {*keys}:
        with_unit = "physical" in tables
        key = f"{example(keys[1])} under [physical]" if with_unit else f"add {MACHINE} = 10.0 to [loading]"
        sentence = f"a machine needs its stiffness {'S' if with_unit else 'S/(E* R)'}; {key}"
        yield Mistake(("loading", "control"), control, sentence)
    elif control == "machine":
        for path in given[1:]:
            sentence = f"{MACHINE} gives the stiffness of the machine already; keep one of the two and remove the other"
            yield Mistake(path, tables[path[0]][path[1]], sentence)
    else:
        for path in given:
            sentence = (
                f'control = "{control}" has no machine; remove this key, or write control = "machine" under [loading]'
            )
            yield Mistake(path, tables[path[0]][path[1]], sentence)


def _mistakes_of_default_only(data: Mapping[str, Any], solvers: Sequence[str]) -> Iterator[Mistake]:
    """Check that another profile or control is asked for only where it is known."""
    others = []
    with suppress(LookupError, TypeError, ValueError):  # what is wrong with it has its own sentence
        others += ["[profile]"] if profile_of(data.get("profile", {})) != Profile() else []
    if data.get("loading", {}).get("control", "displacement") in CONTROLS[1:]:
        others.append("[loading]")
    if not others:
        return
    known = "known of a paraboloid with one cosine wave under controlled displacement only"
    remedy = f"or remove {' and '.join(others)}"
    if kind_of(data) == "curve":
        special = {one: (one, *own) for one, own in CURVES.items() if one not in GENERAL_CURVES}
        for i, name in enumerate(data.get("outputs", [])):
            if any(name in own for own in special.values()):
                yield Mistake(("outputs", i), name, f"this curve is {known}; remove it, {remedy}")
    asked = data.get("method", {}).get("solver", "exact")
    for one in [asked] if isinstance(asked, str) else asked:
        if one == "envelope" and "[loading]" in others:
            sentence = (
                'the solver "envelope" is known under controlled displacement only: contact through a spring begins '
                'and ends where no closed form tells; write solver = "exact", or remove [loading]'
            )
            yield Mistake(("method", "solver"), asked, sentence)
        elif one in solvers[1:] and one != "envelope":
            sentence = f'the solver "{one}" is {known}; write solver = "exact", {remedy}'
            yield Mistake(("method", "solver"), asked, sentence)
    for i, name in enumerate(data.get("outputs", [])):
        if name == "energy_residual" and data.get("loading", {}).get("control") == "load":
            sentence = (
                'a dead load closes no loop, so that there is no residual; remove it, or write control = "machine"'
            )
            yield Mistake(("outputs", i), name, sentence)
    if "[profile]" in others and "a_max_over_a2" in data.get("parameters", {}):
        sentence = (
            "a_2 is that of a paraboloid with one cosine wave; give a_max_over_R or a_max_over_L, or remove [profile]"
        )
        yield Mistake(("parameters", "a_max_over_a2"), data["parameters"]["a_max_over_a2"], sentence)


def _mistakes_of_curves(data: Mapping[str, Any], lengths: Sequence[int], *, points: bool) -> Iterator[Mistake]:
    """Check that a curve study is not too large."""
    scenes = max(lengths, default=1) if points else math.prod(lengths)
    if scenes > MOST_CURVES:
        sentence = f"a curve study has at most {MOST_CURVES:,} scenes, and this one has {scenes:,}; "
        yield Mistake(("kind",), data["kind"], sentence + 'use fewer values, split the study, or write kind = "map"')


def _mistakes_of_solver(kind: str, solver: str | list[str], solvers: Sequence[str]) -> Iterator[Mistake]:
    """Check that each solver is known and named once, and that a curve study names none."""
    path = ("method", "solver")
    if kind == "curve":
        if solver != "exact":
            sentence = "a curve study has no solver, it draws the curves that are asked for; remove this key"
            yield Mistake(path, solver, f'{sentence}, and add "asymptotic", "envelope" or "effective" to outputs')
        return
    asked = [solver] if isinstance(solver, str) else solver
    for i, one in enumerate(asked):
        place: Path = path if isinstance(solver, str) else (*path, i)
        if one not in solvers:
            yield Mistake(place, one, f"not a solver; {did_you_mean(one, solvers)}")
        elif one in asked[:i]:
            yield Mistake(place, one, "this solver is asked for twice; remove one of the two")


def _mistakes_of_reports(asked: Sequence[str], solver: str | list[str], solvers: Sequence[str]) -> Iterator[Mistake]:
    """Check that what the exact solver alone can tell is asked of no other."""
    other = next((one for one in ([solver] if isinstance(solver, str) else solver) if one in solvers[1:]), None)
    for i, name in enumerate(asked):
        if other is not None and name in EXACT_ONLY:
            sentence = f'the solver "{other}" has no such output; remove it, or write solver = "exact"'
            yield Mistake(("outputs", i), name, sentence)
