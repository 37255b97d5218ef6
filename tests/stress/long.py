"""The long form of the stress suite: `python -m tests.stress.long [--scenes N] [--seed N]`, from the repository's root.

Prints a table: each check on each draw, the scenes that it fails for and the worst excess (at most 1 is right), then the
slowest scenes of all, each timed by itself. Ends with 1 if anything has failed.
"""

import argparse
import sys
import time

import numpy as np

from gradhesion.core import OUTPUTS, solve

from .checks import CHECKS
from .draw import Scenes, eventful, hostile

CHUNK = 5000


def _one(scenes: Scenes, i: int) -> dict[str, float]:
    return {name: float(values[i]) for name, values in scenes.items()}


def check_all(seed: int, size: int) -> int:
    """Run every check on every draw; return the number of failed scenes."""
    failed = 0
    print(f"{'draw':10}{'check':34}{'scenes':>10}{'failed':>8}{'worst':>12}{'s':>8}")
    for draw in (hostile, eventful):
        for check in CHECKS:
            start, wrong, worst, count = time.perf_counter(), 0, 0.0, 0
            examples: list[dict[str, float]] = []
            for chunk in range(0, size, CHUNK):
                scenes = draw(seed + chunk, min(CHUNK, size - chunk))
                excess = check(scenes)
                bad = np.flatnonzero(~(excess <= 1.0))
                wrong += bad.size
                count += excess.size
                worst = max(worst, float(np.nan_to_num(excess, nan=np.inf).max(initial=0.0)))
                examples += [_one(scenes, int(i)) for i in bad[:3]]
            seconds = time.perf_counter() - start
            print(
                f"{draw.__name__:10}{check.__name__:34}{count:>10}{wrong:>8}{worst:>12.3g}{seconds:>8.1f}", flush=True
            )
            for example in examples[:3]:
                print("          ", example)
            failed += wrong
    return failed


def slowest(seed: int, size: int) -> None:
    """Time scenes one by one and print the slowest, with what a call costs that solves a smooth one."""
    smooth = {
        "k": 0.3,
        "nu": 0.3,
        "modulus": 9.0,
        "c0_over_R": 1.0,
        "lambda_over_R": 1.0,
        "A": 0.0,
        "a_max_over_R": 1.0,
    }
    print(f"\n{'draw':10}{'slowest scenes of ' + str(size) + ', each in a call of its own, ms':60}")
    for draw in (hostile, eventful):
        scenes = draw(seed, size)
        times = []
        for i in range(scenes["k"].size):
            scene = _one(scenes, i)
            solve(smooth | {"k": scene["k"], "nu": scene["nu"]}, OUTPUTS, threads=1)  # its table is made
            start = time.perf_counter()
            solve(scene, OUTPUTS, threads=1)
            times.append(time.perf_counter() - start)
        order = np.argsort(times)[::-1]
        for i in order[:3]:
            print(f"{draw.__name__:10}{1e3 * times[i]:>10.3f}  {_one(scenes, int(i))}")
        print(f"{draw.__name__:10}{1e3 * float(np.median(times)):>10.3f}  median")


def main() -> int:
    """Run the suite."""
    parser = argparse.ArgumentParser(description="The long form of the stress suite.")
    parser.add_argument("--scenes", type=int, default=100_000, help="scenes of each draw and check")
    parser.add_argument("--seed", type=int, default=1000)
    arguments = parser.parse_args()
    failed = check_all(arguments.seed, arguments.scenes)
    slowest(arguments.seed, min(arguments.scenes, 5000))
    print(f"\n{failed} failed" if failed else "\nall hold")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
