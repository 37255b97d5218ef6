"""A study from a file or a mapping: checked as a whole, and expanded."""

import re
import shlex
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.points import points_of
from gradhesion.cli.study.profile_file import measured_in
from gradhesion.cli.study.rules.answers import Search, Searched, Uncertainty
from gradhesion.cli.study.rules.asked import Asked, steps_of
from gradhesion.cli.study.rules.axes import expanded, range_mistakes
from gradhesion.cli.study.rules.form import KINDS, OUTPUTS_OF, Range
from gradhesion.cli.study.rules.mistakes import Checked, Mistake, checked
from gradhesion.cli.study.rules.scenes import broken, left_out, shape_of
from gradhesion.cli.study.study import Method, Study
from gradhesion.cli.study.text import places
from gradhesion.cli.study.text.foreign import as_written
from gradhesion.cli.study.text.source import Source, included, read_source
from gradhesion.cli.study.text.written import toml_of
from gradhesion.cli.terminal import wording
from gradhesion.cli.terminal.wording import nearest
from gradhesion.core.answers.spectrum import random_profile
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import CURVES

MOST_MISTAKES: Final = 30
"""Mistakes to print: whoever has more is served by the first."""


def load_study(path: str | Path, overrides: Iterable[str] = ()) -> Study:
    """
    Read a study from a file, with `overrides` in the form of `--set` (`"parameters.A=0.02"`).

    Raises
    ------
    StudyError
        The file cannot be read, or the study is wrong; the error has all mistakes.
    """
    return _study(read_source(Path(path), overrides))


def study_from(
    data: Mapping[str, Any],
    name: str = "study",
    *,
    folder: str | Path = "",
    columns: Mapping[str, NDArray[np.float64]] | None = None,
) -> Study:
    """
    Make a study from a mapping with the keys of a study file.

    Parameters
    ----------
    data
        The keys; lists may be arrays.
    name
        The name of the study if it has no title.
    folder
        The folder of the files that it names; the current directory by default.
    columns
        The columns of the file of its points, in SI units; the file is then not read.

    Raises
    ------
    StudyError
        The study is wrong; the error has all mistakes.
    """
    return _study(_source(data, name, folder), columns)


def text_of(data: Mapping[str, Any], study: Study) -> str:
    """Write keys as TOML that are known to be those of a valid study, one with the files of this one."""
    return toml_of(study.measured.stored(as_written(data), "")[0])


def load_any(path: str | Path, overrides: Iterable[str] = ()) -> Study | FitStudy:
    """Read a study of scenes, or one of a fit, from a file; as `load_study`."""
    source = read_source(Path(path), overrides)
    return _fit(source) if is_fit(source.data) else _study(source)


def any_from(data: Mapping[str, Any], name: str = "study", *, folder: str | Path = "") -> Study | FitStudy:
    """Make a study of scenes, or one of a fit, from a mapping; as `study_from`."""
    source = _source(data, name, folder)
    return _fit(source) if is_fit(source.data) else _study(source)


def is_fit(data: Mapping[str, Any]) -> bool:
    """Report whether the keys are meant to be those of a fit."""
    kind = data.get("kind")
    return isinstance(kind, str) and nearest(kind, KINDS) == "fit"


def _fit(source: Source) -> FitStudy:
    """Check a fit as a whole and read its data."""
    from gradhesion.cli.study.fit.reading import fit_from  # noqa: PLC0415 (its form, which no study of scenes needs)

    fit, mistakes = fit_from(source)
    _refuse(source, mistakes)
    assert fit is not None  # noqa: S101 (it has no mistakes)
    return fit


def _source(data: Mapping[str, Any], name: str, folder: str | Path) -> Source:
    """Make the source of a study that is a mapping."""
    if places.is_deep(data):
        raise StudyError(
            f"{name}: not a study, tables or lists are nested more than {places.DEEPEST} deep; remove some levels"
        )
    home, own = Path(folder).absolute(), as_written(data)
    if "include" in own:
        own, _ = included(own, home, f"{name}: include = {wording.shown(own['include'])}")
    return Source(name=name, data=own, text="", place=lambda _: name, folder=home)


