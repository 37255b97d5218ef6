"""Run time against error: the three solvers and a dense grid on the same scenes, whose truth has 30 digits."""

import json
import math
import statistics
from functools import partial
from typing import Any

import matplotlib as mpl
import numpy as np

from benchmarks.clock import BOTH, FIGURES, FORCE, ROOT, microseconds, seconds_of, table
from benchmarks.dense_grid import solve_on_grid
from gradhesion.core import PARAMETERS, SOLVERS, solve

mpl.use("Agg")
from matplotlib import pyplot as plt

TARGETS = {"pull_off_force": 1e-7, "dissipated_energy": 1e-4}
SIZES = (100, 300, 1000, 3000, 10_000, 30_000, 100_000)
COPIES = 2000
LEAST = 1e-17
"""Where an error of zero is drawn."""
Point = tuple[str, float, dict[str, tuple[float, float]]]
"""Name, seconds a scene, and of each output the errors that a half and nine tenths of the scenes keep."""


def scenes_of_twin(number: int) -> list[dict[str, Any]]:
    """Return scenes of tests/twin with a few jumps and a finite rim, spread over its list."""
    stored = json.loads((ROOT / "tests" / "twin" / "scenes.json").read_text())
    scenes = [dict(zip(stored["columns"], row, strict=True)) for row in stored["scenes"]]
    wavy = [scene for scene in scenes if scene["group"] == "random" and scene["k"] < 1 and scene["unloading_jumps"] > 2]
    return wavy[:: len(wavy) // number][:number]


def errors(scenes: list[dict[str, Any]], values: dict[str, Any]) -> dict[str, tuple[float, float]]:
    """Return the relative errors that a half and nine tenths of the scenes keep."""
    kept = {}
    for name in BOTH:
        truth = np.array([scene[name] for scene in scenes])
        error = np.maximum(np.abs(np.asarray(values[name]) / truth - 1), LEAST)
        kept[name] = (float(np.median(error)), float(np.quantile(error, 0.9)))
    return kept


def of_solver(scenes: list[dict[str, Any]], solver: str, outputs: tuple[str, ...]) -> Point:
    """Time a solver on many copies of the scenes, shuffled, each solved for itself, on one thread."""
    order = np.random.default_rng(5).permutation(np.repeat(np.arange(len(scenes)), COPIES))
    parameters = {name: np.array([scene[name] for scene in scenes]) for name in PARAMETERS}
    copies = {name: values[order] for name, values in parameters.items()}
    seconds = 1e-6 * microseconds(copies, outputs, repeat=5, solver=solver)
    return solver, seconds, errors(scenes, solve(parameters, BOTH, solver=solver))


def of_grid(scenes: list[dict[str, Any]], points: int) -> Point:
    """Time the dense grid, scene by scene."""
    times = [seconds_of(partial(solve_on_grid, scene, points), repeat=1) for scene in scenes]
    values = np.array([solve_on_grid(scene, points) for scene in scenes])
    return f"grid of {points:,}", statistics.mean(times), errors(scenes, dict(zip(BOTH, values.T, strict=True)))


def time_at(grids: list[Point], output: str, target: float, kept_by: int) -> float:
    """Return the time that the grid needs for an error (straight between two sizes in logarithms; NaN beyond them)."""
    error = np.array([kept[output][kept_by] for _, _, kept in grids])
    seconds = np.array([seconds for _, seconds, _ in grids])
    if error.min() > target:
        return math.nan
    i = int(np.flatnonzero(error <= target)[0])
    if i == 0:
        return float(seconds[0])
    share = math.log(target / error[i - 1]) / math.log(error[i] / error[i - 1])
    return float(seconds[i - 1] * (seconds[i] / seconds[i - 1]) ** share)


def picture(forces: list[Point], both: list[Point], grids: list[Point]) -> None:
    """Draw run time against error, one panel an output; the bars reach to the error that nine tenths keep."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained", sharey=True)
    marks: dict[str, str] = dict(zip(SOLVERS, "os^", strict=True))
    for axis, name, points in zip(axes, BOTH, (forces, both), strict=True):
        for solver, seconds, kept in points:
            half, most = kept[name]
            axis.errorbar(
                half, seconds, xerr=[[0], [max(0.0, most - half)]], fmt=marks[solver], capsize=3, label=solver
            )
        half, most = np.array([kept[name] for _, _, kept in grids]).T
        times = np.array([seconds for _, seconds, _ in grids])
        axis.errorbar(half, times, xerr=[0 * half, np.maximum(0, most - half)], fmt=".-", capsize=2, label="dense grid")
        words = name.replace("pull_off", "pull-off").replace("_", " ")
        axis.set(xscale="log", yscale="log", xlabel=f"relative error, {words}", ylim=(1e-7, 10))
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("seconds a scene")
    axes[0].legend()
    FIGURES.mkdir(parents=True, exist_ok=True)
    figure.savefig(FIGURES / "time_against_error.png", dpi=110)


def measure(number: int, sizes: tuple[int, ...]) -> tuple[list[Point], list[Point], list[Point]]:
    """Return the points of the solvers for the force, for both outputs, and those of the grid."""
    scenes = scenes_of_twin(number)
    forces = [of_solver(scenes, solver, FORCE) for solver in SOLVERS]
    both = [of_solver(scenes, solver, BOTH) for solver in SOLVERS]
    return forces, both, [of_grid(scenes, points) for points in sizes]


def tables(forces: list[Point], both: list[Point], grids: list[Point]) -> str:
    """Return times and errors, and the speed ratios at equal error."""
    lines = [
        [name, 1e6 * force_seconds, 1e6 * seconds, *(f"{error:.1e}" for output in BOTH for error in kept[output])]
        for (name, force_seconds, _), (_, seconds, kept) in zip([*forces, *grids], [*both, *grids], strict=True)
    ]
    header = ["", "force, us", "both, us", "force: median error", "90 %", "energy: median error", "90 %"]
    ratios = []
    for output, (_, seconds, _) in zip(BOTH, (forces[0], both[0]), strict=True):
        times = [time_at(grids, output, TARGETS[output], kept_by) for kept_by in (0, 1)]
        ratios.append([output, f"{TARGETS[output]:g}", *times, *(time / seconds for time in times)])
    ratio_header = ["output", "error", "grid, s: median", "90 %", "grid/exact: median", "90 %"]
    return table(header, lines) + "\n" + table(ratio_header, ratios)
