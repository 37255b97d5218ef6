"""The folder of a run, FILE.nc.parts beside its output: its lock, its parts, and what a killed run has left there.

lock            held for as long as a run lives; a shard holds it for the moment in which it takes its own
lock-1-of-8     held for as long as this shard lives
study.json      the study whose parts these are
000012.part     a block that is done
state.json      how far the run is, for `gradhesion status`
merged.nc       the dataset in the making
finished.json   which file is to take the output's place: if it has, what is left here is of no use
"""

import json
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from gradhesion.cli import interrupts
from gradhesion.cli.disk import write_whole
from gradhesion.cli.errors import OutputError
from gradhesion.cli.work.locks import closing, is_locked, try_lock

PATIENCE: Final = 0.5
"""Seconds to wait for a lock: `gradhesion status` takes it for a moment to see whether it is free."""

PATIENCE_OF_SHARDS: Final = 3.0
"""The same of a shard: the jobs of an array start at one moment, and take the lock one after the other."""

_OURS: Final = ("*.part", "*.tmp", "merged.nc", "state*.json", "study.json")


@dataclass(frozen=True)
class Folder:
    """The folder of a run."""

    path: Path

    @property
    def merged(self) -> Path:
        """The dataset in the making."""
        return self.path / "merged.nc"

    @property
    def study(self) -> Path:
        """The study whose parts these are."""
        return self.path / "study.json"

    @property
    def finished(self) -> Path:
        """Which file is to take the output's place."""
        return self.path / "finished.json"

    def part(self, number: int) -> Path:
        """Name the part of a block."""
        return self.path / f"{number:06}.part"

    def parts(self) -> list[Path]:
        """List the parts that are there."""
        return sorted(self.path.glob("*.part"))

    def states(self) -> list[Path]:
        """List the states of the runs, or shards, that are or were at work."""
        return sorted(self.path.glob("state*.json"))

    def clear(self, *patterns: str) -> None:
        """Remove files, and nothing that is not ours."""
        for pattern in patterns or _OURS:
            for path in self.path.glob(pattern):
                with suppress(OSError):
                    path.unlink()

    def busy(self) -> bool:
        """Check whether a run, or a shard of one, is at work here."""
        return any(is_locked(path) for path in self.path.glob("lock*"))


def folder_of(output: Path) -> Folder:
    """Name the folder of an output; a link is followed."""
    target = Path(os.path.realpath(output))
    return Folder(target.with_name(f"{target.name}.parts"))


def identity(path: Path) -> list[int] | None:
    """Give what tells a file from every other, and stays when it is renamed."""
    with suppress(OSError):
        found = path.stat()
        return [found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns]
    return None


def read_json(path: Path) -> Any:
    """Read one of the small files, or nothing if it is not there or not whole."""
    with suppress(OSError, ValueError, RecursionError):
        return json.loads(path.read_bytes())
    return None


def write_json(path: Path, content: Any, *, sync: bool = True) -> None:
    """Write one of the small files, whole or not at all."""
    write_whole(path, json.dumps(content, indent=1).encode(), sync=sync)


@contextmanager
def claimed(output: Path, shard: str | None = None) -> Iterator[Folder]:
    """
    Claim the folder of an output for one run, or for one shard of one; it goes at the end if no part is left in it.

    Raises
    ------
    OutputError
        Another run is at work there.
    OSError
        The folder cannot be made.
    """
    folder = folder_of(output)
    lock = _lock(folder, output, shard)
    try:
        if shard is None:
            folder.clear("*.tmp", "merged.nc", "lock-*")
        yield folder
    finally:
        kept = len(folder.parts())
        if kept:
            name = f"{output}.parts"
            many = "part is" if kept == 1 else "parts are"
            interrupts.keep(f"{kept:,} finished {many} kept in {name}, and the same command goes on from there")
        if shard is None:
            folder.clear("*.tmp", "merged.nc")
        if shard is None and not kept:
            _remove(folder, lock)
        else:
            os.close(lock)


def _remove(folder: Folder, lock: int) -> None:
    """Remove the folder, and close its lock; a file in it that is not ours keeps it."""
    folder.clear()
    folder.clear("lock-*")
    path = folder.path / "lock"
    try:
        path.unlink()
        unlinked = True
    except OSError:  # as on Windows, where the file is open
        unlinked = False
    with suppress(OSError):
        folder.finished.unlink()  # last of all: it says that the rest is of no use
    os.close(lock)
    with suppress(OSError):
        if not unlinked:
            path.unlink()
        folder.path.rmdir()


def _lock(folder: Folder, output: Path, shard: str | None) -> int:
    """Take the lock of a run or of a shard; give the handle that holds it."""
    deadline = time.monotonic() + (PATIENCE if shard is None else PATIENCE_OF_SHARDS)
    while True:
        folder.path.mkdir(parents=True, exist_ok=True)
        try:
            handle = _locked(folder, shard)
        except FileNotFoundError:  # a run has just removed the folder
            if time.monotonic() > deadline:
                raise
        else:
            if handle is not None:
                return handle
        if time.monotonic() > deadline:
            raise OutputError(_taken(folder, output))
        time.sleep(PATIENCE / 20)


def _locked(folder: Folder, shard: str | None) -> int | None:
    """Try once to take the lock of a run, which no shard may be at work beside, or that of a shard."""
    lock = try_lock(folder.path / "lock")
    if lock is None:
        return None
    if shard is not None:
        with closing(lock):
            return try_lock(folder.path / f"lock-{shard}")
    if any(is_locked(path) for path in folder.path.glob("lock-*")):
        os.close(lock)
        return None
    return lock


def _taken(folder: Folder, output: Path) -> str:
    """Say that another run is at work."""
    states = [state for path in folder.states() if isinstance(state := read_json(path), dict)]
    who = ", ".join(f"process {state.get('pid')} on {state.get('host')}" for state in states)
    return (
        f"{output}: another run is at work on it{f' ({who})' if who else ''}; wait for it "
        f"(`gradhesion status {output}` shows how far it is), or name another output with -o"
    )
