"""Whether this version of numba links kernels as linking.py needs: tested once, and kept beside the kernels.

Private interfaces may change with any version of numba. Two small kernels, one of which calls the other, are compiled,
linked, written and read as all kernels are, and called; if anything of this fails, numba links kernels its own way. One
process tries, others wait for it; where it ends within the trial, its mark says so, and none tries again.
"""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Final

import numba
import numpy as np
from numba.core.registry import cpu_target

from gradhesion.core.compiler import ahead, cache, linking

_WORKS: Final = "as one"
_FAILS: Final = "one by one"
_TRYING: Final = "trying"


def _options() -> dict[str, Any]:
    """Return what kernels are compiled with; an ImportError if numba lacks a step."""
    from gradhesion.core.compiler.pipeline import KernelCompiler  # noqa: PLC0415 (part of the trial)

    return {"nogil": True, "pipeline_class": KernelCompiler, "error_model": "numpy", "no_cfunc_wrapper": True}


def _is_linked() -> bool:
    """Link two kernels into one, write and read it, and report whether both do what Python does."""
    from gradhesion.core.compiler.keeping import rebuilt, reduced  # noqa: PLC0415 (part of the trial)

    def below(pair: tuple[float, ...], x: float) -> float:
        return pair[0] * x + len(pair)

    inner = numba.njit(no_cpython_wrapper=True, **_options())(below)

    def above(values: Any, x: float) -> float:
        total = 0.0
        for value in values:
            total += inner((value, x), x)
        return total

    entry = numba.njit(**_options())(above)
    linking.note_entry(entry)
    values, expected = np.array([0.5, 2.0]), 0.5 * 3.0 + 2.0 + 2.0 * 3.0 + 2.0
    made = entry(values, 3.0)
    (compiled,), (lower,) = entry.overloads.values(), inner.overloads.values()
    again = rebuilt(cpu_target.target_context, reduced(compiled))
    return bool(made == again.entry_point(values, 3.0) == expected and lower.library._is_open)  # noqa: SLF001


def _works() -> bool:
    """Try it in this process, and undo it if it fails."""
    try:
        undo = linking.install()
    except Exception:  # noqa: BLE001 (whatever a version of numba raises)
        return False
    with suppress(Exception):
        if _is_linked():
            return True
    undo()
    return False


def _kept(mark: Path) -> str:
    """Return what a process has found; "" if none has, `_TRYING` if one is trying, or has ended within the trial."""
    try:
        return mark.read_text(encoding="ascii")
    except (OSError, ValueError):
        return ""


@contextmanager
def _alone(lock: Path) -> Iterator[None]:
    """Acquire a lock; do nothing where a folder has none."""
    from filelock import FileLock  # noqa: PLC0415 (10 ms, once)

    held = FileLock(lock)
    with suppress(OSError, NotImplementedError):
        held.acquire()
    try:
        yield
    finally:
        held.release()


def _found() -> bool:
    """Have numba link kernels so, if it can; return whether it does."""
    folder = cache.place().folder
    if ahead.shipped():  # compiled by the same version
        linking.install()
        return True
    if folder is None:
        return _works()
    mark = folder / f"linking-{cache.machine()}"
    known = _kept(mark)
    if known not in {_WORKS, _FAILS}:
        with _alone(mark.with_suffix(".lock")):
            known = _kept(mark)
            if not known:
                with suppress(OSError):
                    mark.write_text(_TRYING, encoding="ascii")
                works = _works()
                with suppress(OSError):
                    mark.write_text(_WORKS if works else _FAILS, encoding="ascii")
                return works
    if known == _WORKS:
        linking.install()
    return known == _WORKS


LAZY: Final = cache.LINKING != "ordinary" and _found()
"""Whether kernels are linked so."""


def folder_of_kernels() -> Path | None:
    """Return where this process keeps compiled kernels: those that numba links its own way are apart."""
    folder = cache.place().folder
    return folder if LAZY or folder is None else folder / "ordinary"
