"""Workers that suffer what they are ordered to, and a scheduler that a test can kill."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from click.testing import Result
from distributed import Client

Call = Callable[..., Result]

PRELOAD = """
import json, os, signal, time
from contextlib import suppress
from pathlib import Path
import gradhesion.cli.work.solve.given as given

orders = Path({folder!r})
if (orders / "dead").exists():
    os._exit(1)
really = getattr(given.solve, "really", given.solve)  # it may be imported again

def ordered():
    return json.loads((orders / "order.json").read_text())

def solve(parameters, *arguments, **options):
    order = ordered()
    busy = orders / f"{{os.getpid()}}.busy"
    while order.get("once") and busy.exists():  # until it is killed, or the order is another
        time.sleep(0.01)
        order = ordered()
    busy.touch()
    while len([*orders.glob("*.busy")]) < order.get("together", 0):
        time.sleep(0.01)
    if order.get("first_dies"):
        with suppress(FileExistsError):
            (orders / "died").touch(exist_ok=False)
            os.kill(os.getpid(), signal.SIGKILL)
    block = [round(float(parameters[name].flat[0]), 6) for name in ("k", "lambda_over_R")]
    if order.get("poison") == block:
        os.kill(os.getpid(), signal.SIGKILL)
    if order.get("broken") == block:
        raise MemoryError("no room")
    if order.get("hungry") == block:
        import numpy, resource
        pages = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
        before = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (pages + 2**26, before[1]))
        try:
            numpy.ones(2**27)
        finally:
            resource.setrlimit(resource.RLIMIT_AS, before)
    time.sleep(order.get("sleep", 0.0))
    return really(parameters, *arguments, **options)

given.solve, solve.really = solve, really
if "OTHER_NUMPY" in os.environ:
    import numba, numpy  # numba looks at the version when it is imported
    numpy.__version__ = "1.0"
"""

HUGE = """\
outputs = ["pull_off_force"]
[parameters]
k = { start = 0.0, stop = 0.95, num = 200 }
nu = 0.27
modulus = { start = 100.0, stop = 1e4, num = 10 }
c0_over_R = { start = 0.01, stop = 1.0, num = 50, spacing = "log" }
lambda_over_R = { start = 0.05, stop = 1.0, num = 100, spacing = "log" }
A = { start = 0.01, stop = 0.2, num = 10 }
a_max_over_R = inf
"""
"""A study of 600 blocks."""


class Orders:
    """What the workers are told to suffer."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.preload = folder / "preload.py"
        self.preload.write_text(PRELOAD.format(folder=str(folder)))
        self.give()

    def give(self, **order: Any) -> None:
        (self.folder / "new.json").write_text(json.dumps(order))
        (self.folder / "new.json").replace(self.folder / "order.json")
        for path in (*self.folder.glob("*.busy"), *self.folder.glob("died"), *self.folder.glob("dead")):
            path.unlink()

    def no_more(self) -> None:
        """Have every worker die that works, and none start again."""
        (self.folder / "dead").touch()
        for process in self.busy():
            with suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)

    def busy(self) -> list[int]:
        """The processes that have begun a block."""
        return [int(path.stem) for path in self.folder.glob("*.busy")]


class ByHand:
    """A scheduler and workers that are started by hand."""

    def __init__(self, folder: Path, orders: Orders, **environment: str) -> None:
        self.file = folder / "scheduler.json"
        self.orders = orders
        self.processes: list[subprocess.Popen[bytes]] = []
        options = ("--host=127.0.0.1", "--port=0", "--dashboard-address=127.0.0.1:0")
        self.scheduler = self.start("scheduler", *options, **environment)
        deadline = time.monotonic() + 60
        while not self.file.exists() and time.monotonic() < deadline:
            time.sleep(0.01)

    def start(self, kind: str, *options: str, **environment: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "dask", kind, "--scheduler-file", str(self.file), "--no-dashboard", *options]
        process = subprocess.Popen(command, env=os.environ | environment, stderr=subprocess.DEVNULL)
        self.processes.append(process)
        return process

    def ready(self, status: str = "running") -> None:
        """Wait for the worker to be known to the scheduler: how long it takes to start is not what is tested."""
        deadline = time.monotonic() + 120
        with Client(scheduler_file=str(self.file), set_as_default=False) as client:
            while time.monotonic() < deadline:
                there = client.sync(client.scheduler.identity)["workers"].values()
                if there and all(one["status"] == status for one in there):
                    return
                time.sleep(0.05)
        raise AssertionError(f"no worker is {status}")

    def worker(self, **environment: str) -> None:
        self.start("worker", "--nthreads=1", "--no-nanny", f"--preload={self.orders.preload}", **environment)

    def end(self) -> None:
        for process in self.processes:
            process.kill()
            process.wait()


def values_of(path: Path) -> dict[str, bytes]:
    """Read all bytes of all variables."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        return {name: np.asarray(variable[...]).tobytes() for name, variable in file.variables.items()}
