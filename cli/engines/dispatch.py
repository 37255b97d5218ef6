"""Hands blocks to the workers of a cluster, a bounded number at a time, and takes care that none is lost."""

from collections import deque
from collections.abc import Generator, Iterable
from functools import partial
from queue import Empty, SimpleQueue
from typing import Any, Final

from gradhesion.cli.engines import Work
from gradhesion.cli.engines.scheduler import requested
from gradhesion.cli.engines.watch import Watch, without_workers
from gradhesion.cli.engines.worker import RefusedError, UnsolvedError, UnwritableError, carry_out, needed, seen
from gradhesion.cli.errors import ClusterError, OutputError
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.parts.parts import key_of
from gradhesion.cli.work.parts.resume import Solved, blank, found

TASKS: Final = 256
"""With the scheduler at least, so that a cluster that adapts sees what is to be done."""
TASKS_A_THREAD: Final = 3
WITHOUT_WORKER: Final = ("NoWorkerError", "NoValidWorkerError")
"""What a task ends with that had no worker for as long as its scheduler lets it wait; the last argument is the time."""
POLL: Final = 0.2
"""Seconds between two looks at what may have happened beside."""


class Dispatch:
    """Hands out the blocks of a study."""

    def __init__(self, client: Any, work: Work, *, deserted: float, quiet: bool = False) -> None:
        self._client = client
        self._work = work
        self._watch = Watch(client, deserted=deserted, quiet=quiet)
        self._order = (str(work.folder.path), work.study.sha256)
        self._needed = needed()
        self._count = 0

    def results(self, numbers: Iterable[int]) -> Generator[tuple[int, Solved], None, None]:
        """
        Give the blocks as they come.

        A worker that dies takes with it what it works on and what waits with it: which of them has killed it is not
        known. Those that Dask gives up wait until everything else is done; then each is tried alone.

        Raises
        ------
        ClusterError
            No worker can do the work.
        OutputError
            A part cannot be written, the scheduler is lost, or there is no worker for too long.
        """
        suspects = yield from self._together(numbers)
        for number in suspects:
            if (yield from self._together([number])):
                yield self._given_up(number, "KilledWorker: every worker that tried it has died")

    def _together(self, numbers: Iterable[int]) -> Generator[tuple[int, Solved], None, list[int]]:
        """Give blocks as they come, and return those whose workers have died."""
        from distributed import KilledWorker  # noqa: PLC0415 (not there without the extra)

        waiting, killed = deque(numbers), list[int]()
        tasks: dict[Any, int] = {}
        done: SimpleQueue[Any] = SimpleQueue()
        while waiting or tasks:
            interrupts.check()
            self._watch.look()
            while waiting and len(tasks) < max(TASKS, TASKS_A_THREAD * self._watch.threads):
                number = waiting.popleft()
                future = self._submitted(number)
                tasks[future.key] = number
                future.add_done_callback(done.put)
            try:
                future = done.get(timeout=POLL)
            except Empty:
                continue
            number = tasks.pop(future.key)
            self._watch.moved()
            # a failure alone is asked for: that of a task whose worker is lost since it was done would be waited for
            failure = requested(self._client, future.exception) if future.status == "error" else None
            if future.cancelled():  # with the connection to the scheduler
                waiting.appendleft(number)
                continue
            match failure:
                case None:
                    yield self._read(number)
                case KilledWorker():
                    killed.append(number)
                case RefusedError(args=(worker, reason)):
                    self._watch.refuse(worker, reason)
                    waiting.appendleft(number)
                case UnwritableError(args=(worker, reason)):
                    raise OutputError(
                        f"{self._work.path}: worker {worker} cannot write its parts ({reason}); free space or get "
                        "write permission; finished parts are kept, and the same command resumes"
                    )
                case ImportError() | AttributeError() as error:
                    raise ClusterError(
                        f"--engine dask: a worker cannot load gradhesion ({error}); install the same version for all "
                        "workers"
                    )
                case UnsolvedError() as error:
                    yield self._given_up(number, str(error))
                case error if type(error).__name__ in WITHOUT_WORKER:
                    raise without_workers(error.args[-1])
                case error:
                    yield self._given_up(number, f"{type(error).__name__}: {error}")
        return killed

    def _submitted(self, number: int) -> Any:
        """Hand a block to the scheduler."""
        self._count += 1
        submit = partial(
            self._client.submit,
            carry_out,
            *self._order,
            number,
            self._needed,
            key=(f"gradhesion-{self._client.id}", self._count),  # of one group: a long one waits with the scheduler
            pure=False,
            workers=self._watch.choice,
            allow_other_workers=self._watch.choice is not None,  # when none of these is left
        )
        return requested(self._client, submit)

    def _read(self, number: int) -> tuple[int, Solved]:
        """Read the part that a worker has written; on a network file system it may be seen a little late."""
        study, folder = self._work.study, self._work.folder
        block = study.tiling[number]
        key = key_of(study, block)
        values = seen(partial(found, study, folder, number, block, key), folder.path)
        if isinstance(values, str):
            return self._given_up(number, f"PartError: on this machine, the part that a worker has written is {values}")
        return number, Solved(block, values, key)

    def _given_up(self, number: int, reason: str) -> tuple[int, Solved]:
        """Give a block that has no values."""
        block = self._work.study.tiling[number]
        return number, Solved(block, blank(self._work.study, block), error=reason)
