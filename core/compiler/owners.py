"""Who can change the contents of a folder: compiled code is run unchecked, and numba's index is a pickle.

A folder is this user's own if nobody else can put anything in it, move it away, or change its contents. The folders
above it belong to this user or to the system, and others cannot rename what is in them: they cannot write there, or the
sticky bit keeps them from it, as in `/tmp`. The folder belongs to this user, and all in it to this user or to root;
there are no links in it. What is beyond a folder that others cannot enter may be writable by a group, as it is with
many an umask.

Windows has other rights, which are not checked: the user's cache and the temporary folder are private there.
"""

import os
import stat
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Final

_OTHERS: Final = stat.S_IRWXG | stat.S_IRWXO
_WRITTEN: Final = stat.S_IWGRP | stat.S_IWOTH


def make_private(folder: Path) -> None:
    """Make a folder, and those above it that are not there, for this user alone.

    Raises
    ------
    OSError
        It cannot be made.
    """
    for above in (*reversed(folder.parents), folder):
        if not above.is_dir():
            above.mkdir(mode=0o700, exist_ok=True)


def changeable(folder: Path) -> str:
    """Return why a folder is not this user's own, in words that follow a path; "" if it is.

    Parameters
    ----------
    folder
        A path without links above it (`os.path.realpath`).

    Raises
    ------
    OSError
        It is not there, or cannot be read.
    """
    if sys.platform == "win32":
        return ""
    # without rights of root, in a container, what belongs to the system belongs to somebody else
    user, system, closed = os.getuid(), {0, Path(folder.anchor).stat().st_uid}, False
    for above in reversed(folder.parents):
        found = above.stat()
        if found.st_uid not in {user, *system}:
            return f"{above} belongs to another user"
        if not closed and found.st_mode & _WRITTEN and not found.st_mode & stat.S_ISVTX:
            return f"{above} can be written by other users"
        closed |= found.st_uid == user and not found.st_mode & _OTHERS
    own = folder.lstat()
    if own.st_uid != user:
        return f"{folder} belongs to another user"
    closed |= not own.st_mode & _OTHERS
    for path, found in _all_of(folder):
        if stat.S_ISLNK(found.st_mode):
            return f"{path} is a link"
        if found.st_uid not in {user, 0}:
            return f"{path} belongs to another user"
        if not closed and found.st_mode & _WRITTEN:
            return f"{path} can be written by other users"
    return ""


def _all_of(folder: Path) -> Iterator[tuple[Path, os.stat_result]]:
    """Give a folder and all that is in it; links are not followed, and what another process removes is left out."""
    yield folder, folder.lstat()
    if not folder.is_symlink():
        for path, folders, files in os.walk(folder):
            for name in (*folders, *files):
                with suppress(FileNotFoundError):
                    yield Path(path, name), os.lstat(f"{path}{os.sep}{name}")
