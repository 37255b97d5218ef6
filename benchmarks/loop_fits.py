"""Do the intervals of fitted loops cover the truth? `python -m benchmarks.loop_fits [LOOPS] [SEED] [--points N]`.

Loops of a wavy ball on a homogeneous solid, drawn at random, with noise of 1 % of the pull-off force and of 0.1 % of
the depth, and both zeros off. Points are on the exact curve, evenly spread along the path, jumps included; chords have
no part in them. Prints how often each 95 % interval holds the truth, which fits end in another minimum, and the time.
"""

import argparse
import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import Any

import numpy as np
from scipy.stats import binom

from benchmarks.clock import table
from tests.core.answers.loops import OTHER, TIMED, fitted

POINTS = 2000
"""Points of a loop."""


def lines(found: list[dict[str, Any]]) -> Iterator[str]:
    """Report coverage, other minima and time."""
    count = len(found)
    few, many = (binom.ppf(q, count, 0.95) / count for q in (0.0005, 0.9995))
    yield f"{count:,} loops; of intervals that hold the truth in 95 %, chance gives {few:.1%} to {many:.1%}"
    yield ""
    yield "| | linear | profile | mean error (sd) | its spread (sd) |"
    yield "| --- | --- | --- | --- | --- |"
    for name in found[0]["true"]:
        held = [np.mean([one[way][name] for one in found]) for way in ("linear", "profile")]
        off = np.array([one["off"][name] for one in found])
        near = off[np.abs(off) < OTHER]
        yield f"| {name} | {held[0]:.1%} | {held[1]:.1%} | {near.mean():+.2f} | {near.std():.2f} |"
    others = [one for one in found if max(map(abs, one["off"].values())) > OTHER]
    yield ""
    yield f"in another minimum: {len(others)} of {count:,}"
    for one in others:
        true = ", ".join(f"{name} = {value:.4g}" for name, value in one["true"].items())
        yield f"- loop {one['number']}, chi square {one['misfit']:.3g} each: {true}"
    timed = np.array([one["seconds"] for one in found[:TIMED]]).T
    for way, seconds in zip(("linear", "profile"), timed, strict=True):
        half, most, longest = np.quantile(seconds, [0.5, 0.95, 1.0])
        yield f"seconds a loop, {way} intervals: median {half:.2f}, 95 % below {most:.2f}, longest {longest:.2f}"


def times_table(loops: int, seed: int = 5) -> str:
    """Return how long fits of drawn loops take, one after the other."""
    fitted(0, seed, POINTS)  # compiles
    seconds = np.array([fitted(number, seed, POINTS)["seconds"] for number in range(loops)]).T
    rows = [
        [f"{way} intervals", *np.quantile(times, [0.5, 1.0]).tolist()]
        for way, times in zip(("linear", "profile"), seconds, strict=True)
    ]
    return table([f"{loops} loops", "median, s", "longest, s"], rows)


def main() -> None:
    """Fit loops and report."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("loops", nargs="?", type=int, default=1000)
    parser.add_argument("seed", nargs="?", type=int, default=2026)
    parser.add_argument("--points", type=int, default=POINTS)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    chosen = parser.parse_args()
    fitted(0, chosen.seed, chosen.points)  # compiles
    one = partial(fitted, seed=chosen.seed, points=chosen.points)
    with ProcessPoolExecutor(chosen.workers) as pool:
        found = list(pool.map(one, range(chosen.loops)))
    for line in lines(found):
        print(line)


if __name__ == "__main__":
    main()
