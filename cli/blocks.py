"""How the scenes of a study are cut into blocks, and the blocks solved one ahead of whoever takes them."""

import math
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from itertools import product
from typing import Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli import interrupts
from gradhesion.cli.study import Study
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


def blocks(shape: tuple[int, ...]) -> Iterator[Block]:
    """
    Cut a shape into blocks of whole chunks, so that no chunk is written twice.

    >>> [block[0] for block in blocks((5, 131_072))]
    [slice(0, 2, None), slice(2, 4, None), slice(4, 5, None)]
    """
    chunk = chunk_shape(shape)
    counts = tuple(-(-length // part) for length, part in zip(shape, chunk, strict=True))
    steps = [n * part for n, part in zip(tile(counts, CHUNKS_OF_BLOCK), chunk, strict=True)]
    cuts = [
        [slice(start, min(start + step, length)) for start in range(0, length, step)]
        for length, step in zip(shape, steps, strict=True)
    ]
    yield from product(*cuts)


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
    """Solve a block of a study: the values of its outputs and `status`."""
    solvers, check = study.method.solver, study.method.check_contact
    if isinstance(solvers, str):
        scenes = scenes_of(study, block)
        return solve(scenes, study.outputs, solver=solvers, check_contact=check, threads=threads)
    scenes = scenes_of(study, block[1:])
    found = [
        solve(scenes, study.outputs, solver=solver, check_contact=check, threads=threads)
        for solver in solvers[block[0]]
    ]
    return {name: np.stack([values[name] for values in found]) for name in found[0]}


def solved(study: Study, threads: int | None = None) -> Iterator[tuple[Block, dict[str, NDArray[Any]]]]:
    """
    Solve a study block by block: the values of each block and its `status`.

    The next block is solved in a thread of its own while the caller deals with this one; two blocks are in memory.
    """
    worker = ThreadPoolExecutor(1, thread_name_prefix="solve")
    try:
        ahead = None
        for block in blocks(study.shape):
            future = worker.submit(solve_block, study, block, threads)
            if ahead is not None:
                yield ahead[0], awaited(ahead[1])
            ahead = block, future
        if ahead is not None:
            yield ahead[0], awaited(ahead[1])
    finally:
        worker.shutdown(wait=False, cancel_futures=True)


def awaited(future: Future[_T]) -> _T:
    """Wait for a result without being deaf to an interrupt that a library swallowed."""
    while not future.done():
        wait([future], timeout=0.2)
        interrupts.check()
    return future.result()
