"""What `gradhesion plan` estimates, and what a run then takes: studies of each kind, with kernels that are compiled."""

import argparse
import statistics
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any, Final

import numpy as np

from benchmarks.clock import table
from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.cli.work import probe
from gradhesion.cli.work.compiling import compile_for
from gradhesion.cli.work.estimate import estimate

BOTH: Final = ["pull_off_force", "dissipated_energy"]
FORCE: Final = ["pull_off_force"]
GRID: Final[dict[str, Any]] = {
    "k": [0.0, 0.3, 0.5, 0.8],
    "nu": 0.3,
    "modulus": 500.0,
    "c0_over_R": 0.01,
    "lambda_over_R": {"start": 0.05, "stop": 1.0, "num": 100, "spacing": "log"},
    "A": {"start": 0.001, "stop": 0.1, "num": 100, "spacing": "log"},
    "a_max_over_R": 1.0,
}
SHORT: Final = {"lambda_over_R": {"start": 1e-5, "stop": 2e-3, "num": 40, "spacing": "log"}}
SMALL: Final = {
    "lambda_over_R": {"start": 0.05, "stop": 1.0, "num": 80, "spacing": "log"},
    "A": {"start": 0.001, "stop": 0.1, "num": 80, "spacing": "log"},
}
MATERIALS: Final = {"modulus": {"start": 10.0, "stop": 1e4, "num": 25, "spacing": "log"}}
RIMS: Final = {"a_max_over_R": {"start": 0.1, "stop": 1.0, "num": 50}}
SERIES: Final = {"profile": {"harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "cos": 0.2}]}}


def points(count: int, seed: int = 1) -> dict[str, Any]:
    """Return random scenes, each with a gradient exponent of its own."""
    rng = np.random.default_rng(seed)
    return {
        "k": rng.uniform(0.0, 0.9, count).tolist(),
        "nu": 0.3,
        "modulus": (10.0 ** rng.uniform(1.0, 4.0, count)).tolist(),
        "c0_over_R": 0.01,
        "lambda_over_R": (10.0 ** rng.uniform(-1.3, 0.0, count)).tolist(),
        "A": (10.0 ** rng.uniform(-3.0, -1.0, count)).tolist(),
        "a_max_over_R": 1.0,
    }


STUDIES: Final[dict[str, dict[str, Any]]] = {
    "force of one cosine": {"outputs": FORCE, "parameters": GRID | MATERIALS},
    "both of one cosine": {"outputs": BOTH, "parameters": GRID | {"c0_over_R": [0.01, 0.1, 1.0]}},
    "both, short waves": {"outputs": BOTH, "parameters": GRID | SHORT},
    "both, 50 edges on a curve": {"outputs": BOTH, "parameters": GRID | RIMS},
    "smooth punches": {
        "outputs": BOTH,
        "parameters": GRID | MATERIALS | {"A": 0.0, "nu": RIMS["a_max_over_R"] | {"start": 0.1, "stop": 0.4}},
    },
    "force, random k": {"outputs": FORCE, "layout": "points", "parameters": points(200_000)},
    "both, random k": {"outputs": BOTH, "layout": "points", "parameters": points(60_000)},
    "all outputs": {
        "outputs": [*BOTH, "loading_jumps", "unloading_jumps", "delta_max", "delta_jump_out", "pull_off_radius"],
        "parameters": GRID | {"c0_over_R": [0.01, 0.1, 1.0]},
    },
    "force, 300 k of a grid": {
        "outputs": FORCE,
        "parameters": GRID | {"k": {"start": 0.0, "stop": 0.95, "num": 300}, "A": 0.02},
    },
    "two waves, force": {"outputs": FORCE, "parameters": GRID | SMALL, **SERIES},
    "two waves": {"outputs": BOTH, "parameters": GRID | SMALL, **SERIES},
    "exponent 1.5": {"outputs": BOTH, "parameters": GRID | SMALL, "profile": {"exponent": 1.5}},
    "load control": {"outputs": BOTH, "parameters": GRID | SMALL, "loading": {"control": "load"}},
}


@contextmanager
def clock_of_processor() -> Iterator[Callable[[], float]]:
    """Have the probe read the clock of its processor: other work on the machine does not count, nor waiting."""
    wall, probe.clock = probe.clock, time.process_time
    try:
        yield time.process_time
    finally:
        probe.clock = wall


def measured(study: Study, repeat: int, *, wall: bool) -> tuple[float, float]:
    """Return the medians of the time foretold and of that taken, in turns: of one processor, or on the wall."""
    with nullcontext(time.perf_counter) if wall else clock_of_processor() as clock:
        return _measured(study, None if wall else 1, repeat, clock)


def _measured(study: Study, threads: int | None, repeat: int, clock: Callable[[], float]) -> tuple[float, float]:
    compile_for(study)
    foretold, taken = [], []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "study.nc"
        for _ in range(repeat):
            foretold.append(estimate(study, Path(folder) / "new.nc", threads).seconds or 0.0)
            start = clock()
            write(study, path, history="", overwrite=True, threads=threads)
            taken.append(clock() - start)
    return statistics.median(foretold), statistics.median(taken)


def plan_table(names: Iterable[str] = STUDIES, repeat: int = 3, *, wall: bool = False) -> str:
    """Return what was foretold and taken, and the quotient of the two."""
    lines = []
    for name in names:
        study = study_from(STUDIES[name])
        foretold, taken = measured(study, repeat, wall=wall)
        lines.append([name, study.scenes, foretold, taken, foretold / taken])
    return table(["study", "scenes", "plan (s)", "run (s)", "plan / run"], lines)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wall", action="store_true", help="Time on the wall, on all processors, not of one.")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("names", nargs="*")
    chosen = parser.parse_args()
    print(plan_table(chosen.names or STUDIES, chosen.repeat, wall=chosen.wall))


if __name__ == "__main__":
    main()
