"""What the keys of a study have to do with each other."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli.keys import INPUTS, Path
from gradhesion.cli.names.curves import CURVES
from gradhesion.cli.study.form.axes import Values, expanded, mistake_of_range, mistakes_of_grid, mistakes_of_points
from gradhesion.cli.study.form.inputs import Range
from gradhesion.cli.study.form.kinds import KINDS
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.rules.edge import mistakes_of_rate, mistakes_of_toughness
from gradhesion.cli.study.rules.punch import mistakes_of_punch
from gradhesion.cli.study.rules.roles import mistakes_of_roles
from gradhesion.cli.study.rules.search import Sought, mistakes_of_search
from gradhesion.cli.study.rules.states import mistakes_of_states
from gradhesion.cli.study.rules.turn import mistakes_of_turn
from gradhesion.cli.study.rules.uncertainty import mistakes_of_uncertainty
from gradhesion.cli.study.rules.validity import mistakes_of_range
from gradhesion.cli.study.rules.works import mistakes_of_works
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core import REPORTS, SENSITIVITIES, SOLVERS
from gradhesion.core.problem.names import GIVEN_UP

LAYOUTS: Final = ("grid", "points")

EXACT_ONLY: Final = (*REPORTS, *SENSITIVITIES, "snap_in_force")
"""The outputs that come with the exact solver alone."""


def mistakes_between_keys(
    checked: Checked, columns: Mapping[str, Values], sought: Sought
) -> tuple[dict[str, Values], list[Mistake]]:
    """
    Expand the inputs that are right, and list what is wrong between the keys of a study.

    The columns of a file of points stand in the place of the values that stood for them.
    """
    mistakes = [*_mistakes_of_choice(checked), *_mistakes_of_outputs(checked), *_mistakes_of_method(checked)]
    sound: dict[str, Values] = {}
    for name, entry in checked.form.entries.items():
        path: Path = (INPUTS[name].table, name)
        if path in checked.wrong or path[:1] in checked.wrong:
            continue
        mistake = mistake_of_range(path, checked.data[str(path[0])][name], entry)
        if name in sought.over and isinstance(entry, Range) and entry.start == entry.stop:
            mistake = None  # which is said of bounds in other words
        if mistake:
            mistakes.append(mistake)
        else:
            sound[name] = expanded(entry)
    sound = {name: columns.get(name, values) for name, values in sound.items()}
    axes = {name: values for name, values in sound.items() if name not in sought.over}
    is_points = nearest(checked.form.layout, LAYOUTS) == "points"
    mistakes += mistakes_of_points(axes) if is_points else mistakes_of_grid(sound)
    mistakes += mistakes_of_search(checked, sought, sound)
    mistakes += mistakes_of_roles(checked, sound)
    mistakes += mistakes_of_punch(checked, sound)
    mistakes += mistakes_of_turn(checked)
    mistakes += mistakes_of_works(checked, sound, points=is_points)
    mistakes += mistakes_of_toughness(checked, sound, points=is_points)
    mistakes += mistakes_of_rate(checked, sound)
    mistakes += mistakes_of_states(checked, sound)
    mistakes += mistakes_of_range(checked)
    mistakes += mistakes_of_uncertainty(checked, sound)
    lengths = [np.size(values) for values in axes.values()]
    spectrum = checked.form.profile.spectrum
    realisations = 1 if spectrum is None else spectrum.realisations
    mistakes += _mistakes_of_size(checked, lengths, realisations, points=is_points)
    return sound, mistakes


def _kind_of(checked: Checked) -> str:
    """Report which kind of study is meant."""
    return nearest(checked.form.kind, tuple(KINDS)) or "map"


def _mistakes_of_choice(checked: Checked) -> Iterator[Mistake]:
    """Check the keys whose value is one of a few words, and the title."""
    form = checked.form
    choices: tuple[tuple[str, str, Any], ...] = (
        ("kind", form.kind, tuple(KINDS)),
        ("layout", form.layout, LAYOUTS),
    )
    for name, value, known in choices:
        if value not in known:
            yield Mistake((name,), value, f"not a {name}; {did_you_mean(value, known)}")
    if not form.title.isprintable():
        yield Mistake(("title",), form.title, "a title is one line of printable characters; remove the others")


def _mistakes_of_outputs(checked: Checked) -> Iterator[Mistake]:
    """Check that each output belongs to the kind of the study, and is asked for once."""
    requested: Any = checked.data.get("outputs")
    kind = KINDS[_kind_of(checked)]
    if not isinstance(requested, list) or not kind.outputs:
        return
    others = {name: other.name for other in KINDS.values() if other is not kind for name in other.outputs}
    for i, name in enumerate(requested):
        path: Path = ("outputs", i)
        if not isinstance(name, str):
            continue
        if name in kind.outputs and name in requested[:i]:
            yield Mistake(path, name, "this output is listed twice; remove one of the two")
        elif name in kind.outputs:
            curve = next((one for one, own in CURVES.items() if name in own and one in requested and one != name), None)
            if curve is not None:
                yield Mistake(path, name, f'a variable of "{curve}", which is listed as a whole; remove one of the two')
        elif name in others:
            sentence = f'an output of studies of kind "{others[name]}", and this one is of kind "{kind.name}"; '
            sentence += f'{did_you_mean(name, kind.outputs)}, or write kind = "{others[name]}"'
            yield Mistake(path, name, sentence)
        elif name in GIVEN_UP:
            yield Mistake(path, name, f"this output is given up, remove it: {GIVEN_UP[name]}")
        else:
            yield Mistake(path, name, f"not an output; {did_you_mean(name, kind.outputs)}")


def _mistakes_of_method(checked: Checked) -> Iterator[Mistake]:
    """Check that each solver is known, named once and has all outputs, and that a study of curves has no method."""
    method, has_solver = checked.form.method, KINDS[_kind_of(checked)].has_solver
    if not has_solver and method.solver != "exact":
        sentence = "a curve study has no solver, since its outputs select the curves; remove this key"
        sentence += ', and add "asymptotic", "envelope" or "effective" to outputs'
        yield Mistake(("method", "solver"), method.solver, sentence)
    if not has_solver and not method.check_contact:
        sentence = "the path of a curve study is always checked; remove this key"
        yield Mistake(("method", "check_contact"), method.check_contact, sentence)
    for i, one in enumerate(method.solvers if has_solver else ()):
        path: Path = ("method", "solver") if isinstance(method.solver, str) else ("method", "solver", i)
        if one not in SOLVERS:
            yield Mistake(path, one, f"not a solver; {did_you_mean(one, tuple(SOLVERS))}")
        elif one in method.solvers[:i]:
            yield Mistake(path, one, "this solver is listed twice; remove one of the two")
    other = next((one for one in method.solvers if one in SOLVERS and one != "exact"), None)
    for i, name in enumerate(checked.form.outputs if other else ()):
        if name in EXACT_ONLY:
            sentence = f'the solver "{other}" has no such output; remove it, or write solver = "exact"'
            yield Mistake(("outputs", i), name, sentence)


def _mistakes_of_size(checked: Checked, lengths: list[int], realisations: int, *, points: bool) -> Iterator[Mistake]:
    """Check that a study is not too large for its kind."""
    kind = KINDS[_kind_of(checked)]
    scenes = realisations * (max(lengths, default=1) if points else math.prod(lengths))
    if scenes > kind.most_scenes:
        sentence = f"a {kind.name} study has at most {kind.most_scenes:,} scenes, and this one has {scenes:,}; "
        path: Path = ("parameters",) if kind.has_parts else ("kind",)
        yield Mistake(path, None if kind.has_parts else kind.name, sentence + kind.remedy)
