"""The compilation of the solver by the first run of a version: announced once, and done by one process.

Processes that start meanwhile wait for it: they would all compile the same. What a later study needs beyond that is
compiled, and kept, while it is solved.
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Final

import numba
from filelock import FileLock

from gradhesion.cli.errors import CompilerError
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import messages
from gradhesion.cli.work.solve.blocks import solve_block
from gradhesion.core import place

SECONDS: Final = 60
"""About how long one core compiles what both outputs of a first map need: 45 s on one machine, 90 s on another."""
_MARK: Final = "compiled"
"""A file in the folder of the kernels: a process has compiled, and has said so."""

_begun: Final[set[Path | None]] = set()
"""The folders for which this process has; None where nothing is kept."""


def prepare(study: Study | None = None) -> None:
    """Where no process has compiled this version of the solver, say that it takes a while, and do so for a study."""
    refuse_without_compiler()
    folder = place().folder
    if folder in _begun or (folder and (folder / _MARK).exists()):
        return
    say_why()
    messages.say(f"compiling the solver, about {SECONDS} s, once per version")
    with alone():
        if study is not None and study.kind == "map":  # the first and the last of its scenes, of others nothing
            first, last = study.tiling[0], study.tiling[len(study.tiling) - 1]
            for scene in (
                tuple(slice(part.start, part.start + 1) for part in first),
                tuple(slice(part.stop - 1, part.stop) for part in last),
            ):
                with suppress(
                    Exception
                ):  # which is raised again, and reported, when the block is solved for its values
                    solve_block(study, scene, 1)


def refuse_without_compiler() -> None:
    """Make sure that kernels are compiled: as plain Python they take hours (CompilerError)."""
    if numba.config.DISABLE_JIT:
        raise CompilerError("NUMBA_DISABLE_JIT is set, but the solver needs the compiler; unset it")


def say_why() -> None:
    """Report why compiled kernels are not kept in the usual folder, if they are not."""
    if place().why:
        messages.say(place().why)


@contextmanager
def alone() -> Iterator[None]:
    """Compile while no other process of this version does."""
    folder = place().folder
    with ExitStack() as stack:
        if folder is not None:
            with suppress(OSError):
                stack.enter_context(FileLock(folder / "lock"))
        yield
        _begun.add(folder)
        with suppress(OSError):
            if folder is not None:
                (folder / _MARK).touch()
