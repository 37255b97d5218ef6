"""Optima against SciPy's differential evolution on the same function: `python -m benchmarks.optima [PROBLEMS] [SEED]`.

Both get the same random problems: the largest force, or energy, over the wavelength, or over wavelength and amplitude.
Differential evolution is vectorised, with its default settings and its polish, from a fixed seed.
"""

import argparse
import time
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import differential_evolution

import gradhesion as gr
from gradhesion.core import solve

WAVES = (0.05, 1.0)
HEIGHTS = (0.002, 0.1)
REPEATS = 3


def problem(rng: np.random.Generator) -> dict[str, float]:
    """Draw what is not searched."""
    return {
        "k": float(rng.choice([0.0, 0.3, 0.5, 0.8])),
        "nu": 0.3,
        "modulus": 10.0 ** rng.uniform(1.5, 3.5),
        "c0_over_R": 10.0 ** rng.uniform(-3.0, 0.0),
        "A": rng.uniform(*HEIGHTS),
        "a_max_over_R": rng.uniform(0.3, 1.5),
    }


def study_of(scenes: Sequence[dict[str, float]], goal: str, inputs: int) -> Any:
    """Ask for the optima of scenes, as points."""
    searched: dict[str, Any] = {"lambda_over_R": {"start": WAVES[0], "stop": WAVES[1], "spacing": "log"}}
    searched |= {"A": {"start": HEIGHTS[0], "stop": HEIGHTS[1]}} if inputs == 2 else {}
    lists = {name: [scene[name] for scene in scenes] for name in scenes[0] if name not in searched}
    sought = {"maximise": goal, "over": [*searched], "resolution": searched_resolution(inputs)}
    return gr.load({"kind": "optimum", "layout": "points", "optimum": sought, "parameters": lists | searched})


def searched_resolution(inputs: int) -> int:
    """Choose the points of a sweep along each input."""
    return 200 if inputs == 1 else 40


def evolved(scene: dict[str, float], goal: str, inputs: int) -> tuple[float, int]:
    """Find the same by differential evolution; the best value, and how many scenes that took."""
    count = 0

    def height(places: NDArray[np.float64]) -> NDArray[np.float64]:
        nonlocal count
        waves = np.exp(places[0])
        count += waves.size
        own = {"lambda_over_R": waves} | ({"A": places[1]} if inputs == 2 else {})
        return -solve(scene | own, [goal], check_contact=False)[goal]

    bounds = [(np.log(WAVES[0]), np.log(WAVES[1])), HEIGHTS][:inputs]
    found = differential_evolution(height, bounds, vectorized=True, updating="deferred", rng=1)
    return -float(found.fun), count


def compared(goal: str, inputs: int, problems: int, seed: int) -> str:
    """Write a row: the least times of several rounds, in turn, and who has found the better optimum."""
    rng = np.random.default_rng(seed)
    drawn = [problem(rng) for _ in range(problems)]
    requested = [study_of([scene], goal, inputs) for scene in drawn]
    times, ours, theirs = np.full((2, problems), np.inf), np.empty(problems), np.empty(problems)
    whole, mapped = study_of(drawn, goal, inputs), np.inf
    gr.run(requested[0], threads=1)
    for _ in range(REPEATS):
        for i, (scene, study) in enumerate(zip(drawn, requested, strict=True)):
            start = time.perf_counter()
            ours[i] = gr.run(study, threads=1)[f"best_{goal}"].item()
            middle = time.perf_counter()
            theirs[i], _ = evolved(scene, goal, inputs)
            times[:, i] = np.minimum(times[:, i], (middle - start, time.perf_counter() - middle))
        start = time.perf_counter()
        gr.run(whole, threads=1)
        mapped = min(mapped, (time.perf_counter() - start) / problems)
    size = np.abs(ours)
    lost, won = (theirs - ours > 1e-9 * size).sum(), (ours - theirs > 1e-9 * size).sum()
    ratio = np.median(times[1] / times[0])
    alone, evolution = 1e3 * np.median(times, axis=1)
    numbers = f"{1e3 * mapped:.1f} | {alone:.0f} | {evolution:.0f} | {ratio:.1f} | {won} | {lost} | {problems}"
    return f"| {goal} | {inputs} | {numbers} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.optima", description=__doc__)
    parser.add_argument("problems", type=int, nargs="?", default=20)
    parser.add_argument("seed", type=int, nargs="?", default=3)
    arguments = parser.parse_args()
    print("| goal | inputs | in a map, ms | alone, ms | evolution, ms | ratio | better | worse | problems |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for inputs in (1, 2):
        for goal in ("pull_off_force", "dissipated_energy"):
            print(compared(goal, inputs, arguments.problems, arguments.seed), flush=True)


if __name__ == "__main__":
    main()
