"""A cluster of this machine: it comes and goes, hears Ctrl-C at once, and serves nobody else."""

import asyncio
import os
import signal
import subprocess
import sys
import threading
import time
from itertools import product
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import urlopen

import dask
import psutil
import pytest
from dask.system import CPU_COUNT
from distributed import Scheduler, Security
from distributed.comm import CommClosedError, connect

from gradhesion.cli.engines.local import local_client
from gradhesion.cli.work.parts.folder import folder_of
from tests.cli.engines.orders import HUGE, Call, Orders, values_of

pytestmark = pytest.mark.slow


def listening() -> set[tuple[str, int]]:
    """The addresses at which this process and those that it has started listen."""
    processes = [psutil.Process(), *psutil.Process().children(recursive=True)]
    sockets = [socket for process in processes for socket in process.net_connections("inet")]
    return {(socket.laddr.ip, socket.laddr.port) for socket in sockets if socket.status == psutil.CONN_LISTEN}


def test_it_listens_on_the_loopback_and_to_its_own_certificate_alone() -> None:
    """On a login node every user reaches the ports of the loopback; Dask runs the code of whoever gets through."""

    async def knock(address: str, security: Security | None) -> Any:
        arguments = security.get_connection_args("client") if security else {}
        comm = await connect(address, timeout="60s", **arguments)
        await comm.write({"op": "identity", "reply": True})
        try:
            return (await comm.read())["type"]
        finally:
            comm.abort()

    before = listening()
    with local_client(2, 2) as client:
        opened = listening() - before
        assert {ip for ip, _ in opened} == {"127.0.0.1"}
        own, stranger = client.security, Security.temporary()
        servers = {client.scheduler.address, *client.nthreads(), *(n.address for n in client.cluster.workers.values())}
        found = [asyncio.run(knock(address, own)) for address in servers]
        assert sorted(found) == ["Nanny", "Nanny", "Scheduler", "Worker", "Worker"]
        for address in servers:
            with pytest.raises(CommClosedError, match="TLS certificate does not match"):
                asyncio.run(knock(address, stranger))
            with pytest.raises(CommClosedError, match="in <TCP"):
                asyncio.run(knock(address.replace("tls", "tcp"), None))

        pages = {port for _, port in opened} - {int(address.rpartition(":")[2]) for address in servers}
        assert len(pages) == 3, "of the scheduler and the workers; Dask leaves no choice but of what they show"
        for port, page in product(pages, ("", "info/main/workers.html", "json/counts.json", "metrics", "health")):
            with pytest.raises(HTTPError, match="404"):
                urlopen(f"http://127.0.0.1:{port}/{page}", timeout=60)


def test_the_cores_are_counted_on_every_system(
    gradhesion: Call, study_file: Path, output: Path, orders: Orders, monkeypatch: pytest.MonkeyPatch
) -> None:
    orders.give()
    for name in ("sched_getaffinity", "process_cpu_count"):  # which macOS has not, nor older Pythons
        monkeypatch.delattr(os, name, raising=False)
    result = gradhesion("run", study_file, "-o", output, "--engine=dask")
    assert result.exit_code == 0, result.stderr


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


def test_a_clock_that_is_set_forward_loses_nothing(
    gradhesion: Call,
    study_file: Path,
    whole: dict[str, bytes],
    output: Path,
    orders: Orders,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Dask then takes every worker for one that has been silent for days, and starts them anew."""
    restarted: list[str] = []
    restart, check = Scheduler.restart_workers, Scheduler.check_worker_ttl

    async def restarting(self: Scheduler, workers: list[str], **options: Any) -> Any:
        restarted.extend(workers)
        orders.give()
        return await restart(self, workers, **options)

    async def late_check(self: Scheduler) -> None:
        if orders.busy() and not restarted:
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr("distributed.scheduler.time", lambda: time.time() + 1e6)
                await check(self)

    monkeypatch.setattr(Scheduler, "restart_workers", restarting)
    monkeypatch.setattr(Scheduler, "check_worker_ttl", late_check)
    orders.give(once=True)  # and the second block waits for the restart
    with dask.config.set({"distributed.scheduler.worker-ttl": "1s"}):
        result = gradhesion("run", study_file, "-o", output, "--engine=dask", "--threads=1")
    assert result.exit_code == 0, result.stderr
    assert restarted
    assert values_of(output) == whole


def test_workers_that_all_die_end_the_run_and_lose_nothing(
    gradhesion: Call,
    study_file: Path,
    whole: dict[str, bytes],
    output: Path,
    orders: Orders,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Every worker is killed at its second block, and whatever is started in its place ends at once."""
    monkeypatch.setattr("gradhesion.cli.engines.cluster.DESERTED_HERE", 3.0)
    monkeypatch.setattr("gradhesion.cli.engines.watch.LONELY", 0.0)
    orders.give(once=True)
    folder = folder_of(output)

    def end() -> None:
        deadline = time.monotonic() + 60
        while not folder.parts() and time.monotonic() < deadline:
            time.sleep(0.01)
        orders.no_more()

    thread = threading.Thread(target=end)
    thread.start()
    result = gradhesion("run", study_file, "-o", output, "--engine=dask", "--threads=1")
    thread.join()
    assert result.exit_code == 4, result.stderr
    first, *_, last = result.stderr.splitlines()
    assert first.endswith("waiting for workers; without any for 3 s the run ends")
    assert last == (
        "--engine dask: no worker has been connected for 3 s; finished parts are kept, and the same command resumes once "
        "there are workers"
    )
    kept = len(folder.parts())
    assert 0 < kept < 6
    assert not output.exists()
    orders.give()
    assert f"reused {kept} block" in gradhesion("run", study_file, "-o", output).stderr
    assert values_of(output) == whole


def test_an_interrupt_ends_workers_and_keeps_parts(tmp_path: Path) -> None:
    study, output = tmp_path / "huge.toml", tmp_path / "data" / "huge.nc"
    study.write_text(HUGE)
    command = [sys.executable, "-m", "gradhesion.cli", "run", study, "-o", output, "--engine=dask", "--chunk=131072"]
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
    assert f"kept in {output}.parts, and the same command resumes" in stderr.splitlines()[-1]
    assert not list(folder.path.glob("*.nc"))
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        try:
            os.killpg(process.pid, 0)
        except ProcessLookupError:
            break
        time.sleep(0.05)
    else:
        pytest.fail("a worker lives on")
    assert len(folder.parts()) <= kept + CPU_COUNT, "what the workers had in hand"
