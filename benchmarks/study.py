"""Studies of 10^5 to 10^7 scenes through the command: wall time, how threads share it, and peak memory."""

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Final

import numpy as np

from benchmarks.clock import BOTH, seconds_of, table
from gradhesion.core import solve
from gradhesion.core.processors import processors

SIZES: Final = {10**5: (4, 25, 4), 10**6: (8, 50, 10), 10**7: (8, 250, 20)}
"""Values of c0/R, lambda/R and A, over the same ranges, so that the scenes are of the same kind."""
_EXPONENTS: Final = (0.0, 0.2, 0.4, 0.6, 0.8)
_RIMS: Final = 50
_LAUNCH: Final = """import os, sys, time
start = time.perf_counter()
process = os.posix_spawn(sys.executable, [sys.executable, *sys.argv[1:]], os.environ)
_, status, usage = os.wait4(process, 0)
print(time.perf_counter() - start, usage.ru_maxrss / 2**20)
sys.exit(os.waitstatus_to_exitcode(status))
"""
"""Runs a command from a small process: what a large one takes would count as the command's memory."""


def text_of(depths: int, wavelengths: int, amplitudes: int) -> str:
    """Return a study over five axes, of 250 times the product of the numbers."""
    return f"""title = "Scenes over five axes"
outputs = ["{'", "'.join(BOTH)}"]
[parameters]
k             = {[*_EXPONENTS]}
nu            = 0.3
modulus       = 500.0
c0_over_R     = {{ start = 0.01, stop = 1.0, num = {depths}, spacing = "log" }}
lambda_over_R = {{ start = 0.02, stop = 1.0, num = {wavelengths}, spacing = "log" }}
A             = {{ start = 0.001, stop = 0.1, num = {amplitudes}, spacing = "log" }}
a_max_over_R  = {{ start = 0.1, stop = 1.0, num = {_RIMS} }}
"""


def run(numbers: tuple[int, int, int], threads: int) -> tuple[float, float, float]:
    """Run a study by the command; return its wall time in s, peak memory in GiB and the size of its file in MB."""
    with tempfile.TemporaryDirectory() as folder:
        study, output = Path(folder) / "study.toml", Path(folder) / "study.nc"
        study.write_text(text_of(*numbers))
        command = ["-m", "gradhesion.cli", "run", str(study), "-o", str(output), "--threads", str(threads), "--quiet"]
        done = subprocess.run([sys.executable, "-c", _LAUNCH, *command], capture_output=True, text=True, check=True)
        seconds, memory = map(float, done.stdout.split())
        return seconds, memory, output.stat().st_size / 1e6


def solving(numbers: tuple[int, int, int], threads: int) -> float:
    """Return the time of solving these scenes alone, in s."""
    depths, wavelengths, amplitudes = numbers
    axes = {
        "k": np.array(_EXPONENTS),
        "c0_over_R": np.geomspace(0.01, 1.0, depths),
        "lambda_over_R": np.geomspace(0.02, 1.0, wavelengths),
        "A": np.geomspace(0.001, 0.1, amplitudes),
        "a_max_over_R": np.linspace(0.1, 1.0, _RIMS),
    }
    open_mesh = dict(zip(axes, np.ix_(*axes.values()), strict=True))
    scenes = {**open_mesh, "nu": 0.3, "modulus": 500.0}
    return seconds_of(lambda: solve(scenes, BOTH, threads=threads), repeat=2, clock=time.perf_counter)


def study_table(most: int = 10**7) -> str:
    """Return the times of studies of up to `most` scenes on one thread and on all."""
    lines = []
    for count in [size for size in SIZES if size <= most]:
        for threads in sorted({1, processors()}):
            seconds, *memory_and_size = run(SIZES[count], threads)
            alone = solving(SIZES[count], threads)
            lines.append([count, threads, alone, seconds, 1e6 * seconds / count, *memory_and_size])
    return table(["scenes", "threads", "solving, s", "command, s", "us a scene", "peak GiB", "file in MB"], lines)
