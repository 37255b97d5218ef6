"""The long form of the stress suite: `python -m tests.stress.long [--scenes N] [--seed N]`, from the repository's root.

Prints a table: each check on each draw, the scenes that it fails for and the worst excess (at most 1 is right). Ends
with 1 if anything has failed.
"""

import argparse
import sys
import time

import numpy as np

from .checks import CHECKS
from .draw import eventful, hostile

CHUNK = 5000


def check_all(seed: int, size: int) -> int:
    """Run every check on every draw; return the number of failed scenes."""
    failed = 0
    print(f"{'draw':10}{'check':36}{'scenes':>10}{'failed':>8}{'worst':>12}{'s':>8}")
    for draw in (hostile, eventful):
        for check in CHECKS:
            start, wrong, worst, count = time.perf_counter(), 0, 0.0, 0
            examples: list[dict[str, float]] = []
            for chunk in range(0, size, CHUNK):
                scenes = draw(seed + chunk, min(CHUNK, size - chunk))
                excess = check(scenes)
                bad = np.flatnonzero(~(excess <= 1.0))
                wrong, count = wrong + bad.size, count + excess.size
                worst = max(worst, float(np.nan_to_num(excess, nan=np.inf).max(initial=0.0)))
                examples += [{name: float(values[i]) for name, values in scenes.items()} for i in bad[:3]]
            seconds = time.perf_counter() - start
            row = f"{draw.__name__:10}{check.__name__:36}{count:>10}{wrong:>8}{worst:>12.3g}{seconds:>8.1f}"
            print("\n".join([row, *(f"           {example}" for example in examples[:3])]), flush=True)
            failed += wrong
    return failed


def main() -> int:
    """Run the suite."""
    parser = argparse.ArgumentParser(description="The long form of the stress suite.")
    parser.add_argument("--scenes", type=int, default=100_000, help="scenes of each draw and check")
    parser.add_argument("--seed", type=int, default=1000)
    arguments = parser.parse_args()
    failed = check_all(arguments.seed, arguments.scenes)
    print(f"\n{failed} failed" if failed else "\nall hold")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
