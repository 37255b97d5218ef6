"""Blocks solved by the workers of a Dask cluster: the same bytes as by threads, whatever becomes of the workers."""

import json
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import dask
import pytest
from click.testing import Result
from distributed import LocalCluster, get_worker

from gradhesion.cli.work.parts.folder import folder_of
from tests.cli.engines.orders import ByHand, Call, Orders, values_of

pytestmark = pytest.mark.slow

SETTINGS: dict[str, Any] = {
    "threads_per_worker": 1,
    "memory_limit": None,
    "dashboard_address": "127.0.0.1:0",
    "scheduler_kwargs": {"dashboard": False},
    "silence_logs": 60,
}


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
    orders.give(together=2)
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
    orders.give(first_dies=True)
    result = dask_run("-o", output)
    assert result.exit_code == 0, result.stderr
    assert (orders.folder / "died").exists()
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


@pytest.mark.skipif(sys.platform != "linux", reason="limits the memory of a process as Linux does")
def test_a_worker_without_memory_loses_its_block_alone(
    dask_run: Call, whole: dict[str, bytes], output: Path, orders: Orders
) -> None:
    """An array of 1 GiB where 64 MiB are left."""
    orders.give(hungry=[0.31, 0.11])
    result = dask_run("-o", output)
    assert result.exit_code == 3
    assert "block 4 of 6 (4 scenes, index k 1, lambda_over_R 0) raised" in result.stderr
    assert "Unable to allocate 1.00 GiB" in result.stderr
    orders.give()
    assert "reused 5 blocks, computed 1" in dask_run("-o", output, "--overwrite").stderr
    assert values_of(output) == whole


def test_workers_that_die_one_after_the_other_end_the_run(
    gradhesion: Call, study_file: Path, output: Path, tmp_path: Path, orders: Orders, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Dask ends a worker whose memory limit is below what the program itself takes, and starts it anew, without end."""
    monkeypatch.setattr("gradhesion.cli.engines.watch.FRUITLESS", -3)
    monkeypatch.setattr("gradhesion.cli.engines.watch.PERIOD", 0.2)
    cluster = ByHand(tmp_path, orders)
    try:
        cluster.start("worker", "--nthreads=1", "--memory-limit=160MB")
        result = gradhesion("run", study_file, "-o", output, "--engine=dask", "--scheduler", cluster.file)
    finally:
        cluster.end()
    assert result.exit_code == 4, result.stderr
    assert result.stderr.splitlines()[-1].endswith(
        "workers have started and ended since the last finished block; give them the memory and the time that `gradhesion "
        "plan` shows; finished parts are kept, and the same command resumes"
    )


def test_workers_that_are_paused_end_the_run(
    gradhesion: Call, study_file: Path, output: Path, tmp_path: Path, orders: Orders, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Dask gives nothing to a worker that has 80 % of its memory in use, and would wait without end."""
    monkeypatch.setattr("gradhesion.cli.engines.cluster.DESERTED", 2.0)
    monkeypatch.setattr("gradhesion.cli.engines.watch.LONELY", 0.0)
    monkeypatch.setattr("gradhesion.cli.engines.watch.PERIOD", 0.2)
    shares = {"PAUSE": "0.01", "TERMINATE": "False", "SPILL": "False", "TARGET": "False"}
    cluster = ByHand(tmp_path, orders)
    try:
        cluster.start(
            "worker", "--nthreads=1", "--memory-limit=1GB",
            **{f"DASK_DISTRIBUTED__WORKER__MEMORY__{name}": share for name, share in shares.items()},
        )  # fmt: skip
        cluster.ready("paused")
        result = gradhesion("run", study_file, "-o", output, "--engine=dask", "--scheduler", cluster.file)
    finally:
        cluster.end()
    assert result.exit_code == 4, result.stderr
    assert "because Dask has paused all workers for lack of memory; after 2 s the run ends" in result.stderr
    assert result.stderr.splitlines()[-1].endswith(
        "Dask has paused all workers (1) for lack of memory for 2 s; give them the memory that `gradhesion plan` shows; "
        "finished parts are kept, and the same command resumes"
    )


def test_workers_that_come_late_and_leave_early(
    gradhesion: Call, study_file: Path, whole: dict[str, bytes], output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gradhesion.cli.work.solve import given

    really, seen = given.solve, set()

    def solve(*arguments: Any, **options: Any) -> dict[str, Any]:
        seen.add(get_worker().address)
        time.sleep(0.3)
        return really(*arguments, **options)

    monkeypatch.setattr(given, "solve", solve)
    monkeypatch.setattr("gradhesion.cli.engines.watch.LONELY", 0.2)
    monkeypatch.setattr("gradhesion.cli.engines.watch.PERIOD", 0.1)
    with (
        dask.config.set({"distributed.worker.preload": [], "distributed.deploy.lost-worker-timeout": "100ms"}),
        LocalCluster(n_workers=0, processes=False, lifetime="0.8s", **SETTINGS) as cluster,
    ):
        cluster.adapt(minimum=0, maximum=1, interval="300ms")
        scheduler = output.parent.parent / "scheduler.json"
        scheduler.write_text(json.dumps({"address": cluster.scheduler_address}))
        result = gradhesion("run", study_file, "-o", output, "--engine=dask", "--scheduler", scheduler)
    assert result.exit_code == 0, result.stderr
    assert "waiting for workers" in result.stderr
    assert len(seen) > 1, "the first left before all was done"
    assert values_of(output) == whole


def test_one_block_needs_no_cluster(
    gradhesion: Call, study_file: Path, output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", "100")
    result = gradhesion("run", study_file, "-o", output, "--engine=dask")
    assert result.exit_code == 0
    assert "the study has one block or consists of curves, and is solved in this process" in result.stderr
