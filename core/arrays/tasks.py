"""Tasks of one gradient exponent each, and the threads that run them: only a few are in memory at a time."""

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Final, Protocol, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.processors import processors

_T = TypeVar("_T")
_Made_co = TypeVar("_Made_co", covariant=True)
_FEW: Final = 2048
"""Exponents that a plain sort orders as soon as any other."""
_LIKE: Final = 32
"""Number of first exponents by which all are judged to differ."""
_PARTS: Final = 2.0**16 - 1.0
"""Parts of [0, 1] that integers of 16 bits resolve: numpy sorts these by counting."""
Task: TypeAlias = tuple[float, NDArray[np.int64]]
"""A gradient exponent, and the indices of curves that have it."""


class Several(Protocol[_Made_co]):
    """A sequence whose items are made on access."""

    def __len__(self) -> int: ...

    def __iter__(self) -> Iterator[_Made_co]: ...


@dataclass(frozen=True)
class Tasks:
    """The tasks of some curves, made on access.

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


def _rises(values: NDArray[np.float64]) -> bool:
    """Report whether values (n,) are sorted; NaN is not."""
    return bool(np.all(values[1:] >= values[:-1]))


def _sorted(k: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the stable order of exponents k, both of shape (n,), by the fastest sort that gives it.

    Where all differ any sort is stable. Where no two of them are in one of `_PARTS`, that of the parts is the order.
    """
    if k.size <= _FEW:
        return np.argsort(k, kind="stable")
    if np.unique(k[:_LIKE]).size == _LIKE:
        order = np.argsort(k)
        if np.all(k[order[1:]] > k[order[:-1]]):
            return order
    parts = (_PARTS * np.fmin(np.fmax(k, 0.0), 1.0)).astype(np.uint16)  # NaN is in the first one
    order = np.argsort(parts, kind="stable")
    return order if _rises(k[order]) else np.argsort(k, kind="stable")


def groups_of(k: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the numbers of curves by their exponents k, of shape (n,), and where each exponent begins, (exponents,).

    Examples
    --------
    >>> order, begins = groups_of(np.array([0.3, 0.0, 0.3]))
    >>> order.tolist(), begins.tolist()
    ([1, 0, 2], [0, 1])
    """
    order = np.arange(k.size) if _rises(k) else _sorted(k)
    ordered = k[order]
    changes = np.ones(k.size, dtype=bool)
    np.not_equal(ordered[1:], ordered[:-1], out=changes[1:])
    return order, np.flatnonzero(changes)


def tasks_of(k: NDArray[np.float64], size: int) -> Tasks:
    """Cut curves into tasks of one exponent each, of at most `size` curves.

    Examples
    --------
    >>> tasks = tasks_of(np.array([0.3, 0.0, 0.3, 0.3]), 2)
    >>> len(tasks), [(exponent, index.tolist()) for exponent, index in tasks]
    (3, [(0.0, [1]), (0.3, [0, 2]), (0.3, [3])])
    """
    order, begins = groups_of(k)
    return Tasks(k, order, np.append(begins, k.size), size)


def run_one_by_one(tasks: Several[_T], work: Callable[[_T], None], threads: int | None) -> None:
    """Do the work on every task, on threads that each take the next one; an exception in one of them ends all.

    A pool with a future a task would hold all of them: 2 kB each, for what may be one scene. Processors, which
    `threads` = None is for, are counted only where there are two tasks: that takes as long as 300 scenes.
    """
    count = len(tasks)
    workers = 1 if count < 2 else min(threads or processors(), count)
    if workers < 2:
        for task in tasks:
            work(task)
        return
    left, turn, ended = iter(tasks), threading.Lock(), threading.Event()

    def drain(_number: int) -> None:
        while not ended.is_set():
            with turn:
                task = next(left, None)
            if task is None:
                return
            try:
                work(task)
            except BaseException:
                ended.set()
                raise

    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(drain, range(workers)))
