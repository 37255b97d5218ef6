"""The solver of the core against the twin on the draws of the stress suite, in shares of the stated errors.

python -m tests.twin.compare [--scenes N] [--seed N] [--waves FROM TO] [--general], from the repository's root. Prints for each draw and
output the share of the stated error (gradhesion.twin.stated) that a half and 99 in 100 of the values keep, the worst,
and the worst error over the value; then the worst scene of each.
"""

import argparse
import math
import sys
import time
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gradhesion.core import FAILED, OUTPUTS, solve
from gradhesion.twin import stated
from gradhesion.twin.general import PLAIN, Shape
from gradhesion.twin.scene import waves_to_follow
from tests.stress.draw import Scenes, eventful, hostile

from .draw_general import general_scene, known_to_the_core

Case = tuple[dict[str, float], dict[str, Any], Shape]
"""A scene, what else `solve` is given, and its shape for the twin."""


@dataclass
class Comparison:
    """What a draw gave: for each output a list of (share, relative error, scene), and what was not compared."""

    scenes: int = 0
    beyond: int = 0
    unsure: int = 0
    near: int = 0
    found: dict[str, list[tuple[float, float, int]]] = field(default_factory=lambda: defaultdict(list))

    def take(self, values: dict[str, Any], expected: dict[str, stated.Expected], scene: int) -> None:
        """Add a scene."""
        self.scenes += 1
        for name, of in expected.items():
            deviation = stated.deviation(float(values[name]), of)
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


def of_one_cosine(scenes: Scenes) -> list[Case]:
    """Give the cases of a draw of the stress suite."""
    rows = zip(*(column.tolist() for column in scenes.values()), strict=True)
    return [(dict(zip(scenes, row, strict=True)), {}, PLAIN) for row in rows]


def of_any_kind(seed: int, count: int) -> list[Case]:
    """Draw cases of any profile and control."""
    rng, made = np.random.default_rng(seed), []
    for _ in range(count):
        scene, shape = general_scene(rng)
        made.append((scene, known_to_the_core(shape), shape))
    return made


def compare(
    cases: Iterable[Case],
    waves: tuple[float, float] = (0.0, stated.MOST_WAVES),
    most: float = math.inf,
    names: Sequence[str] = OUTPUTS,
) -> Comparison:
    """Solve the scenes that have that many waves both ways, up to `most` of them; those of one k share its functions."""
    made = Comparison()
    for i, (scene, how, shape) in sorted(enumerate(cases), key=lambda case: case[1][0]["k"]):
        if made.scenes >= most:
            break
        try:
            values = solve(scene, names, **how)
            if values["status"] & FAILED or not waves[0] <= waves_to_follow(scene, shape, cycle=True) <= waves[1]:
                made.beyond += 1
                continue
            made.take(values, stated.expected(scene, names, "exact", shape), i)
        except ArithmeticError:
            made.unsure += 1
    return made


def main() -> int:
    """Compare the draws and print what came out."""
    parser = argparse.ArgumentParser(description="The solver against the twin.")
    parser.add_argument("--scenes", type=int, default=5000, help="scenes of each draw")
    parser.add_argument("--seed", type=int, default=2013)
    parser.add_argument("--waves", type=float, nargs=2, default=(0.0, 60.0), metavar=("FROM", "TO"))
    parser.add_argument("--general", action="store_true", help="scenes of any profile and control")
    arguments = parser.parse_args()
    given, worst = (arguments.seed, arguments.scenes), 0.0
    draws = {"general": of_any_kind(*given)} if arguments.general else {
        draw.__name__: of_one_cosine(draw(*given)) for draw in (hostile, eventful)
    }  # fmt: skip
    for name, cases in draws.items():
        start = time.perf_counter()
        made = compare(cases, tuple(arguments.waves))
        print(
            f"{name}: {made.scenes:,} scenes compared in {time.perf_counter() - start:.0f} s, {made.beyond:,} with "
            f"other numbers of waves, {made.unsure:,} unsure, {made.near} values may be either of two"
        )
        print("\n".join(made.told()))
        for output, rows in made.found.items():
            if "jumps" not in output:
                print(f"  worst {output}: {cases[max(rows)[2]][0]}")
        worst = max(worst, made.worst)
    return 1 if worst > 1.0 else 0


if __name__ == "__main__":
    sys.exit(main())
