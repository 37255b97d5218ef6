"""Start-up of the command: help, a study checked, run and described; the first run ever, which compiles or need not."""

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


def run(*arguments: str, **changes: str) -> float:
    """Return the wall time of the command, with changes of the environment."""
    environment = os.environ | changes
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program has the bytecode of its modules
    start = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "gradhesion.cli", *arguments], env=environment, check=True, capture_output=True
    )
    return time.perf_counter() - start


def from_a_wheel(folder: Path, *arguments: str) -> float:
    """Return the wall time of the first run of a wheel with the compiled kernels of cycles, its cache empty."""
    wheel, installed = folder / "wheel", folder / "installed"
    build = [sys.executable, "-m", "wheels", "--kinds", "energy", "--target", wheel, "--kept", folder / "kept"]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", installed]
    subprocess.run([*pip, *wheel.iterdir()], check=True)
    return run(*arguments, PYTHONPATH=str(installed), XDG_CACHE_HOME=str(folder / "empty"))


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
        first = run(*smoke, XDG_CACHE_HOME=folder)
        carried = from_a_wheel(Path(folder), *smoke)
    lines = [[f"`{words}`", statistics.median(own)] for words, own in times.items()]
    lines += [["first run ever, which compiles", first], ["first run ever, of a wheel with compiled kernels", carried]]
    return table(["command", "s"], lines)


def main() -> None:
    """Print the table."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(start_up_table())


if __name__ == "__main__":
    main()
