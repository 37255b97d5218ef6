"""Solve the scenes of scenes.json again, and store their values: python -m tests.twin.generate [FILE]."""

import json
import sys
from pathlib import Path

from flint import arb

from gradhesion.twin.scene import PARAMETERS, solve

STORED = Path(__file__).with_name("scenes.json")


def row(scene: dict[str, object]) -> list[object]:
    """One line of the file: what a scene is, and its values, rounded once."""
    solution = solve({name: float(str(scene[name])) for name in PARAMETERS})
    values: list[object] = []
    for name, given in scene.items():
        value = getattr(solution, name, given)
        if name.startswith(("margin", "energy_c", "radius_c")):
            value = float(f"{value:.2e}")
        values.append(float(value) if isinstance(value, arb) else value)
    return values


def main(output: Path = STORED) -> None:
    """Solve and store; scenes of one k share their universal functions."""
    file = json.loads(STORED.read_text(encoding="utf-8"))
    scenes = [dict(zip(file["columns"], stored, strict=True)) for stored in file.pop("scenes")]
    rows = {i: row(scenes[i]) for i in sorted(range(len(scenes)), key=lambda i: float(str(scenes[i]["k"])))}
    lines = ",\n".join(json.dumps(rows[i]) for i in range(len(scenes)))
    output.write_text(json.dumps(file, indent=1)[:-2] + ',\n "scenes": [\n' + lines + "\n]}\n", encoding="utf-8")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:2]))
