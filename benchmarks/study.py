"""A study of ten million scenes through the command: wall time and peak memory."""

import argparse
import math
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from gradhesion.core.arrays.processors import processors

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


def study_sentence() -> str:
    """Run the study of 10^7 scenes by the command; tell its wall time, memory and size."""
    with tempfile.TemporaryDirectory() as folder:
        study, output = Path(folder) / "study.toml", Path(folder) / "study.nc"
        study.write_text(STUDY)
        start = time.perf_counter()
        process = subprocess.Popen([sys.executable, "-m", "gradhesion.cli", "run", study, "-o", output, "--quiet"])
        _, code, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - start
        process.returncode = code
        size = output.stat().st_size / 1e6 if output.exists() else math.nan
    cores = processors()
    return (
        f"A study of 10,000,000 scenes over 5 axes, both outputs, warm, {cores} cores, from the command to the closed "
        f"file: {seconds:.1f} s, peak memory {usage.ru_maxrss / 2**20:.2f} GiB, file {size:.0f} MB, exit code {code}.\n"
    )


def main() -> None:
    """Run the study once."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(study_sentence())


if __name__ == "__main__":
    main()
