"""The blocks of a study solved, some ahead of whoever takes them."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from itertools import islice
from typing import Any

from numpy.typing import NDArray

from gradhesion.cli.names.curves import is_ragged
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.solve.scenes import Arrays, draw, solve_given
from gradhesion.core.processors import processors

Engine = Callable[[Study, Sequence[int]], Iterator[tuple[int, Arrays]]]
"""Solves blocks of a study by their numbers: gives each once, in any order, with its values."""


def solve_block(study: Study, block: Block, threads: int | None) -> Arrays:
    """Solve a block of a study: the values of its variables and `status`."""
    if study.kind == "curve":
        return draw(study, block)
    if study.search:
        from gradhesion.cli.work.solve.optima import solve_optima  # noqa: PLC0415 (SciPy's optimisers)

        return solve_optima(study, block, threads)
    if study.uncertainty:
        from gradhesion.cli.work.solve.spreads import solve_uncertain  # noqa: PLC0415 (SciPy's statistics)

        return solve_uncertain(study, block, threads)
    _, axes, _ = study.apart(block)
    return solve_given(study, study.parameters_of(axes), block, threads, watch=study.watches_slope)


def in_threads(study: Study, numbers: Sequence[int], threads: int | None = None) -> Iterator[tuple[int, Arrays]]:
    """Solve blocks in this process, in their order, one ahead of whoever takes them.

    A block is solved on so many threads, or as many as the process may use; of curves several are drawn at a time.
    """
    workers, ahead = 1, 1
    if study.kind == "curve":
        workers = min(threads or processors(), study.scenes)
        ahead = 2 * workers
    pool = ThreadPoolExecutor(workers, thread_name_prefix="solve")
    left, begun = iter(numbers), deque[tuple[int, Future[Arrays]]]()
    try:
        while True:
            for number in islice(left, ahead + 1 - len(begun)):
                begun.append((number, pool.submit(solve_block, study, study.tiling[number], threads)))
            if not begun:
                return
            number, future = begun.popleft()
            while not future.done():
                wait([future], timeout=0.2)
                interrupts.check()  # a library may have swallowed it
            yield number, future.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def within(name: str, block: Block, part: NDArray[Any], begun: int = 0) -> Block:
    """Report where a part goes that may have further dimensions than its block, or none of it, after `begun` items."""
    if is_ragged(name):
        return (slice(begun, begun + part.size),)
    return (*block, *(slice(0, length) for length in part.shape[len(block) :]))
