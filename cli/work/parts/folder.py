"""The folder of a run, FILE.nc.parts beside its output: its lock, its parts, and what a killed run has left there.

lock            held for as long as a run lives; a shard holds it for the moment in which it takes its own
lock-1-of-8     held for as long as this shard lives
study.json      the study whose parts these are: written first, it marks the folder as ours
000012.part     a block that is done
state.json      how far the run is, for `gradhesion status`
merged.nc       the dataset in the making
finished.json   which file is to take the output's place: if it has, what is left here is of no use

A folder without a mark is somebody else's: nothing in it is read, written or removed. In one of ours only files with
these names are.
"""

import os
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from gradhesion.cli.errors import OutputError
from gradhesion.cli.locks import closing, is_locked, try_lock
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.parts.records import Finished, Manifest, State, read_record

PATIENCE: Final = 0.5
"""Seconds to wait for a lock: `gradhesion status` takes it for a moment to see whether it is free."""

PATIENCE_OF_SHARDS: Final = 3.0
"""The same of a shard: the jobs of an array start at one moment, and take the lock one after the other."""

_SHARD: Final = r"-\d+-of-\d+"
_PARTS: Final = r"\d{6,}\.part"
_STATES: Final = rf"state({_SHARD})?\.json"
_LOCKS: Final = rf"lock{_SHARD}"
_RECORDS: Final = rf"study\.json|finished\.json|{_STATES}"
_WORKING: Final = rf"merged\.nc|({_RECORDS}|{_PARTS})\.[0-9a-f]{{16}}\.tmp"
"""What a run has in the making: of no use to another."""
_BARE: Final = rf"lock({_SHARD})?|study\.json\.[0-9a-f]{{16}}\.tmp|\.nfs[0-9a-f]+"
"""What there may be before there is a mark; NFS keeps a lock that is removed under another name until it is closed."""


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
        return self._named(_PARTS)

    def bytes_of_parts(self) -> int:
        """Count the bytes of the parts."""
        size = 0
        for part in self.parts():
            with suppress(OSError):
                size += part.lstat().st_size
        return size

    def states(self) -> list[Path]:
        """List the states of the runs, or shards, that are or were at work."""
        return self._named(_STATES)

    def manifest(self) -> Manifest | None:
        """Read the study whose parts these are, or were: what marks the folder as one of ours."""
        if os.path.islink(self.path):  # noqa: PTH114 (never an error, whatever the name)
            return None
        manifest = read_record(self.study, Manifest)
        if manifest is None:  # a run that was killed while it tidied up has left the other one
            finished = read_record(self.finished, Finished)
            manifest = finished.study if finished else None
        return manifest if manifest and "gradhesion" in manifest.versions else None

    def has_made(self, output: Path) -> bool:
        """Check whether a run has finished, and what it has made stands at its output: the rest here is of no use."""
        finished = read_record(self.finished, Finished)
        return finished is not None and finished.file == identity(output)

    def foreign(self) -> str:
        """Say why the folder is not ours to use; "" if it is, or is not there."""
        if os.path.islink(self.path):  # noqa: PTH114 (never an error, whatever the name)
            return "is a link"
        if not os.path.lexists(self.path):
            return ""
        if not os.path.isdir(self.path):  # noqa: PTH112
            return "is a file"
        if self.manifest() or self._is_bare() or self.manifest():  # a run may have begun between the two
            return ""
        return "is a folder that gradhesion has not made"

    def clear_parts(self) -> None:
        """Remove the parts."""
        _remove(self._named(_PARTS))

    def clear_unfinished(self) -> None:
        """Remove what a run has had in the making."""
        _remove(self._named(_WORKING))

    def clear(self) -> None:
        """Remove all that a run has left but its locks and what says that it has finished, the mark last."""
        _remove(self._named(rf"{_WORKING}|{_PARTS}|{_STATES}"))
        _remove([self.study])

    def clear_locks(self) -> None:
        """Remove the locks of shards, none of which is at work."""
        _remove(self._named(_LOCKS))

    def busy(self) -> bool:
        """Check whether a run, or a shard of one, is at work here."""
        return any(is_locked(path) for path in self._named(rf"lock|{_LOCKS}"))

    def shards_at_work(self) -> bool:
        """Check whether a shard is."""
        return any(is_locked(path) for path in self._named(_LOCKS))

    def _named(self, pattern: str) -> list[Path]:
        """List the files with names of one kind."""
        with suppress(OSError):
            return sorted(path for path in self.path.iterdir() if re.fullmatch(pattern, path.name))
        return []

    def _is_bare(self) -> bool:
        """Check whether nothing can be lost here: it is empty, or has what a run leaves that is killed at once."""
        try:
            files = list(self.path.iterdir())
            return all(
                re.fullmatch(_BARE, file.name) and (file.suffix == ".tmp" or file.lstat().st_size == 0)
                for file in files
            )
        except OSError:
            return False


