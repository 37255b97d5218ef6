"""Processor time of a scene, class by class: `python -m benchmarks.cost [--scenes N] [--json FILE] [--over FILE]`.

Two checkouts are compared on one machine by the numbers of the first, of which the second prints ratios:

    PYTHONPATH=../before/build/types python -m benchmarks.cost --json before.json
    python -m benchmarks.cost --over before.json

so that only names that both have may stand here.
"""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from benchmarks.clock import BOTH, FORCE, microseconds, table
from benchmarks.draw import Parameters, mixture, waves
from gradhesion import core
from gradhesion.core import SENSITIVITIES, Harmonic, Loading, Profile
from gradhesion.core.problem.toughness import Rate, Toughness, ToughnessHarmonic

VALUES: Final = {"force": FORCE, "both": BOTH}
SLOPES: Final = {"force + slopes": (*FORCE, *SENSITIVITIES[:1]), "both + slopes": (*BOTH, *SENSITIVITIES)}
TASKS: Final = VALUES | SLOPES
"""What is requested: force, force and energy, and either with its sensitivities to all parameters."""
SHARED: Final = 50
"""Rims, or depths, on one curve."""
CHI: Final = 0.8
"""r/s of long curves, whose waves fold up to the rim."""


class Case(NamedTuple):
    """Scenes of a class, how they are solved, and what is requested."""

    name: str
    scenes: Parameters
    how: dict[str, Any]
    tasks: dict[str, tuple[str, ...]] = VALUES


def on_one_curve(curves: int, name: str, low: float) -> Parameters:
    """Draw curves, each with many rims or depths: parts of its rim, or of the depth of a paraboloid there."""
    drawn = {key: np.reshape(values, (-1, 1)) for key, values in mixture(curves, "log").items()}
    part = np.linspace(low, 1.0, SHARED)
    power = 1.0 if name == "a_max_over_R" else 2.0
    return drawn | {name: part * drawn["a_max_over_R"] ** power}


def cases(number: int) -> Iterator[Case]:
    """Yield all classes; those whose scenes are dear have fewer of them."""
    rng = np.random.default_rng(4)
    plain = dict(mixture(number, "log"))
    few = {name: values[: number // 10] if np.ndim(values) else values for name, values in plain.items()}
    pair = Profile(harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.2)))
    eight = Profile(harmonics=tuple(Harmonic(n=n, cos=n**-2.0) for n in range(1, 9)))
    springs = {"machine_stiffness": 10.0 ** rng.uniform(-3.0, 0.0, number)}
    depths = {"indentation_max_over_R": plain["a_max_over_R"] ** 2 * rng.uniform(0.1, 0.7, number)}
    pattern = Toughness((ToughnessHarmonic(n=1, sin=0.3),))
    period = {"toughness_wavelength_over_R": few["lambda_over_R"] / 1.37}
    yield Case("one cosine", plain, {}, TASKS)
    yield Case("uniform lambda/L", mixture(number, "linear"), {})
    yield Case("smooth", plain | {"A": 0.0}, {})
    yield Case("exponent 1.5", plain, {"profile": Profile(exponent=1.5)}, TASKS)
    yield Case("two harmonics", plain, {"profile": pair}, TASKS)
    yield Case("eight harmonics", few, {"profile": eight}, TASKS)
    yield Case("load", plain, {"loading": Loading(control="load")}, TASKS)
    yield Case("machine", plain | springs, {"loading": Loading(control="machine")}, TASKS)
    yield Case("a k of its own", plain | {"k": rng.uniform(0.0, 0.95, number)}, {}, TASKS)
    yield Case("turned at a depth", plain | depths, {}, TASKS)
    yield Case("closing ratio 0.5", plain | {"closing_ratio": 0.5}, {})
    yield Case("pattern of toughness", few | period, {"toughness": pattern})
    yield Case(f"{SHARED} rims a curve", on_one_curve(number // SHARED, "a_max_over_R", 0.02), {})
    yield Case(f"{SHARED} depths a curve", on_one_curve(number // SHARED, "indentation_max_over_R", 0.02), {})
    for count in (1_000, 10_000, 100_000):
        yield Case(f"{count:,} waves", waves(1.0 / count, CHI, max(1, number // 200)), {})
    moved = dict(waves(0.025, CHI, max(1, number // 2_000))) | {"a_max_over_R": 0.5, "speed_over_reference": 1e-3}
    yield Case("a speed, 20 waves", moved, {"rate": Rate(exponent=0.6)})


def measured(number: int, only: str = "") -> dict[str, dict[str, float]]:
    """Return the microseconds of a scene by class and task."""
    return {
        case.name: {task: microseconds(case.scenes, asked, repeat=6, **case.how) for task, asked in case.tasks.items()}
        for case in cases(number)
        if only in case.name
    }


def cost_table(found: dict[str, dict[str, float]], before: dict[str, dict[str, float]] | None = None) -> str:
    """Return the microseconds of a scene; beside each what it is over that before, where that is given."""
    header = ["processor time of a scene"]
    rows: list[list[Any]] = [[name] for name in found]
    for task in TASKS:
        header += [f"{task}, us"] if before is None else [f"{task}, us", "over before"]
        for row, (name, times) in zip(rows, found.items(), strict=True):
            own = times.get(task, np.nan)
            row += [own] if before is None else [own, own / before.get(name, {}).get(task, np.nan)]
    return table(header, rows)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=20_000, help="scenes of a call, fewer of dear ones [20000]")
    parser.add_argument("--only", default="", help="the classes whose names contain this alone")
    parser.add_argument("--json", type=Path, help="a file to write the numbers to")
    parser.add_argument("--over", type=Path, help="a file that --json has written, to be compared with")
    chosen = parser.parse_args()
    before = json.loads(chosen.over.read_text()) if chosen.over else None
    found = measured(chosen.scenes, chosen.only)
    if chosen.json:
        chosen.json.write_text(json.dumps(found, indent=1))
    print(f"{Path(core.__file__).parent}\n\n{cost_table(found, before)}")


if __name__ == "__main__":
    main()
