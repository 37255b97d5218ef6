"""Kernels are compiled by one process at a time: the index of numba's cache is read, changed and written back.

Two processes that do so at once can leave an index that points at the other's code.
"""

import hashlib
import json
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from typing import Final

import numba
from llvmlite import binding

from gradhesion.cli import interrupts
from gradhesion.cli.names import SOLVER
from gradhesion.cli.study.study import Study
from gradhesion.cli.work.blocks import solve_block
from gradhesion.cli.work.locks import closing, try_lock
from gradhesion.cli.work.parts import settings_of
from gradhesion.core import CACHE_FOLDER, kind_of_curves, kind_of_map

PAUSE: Final = 0.2
"""Seconds between two looks at what another process compiles."""

_one_of_us: Final = threading.Lock()


def kinds_of(study: Study) -> tuple[str, ...]:
    """Give the kinds of work of a study, each of which has kernels of its own (core/kinds.py)."""
    if study.kind == "curve":
        return (kind_of_curves(study.profile, study.loading),)
    solvers = study.method.solver
    solvers = (solvers,) if isinstance(solvers, str) else solvers
    return tuple(kind_of_map(study.outputs, solver, study.profile, study.loading) for solver in solvers)


def compile_kernels(study: Study) -> None:
    """
    Solve one scene of a map, so that its kernels are in memory and in the cache; another process is waited for.

    Once they are compiled for a kind of study and of processor, processes read the cache side by side.
    """
    processor = (binding.get_host_cpu_name(), binding.get_host_cpu_features().flatten())
    kind = (sys.version, numba.__version__, processor, settings_of(study))
    name = hashlib.sha256(json.dumps(kind, default=str).encode()).hexdigest()[:16]
    compiled = CACHE_FOLDER / f"compiled-{name}"
    scene = tuple(slice(0, size if name == SOLVER else 1) for name, size in study.sizes.items())
    with _one_of_us, _alone(CACHE_FOLDER / "lock", compiled):
        solve_block(study, scene, 1)
        with suppress(OSError):
            compiled.touch()


@contextmanager
def _alone(lock: Path, compiled: Path) -> Iterator[None]:
    """Hold a lock, unless `compiled` exists; without it where there is no such file, or no locks."""
    handle = None
    with suppress(OSError):
        lock.parent.mkdir(parents=True, exist_ok=True)
        while not compiled.exists() and (handle := try_lock(lock)) is None:
            interrupts.check()
            time.sleep(PAUSE)
    with nullcontext() if handle is None else closing(handle):
        yield
