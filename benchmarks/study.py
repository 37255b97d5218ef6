"""A study of ten million scenes through the command: wall time and peak memory."""

import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.clock import processors

STUDY = """title = "Ten million scenes"
outputs = ["pull_off_force", "dissipated_energy"]
[parameters]
k             = [0.0, 0.2, 0.4, 0.6, 0.8]
nu            = 0.3
modulus       = 500.0
c0_over_R     = { start = 0.01, stop = 1.0, num = 8, spacing = "log" }
lambda_over_R = { start = 0.02, stop = 1.0, num = 250, spacing = "log" }
A             = { start = 0.001, stop = 0.1, num = 20, spacing = "log" }
a_max_over_R  = { start = 0.1, stop = 1.0, num = 50 }
"""
_LAUNCH = """import os, sys, time
start = time.perf_counter()
process = os.posix_spawn(sys.executable, [sys.executable, *sys.argv[1:]], os.environ)
_, status, usage = os.wait4(process, 0)
print(time.perf_counter() - start, os.waitstatus_to_exitcode(status), usage.ru_maxrss / 2**20)
"""
"""Runs a command from a small process: what a large one takes would count as the command's memory."""


def study_sentence() -> str:
    """Run the study of 10^7 scenes by the command; tell its wall time, memory and size."""
    with tempfile.TemporaryDirectory() as folder:
        study, output = Path(folder) / "study.toml", Path(folder) / "study.nc"
        study.write_text(STUDY)
        command = ["-m", "gradhesion.cli", "run", str(study), "-o", str(output), "--quiet"]
        done = subprocess.run([sys.executable, "-c", _LAUNCH, *command], capture_output=True, text=True, check=True)
        seconds, code, memory = map(float, done.stdout.split())
        size = output.stat().st_size / 1e6 if output.exists() else math.nan
    cores = processors()
    return (
        f"A study of 10,000,000 scenes over 5 axes, both outputs, warm, {cores} cores, from the command to the closed "
        f"file: {seconds:.1f} s, peak memory {memory:.2f} GiB, file {size:.0f} MB, exit code {code:.0f}.\n"
    )


def main() -> None:
    """Run the study once."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(study_sentence())


if __name__ == "__main__":
    main()
