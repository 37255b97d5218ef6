"""A study of a fit, read and checked as a whole."""

from collections.abc import Mapping
from typing import Any

from gradhesion.cli.keys import INTERACTION
from gradhesion.cli.study.fit.form import NUMBER_ALONE, REQUIRED, FitForm, Search
from gradhesion.cli.study.fit.loop_file import LoopFile
from gradhesion.cli.study.fit.loop_files import fingerprint, loops_of
from gradhesion.cli.study.fit.rules import control_of, form_of, mistakes_of_fit, sound_keys
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.form.mistakes import Mistake, checked
from gradhesion.cli.study.rules.edge import toughness_of
from gradhesion.cli.study.rules.punch import profile_of
from gradhesion.cli.study.text.source import Source
from gradhesion.cli.study.text.written import toml_of, with_fingerprint
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.rate import Rate


def fit_from(source: Source) -> tuple[FitStudy | None, list[Mistake]]:
    """Check a fit as a whole and read its loops; None where something is wrong."""
    data, mistakes = sound_keys(source.data)
    found = checked(data, FitForm, REQUIRED)
    mistakes += [mistake for mistake in found.mistakes if not _said_better(mistake, mistakes)]
    mistakes += mistakes_of_fit(found)
    form = form_of(found)
    loops: tuple[LoopFile, ...] = ()
    if not any(path[0] == "data" for path in (*found.wrong, *(mistake.path for mistake in mistakes))):
        loops, wrong = loops_of(source, found)
        mistakes += wrong
    if mistakes or not loops:
        return None, mistakes
    entries = form.entries
    fixed = {name: float(entry) for name, entry in entries.items() if isinstance(entry, int | float)}
    free = {name: (entry.start, entry.stop) for name, entry in entries.items() if isinstance(entry, Search)}
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
        profile=profile_of(form.profile),
        loading=Loading(control=control_of(form)),
        toughness=toughness_of(form.toughness),
        rate=None if form.rate is None else Rate(exponent=exponent, closing=form.rate.closing),
        adhesion_range=fixed.get(INTERACTION),
        folder=source.folder,
    ), []


def _said_better(mistake: Mistake, others: list[Mistake]) -> bool:
    """Check whether a key is spoken of already."""
    return any(mistake.path[:1] == other.path[:1] for other in others)


def _stored(source: Source, data: Mapping[str, Any], sha256: str) -> str:
    """Give the text of a study with the fingerprint of its file."""
    if source.text and data["data"].get("sha256"):
        return source.text
    data, text = with_fingerprint(data, source.text, "data", sha256)
    return text or toml_of(data)
