"""A study from a file or a mapping: checked as a whole, and expanded."""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.keys import INPUTS
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.form.kinds import KINDS
from gradhesion.cli.study.form.mistakes import Mistake, checked
from gradhesion.cli.study.points import points_of
from gradhesion.cli.study.profile_file import measured_in
from gradhesion.cli.study.rules.between import mistakes_between_keys
from gradhesion.cli.study.rules.edge import rate_of, toughness_of
from gradhesion.cli.study.rules.punch import profile_of, spectrum_of
from gradhesion.cli.study.rules.roles import left_out
from gradhesion.cli.study.rules.search import search_of, sought_in
from gradhesion.cli.study.rules.uncertainty import uncertainty_of
from gradhesion.cli.study.study import Method, Study
from gradhesion.cli.study.text import places
from gradhesion.cli.study.text.foreign import as_written
from gradhesion.cli.study.text.source import Source, read_source
from gradhesion.cli.study.text.written import toml_of
from gradhesion.cli.terminal import wording
from gradhesion.cli.terminal.wording import nearest
from gradhesion.core.problem.control import Loading

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
    return isinstance(kind, str) and nearest(kind, tuple(KINDS)) == "fit"


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
    home = Path(folder).absolute()
    return Source(name=name, data=as_written(data), text="", place=lambda _: name, folder=home)


def _study(source: Source, columns: Mapping[str, NDArray[np.float64]] | None = None) -> Study:
    """Check a study as a whole and expand it."""
    if is_fit(source.data):
        raise StudyError(f"{source.place(('kind',))}: a fit has no scenes; `gradhesion run` and gradhesion.run fit it")
    points = points_of(source.data, source.folder, columns)
    measured = measured_in(source.data, source.folder)
    sought = sought_in(source.data)
    found = checked(measured.beside(points.beside(sought.beside())))
    sound, between = mistakes_between_keys(found, points.columns, sought)
    mistakes = [
        mistake
        for mistake in (*points.mistakes, *measured.mistakes, *found.mistakes, *between)
        if mistake.value is not None or not (points.unread or (measured.unread and mistake not in measured.mistakes))
    ]
    _refuse(source, mistakes)
    form = found.form
    absent = left_out(sound, with_units="physical" in form.model_fields_set)
    given = sound | absent
    parameters = {name: given[name] for name in INPUTS if name in given and name not in sought.over}
    for values in parameters.values():
        if isinstance(values, np.ndarray):
            if form.layout == "grid" and not (np.all(np.diff(values) > 0) or np.all(np.diff(values) < 0)):
                values.sort()  # CF wants coordinates that rise or fall
            values.flags.writeable = False
    solver = form.method.solver
    data, text = points.stored(source.data, source.text)
    data, text = measured.stored(data, text)
    return Study(
        name=source.name,
        title=form.title or source.name,
        kind=form.kind,
        layout=form.layout,
        outputs=() if form.kind == "optimum" else KINDS[form.kind].variables(form.outputs),
        parameters=parameters,
        method=Method(
            solver=solver if isinstance(solver, str) else tuple(solver), check_contact=form.method.check_contact
        ),
        profile=measured.profile() or profile_of(form.profile),
        spectrum=spectrum_of(form.profile),
        loading=Loading(control=form.loading.control),
        toughness=toughness_of(form.toughness),
        rate=rate_of(form.rate),
        states=form.states.radii,
        search=search_of(found, sought),
        uncertainty=uncertainty_of(found),
        text=text or toml_of(data),
        left_out=frozenset(absent.keys() - {"a_max", "a_max_over_R"}),
        folder=source.folder,
        points=points,
        measured=measured,
    )


def _refuse(source: Source, mistakes: Iterable[Mistake]) -> None:
    """Raise what is wrong with a study, if anything is."""
    sentences = []
    for mistake in mistakes:
        value = "" if mistake.value is None else f" = {wording.shown(mistake.value)}"
        sentences.append(f"{source.place(mistake.path)}: {places.dotted(mistake.path)}{value}: {mistake.sentence}")
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
