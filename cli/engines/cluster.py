"""The engine that hands blocks to the workers of a Dask cluster, and reads the parts that they write."""

from collections.abc import Generator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any

from gradhesion.cli.engines import Work
from gradhesion.cli.engines.dispatch import Dispatch
from gradhesion.cli.engines.local import local_client
from gradhesion.cli.engines.scheduler import client_of, silent
from gradhesion.cli.engines.watch import DESERTED, DESERTED_HERE
from gradhesion.cli.work.compiling import compile_for
from gradhesion.cli.work.parts.parts import key_of
from gradhesion.cli.work.parts.resume import Solved, found


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
            No scheduler answers, or no worker is usable.
        OutputError
            A part cannot be written, the scheduler is lost, or it has no worker for too long.
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
            compile_for(study)  # before there are processes that would all do so
        with silent(), self._client(len(left)) as client:
            dispatch = Dispatch(client, work, deserted=self._deserted(), quiet=self.quiet)
            yield from dispatch.results(left)

    def _deserted(self) -> float:
        """Give the seconds without any worker after which a run ends."""
        import dask  # noqa: PLC0415 (not there without the extra)

        own = dask.config.get("distributed.scheduler.no-workers-timeout", None)
        if own is not None:
            return float(dask.utils.parse_timedelta(own))
        return DESERTED_HERE if self.scheduler is None else DESERTED

    def _client(self, most: int) -> AbstractContextManager[Any]:
        """Make a client of the scheduler, or of a cluster of this machine."""
        return local_client(self.workers, most) if self.scheduler is None else client_of(self.scheduler)
