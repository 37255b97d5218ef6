"""The finished blocks of a run, kept in FILE.nc.parts beside its output until the dataset is whole.

lock          held for as long as a run lives; lock-1-of-8 for as long as that shard does
study.json    the study, and the key of all that its values depend on
000012.npz    a block that is done, with that key
merged.nc     the dataset in the making
"""

import hashlib
import json
import os
import re
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numba
import numpy as np
from filelock import FileLock, Timeout
from numpy.typing import NDArray

from gradhesion.cli.disk import rewritten
from gradhesion.cli.errors import OutputError
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core import SOURCES

FORMAT: Final = 2
"""To be raised when blocks are kept in another way, or solved in another way by `gradhesion.cli`."""
MARK: Final = "study.json"
UNFINISHED: Final = r"merged\.nc|.*\.[0-9a-f]{16}\.tmp"
PARTS: Final = r"\d{6,}\.(npz|part)"
LEFT: Final = rf"{UNFINISHED}|{PARTS}|lock-.*|(study|state.*|finished)\.json"
"""Names of files: what is being written, the finished blocks, and what a run may leave beside its lock; with those of
version 0.3."""
PATIENCE: Final = 0.5
"""Seconds to wait for a lock, which others take for a moment to see whether it is free."""


def folder_of(output: Path) -> Path:
    """Name the folder of an output; a link is followed."""
    return Path(f"{os.path.realpath(output)}.parts")


def versions() -> dict[str, Any]:
    """List the versions that values depend on: another one may round another way."""
    packages = {"gradhesion": version("gradhesion"), "numba": numba.__version__, "numpy": np.__version__}
    return {"format": FORMAT, "core": SOURCES, **packages}


class Parts:
    """The folder of a run, and its blocks as those of one study."""

    def __init__(self, output: Path, study: Study) -> None:
        self.output, self.study = output, study
        self.folder = folder_of(output)
        self.merged = self.folder / "merged.nc"

    @cached_property
    def key(self) -> str:
        """Name all that the values depend on: what the study says, how it is cut, and the versions."""
        data = tomllib.loads(self.study.text)
        data.pop("title", None)
        everything = json.dumps([data, self.study.chunk, versions()], sort_keys=True, default=str)
        return hashlib.sha256(everything.encode()).hexdigest()

    def part(self, number: int) -> Path:
        """Name the file of a block."""
        return self.folder / f"{number:06}.npz"

    def read(self, number: int) -> dict[str, NDArray[Any]] | None:
        """Read a block; None if it is not there, not whole (each array has a checksum), or of another study."""
        try:
            with self.part(number).open("rb") as file, np.load(file) as arrays:
                found = dict(arrays)
        except Exception:  # noqa: BLE001 (whatever is wrong with it, it is solved again)
            return None
        return found if found.pop("key", None) == f"{self.key} {number}" else None

    def write(self, number: int, values: Mapping[str, Any]) -> None:
        """Keep a block, whole or not at all."""
        with rewritten(self.part(number)) as file:
            np.savez(file, key=np.array(f"{self.key} {number}"), **values)

    def refusal(self) -> str:
        """Say why a run of this study would not go on here; "" if it would."""
        kept, mark = len(parts_in(self.folder)), mark_of(self.folder)
        if not kept or mark.get("key") == self.key:
            return ""
        other = "study" if mark.get("versions") == versions() else "version"
        there = f"{counted(kept, 'finished block')} of another {other} in {self.output}.parts"
        return f"{self.output}: {there}; add --fresh to discard them, or name another output with -o"

    def begin(self, *, fresh: bool = False) -> None:
        """Make the folder that of this study; OutputError if blocks of another are there, and not to be dropped."""
        if fresh:
            clear(self.folder)
        elif refusal := self.refusal():
            raise OutputError(refusal)
        study = self.study
        mark: dict[str, Any] = {"key": self.key, "versions": versions(), "study": study.text, "name": study.name}
        mark |= {"folder": str(study.folder.absolute()), "scenes": study.scenes, "blocks": len(study.tiling)}
        with rewritten(self.folder / MARK) as file:
            file.write(json.dumps(mark, indent=1).encode())


def mark_of(folder: Path) -> dict[str, Any]:
    """Read which study the blocks in a folder are of; nothing if it is none of a run."""
    with suppress(OSError, ValueError):
        found = json.loads((folder / MARK).read_bytes())
        if isinstance(found, dict) and "key" in found:
            return found
    return {}


def is_written(folder: Path, output: Path) -> bool:
    """Report whether an output is newer than the run that left a folder, which was killed before it could tidy up."""
    with suppress(OSError):
        return output.stat().st_mtime_ns >= (folder / MARK).stat().st_mtime_ns
    return False


def study_in(folder: Path) -> Study | None:
    """Read the study whose blocks are kept, None if there are none; StudyError if a file that it names has changed."""
    mark = mark_of(folder)
    if not mark:
        return None
    study = study_from(tomllib.loads(mark["study"]), mark["name"], folder=mark["folder"])
    return replace(study, text=mark["study"])


def parts_in(folder: Path) -> list[Path]:
    """List the finished blocks in a folder."""
    return _named(folder, PARTS)


def is_running(folder: Path, locks: str = r"lock.*") -> bool:
    """Report whether a run, or a shard, is at work: each of its locks is taken for a moment."""
    for path in _named(folder, locks):
        try:
            FileLock(path).acquire(timeout=PATIENCE).lock.release()
        except Timeout:
            return True
    return False


@contextmanager
def claimed(output: Path, shard: str = "") -> Iterator[None]:
    """Hold the folder of an output for one run, or for one shard beside others; it goes at the end if it has no block.

    OutputError: another run is at work there, or it holds files that no run has made. OSError: it cannot be made.
    """
    folder = folder_of(output)
    ours = rf"{LEFT}|lock"
    if os.path.lexists(folder) and not mark_of(folder) and len(_named(folder, ours)) < len([*folder.iterdir()]):
        raise OutputError(f"{output}.parts: no run has made it; move it away, or name another output with -o")
    lock = FileLock(folder / f"lock{shard}")
    try:
        with interrupts.deferred():  # a lock that is half taken is nobody's
            folder.mkdir(parents=True, exist_ok=True)
            with suppress(Timeout):
                lock.acquire(timeout=PATIENCE)
        if not lock.is_locked or is_running(folder, "lock" if shard else r"lock-.*"):
            remedy = f"wait for it (`gradhesion status {output}` shows how far it is), or name another output with -o"
            raise OutputError(f"{output}: another run is writing it; {remedy}")
        yield
    finally:
        if lock.is_locked and not shard:
            clear(folder, UNFINISHED if parts_in(folder) else ours)
        lock.release()
        with suppress(OSError):  # it is not empty, or not there
            folder.rmdir()


def clear(folder: Path, pattern: str = LEFT) -> None:
    """Remove what a run has left but its lock, as far as that goes; what says whose it is goes last."""
    for path in sorted(_named(folder, pattern), key=lambda path: path.name == MARK):
        with suppress(OSError):
            path.unlink()


def _named(folder: Path, pattern: str) -> list[Path]:
    """List the files of a folder with names of one kind."""
    with suppress(OSError):
        return sorted(path for path in folder.iterdir() if re.fullmatch(pattern, path.name))
    return []
