"""One scene in a call of Python: what a dataset costs beside its solution."""

import argparse
import time
from collections.abc import Callable
from typing import Any

import gradhesion as gr
from benchmarks.clock import table
from gradhesion import core

SCENE = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 1.0}


def calls_table(repeat: int = 300) -> str:
    """Return the least processor times of both calls, in turns, and their ratio."""
    calls: dict[str, Callable[[], Any]] = {
        "gradhesion.core.solve": lambda: core.solve(SCENE),
        "gradhesion.solve": lambda: gr.solve(SCENE),
    }
    least = dict.fromkeys(calls, float("inf"))
    for _ in range(repeat):
        for name, call in calls.items():
            start = time.process_time()
            call()
            least[name] = min(least[name], time.process_time() - start)
    plain, whole = least.values()
    rows: list[list[object]] = [[f"`{name}`", 1e3 * seconds] for name, seconds in least.items()]
    return table(["call", "ms"], [*rows, ["ratio", whole / plain]])


def main() -> None:
    """Print the table."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(calls_table())


if __name__ == "__main__":
    main()
