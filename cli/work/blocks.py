"""How the scenes of a study are cut into blocks, and the blocks solved one ahead of whoever takes them."""

import math
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import partial
from itertools import product
from typing import Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli import interrupts
from gradhesion.cli.names import SI, UNITS
from gradhesion.cli.study.study import Study
from gradhesion.core import PARAMETERS, solve

CHUNK: Final = 131_072
"""Cells of a chunk in the file: one MiB of float64."""

CHUNKS_OF_BLOCK: Final = 2
"""Chunks of a block: a second or so of the slowest work, so that progress shows and an interrupt is heard."""

Block = tuple[slice, ...]
_T = TypeVar("_T")


def tile(shape: tuple[int, ...], cells: int) -> tuple[int, ...]:
    """
    Cut a shape into even tiles of at most `cells` cells, the trailing axes whole as long as they fit.

    Leading axes are cut first, since all a_max (the last axis) of one curve share its trace.

    >>> tile((19, 4, 60, 5, 6), 131_072)
    (10, 4, 60, 5, 6)
    """
    size = []
    for length in reversed(shape):
        parts = -(-length // max(1, min(length, cells)))
        size.append(-(-length // parts))
        cells = cells // length if parts == 1 else 1
    return tuple(reversed(size))


def chunk_shape(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Choose the chunks of a variable in the file."""
    return tile(shape, CHUNK)


def _cuts(shape: tuple[int, ...]) -> list[range]:
    """Tell where the blocks of a shape begin along each axis; the steps are their lengths."""
    chunk = chunk_shape(shape)
    counts = tuple(-(-length // part) for length, part in zip(shape, chunk, strict=True))
    steps = [n * part for n, part in zip(tile(counts, CHUNKS_OF_BLOCK), chunk, strict=True)]
    return [range(0, length, step) for length, step in zip(shape, steps, strict=True)]


def blocks(shape: tuple[int, ...]) -> Iterator[Block]:
    """
    Cut a shape into blocks of whole chunks, so that no chunk is written twice.

    >>> [block[0] for block in blocks((5, 131_072))]
    [slice(0, 2, None), slice(2, 4, None), slice(4, 5, None)]
    """
    cuts = [[slice(start, min(start + cut.step, cut.stop)) for start in cut] for cut in _cuts(shape)]
    yield from product(*cuts)


def block_at(shape: tuple[int, ...], number: int) -> Block:
    """
    Give a block by its number.

    >>> block_at((5, 131_072), 2)
    (slice(4, 5, None), slice(0, 131072, None))
    """
    cuts = _cuts(shape)
    at = []
    for cut in reversed(cuts):
        number, place = divmod(number, len(cut))
        at.append(slice(cut[place], min(cut[place] + cut.step, cut.stop)))
    return tuple(reversed(at))


def count_of(shape: tuple[int, ...]) -> int:
    """
    Count the blocks of a shape.

    >>> count_of((5, 131_072)), count_of(())
    (3, 1)
    """
    return math.prod(map(len, _cuts(shape)))


def size_of(block: Block) -> int:
    """Count the cells of a block."""
    return math.prod(part.stop - part.start for part in block)


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
    return scales_in_si(given["R"], given["work_of_adhesion"])


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

    yield from one_ahead(partial(task, block) for block in blocks(study.shape))


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
