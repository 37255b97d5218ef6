"""The folder of a run, FILE.nc.parts beside its output: its lock, its parts, and what a killed run has left there.

lock            held by the system for as long as a run lives (shards share it, and have one each beside it)
study.json      the study whose parts these are
000012.part     a block that is done
state.json      how far the run is, for `gradhesion status`
merged.nc       the dataset in the making
finished.json   which file is to take the output's place: if it has, what is left here is of no use
"""

import fcntl
import json
import os
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from gradhesion.cli import interrupts
from gradhesion.cli.disk import write_whole
from gradhesion.cli.errors import OutputError

PATIENCE: Final = 0.5
"""Seconds to wait for the lock: `gradhesion status` takes it for a moment to see whether it is free."""

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
        """Tell whether a run is at work here."""
        try:
            with (self.path / "lock").open("r+b") as file:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
        return False


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
    with ExitStack() as stack:
        lock = stack.enter_context(_locked(folder, "lock", output, shared=shard is not None))
        if shard is not None:
            stack.enter_context(_locked(folder, f"lock-{shard}", output, shared=False))
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
                if not kept:
                    _remove(folder, lock)


def _remove(folder: Folder, lock: Callable[[], None]) -> None:
    """Remove the folder; a file in it that is not ours keeps it."""
    folder.clear()
    folder.clear("lock-*", "lock")
    folder.clear("finished.json")  # last of all: it tells that the rest is of no use
    lock()
    with suppress(OSError):
        folder.path.rmdir()


@contextmanager
def _locked(folder: Folder, name: str, output: Path, *, shared: bool) -> Iterator[Callable[[], None]]:
    """Hold a lock, which the system releases when the process dies; gives what releases it."""
    deadline = time.monotonic() + PATIENCE
    path = folder.path / name
    kind = fcntl.LOCK_SH if shared else fcntl.LOCK_EX
    while True:
        folder.path.mkdir(parents=True, exist_ok=True)
        handle = -1
        try:
            handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
            try:
                fcntl.flock(handle, kind | fcntl.LOCK_NB)
            except BlockingIOError:
                raise
            except OSError:  # a file system without locks
                break
            if os.path.samestat(os.fstat(handle), path.stat()):
                break
        except (BlockingIOError, FileNotFoundError) as error:  # held; or its holder has just removed the folder
            if time.monotonic() > deadline:
                if isinstance(error, FileNotFoundError):
                    raise
                raise OutputError(_taken(folder, output)) from None
            time.sleep(PATIENCE / 20)
        if handle >= 0:
            os.close(handle)
    open_handles = [handle]

    def release() -> None:
        while open_handles:
            os.close(open_handles.pop())

    try:
        yield release
    finally:
        release()


def _taken(folder: Folder, output: Path) -> str:
    """Say that another run is at work."""
    states = [state for path in folder.states() if isinstance(state := read_json(path), dict)]
    who = ", ".join(f"process {state.get('pid')} on {state.get('host')}" for state in states)
    return (
        f"{output}: another run is at work on it{f' ({who})' if who else ''}; wait for it "
        f"(`gradhesion status {output}` tells how far it is), or name another output with -o"
    )
