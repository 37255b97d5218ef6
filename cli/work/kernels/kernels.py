"""Kernels are compiled by one process at a time: the index of numba's cache is read, changed and written back.

Two processes that do so at once can leave an index that points at the other's code. Once kernels are compiled for a
kind of work and of processor, processes read the cache side by side.
"""

import math
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from subprocess import DEVNULL
from typing import Final

import numba
import numpy as np

from gradhesion.cli.errors import CompilerError
from gradhesion.cli.keys import CLOSING
from gradhesion.cli.locks import closing, try_lock
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import interrupts
from gradhesion.core import (
    MANY_SMOOTH,
    NEEDS,
    SENSITIVITIES,
    VALIDITY,
    compiled_before,
    kind_of_curves,
    kind_of_map,
    kind_of_sensitivities,
    kind_of_turning,
    kinds_of_long,
    place,
)
from gradhesion.core.problem.names import CONTACT_SLOPE

PAUSE: Final = 0.2
"""Seconds between two looks at what another process compiles."""

_AMPLITUDES: Final = ("A", "chi", "amplitude")
"""The parameters that give the height of waves (core/closed/reduced.py)."""
_WITH_SMOOTH: Final = frozenset({"force", "energy", "reports"})
"""The kinds of work whose smooth scenes, if they are many, have kernels of their own."""
_one_of_us: Final = threading.Lock()


def kinds_of(study: Study) -> tuple[str, ...]:
    """Give the kinds of work of a study, each of which has kernels of its own (core/kinds.py)."""
    driven = (study.profile, study.loading, study.toughness)
    turning = (kind_of_turning(*driven),) if study.turn else ()
    moving = () if study.rate is None else ("rate",)
    if study.kind == "curve":
        return (*turning, kind_of_curves(*driven), *moving)
    solvers = study.method.solver
    solvers = (solvers,) if isinstance(solvers, str) else solvers
    outputs = [name for name in study.solved if name not in (*VALIDITY, CONTACT_SLOPE)]
    slopes = (kind_of_sensitivities(*driven),) if {*outputs} & {*SENSITIVITIES} else ()
    kinds = dict.fromkeys(kind_of_map(outputs, solver, *driven) for solver in solvers)
    many = study.scenes >= MANY_SMOOTH and _smooth_scenes(study) >= MANY_SMOOTH
    smooth = ("smooth",) if many and {*kinds} & _WITH_SMOOTH and not slopes else ()
    snaps = "snap_in_force" in outputs
    edge = ("edge",) if snaps or (slopes and study.gives(CLOSING) and study.turn) else ()
    jump = (kind_of_turning(*driven),) if snaps else ()
    long = kinds_of_long((*kinds, *slopes), _most_waves(study), study.profile)
    return tuple(dict.fromkeys((*kinds, *smooth, *turning, *jump, *slopes, *long, *edge, *moving)))


def _most_waves(study: Study) -> float:
    """Give the most wavelengths that a rim of a study contains, as far as its keys show that: else inf."""
    given = study.parameters
    if "lambda_over_R" in study.left_out:
        return 0.0
    if study.search or study.uncertainty:
        return math.inf
    for rim, wavelength in (("a_max_over_R", "lambda_over_R"), ("a_max", "wavelength")):
        if rim in given and wavelength in given:
            return float(np.max(given[rim]) / np.min(given[wavelength]))
    return math.inf


def _smooth_scenes(study: Study) -> float:
    """Give the number of a study's scenes that have no waves."""
    given = (study.parameters[name] for name in _AMPLITUDES if name in study.parameters)
    return study.scenes * max((float(np.mean(np.equal(values, 0.0))) for values in given), default=0.0)


def missing_of(kinds: Sequence[str]) -> list[str]:
    """List what is to be compiled for some kinds of work: those that are not, after the kinds that they need."""
    steps: dict[str, None] = {}

    def add(kind: str) -> None:
        if not compiled_before(kind):
            for needed in NEEDS[kind]:
                add(needed)
            steps[kind] = None

    for kind in kinds:
        add(kind)
    return list(steps)


def refuse_without_compiler() -> None:
    """
    Make sure that kernels are compiled: some of them are no Python.

    Raises
    ------
    CompilerError
        The environment says that they are not to be.
    """
    if numba.config.DISABLE_JIT:
        raise CompilerError("NUMBA_DISABLE_JIT is set, but the solver needs the compiler; unset it")


def compile_kinds(kinds: Sequence[str], done: Callable[[str], None] = lambda _: None, *, alone: bool = False) -> None:
    """
    Compile the kernels of some kinds of work, so that they are in memory and in the cache.

    A process that compiles any of them is waited for. `done` is called with the name of each kernel that is compiled
    here; `alone` is that no other process helps.
    """
    from gradhesion.core import compile_kind, watch_compilation  # noqa: PLC0415 (all kernels, also those of curves)

    folder = place().folder
    with _one_of_us, nullcontext() if folder is None else _alone(folder / "lock", kinds), watch_compilation(done):
        missing = missing_of(kinds)
        if folder is not None and not alone:
            _compile_side_by_side(missing)
        for kind in missing:
            interrupts.check()
            compile_kind(kind)


def _compile_side_by_side(kinds: Sequence[str]) -> None:
    """Compile the tables in another process, and here the loop that needs them, where that can be: a fifth sooner.

    What becomes of the other process does not matter: this one compiles what is not kept then.
    """
    from gradhesion.core.compiler.probe import LAZY  # noqa: PLC0415
    from gradhesion.core.processors import processors  # noqa: PLC0415 (a run whose kernels are compiled)
    from gradhesion.core.warmup import LOOPS, compile_loop  # noqa: PLC0415

    loop = next((kind for kind in kinds if kind in LOOPS), None)
    if not (LAZY and loop and "tables" in kinds and sys.executable and processors() > 1):
        return
    tables = [sys.executable, "-P", "-c", "from gradhesion.core import compile_kind; compile_kind('tables')"]
    try:
        other = subprocess.Popen(tables, stdin=DEVNULL, stdout=DEVNULL, stderr=DEVNULL)  # noqa: S603 (of our own)
    except OSError:  # no more processes
        return
    with other:
        try:
            compile_loop(loop)
        except BaseException:
            other.kill()
            raise


@contextmanager
def _alone(lock: Path, kinds: Sequence[str]) -> Iterator[None]:
    """Hold a lock, unless all is compiled; without it where there is no such file, or no locks."""
    handle = None
    with suppress(OSError):
        while missing_of(kinds) and (handle := try_lock(lock)) is None:
            interrupts.check()
            time.sleep(PAUSE)
    with nullcontext() if handle is None else closing(handle):
        yield
