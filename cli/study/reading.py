"""A study from a file or a mapping: checked as a whole, and expanded."""

from collections.abc import Iterable, Iterator, Mapping
from operator import itemgetter
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.files import measured_in, points_of
from gradhesion.cli.study.fit.loops import LoopFile, LoopFileError
from gradhesion.cli.study.fit.study import FitStudy, fit_of, loops_of
from gradhesion.cli.study.fit.study import broken as broken_in_fit
from gradhesion.cli.study.rules.asked import Asked, checked, kind_of, value_at
from gradhesion.cli.study.rules.form import OUTPUTS_OF, Optimum, Uncertainty
from gradhesion.cli.study.rules.given import given_by
from gradhesion.cli.study.rules.inputs import left_out, shape_of
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.rules.mistakes import Mistake
from gradhesion.cli.study.rules.scenes import broken
from gradhesion.cli.study.study import Method, Study
from gradhesion.cli.study.text.quantities import as_written
from gradhesion.cli.study.text.toml import Source, dotted, read_source, source_of, steps_of, with_fingerprints
from gradhesion.cli.terminal.wording import shown
from gradhesion.core.answers.spectrum import random_profile
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import CURVES

MOST_MISTAKES: Final = 30
"""Mistakes to print: whoever has more is served by the first."""


def load_study(path: str | Path, overrides: Iterable[str] = ()) -> Study:
    """Read a study from a file, with `overrides` in the form of `--set` (`"parameters.A=0.02"`).

    Raises
    ------
    StudyError
        The file cannot be read, or the study is wrong; the error has all mistakes.
    """
    return _of_scenes(read_source(Path(path), overrides))


