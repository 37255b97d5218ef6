"""Start-up of the command: help, a warm run of the smoke study, and the first run ever, which compiles."""

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
    start = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "gradhesion.cli", *arguments], env=environment, check=True, capture_output=True
    )
    return time.perf_counter() - start


def start_up_table(repeat: int = 9) -> str:
    """Return medians; the first run is one."""
    with tempfile.TemporaryDirectory() as folder:
        smoke = ["run", str(SMOKE), "-o", str(Path(folder) / "smoke.nc"), "--overwrite", "--quiet"]
        run(*smoke)
        warm = statistics.median(run(*smoke) for _ in range(repeat))
        first = run(*smoke, cache=folder)
    help_ = statistics.median(run("--help") for _ in range(repeat))
    lines = [
        ["`gradhesion --help`", help_],
        ["`gradhesion run configs/smoke.toml`, warm", warm],
        ["first run ever, which compiles", first],
    ]
    return table(["command", "s"], lines)


def main() -> None:
    """Print the table."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(start_up_table())


if __name__ == "__main__":
    main()
