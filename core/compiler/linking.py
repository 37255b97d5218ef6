"""Kernels that only kernels call, kept as intermediate code: each one that Python calls is optimised once, as a whole.

Numba optimises every kernel, makes machine code of it and links its optimised code into every caller, where all of it
is optimised again. Here what an entry needs is linked into it as it was lowered, and optimised there alone. This takes
half the time, keeps one file for each entry instead of one for each kernel, and gives the same values: forces to the
bit, and of 20,000 energies all but five, which differ in the last bit. In a sum of two products one is fused with the
addition, and which one may depend on what else stands in a kernel (tests/core/compiler/test_linking.py).

Numba has no option for it: the files of this folder use its private interfaces, of the versions in `KNOWN`. With
another version, or with GRADHESION_LINKING=ordinary in the environment, `LAZY` is false: kernels are compiled and
linked as numba does, and nothing of what pipeline.py, resolving.py and keeping.py change is changed.
"""

import os
from typing import Any, Final
from weakref import WeakSet

import numba
from numba.core import event
from numba.core.codegen import JITCodeLibrary
from numba.core.registry import cpu_target

from gradhesion.core.compiler.resolving import remember_calls

KNOWN: Final = tuple((0, minor) for minor in range(62, 69))
"""The versions of numba, major and minor number, whose interfaces are those that are used here."""
LAZY: Final = numba.version_info.short in KNOWN and os.environ.get("GRADHESION_LINKING") != "ordinary"
"""Whether kernels are linked so."""

_entries: Final[WeakSet[Any]] = WeakSet()
"""What Python calls."""
_compiling: Final[list[Any]] = []
"""What is being compiled, each for the one before; numba compiles under a lock of the process."""


def _is_inside() -> bool:
    """Report whether what is being compiled is for an entry of ours."""
    return bool(_compiling) and _compiling[0] in _entries


class _Stack(event.Listener):  # type: ignore[misc] # numba has no types
    """Keeps what is being compiled."""

    def on_start(self, started: Any) -> None:
        """Put a kernel on the stack."""
        _compiling.append(started.data["dispatcher"])

    def on_end(self, _event: Any) -> None:
        """Take it off."""
        _compiling.pop()


class _Library(JITCodeLibrary):  # type: ignore[misc]
    """The code of one kernel: as intermediate code if it is for an entry of ours, else as numba makes it."""

    _linking_libraries: list[Any]
    """What it calls, directly."""
    _is_open = False
    """Whether it stays intermediate code, without that of the kernels that it calls."""

    def _optimize_functions(self, module: Any) -> None:
        """Leave to the entry what would be optimised there again."""
        if _is_inside():
            module.data_layout = self._codegen._data_layout  # noqa: SLF001
        else:
            super()._optimize_functions(module)

    def finalize(self) -> None:
        """Leave the code as it is, or link all that is below, optimise it and make machine code."""
        is_entry = len(_compiling) == 1 and self.name == _compiling[0].py_func.__qualname__
        if _is_inside() and not is_entry and not self.name.startswith("nrt"):
            self._raise_if_finalized()
            self._is_open = self._finalized = True
            return
        self._linking_libraries = _all_below(self._linking_libraries)
        super().finalize()


def _all_below(libraries: list[Any]) -> list[Any]:
    """List libraries, and those that the open ones among them need."""
    found: dict[Any, None] = {}
    left = libraries[::-1]
    while left:
        library = left.pop()
        if library not in found:
            found[library] = None
            if getattr(library, "_is_open", False):
                left += library._linking_libraries[::-1]  # noqa: SLF001
    return list(found)


def _install() -> None:
    """Have numba make its code so in this process."""
    codegen = cpu_target.target_context.codegen()
    set_environment = codegen.set_env

    def set_if_defined(name: str, environment: Any) -> None:
        """Set the environment of a kernel, unless it is intermediate code, which has none yet."""
        if not _compiling or codegen._engine.is_symbol_defined(name):  # noqa: SLF001
            set_environment(name, environment)

    codegen._library_class = _Library  # noqa: SLF001
    codegen.set_env = set_if_defined
    event.register("numba:compile", _Stack())
    remember_calls(_is_inside)


def note_entry(dispatcher: Any) -> None:
    """Keep that Python calls a kernel: what is compiled for it is linked into it."""
    _entries.add(dispatcher)


def entries() -> list[Any]:
    """Return what Python calls, of all modules that are imported."""
    return list(_entries)


def is_kept(dispatcher: Any) -> bool:
    """Report whether the machine code of a kernel is kept by itself, not in that of entries alone."""
    return not LAZY or dispatcher in _entries


if LAZY:
    _install()
