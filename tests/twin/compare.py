"""The solver of the core against the twin on the draws of the stress suite, in shares of the stated errors.

python -m tests.twin.compare [--scenes N] [--seed N] [--waves FROM TO] [--general], from the repository's root. Prints for each draw and
output the share of the stated error (gradhesion.twin.stated) that a half and 99 in 100 of the values keep, the worst,
and the worst error over the value; then the worst scene of each.
"""

import argparse
import math
import sys
import time
from dataclasses import dataclass, field

import numpy as np

from gradhesion.core import FAILED, OUTPUTS, solve
from gradhesion.twin import stated
from gradhesion.twin.scene import waves_to_follow
from tests.stress.draw import Scenes, eventful, hostile

from .draw_general import general_scene, known_to_the_core


@dataclass
class Comparison:
    """What a draw gave: for each output a list of (share, relative error, scene), and what was not compared."""

    scenes: int = 0
    beyond: int = 0
    unsure: int = 0
    near: int = 0
    found: dict[str, list[tuple[float, float, int]]] = field(default_factory=lambda: {name: [] for name in OUTPUTS})

    def take(self, values: dict[str, float], expected: dict[str, stated.Expected], scene: int) -> None:
        """Add a scene."""
        for name, of in expected.items():
            deviation = stated.deviation(values[name], of)
            if of.near and deviation > of.error:
                self.near += 1
                continue
            share = deviation / of.error if of.error > 0.0 else 0.0 if deviation == 0.0 else math.inf
            size = abs(float(of.value))
            self.found[name].append((share, deviation / size if 0.0 < size < math.inf else 0.0, scene))

    def told(self) -> list[str]:
        """Tell the shares of each output."""
        lines = [f"  {'output':<20}{'half':>10}{'99 in 100':>12}{'worst':>10}{'over the value':>16}  scene"]
        for name, rows in self.found.items():
            shares = np.array([share for share, _, _ in rows])
            half, most = np.quantile(shares, [0.5, 0.99])
            over, scene = max(row[1] for row in rows), max(rows)[2]
            lines.append(f"  {name:<20}{half:>10.2g}{most:>12.2g}{shares.max():>10.2g}{over:>16.2g}  {scene}")
        return lines

    @property
    def worst(self) -> float:
        """The greatest share."""
        return max(share for rows in self.found.values() for share, _, _ in rows)


def one(scenes: Scenes, i: int) -> dict[str, float]:
    """Give a scene of a draw."""
    return {name: float(values[i]) for name, values in scenes.items()}


def compare(
    scenes: Scenes, waves: tuple[float, float] = (0.0, stated.MOST_WAVES), most: float = math.inf
) -> Comparison:
    """Solve the scenes that have that many waves both ways, up to `most` of them."""
    values = solve(scenes, OUTPUTS)
    made = Comparison()
    for i in np.argsort(scenes["k"], kind="stable"):
        if made.scenes >= most:
            break
        scene = one(scenes, i)
        if values["status"][i] & FAILED or not waves[0] <= waves_to_follow(scene, cycle=True) <= waves[1]:
            made.beyond += 1
            continue
        try:
            expected = stated.expected(scene, OUTPUTS, "exact")
        except ArithmeticError:
            made.unsure += 1
            continue
        made.scenes += 1
        made.take({name: float(values[name][i]) for name in expected}, expected, int(i))
    return made


def compare_general(seed: int, count: int, most_waves: float, most: float = math.inf) -> Comparison:
    """Solve scenes of any profile and control both ways, up to `most` of them."""
    made = Comparison()
    rng = np.random.default_rng(seed)
    for i in range(count):
        if made.scenes >= most:
            break
        scene, shape = general_scene(rng)
        values = solve(scene, OUTPUTS, **known_to_the_core(shape))
        try:
            if values["status"] & FAILED or waves_to_follow(scene, shape, cycle=True) > most_waves:
                made.beyond += 1
                continue
            expected = stated.expected(scene, OUTPUTS, "exact", shape)
        except ArithmeticError:
            made.unsure += 1
            continue
        made.scenes += 1
        made.take({name: float(values[name]) for name in expected}, expected, i)
    return made


def main() -> int:
    """Compare both draws and print what came out."""
    parser = argparse.ArgumentParser(description="The solver against the twin.")
    parser.add_argument("--scenes", type=int, default=5000, help="scenes of each draw")
    parser.add_argument("--seed", type=int, default=2013)
    parser.add_argument("--waves", type=float, nargs=2, default=(0.0, 60.0), metavar=("FROM", "TO"))
    parser.add_argument("--general", action="store_true", help="scenes of any profile and control")
    arguments = parser.parse_args()
    if arguments.general:
        start = time.perf_counter()
        made = compare_general(arguments.seed, arguments.scenes, arguments.waves[1])
        took = time.perf_counter() - start
        print(f"{made.scenes:,} scenes in {took:.0f} s, {made.beyond:,} beyond, {made.unsure} unsure, {made.near} near")
        print("\n".join(made.told()))
        return 1 if made.worst > 1.0 else 0
    worst = 0.0
    for draw in (hostile, eventful):
        start = time.perf_counter()
        scenes = draw(arguments.seed, arguments.scenes)
        made = compare(scenes, tuple(arguments.waves))
        print(
            f"{draw.__name__}: {made.scenes:,} scenes compared in {time.perf_counter() - start:.0f} s, {made.beyond:,} with "
            f"other numbers of waves, {made.unsure:,} unsure, {made.near} values may be either of two"
        )
        print("\n".join(made.told()))
        for name, rows in made.found.items():
            if "jumps" not in name:
                print(f"  worst {name}: {one(scenes, max(rows)[2])}")
        worst = max(worst, made.worst)
    return 1 if worst > 1.0 else 0


if __name__ == "__main__":
    sys.exit(main())
