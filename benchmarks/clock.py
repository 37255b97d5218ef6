"""What the benchmarks share: a clock, the machine, and tables in Markdown."""

import importlib.metadata
import math
import os
import platform
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
FIGURES = ROOT / "docs" / "figures"


def seconds_of(function: Callable[[], Any], *, repeat: int = 7, at_least: float = 0.01) -> float:
    """Return the least time of one call, the calls of one sample filling `at_least` seconds: other work only adds."""
    start = time.perf_counter()
    function()
    once = time.perf_counter() - start
    calls = max(1, math.ceil(at_least / max(once, 1e-7)))
    samples = []
    for _ in range(repeat):
        start = time.perf_counter()
        for _ in range(calls):
            function()
        samples.append((time.perf_counter() - start) / calls)
    return min(samples)


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


def processors() -> int:
    """Return the number of processors that this process is bound to."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def machine() -> str:
    """Return the machine and the versions in one sentence."""
    processor = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [
            line.split(":", 1)[1].strip() for line in info.read_text().splitlines() if line.startswith("model name")
        ]
        processor = names[0] if names else processor
    packages = ("gradhesion", "numpy", "numba", "llvmlite", "scipy", "mpmath", "netCDF4")
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in packages)
    cores = processors()
    return f"{processor}, {cores} cores, {platform.system()}; Python {platform.python_version()}, {versions}."
