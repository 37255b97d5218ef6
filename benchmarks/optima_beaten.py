"""Optima of one input against dense sweeps: `python -m benchmarks.optima_beaten [PROBLEMS] [SEED]`.

Random problems: the largest or the least force or energy over the wavelength, the amplitude or the radius, at the
default resolution. An optimum is beaten where the best of 40,001 points is better by more than 1e-9 of it; it should
then have the flag `resolution_too_coarse`. The rows count those that are beaten without it, those that are beaten and
have it, and those that have it and are not.
"""

import argparse
import time
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

import gradhesion as gr
from gradhesion.core import solve

Array = NDArray[np.float64]
POINTS: Final = 40_001
CLOSE: Final = 1e-9
RANGES: Final[dict[str, dict[str, Any]]] = {
    "lambda_over_R": {"start": 0.03, "stop": 1.0, "spacing": "log"},
    "A": {"start": 0.002, "stop": 0.1},
    "a_max_over_R": {"start": 0.1, "stop": 1.5},
}
GOALS: Final = [(sense, goal) for goal in ("pull_off_force", "dissipated_energy") for sense in ("maximise", "minimise")]


def drawn(count: int, seed: int) -> dict[str, Array]:
    """Draw scenes, whose searched input is not used."""
    rng = np.random.default_rng(seed)
    return {
        "k": rng.choice([0.0, 0.3, 0.5, 0.8], count),
        "nu": np.full(count, 0.3),
        "modulus": 10.0 ** rng.uniform(1.5, 3.5, count),
        "c0_over_R": 10.0 ** rng.uniform(-3.0, 0.0, count),
        "lambda_over_R": 10.0 ** rng.uniform(-1.5, 0.0, count),
        "A": rng.uniform(0.002, 0.1, count),
        "a_max_over_R": rng.uniform(0.3, 1.5, count),
    }


def found(scenes: dict[str, Array], name: str, sense: str, goal: str) -> tuple[Array, NDArray[np.bool_]]:
    """Return the optima of scenes, and whether they have the flag."""
    fixed = {key: values.tolist() for key, values in scenes.items() if key != name}
    sought = {sense: goal, "over": [name]}
    study = {"kind": "optimum", "layout": "points", "optimum": sought, "parameters": fixed | {name: RANGES[name]}}
    values = gr.run(study, threads=1)
    flags = values["status"].to_numpy()
    return values[f"best_{goal}"].to_numpy(), (flags & gr.FLAGS["resolution_too_coarse"]) != 0


def dense(scenes: dict[str, Array], name: str, sense: str, goal: str) -> Array:
    """Return the best points of dense sweeps."""
    own = RANGES[name]
    spaced = np.geomspace if own.get("spacing") == "log" else np.linspace
    places = spaced(own["start"], own["stop"], POINTS)
    best = np.nanmax if sense == "maximise" else np.nanmin
    swept = np.empty(scenes["k"].size)
    for i in range(swept.size):
        scene = {key: values[i] for key, values in scenes.items()}
        swept[i] = best(solve(scene | {name: places}, [goal], check_contact=False, threads=1)[goal])
    return swept


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.optima_beaten", description=__doc__)
    parser.add_argument("problems", type=int, nargs="?", default=1000)
    parser.add_argument("seed", type=int, nargs="?", default=20_271)
    arguments = parser.parse_args()
    kinds = [(name, *goal) for name in RANGES for goal in GOALS]
    count = -(-arguments.problems // len(kinds))
    print("| input | goal | problems | beaten, no flag | beaten, flag | flag alone | worst | ms |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for number, (name, sense, goal) in enumerate(kinds):
        scenes = drawn(count, arguments.seed + number)
        start = time.process_time()
        ours, flagged = found(scenes, name, sense, goal)
        taken = 1e3 * (time.process_time() - start) / count
        swept = dense(scenes, name, sense, goal)
        loss = (swept - ours) * (1.0 if sense == "maximise" else -1.0) / np.abs(ours)
        beaten = loss > CLOSE
        numbers = [np.sum(beaten & ~flagged), np.sum(beaten & flagged), np.sum(flagged & ~beaten)]
        row = " | ".join(str(one) for one in (count, *numbers, f"{max(0.0, loss.max()):.0e}", f"{taken:.1f}"))
        print(f"| {name} | {sense} {goal} | {row} |", flush=True)


if __name__ == "__main__":
    main()
