"""The compilation of the solver by the first run of a version: announced once, and done by one process.

Processes that start meanwhile wait for it: they would all compile the same. What a later study needs beyond that is
compiled, and kept, while it is solved.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from typing import Final

import numba

from gradhesion.cli.errors import CompilerError
from gradhesion.cli.locks import closing, try_lock
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.terminal import interrupts, messages
from gradhesion.cli.work.solve.blocks import solve_block
from gradhesion.core import place

SECONDS: Final = 60
"""About how long one core compiles what both outputs of a first map need: 45 s on one machine, 90 s on another."""
PAUSE: Final = 0.2
"""Seconds between two looks at what another process compiles."""
_MARK: Final = "compiled"
"""A file in the folder of the kernels: a process has compiled, and has said so."""

_begun: Final[set[Path | None]] = set()
"""The folders for which this process has; None where nothing is kept."""


def prepare(study: Study | None = None) -> None:
    """
    Where no process has compiled this version of the solver, say that it takes a while, and compile it for a study.

    Raises
    ------
    CompilerError
        The environment says that nothing is to be compiled.
    """
    refuse_without_compiler()
    if is_first():
        say_why()
        messages.say("compile", f"compiling the solver, about {SECONDS} s, once per version")
        compile_for(study)


def refuse_without_compiler() -> None:
    """
    Make sure that kernels are compiled: as plain Python they take hours.

    Raises
    ------
    CompilerError
        The environment says that they are not to be.
    """
    if numba.config.DISABLE_JIT:
        raise CompilerError("NUMBA_DISABLE_JIT is set, but the solver needs the compiler; unset it")


def is_first() -> bool:
    """Report whether neither this process nor one before it has compiled this version."""
    folder = place().folder
    return folder not in _begun and (folder is None or not (folder / _MARK).exists())


def say_why() -> None:
    """Report why compiled kernels are not kept in the usual folder, if they are not."""
    if place().why:
        messages.say("cache", place().why)


def compile_for(study: Study | None) -> None:
    """Solve the first and the last scene of a map, so that what they need is compiled, and kept; of others nothing."""
    with alone():
        if study is not None and study.kind == "map":
            first, last = study.tiling[0], study.tiling[len(study.tiling) - 1]
            _try_to_solve(study, tuple(slice(part.start, part.start + 1) for part in first))
            _try_to_solve(study, tuple(slice(part.stop - 1, part.stop) for part in last))


def _try_to_solve(study: Study, block: Block) -> None:
    """Solve a block; what is raised there is raised, and reported, when the block is solved for its values."""
    with suppress(Exception):
        solve_block(study, block, 1)


@contextmanager
def alone() -> Iterator[None]:
    """Compile as the first process of this version that does, after any that is at it; without locks where none are."""
    folder, handle = place().folder, None
    with suppress(OSError):
        while folder is not None and is_first() and (handle := try_lock(folder / "lock")) is None:
            interrupts.check()
            time.sleep(PAUSE)
    with nullcontext() if handle is None else closing(handle):
        yield
        _begun.add(folder)
        with suppress(OSError):
            if folder is not None:
                (folder / _MARK).touch()
