"""An eye on a cluster: which workers are there and fit, and whether anything moves."""

import time
from typing import Any, Final

from gradhesion.cli.engines.scheduler import patience, requested
from gradhesion.cli.errors import ClusterError, OutputError
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import counted

PERIOD: Final = 1.0
"""Seconds between two looks."""
LONELY: Final = 10.0
"""Seconds without a finished block until a message, if there is no worker; the next comes after twice the time."""
STILL: Final = 600.0
"""The same if there are workers."""
DESERTED: Final = 86_400.0
"""Seconds without any worker after which a run ends: the jobs of workers may wait in a queue for hours."""
DESERTED_HERE: Final = 60.0
"""The same of a cluster of this machine, which replaces a worker that has died in seconds."""
FRUITLESS: Final = 12
"""Workers that may come and go without a finished block, beside four for each that is there at once."""


class Watch:
    """Watches the workers of a client."""

    def __init__(self, client: Any, *, deserted: float, quiet: bool = False) -> None:
        self._client = client
        self._deserted = deserted
        self._quiet = quiet
        self._refused: dict[str, str] = {}
        self._workers: dict[str, int] = {}
        self._looked = -PERIOD
        self._lost: float | None = None
        self._most = 0
        self.moved()

    @property
    def fit(self) -> list[str]:
        """The workers that are there and not refused."""
        return sorted(self._workers.keys() - self._refused.keys())

    @property
    def choice(self) -> list[str] | None:
        """The workers to choose from; None if all are fit."""
        return self.fit if self._refused else None

    @property
    def threads(self) -> int:
        """Of all workers that are fit."""
        return sum(self._workers[worker] for worker in self.fit)

    def moved(self) -> None:
        """Note that a block has come back."""
        self._moved, self._next = time.monotonic(), LONELY
        self._come = {*self._workers}

    def refuse(self, worker: str, reason: str) -> None:
        """
        Give no more work to a worker.

        Raises
        ------
        ClusterError
            There is no other.
        """
        if worker not in self._refused:
            self._say("refused", f"worker {worker} {reason}; it gets no blocks", worker=worker)
        self._refused[worker] = reason
        self._looked = -PERIOD
        self.look()

    def look(self) -> None:
        """
        See who is there, once a period.

        Raises
        ------
        ClusterError
            All that are there are refused.
        OutputError
            The scheduler is lost, has had no worker for so long that none will come, has none that lives, or none
            that Dask lets begin a block.
        """
        if time.monotonic() - self._looked < PERIOD:
            return
        client = self._client
        there = requested(client, lambda: client.sync(client.scheduler.identity, callback_timeout=patience()))[
            "workers"
        ]
        self._workers = {worker: one["nthreads"] for worker, one in there.items()}
        self._looked = time.monotonic()
        many = len(self._workers)
        able = any(one["status"] != "paused" for one in there.values())
        if able:
            self._lost = None
        elif self._lost is None:  # now, however long ago the last look was
            self._lost = self._looked
        elif self._looked - self._lost > self._deserted:
            raise paused_workers(many, self._deserted) if many else without_workers(self._deserted)
        self._come |= self._workers.keys()
        self._most = max(self._most, many)
        gone = len(self._come) - many
        if gone > FRUITLESS + 4 * self._most:
            raise OutputError(
                f"--engine dask: {gone:,} workers have started and ended since the last finished block; give them the "
                "memory and the time that `gradhesion plan` shows; finished parts are kept, and the same command "
                "resumes"
            )
        if many and not self.fit:
            worker = min(self._workers)
            raise ClusterError(
                f"--engine dask: no worker is usable: worker {worker} {self._refused[worker]}; start workers "
                "in the environment and on the file system of this command"
            )
        seconds = self._looked - self._moved
        if seconds > (max(self._next, STILL) if able else self._next):
            self._next = 2 * seconds
            ends = f"{in_words(self._deserted)} the run ends"
            if able:
                why = (
                    f"with {counted(many, 'worker')} there; workers whose lifetime or memory limit is below what "
                    "`gradhesion plan` shows finish none"
                )
            elif many:
                why = f"because Dask has paused all workers for lack of memory; after {ends}"
            else:
                why = f"waiting for workers; without any for {ends}"
            sentence = f"no block has finished for {seconds:.0f} s, {why}"
            self._say("waiting", sentence, seconds=seconds, workers=many)

    def _say(self, event: str, sentence: str, **fields: Any) -> None:
        """Print a message, unless all is to be quiet."""
        if not self._quiet:
            messages.say(event, sentence, **fields)


def without_workers(seconds: float) -> OutputError:
    """Make the error of a run that no worker is left for."""
    return OutputError(
        f"--engine dask: no worker has been connected for {in_words(seconds)}; finished parts are kept, and the same "
        "command resumes once there are workers"
    )


def paused_workers(many: int, seconds: float) -> OutputError:
    """Make the error of a run whose workers have no memory to begin another block."""
    return OutputError(
        f"--engine dask: Dask has paused all workers ({many:,}) for lack of memory for {in_words(seconds)}; give them "
        "the memory that `gradhesion plan` shows; finished parts are kept, and the same command resumes"
    )


def in_words(seconds: float) -> str:
    """
    Write down a time.

    >>> in_words(60.0), in_words(86_400.0)
    ('60 s', '24 h')
    """
    return f"{seconds:.3g} s" if seconds < 7200.0 else f"{seconds / 3600.0:.3g} h"
