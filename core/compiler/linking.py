"""Kernels that only kernels call, kept as intermediate code: each one that Python calls is optimised once, as a whole.

Numba optimises every kernel, makes machine code of it and links its optimised code into every caller, where all of it
is optimised again. Here what an entry needs is linked into it as it was lowered, and optimised there alone. This takes
half the time, keeps one file for each entry instead of one for each kernel, and gives the same values: forces to the
bit, and of 20,000 energies all but five, which differ in the last bit. In a sum of two products one is fused with the
addition, and which one may depend on what else stands in a kernel (tests/core/compiler/test_linking.py).

Numba has no option for it: the files of this folder use its private interfaces. Where a version of it has others
(probe.py), or with GRADHESION_LINKING=ordinary in the environment, kernels are compiled and linked as numba does, and
nothing of what pipeline.py, resolving.py and keeping.py change is changed.
"""

from collections.abc import Callable
from typing import Any, Final
from weakref import WeakSet

from numba.core import event
from numba.core.codegen import JITCodeLibrary
from numba.core.registry import cpu_target

from gradhesion.core.compiler.resolving import remember_calls

_entries: Final[WeakSet[Any]] = WeakSet()
"""The kernels that Python calls."""
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
        """Skip the optimisation that the entry repeats."""
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


def install() -> Callable[[], None]:
    """Have numba make its code so in this process; return a function that undoes this."""
    codegen = cpu_target.target_context.codegen()
    make_library, set_environment = codegen._library_class, codegen.set_env  # noqa: SLF001

    def set_if_defined(name: str, environment: Any) -> None:
        """Set the environment of a kernel, unless it is intermediate code, which has none yet."""
        if not _compiling or codegen._engine.is_symbol_defined(name):  # noqa: SLF001
            set_environment(name, environment)

    codegen._library_class = _Library  # noqa: SLF001
    codegen.set_env = set_if_defined
    stack = _Stack()
    event.register("numba:compile", stack)
    forget_calls = remember_calls(_is_inside)

    def undo() -> None:
        codegen._library_class, codegen.set_env = make_library, set_environment  # noqa: SLF001
        event.unregister("numba:compile", stack)
        _compiling.clear()
        forget_calls()

    return undo


def note_entry(dispatcher: Any) -> None:
    """Record that Python calls a kernel: code compiled for it is linked into it."""
    _entries.add(dispatcher)


def entries() -> list[Any]:
    """Return the kernels that Python calls, of all imported modules."""
    return list(_entries)


def is_entry(dispatcher: Any) -> bool:
    """Report whether Python calls a kernel."""
    return dispatcher in _entries
