"""Schedulers that do not answer, that serve workers of other versions, and that are lost."""

import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import dask
import numpy as np
import pytest
from distributed import Client

from gradhesion.cli.engines.scheduler import client_of
from gradhesion.cli.engines.watch import Watch
from gradhesion.cli.errors import ClusterError
from gradhesion.cli.work.parts.folder import folder_of
from tests.cli.engines.orders import HUGE, ByHand, Call, Orders, values_of

pytestmark = pytest.mark.slow


def test_workers_of_another_version(
    gradhesion: Call,
    study_file: Path,
    whole: dict[str, bytes],
    output: Path,
    by_hand: ByHand,
) -> None:
    command = ["run", study_file, "-o", output, "--engine=dask", "--scheduler", by_hand.file]
    by_hand.orders.give()
    by_hand.worker(OTHER_NUMPY="1")
    refused = gradhesion(*command)
    assert refused.exit_code == 2
    assert f"has numpy 1.0 instead of {np.__version__}; it gets no blocks" in refused.stderr
    assert "no worker is usable: worker tcp://" in refused.stderr
    assert by_hand.orders.busy() == []

    by_hand.worker()
    deadline = time.monotonic() + 120
    while (result := gradhesion(*command)).exit_code == 2 and time.monotonic() < deadline:
        time.sleep(0.1)
    assert result.exit_code == 0, result.stderr
    assert "it gets no blocks" in result.stderr
    assert "24 scenes in" in result.stderr
    assert values_of(output) == whole


@pytest.mark.parametrize(
    ("method", "call", "pause", "end"),
    [
        ("submit", 1, 0.0, signal.SIGKILL),
        ("submit", 4, 1.0, signal.SIGKILL),  # when its client has given up
        ("sync", 2, 0.0, signal.SIGKILL),
        ("sync", 5, 1.0, signal.SIGKILL),
        ("sync", 5, 0.0, signal.SIGSTOP),  # connected, and silent
    ],
)
def test_a_scheduler_that_is_lost(
    gradhesion: Call,
    study_file: Path,
    whole: dict[str, bytes],
    output: Path,
    by_hand: ByHand,
    monkeypatch: pytest.MonkeyPatch,
    method: str,
    call: int,
    pause: float,
    end: signal.Signals,
) -> None:
    """The same sentence wherever the client has just been: it ends before the nth call of a method."""
    by_hand.orders.give(sleep=0.2)
    by_hand.worker()
    by_hand.ready()
    really, calls = getattr(Client, method), []

    def killing(self: Client, *arguments: Any, **options: Any) -> Any:
        calls.append(None)
        if len(calls) == call:
            by_hand.scheduler.send_signal(end)
            if end == signal.SIGKILL:
                by_hand.scheduler.wait()
            time.sleep(pause)
        return really(self, *arguments, **options)

    monkeypatch.setattr(Client, method, killing)
    monkeypatch.setattr("gradhesion.cli.engines.watch.PERIOD", 0.1)
    with dask.config.set({"distributed.comm.timeouts.connect": "500ms"}):
        lost = gradhesion("run", study_file, "-o", output, "--engine=dask", "--scheduler", by_hand.file)
    assert lost.exit_code == 4, lost.stderr
    assert [line for line in lost.stderr.splitlines() if not line.startswith("waiting")] == [
        (
            "--engine dask: the scheduler no longer answers; finished parts are kept, and the same command resumes once a "
            "scheduler is available"
        )
    ]
    assert not output.exists()
    by_hand.orders.give()
    assert gradhesion("run", study_file, "-o", output).exit_code == 0
    assert values_of(output) == whole


@pytest.mark.parametrize("whose", ["client", "scheduler"])
def test_a_scheduler_that_no_worker_is_left_for(
    whose: str,
    gradhesion: Call,
    study_file: Path,
    whole: dict[str, bytes],
    output: Path,
    tmp_path: Path,
    orders: Orders,
) -> None:
    """The seconds are Dask's own setting: of this command, or of the scheduler, which then ends the tasks itself."""
    timeout = {"DASK_DISTRIBUTED__SCHEDULER__NO_WORKERS_TIMEOUT": "1s"} if whose == "scheduler" else {}
    cluster = ByHand(tmp_path, orders, **timeout)
    try:
        orders.give(once=True)
        cluster.worker()
        cluster.ready()

        def end() -> None:
            deadline = time.monotonic() + 60
            while not folder_of(output).parts() and time.monotonic() < deadline:
                time.sleep(0.01)
            orders.no_more()

        thread = threading.Thread(target=end)
        thread.start()
        with dask.config.set({} if timeout else {"distributed.scheduler.no-workers-timeout": "2s"}):
            alone = gradhesion("run", study_file, "-o", output, "--engine=dask", "--scheduler", cluster.file)
        thread.join()
    finally:
        cluster.end()
    assert alone.exit_code == 4, alone.stderr
    assert alone.stderr.splitlines()[-1] == (
        f"--engine dask: no worker has been connected for {1 if timeout else 2} s; finished parts are kept, and the "
        "same command resumes once there are workers"
    )
    assert 0 < len(folder_of(output).parts()) < 6
    orders.give()
    assert gradhesion("run", study_file, "-o", output).exit_code == 0
    assert values_of(output) == whole


