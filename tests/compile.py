"""Compile the kernels that tests need, each once: processes that run tests side by side would compile them twice.

`python -m tests.compile` does so in two processes; `python -m tests.compile KIND ...` compiles some kinds in this one.
"""

import argparse
import subprocess
import sys
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import combinations

from gradhesion.core import KINDS, NEEDS, compile_kind, watch_compilation


def compile_all(processes: int) -> None:
    """Compile all kinds, each in a process of its own and after those whose kernels it shares."""
    waiting, done = dict(NEEDS), dict[str, set[str]]()
    under_way: dict[Future[set[str]], str] = {}
    with ThreadPoolExecutor(processes) as pool:
        while waiting or under_way:
            ready = [kind for kind, needs in waiting.items() if done.keys() >= set(needs)]
            for kind in ready[: processes - len(under_way)]:
                del waiting[kind]
                under_way[pool.submit(_in_a_process, kind)] = kind
            for future in wait(under_way, return_when=FIRST_COMPLETED).done:
                done[under_way.pop(future)] = future.result()
    for one, other in combinations(KINDS, 2):
        twice = done[one] & done[other] if one not in _before(other) else set()
        assert not twice, f"{one} and {other} may run side by side, and both compile {sorted(twice)}"


def _before(kind: str) -> set[str]:
    """All kinds that are compiled before a kind."""
    return {*NEEDS[kind]}.union(*map(_before, NEEDS[kind]))


def _in_a_process(kind: str) -> set[str]:
    command = [sys.executable, "-m", "tests.compile", kind]
    return {*subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()}


def main() -> None:
    """Compile some kinds, or all."""
    parser = argparse.ArgumentParser(prog="python -m tests.compile", description=__doc__)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"out of {', '.join(KINDS)} [all]")
    parser.add_argument("--processes", type=int, default=2, help="side by side [%(default)s]")
    asked = parser.parse_args()
    with watch_compilation(lambda name: print(name, flush=True)):
        for kind in asked.kinds:
            compile_kind(kind)
    if not asked.kinds:
        compile_all(asked.processes)


if __name__ == "__main__":
    main()
