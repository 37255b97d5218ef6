"""Measured loops: depth and load in SI units, which way the points go, how noisy they are, and their means."""

import hashlib
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from glob import glob
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.disk import read_at_most
from gradhesion.cli.study.fit.columns import PAUSE, LoopFileError, Rows, read_raw
from gradhesion.cli.study.rules.fit_form import DataTable
from gradhesion.cli.tables.reading import MOST_BYTES
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.loops.measured import points as loop_points
from gradhesion.core.loops.measured.features import fault_of
from gradhesion.core.loops.measured.points import MOST, averaged, noise_of

MOST_FILES: Final = 10_000
"""Files of one study: each is a fit."""
_NONE: Final = np.zeros(0)
_SIGNS: Final = {
    "depth": ("depth", "the load rises towards the shallowest points, but depth grows into the half-space"),
    "load": ("load", "the load falls towards the deepest points, but positive loads press"),
    "both": ("load", "the load falls towards the shallowest points: both its sign and that of the depth are wrong"),
}
"""The key that is wrong, and why, by the fault of the points."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LoopFile:
    """The points of a measured loop, or means of many."""

    depth: NDArray[np.float64] = field(default_factory=_NONE.copy)
    """In m: of the contact, or of the machine."""
    load: NDArray[np.float64] = field(default_factory=_NONE.copy)
    """In N; positive presses."""
    unloading: NDArray[np.bool_] = field(default_factory=lambda: _NONE.astype(bool))
    cycle: NDArray[np.int64] = field(default_factory=lambda: _NONE.astype(np.int64))
    """The number of the cycle of each point, from 1 unless the file has them."""
    counts: NDArray[np.float64] = field(default_factory=_NONE.copy)
    """How many points of the file each is the mean of."""
    file: str = ""
    """The name of the file, from the folder of the study; behind # which of its loops this is."""
    sha256: str = ""
    dropped: int = 0
    """Rows without a number that were left out."""
    paused: int = 0
    """Rows of pauses that were left out."""
    noise: tuple[float, float] = (0.0, 0.0)
    """Standard deviations of depth and load of a point of the file, estimated from the points."""
    problem: str = ""
    """Why it cannot be fitted, where it is one of several; it has no points then."""

    @property
    def cycles(self) -> int:
        """The number of its cycles."""
        return np.unique(self.cycle).size

    @property
    def points(self) -> int:
        """The number of points of the file."""
        return int(self.counts.sum())

    @property
    def notes(self) -> list[str]:
        """What was left out of it, and what was averaged."""
        if self.problem:
            return [f"{self.file}: {self.problem}"]
        left_out = ((self.dropped, "without a number left out"), (self.paused, "of pauses left out"))
        sentences = [f"{counted(count, 'row')} {what}" for count, what in left_out if count]
        if self.points > self.depth.size:
            sentences.append(f"{counted(self.points, 'point')} averaged along the path; {self.depth.size:,} kept")
        return [f"{self.file}: {sentence}" for sentence in sentences]


def read_loops(
    folder: Path, table: DataTable, fitted: list[str], *, average: bool, through_machine: bool
) -> tuple[LoopFile, ...]:
    """Read all loops of a study, sorted by the names of their files; LoopFileError where none of them can be fitted.

    There must be points enough for what is `fitted`; one of several loops that cannot be is kept with its problem. Many
    points are averaged if `average`; depths are displacements of a machine if `through_machine`.
    """
    names = _names_of(folder, table.file)
    if not names or len(names) > MOST_FILES:
        what = f"{len(names):,} files are more than {MOST_FILES:,}" if names else "no file matches this pattern"
        raise LoopFileError("file", f'{what}; write the path from the folder of the study, as "curves/*.csv"')
    loops: list[LoopFile] = []
    errors: list[LoopFileError] = []
    for name in names:
        try:
            sha256, found = read_raw(folder / name, table, through_machine=through_machine)
            files = ((f"{name}#{of}" if of else name, rows) for of, rows in found.items())
            loops += [_loop(rows, file, sha256, table, fitted, average=average) for file, rows in files]
        except LoopFileError as error:
            errors.append(error)
            sha256 = ""
            with suppress(OSError):
                sha256 = hashlib.sha256(read_at_most(folder / name, MOST_BYTES)).hexdigest()
            loops.append(LoopFile(file=name, problem=str(error), sha256=sha256))
    if errors and all(loop.problem for loop in loops):
        several = f" (and so with each of the {counted(len(loops), 'loop')})"
        words = str(errors[0]) if len(loops) == 1 else f"{loops[0].file}: {errors[0]}{several}"
        raise LoopFileError(errors[0].key, words)
    return tuple(loops)


