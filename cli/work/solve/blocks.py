"""The blocks of a study solved, one ahead of whoever takes them."""

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import partial
from typing import Any, TypeVar

from numpy.typing import NDArray

from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.solve.given import solve_given

_T = TypeVar("_T")


def solve_block(study: Study, block: Block, threads: int | None) -> dict[str, NDArray[Any]]:
    """Solve a block of a study: the values of its variables and `status`."""
    if study.search:
        from gradhesion.cli.work.solve.optima import best_of_block, fronts_of_block  # noqa: PLC0415 (SciPy's optimisers)

        return (fronts_of_block if study.search.is_front else best_of_block)(study, block, threads)
    if study.uncertainty:
        from gradhesion.cli.work.solve.spreads import solve_uncertain  # noqa: PLC0415 (SciPy's statistics)

        return solve_uncertain(study, block, threads)
    several, axes, _ = study.apart(block)
    return solve_given(study, study.parameters_of(axes), several, block, threads, watch=study.watches_slope)


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
