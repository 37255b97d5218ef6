"""Locks on files, which the system releases when the process that holds them dies: flock, or LockFileEx on Windows.

On NFS the client turns them into locks of its server, so that machines see those of each other; where a file system has
no locks, work goes on without any.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from filelock import lock_descriptor


def try_lock(path: Path, *, create: bool = True) -> int | None:
    """
    Take the lock of a file now: give a handle that holds it until it is closed, or None if another handle holds it.

    Raises
    ------
    FileNotFoundError
        Its folder is not there, or it is not and shall not be made.
    OSError
        It cannot be opened, or is a link, which could lead to a file of somebody else.
    """
    flags = os.O_RDWR | getattr(os, "O_NOFOLLOW", 0) | (os.O_CREAT if create else 0)  # Windows has no such flag
    while True:
        handle = os.open(path, flags, 0o666)
        try:
            taken = lock_descriptor(handle, blocking=False)
        except OSError:  # a file system without locks
            return handle
        with suppress(FileNotFoundError):
            if taken and os.path.samestat(os.fstat(handle), path.stat()):
                return handle
        os.close(handle)
        if not taken:
            return None  # otherwise its holder has just removed the file: this lock is of one without a name


def is_locked(path: Path) -> bool:
    """Check whether a lock is held; it is taken for a moment. One that cannot be opened is not."""
    with suppress(OSError):
        handle = try_lock(path, create=False)
        if handle is None:
            return True
        os.close(handle)
    return False


@contextmanager
def closing(handle: int) -> Iterator[None]:
    """Close a handle at the end, and so release its lock."""
    try:
        yield
    finally:
        os.close(handle)
