"""What the benchmarks share: a clock, the machine, and tables in Markdown."""

import importlib.metadata
import math
import platform
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from gradhesion.core import solve
from gradhesion.core.processors import processors

ROOT: Final = Path(__file__).parents[1]
FIGURES: Final = ROOT / "docs" / "figures"
BOTH: Final = ("pull_off_force", "dissipated_energy")
FORCE: Final = BOTH[:1]
_WARM: Final = 0.2
"""Seconds of calls that are not counted: the first ones of a process take half as long again."""


def seconds_of(
    function: Callable[[], Any],
    *,
    repeat: int = 7,
    most: float = math.inf,
    clock: Callable[[], float] = time.process_time,
) -> float:
    """Return the least time of one call, the calls of a sample filling a hundredth of a second: other work only adds.

    There are `repeat` samples; after `most` seconds no other begins, if there is one.
    """
    function()  # what is compiled or made once
    calls, begin = 0, clock()
    while not calls or clock() - begin < min(_WARM, most):
        function()
        calls += 1
    once = (clock() - begin) / calls
    calls, samples = max(1, math.ceil(0.01 / max(once, 1e-7))), [once]
    while len(samples) <= repeat and (len(samples) == 1 or clock() - begin < most):
        start = clock()
        for _ in range(calls):
            function()
        samples.append((clock() - start) / calls)
    return min(samples)


def microseconds(
    scenes: Any, outputs: Sequence[str] = BOTH, *, repeat: int = 3, most: float = 3.0, **how: Any
) -> float:
    """Return the processor time of a scene in a call on one thread."""
    count = math.prod(np.broadcast_shapes(*(np.shape(values) for values in scenes.values())))
    return 1e6 * seconds_of(lambda: solve(scenes, outputs, threads=1, **how), repeat=repeat, most=most) / count


def table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Return a table in Markdown; floats get two digits."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cell(value) for value in line) + " |" for line in lines) + "\n"


def cell(value: Any) -> str:
    """Return a value as it stands in a table."""
    if isinstance(value, float):
        if math.isnan(value):
            return "-"
        return f"{float(f'{value:.2g}'):,.0f}" if 100 <= value < 1e6 else f"{value:.2g}"
    return f"{value:,}" if isinstance(value, int) else str(value)


def machine() -> str:
    """Return the machine and the versions in one sentence."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    processor = [*names, platform.processor() or platform.machine()][0]
    packages = ("gradhesion", "numpy", "numba", "llvmlite", "scipy", "mpmath", "netCDF4")
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in packages)
    return f"{processor}, {processors()} cores, {platform.system()}; Python {platform.python_version()}, {versions}."
