"""Workers of a Dask cluster on this machine against threads: what it costs to hand out blocks, and to start."""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import table

STUDY = """outputs = ["pull_off_force", "dissipated_energy"]
[parameters]
k             = 0.3
nu            = 0.3
modulus       = 500.0
c0_over_R     = 0.01
lambda_over_R = {{ start = {start}, stop = {stop}, num = {blocks} }}
A             = {{ start = 0.01, stop = 0.05, num = 32768 }}
a_max_over_R  = {{ start = 0.5, stop = 1.0, num = 8 }}
"""
"""A block for each wavelength: 32,768 curves with 8 rims each."""


CASES: Final = ((0.1, 0.11, 40), (0.02, 0.021, 12))
"""Wavelengths, the fewer blocks the dearer they are."""


def seconds_of(study: Path, folder: str, engine: str) -> NDArray[np.float64]:
    """Return the wall time of a run, without that of the interpreter, and the processor time of all its processes."""
    output, log = Path(folder) / "out.nc", Path(folder) / "log"
    command = [sys.executable, "-m", "gradhesion.cli", "run", str(study), "-o", str(output), "--overwrite"]
    with log.open("w") as file:
        process = subprocess.Popen([*command, "--engine", engine], stderr=file)
        _, code, usage = os.wait4(process.pid, 0)
        process.returncode = code
    if code:
        raise RuntimeError(log.read_text())
    found = re.search(r"scenes in ([\d.]+) s", log.read_text())
    if found is None:
        raise RuntimeError(log.read_text())
    return np.array([float(found[1]), usage.ru_utime + usage.ru_stime])


def engines_table(repeat: int = 3) -> str:
    """Return the times of both engines in turns, the least of each, and what is left of their difference."""
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        study = Path(folder) / "study.toml"

        def measure() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
            seconds_of(study, folder, "threads")  # compiles, if need be
            both = [[seconds_of(study, folder, engine) for engine in ("threads", "dask")] for _ in range(repeat)]
            least = np.min(both, axis=0)
            return least[0], least[1]

        study.write_text(STUDY.format(start=0.8, stop=0.9, blocks=2))
        threads, workers = measure()
        start = workers - threads
        for low, high, blocks in CASES:
            study.write_text(STUDY.format(start=low, stop=high, blocks=blocks))
            threads, workers = measure()
            more = (workers - start - threads) / threads
            percent = [f"{100 * one:+.0f} %" for one in more]
            of_block = float(threads[1]) / blocks
            lines.append([of_block, blocks, float(threads[0]), float(workers[0]), *percent])
    header = [
        "s of a core a block",
        "blocks",
        "threads, s",
        "workers, s",
        "more without their start",
        "of processor time",
    ]
    words = f"To start, workers need {start[0]:.1f} s, and {start[1]:.1f} s of processor time.\n"
    return f"{table(header, lines)}\n{words}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=3)
    print(engines_table(parser.parse_args().repeat))


if __name__ == "__main__":
    main()
