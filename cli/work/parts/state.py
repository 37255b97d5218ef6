"""How far a run is, in a small file that another shell can read at any moment."""

import os
import platform
import time
from contextlib import suppress
from pathlib import Path
from typing import Final

from gradhesion.cli.work.parts.records import State, write_record

PERIOD: Final = 1.0
"""Seconds between two states."""


class Keeper:
    """Keeps the file of a state up to date; a file that cannot be written is no reason to end a run."""

    def __init__(self, path: Path, *, scenes: int, blocks: int) -> None:
        self.state = State(scenes, blocks, _now(), pid=os.getpid(), host=platform.node())
        self._path = path
        self._begun = time.monotonic()
        self._last = -PERIOD
        self.write()

    def add(self, *, scenes: int, failed: int, reused: bool, raised: bool) -> None:
        """Count a block that is done."""
        state = self.state
        state.blocks_done += 1
        state.scenes_done += scenes
        state.scenes_failed += failed
        state.blocks_reused += reused
        state.scenes_reused += scenes * reused
        state.blocks_raised += raised
        if time.monotonic() - self._last >= PERIOD:
            self.write()

    def write(self) -> None:
        """Write the state now."""
        self.state.updated = _now()
        self._last = time.monotonic()
        self.state.seconds = self._last - self._begun
        with suppress(OSError):
            write_record(self._path, self.state, sync=False)


def _now() -> float:
    """Give the seconds since 1970; a clock that is set to before says 0."""
    return max(0.0, time.time())
