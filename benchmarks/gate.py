"""The gate of a refactoring: outputs of 45,000 scenes, kept from one state of the sources and compared with another.

    python -m benchmarks.gate freeze ../before.npz       in the state before, kept outside the repository
    python -m benchmarks.gate compare ../before.npz      in the state after, on the same machine

For each class of scenes the comparison prints how many values have other bits, the largest relative difference of any,
and the processor time of a scene in both states. Times are only worth comparing when both commands ran within minutes
on a quiet machine. It ends with 1 where a value differs.
"""

import argparse
import math
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import table
from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, solve

Arrays = dict[str, NDArray[Any]]
PAIR = Profile(exponent=2.5, harmonics=(Harmonic(n=1), Harmonic(n=2, cos=0.4, sin=0.3)))
LOAD, MACHINE = Loading(control="load"), Loading(control="machine")
FORCE = ("pull_off_force",)


def scenes(seed: int, number: int, waves: tuple[float, float] = (1.0, 60.0)) -> Arrays:
    """Draw scenes with a_max/lambda in a range of decades; a tenth of the punches is unbounded."""
    rng = np.random.default_rng([2013, seed])
    rim = rng.uniform(0.05, 2.0, number)
    drawn = {
        "k": rng.choice(rng.uniform(0.0, 0.95, 12), number),
        "nu": rng.uniform(-0.3, 0.5, number),
        "modulus": 10.0 ** rng.uniform(1.5, 4.0, number),
        "c0_over_R": 10.0 ** rng.uniform(-3.0, 0.0, number),
        "lambda_over_R": rim / np.exp(rng.uniform(math.log(waves[0]), math.log(waves[1]), number)),
        "A": 10.0 ** rng.uniform(-4.0, -1.0, number),
    }
    return drawn | {"a_max_over_R": np.where(rng.random(number) < 0.1, np.inf, rim)}


def many_rims(seed: int, curves: int, rims: int, waves: tuple[float, float]) -> Arrays:
    """Draw curves that have many rims each."""
    drawn = {name: values[:, None] for name, values in scenes(seed, curves, waves).items()}
    return drawn | {"a_max_over_R": np.linspace(0.02, 1.5, rims)[None, :]}


def classes() -> Iterator[tuple[str, Arrays, tuple[str, ...], dict[str, Any]]]:
    """Yield the name of each class, its scenes, the outputs, and how they are solved."""
    yield "force", scenes(1, 12_000), FORCE, {}
    yield "cycle", scenes(2, 6_000), OUTPUTS, {}
    yield "short waves", scenes(3, 2_000, (60.0, 3_000.0)), OUTPUTS, {}
    yield "long curves", scenes(4, 400, (3e3, 1e6)), OUTPUTS, {}
    yield "many rims", many_rims(5, 40, 150, (1.0, 1e3)), OUTPUTS, {}
    yield "smooth", scenes(6, 8_000) | {"A": np.zeros(8_000)}, OUTPUTS, {}
    yield "load", scenes(7, 800), OUTPUTS, {"loading": LOAD}
    springs = {"machine_stiffness": 10.0 ** np.random.default_rng(8).uniform(-3.0, 1.0, 800)}
    yield "machine", scenes(8, 800) | springs, OUTPUTS, {"loading": MACHINE}
    yield "series", scenes(9, 400), OUTPUTS, {"profile": PAIR}
    yield "series, long", scenes(10, 60, (1e3, 1e5)), OUTPUTS, {"profile": PAIR}
    yield "series, force", scenes(11, 2_000), FORCE, {"profile": PAIR}
    turns = {"indentation_max_over_R": np.random.default_rng(12).uniform(0.01, 0.3, 2_000)}
    yield "turned", scenes(12, 2_000) | turns, OUTPUTS, {}
    preloads = {"load_max": np.random.default_rng(13).uniform(0.1, 3.0, 2_000)}
    yield "turned by load", scenes(13, 2_000) | preloads, OUTPUTS, {}
    yield "exponents", scenes(14, 3_000) | {"k": np.random.default_rng(14).uniform(0.0, 1.0, 3_000)}, OUTPUTS, {}
    slopes = ("pull_off_force_sensitivity", "dissipated_energy_sensitivity")
    yield "sensitivities", scenes(15, 500), slopes, {}
    yield "envelope", scenes(16, 2_000), OUTPUTS, {"solver": "envelope"}


def timed(work: Callable[[], Arrays], repeat: int) -> tuple[Arrays, float]:
    """Return what `work` returns, and its least processor time of some."""
    found, best = work(), float("inf")
    for _ in range(repeat):
        start = time.process_time()
        found = work()
        best = min(best, time.process_time() - start)
    return found, best


def measured(repeat: int, only: str | None = None) -> Arrays:
    """Return all values by `class/output`, and the microseconds of a scene by `time/class`."""
    values: Arrays = {}
    for name, drawn, outputs, how in classes():
        if only in (None, name):
            found, seconds = timed(partial(solve, drawn, outputs, threads=1, **how), repeat)
            values |= {f"{name}/{output}": array for output, array in found.items()}
            values[f"time/{name}"] = np.array(1e6 * seconds / found["status"].size)
    return values


def compared(before: Arrays, after: Arrays) -> tuple[str, int]:
    """Return a table with a row for each class, and how many values differ."""
    rows, differing = [], 0
    for key in (key for key in after if key.startswith("time/")):
        name = key.removeprefix("time/")
        outputs = [output for output in after if output.startswith(f"{name}/")]
        count, largest = 0, 0.0
        for output in outputs:
            old, new = before[output].astype(float), after[output].astype(float)
            other = ~((old == new) | (np.isnan(old) & np.isnan(new)))
            count += int(np.count_nonzero(other))
            if other.any():
                with np.errstate(all="ignore"):
                    apart = np.abs(new - old)[other] / np.abs(old)[other]
                largest = max(largest, float(np.max(np.where(np.isnan(apart), np.inf, apart))))
        old_time, new_time = float(before[key]), float(after[key])
        rows.append([name, sum(after[output].size for output in outputs), count, largest, old_time, new_time])
        differing += count
    header = ["class", "values", "other bits", "largest, relative", "us before", "us after"]
    return table(header, rows), differing


def main() -> None:
    """Keep the values of this state, or compare it with what was kept."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.gate", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("do", choices=["freeze", "compare"])
    parser.add_argument("file", type=Path)
    parser.add_argument("--repeat", type=int, default=3, help="samples of each time [3]")
    parser.add_argument("--only", help="one class alone")
    arguments = parser.parse_args()
    values = measured(arguments.repeat, arguments.only)
    if arguments.do == "freeze":
        np.savez_compressed(arguments.file, **values)  # type: ignore[arg-type] # names are not those of its flags
        return
    with np.load(arguments.file) as kept:
        text, differing = compared(dict(kept), values)
    print(text)
    raise SystemExit(1 if differing else 0)


if __name__ == "__main__":
    main()