def _names_of(folder: Path, file: str) -> list[str]:
    """Name the files that a pattern means, sorted; a file that has the name is meant itself."""
    if not any(mark in file for mark in "*?[") or (folder / file).exists():
        return [file]
    found = glob(file, root_dir=folder, recursive=True)  # noqa: PTH207 (patterns may be absolute)
    return sorted(name for name in found if (folder / name).is_file())


def fingerprint(loops: Iterable[LoopFile]) -> str:
    """Give the SHA-256 of the file, or of the names and fingerprints of several."""
    own = {loop.file.partition("#")[0]: loop.sha256 for loop in loops}
    if len(own) == 1:
        return next(iter(own.values()))
    return hashlib.sha256("".join(f"{name} {sha256}\n" for name, sha256 in own.items()).encode()).hexdigest()


def _loop(rows: Rows, file: str, sha256: str, table: DataTable, fitted: list[str], *, average: bool) -> LoopFile:
    """Leave rows out, tell the branches, average, and refuse what is no loop."""
    branch, numbers = (rows.get(name, np.zeros(rows["depth"].size)) for name in ("branch", "cycle"))
    paused = branch == PAUSE
    sound = np.all([np.isfinite(row) for row in (rows["depth"], rows["load"], branch, numbers)], axis=0)
    use = sound & ~paused
    if not use.any():
        why = "every row belongs to a pause" if sound.any() else "no row has numbers in all of its columns"
        raise LoopFileError("file", f"{why}; name a file with some")
    depth, load, cycle = rows["depth"][use], rows["load"][use], numbers[use].astype(np.int64)
    rank = None if "cycle" not in rows else np.unique(cycle, return_inverse=True)[1].astype(np.int32)
    if "branch" in rows:
        unloading = branch[use] == 1.0
        rank = np.ones(depth.size, np.int32) if rank is None else rank
    elif loop_points.has_order(depth, rank):
        unloading, rank = loop_points.ways(depth, rank)
    else:
        turns = int(loop_points.ways(depth)[1].max())
        what = f"the order of the points does not tell the branches ({turns:,} turns of {depth.size:,} points)"
        remedy = 'name a column that has them, branch = "branch", or sort the rows as they were measured'
        raise LoopFileError("file", f"{what}; {remedy}")
    cycle = cycle if "cycle" in rows else rank.astype(np.int64)
    if table.which is not None:
        own = unloading == (table.which == "unloading")
        if not own.any():
            raise LoopFileError("which", f"the data have no {table.which}; write the other branch, or remove which")
        depth, load, unloading, rank, cycle = (row[own] for row in (depth, load, unloading, rank, cycle))
    found = noise_of(depth, load, unloading, rank)
    kept = averaged(depth, load, unloading, rank, found, most=MOST if average else depth.size)
    if kept.depth.size < depth.size:
        number_of = dict(zip(rank.tolist(), cycle.tolist(), strict=True))
        cycle = np.array([number_of[one] for one in kept.cycle.tolist()], np.int64)
    loop = LoopFile(
        depth=kept.depth,
        load=kept.load,
        unloading=kept.unloading,
        cycle=cycle,
        counts=kept.counts,
        file=file,
        sha256=sha256,
        dropped=int(np.count_nonzero(~sound & ~paused)),
        paused=int(np.count_nonzero(paused)),
        noise=kept.noise,
    )
    _refuse(loop, table, fitted)
    return loop


def _refuse(loop: LoopFile, table: DataTable, fitted: list[str]) -> None:
    """Refuse points without contact, with a wrong sign, too few for what is fitted, or all the same."""
    fault = fault_of(loop.depth, loop.load, loop.noise[1] / np.sqrt(loop.counts), loop.unloading)
    if fault == "straight":
        raise LoopFileError("load", "the data show no contact, but a linear load; name another file or column")
    if fault:
        key, words = _SIGNS[fault]
        key = (table.depths or "indentation") if key == "depth" else key
        own = getattr(table, key)
        remedy = f'write {key} = {{ column = "{own.column if own else "..."}", sign = -1 }} with its unit'
        raise LoopFileError(key, f"{words}; {'leave its sign out' if own and own.sign == -1 else remedy}")
    if loop.depth.size <= len(fitted):
        words = f"{loop.depth.size} points are too few for {len(fitted)} fitted values ({', '.join(fitted)})"
        raise LoopFileError("file", f"{words}; measure more points, or fix some")
    for row, values in (("depth", loop.depth), ("load", loop.load)):
        if np.ptp(values) == 0.0:
            raise LoopFileError("file", f"all values of the {row} are the same; name another column")
