"""The time of opening at a speed, by the number of waves within the contact: `python -m benchmarks.rate`."""

import argparse

from benchmarks.clock import seconds_of, table
from gradhesion.core import Loading, Profile
from gradhesion.core.problem.rate import Rate
from gradhesion.core.rate.scenes import move

SCENE = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "a_max_over_R": 0.5}
WAVES = (0, 20, 1000, 10_000)
SPEEDS = (1e-6, 1e-3, 0.1, 10.0)
CHI = 0.3
"""Strength of the waves, about the same for all: r/s."""


def rate_table(waves: tuple[int, ...] = WAVES) -> str:
    """Return milliseconds a scene, on one thread, of n = 0.6."""
    law, rows, known = Rate(exponent=0.6), [], {"profile": Profile(), "loading": Loading(), "threads": 1}
    for count in waves:
        wavelength = SCENE["a_max_over_R"] / max(1, count)
        wavy = {"lambda_over_R": wavelength, "A": 0.0 if count == 0 else 0.02 * CHI * (20.0 / count) ** 0.65}
        times: list[str | float] = [f"{count:,}"]
        for opens in (True, False):
            for speed in SPEEDS:
                scene = SCENE | wavy | {"speed_over_reference": speed}
                repeat = 1 if count > 1000 else 5
                times.append(
                    1e3
                    * seconds_of(
                        lambda s=scene, opens=opens: move(s, law, known, opens=opens),
                        repeat=repeat,
                    )
                )
        rows.append(times)
    header = ["waves", *(f"{way}, V/v* = {speed:g}" for way in ("opening", "closing") for speed in SPEEDS)]
    return table(header, rows)


def main() -> None:
    """Print the table."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print("Milliseconds a scene, one thread, n = 0.6:\n")
    print(rate_table())


if __name__ == "__main__":
    main()
