"""Start-up of the command: help, a study checked, run and described; the first run ever, which compiles."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.clock import ROOT, table

SMOKE, CURVE = (ROOT / "configs" / f"{name}.toml" for name in ("smoke", "curve"))
FORCE = ("--set", 'outputs=["pull_off_force"]')
"""Of the smoke study, the force alone."""


def run(*arguments: str, **changes: str) -> float:
    """Return the wall time of the command, with changes of the environment."""
    environment = os.environ | changes
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program has the bytecode of its modules
    start = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "gradhesion.cli", *arguments], env=environment, check=True, capture_output=True
    )
    return time.perf_counter() - start


def start_up_table(repeat: int = 9) -> str:
    """Return medians, and what is done once: the first runs."""
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
        curve = ["run", str(CURVE), "-o", str(Path(folder) / "curve.nc"), "--quiet"]
        empty, other, third = (str(Path(folder) / name) for name in ("empty", "other", "third"))
        first = {
            "first run ever of the force alone, which compiles": run(*smoke, *FORCE, NUMBA_CACHE_DIR=other),
            "first run ever": run(*smoke, NUMBA_CACHE_DIR=empty),
            "first run of curves after that": run(*curve, NUMBA_CACHE_DIR=empty),
            "everything compiled ahead, `gradhesion warmup --all`": run("warmup", "--all", NUMBA_CACHE_DIR=third),
        }
    lines: list[list[object]] = [[f"`{words}`", statistics.median(own)] for words, own in times.items()]
    lines += [[words, seconds] for words, seconds in first.items()]
    return table(["command", "s"], lines)
