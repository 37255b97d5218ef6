"""A measured loop: depth and load in SI units, which way the points go, how noisy they are, and their means."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.fit.afm_file import is_force_file, read_force_file
from gradhesion.cli.study.fit.fault_words import refuse_faults, refuse_order
from gradhesion.cli.study.fit.loop_columns import PAUSE, LoopFileError, Raw, read_table
from gradhesion.cli.study.fit.rules import control_of
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.loops.measured import points as loop_points
from gradhesion.core.loops.measured.averaging import MOST, averaged
from gradhesion.core.loops.measured.noise import noise_of

if TYPE_CHECKING:
    from gradhesion.cli.study.fit.form import DataTable, FitForm


@dataclass(frozen=True, kw_only=True, eq=False)
class LoopFile:
    """The points of a measured loop, or means of many."""

    depth: NDArray[np.float64]
    """In m: of the contact, or of the machine."""
    load: NDArray[np.float64]
    """In N; positive presses."""
    unloading: NDArray[np.bool_]
    cycle: NDArray[np.int64]
    """The number of the cycle of each point, from 1 unless the file has them."""
    counts: NDArray[np.float64]
    """How many points of the file each is the mean of."""
    file: str = ""
    """The name of the file, from the folder of the study; behind # which of its loops this is."""
    through_machine: bool = False
    """Whether `depth` is the displacement of the machine."""
    sha256: str = ""
    dropped: int = 0
    """Rows without a number that were left out."""
    paused: int = 0
    """Rows of pauses that were left out."""
    noise: tuple[float, float] = field(default=(0.0, 0.0))
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
    def is_averaged(self) -> bool:
        """Whether its points are means of several."""
        return self.points > self.depth.size


def nothing(file: str, problem: str, sha256: str = "") -> LoopFile:
    """Give a loop without points, and why it has none."""
    none = np.zeros(0)
    return LoopFile(
        depth=none,
        load=none,
        counts=none,
        unloading=np.zeros(0, bool),
        cycle=np.zeros(0, np.int64),
        file=file,
        sha256=sha256,
        problem=problem,
    )


def read_loops(path: Path, file: str, form: "FitForm") -> list[LoopFile]:
    """
    Read the loops of a file: of a table one, of an instrument's file perhaps several.

    Raises
    ------
    LoopFileError
        The file cannot be read, lacks a column, or is no loop.
    """
    table, through_machine = form.data, control_of(form) == "machine"
    if is_force_file(path.name, table):
        raws = read_force_file(path, table, through_machine=through_machine)
    else:
        raws = [read_table(path, table)]
    more = {"average": form.fit.average, "through_machine": through_machine}
    return [_loop(raw, f"{file}#{raw.of}" if raw.of else file, table, **more) for raw in raws]


def _loop(raw: Raw, file: str, table: "DataTable", *, average: bool, through_machine: bool) -> LoopFile:
    """Leave rows out, tell the branches, and average."""
    paused = np.zeros(raw.depth.size, bool) if raw.branch is None else raw.branch == PAUSE
    branch = np.zeros(raw.depth.size) if raw.branch is None else raw.branch
    sound = np.isfinite(raw.depth) & np.isfinite(raw.load) & np.isfinite(branch)
    use = sound & ~paused
    if not use.any():
        why = "every row belongs to a pause" if sound.any() else "no row has numbers in all of its columns"
        raise LoopFileError("file", f"{why}; name a file with some")
    depth, load = raw.depth[use], raw.load[use]
    cycle = None if raw.cycle is None else raw.cycle[use]
    rank = None if cycle is None else np.unique(cycle, return_inverse=True)[1].astype(np.int32)
    if raw.branch is not None:
        unloading = branch[use] == 1.0
        rank = np.ones(depth.size, np.int32) if rank is None else rank
    else:
        refuse_order(depth, rank)
        unloading, rank = loop_points.ways(depth, rank)
    cycle = rank.astype(np.int64) if cycle is None else cycle
    if table.which is not None:
        own = unloading == (table.which == "unloading")
        if not own.any():
            raise LoopFileError("which", f"the data have no {table.which}; write the other branch, or remove which")
        depth, load, unloading, rank, cycle = (row[own] for row in (depth, load, unloading, rank, cycle))
    found = noise_of(depth, load, unloading, rank)
    kept = averaged(depth, load, unloading, rank, found, most=MOST if average else depth.size)
    refuse_faults(kept.depth, kept.load, kept.noise[1] / np.sqrt(kept.counts), kept.unloading, table)
    first = dict(zip(rank.tolist(), cycle.tolist(), strict=True)) if kept.depth.size < depth.size else {}
    return LoopFile(
        depth=kept.depth,
        load=kept.load,
        unloading=kept.unloading,
        cycle=np.array([first[one] for one in kept.cycle.tolist()], np.int64) if first else cycle,
        counts=kept.counts,
        file=file,
        through_machine=through_machine,
        sha256=raw.sha256,
        dropped=int(np.count_nonzero(~sound & ~paused)),
        paused=int(np.count_nonzero(paused)),
        noise=kept.noise,
    )


def notes_of(loop: LoopFile) -> list[str]:
    """Say what was left out of a loop, and what was averaged."""
    if loop.problem:
        return [f"{loop.file}: {loop.problem}"]
    sentences = []
    for count, what in ((loop.dropped, "without a number"), (loop.paused, "of pauses")):
        if count:
            were = "was" if count == 1 else "were"
            sentences.append(f"{loop.file}: {counted(count, 'row')} {what} {were} left out")
    if loop.is_averaged:
        sentences.append(
            f"{loop.file}: {counted(loop.points, 'point')} averaged along the path; {loop.depth.size:,} kept"
        )
    return sentences
