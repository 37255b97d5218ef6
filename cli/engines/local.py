"""A Dask cluster of this machine for the time of a run, which nobody but this process can use."""

import logging
import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, Final

from gradhesion.cli.engines.scheduler import started
from gradhesion.cli.errors import ClusterError

SETTINGS: Final = {
    "distributed.scheduler.allowed-failures": 1,  # two lost workers are enough to suspect a block
    "distributed.scheduler.worker-saturation": 1.0,  # and it takes no other along that waits with its worker
    # Pages about the cluster, which need no certificate.
    "distributed.scheduler.http.routes": [],
    "distributed.worker.http.routes": [],
    # What Dask watches of itself took 8 % of a core; less often it takes 1 %.
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.tick.cycle": "5s",
    "distributed.admin.system-monitor.interval": "10s",
    "distributed.worker.profile.enabled": False,
}


@contextmanager
def local_client(workers: int | None, most: int) -> Iterator[Any]:
    """
    Make a client of worker processes of one thread each: so many, or one a core, and not more than `most`.

    They listen on the loopback interface alone, and to those alone who have a certificate that is made here and that
    no other user can read: on a machine with several users the others cannot run code as this one.

    Raises
    ------
    ClusterError
        They cannot be started.
    """
    import dask  # noqa: PLC0415
    from dask.system import CPU_COUNT  # noqa: PLC0415 (of this process, on every system)
    from distributed import LocalCluster, Security  # noqa: PLC0415

    with dask.config.set(SETTINGS), _without_sigint():
        try:
            cluster = LocalCluster(
                n_workers=min(workers or CPU_COUNT, most),
                threads_per_worker=1,
                host="127.0.0.1",
                security=Security.temporary(),
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
        with started(cluster) as client:
            yield client
    except BaseException:
        _kill(cluster)
        raise
    finally:
        with suppress(OSError, RuntimeError, TimeoutError):
            cluster.close(timeout=10.0)


@contextmanager
def _without_sigint() -> Iterator[None]:
    """Start threads and processes without Ctrl-C: the command has it, and ends them."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _kill(cluster: Any) -> None:
    """End workers at once, not after their block: a part is whole or not there."""
    for nanny in cluster.workers.values():
        nanny.auto_restart = False
        if nanny.pid:
            with suppress(OSError):
                os.kill(nanny.pid, getattr(signal, "SIGKILL", signal.SIGTERM))  # Windows has but the second
