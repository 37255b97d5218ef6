"""Blocks solved by the workers of a Dask cluster: the same bytes as by threads, whatever becomes of the workers."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import dask
import netCDF4
import numpy as np
import pytest
from click.testing import Result
from distributed import LocalCluster, get_worker

from gradhesion.cli.work.folder import folder_of

Call = Callable[..., Result]

PRELOAD = """
import json, os, signal, time
from pathlib import Path
import gradhesion.cli.work.blocks as blocks

blocks.CHUNK = 2
orders = Path({folder!r})
really = getattr(blocks.solve, "really", blocks.solve)  # it may be imported again

def solve(parameters, *arguments, **options):
    order = json.loads((orders / "order.json").read_text())
    (orders / f"{{os.getpid()}}.busy").touch()
    block = [round(float(parameters[name].flat[0]), 6) for name in ("k", "lambda_over_R")]
    if order.get("poison") == block:
        os.kill(os.getpid(), signal.SIGKILL)
    if order.get("broken") == block:
        raise MemoryError("no room")
    time.sleep(order.get("sleep", 0.0))
    return really(parameters, *arguments, **options)

blocks.solve, solve.really = solve, really
if "OTHER_NUMPY" in os.environ:
    import numpy
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


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


SETTINGS: dict[str, Any] = {
    "threads_per_worker": 1,
    "memory_limit": None,
    "dashboard_address": "127.0.0.1:0",
    "scheduler_kwargs": {"dashboard": False},
    "silence_logs": 60,
}


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
        for path in self.folder.glob("*.busy"):
            path.unlink()

    def busy(self) -> list[int]:
        """The processes that have begun a block."""
        return [int(path.stem) for path in self.folder.glob("*.busy")]


@pytest.fixture(scope="module")
def orders(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Orders]:
    """Orders that workers of this process's clusters obey."""
    orders = Orders(tmp_path_factory.mktemp("orders"))
    with dask.config.set(
        {
            "distributed.worker.preload": [str(orders.preload)],
            "distributed.scheduler.allowed-failures": 0,
            "distributed.worker.profile.enabled": False,
        }
    ):
        yield orders


@pytest.fixture(scope="module")
def cluster(orders: Orders) -> Iterator[LocalCluster]:
    """Two workers that stay."""
    orders.give()
    with LocalCluster(n_workers=2, **SETTINGS) as cluster:
        yield cluster


@pytest.fixture
def dask_run(gradhesion: Call, study_file: Path, cluster: LocalCluster, orders: Orders) -> Iterator[Call]:
    """Run the small study on the two workers."""

    def run(*arguments: str | Path) -> Result:
        return gradhesion("run", study_file, "--engine=dask", "--scheduler", cluster.scheduler_address, *arguments)

    orders.give()
    yield run
    orders.give()


@pytest.fixture
def whole(gradhesion: Call, study_file: Path, tmp_path: Path) -> dict[str, bytes]:
    """What threads give."""
    path = tmp_path / "whole.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return values_of(path)


@pytest.fixture
def output(tmp_path: Path) -> Path:
    return tmp_path / "data" / "out.nc"


