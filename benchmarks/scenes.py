"""The cost of scenes: mixtures, smooth ones, many waves, many rims."""

from typing import Any

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import BOTH, FIGURES, FORCE, microseconds, table
from benchmarks.draw import mixture, waves
from gradhesion.core import solve

mpl.use("Agg")
from matplotlib import pyplot as plt


def mixture_table(number: int = 1_000_000) -> str:
    """Return the time of a scene of the mixtures, and of smooth scenes."""
    lines = []
    for name, spacing in [("log-uniform lambda/L", "log"), ("uniform lambda/L", "linear")]:
        scenes = mixture(number, spacing)
        lines.append([name, microseconds(scenes, FORCE), microseconds(scenes)])
    smooth: dict[str, Any] = {**mixture(number, "log"), "A": 0.0}
    lines.append(["smooth, all materials different", microseconds(smooth, FORCE), microseconds(smooth)])
    smooth |= {"k": 0.3, "modulus": 500.0, "lambda_over_R": 0.1, "a_max_over_R": np.linspace(0.5, 3, number)}
    lines.append(["smooth, one material", microseconds(smooth, FORCE), microseconds(smooth)])
    for solver in ("asymptotic", "envelope"):
        scenes = mixture(number // 10, "log")
        lines.append([f"log-uniform, {solver}", *(microseconds(scenes, out, solver=solver) for out in (FORCE, BOTH))])
    return table([f"{number:,} scenes, one thread", "force, us", "force and energy, us"], lines)


def waves_table() -> tuple[str, NDArray[np.float64]]:
    """Return the growth of the cost with the number of waves."""
    lines, points = [], []
    for wavelength in 10.0 ** -np.arange(1, 6.1, 0.5):
        line: list[float] = [wavelength]
        for r_over_s in (None, 0.8):
            scenes = waves(wavelength, r_over_s)
            jumps = solve(scenes, ["loading_jumps", "unloading_jumps"])
            line += [int(jumps["loading_jumps"][0] + jumps["unloading_jumps"][0]), microseconds(scenes)]
        points.append(line)
        lines.append([f"{wavelength:.2g}", *line[1:]])
    header = ["lambda/R", "jumps, A = 0.02", "us", "jumps, r/s = 0.8", "us"]
    array = np.array(points)
    for name, first in [("largest over that at 0.1", 0), ("largest over that at 0.01", 2)]:
        growth = [array[first:, column].max() / array[first, column] for column in (2, 4)]
        lines.append([name, "", growth[0], "", growth[1]])
    return table(header, lines), array


def rims_table() -> tuple[str, NDArray[np.float64]]:
    """Return the cost of many a_max on one curve."""
    points = []
    for rims in (1, 3, 10, 30, 100, 300, 1000):
        scenes: dict[str, Any] = dict(waves(0.02, 0.8))
        scenes = {name: np.reshape(value, (-1, 1)) for name, value in scenes.items()}
        scenes["a_max_over_R"] = np.linspace(0.1, 1.0, rims)[None, ::-1] if rims > 1 else np.ones((1, 1))
        points.append([rims, microseconds(scenes) * rims])
    array = np.array(points)
    lines = [[int(rims), time_, f"{time_ / array[0, 1]:.2f}"] for rims, time_ in points]
    return table(["a_max/R on one curve", "us a curve", "over one a_max"], lines), array


def numbers() -> NDArray[np.float64]:
    """Return the time of a scene against the number of scenes of a call."""
    counts = [1, 10, 100, 1000, 10_000, 100_000]
    return np.array([[n, *(microseconds(mixture(n, "log"), out) for out in (FORCE, BOTH))] for n in counts])


def picture(by_waves: NDArray[np.float64], by_rims: NDArray[np.float64], by_number: NDArray[np.float64]) -> None:
    """Draw cost against the numbers of waves, of scenes and of a_max."""
    figure, axes = plt.subplots(1, 3, figsize=(9, 3), layout="constrained")
    axes[0].loglog(1 / by_waves[:, 0], by_waves[:, 2], "o-", label="A = 0.02")
    axes[0].loglog(1 / by_waves[:, 0], by_waves[:, 4], "s-", label="r/s = 0.8")
    axes[0].set(xlabel="waves within the punch", ylabel="force and energy, µs a scene")
    axes[1].loglog(by_number[:, 0], by_number[:, 1], "o-", label="force")
    axes[1].loglog(by_number[:, 0], by_number[:, 2], "s-", label="force and energy")
    axes[1].set(xlabel="scenes in a call", ylabel="µs a scene")
    axes[2].loglog(by_rims[:, 0], by_rims[:, 1], "o-")
    axes[2].set(xlabel="number of a_max on one curve", ylabel="force and energy, µs a curve")
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.set_ylim(bottom=0.1)
    for axis in axes[:2]:
        axis.legend()
    FIGURES.mkdir(parents=True, exist_ok=True)
    figure.savefig(FIGURES / "cost.png", dpi=110)