def _study(source: Source, columns: Mapping[str, NDArray[np.float64]] | None = None) -> Study:
    """Check a study as a whole and expand it."""
    if is_fit(source.data):
        raise StudyError(f"{source.place(('kind',))}: a fit has no scenes; `gradhesion run` and gradhesion.run fit it")
    points = points_of(source.data, source.folder, columns)
    measured = measured_in(source.data, source.folder)
    over = _searched(source.data)
    found = checked(measured.beside(points.beside(_with_ends(source.data, over))))
    asked, between = _asked(found, source.data, points.columns, over)
    mistakes = [
        mistake
        for mistake in (*points.mistakes, *measured.mistakes, *found.mistakes, *between)
        if mistake.value is not None or not (points.unread or (measured.unread and mistake not in measured.mistakes))
    ]
    _refuse(source, mistakes)
    form, absent = found.form, left_out(asked.values, with_units="physical" in found.form.model_fields_set)
    given = {**asked.values, **absent}
    parameters = {name: given[name] for name in INPUTS if name in given and name not in over}
    for values in parameters.values():
        if isinstance(values, np.ndarray):
            if form.layout == "grid" and not (np.all(np.diff(values) > 0) or np.all(np.diff(values) < 0)):
                values.sort()  # CF wants coordinates that rise or fall
            values.flags.writeable = False
    solver, spectrum = form.method.solver, form.profile.spectrum.made() if form.profile.spectrum else None
    profile = random_profile(spectrum, 0, form.profile.exponent) if spectrum else shape_of(form.profile)
    data, text = points.stored(source.data, source.text)
    data, text = measured.stored(data, text)
    return Study(
        name=source.name,
        title=form.title or source.name,
        kind=form.kind,
        layout=form.layout,
        outputs=() if form.kind == "optimum" else variables_of(form.kind, form.outputs),
        parameters=parameters,
        method=Method(
            solver=solver if isinstance(solver, str) else tuple(solver), check_contact=form.method.check_contact
        ),
        profile=measured.profile() or profile,
        spectrum=spectrum,
        loading=Loading(control=form.loading.control),
        toughness=form.toughness.made() if form.toughness else None,
        rate=form.rate.made() if form.rate else None,
        states=tuple(form.states.contact_radius_over_R or ()),
        search=_search(form, over),
        uncertainty=_uncertainty(form.uncertainty),
        text=text or toml_of(data),
        left_out=frozenset(absent.keys() - {"a_max", "a_max_over_R"}),
        folder=source.folder,
        points=points,
        measured=measured,
    )


def variables_of(kind: str, requested: Iterable[str]) -> tuple[str, ...]:
    """
    Give the variables that are asked for, in the order of the dataset: a curve stands for all of its own.

    >>> variables_of("curve", ["jump_energy", "smooth"])[-2:]
    ('jump_count', 'jump_energy')
    """
    requested = {*requested}
    if kind == "map":
        return tuple(name for name in OUTPUTS_OF["map"] if name in requested)
    own = ((curve, name) for curve in CURVES.values() for name in curve.names)
    return tuple(
        name
        for curve, name in own
        if {curve.name, name} & requested or (name == curve.count and {*curve.names} & requested)
    )


def _searched(data: Mapping[str, Any]) -> tuple[str, ...]:
    """Name the inputs of an optimum that have bounds alone and are searched, also those whose names are misspelt."""
    table = data.get("optimum")
    if data.get("kind") != "optimum" or not isinstance(table, Mapping) or not isinstance(table.get("over"), list):
        return ()
    tables = {name: data.get(own.table) for name, own in INPUTS.items()}
    entries = {name: own[name] for name, own in tables.items() if isinstance(own, Mapping) and name in own}
    bounded = [name for name, entry in entries.items() if isinstance(entry, Mapping) and "num" not in entry]
    names = (name for name in table["over"] if isinstance(name, str))
    meant = (name if name in INPUTS else nearest(name, bounded) for name in names)
    return tuple(dict.fromkeys(name for name in meant if name in bounded))


