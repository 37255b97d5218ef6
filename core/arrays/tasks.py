"""Tasks of one gradient exponent each, and the threads that do them: however many there are, a few are in memory."""

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Task: TypeAlias = tuple[float, NDArray[np.int64]]
"""A gradient exponent, and the indices of curves that have it."""


@dataclass(frozen=True)
class Tasks:
    """The tasks of some curves, made when they are asked for.

    Attributes
    ----------
    k
        The exponents of the curves; shape (curves,).
    order
        The curves, those of one exponent next to each other; shape (curves,).
    ends
        Where each exponent begins in `order`, and where the last one ends; shape (exponents + 1,).
    size
        Curves of a task, at most.
    """

    k: NDArray[np.float64]
    order: NDArray[np.int64]
    ends: NDArray[np.int64]
    size: int

    def __len__(self) -> int:
        return int(np.sum(-(-np.diff(self.ends) // self.size)))

    def __iter__(self) -> Iterator[Task]:
        for i in range(self.ends.size - 1):
            begin, end = int(self.ends[i]), int(self.ends[i + 1])
            exponent = float(self.k[self.order[begin]])
            for first in range(begin, end, self.size):
                yield exponent, self.order[first : min(first + self.size, end)]


def tasks_of(k: NDArray[np.float64], size: int) -> Tasks:
    """Cut curves into tasks of one exponent each, of at most `size` curves.

    Examples
    --------
    >>> tasks = tasks_of(np.array([0.3, 0.0, 0.3, 0.3]), 2)
    >>> len(tasks), [(exponent, index.tolist()) for exponent, index in tasks]
    (3, [(0.0, [1]), (0.3, [0, 2]), (0.3, [3])])
    """
    order = np.arange(k.size) if np.all(k[1:] >= k[:-1]) else np.argsort(k, kind="stable")
    ordered = k[order]
    begins = np.flatnonzero(np.concatenate([[True], ordered[1:] != ordered[:-1]])) if k.size else np.array([], int)
    return Tasks(k, order, np.append(begins, k.size), size)


def run_one_by_one(tasks: Tasks, work: Callable[[float, NDArray[np.int64]], None], workers: int) -> None:
    """Do the work on every task, by some threads that take the next one each; what one of them raises ends all.

    A pool with a future a task would hold all of them: 2 kB each, for what may be one scene.
    """
    workers = min(workers, len(tasks))
    if workers < 2:
        for task in tasks:
            work(*task)
        return
    left, turn, ended = iter(tasks), threading.Lock(), threading.Event()

    def drain(_number: int) -> None:
        while not ended.is_set():
            with turn:
                task = next(left, None)
            if task is None:
                return
            try:
                work(*task)
            except BaseException:
                ended.set()
                raise

    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(drain, range(workers)))
