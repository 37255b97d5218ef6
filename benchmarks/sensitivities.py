"""What sensitivities cost beside the values: `python -m benchmarks.sensitivities [--scenes N]`.

Processor time of one thread, the least of several samples, values and sensitivities in turn.
"""

import argparse
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import table
from gradhesion.core import SENSITIVITIES, Harmonic, Loading, Profile, solve

VALUES = ("pull_off_force", "dissipated_energy")
TASKS = (VALUES[:1], VALUES)
PAIR = Profile(harmonics=(Harmonic(n=1, sin=0.3, cos=1.0), Harmonic(n=3, cos=0.2, sin=-0.1)))
MANY = Profile(harmonics=tuple(Harmonic(n=n, cos=1.0 / n) for n in range(1, 25)))
CASES: dict[str, tuple[int, dict[str, Any]]] = {
    "one cosine": (10, {}),
    "one cosine, load control": (2, {"loading": Loading(control="load")}),
    "one cosine, by a machine": (2, {"loading": Loading(control="machine")}),
    "series of two": (1, {"profile": PAIR}),
    "series of 24": (1, {"profile": MANY}),
    "cone": (1, {"profile": Profile(exponent=1.3)}),
}
"""Times as many scenes, and the settings."""


def drawn(count: int, *, machine: bool) -> dict[str, Any]:
    """Draw scenes of one exponent."""
    rng = np.random.default_rng(0)
    scenes: dict[str, Any] = {
        "k": 0.37,
        "nu": 0.3,
        "modulus": 10 ** rng.uniform(1.5, 3.5, count),
        "c0_over_R": 0.01,
        "lambda_over_R": 10 ** rng.uniform(-2, 0, count),
        "A": 10 ** rng.uniform(-3, -1, count),
        "a_max_over_R": 10 ** rng.uniform(-1.5, 0.3, count),
    }
    return scenes | ({"machine_stiffness": 10 ** rng.uniform(-1, 2, count)} if machine else {})


def costs(count: int, settings: dict[str, Any], samples: int = 7) -> NDArray[np.float64]:
    """Return the seconds of force, and of both values; without and with their sensitivities."""
    scenes = drawn(count, machine=settings.get("loading") == Loading(control="machine"))
    best = np.full((2, 2), np.inf)
    for _ in range(samples + 1):  # the first one compiles
        for i, values in enumerate(TASKS):
            for j, outputs in enumerate((values, (*values, *SENSITIVITIES[: len(values)]))):
                start = time.thread_time()
                solve(scenes, outputs, threads=1, **settings)
                best[i, j] = min(best[i, j], time.thread_time() - start)
    return best


def costs_table(count: int) -> str:
    """Return what sensitivities to all parameters cost, over what the values cost."""
    rows = []
    for name, (times, settings) in CASES.items():
        best = costs(times * count, settings)
        more = best[:, 1] / best[:, 0] - 1.0
        rows.append([name, *(1e6 * best[:, 0] / (times * count)), *more])
    header = ["", "force, us", "force and energy, us", "sensitivities of the force: more", "of both: more"]
    return table(header, rows)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="What sensitivities cost beside the values.")
    parser.add_argument("--scenes", type=int, default=1000, help="of a series; others have more (default: 1000)")
    print(costs_table(parser.parse_args().scenes))


if __name__ == "__main__":
    main()
