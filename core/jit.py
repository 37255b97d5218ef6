"""How kernels are compiled, and where their code is kept: the only module that knows numba's options.

A kernel is a function of floats, arrays and NamedTuples. It neither raises nor prints. Contraction (a b + c in one
step) is the only freedom that its arithmetic has; sums of quadrature may be reordered as well. `isnan` keeps its
meaning everywhere.

Most kernels make no arrays, and count no references to those that they are handed: Python holds them for as long as its
call lasts, and to count takes up to half of the time of a scene. Those that make arrays count. They may hand their own
to kernels that do not count, but these must not return them: they would be released once too often. Nor may these
return a part of an array to Python, which would get the whole of it.

Numba notices an edit in the file of a kernel, but not in the files of those that it calls. Code is therefore kept in a
folder that is named after a digest of all sources of the core. Code that is kept is run unchecked, and numba's index
of it is a pickle: a folder is used only if this user and the system alone can change what is in it.
"""

import hashlib
import os
import shutil
import stat
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any, Final, NamedTuple, TypeVar

import numba
import platformdirs

_Function = TypeVar("_Function", bound=Callable[..., Any])
_CONTRACTED: Final = {"contract"}
_REORDERED: Final = {"contract", "reassoc", "nsz"}

CORE: Final = Path(__file__).resolve().parent
"""Where the core stands, the same by whatever link: numba keeps the code of one place for that place alone."""
_FILES: Final = sorted(CORE.rglob("*.py"))
_TEXTS: Final = b"".join(path.relative_to(CORE).as_posix().encode() + path.read_bytes() for path in _FILES)
SOURCES: Final = hashlib.sha256(_TEXTS).hexdigest()
"""The digest of the core, wherever it stands: values from the same sources are comparable bit for bit."""
_NAME: Final = f"kernels-{hashlib.sha256(f'{CORE}{SOURCES}{numba.__version__}'.encode()).hexdigest()[:16]}"


class Place(NamedTuple):
    """The folder of compiled kernels, None if nothing can be kept; a sentence on why it is not the usual one, or ""."""

    folder: Path | None
    why: str


def changeable(folder: Path) -> str:
    """Return why others could change what a folder contains, in words that follow its path; "" if none can.

    All that stands above it and in it belongs to this user or to the system, and nobody else can write there, unless a
    folder of this user keeps all others out further up; above it, the sticky bit serves as well (`/tmp`). There are no
    links. Windows has other rights, which are not checked.
    """
    if sys.platform == "win32":
        return ""
    above, closed = [*reversed(folder.parents)], False
    for path in (*above, folder, *folder.rglob("*")):
        with suppress(FileNotFoundError):  # another process has removed it meanwhile
            found = path.lstat()
            if found.st_uid not in {os.getuid(), 0, above[0].stat().st_uid}:
                return f"is not used, since {path} belongs to another user"
            if stat.S_ISLNK(found.st_mode):
                return f"is not used, since {path} is a link"
            sticky = path in above and found.st_mode & stat.S_ISVTX
            if found.st_mode & 0o022 and not sticky and not closed:
                return f"is not used, since {path} can be written by other users"
            if path in (*above, folder) and found.st_uid == os.getuid() and not found.st_mode & 0o077:
                closed = True
    return ""


def _refused(folder: Path) -> str:
    """Make a folder, for this user alone, and return why nothing is kept there; "" if it serves."""
    try:
        for path in (*reversed(folder.parents), folder):
            path.mkdir(mode=0o700, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
        return changeable(folder)
    except OSError:
        return "cannot be written"


def _candidates(given: str) -> Iterator[tuple[str, Path]]:
    """Give the folders in which code may be kept, the preferred one first, each after its name in a sentence."""
    if given:
        yield f"NUMBA_CACHE_DIR = {given}", Path(given)
    usual = Path(platformdirs.user_cache_dir("gradhesion"))
    yield str(usual), usual
    with suppress(OSError):  # no folder for temporary files
        temporary = Path(tempfile.gettempdir(), f"gradhesion-{os.getuid() if sys.platform != 'win32' else ''}")
        yield str(temporary), temporary


@lru_cache(maxsize=1)
def place() -> Place:
    """Return where this process keeps compiled kernels: in NUMBA_CACHE_DIR, the user's cache or a temporary folder."""
    refused: list[str] = []
    for name, parent in _candidates(numba.config.CACHE_DIR):
        folder = Path(os.path.realpath(parent), _NAME)
        if not (reason := _refused(folder)):
            os.utime(folder)  # the time of its last use
            _remove_unused(folder.parent)
            return Place(folder, f"{' and '.join(refused)}; compiled kernels are kept in {parent}" if refused else "")
        refused.append(f"{name} {reason}")
    advice = "every process compiles anew; set NUMBA_CACHE_DIR to a folder that you can write and no other user can"
    return Place(None, f"{' and '.join(refused)}: {advice}")


def _remove_unused(parent: Path) -> None:
    """Remove the folders of other versions that no process has used for 30 days."""
    for other in parent.glob(f"kernels-{'[0-9a-f]' * 16}"):
        with suppress(OSError):  # another process removes it too
            if time.time() - other.lstat().st_mtime > 30 * 86400 and not other.is_symlink():
                shutil.rmtree(other)


def _compiled(function: _Function, **options: Any) -> _Function:
    """Have numba compile a function when it is called, and keep its code in the folder of `place`, if there is one.

    Numba hands `forceinline` and `_nrt` (whether references are counted) on to all that a function calls, unless they
    are given there: how a kernel is compiled would depend on which of its callers was the first. Both always are.
    """
    options = {"forceinline": False, "_nrt": False} | options
    options |= {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}  # no C code calls them
    folder, of_the_user = place().folder, numba.config.CACHE_DIR
    if folder is not None:
        numba.config.CACHE_DIR = str(folder)  # numba reads it when a function is decorated, and not later
        try:
            kept: Any = numba.njit(cache=True, **options)(function)
        finally:
            numba.config.CACHE_DIR = of_the_user
        if Path(kept.stats.cache_path).is_relative_to(folder):  # and not, as where it is full, beside the source
            return kept
    return numba.njit(**options)(function)


def kernel(function: _Function) -> _Function:
    """Compile a function that other kernels or Python call; it runs without the lock of the interpreter."""
    return _compiled(function, fastmath=_CONTRACTED)


def allocating(function: _Function) -> _Function:
    """Compile a kernel that makes arrays."""
    return _compiled(function, fastmath=_CONTRACTED, _nrt=True)


def leaf(function: _Function) -> _Function:
    """Compile what is short into its callers: to hand over arrays takes as long as it does."""
    return _compiled(function, fastmath=_CONTRACTED, forceinline=True)


def inlined(function: _Function) -> _Function:
    """Write a long function that is called in one place into its caller, before that is compiled: it is compiled once.

    Any other kernel is compiled by itself, and again with each that it is part of. Numba keeps the variables of what is
    written in alive: compare the time of a scene before and after.
    """
    return _compiled(function, fastmath=_CONTRACTED, inline="always")


def quadrature(function: _Function) -> _Function:
    """Compile a loop of sums whose terms may be added in any order, so that several are added at once.

    It may make arrays.
    """
    return _compiled(function, fastmath=_REORDERED, _nrt=True)


def quadrature_leaf(function: _Function) -> _Function:
    """Compile such a loop into each of its callers."""
    return _compiled(function, fastmath=_REORDERED, forceinline=True)