def _remove(paths: list[Path]) -> None:
    """Remove files, as far as that goes."""
    for path in paths:
        with suppress(OSError):
            path.unlink()


def folder_of(output: Path) -> Folder:
    """Name the folder of an output; a link is followed."""
    return Folder(Path(f"{os.path.realpath(output)}.parts"))


def identity(path: Path) -> tuple[int, int, int, int] | None:
    """Give what identifies a file, and stays when it is renamed."""
    with suppress(OSError):
        found = path.stat()
        return (found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns)
    return None


@contextmanager
def claimed(output: Path, shard: str | None = None) -> Iterator[Folder]:
    """
    Claim the folder of an output for one run, or for one shard of one; it goes at the end if no part is left in it.

    Raises
    ------
    OutputError
        Another run is at work there, or the folder is not ours.
    OSError
        The folder cannot be made.
    """
    folder = folder_of(output)
    interrupts.hold()
    try:
        lock = _lock(folder, output, shard)
    except BaseException:
        interrupts.release()
        raise
    try:
        interrupts.release()
        if shard is None:
            folder.clear_unfinished()
            folder.clear_locks()
        yield folder
    finally:
        kept = len(folder.parts())
        if kept:
            name = f"{output}.parts"
            many = "part is" if kept == 1 else "parts are"
            interrupts.keep(f"{kept:,} finished {many} kept in {name}, and the same command resumes")
        if shard is None:
            folder.clear_unfinished()
        if shard is None and not kept:
            _give_up(folder, lock)
        else:
            os.close(lock)


def _give_up(folder: Folder, lock: int) -> None:
    """Remove the folder, and close its lock; a file in it that is not ours keeps it."""
    folder.clear_locks()
    folder.clear()
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


def refuse_foreign(folder: Folder, output: Path) -> None:
    """
    Leave alone what is not ours.

    Raises
    ------
    OutputError
        Something of somebody else is where the folder of this output would be.
    """
    reason = folder.foreign()
    if reason:
        raise OutputError(
            f"{output}.parts: {reason}, so it is left untouched; move it away, or name another output with -o"
        )


def _lock(folder: Folder, output: Path, shard: str | None) -> int:
    """Take the lock of a run or of a shard; give the handle that holds it."""
    deadline = time.monotonic() + (PATIENCE if shard is None else PATIENCE_OF_SHARDS)
    while True:
        refuse_foreign(folder, output)
        try:
            folder.path.mkdir(parents=True, exist_ok=True)
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
    if folder.shards_at_work():
        os.close(lock)
        return None
    return lock


def _taken(folder: Folder, output: Path) -> str:
    """Say that another run is at work."""
    states = [state for path in folder.states() if (state := read_record(path, State))]
    who = ", ".join(f"process {state.pid} on {state.host}" for state in states)
    return (
        f"{output}: another run is writing it{f' ({who})' if who else ''}; wait for it "
        f"(`gradhesion status {output}` shows its progress), or name another output with -o"
    )
