"""The folder of compiled kernels, and the removal of those that no version uses any more.

Numba notices an edit in the file of a kernel, but not in the files of the kernels that it calls. The folder of the
compiled code is therefore named after a digest of all sources of the core that have kernels and of where they stand
(numba keeps code of one place for that place alone): an edit in any of them compiles all of it anew.

The folder is the first of these that can be written, and that nobody else can change (owners.py): in `NUMBA_CACHE_DIR`,
if that is set; in the user's cache; in the folder for temporary files. Without any of them nothing is kept.
"""

import getpass
import hashlib
import os
import re
import stat
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Final

import numba
import platformdirs
from llvmlite import binding

from gradhesion.core.compiler.owners import changeable, make_private
from gradhesion.core.compiler.sources import COMPILED, CORE

LINKING: Final = os.environ.get("GRADHESION_LINKING", "")
"""How kernels are to be linked; "ordinary" for numba's own way (linking.py)."""
_NAME: Final = f"kernels-{hashlib.sha256(f'{CORE}{COMPILED}{LINKING}{numba.__version__}'.encode()).hexdigest()[:16]}"
_OURS: Final = re.compile(r"kernels-[0-9a-f]{16}")
_KEPT: Final = re.compile(r".*\.(nbi|nbc)(\.tmp\..*)?|(compiled|linking)-.*|lock")
"""The files of such a folder: numba's index and code, finished or not, and the marks of what is compiled, and how."""
_UNUSED: Final = 30 * 86400.0
"""Seconds after which the folder of another version is removed."""
_DAY: Final = 86400.0
"""Seconds since the last use of the folder in use beyond which the clock may have been set, and is not used."""


@dataclass(frozen=True)
class Place:
    """Where compiled kernels are kept.

    Parameters
    ----------
    folder
        The folder; None if nothing can be kept.
    why
        "" for the usual folder, else one sentence: what cannot be written, or who else can, and what is used instead.
    """

    folder: Path | None
    why: str = ""


def _refused(folder: Path) -> str:
    """Make a folder, and return why nothing is kept there: what cannot be written, or who else can; else ""."""
    try:
        make_private(folder)
        others = changeable(folder)
        if not others:
            tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return "cannot be written"
    return f"is not used, since {others}" if others else ""


def _private(folder: Path) -> bool:
    """Make a folder that only this user can write, whoever may write around it; return whether it is so."""
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError:
        return False
    if not stat.S_ISDIR(found.st_mode):  # a link could lead anywhere
        return False
    if sys.platform == "win32":  # the folder for temporary files is the user's own
        return True
    return found.st_uid == os.getuid() and not found.st_mode & 0o077


def _temporary() -> Path:
    """Return this user's folder among the temporary ones."""
    try:
        user = getpass.getuser() if sys.platform == "win32" else str(os.getuid())
    except (KeyError, OSError):
        user = "user"
    return Path(tempfile.gettempdir()) / f"gradhesion-{user}"


def choose(given: str) -> Place:
    """Return where kernels are kept, if `given` is what NUMBA_CACHE_DIR says ("" where it is not set)."""
    usual = Path(platformdirs.user_cache_dir("gradhesion"))
    names = {f"NUMBA_CACHE_DIR = {given}": Path(given)} if given else {}
    refused: list[str] = []
    for name, parent in (names | {str(usual): usual}).items():
        folder = Path(os.path.realpath(parent)) / _NAME
        why = _refused(folder)
        if not why:
            return Place(folder, f"{refused[0]}; compiled kernels are kept in {parent}" if refused else "")
        refused.append(f"{name} {why}")
    because = " and ".join(refused)
    try:
        temporary = _temporary()
    except OSError:  # no folder for temporary files
        temporary = None
    if temporary and _private(temporary):
        folder = Path(os.path.realpath(temporary)) / _NAME
        if not _refused(folder):
            return Place(folder, f"{because}; compiled kernels are kept in {temporary}")
    return Place(
        None,
        f"{because}, and nothing is kept in the folder for temporary files either: every process compiles anew; "
        "set NUMBA_CACHE_DIR to a folder that you can write and no other user can",
    )


@lru_cache(maxsize=1)
def place() -> Place:
    """Return where this process keeps compiled kernels, and why there.

    Examples
    --------
    >>> isinstance(place().why, str)
    True
    """
    chosen = choose(numba.config.CACHE_DIR)
    if chosen.folder is not None:
        with suppress(OSError):
            os.utime(chosen.folder)  # the time of its last use
    return chosen


CACHE_FOLDER: Final = place().folder or Path(platformdirs.user_cache_dir("gradhesion")) / _NAME
"""The folder of `place`; where nothing can be kept, one that is not used."""


def _last_use(folder: Path) -> float:
    """Return when anything of a folder was last written or used."""
    return max(path.lstat().st_mtime for path in (folder, *folder.rglob("*")))


def _remove(folder: Path) -> None:
    """Remove what is known of a folder, and the folder if nothing else is in it."""
    for path in sorted(folder.rglob("*"), reverse=True):  # what is in a folder before the folder
        with suppress(OSError):
            if path.is_dir() and not path.is_symlink():
                path.rmdir()
            elif _KEPT.fullmatch(path.name):
                path.unlink()
    folder.rmdir()


def remove_unused(folder: Path, now: float | None = None) -> None:
    """Remove the folders of other versions beside `folder` that nobody has used for 30 days.

    Only folders of this user with names of ours are touched, no links are followed, and files that are not ours stay.

    Parameters
    ----------
    folder
        The folder in use.
    now
        Seconds since 1970; if not given the present, at most a day after the last use of `folder`.
    """
    with suppress(OSError):
        now = min(time.time(), folder.lstat().st_mtime + _DAY) if now is None else now
        for other in folder.parent.iterdir():
            with suppress(OSError):  # another process may remove it too
                found = other.lstat()
                if other == folder or not _OURS.fullmatch(other.name) or not stat.S_ISDIR(found.st_mode):
                    continue
                if sys.platform != "win32" and found.st_uid != os.getuid():
                    continue
                if now - found.st_mtime > _UNUSED and now - _last_use(other) > _UNUSED:
                    _remove(other)


@lru_cache(maxsize=1)
def machine() -> str:
    """Return a digest of all that compiled code depends on beside the sources."""
    requested = (numba.config.CPU_NAME, numba.config.CPU_FEATURES)
    processor = (*requested, binding.get_host_cpu_name(), binding.get_host_cpu_features().flatten())
    return hashlib.sha256(repr((sys.version, numba.__version__, processor)).encode()).hexdigest()[:16]
