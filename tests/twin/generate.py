"""Write the stored values: python -m tests.twin.generate [--random N] [--unbounded N] [--seed N] [--output FILE]."""

import argparse
import json
import math
import time
from pathlib import Path

from gradhesion.twin.scene import PARAMETERS, Solution, solve

from .draw import Request, draw
from .hard import hard_scenes

EXPECTED = tuple(Solution.__dataclass_fields__)[:11]
OUTPUT = Path(__file__).with_name("scenes.json")
DESCRIPTION = (
    "Scenes solved by the twin (tests/twin), R = dgamma = 1: parameters are exact doubles under the keys of a study,"
    " values are rounded once from more than 30 digits, in the units of a dataset. a_max_over_R 'inf' is an unbounded"
    " punch, its delta_max null."
)


def row(request: Request) -> list[object]:
    """One line of the file."""
    solution = solve(request.parameters)
    inputs = [value if math.isfinite(value) else "inf" for value in (request.parameters[name] for name in PARAMETERS)]
    values: list[object] = []
    for name in EXPECTED:
        value = getattr(solution, name)
        if name.startswith(("margin", "energy_c", "radius_c")):
            value = float(f"{value:.2e}")
        values.append(value if value is None or isinstance(value, int | float) else float(value))
    return [request.group, request.note, *inputs, *values]


def write(path: Path, seed: int, rows: list[list[object]]) -> None:
    """Store all rows, one a line."""
    head = {"description": DESCRIPTION, "seed": seed, "columns": ["group", "note", *PARAMETERS, *EXPECTED]}
    lines = ",\n".join(json.dumps(r) for r in rows)
    path.write_text(json.dumps(head, indent=1)[:-2] + ',\n "scenes": [\n' + lines + "\n]}\n", encoding="utf-8")


def main() -> None:
    """Draw, solve and store."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--random", type=int, default=2000)
    parser.add_argument("--unbounded", type=int, default=100)
    parser.add_argument("--seed", type=int, default=20130)
    parser.add_argument("--output", type=Path, default=OUTPUT)
    options = parser.parse_args()
    begin = time.perf_counter()
    requests = draw(options.seed, options.random, options.unbounded) + hard_scenes()
    rows: dict[int, list[object]] = {}
    # scenes of one k share their universal functions
    for n, i in enumerate(sorted(range(len(requests)), key=lambda i: requests[i].parameters["k"]), start=1):
        rows[i] = row(requests[i])
        if n % 100 == 0 or n == len(requests):
            print(f"{n} of {len(requests)} scenes, {time.perf_counter() - begin:.0f} s", flush=True)
    write(options.output, options.seed, [rows[i] for i in range(len(requests))])


if __name__ == "__main__":
    main()
