"""A place in memory for what tests write: a disk that makes sure of each file takes longer than what is tested."""

import os
from pathlib import Path
from typing import Final

SHARED: Final = Path("/dev/shm")  # noqa: S108 (folders are made in it)


def in_memory(size: int) -> str | None:
    """Return where so many bytes of files, and programs among them, can stand in memory; None if nowhere."""
    if not (SHARED.is_dir() and os.access(SHARED, os.W_OK)):
        return None
    system = os.statvfs(SHARED)
    room = system.f_bavail * system.f_frsize
    return str(SHARED) if room >= size and not system.f_flag & os.ST_NOEXEC else None
