"""The loops of a fit: one file, or several that a pattern names, each with points enough."""

import hashlib
from collections.abc import Mapping
from dataclasses import replace
from glob import glob
from pathlib import Path
from typing import Any, Final

import numpy as np

from gradhesion.cli.study.fit.form import FitForm, Search
from gradhesion.cli.study.fit.loop_columns import LoopFileError
from gradhesion.cli.study.fit.loop_file import LoopFile, nothing, read_loops
from gradhesion.cli.study.rules.mistakes import Checked, Mistake
from gradhesion.cli.study.text.places import Path as Key
from gradhesion.cli.study.text.source import Source
from gradhesion.cli.tables.columns import changed
from gradhesion.cli.terminal.amounts import counted

FILE: Final[Key] = ("data", "file")
MOST: Final = 10_000
"""Files of one study: each is a fit."""


def names_of(folder: Path, file: str) -> list[str]:
    """
    Name the files that a pattern means, sorted; a file that has the name is meant itself.

    >>> names_of(Path("no such folder"), "loop.csv"), names_of(Path("no such folder"), "*.csv")
    (['loop.csv'], [])
    """
    if not any(mark in file for mark in "*?[") or (folder / file).exists():
        return [file]
    found = glob(file, root_dir=folder, recursive=True)  # noqa: PTH207 (patterns may be absolute)
    return sorted(name for name in found if (folder / name).is_file())


def loops_of(source: Source, found: Checked) -> tuple[tuple[LoopFile, ...], list[Mistake]]:
    """Read all loops; one of several that cannot be read is kept with its problem, unless none can."""
    form = found.form
    file, table = form.data.file, form.data
    names = names_of(source.folder, file)
    if not names or len(names) > MOST:
        what = f"{len(names):,} files are more than {MOST:,}" if names else "no file matches this pattern"
        return (), [Mistake(FILE, file, f'{what}; write the path from the folder of the study, as "curves/*.csv"')]
    loops: list[LoopFile] = []
    wrong: list[Mistake] = []
    for name in names:
        try:
            own = [_enough(loop, form) for loop in read_loops(source.folder / name, name, form)]
        except LoopFileError as error:
            path: Key = ("data", error.key)
            wrong.append(Mistake(path, found.at(path), str(error)))
            own = [nothing(name, str(error), _digest(source.folder / name))]
        loops += own
    problems = [loop for loop in loops if loop.problem]
    if len(problems) == len(loops):
        where = "" if len(loops) == 1 else f"{problems[0].file}: "
        more = "" if len(loops) == 1 else f" (and so with each of the {counted(len(loops), 'loop')})"
        first = wrong[0] if wrong else Mistake(FILE, file, problems[0].problem)
        return tuple(loops), [replace(first, sentence=f"{where}{first.sentence}{more}")]
    sha256 = fingerprint(loops)
    if table.sha256 and table.sha256 != sha256:
        sentence = changed(sha256, table.sha256, "remove sha256", several=file not in names)
        return tuple(loops), [Mistake(FILE, file, sentence)]
    return tuple(loops), []


def fingerprint(loops: list[LoopFile] | tuple[LoopFile, ...]) -> str:
    """Give the SHA-256 of the file, or of the names and fingerprints of several."""
    own: Mapping[str, str] = {loop.file.partition("#")[0]: loop.sha256 for loop in loops}
    if len(own) == 1:
        return next(iter(own.values()))
    return hashlib.sha256("".join(f"{name} {sha256}\n" for name, sha256 in own.items()).encode()).hexdigest()


def _digest(path: Path) -> str:
    """Give the fingerprint of a file that is no loop; empty where it cannot be read."""
    if not path.is_file():  # to open a pipe would wait for who writes into it
        return ""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return ""


def _enough(loop: LoopFile, form: FitForm) -> LoopFile:
    """
    Check that a loop has points enough, and is one.

    Raises
    ------
    LoopFileError
        It has not, or is none.
    """
    searched: list[Any] = [name for name, entry in form.entries.items() if isinstance(entry, Search)]
    zeros = form.fit.offsets.names
    count = len(searched) + len(zeros)
    if loop.depth.size <= count:
        plural = {1: "offset", 2: "two offsets", 3: "two offsets and the tilt"}.get(len(zeros), "")
        and_offsets = f" and the {plural}" if plural else ""
        raise LoopFileError(
            "file",
            f"{loop.depth.size} points are too few for {count} fitted values ({', '.join(searched)}{and_offsets}); "
            "measure more points, or fix some",
        )
    if not (np.ptp(loop.depth) > 0.0 and np.ptp(loop.load) > 0.0):
        row = "depth" if np.ptp(loop.depth) == 0.0 else "load"
        raise LoopFileError(
            "file", f"all values of the {row} are the same, so that there is no loop; name another column"
        )
    return loop
