"""Blocks solved by the workers of a Dask cluster: the same bytes as by threads, whatever becomes of the workers."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import dask
import pytest
from distributed import LocalCluster

from gradhesion.cli.work.folder import folder_of, parts_in
from tests.cli.conftest import Call, Patch
from tests.faults.trials import values_of

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("small_blocks")]
Cluster = Callable[[int], str]

PRELOAD = """
import os, signal, time
from pathlib import Path
import gradhesion.cli.work.cluster as cluster
import gradhesion.cli.work.folder as folder

order = Path({folder!r})
really = getattr(cluster.solve_block, "really", cluster.solve_block)  # it may be imported again

def solve_block(study, block, threads):
    if (order / "die").exists():
        (order / "die").unlink()
        os.kill(os.getpid(), signal.SIGKILL)
    if (order / "always_die").exists():
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.05)
    return really(study, block, threads)

cluster.solve_block, solve_block.really = solve_block, really
if (order / "other_version").exists():
    cluster.versions = lambda: folder.versions() | {{"numba": "0.0"}}
"""
"""Workers that suffer what files tell them to."""


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    """Start workers that obey, and give the address of their scheduler."""
    preload = tmp_path / "preload.py"
    preload.write_text(PRELOAD.format(folder=str(tmp_path)))
    how = {"threads_per_worker": 1, "memory_limit": None, "dashboard_address": ":0", "silence_logs": 60}
    own = {"distributed.worker.preload": [str(preload)], "distributed.scheduler.allowed-failures": 1}
    with dask.config.set(own), ExitStack() as made:

        def started(workers: int) -> str:
            cluster = made.enter_context(LocalCluster(n_workers=workers, **how))
            made.callback(cluster.wait_for_workers, workers, 60)  # none is closed while it is started again
            return str(cluster.scheduler_address)

        yield started


def test_workers_give_the_bytes_of_threads_and_what_dies_is_replaced(
    gradhesion: Call, study_file: Path, whole: dict[str, bytes], tmp_path: Path, cluster: Cluster
) -> None:
    """By address, by the file of a scheduler, on what another engine has left, and with a worker that is killed."""
    output, file = tmp_path / "data" / "out.nc", tmp_path / "scheduler.json"
    address = cluster(2)
    file.write_text(json.dumps({"address": address}))
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/3").exit_code == 0
    (tmp_path / "die").touch()
    result = gradhesion("run", study_file, "-o", output, "--engine", "dask", "--scheduler", address, code=0)
    assert "reused 2 blocks, computed 4" in result.stderr
    assert not (tmp_path / "die").exists()
    assert values_of(output) == whole
    again = ("--overwrite", "--engine=dask", "--scheduler", file, "--quiet")
    assert gradhesion("run", study_file, "-o", output, *again, code=0).stderr == ""
    assert values_of(output) == whole
    assert os.listdir(output.parent) == ["out.nc"]


@pytest.mark.parametrize(("what", "code"), [("always_die", 4), ("other_version", 2)])
def test_workers_that_cannot_do_it_end_the_run(
    what: str, code: int, gradhesion: Call, study_file: Path, tmp_path: Path, cluster: Cluster
) -> None:
    (tmp_path / what).touch()
    address, output = cluster(1), tmp_path / "data" / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/3").exit_code == 0
    result = gradhesion("run", study_file, "-o", output, "--engine", "dask", "--scheduler", address, code=code)
    assert result.stderr.startswith("--engine dask: ")
    assert len(parts_in(folder_of(output))) == 2, "what was there stays"


@pytest.mark.parametrize("scheduler", ["tcp://127.0.0.1:9", "none.json", "/dev/null", "no dask"])
def test_no_scheduler_or_no_dask_is_said(
    scheduler: str, gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: Patch
) -> None:
    command = ["run", study_file, "-o", tmp_path / "data" / "out.nc", "--engine=dask"]
    if no_dask := scheduler == "no dask":
        monkeypatch.setitem(sys.modules, "distributed", None)
    else:
        command += ["--scheduler", scheduler]
    with dask.config.set({"distributed.comm.timeouts.connect": "1s"}):
        assert ("pip install dask" if no_dask else scheduler) in gradhesion(*command, code=2).stderr
    monkeypatch.setenv("GRADHESION_CHUNK", "100")
    gradhesion(*command, code=2 if no_dask else 0)  # one block needs no cluster


def test_an_interrupt_ends_the_workers_of_this_machine_and_keeps_blocks(study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "data" / "out.nc"
    larger = ["--set", "parameters.A={start=0, stop=0.02, num=3000}"]
    command = [sys.executable, "-m", "gradhesion.cli", "run", study_file, "-o", output, "--engine=dask", *larger]
    folder = folder_of(output)
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True) as process:
        deadline = time.monotonic() + 120
        while not parts_in(folder) and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)  # as the terminal does: to the workers as well
        stderr = process.communicate(timeout=60)[1]
    assert process.returncode == 130, stderr
    assert "Traceback" not in stderr
    assert parts_in(folder)
    assert "the same command resumes" in stderr.splitlines()[-1]
    assert not list(folder.glob("*.nc"))
    time.sleep(2.0)
    with pytest.raises(ProcessLookupError):
        os.killpg(process.pid, 0)
