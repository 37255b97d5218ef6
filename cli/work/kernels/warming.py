"""All kinds of work compiled ahead, by processes side by side that share the work."""

import multiprocessing
from collections import Counter, defaultdict
from collections.abc import Callable, Container, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from typing import Final

from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.kernels.kernels import compile_kinds, missing_of
from gradhesion.core import APART, KERNELS, NEEDS, compile_kind, watch_compilation
from gradhesion.core.compiler.probe import LAZY
from gradhesion.core.kinds import before

_FAMILIES: Final = 2
"""What is for one cosine, and what is for all profiles: of each, one kind with kernels can begin after the tables."""


def warm(
    kinds: Sequence[str],
    workers: int,
    done: Callable[[str, list[str]], None] = lambda *_: None,
    *,
    kept: bool = False,
) -> None:
    """
    Compile the kernels of some kinds of work by several processes.

    A kind is begun when those that it needs are done, and not beside one of `APART`, so that no two processes compile
    the same kernel to be kept. Tables are the exception: all kinds need them, and what they are made of, so that the
    processes of both families compile them, and keep the same under the same names. `done` gets each kind, once, when
    no process is at it any more, with the names of the kernels that were compiled for it, or with `kept` of those alone
    whose code is kept by itself. What one process has kept, another reads: a kernel is compiled by any of them.
    """
    left = missing_of(kinds)
    if workers == 1 or len(left) < 2 or not LAZY:  # numba keeps every kernel by itself, and kinds share most of them
        names: list[str] = []
        compile_kinds(kinds, names.append, alone=workers == 1)
        done(", ".join(left), names)
        return
    processes, named = [_Worker() for _ in range(workers)], defaultdict[str, Counter[str]](Counter)
    try:
        if "tables" in left:
            left.remove("tables")
            for worker in processes[: min(_FAMILIES, len(left))]:
                worker.begin("tables", kept=kept)
        while left or any(worker.kind for worker in processes):
            for worker in processes:
                running = [one.kind for one in processes if one.kind]
                if not worker.kind and (kind := next_kind(left, running, worker.behind)):
                    worker.begin(kind, kept=kept)
                    left.remove(kind)
            wait([worker.future for worker in processes if worker.kind], timeout=0.2, return_when=FIRST_COMPLETED)
            interrupts.check()
            for worker in processes:
                if worker.kind and worker.future.done():
                    kind, names = worker.end()
                    named[kind] |= Counter(names)
                    if all(other.kind != kind for other in processes):
                        done(kind, [*named[kind].elements()])
    finally:
        for worker in processes:
            worker.pool.shutdown(wait=not worker.kind, cancel_futures=True)  # Python's own end may meet theirs


def next_kind(left: Sequence[str], running: Sequence[str], behind: Container[str]) -> str:
    """
    Choose what a process compiles next: of what may be begun, that of which most is behind it; "" if nothing may be.

    Of several such kinds it is the one for which most others wait, then the longest. So one process compiles what is
    for one cosine, and another what is for all profiles, and what kinds share is hardly compiled by both.

    >>> next_kind(["energy", "general_energy", "general_force"], ["energy"], {"tables"})
    'general_energy'
    >>> next_kind(["reports", "general_reports"], [], {"tables", "general_energy"})
    'general_reports'
    """
    begun = {*left, *running}
    ready = [
        kind
        for kind in left
        if not begun & {*NEEDS[kind]} and not any(kind in pair and pair & {*running} for pair in APART)
    ]

    def worth(kind: str) -> tuple[int, int, int]:
        shared = sum(KERNELS[one] for one in before(kind) if one in behind)
        return shared, sum(KERNELS[one] for one in left if kind in before(one)), KERNELS[kind]

    return max(ready, key=worth, default="")


class _Worker:
    """A process that compiles one kind after the other."""

    def __init__(self) -> None:
        self.pool = ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn"))
        self.kind = ""
        self.behind: set[str] = set()
        self.future: Future[list[str]]

    def begin(self, kind: str, *, kept: bool) -> None:
        """Have a kind compiled."""
        self.kind, self.future = kind, self.pool.submit(_compile, kind, kept=kept)

    def end(self) -> tuple[str, list[str]]:
        """Give the kind that is compiled, with the names of its kernels."""
        kind, self.kind = self.kind, ""
        self.behind.add(kind)
        return kind, self.future.result()


def _compile(kind: str, *, kept: bool) -> list[str]:
    """Compile the kernels of a kind in a process of its own, and name them."""
    names: list[str] = []
    with watch_compilation(names.append, kept=kept):
        compile_kind(kind)
    return names
