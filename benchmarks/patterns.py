"""Time of a cycle against the waves of a pattern of toughness within the rim: `python -m benchmarks.patterns`.

A paraboloid, smooth or with a wave of its own that has no common measure with the pattern; force, energy and counts.
"""

import argparse
from functools import partial
from typing import Final

from benchmarks.clock import seconds_of, table
from gradhesion.core import solve
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

SCENE: Final = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 1.0, "lambda_over_R": 0.013, "a_max_over_R": 0.5}
OUTPUTS: Final = ("pull_off_force", "dissipated_energy", "loading_jumps", "unloading_jumps")
HARMONICS: Final = (ToughnessHarmonic(n=1, sin=0.3),)
WAVES: Final = (20, 1_000, 10_000, 100_000)


def main() -> None:
    """Print the milliseconds of one scene, on one thread."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    rows = []
    for of in ("toughness", "work"):
        for amplitude in (0.0, 0.003):
            times = []
            for waves in WAVES:
                scene = SCENE | {"A": amplitude, "toughness_wavelength_over_R": 0.5 / waves}
                run = partial(solve, scene, OUTPUTS, toughness=Toughness(HARMONICS, of), threads=1)
                run()
                times.append(seconds_of(run, repeat=3))
            rows.append([of, f"{amplitude:g}", *(f"{1e3 * time:.3g}" for time in times)])
    print(table(["pattern of", "A", *(f"{waves:,} waves" for waves in WAVES)], rows))


if __name__ == "__main__":
    main()
