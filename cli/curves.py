"""The curves of a study: drawn scene by scene, each as long as it needs to be, and padded to the longest."""

import os
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import product
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.blocks import Block, awaited, scenes_of
from gradhesion.cli.names import CURVES, EXTENTS, INTEGERS
from gradhesion.cli.study import Study
from gradhesion.core import draw_curves

AHEAD: Final = 2
"""Scenes drawn ahead a thread."""

Drawing = tuple[Block, dict[str, NDArray[Any]]]


def extent_of(variable: str) -> str:
    """
    Name the dimension along the curve that a variable belongs to.

    >>> extent_of("path_load")
    'path_point'
    """
    return next(EXTENTS[curve] for curve, own in CURVES.items() if variable in own)


def blank_of(variable: str) -> float:
    """Give what stands where a curve has no point."""
    return -1 if variable in INTEGERS else np.nan


def drawn(study: Study, threads: int | None = None) -> Iterator[Drawing]:
    """
    Draw a study scene by scene: its curves, along one more dimension than its block, and its `status`.

    Scenes are drawn in threads of their own, some ahead of whoever takes them; they come in order.
    """
    workers = min(threads or os.cpu_count() or 1, study.scenes)
    pool = ThreadPoolExecutor(workers, thread_name_prefix="draw")
    ahead: deque[Future[Drawing]] = deque()
    try:
        for item in product(*(range(length) for length in study.shape)):
            block = tuple(slice(i, i + 1) for i in item)
            ahead.append(pool.submit(_draw, study, block))
            if len(ahead) > AHEAD * workers:
                yield awaited(ahead.popleft())
        while ahead:
            yield awaited(ahead.popleft())
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _draw(study: Study, block: Block) -> Drawing:
    """Draw the curves of one scene; one that has none is one point without a value."""
    scene = {name: float(values.item()) for name, values in scenes_of(study, block).items()}
    curves = [curve for curve, own in CURVES.items() if any(name in own for name in study.outputs)]
    found, status = draw_curves(scene, curves)
    front = (1,) * len(block)
    parts = {}
    for name in study.outputs:
        values = np.asarray(found[name]) if np.size(found[name]) else np.array([blank_of(name)])
        parts[name] = values.reshape(*front, -1)
    parts["status"] = np.full(front, status, dtype=np.int8)
    return block, parts


def gathered(study: Study, threads: int | None = None) -> dict[str, NDArray[Any]]:
    """Draw a study in memory, padded to its longest curves."""
    drawings = list(drawn(study, threads))
    filled: dict[str, NDArray[Any]] = {"status": np.empty(study.shape, np.int8)}
    for name in study.outputs:
        longest = max(parts[name].shape[-1] for _, parts in drawings)
        filled[name] = np.full((*study.shape, longest), blank_of(name), INTEGERS.get(name, "f8"))
    for block, parts in drawings:
        for name, part in parts.items():
            filled[name][within(block, part)] = part
    return filled


def within(block: Block, part: NDArray[Any]) -> Block:
    """
    Tell where a part goes that has further dimensions than its block.

    >>> within((slice(2, 3),), np.zeros((1, 5)))
    (slice(2, 3, None), slice(0, 5, None))
    """
    return (*block, *(slice(0, length) for length in part.shape[len(block) :]))