def study_from(
    data: Mapping[str, Any],
    name: str = "study",
    *,
    folder: str | Path = "",
    columns: Mapping[str, NDArray[np.float64]] | None = None,
) -> Study:
    """Make a study from a mapping with the keys of a study file.

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
    return _of_scenes(source_of(data, name, folder), columns)


def load_any(path: str | Path, overrides: Iterable[str] = ()) -> Study | FitStudy:
    """Read a study of scenes, or one of a fit, from a file; as `load_study`."""
    return _of_any(read_source(Path(path), overrides))


def any_from(data: Mapping[str, Any], name: str = "study", *, folder: str | Path = "") -> Study | FitStudy:
    """Make a study of scenes, or one of a fit, from a mapping; as `study_from`."""
    return _of_any(source_of(data, name, folder))


def text_of(data: Mapping[str, Any], study: Study) -> str:
    """Write keys as TOML that are known to be those of a valid study, one with the files of this one."""
    files = {study.measured.key: study.measured.sha256} if study.measured.file else {}
    return with_fingerprints(as_written(data), "", files)


def _of_any(source: Source) -> Study | FitStudy:
    """Check a study of its kind as a whole, and expand it or read its data."""
    if kind_of(source.data) != "fit":
        return _of_scenes(source)
    asked = checked(source.data)
    mistakes = [*asked.mistakes, *_between(asked, source.data, broken_in_fit(asked))]
    loops: tuple[LoopFile, ...] = ()
    if asked.form.data and asked.right("data") and not any("data" in path[:1] for path, _ in mistakes):
        try:
            loops = loops_of(source.folder, asked.form, asked.form.data)
        except LoopFileError as error:
            mistakes.append((("data", error.key), str(error)))
    _refuse(source, mistakes)
    return fit_of(source, asked.form, loops)


def _of_scenes(source: Source, columns: Mapping[str, NDArray[np.float64]] | None = None) -> Study:
    """Check a study of scenes as a whole and expand it."""
    if kind_of(source.data) == "fit":
        raise StudyError(f"{source.place(('kind',))}: a fit has no scenes; `gradhesion run` and gradhesion.run fit it")
    points, measured = points_of(source.data, source.folder, columns), measured_in(source.data, source.folder)
    asked = checked(measured.beside(points.beside(source.data)))
    mistakes = [*asked.mistakes, *_between(asked, source.data, broken(asked))]
    if points.mistakes and not points.file:  # nothing is missing that the file would give
        mistakes = [(path, words) for path, words in mistakes if value_at(source.data, path) is not None]
    _refuse(source, [*points.mistakes, *measured.mistakes, *mistakes])
    form = asked.form
    absent = left_out(asked.values, with_units=form.physical is not None)
    given = {**asked.values, **absent}
    parameters = {name: given[name] for name in INPUTS if name in given and name not in asked.over}
    for values in parameters.values():
        if isinstance(values, np.ndarray):
            if form.layout == "grid" and not (np.all(np.diff(values) > 0) or np.all(np.diff(values) < 0)):
                values.sort()  # CF wants coordinates that rise or fall
            values.flags.writeable = False
    solvers = tuple(form.method.solver)
    solver = solvers if isinstance(asked.at("method.solver"), list) else solvers[0]
    spectrum = form.profile.spectrum.made() if form.profile.spectrum else None
    profile = random_profile(spectrum, 0, float(form.profile.exponent)) if spectrum else shape_of(form.profile)
    ranges = ((name, form.entries[name]) for name in asked.over)
    return Study(
        **given_by(source, form, {one.key: one.sha256 for one in (points, measured) if one.file}),
        layout=form.layout,
        outputs=() if form.kind == "optimum" else _variables_of(form.kind, form.outputs),
        parameters=parameters,
        method=Method(solver=solver, check_contact=form.method.check_contact),
        profile=measured.fit.profile if measured.fit else profile,
        spectrum=spectrum,
        loading=Loading(control=form.loading.control),
        rate=form.rate.made() if form.rate else None,
        states=tuple(form.states.contact_radius_over_R or ()),
        search=form.optimum or Optimum(),
        searched={name: Range(**dict(one)) for name, one in ranges if isinstance(one, Range)},
        uncertainty=form.uncertainty or Uncertainty(),
        left_out=frozenset(absent.keys() - {"a_max", "a_max_over_R"}),
        points=points,
        measured=measured,
    )


def _variables_of(kind: str, requested: Iterable[str]) -> tuple[str, ...]:
    """Give the variables that are asked for, in the order of the dataset: a curve stands for all of its own."""
    requested = {*requested}
    if kind == "map":
        return tuple(name for name in OUTPUTS_OF["map"] if name in requested)
    found: list[str] = []
    for curve in CURVES.values():
        own = [name for name in curve.names if {curve.name, name} & requested]
        found += [curve.count, *own] if own and curve.count and curve.count not in own else own
    return tuple(found)


def _between(asked: Asked, written: Mapping[str, Any], found: Iterable[tuple[str, str]]) -> Iterator[Mistake]:
    """Give the mistakes between keys; none is missing that is misspelt, or in a table that is wrong."""
    known = {path for path, _ in asked.mistakes} | {*asked.wrong}
    for key, words in found:
        path = steps_of(key)
        if value_at(written, path) is not None or not {path, path[:1]} & known:
            yield path, words


def _refuse(source: Source, mistakes: Iterable[Mistake]) -> None:
    """Raise StudyError with what is wrong with a study, in the order of its lines, if anything is."""
    sentences = []
    for path, words in mistakes:
        value, place = value_at(source.data, path), source.place(path)
        file, _, line = place.rpartition(":")
        written = "" if value is None else f" = {shown(value)}"
        order = (file, int(line)) if line.isdecimal() else ("", 0)
        sentences.append((order, f"{place}: {dotted(path)}{written}: {words}"))
    found = [*source.mistakes, *(sentence for _, sentence in sorted(sentences, key=itemgetter(0)))]
    if len(found) > MOST_MISTAKES:
        found[MOST_MISTAKES:] = [f"... and {len(found) - MOST_MISTAKES} more mistakes; fix these first"]
    if found:
        raise StudyError(found)
