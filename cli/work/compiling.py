"""The compilation of what a kind of study needs, by the first one of a version: announced, and done by one process.

Processes that start meanwhile wait for it: they would all compile the same. What a scene needs beyond that, as many
waves do, is compiled, and kept, while it is solved.
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Final

import numba
from filelock import FileLock

from gradhesion.cli.errors import SetupError
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import messages
from gradhesion.cli.work.solve.blocks import solve_block
from gradhesion.core import SENSITIVITIES, place
from gradhesion.core.problem.names import PULL_OFF

SECONDS: Final = {"forces": 15, "energies": 40, "sensitivities": 45, "speeds": 45, "curves": 40, "fits": 50}
"""How long a free processor compiles what each kind of study needs, if nothing is compiled yet; a slow one: twice."""

_begun: Final[set[tuple[Path | None, str]]] = set()
"""The folders (None where nothing is kept) and kinds for which this process has compiled."""


def need_of(study: Study | None) -> str:
    """Return which of the kinds of SECONDS a study is (None: a fit); a file of that name marks what is compiled."""
    if study is None:
        return "fits"
    if study.kind == "curve":
        return "curves"
    if study.rate is not None:
        return "speeds"
    if {*study.solved} & {*SENSITIVITIES}:
        return "sensitivities"
    return "forces" if {*study.solved} <= {*PULL_OFF} else "energies"


def prepare(study: Study | None = None) -> None:
    """Where no process of this version has compiled for such a study, say that it takes a while, and do so.

    A map is compiled for before it is solved, curves and fits (None) while they are.
    """
    refuse_without_compiler()
    folder, need = place().folder, need_of(study)
    if (folder, need) in _begun or (folder and (folder / need).exists()):
        return
    messages.say(f"compiling the solver for {need}, up to {SECONDS[need]} s of a free processor, once per version")
    with alone(need):
        if study is not None and study.kind == "map":  # the first and the last of its scenes
            for places in ([0] * len(study.shape), [size - 1 for size in study.shape]):
                with suppress(Exception):  # it is raised again, and reported, when the block is solved for its values
                    solve_block(study, tuple(slice(place, place + 1) for place in places), 1)


def refuse_without_compiler() -> None:
    """Make sure that kernels are compiled: as plain Python they take hours (SetupError)."""
    if numba.config.DISABLE_JIT:
        raise SetupError("NUMBA_DISABLE_JIT is set, but the solver needs the compiler; unset it")


@contextmanager
def alone(*needs: str) -> Iterator[None]:
    """Compile for some kinds of studies while no other process of this version compiles, and mark that it is done."""
    folder, why = place()
    if why and not _begun:  # nothing is kept
        messages.say(why)
    with ExitStack() as stack:
        if folder is not None:
            with suppress(OSError):
                stack.enter_context(FileLock(folder / "lock"))
        yield
        for need in needs:
            _begun.add((folder, need))
            with suppress(OSError):
                if folder is not None:
                    (folder / need).touch()
