"""Start-up of the command: help, a study checked, run and described, and the first run ever, which compiles."""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.clock import ROOT, table

SMOKE = ROOT / "configs" / "smoke.toml"


def run(*arguments: str, cache: str | None = None) -> float:
    """Return the wall time of the command."""
    environment = os.environ | ({"XDG_CACHE_HOME": cache} if cache else {})
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program has the bytecode of its modules
    start = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "gradhesion.cli", *arguments], env=environment, check=True, capture_output=True
    )
    return time.perf_counter() - start


def start_up_table(repeat: int = 9) -> str:
    """Return medians; the first run is one."""
    with tempfile.TemporaryDirectory() as folder:
        dataset = str(Path(folder) / "smoke.nc")
        smoke = ["run", str(SMOKE), "-o", dataset, "--overwrite", "--quiet"]
        run(*smoke)
        warm = {
            "gradhesion --help": ["--help"],
            "gradhesion validate configs/smoke.toml": ["validate", str(SMOKE)],
            "gradhesion run configs/smoke.toml": smoke,
            "gradhesion info outputs/smoke.nc": ["info", dataset],
        }
        times: dict[str, list[float]] = {words: [] for words in warm}
        for _ in range(repeat):  # in turns, so that a busy moment of the machine is in all of them
            for words, arguments in warm.items():
                times[words].append(run(*arguments))
        first = run(*smoke, cache=folder)
    lines = [[f"`{words}`", statistics.median(own)] for words, own in times.items()]
    lines.append(["first run ever, which compiles", first])
    return table(["command", "s"], lines)


def main() -> None:
    """Print the table."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(start_up_table())


if __name__ == "__main__":
    main()
