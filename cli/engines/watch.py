"""An eye on a cluster: which workers are there and fit, and whether anything moves; what is wrong is told."""

import time
from typing import Any, Final

from gradhesion.cli import messages
from gradhesion.cli.errors import ClusterError, OutputError

PERIOD: Final = 1.0
"""Seconds between two looks."""
ANSWER: Final = 10.0
"""Seconds that the scheduler has to answer."""
SILENCE: Final = 30.0
"""Seconds without a scheduler until the run ends."""
LONELY: Final = 10.0
"""Seconds without a worker until it is told; each further word comes after twice the time."""
STILL: Final = 600.0
"""Seconds without a finished block until it is told."""


class Watch:
    """Watches the workers of a client."""

    def __init__(self, client: Any, *, quiet: bool = False) -> None:
        self._client = client
        self._quiet = quiet
        self._refused: dict[str, str] = {}
        self._looked = 0.0
        now = time.monotonic()
        self._answered = self._peopled = self._moved = now
        self._next_lonely = LONELY
        self._next_still = STILL
        self.present: frozenset[str] = frozenset()
        self.threads = 0
        """Of all workers that are fit."""

    @property
    def fit(self) -> frozenset[str] | None:
        """The workers to choose from; None if all are fit."""
        return (self.present - self._refused.keys()) or None if self._refused else None

    def due(self) -> bool:
        """Tell whether it is time for a look."""
        return time.monotonic() - self._looked > PERIOD

    def moved(self) -> None:
        """Note that a task has come back."""
        self._moved = time.monotonic()
        self._next_still = STILL

    def refuse(self, worker: str, reason: str) -> None:
        """
        Give no more work to a worker.

        Raises
        ------
        ClusterError
            There is no other.
        """
        if worker not in self._refused:
            self._refused[worker] = reason
            self._say("refused", f"worker {worker} {reason}; it gets no blocks", worker=worker)
        self.look()
        self._refuse_all()

    def look(self) -> None:
        """
        See who is there.

        Raises
        ------
        ClusterError
            All that are there are refused.
        OutputError
            The scheduler has gone.
        """
        self._looked = now = time.monotonic()
        try:
            workers = self._client.sync(self._client.scheduler.ncores, callback_timeout=ANSWER)
        except (OSError, RuntimeError, AttributeError):  # whatever a connection breaks with
            if self._client.status == "closed" or now - self._answered > SILENCE:
                raise OutputError(
                    "--engine dask: the scheduler does not answer any more; finished parts are kept, and the same "
                    "command goes on from there when there is a scheduler again"
                ) from None
            return
        self._answered = now
        self.present = frozenset(workers)
        self.threads = sum(many for worker, many in workers.items() if worker not in self._refused)
        self._refuse_all()
        if workers:
            self._peopled, self._next_lonely = now, LONELY
        elif now - self._peopled > self._next_lonely:
            seconds = now - self._peopled
            self._next_lonely = 2 * seconds
            self._say("waiting", f"waiting for workers: there have been none for {seconds:.0f} s", seconds=seconds)
        if workers and now - self._moved > self._next_still:
            seconds = now - self._moved
            self._next_still = 2 * seconds
            self._say(
                "waiting",
                f"no block has been finished for {seconds:.0f} s, with {len(workers):,} workers there; a block takes "
                "as long as `gradhesion plan` tells, and workers whose lifetime is shorter finish none",
                seconds=seconds,
            )

    def _refuse_all(self) -> None:
        """End where no worker is fit."""
        if self.present and self.present <= self._refused.keys():
            worker = next(iter(self.present))
            raise ClusterError(
                f"--engine dask: no worker can do the work: worker {worker} {self._refused[worker]}; start workers "
                "in the environment and on the file system of this command"
            )

    def _say(self, event: str, sentence: str, **fields: Any) -> None:
        """Tell something, unless all is to be quiet."""
        if not self._quiet:
            messages.say(event, sentence, **fields)
