"""The solver of the core against the twin on the draws of the stress suite, in shares of the stated errors.

python -m tests.twin.compare [--scenes N] [--seed N] [--waves FROM TO] [--general], from the repository's root. Prints for each draw and
output the share of the stated error (gradhesion.twin.stated) that a half and 99 in 100 of the values keep, the worst,
and the scene of the worst.
"""

import argparse
import math
import sys
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gradhesion.core import FAILED, OUTPUTS, Loading, solve
from gradhesion.core.problem.control import CONTROLS
from gradhesion.twin import stated
from gradhesion.twin.scene import waves_to_follow
from gradhesion.twin.shape import PLAIN, Shape
from tests.core.scene import profile_of
from tests.stress.draw import Scenes, eventful, hostile

EXPONENTS = (0.0, 1e-9, 0.23, 0.5, 0.71, 0.94, 1 - 1e-9, 1.0)
POWERS = (1.0, 1.05, 1.3, 2.0, 3.0, 6.5)
Case = tuple[dict[str, float], dict[str, Any], Shape]
"""A scene, what else `solve` is given, and its shape for the twin."""


@dataclass
class Comparison:
    """What a draw gave: for each output shares of the stated error, each with its scene, and what was not compared."""

    scenes: int = 0
    beyond: int = 0
    unsure: int = 0
    near: int = 0
    shares: dict[str, list[tuple[float, int]]] = field(default_factory=lambda: defaultdict(list))

    @property
    def worst(self) -> float:
        return max(share for rows in self.shares.values() for share, _ in rows)


def general_scene(rng: np.random.Generator, most_harmonics: int) -> tuple[dict[str, float], Shape]:
    """Draw a scene; waves may have any sign, and be missing."""
    k = float(rng.choice([*EXPONENTS, rng.random()]))
    m = float(rng.choice(POWERS))
    count = int(rng.integers(1, most_harmonics + 1)) if rng.random() < 0.5 else 1
    numbers = sorted(int(n) for n in rng.choice(np.arange(1, max(12, 2 * count)), count, replace=False))
    harmonics = tuple((n, *(float(rng.choice([0.0, rng.normal() / n])) for _ in range(2))) for n in numbers)
    unbounded = m > 1.6 and rng.random() < 0.15
    scene = {
        "k": k,
        "nu": 0.5 if k > 1 - 1e-3 else float(rng.uniform(-0.5, 0.5)),
        "modulus": 10 ** float(rng.uniform(1, 4)),
        "c0_over_R": 10 ** float(rng.uniform(-2, 0)),
        "lambda_over_R": 10 ** float(rng.uniform(-1.5, 0.3)),
        "A": 10 ** float(rng.uniform(-3.5, -0.5)),
        "a_max_over_R": math.inf if unbounded else 10 ** float(rng.uniform(-1.3, 0.3)),
    }
    control = str(rng.choice(CONTROLS))
    if control == "machine":
        scene["machine_stiffness"] = 10 ** float(rng.uniform(-4, 2))
    return scene, Shape(m, harmonics, control)


def of_one_cosine(scenes: Scenes) -> list[Case]:
    """Give the cases of a draw of the stress suite."""
    rows = zip(*(column.tolist() for column in scenes.values()), strict=True)
    return [(dict(zip(scenes, row, strict=True)), {}, PLAIN) for row in rows]


def of_any_kind(seed: int, count: int, most_harmonics: int = 8) -> list[Case]:
    """Draw cases of any profile and control."""
    rng, made = np.random.default_rng(seed), []
    for _ in range(count):
        scene, shape = general_scene(rng, most_harmonics)
        profile, loading = profile_of(shape.exponent, *shape.harmonics), Loading(control=shape.control)
        made.append((scene, {"profile": profile, "loading": loading}, shape))
    return made


def compare(
    cases: Iterable[Case], waves: Sequence[float] = (0.0, stated.MOST_WAVES), names: Sequence[str] = OUTPUTS
) -> Comparison:
    """Solve the scenes that have that many waves both ways; those of one k share its functions."""
    made = Comparison()
    for i, (scene, how, shape) in sorted(enumerate(cases), key=lambda case: case[1][0]["k"]):
        try:
            values = solve(scene, names, **how)
            if values["status"] & FAILED or not waves[0] <= waves_to_follow(scene, shape, cycle=True) <= waves[1]:
                made.beyond += 1
                continue
            expected = stated.expected(scene, names, "exact", shape)
        except ArithmeticError:
            made.unsure += 1
            continue
        made.scenes += 1
        for name, of in expected.items():
            off = stated.deviation(float(values[name]), of)
            if of.near and off > of.error:
                made.near += 1
            else:
                made.shares[name].append((off / of.error if of.error > 0.0 else math.inf if off > 0.0 else 0.0, i))
    return made


def main() -> int:
    parser = argparse.ArgumentParser(description="The solver against the twin.")
    parser.add_argument("--scenes", type=int, default=5000, help="scenes of each draw")
    parser.add_argument("--seed", type=int, default=2013)
    parser.add_argument("--waves", type=float, nargs=2, default=(0.0, 60.0), metavar=("FROM", "TO"))
    parser.add_argument("--general", action="store_true", help="scenes of any profile and control")
    arguments = parser.parse_args()
    given, worst = (arguments.seed, arguments.scenes), 0.0
    draws = {draw.__name__: of_one_cosine(draw(*given)) for draw in (hostile, eventful)}
    for name, cases in ({"general": of_any_kind(*given)} if arguments.general else draws).items():
        made = compare(cases, arguments.waves)
        print(f"{name}: {made.scenes:,} scenes compared, {made.beyond:,} with other numbers of waves,", end=" ")
        print(f"{made.unsure:,} unsure, {made.near} values may be either of two")
        for output, rows in made.shares.items():
            half, most = np.quantile([share for share, _ in rows], [0.5, 0.99])
            print(f"  {output:<20}{half:>10.2g}{most:>10.2g}{max(rows)[0]:>10.2g}  {cases[max(rows)[1]][0]}")
        worst = max(worst, made.worst)
    return 1 if worst > 1.0 else 0


if __name__ == "__main__":
    sys.exit(main())
