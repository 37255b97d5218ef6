"""Waves that the solver sums against the same waves walked one by one: python -m benchmarks.walked.

Prints for each class of scenes, and number of waves up to the rim, the largest difference of the force over itself and
of the energies over those of loading and unloading, the most jumps, and how many counts differ.
"""

import argparse
import math
from contextlib import ExitStack
from typing import Any, Final
from unittest.mock import patch

import numpy as np

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scenes import long, tables, tasks

TWO: Final = Profile(exponent=3.0, harmonics=(Harmonic(n=1, cos=1.0), Harmonic(n=3, cos=0.2, sin=0.3)))
CLASSES: Final[dict[str, dict[str, Any]]] = {
    "one cosine": {},
    "exponent 3, two harmonics": {"profile": TWO},
    "load": {"loading": Loading(control="load")},
    "machine": {"loading": Loading(control="machine")},
}
RANGES: Final = ((700.0, 4e3, 60), (4e3, 1.4e4, 20), (5e4, 1e5, 4))
"""Waves, from and to, and scenes of each class. Walking 100,000 waves of one cosine takes half a GB."""
ENERGIES: Final = ("dissipated_energy", "loading_energy", "unloading_energy")
COUNTS: Final = ("loading_jumps", "unloading_jumps")
WALKED: Final = (
    (long, "_WALKED", 10**6),
    (long, "_WALKED_BINS", 10**7),
    (tasks, "MOST_BINS", 3_000_000),
    (tables, "_KEPT_BINS", 10),
)
"""Limits of core/scenes with which nothing is summed."""


def draw(rng: np.random.Generator, size: int, low: float, high: float) -> dict[str, Any]:
    """Draw scenes with a rim and chi from 0.1 to 3, of that many waves up to the rim."""

    def log(start: float, stop: float) -> Any:
        return np.exp(rng.uniform(math.log(start), math.log(stop), size))

    k = rng.choice([0.0, 0.3, 0.62, 0.9, 1.0], size)
    scenes = {"k": k, "nu": np.where(k == 1.0, 0.5, 0.3), "modulus": log(10.0, 1e4), "c0_over_R": log(0.01, 1.0)}
    rim, half = log(0.1, 3.0), 0.5 * (1.0 + k)
    wavelength = rim / log(low, high)
    stretch = np.sqrt(2.0 ** (1.0 + k) * np.pi / stiffness(*scenes.values()))
    size_of_waves = np.pi ** (1.0 - half) * np.array([math.gamma(h) for h in half]) * wavelength**half
    return {**scenes, "lambda_over_R": wavelength, "A": log(0.1, 3.0) * stretch / size_of_waves, "a_max_over_R": rim}


def compare(scenes: dict[str, Any], how: dict[str, Any]) -> str:
    """Solve scenes both ways, and tell how far apart they are."""
    outputs = ("pull_off_force", *ENERGIES, *COUNTS)
    summed = solve(scenes, outputs, threads=1, **how)
    with ExitStack() as walking:
        for module, name, limit in WALKED:
            walking.enter_context(patch.object(module, name, limit))
        walked = solve(scenes, outputs, threads=1, **how)
    sure = ((summed["status"] | walked["status"]) & NO_VALUE) == 0
    size = np.abs(walked["loading_energy"]) + np.abs(walked["unloading_energy"])
    energy = max(float((np.abs(summed[name] - walked[name]) / size)[sure].max()) for name in ENERGIES)
    force = float(np.abs(summed["pull_off_force"] / walked["pull_off_force"] - 1.0)[sure].max())
    jumps = max(int(walked[name][sure].max()) for name in COUNTS)
    other = sum(int((summed[name] != walked[name])[sure].sum()) for name in COUNTS)
    return f"{sure.sum()} | {jumps:,} | {force:.1e} | {energy:.1e} | {other}"


def main() -> None:
    """Compare all classes, and print a table."""
    parser = argparse.ArgumentParser(description="Sums over waves against walks.")
    parser.add_argument("--seed", type=int, default=7)
    rng = np.random.default_rng(parser.parse_args().seed)
    print("|  | waves | scenes | jumps, at most | force | energies | other counts |\n" + "| --- " * 7 + "|")
    for low, high, size in RANGES:
        for name, how in CLASSES.items():
            if high * (3 if how.get("profile") == TWO else 1) > 1e5:
                continue
            scenes = draw(rng, size, low, high)
            if name == "machine":
                scenes["machine_stiffness"] = 10.0 ** rng.uniform(-2.0, 1.0, size)
            print(f"| {name} | {low:,.0f} to {high:,.0f} | {compare(scenes, how)} |", flush=True)


if __name__ == "__main__":
    main()
