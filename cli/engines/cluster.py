"""The engine that hands blocks to the workers of a Dask cluster, and reads the parts that they write."""

import os
from collections.abc import Generator
from dataclasses import dataclass

from gradhesion.cli.engines import Work
from gradhesion.cli.engines.connection import connected
from gradhesion.cli.engines.foreman import Foreman
from gradhesion.cli.work.kernels import compile_kinds, kinds_of
from gradhesion.cli.work.parts import key_of
from gradhesion.cli.work.resume import Solved, found


@dataclass(frozen=True)
class Cluster:
    """Has blocks solved by the workers of a cluster."""

    scheduler: str | None = None
    """An address, or the file of a scheduler; None is a cluster of this machine for the time of the run."""
    workers: int | None = None
    """Of a cluster of this machine: a process a core if None."""
    quiet: bool = False

    def results(self, work: Work) -> Generator[tuple[int, Solved], None, None]:
        """
        Give the blocks: those that are parts first, then the others as they come.

        Raises
        ------
        ClusterError
            No scheduler answers, or no worker can do the work.
        OutputError
            A part cannot be written, or the scheduler has gone.
        """
        study, left = work.study, []
        for number in work.numbers:
            block = study.tiling[number]
            key = key_of(study, block)
            values = found(study, work.folder, number, block, key)
            if isinstance(values, dict):
                yield number, Solved(block, values, key, reused=True)
            else:
                left.append(number)
        if not left:
            return
        if self.scheduler is None:
            compile_kinds(kinds_of(study))  # before there are processes that would all do so
        workers = min(self.workers or len(os.sched_getaffinity(0)), len(left))
        with connected(self.scheduler, workers) as client:
            yield from Foreman(client, work, left, quiet=self.quiet).results()