def values_of(path: Path) -> dict[str, bytes]:
    """Read all bytes of all variables."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        return {name: np.asarray(variable[...]).tobytes() for name, variable in file.variables.items()}


def test_workers_give_the_bytes_of_threads(dask_run: Call, whole: dict[str, bytes], output: Path) -> None:
    result = dask_run("-o", output)
    assert result.exit_code == 0
    assert f"{output}: 24 scenes in" in result.stderr
    assert "reused" not in result.stderr
    assert values_of(output) == whole
    assert os.listdir(output.parent) == ["out.nc"]


def test_a_run_goes_on_with_the_other_engine(
    dask_run: Call, gradhesion: Call, study_file: Path, whole: dict[str, bytes], output: Path, orders: Orders
) -> None:
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/3").exit_code == 0
    events = [json.loads(line) for line in dask_run("-o", output, "--log-json").stderr.splitlines()]
    assert {name: events[-1][name] for name in ("event", "blocks_reused", "blocks_computed", "failed")} == {
        "event": "done",
        "blocks_reused": 2,
        "blocks_computed": 4,
        "failed": 0,
    }
    assert values_of(output) == whole
    assert len(orders.busy()) == 2, "both workers have worked"
    assert dask_run("-o", output, "--overwrite", "--quiet").stderr == ""


def test_a_killed_worker_loses_nothing(dask_run: Call, whole: dict[str, bytes], output: Path, orders: Orders) -> None:
    orders.give(sleep=0.3)
    killed = []

    def kill() -> None:
        deadline = time.monotonic() + 30
        while not orders.busy() and time.monotonic() < deadline:
            time.sleep(0.01)
        killed.append(orders.busy()[0])
        os.kill(killed[0], signal.SIGKILL)

    thread = threading.Thread(target=kill)
    thread.start()
    result = dask_run("-o", output)
    thread.join()
    assert result.exit_code == 0, result.stderr
    assert killed
    assert values_of(output) == whole


def test_a_block_that_kills_its_workers_takes_no_other_along(
    dask_run: Call, whole: dict[str, bytes], output: Path, orders: Orders
) -> None:
    orders.give(poison=[0.0, 0.47])
    result = dask_run("-o", output)
    assert result.exit_code == 3
    assert "block 3 of 6 (4 scenes, index k 0, lambda_over_R 2) raised KilledWorker" in result.stderr
    assert (
        "1 block could not be solved, and their scenes have no value; the parts of the others are kept" in result.stderr
    )
    assert len(folder_of(output).parts()) == 5
    orders.give()
    again = dask_run("-o", output, "--overwrite")
    assert again.exit_code == 0
    assert "reused 5 blocks, computed 1" in again.stderr
    assert values_of(output) == whole


def test_a_block_that_raises(dask_run: Call, gradhesion: Call, study_file: Path, output: Path, orders: Orders) -> None:
    orders.give(broken=[0.31, 0.11])
    failed = dask_run("-o", output, "--fail-fast")
    assert failed.exit_code == 3
    sentence = "block 4 of 6 (4 scenes, index k 1, lambda_over_R 0) raised MemoryError: no room"
    assert f"{output}: {sentence}; nothing is written" in failed.stderr
    assert not output.exists()
    result = dask_run("-o", output)
    assert result.exit_code == 3
    assert f"{output}: {sentence}\n" in result.stderr
    assert "reused 5 blocks, computed 1" in gradhesion("run", study_file, "-o", output, "--overwrite").stderr


def test_a_local_cluster_comes_and_goes(
    gradhesion: Call, study_file: Path, whole: dict[str, bytes], output: Path, orders: Orders
) -> None:
    orders.give()
    result = gradhesion("run", study_file, "-o", output, "--engine=dask", "--threads=1")
    assert result.exit_code == 0
    assert result.stderr.startswith(f"{output}: 24 scenes in"), "nothing of Dask's own is told"
    assert values_of(output) == whole
    (worker,) = orders.busy()
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


def test_workers_that_come_late_and_leave_early(
    gradhesion: Call, study_file: Path, whole: dict[str, bytes], output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gradhesion.cli.work import blocks

    really, seen = blocks.solve, set()

    def solve(*arguments: Any, **options: Any) -> dict[str, Any]:
        seen.add(get_worker().address)
        time.sleep(0.3)
        return really(*arguments, **options)

    monkeypatch.setattr(blocks, "solve", solve)
    monkeypatch.setattr("gradhesion.cli.engines.watch.LONELY", 0.2)
    monkeypatch.setattr("gradhesion.cli.engines.watch.PERIOD", 0.1)
    with (
        dask.config.set({"distributed.worker.preload": [], "distributed.deploy.lost-worker-timeout": "100ms"}),
        LocalCluster(n_workers=0, processes=False, lifetime="0.8s", **SETTINGS) as cluster,
    ):
        cluster.adapt(minimum=0, maximum=2, interval="300ms")
        scheduler = output.parent.parent / "scheduler.json"
        scheduler.write_text(json.dumps({"address": cluster.scheduler_address}))
        result = gradhesion("run", study_file, "-o", output, "--engine=dask", "--scheduler", scheduler)
    assert result.exit_code == 0, result.stderr
    assert "waiting for workers: there have been none for" in result.stderr
    assert len(seen) > 2, "each lives for two blocks or so"
    assert values_of(output) == whole


class ByHand:
    """A scheduler and workers that are started by hand."""

    def __init__(self, folder: Path, orders: Orders) -> None:
        self.file = folder / "scheduler.json"
        self.orders = orders
        self.processes: list[subprocess.Popen[bytes]] = []
        self.scheduler = self.start("scheduler", "--host=127.0.0.1", "--port=0", "--dashboard-address=127.0.0.1:0")

    def start(self, kind: str, *options: str, **environment: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "dask", kind, "--scheduler-file", str(self.file), "--no-dashboard", *options]
        process = subprocess.Popen(command, env=os.environ | environment, stderr=subprocess.DEVNULL)
        self.processes.append(process)
        return process

    def worker(self, **environment: str) -> None:
        self.start("worker", "--nthreads=1", "--no-nanny", f"--preload={self.orders.preload}", **environment)

    def end(self) -> None:
        for process in self.processes:
            process.kill()
            process.wait()


@pytest.fixture
def by_hand(tmp_path: Path, orders: Orders) -> Iterator[ByHand]:
    cluster = ByHand(tmp_path, orders)
    yield cluster
    cluster.end()


def test_workers_of_another_version_and_a_scheduler_that_goes(
    gradhesion: Call,
    study_file: Path,
    whole: dict[str, bytes],
    output: Path,
    by_hand: ByHand,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    command = ["run", study_file, "-o", output, "--engine=dask", "--scheduler", by_hand.file]
    by_hand.orders.give()
    by_hand.worker(OTHER_NUMPY="1")
    refused = gradhesion(*command)
    assert refused.exit_code == 2
    assert f"has numpy 1.0 instead of {np.__version__}; it gets no blocks" in refused.stderr
    assert "no worker can do the work: worker tcp://" in refused.stderr
    assert by_hand.orders.busy() == []

    by_hand.worker()
    deadline = time.monotonic() + 30
    while (result := gradhesion(*command)).exit_code == 2 and time.monotonic() < deadline:
        time.sleep(0.1)
    assert result.exit_code == 0, result.stderr
    assert "it gets no blocks" in result.stderr
    assert "24 scenes in" in result.stderr
    assert values_of(output) == whole

    monkeypatch.setattr("gradhesion.cli.engines.watch.SILENCE", 0.5)
    monkeypatch.setattr("gradhesion.cli.engines.watch.ANSWER", 0.5)
    monkeypatch.setattr("gradhesion.cli.engines.watch.PERIOD", 0.1)
    by_hand.orders.give(sleep=0.4)

    def kill() -> None:
        deadline = time.monotonic() + 30
        while not folder_of(output).parts() and time.monotonic() < deadline:
            time.sleep(0.01)
        by_hand.scheduler.kill()

    thread = threading.Thread(target=kill)
    thread.start()
    lost = gradhesion(*command, "--overwrite")
    thread.join()
    assert lost.exit_code == 4
    assert "--engine dask: the scheduler does not answer any more; finished parts are kept" in lost.stderr
    assert folder_of(output).parts()
    by_hand.orders.give()
    assert "reused" in gradhesion("run", study_file, "-o", output, "--overwrite").stderr
    assert values_of(output) == whole


def test_an_interrupt_ends_workers_and_keeps_parts(tmp_path: Path) -> None:
    study, output = tmp_path / "huge.toml", tmp_path / "data" / "huge.nc"
    study.write_text(HUGE)
    command = [sys.executable, "-m", "gradhesion.cli", "run", study, "-o", output, "--engine=dask"]
    folder = folder_of(output)
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True) as process:
        deadline = time.monotonic() + 120
        while not folder.parts() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)  # as the terminal does: to the workers as well
        stderr = process.communicate(timeout=60)[1]
    assert process.returncode == 130, stderr
    assert "Traceback" not in stderr
    kept = len(folder.parts())
    assert kept > 0
    assert f"kept in {output}.parts, and the same command goes on from there" in stderr.splitlines()[-1]
    assert not list(folder.path.glob("*.nc"))
    deadline = time.monotonic() + 10
    while time.monotonic() < deadline:
        try:
            os.killpg(process.pid, 0)
        except ProcessLookupError:
            break
        time.sleep(0.05)
    else:
        pytest.fail("a worker lives on")
    assert len(folder.parts()) <= kept + 2, "what the workers had in hand"


def test_mistakes(
    gradhesion: Call, study_file: Path, output: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gradhesion.cli.engines.connection.PATIENCE", 0.3)
    run = ["run", study_file, "-o", output]
    for arguments in (["--scheduler=tcp://127.0.0.1:9"], ["--engine=dask", "--scheduler=f", "--threads=2"]):
        result = gradhesion(*run, *arguments)
        assert result.exit_code == 2
        assert "--scheduler goes with --engine dask, and without --threads" in result.stderr
    for scheduler, sentence in (
        ("tcp://127.0.0.1:9", "no Dask scheduler answers"),
        ("nonsense://1", "no Dask scheduler answers"),
        (str(tmp_path / "none.json"), "neither an address, as tcp://host:8786, nor the file of a scheduler"),
    ):
        result = gradhesion(*run, "--engine=dask", "--scheduler", scheduler)
        assert result.exit_code == 2, result.stderr
        assert f"--scheduler {scheduler}: {sentence}" in result.stderr
    monkeypatch.setitem(sys.modules, "distributed", None)
    result = gradhesion(*run, "--engine=dask")
    assert result.exit_code == 2
    assert result.stderr.endswith("--engine dask needs Dask: install it with `pip install 'gradhesion[cluster]'`\n")
    assert not list(output.parent.glob("*"))


def test_one_block_needs_no_cluster(
    gradhesion: Call, study_file: Path, output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", "100")
    result = gradhesion("run", study_file, "-o", output, "--engine=dask")
    assert result.exit_code == 0
    assert "the study is of one block or of curves, and is solved in this process" in result.stderr