def test_a_block_whose_worker_is_lost_before_it_is_looked_at(
    gradhesion: Call,
    study_file: Path,
    whole: dict[str, bytes],
    output: Path,
    by_hand: ByHand,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Dask takes back then that its task is done, and has it wait for another worker; the part is there all the same."""
    by_hand.orders.give(once=True)
    by_hand.worker()
    by_hand.ready()
    really, calls = Watch.moved, []

    def losing(self: Watch) -> None:
        really(self)
        calls.append(None)
        if len(calls) == 2:  # the first is that of the beginning
            by_hand.orders.no_more()
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline and all(one.status != "lost" for one in states(self._client)):
                time.sleep(0.01)
            assert [one.status for one in states(self._client)].count("lost") == 1

    def states(client: Client) -> list[Any]:
        return [*client.futures.values()]

    monkeypatch.setattr(Watch, "moved", losing)
    with dask.config.set({"distributed.scheduler.no-workers-timeout": "2s"}):
        alone = gradhesion("run", study_file, "-o", output, "--engine=dask", "--scheduler", by_hand.file)
    assert alone.exit_code == 4, alone.stderr
    assert "--engine dask: no worker has been connected for 2 s; finished parts are kept" in alone.stderr
    assert len(folder_of(output).parts()) == 1
    by_hand.orders.give()
    again = gradhesion("run", study_file, "-o", output)
    assert again.exit_code == 0
    assert "reused 1 block, computed 5" in again.stderr
    assert values_of(output) == whole


def test_an_interrupt_takes_back_what_waits(tmp_path: Path, output: Path, by_hand: ByHand) -> None:
    study = tmp_path / "huge.toml"
    study.write_text(HUGE)
    by_hand.orders.give(once=True)
    by_hand.worker()
    command = [sys.executable, "-m", "gradhesion.cli", "run", study, "-o", output, "--engine=dask", "--quiet"]
    command += ["--chunk=131072"]  # 600 blocks
    with subprocess.Popen([*command, "--scheduler", by_hand.file], stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 120
        while not folder_of(output).parts() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        stderr = process.communicate(timeout=60)[1]
    assert process.returncode == 130, stderr
    assert stderr.strip().startswith("interrupted; ")
    assert "Traceback" not in stderr
    by_hand.orders.give()
    with Client(scheduler_file=str(by_hand.file), set_as_default=False) as client:
        deadline = time.monotonic() + 60
        while any(client.processing().values()) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert not any(client.processing().values())
    assert len(folder_of(output).parts()) <= 2, "of 600: what was in hand has been finished, the rest taken back"


def test_mistakes(
    gradhesion: Call, study_file: Path, output: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = ["run", study_file, "-o", output]
    for arguments in (["--scheduler=tcp://127.0.0.1:9"], ["--engine=dask", "--scheduler=f", "--threads=2"]):
        result = gradhesion(*run, *arguments)
        assert result.exit_code == 2
        assert "--scheduler needs --engine dask, without --threads" in result.stderr
    for scheduler, sentence in (
        ("tcp://127.0.0.1:9", "no Dask scheduler answers"),
        ("nonsense://1", "no Dask scheduler answers"),
        ("tcp://127.0.0.1", "no Dask scheduler answers"),
        ("tls://127.0.0.1:9", "no Dask scheduler answers"),  # without a certificate
        (str(tmp_path / "none.json"), "neither an address, such as tcp://host:8786, nor the file of a scheduler"),
    ):
        with dask.config.set({"distributed.comm.timeouts.connect": "300ms"}):
            result = gradhesion(*run, "--engine=dask", "--scheduler", scheduler)
        assert result.exit_code == 2, result.stderr
        assert f"--scheduler {scheduler}: {sentence}" in result.stderr
    for package in ("cryptography", "distributed"):
        monkeypatch.setitem(sys.modules, package, None)
        result = gradhesion(*run, "--engine=dask")
        assert result.exit_code == 2
        assert result.stderr.endswith(
            "--engine dask needs Dask: install it with `pip install dask distributed cryptography`\n"
        )
    assert not list(output.parent.glob("*"))


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense://1", "tcp://127.0.0.1", "tls://127.0.0.1:9"])
def test_a_client_that_does_not_start_is_closed(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One that is left open is closed by the collector, in any thread; that of the next client can then not go on."""
    made: list[Client] = []
    start = Client.start

    def starting(self: Client, **options: Any) -> None:
        made.append(self)
        start(self, **options)

    monkeypatch.setattr(Client, "start", starting)
    with (
        dask.config.set({"distributed.comm.timeouts.connect": "300ms"}),
        pytest.raises(ClusterError, match=f"--scheduler {address}: no Dask scheduler answers"),
    ):
        client_of(address)
    assert [client.status for client in made] == ["closed"]
