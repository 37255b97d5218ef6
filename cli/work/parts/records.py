"""The small files of a run's folder, whose fields have types: one that is not whole, or not of ours, reads as None."""

import os
import platform
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Final, TypeVar

from pydantic import Field, TypeAdapter

from gradhesion.cli.disk import write_whole
from gradhesion.cli.files import read_at_most
from gradhesion.cli.study.tiling import CHUNK

MOST_BYTES: Final = 2**29
"""Of a small file: the text of the largest study that is read, and more."""

PERIOD: Final = 1.0
"""Seconds between two states."""

Count = Annotated[int, Field(ge=0, lt=2**63)]
Time = Annotated[float, Field(ge=0.0, lt=1e11)]
"""Seconds since 1970."""


@dataclass(frozen=True)
class Manifest:
    """A study as `study.json` has it: what its values depend on first, then how to read it again."""

    versions: dict[str, Any]
    settings: dict[str, Any]
    parameters: dict[str, tuple[str, str]]
    """Each in words, with the digest of its values."""
    blocks: Count
    scenes: Count
    title: str
    name: str
    text: str
    chunk: Annotated[int, Field(ge=1, lt=2**63)] = CHUNK
    folder: str = field(default="", compare=False)
    """Where the files are that the study names: their contents count, not their place."""


@dataclass(frozen=True)
class Finished:
    """Which file is to take the output's place, as `finished.json` has it."""

    file: tuple[int, int, int, int]
    """Its `identity`."""
    study: Manifest
    failed: Count = 0
    """Scenes without value."""


@dataclass
class State:
    """How far a run is, as `state.json` has it."""

    scenes: Count
    blocks: Count
    started: Time
    updated: Time = 0.0
    seconds: Annotated[float, Field(ge=0.0, lt=1e11)] | None = None
    """Between the two, by a clock that nobody sets."""
    pid: Count = 0
    host: str = ""
    blocks_done: Count = 0
    blocks_reused: Count = 0
    scenes_done: Count = 0
    scenes_reused: Count = 0
    scenes_failed: Count = 0
    blocks_raised: Count = 0


Record = TypeVar("Record", Manifest, Finished, State)


def read_record(path: Path, kind: type[Record]) -> Record | None:
    """Read a small file; None if it is not there, not whole, a link, or not what it should be."""
    with suppress(OSError, ValueError):
        if path.is_symlink():
            return None
        return TypeAdapter(kind).validate_json(read_at_most(path, MOST_BYTES), strict=True)
    return None


def write_record(path: Path, record: Record, *, sync: bool = True) -> None:
    """Write a small file, whole or not at all."""
    write_whole(path, TypeAdapter(type(record)).dump_json(record, indent=1), sync=sync)


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
