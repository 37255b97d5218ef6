"""Sums over waves of one cosine, by a second way: `python -m benchmarks.sums [SCENES] [SEED]`.

For each power of ten of waves, punches with and without a rim, on soft and on stiff half-spaces. The two solvers sum by
different means; where the second has no value (weak waves, from 10^9 on), the limit of short waves remains for punches
without a rim. Then scenes of any profile and control against similar ones, and a fiftieth of them a class in ball
arithmetic (benchmarks/far.py).
"""

import argparse
import math

import numpy as np
from numpy.typing import NDArray

from benchmarks import far
from gradhesion.core import Loading, Profile, solve
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.general_report import report_general
from gradhesion.core.equations import saturation
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import FAILED
from tests.core.waves.reaching import reaching

NAMES = ("dissipated_energy", "dissipated_energy_error")
ANY = (Profile(), Loading(), 2)
BLOCK = 2000

Values = NDArray[np.float64]


def drawn(rng: np.random.Generator, decade: int, count: int) -> tuple[dict[str, Values], Values]:
    """Draw scenes whose folds end beyond so many waves, every other one with a rim, and give their ratios r/s."""
    k = rng.choice([0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0], count)
    material = {
        "k": k,
        "nu": np.where(k == 1.0, 0.5, rng.uniform(-0.9, 0.5, count)),
        "modulus": 10.0 ** rng.uniform(-3.0, 5.0, count),
        "c0_over_R": 10.0 ** rng.uniform(-3.0, 0.5, count),
    }
    ratio = 10.0 ** rng.uniform(-1.5 if decade < 5 else -4.0, 0.5, count)
    waves = 10.0 ** (decade + rng.uniform(0.0, 1.0, count))
    scenes = reaching(material, ratio, waves)
    rim = scenes["lambda_over_R"] * waves * 10.0 ** rng.uniform(-1.0, 1.0, count)
    return scenes | {"a_max_over_R": np.where(np.arange(count) % 2 == 0, math.inf, rim)}, ratio


def compared(scenes: dict[str, Values], ratio: Values) -> dict[str, Values]:
    """Compare energies with the second solver and the limit, over what is stated."""
    one = solve(scenes, NAMES)
    other = solve_general(scenes, NAMES[:1], *ANY, check_contact=False)
    stated = one[NAMES[1]] + report_general(scenes, NAMES[1:], other, *ANY)[NAMES[1]]
    energy, there = one[NAMES[0]], one["status"] & FAILED == 0
    both = there & (other["status"] & FAILED == 0)
    with np.errstate(all="ignore"):
        off = np.abs(energy - other[NAMES[0]])
        parts = (scenes[name] for name in ("k", "nu", "modulus", "c0_over_R"))
        shape = (scenes["k"], stiffness(*parts), scenes["lambda_over_R"], scenes["A"], np.inf)
        ends = saturation.end_of_folds(scenes["k"], scenes["lambda_over_R"], scenes["A"]) / scenes["lambda_over_R"]
        limit = np.abs(energy / saturation.dissipated_energy(*shape) - 1.0) / (2.0 / (ratio * ends) + 1e-12)
        near = there & np.isinf(scenes["a_max_over_R"]) & (ratio < 0.9) & (ratio * ends > 40.0)
    return {
        "failed": (~there).astype(float),
        "second": np.where(both, off / stated, np.nan),
        "relative": np.where(both, off / np.abs(energy), np.nan),
        "limit": np.where(near, limit, np.nan),
        "alone": (there & ~both & ~near).astype(float),
    }


def main() -> None:
    """Print a row for each power of ten, and what benchmarks/far.py measures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=10_000)
    parser.add_argument("seed", type=int, nargs="?", default=20261)
    parser.add_argument("--alone", action="store_true", help="one cosine alone, without benchmarks/far.py")
    requested = parser.parse_args()
    count, seed = requested.count, requested.seed
    heads = ("waves", "scenes", "no value", "against the second solver", "over stated", "relative")
    heads += ("against the limit", "over 2/(chi N) + 1e-12", "neither")
    print(f"| {' | '.join(heads)} |\n| {' | '.join(['---'] * len(heads))} |")
    for decade in range(2, 14):
        rng = np.random.default_rng([seed, decade])
        blocks = [compared(*drawn(rng, decade, min(BLOCK, count - first))) for first in range(0, count, BLOCK)]
        found = {name: np.concatenate([block[name] for block in blocks]) for name in blocks[0]}
        second, relative, limit = (found[name][np.isfinite(found[name])] for name in ("second", "relative", "limit"))
        print(
            f"| 1e{decade} | {count:,} | {found['failed'].sum():.0f} | {second.size:,} "
            f"| {max(second, default=math.nan):.2g} | {max(relative, default=math.nan):.1e} "
            f"| {limit.size:,} | {max(limit, default=math.nan):.2g} | {found['alone'].sum():.0f} |",
            flush=True,
        )
    if requested.alone:
        return
    print(far.report(4, 14, count, seed))
    print(far.report_of_balls(4, 14, max(1, count // 50), seed))


if __name__ == "__main__":
    main()
