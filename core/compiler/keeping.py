"""The search for an entry before it is compiled: among those that came with the program, and in the cache.

Numba's cache brings numba's whole library into memory before it reads a file, which takes a quarter of a second and is
for compiling. It also keeps what only other compilations need: intermediate code, types in words, and the constants,
of which there are none, of every kernel below. Entries are linked into nothing (linking.py), so a third of the file is
left, and that is read alone.

This file, like linking.py, uses numba's private interfaces; where these are others, nothing of it is (probe.py).
"""

import pickle
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar, Final

import numba
from llvmlite import binding
from numba.core.caching import CompileResultCacheImpl, FunctionCache, NullCache, UserProvidedCacheLocator
from numba.core.compiler import CompileResult
from numba.core.runtime.nrt import rtsys

from gradhesion.core.compiler import ahead

_setting: Final = threading.Lock()


@contextmanager
def kept_in(folder: Path) -> Iterator[None]:
    """Have numba keep the code of kernels that are made in the block in a folder."""
    with _setting:
        previous = numba.config.CACHE_DIR
        try:
            numba.config.CACHE_DIR = str(folder)
            yield
        finally:
            numba.config.CACHE_DIR = previous


@lru_cache(maxsize=1)
def _nothing() -> bytes:
    """Return the intermediate code of no function."""
    return bytes(binding.parse_assembly("").as_bitcode())


def reduced(result: Any) -> tuple[Any, ...]:
    """Return the parts of a compiled entry for calling it, without intermediate code, words and empty constants."""
    (name, form, (code, _)), *between, _words, reload_init, environments = result._reduce()  # noqa: SLF001
    return (name, form, code), *between, reload_init, tuple(one for one in environments if one.consts)


def rebuilt(context: Any, parts: tuple[Any, ...]) -> Any:
    """Return the compiled entry again; `context` is numba's of this process."""
    (name, form, code), description, *between, reload_init, environments = parts
    symbols = context.codegen()._engine._defined_symbols  # noqa: SLF001 (numba takes them from the intermediate code)
    symbols |= {description.llvm_cpython_wrapper_name, context.get_env_name(description)}
    library = name, form, (code, _nothing())
    return CompileResult._rebuild(  # noqa: SLF001
        context, library, description, *between, "", reload_init, environments
    )


class _Impl(CompileResultCacheImpl):  # type: ignore[misc] # numba has no types
    """How the cache writes and reads entries, and that it does so in the folder that is given, or nowhere."""

    _locator_classes: ClassVar[list[Any]] = [UserProvidedCacheLocator]

    def reduce(self, result: Any) -> tuple[Any, ...]:
        """Return what is written."""
        return reduced(result)

    def rebuild(self, context: Any, parts: tuple[Any, ...]) -> Any:
        """Return what was written as an entry."""
        return rebuilt(context, parts)


class _Files(FunctionCache):  # type: ignore[misc]
    """The files of an entry in the cache."""

    _impl_class = _Impl

    def load_overload(self, types: Any, context: Any) -> Any:
        """Return the entry for types of arguments, None if it is to be compiled."""
        with self._guard_against_spurious_io_errors():
            return self._load_overload(types, context)

    def parts(self, types: Any, context: Any) -> Any:
        """Return what is written of the entry for types of arguments, None if that is nothing."""
        return self._cache_file.load(self._index_key(types, context.codegen()))


class Kept(NullCache):  # type: ignore[misc]
    """The cache from which numba reads an entry before it compiles it, and to which it writes it afterwards.

    Parameters
    ----------
    function
        The function of the kernel.
    folder
        Where code is kept; None if nothing can be.
    """

    def __init__(self, function: Callable[..., Any], folder: Path | None) -> None:
        self._function, self._folder = function, folder
        self._opened: Any = None

    @property
    def _files(self) -> Any:
        """The files of the cache, once what came with the program does not have the entry."""
        if self._opened is None:
            self._opened = NullCache()
            if self._folder is not None:
                try:
                    with kept_in(self._folder):
                        self._opened = _Files(self._function)
                except (OSError, RuntimeError):  # the folder has gone, or is full
                    pass
        return self._opened

    @property
    def cache_path(self) -> Any:
        """Where the files are."""
        return self._files.cache_path

    def load_overload(self, types: Any, context: Any) -> Any:
        """Return the entry for types of arguments, None if it is to be compiled."""
        rtsys.initialize(context)
        shipped = ahead.shipped()
        parts = shipped and shipped.read(ahead.name_of(self._function, types))
        return rebuilt(context, parts) if parts else self._files.load_overload(types, context)

    def save_overload(self, types: Any, result: Any) -> None:
        """Keep an entry that has been compiled."""
        self._files.save_overload(types, result)


def keep(entry: Any, folder: Path | None) -> None:
    """Have an entry, as numba decorates it, read and written by this cache."""
    entry._cache = Kept(entry.py_func, folder)  # noqa: SLF001


def code_of(entry: Any) -> dict[str, bytes]:
    """Return what the cache has of an entry that this process has called, by the names of files (ahead.py).

    Raises
    ------
    LookupError
        It is not in the cache.
    """
    found = {}
    for types in entry.overloads:
        files = entry._cache._files  # noqa: SLF001
        parts = files.parts(types, entry.targetctx) if isinstance(files, _Files) else None
        if parts is None:
            raise LookupError(f"{entry.py_func.__qualname__}{types}: not in the cache, which cannot be written")
        found[ahead.name_of(entry.py_func, types)] = pickle.dumps(parts)
    return found
