"""A study of a fit, read and checked as a whole."""

import json
import tomllib
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from gradhesion.cli import keys
from gradhesion.cli.study import places
from gradhesion.cli.study.fit_form import REQUIRED, FitForm, Search
from gradhesion.cli.study.fit_rules import form_of, mistakes_of_fit, sound_keys
from gradhesion.cli.study.fit_study import FitStudy
from gradhesion.cli.study.loop_file import LoopFile, LoopFileError, read_loop, table_of
from gradhesion.cli.study.mistakes import Checked, Mistake, checked
from gradhesion.cli.study.punch import profile_of
from gradhesion.cli.study.source import Source
from gradhesion.cli.study.written import toml_of

KEY: Final[keys.Path] = ("data", "file")


def fit_from(source: Source) -> tuple[FitStudy | None, list[Mistake]]:
    """Check a fit as a whole and read its data; None where something is wrong."""
    data, mistakes = sound_keys(source.data)
    found = checked(data, FitForm, REQUIRED)
    mistakes += [mistake for mistake in found.mistakes if not _said_better(mistake, mistakes)]
    mistakes += mistakes_of_fit(found)
    form = form_of(found)
    loop: LoopFile | None = None
    if not any(path[0] == "data" for path in (*found.wrong, *(mistake.path for mistake in mistakes))):
        loop, wrong = _loop_of(source, found)
        mistakes += wrong
    if mistakes or loop is None:
        return None, mistakes
    entries = form.entries
    fixed = {name: float(entry) for name, entry in entries.items() if isinstance(entry, int | float)}
    free = {name: (entry.start, entry.stop) for name, entry in entries.items() if isinstance(entry, Search)}
    noise = form.fit.noise
    depth_noise = None if noise is None else noise.get("indentation", noise.get("displacement"))
    return FitStudy(
        name=source.name,
        title=form.title or source.name,
        text=_stored(source, data, loop.sha256),
        file=form.data.file,
        loop=loop,
        fixed=fixed,
        free=free,
        offsets=form.fit.offsets,
        noise=loop.noise if noise is None or depth_noise is None else (depth_noise, noise["load"]),
        noise_is_given=noise is not None,
        intervals=form.fit.intervals,
        starts=form.fit.starts,
        profile=profile_of(form.profile),
        folder=source.folder,
    ), []


def _said_better(mistake: Mistake, others: list[Mistake]) -> bool:
    """Check whether a key is spoken of already."""
    return any(mistake.path[:1] == other.path[:1] for other in others)


def _loop_of(source: Source, found: Checked) -> tuple[LoopFile | None, list[Mistake]]:
    """Read the loop, and check that it is the one meant and has points enough."""
    form = form_of(found)
    table, file = form.data, form.data.file
    written = table_of(found.data)
    try:
        loop = read_loop(source.folder / file, table)
    except LoopFileError as error:
        path: keys.Path = ("data", error.key)
        return None, [Mistake(path, written.get(error.key), str(error))]
    if table.sha256 and table.sha256 != loop.sha256:
        sentence = (
            f"the file is not the one that this study was written for: its sha256 is {loop.sha256[:12]}..., not "
            f"{table.sha256[:12]}...; put that file back, or remove sha256"
        )
        return loop, [Mistake(KEY, file, sentence)]
    searched = [name for name, entry in form.entries.items() if isinstance(entry, Search)]
    count = len(searched) + 2 * form.fit.offsets
    if loop.depth.size <= count:
        and_offsets = " and the two offsets" if form.fit.offsets else ""
        sentence = (
            f"{loop.depth.size} points cannot give {count} numbers ({', '.join(searched)}{and_offsets}); measure more "
            "points, or fix some"
        )
        return loop, [Mistake(KEY, file, sentence)]
    if not (np.ptp(loop.depth) > 0.0 and np.ptp(loop.load) > 0.0):
        row = "depth" if np.ptp(loop.depth) == 0.0 else "load"
        sentence = f"all values of the {row} are the same, which is no loop; name another column"
        return loop, [Mistake(KEY, file, sentence)]
    return loop, []


def _stored(source: Source, data: Mapping[str, Any], sha256: str) -> str:
    """Give the text of a study with the fingerprint of its file."""
    if source.text and data["data"].get("sha256"):
        return source.text
    data = {**data, "data": {**data["data"], "sha256": sha256}}
    number = places.lines_of(source.text).get(KEY, 0) if source.text else 0
    if number:
        lines = source.text.split("\n")
        dot = "data." if lines[number - 1].lstrip().startswith("data.") else ""
        lines.insert(number, f"{dot}sha256 = {json.dumps(sha256)}")
        text = "\n".join(lines)
        try:
            if tomllib.loads(text) == data:
                return text
        except ValueError:
            pass
    return toml_of(data)
