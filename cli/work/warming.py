"""All kinds of work compiled ahead, by processes side by side that compile no kernel twice."""

import multiprocessing
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait

from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.kernels import compile_kinds, missing_of
from gradhesion.core import APART, NEEDS, compile_kind, watch_compilation
from gradhesion.core.compiler.linking import LAZY


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
    the same kernel to be kept. `done` gets each kind with the names of the kernels that were compiled for it, or with
    `kept` of those alone whose code is kept by itself.
    """
    left = missing_of(kinds)
    if workers == 1 or len(left) < 2 or not LAZY:  # numba keeps every kernel by itself, and kinds share most of them
        names: list[str] = []
        compile_kinds(kinds, names.append)
        done(", ".join(left), names)
        return
    running: dict[Future[list[str]], str] = {}
    pool = ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))
    try:
        while left or running:
            begun = {*left, *running.values()}
            for kind in [kind for kind in left if not begun & {*NEEDS[kind]}]:
                if any(kind in pair and pair & {*running.values()} for pair in APART):
                    continue
                running[pool.submit(_compile, kind, kept=kept)] = kind
                left.remove(kind)
            finished, _ = wait(running, timeout=0.2, return_when=FIRST_COMPLETED)
            interrupts.check()
            for future in finished:
                done(running.pop(future), future.result())
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _compile(kind: str, *, kept: bool) -> list[str]:
    """Compile the kernels of a kind in a process of its own, and name them."""
    names: list[str] = []
    with watch_compilation(names.append, kept=kept):
        compile_kind(kind)
    return names
