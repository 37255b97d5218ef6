"""Hands out blocks to the workers of a cluster, a bounded number at a time, and takes care that none is lost."""

import time
from collections.abc import Generator, Iterable
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from typing import Any, Final

from gradhesion.cli import interrupts
from gradhesion.cli.engines import Work
from gradhesion.cli.engines.supply import Supply
from gradhesion.cli.engines.watch import Watch
from gradhesion.cli.engines.worker import SIGHT, carry_out, needed
from gradhesion.cli.errors import ClusterError, OutputError
from gradhesion.cli.work.parts import Results, key_of
from gradhesion.cli.work.resume import Solved, blank, found

FLYING: Final = 256
"""Tasks at least in the hands of the scheduler, so that a cluster that adapts sees what is to be done."""
FLYING_A_THREAD: Final = 3
POLL: Final = 0.2
"""Seconds between two looks at what may have happened beside."""

Key = tuple[str, int]


@dataclass(frozen=True)
class Task:
    """Blocks that are handed out."""

    future: Any
    numbers: tuple[int, ...]
    alone: bool
    """Whether nothing else is at work: then it is guilty of the death of its worker."""
    workers: frozenset[str] | None
    """The only ones that may do it; None is all."""


class Foreman:
    """Hands out the blocks of a study."""

    def __init__(self, client: Any, work: Work, left: Iterable[int], *, quiet: bool = False) -> None:
        self._client = client
        self._work = work
        self._supply = Supply(left)
        self._watch = Watch(client, quiet=quiet)
        self._flying: dict[Key, Task] = {}
        self._landed: SimpleQueue[Key] = SimpleQueue()
        self._count = 0
        self._order = (str(work.folder.path), work.study.sha256)
        self._needed = needed()

    def results(self) -> Generator[tuple[int, Solved], None, None]:
        """Give the blocks as they come."""
        self._watch.look()
        try:
            while self._supply or self._flying:
                interrupts.check()
                self._hand_out()
                try:
                    key = self._landed.get(timeout=POLL)
                except Empty:
                    key = ("", 0)
                task = self._flying.pop(key, None)
                if task is not None:
                    yield from self._taken(task)
                    self._watch.moved()
                if self._watch.due():
                    self._watch.look()
                    self._call_back_strays()
        finally:
            if self._flying and self._client.status == "running":
                self._client.cancel([task.future for task in self._flying.values()], force=True)
            self._flying.clear()

    def _hand_out(self) -> None:
        """Keep enough tasks in the hands of the scheduler."""
        while len(self._flying) < max(FLYING, FLYING_A_THREAD * self._watch.threads):
            numbers, alone = self._supply.take(threads=self._watch.threads, flying=len(self._flying))
            if not numbers:
                return
            self._submit(numbers, alone=alone)

    def _submit(self, numbers: tuple[int, ...], *, alone: bool) -> None:
        """Hand out a task."""
        self._count += 1
        workers = self._watch.fit
        key = (f"gradhesion-{self._client.id}", self._count)  # of one group: a long one waits with the scheduler
        future = self._client.submit(
            carry_out,
            *self._order,
            numbers,
            self._needed,
            key=key,
            pure=False,
            workers=None if workers is None else sorted(workers),
        )
        self._flying[key] = Task(future, numbers, alone, workers)
        future.add_done_callback(lambda future: self._landed.put(future.key))

    def _taken(self, task: Task) -> Generator[tuple[int, Solved], None, None]:
        """Take what a worker has done, or deal with what it has not."""
        from distributed import CancelledError, KilledWorker  # noqa: PLC0415 (not there without the extra)

        try:
            told = task.future.result(timeout=SIGHT)
        except KilledWorker:
            reason = "KilledWorker: every worker that tried it has died"
            yield from self._given_up(self._supply.killed(task.numbers, alone=task.alone), reason)
        except (CancelledError, TimeoutError):
            reason = "CancelledError: the scheduler has dropped it again and again"
            yield from self._given_up(self._supply.back(task.numbers), reason)
        except (ImportError, AttributeError) as error:
            raise ClusterError(
                f"--engine dask: a worker cannot load gradhesion ({error}); install the same version for all workers"
            ) from None
        except Exception as error:  # noqa: BLE001 (whatever a worker may raise, its neighbours go on)
            yield from self._given_up(self._supply.back(task.numbers), f"{type(error).__name__}: {error}")
        else:
            yield from self._read(task, told)
        finally:
            task.future.release()

    def _read(self, task: Task, told: dict[str, Any]) -> Generator[tuple[int, Solved], None, None]:
        """Read the parts that a worker has written."""
        if told["refused"]:
            self._watch.refuse(told["worker"], told["refused"])
            self._supply.again(task.numbers)
            return
        if told["unwritable"]:
            raise OutputError(
                f"{self._work.path}: worker {told['worker']} cannot write its parts ({told['unwritable']}); make room "
                "or get the right to write; finished parts are kept, and the same command goes on"
            )
        self._supply.done(len(task.numbers), told["seconds"])
        for number in task.numbers:
            if number in told["errors"]:
                yield from self._given_up((number,), told["errors"][number])
                continue
            block = self._work.study.tiling[number]
            key = key_of(self._work.study, block)
            values = self._seen(number, block, key)
            if isinstance(values, dict):
                yield number, Solved(block, values, key)
            else:
                reason = f"PartError: the part that worker {told['worker']} has written is {values}"
                yield from self._given_up(self._supply.back((number,)), reason)

    def _seen(self, number: int, block: tuple[slice, ...], key: str) -> Results | str:
        """Read a part; on a network file system it may be seen a little late."""
        deadline = time.monotonic() + SIGHT
        while True:
            values = found(self._work.study, self._work.folder, number, block, key)
            if isinstance(values, dict) or time.monotonic() > deadline:
                return values
            interrupts.check()
            self._work.folder.parts()  # makes it look
            time.sleep(POLL)

    def _given_up(self, numbers: Iterable[int], reason: str) -> Generator[tuple[int, Solved], None, None]:
        """Give blocks that have no values."""
        for number in numbers:
            block = self._work.study.tiling[number]
            yield number, Solved(block, blank(self._work.study, block), error=reason)

    def _call_back_strays(self) -> None:
        """Hand out anew what only workers may do that are no more."""
        for key, task in list(self._flying.items()):
            if task.workers is not None and self._watch.present and not task.workers & self._watch.present:
                del self._flying[key]
                self._client.cancel([task.future], force=True)
                self._supply.again(task.numbers)
