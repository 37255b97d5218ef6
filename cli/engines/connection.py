"""The way to a Dask cluster: one that runs somewhere, or one of this machine for the time of a run."""

import json
import logging
import os
import signal
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Final

from gradhesion.cli import interrupts
from gradhesion.cli.errors import ClusterError, MissingExtraError

PATIENCE: Final = 10.0
"""Seconds for a scheduler to answer, or to write its file."""

SETTINGS: Final = {
    "distributed.scheduler.allowed-failures": 1,  # two workers lost are enough to suspect a block
    "distributed.comm.timeouts.connect": "10s",
    # What Dask watches of itself took 8 % of a core; less often it takes 1 %.
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.tick.cycle": "5s",
    "distributed.admin.system-monitor.interval": "10s",
    "distributed.worker.profile.enabled": False,
}
"""Of a local cluster."""


def require_dask() -> None:
    """
    Make sure that Dask is there.

    Raises
    ------
    MissingExtraError
        It is not.
    """
    try:
        import distributed  # noqa: F401, PLC0415 (half a second, and not always there)
    except ModuleNotFoundError as error:
        if error.name not in {"dask", "distributed"}:
            raise
        raise MissingExtraError(
            "--engine dask needs Dask: install it with `pip install 'gradhesion[cluster]'`"
        ) from None


@contextmanager
def connected(scheduler: str | None, workers: int) -> Iterator[Any]:
    """
    Give a client of the cluster at an address or of a scheduler file, or of a local one of some workers.

    Raises
    ------
    ClusterError
        No scheduler answers, or none can be started.
    """
    from distributed import Client  # noqa: PLC0415
    from distributed.versions import VersionMismatchWarning  # noqa: PLC0415

    logger = logging.getLogger("distributed")
    level = logger.level
    logger.setLevel(logging.CRITICAL + 1)  # what goes wrong there is told here, once
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", VersionMismatchWarning)  # workers are looked at one by one
            if scheduler is None:
                with _local(workers) as cluster, Client(cluster, set_as_default=False) as client:
                    yield client
            else:
                with _client(scheduler) as client:
                    yield client
    finally:
        logger.setLevel(level)


def _client(scheduler: str) -> Any:
    """Connect to a scheduler."""
    from distributed import Client  # noqa: PLC0415

    address = scheduler if "://" in scheduler else _address_in(Path(scheduler))
    try:
        return Client(address, timeout=PATIENCE, set_as_default=False, name="gradhesion")
    except (OSError, ValueError, RuntimeError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise ClusterError(
            f"--scheduler {scheduler}: no Dask scheduler answers ({reason}); start one with `dask scheduler`, or "
            "leave --scheduler out for a cluster of this machine"
        ) from None


def _address_in(path: Path) -> str:
    """Read the file that a scheduler writes; one that has just been started is waited for."""
    deadline = time.monotonic() + PATIENCE
    while True:
        with suppress(OSError, ValueError, KeyError, TypeError):
            return str(json.loads(path.read_bytes())["address"])
        if time.monotonic() > deadline:
            raise ClusterError(
                f"--scheduler {path}: neither an address, as tcp://host:8786, nor the file of a scheduler; "
                f"write one with `dask scheduler --scheduler-file {path}`"
            )
        interrupts.check()
        time.sleep(0.1)


@contextmanager
def _local(workers: int) -> Iterator[Any]:
    """Run a cluster on this machine: a process a worker, each of one thread."""
    import dask  # noqa: PLC0415
    from distributed import LocalCluster  # noqa: PLC0415

    with dask.config.set(SETTINGS), _without_sigint():
        try:
            cluster = LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                scheduler_kwargs={"dashboard": False},
                memory_limit=None,  # as for threads, that is for the system
                silence_logs=logging.CRITICAL,
            )
        except (OSError, RuntimeError) as error:
            raise ClusterError(
                f"--engine dask: no cluster can be started on this machine ({error}); use --engine threads"
            ) from error
    try:
        yield cluster
    except BaseException:
        _kill(cluster)
        raise
    finally:
        with suppress(OSError, RuntimeError, TimeoutError):
            cluster.close(timeout=PATIENCE)


@contextmanager
def _without_sigint() -> Iterator[None]:
    """Start threads and processes that never hear Ctrl-C: it is for the command, which tells them to end."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _kill(cluster: Any) -> None:
    """End workers at once: a part is whole or not there, so nothing is to be waited for."""
    for nanny in cluster.workers.values():
        nanny.auto_restart = False
        if nanny.pid:
            with suppress(OSError):
                os.kill(nanny.pid, signal.SIGKILL)
