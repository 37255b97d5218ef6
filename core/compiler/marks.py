"""Which kinds of work have been compiled, by this process, by others before it, or ahead."""

from contextlib import suppress
from pathlib import Path
from typing import Final

from gradhesion.core.compiler import cache
from gradhesion.core.compiler.ahead import is_complete
from gradhesion.core.compiler.probe import folder_of_kernels

_here: Final[set[str]] = set()
"""The kinds of work that this process has done, whose kernels are in memory."""


def _mark(kind: str) -> Path | None:
    folder = folder_of_kernels()
    return None if folder is None else folder / f"compiled-{kind}-{cache.machine()}"


def compiled_before(kind: str) -> bool:
    """Return whether the kernels of a kind of work (one of `KINDS`) need no compiling; else the first call is slow."""
    mark = _mark(kind)
    return kind in _here or is_complete(kind) or (mark is not None and mark.exists())


def note_compiled(kind: str) -> None:
    """Record that the kernels of a kind of work have been compiled, for this process and those after it."""
    if kind in _here:
        return
    _here.add(kind)
    mark = _mark(kind)
    if mark is not None:
        with suppress(OSError):
            mark.touch()
