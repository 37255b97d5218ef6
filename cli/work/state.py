"""How far a run is, in a small file that another shell can read at any moment."""

import os
import platform
import time
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Final

from gradhesion.cli.work.folder import write_json

PERIOD: Final = 1.0
"""Seconds between two states."""


@dataclass
class State:
    """How far a run is; times are seconds since 1970."""

    scenes: int
    blocks: int
    started: float
    updated: float = 0.0
    pid: int = 0
    host: str = ""
    blocks_done: int = 0
    blocks_reused: int = 0
    scenes_done: int = 0
    scenes_reused: int = 0
    scenes_failed: int = 0
    blocks_raised: int = 0


class Keeper:
    """Keeps the file of a state up to date; a file that cannot be written is no reason to end a run."""

    def __init__(self, path: Path, *, scenes: int, blocks: int) -> None:
        self.state = State(scenes, blocks, time.time(), pid=os.getpid(), host=platform.node())
        self._path = path
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
        self.state.updated = time.time()
        self._last = time.monotonic()
        with suppress(OSError):
            write_json(self._path, asdict(self.state), sync=False)
