"""The blocks of a study solved, one ahead of whoever takes them."""

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import partial
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names import SI, UNITS
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.scenes import solve
from gradhesion.core import PARAMETERS

_T = TypeVar("_T")


def scenes_of(study: Study, block: Block) -> dict[str, NDArray[np.float64]]:
    """Give the parameters of a block of the axes as the core knows them; NaN is one that does not exist."""
    given = study.parameters_of(block)
    if given.keys() >= {*PARAMETERS}:
        return given
    from gradhesion.core.reduced import parameters_from  # noqa: PLC0415 (300 ms for SciPy)

    return parameters_from(given)


def solve_block(study: Study, block: Block, threads: int | None) -> dict[str, NDArray[Any]]:
    """Solve a block of a study: the values of its variables and `status`."""
    found = _solved(study, block, threads)
    scales = scales_of(study, block[len(block) - len(study.axes) :])
    return found | {name + SI: found[name] * scales[UNITS[name]] for name in study.in_si}


def scales_of(study: Study, block: Block) -> dict[str, NDArray[np.float64]]:
    """Give what results are multiplied by for SI units, by the unit; nothing if the study has none."""
    if not study.in_si:
        return {}
    from gradhesion.core.reduced import scales_in_si  # noqa: PLC0415 (300 ms for SciPy)

    given = study.parameters_of(block)
    scales = scales_in_si(given["R"], given["work_of_adhesion"])
    if any(UNITS[name] == "Pa" for name in study.in_si):
        from gradhesion.core.equations.pressure import pressure_unit  # noqa: PLC0415 (300 ms for SciPy)

        scales["Pa"] = pressure_unit(given["R"], given["work_of_adhesion"])
    return scales


def _solved(study: Study, block: Block, threads: int | None) -> dict[str, NDArray[Any]]:
    """Solve a block of a study: its outputs and `status`."""
    solvers = study.method.solver
    settings: dict[str, Any] = {"check_contact": study.method.check_contact, "threads": threads}
    settings |= {"profile": study.profile, "loading": study.loading}
    if isinstance(solvers, str):
        return solve(scenes_of(study, block), study.outputs, solver=solvers, **settings)
    scenes = scenes_of(study, block[1:])
    found = [solve(scenes, study.outputs, solver=solver, **settings) for solver in solvers[block[0]]]
    return {name: np.stack([values[name] for values in found]) for name in found[0]}


def solved(study: Study, threads: int | None = None) -> Iterator[tuple[Block, dict[str, NDArray[Any]]]]:
    """Solve a study block by block: the values of each block and its `status`."""

    def task(block: Block) -> tuple[Block, dict[str, NDArray[Any]]]:
        return block, solve_block(study, block, threads)

    yield from one_ahead(partial(task, block) for block in study.tiling)


def one_ahead(tasks: Iterable[Callable[[], _T]]) -> Iterator[_T]:
    """Run tasks in a thread of their own, each while the caller deals with the one before; two are in memory."""
    worker = ThreadPoolExecutor(1, thread_name_prefix="solve")
    try:
        ahead: Future[_T] | None = None
        for task in tasks:
            future = worker.submit(task)
            if ahead is not None:
                yield awaited(ahead)
            ahead = future
        if ahead is not None:
            yield awaited(ahead)
    finally:
        worker.shutdown(wait=False, cancel_futures=True)


def awaited(future: Future[_T]) -> _T:
    """Wait for a result without being deaf to an interrupt that a library swallowed."""
    while not future.done():
        wait([future], timeout=0.2)
        interrupts.check()
    return future.result()
