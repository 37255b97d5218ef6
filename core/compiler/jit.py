"""The decorator of all kernels, and messages about their compilation."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import update_wrapper
from pathlib import Path
from typing import Any, Final, TypeVar, cast

import numba
import numpy as np
from numba.core import event

from gradhesion.core.compiler import cache, collecting, keeping, linking
from gradhesion.core.compiler.borrowed import OrdinaryCompiler
from gradhesion.core.compiler.probe import LAZY, folder_of_kernels

Function = TypeVar("Function", bound=Callable[..., Any])


def constant(value: int) -> Any:
    """Return a flag or a whole number that numba takes for a variable: it compiles a kernel anew for each literal."""
    return np.bool_(value) if isinstance(value, bool) else np.int64(value)


YES: Final = constant(True)
NO: Final = constant(False)
NONE: Final = constant(0)
"""The number of an item that does not exist yet."""
ONE: Final = constant(1)

_Compiler: Any = OrdinaryCompiler
if LAZY:
    from gradhesion.core.compiler.pipeline import KernelCompiler as _Compiler

_PACKAGE: Final = "gradhesion.core."
_making: Final = threading.RLock()


class Kernel:
    """A kernel: for Python the entry, for other kernels its inner code.

    Both are compiled from the same function, and have its name, its types and its bits. The entry is kept in the cache
    with all the kernels that it calls; what is inner is linked into entries (linking.py). Either is made when it is
    first needed: a run whose kernels are all compiled needs some entries, and nothing inner.
    """

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]) -> None:
        update_wrapper(self, function)
        self._function, self._options, self._folder = function, options, cache.place().folder

    def __call__(self, *arguments: Any) -> Any:
        """Call the entry."""
        return self._entry(*arguments)

    def __getattr__(self, name: str) -> Any:
        """Make the entry or the inner code, once; give what the entry has, or the inner code if there is no entry."""
        if name in {"_function", "_options", "_folder"}:  # not set yet, as in a copy
            raise AttributeError(name)
        is_inner = self._options["no_cpython_wrapper"]
        if name not in {"_entry", "_inner"}:
            return getattr(self._inner if is_inner else self._entry, name)
        if name == "_entry" and is_inner:
            raise TypeError(f"{self._function.__qualname__} is called by kernels alone: its name begins with _")
        with _making:
            if name not in vars(self):
                vars(self)[name] = self._made_entry() if name == "_entry" else self._made_inner()
        return vars(self)[name]

    def _made_entry(self) -> Any:
        """Make what Python calls."""
        entry = numba.njit(**self._options)(self._function)
        keeping.keep(entry, self._folder)
        linking.note_entry(entry)
        return entry

    def _made_inner(self) -> Any:
        """Make what kernels call."""
        return numba.njit(**self._options | {"no_cpython_wrapper": True})(self._function)

    @property
    def _numba_type_(self) -> Any:
        """The type for numba, where a kernel calls this one."""
        return self._inner._numba_type_

    @property
    def signatures(self) -> list[Any]:
        """The types for which it has been compiled."""
        made = [vars(self)[name] for name in ("_entry", "_inner") if name in vars(self)]
        return list(dict.fromkeys(types for one in made for types in one.signatures))


def kernel(*, contract: bool = False, inline: bool = False, entry: bool = False) -> Callable[[Function], Function]:
    """Compile a function to machine code that releases the GIL and follows IEEE arithmetic.

    A kernel whose name begins with an underscore is called by kernels alone, and is compiled without what lets Python
    call it (a tenth of the time): such a call is a TypeError, or ends the process where kernels are linked as numba
    does (linking.py). Other kernels can be called from Python as well.

    Parameters
    ----------
    contract
        Allow `a * b + c` to be rounded once. No other liberty is ever taken: with full fast-math `isnan` is always
        false, and the exact argument reductions of the wave break.
    inline
        Insert the function into its callers: for one so short that handing its arrays over is a good part of its cost.
    entry
        Let Python call it, whatever its name.
    """

    def decorate(function: Function) -> Function:
        options = {
            "nogil": True,
            "pipeline_class": _Compiler,
            "error_model": "numpy",
            "fastmath": {"contract"} if contract else False,
            "inline": "always" if inline else "never",
            "no_cfunc_wrapper": True,  # none is passed as a function
            "no_cpython_wrapper": function.__name__.startswith("_") and not entry,
        }
        if not LAZY or inline:
            return _kept(function, options)
        return cast("Function", Kernel(function, options))

    return decorate


def _kept(function: Function, options: dict[str, Any]) -> Function:
    """Have a function compiled when it is called, and the code kept as numba does where that is possible."""
    folder = folder_of_kernels()
    if folder is not None:
        try:
            folder.mkdir(exist_ok=True)
            with keeping.kept_in(folder):
                found: Function = numba.njit(cache=True, **options)(function)
        except (OSError, RuntimeError):  # the folder has gone, or is full
            pass
        else:
            if Path(found.stats.cache_path).is_relative_to(folder):  # type: ignore[attr-defined] # else beside the source
                return found
    compiled: Function = numba.njit(**options)(function)
    return compiled


class _Compilation(event.Listener):  # type: ignore[misc] # numba has no types
    """Is notified of every kernel that is compiled, not of those read from the cache."""

    def __init__(self) -> None:
        self.begun = False
        self.listeners: list[tuple[Callable[[str], None], bool]] = []

    def on_start(self, _event: Any) -> None:
        """Clear away other versions, once in a process that compiles."""
        if self.begun:
            return
        self.begun = True
        folder = cache.place().folder
        if folder is not None:
            cache.remove_unused(folder)

    def on_end(self, finished: Any) -> None:
        """Pass on the name of a kernel."""
        dispatcher = finished.data["dispatcher"]
        function = dispatcher.py_func
        if function.__module__.startswith(_PACKAGE):
            for listener, kept in (*self.listeners,):
                if not kept or not LAZY or linking.is_entry(dispatcher):
                    listener(f"{function.__module__.removeprefix(_PACKAGE)}.{function.__name__}")


_compilation: Final = _Compilation()
event.register("numba:compile", _compilation)
event.register("numba:compile", collecting.Seldom())


@contextmanager
def watch_compilation(listener: Callable[[str], None], *, kept: bool = False) -> Iterator[None]:
    """Call `listener` with the name of each kernel that is compiled within the block, by any thread.

    Parameters
    ----------
    listener
        It gets the name, as "scene.solve_curve", when the kernel is done. An exception in it ends the compilation.
        `KERNELS` (kinds.py) has the number to expect.
    kept
        Only of those whose code is kept by itself, not as a part of that of others (linking.py).

    Examples
    --------
    >>> from gradhesion.core import solve
    >>> names = []
    >>> with watch_compilation(names.append):
    ...     _ = solve(dict(k=0, nu=0.3, modulus=500, c0_over_R=1, lambda_over_R=1, A=0, a_max_over_R=1), threads=1)
    >>> with watch_compilation(names.append):  # the same again: nothing is left to compile
    ...     names.clear()
    ...     _ = solve(dict(k=0, nu=0.3, modulus=500, c0_over_R=1, lambda_over_R=1, A=0, a_max_over_R=1), threads=1)
    >>> names
    []
    """
    _compilation.listeners.append((listener, kept))
    try:
        yield
    finally:
        _compilation.listeners.remove((listener, kept))
