"""A study of a fit, read and checked as a whole."""

from collections.abc import Mapping
from typing import Any

from gradhesion.cli.study.fit.form import NUMBER_ALONE, REQUIRED, FitForm, Search
from gradhesion.cli.study.fit.loop_file import LoopFile
from gradhesion.cli.study.fit.loop_files import fingerprint, loops_of
from gradhesion.cli.study.fit.rules import broken, control_of, sound_keys
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.rules.asked import steps_of
from gradhesion.cli.study.rules.mistakes import Mistake, checked
from gradhesion.cli.study.rules.scenes import shape_of
from gradhesion.cli.study.text.source import Source
from gradhesion.cli.study.text.written import toml_of, with_fingerprint
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.toughness import Rate


def fit_from(source: Source) -> tuple[FitStudy | None, list[Mistake]]:
    """Check a fit as a whole and read its loops; None where something is wrong."""
    data, mistakes = sound_keys(source.data)
    found = checked(data, FitForm, REQUIRED)
    spoken = {mistake.path[0] for mistake in mistakes}
    mistakes += [mistake for mistake in found.mistakes if mistake.path[0] not in spoken]
    mistakes += [Mistake(path, found.at(path), words) for path, words in _broken(broken(found))]
    form = found.form
    loops: tuple[LoopFile, ...] = ()
    if not any(path[0] == "data" for path in (*found.wrong, *(mistake.path for mistake in mistakes))):
        loops, wrong = loops_of(source, found)
        mistakes += wrong
    if mistakes or not loops:
        return None, mistakes
    fixed = {name: float(entry) for name, entry in form.entries.items() if isinstance(entry, int | float)}
    free = {name: (entry.start, entry.stop) for name, entry in form.entries.items() if isinstance(entry, Search)}
    noise = form.fit.noise
    depth_noise = None if noise is None else noise.get("indentation", noise.get("displacement"))
    exponent = fixed.pop("exponent", 0.0) or sum(free.get("exponent", ())) / 2.0
    return FitStudy(
        name=source.name,
        title=form.title or source.name,
        text=_stored(source, data, fingerprint(loops)),
        file=form.data.file,
        loops=loops,
        fixed={name: value for name, value in fixed.items() if name not in NUMBER_ALONE},
        free=free,
        offsets=form.fit.offsets,
        average=form.fit.average,
        given_noise=None if noise is None or depth_noise is None else (depth_noise, noise["load"]),
        intervals=form.fit.intervals,
        starts=form.fit.starts,
        profile=shape_of(form.profile),
        loading=Loading(control=control_of(form)),
        toughness=form.toughness.made() if form.toughness else None,
        rate=None if form.rate is None else Rate(exponent=exponent, closing=form.rate.closing),
        adhesion_range=fixed.get("adhesion_range"),
        folder=source.folder,
    ), []


def _broken(found: Any) -> list[tuple[Any, str]]:
    """Give the keys of what is wrong as steps."""
    return [(steps_of(path), words) for path, words in found]


def _stored(source: Source, data: Mapping[str, Any], sha256: str) -> str:
    """Give the text of a study with the fingerprint of its file."""
    if source.text and data["data"].get("sha256"):
        return source.text
    data, text = with_fingerprint(data, source.text, "data", sha256)
    return text or toml_of(data)
