"""What closing at less work costs over one cycle, and what a study without it pays: `python -m benchmarks.works`.

Grids of scenes, all in turns: the least processor time of each, and their ratios. Values at ratio 1 are those without
the key, which are solved as if there were none.
"""

import argparse
import time
from typing import Any

import numpy as np

from benchmarks.clock import table
from gradhesion.core import Harmonic, Loading, Profile, solve

OUTPUTS = ("pull_off_force", "dissipated_energy")
GRID: dict[str, Any] = {
    "k": 0.3,
    "nu": 0.3,
    "modulus": np.geomspace(50.0, 5000.0, 40)[:, None, None],
    "c0_over_R": 0.01,
    "lambda_over_R": np.geomspace(0.05, 0.5, 40)[:, None],
    "A": 0.02,
}
CASES: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "rims": ({"a_max_over_R": np.linspace(0.2, 0.8, 12)}, {}),
    "turned at a depth": ({"a_max_over_R": np.inf, "indentation_max_over_R": np.linspace(0.01, 0.1, 12)}, {}),
    "under a load": ({"a_max_over_R": np.linspace(0.2, 0.8, 12)}, {"loading": Loading(control="load")}),
    "two harmonics": (
        {"a_max_over_R": np.linspace(0.2, 0.8, 4)},
        {"profile": Profile(harmonics=(Harmonic(n=1), Harmonic(n=3, sin=0.1)))},
    ),
}


def works_table(repeat: int = 5) -> str:
    """Return the times of the cases, without a ratio, at ratio 0.5, and at five ratios over five times that."""
    rows: list[list[object]] = []
    for name, (more, how) in CASES.items():
        scenes = GRID | more
        ratios = np.array([0.2, 0.4, 0.6, 0.8, 1.0])
        five = {key: np.asarray(value)[..., None] for key, value in scenes.items()} | {"closing_ratio": ratios}
        calls = {"plain": scenes, "ratio": scenes | {"closing_ratio": 0.5}, "five": five}
        least = dict.fromkeys(calls, float("inf"))
        for _ in range(repeat):
            for call, parameters in calls.items():
                start = time.process_time()
                size = solve(parameters, OUTPUTS, threads=1, **how)["status"].size
                least[call] = min(least[call], (time.process_time() - start) / size)
        each = [1e6 * seconds for seconds in least.values()]
        rows.append([name, *each, each[1] / each[0], each[2] / each[0]])
    return table(["case", "us a cycle", "us at ratio 0.5", "us at five ratios", "ratio", "five"], rows)


def main() -> None:
    """Print the table."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(works_table())


if __name__ == "__main__":
    main()