def _with_ends(data: Mapping[str, Any], over: Iterable[str]) -> dict[str, Any]:
    """Give the keys of an optimum as those of a map: inputs that are searched are axes of two values, their bounds."""
    found = {**data}
    if found.get("kind") == "optimum":
        found.setdefault("outputs", ["pull_off_force"])
    for name in over:
        table = INPUTS[name].table
        found[table] = {**found[table], name: {**found[table][name], "num": 2}}
    return found


def _asked(
    found: Checked, written: Mapping[str, Any], columns: Mapping[str, Any], over: tuple[str, ...]
) -> tuple[Asked, list[Mistake]]:
    """Expand the inputs that are right, columns of a file in their place, and list what is wrong between keys."""
    wrong, values = [], {}
    for name, entry in found.form.entries.items():
        if {(INPUTS[name].table, name), (INPUTS[name].table,)} & found.wrong:
            continue
        own = list(range_mistakes(name, entry, searched=name in over))
        wrong += own
        if not own:
            values[name] = columns.get(name, expanded(entry))
    asked = Asked(checked=found, values=values, over=over, written=written)
    whole = Checked(form=found.form, data=written)
    paths = [(steps_of(path), words) for path, words in (*wrong, *broken(asked))]
    return asked, [Mistake(path, whole.at(path), words) for path, words in paths]


def _search(form: Any, over: tuple[str, ...]) -> Search:
    """Read what is sought."""
    table = form.optimum
    if form.kind != "optimum" or table is None:
        return Search()
    ends = [(name, form.entries[name]) for name in INPUTS if name in over]
    assert all(isinstance(entry, Range) for _, entry in ends)  # noqa: S101 (what is searched is one)
    least, most = table.require.minimum, table.require.maximum
    return Search(
        goals=tuple(name for _, name in table.goals),
        signs=tuple(1 if way == "maximise" else -1 for way, _ in table.goals),
        inputs=tuple(
            Searched(name=name, low=low, high=high, log=entry.spacing == "log")
            for name, entry in ends
            for low, high in [sorted((entry.start, entry.stop))]
        ),
        resolution=table.resolution,
        one_disc=table.require.one_disc,
        limits=tuple((name, least.get(name, -np.inf), most.get(name, np.inf)) for name in {**least, **most}),
    )


def _uncertainty(table: Any) -> Uncertainty:
    """Read how far inputs may be off."""
    if table is None:
        return Uncertainty()
    given = tuple((name, one) for name in INPUTS if (one := getattr(table, name)) is not None)
    return Uncertainty(deviations=given, samples=table.samples, seed=table.seed)


def _refuse(source: Source, mistakes: Iterable[Mistake]) -> None:
    """Raise what is wrong with a study, if anything is."""
    sentences = []
    for mistake in mistakes:
        value = "" if mistake.value is None else f" = {wording.shown(mistake.value)}"
        place, sentence = source.place(mistake.path), mistake.sentence
        written, _, given = place.partition("=")
        if written == f"--set {places.dotted(mistake.path)}" and mistake.meant[-1:] == mistake.path[-1:]:
            right = shlex.quote(f"{places.dotted(mistake.meant)}={given.strip()}")
            sentence = f"{sentence.partition(';')[0]}; write --set {right}"
        sentences.append(f"{place}: {places.dotted(mistake.path)}{value}: {sentence}")
    sentences.sort(key=_line)
    found = [*source.mistakes, *sentences]
    if len(found) > MOST_MISTAKES:
        more = f"... and {len(found) - MOST_MISTAKES} more mistakes; fix these first"
        found = [*found[:MOST_MISTAKES], more]
    if found:
        raise StudyError(found)


def _line(sentence: str) -> tuple[str, int]:
    """Sort sentences by the line that they name."""
    at = re.match(r"(.*?):(\d+):", sentence)
    return (at[1], int(at[2])) if at else ("", 0)
