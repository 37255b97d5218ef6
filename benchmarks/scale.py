"""Studies of 10^4 to 10^8 scenes: time a scene and memory must not depend on the size."""

import argparse
import resource
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path
from typing import Final

import numpy as np

from benchmarks.clock import ROOT, seconds_of, table
from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study.reading import study_from
from gradhesion.core import solve

OUTPUTS: Final = ("pull_off_force", "dissipated_energy")
SIZES: Final = {10**4: (2, 5, 4), 10**5: (4, 25, 4), 10**6: (8, 50, 10), 10**7: (8, 250, 20), 10**8: (8, 1000, 50)}
"""Values of c0/R, lambda/R and A, over the same ranges, so that the scenes are of the same kind."""
_EXPONENTS: Final = (0.0, 0.2, 0.4, 0.6, 0.8)
_RIMS: Final = 50
_SMALL: Final = (2, 2, 2)


def study_of(depths: int, wavelengths: int, amplitudes: int) -> str:
    """Return a study over five axes, 250 times the product of the numbers in size."""
    return f"""title = "Scenes over five axes"
outputs = ["{'", "'.join(OUTPUTS)}"]
[parameters]
k             = {[*_EXPONENTS]}
nu            = 0.3
modulus       = 500.0
c0_over_R     = {{ start = 0.01, stop = 1.0, num = {depths}, spacing = "log" }}
lambda_over_R = {{ start = 0.02, stop = 1.0, num = {wavelengths}, spacing = "log" }}
A             = {{ start = 0.001, stop = 0.1, num = {amplitudes}, spacing = "log" }}
a_max_over_R  = {{ start = 0.1, stop = 1.0, num = {_RIMS} }}
"""


def peak_memory() -> float:
    """Return the peak memory of this process in MiB, without that of the one that started it, which rusage counts."""
    status = Path("/proc/self/status")
    if not status.exists():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10
    return next(float(line.split()[1]) for line in status.read_text().splitlines() if line.startswith("VmHWM")) / 2**10


def measure(cells: int, samples: int, threads: int | None = None) -> tuple[float, float, float]:
    """Return the least time of computing and writing a study in s, peak memory in MiB and size of the file in MB."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "study.nc"

        def once(numbers: tuple[int, int, int]) -> float:
            study = study_from(tomllib.loads(study_of(*numbers)))
            start = time.perf_counter()
            write(study, output, history="", overwrite=True, threads=threads)
            return time.perf_counter() - start

        once(_SMALL)
        fixed = min(once(_SMALL) for _ in range(20))  # what opening, closing and renaming a file costs
        seconds = min(once(SIZES[cells]) for _ in range(samples)) - fixed
        return seconds, peak_memory(), output.stat().st_size / 1e6


def in_its_own_process(cells: int, threads: int | None = None) -> tuple[float, float, float]:
    """Return what `measure` does, of a fresh process: its memory is that of this size alone."""
    samples = {10**7: 3, 10**8: 1}.get(cells, 9)
    code = f"from benchmarks.scale import measure; print(*measure({cells}, {samples}, {threads}))"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    seconds, peak, size = map(float, done.stdout.split())
    return seconds, peak, size


def solving(cells: int = 10**6, threads: int | None = None) -> float:
    """Return the time of solving alone, in s a scene, on all processors or so many threads."""
    depths, wavelengths, amplitudes = SIZES[cells]
    axes = {
        "k": np.array(_EXPONENTS),
        "c0_over_R": np.geomspace(0.01, 1.0, depths),
        "lambda_over_R": np.geomspace(0.02, 1.0, wavelengths),
        "A": np.geomspace(0.001, 0.1, amplitudes),
        "a_max_over_R": np.linspace(0.1, 1.0, _RIMS),
    }
    open_mesh = dict(zip(axes, np.ix_(*axes.values()), strict=True))
    return (
        seconds_of(lambda: solve({**open_mesh, "nu": 0.3, "modulus": 500.0}, OUTPUTS, threads=threads), repeat=3)
        / cells
    )


def scale_table(most: int = 10**8) -> str:
    """Return the table, sizes up to `most`."""
    alone = solving()
    lines = []
    for cells in SIZES:
        if cells <= most:
            seconds, peak, size = in_its_own_process(cells)
            each = seconds / cells
            lines.append([cells, seconds, 1e6 * each, f"{100 * alone / each:.0f} %", round(peak), size])
    return table(["scenes", "s", "us a scene", "of it solving", "peak MiB", "file in MB"], lines)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=10**8, help="the largest number of scenes")
    print(scale_table(parser.parse_args().most))


if __name__ == "__main__":
    main()
