"""The blocks of a study solved by the workers of a Dask cluster, on this machine or elsewhere.

A worker gets the study once, and the number of a block at a time; it returns the values, which are kept and written
here, so that it needs no file system of ours. A block whose worker is lost is solved by another one.
"""

import json
import logging
import pickle
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from itertools import islice
from pathlib import Path
from typing import Any, Final

from gradhesion.cli.errors import GradhesionError, MissingExtraError, OutputError, SetupError
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import interrupts, messages
from gradhesion.cli.work.compiling import prepare
from gradhesion.cli.work.folder import versions
from gradhesion.cli.work.solve.blocks import Engine, solve_block
from gradhesion.cli.work.solve.scenes import Arrays

AHEAD: Final = 3
"""Blocks with the scheduler for each thread of the workers, so that none waits for this process."""
LEAST: Final = 16
"""The same at least: a cluster that adapts sees what is to be done."""


def on_cluster(scheduler: str | None = None, workers: int | None = None) -> Engine:
    """Have blocks solved by the workers of a scheduler (its address or its file), or by processes of this machine.

    MissingExtraError: there is no Dask. The engine raises SetupError where no scheduler answers or a worker has another
    version, and OutputError where the cluster is lost.
    """
    try:
        import cryptography  # noqa: F401, PLC0415 (for a cluster of this machine that is closed to others)
        import distributed  # noqa: F401, PLC0415 (half a second, and not always there)
    except ModuleNotFoundError:
        raise MissingExtraError("--engine dask needs Dask: pip install dask distributed cryptography") from None

    def engine(study: Study, numbers: Sequence[int]) -> Iterator[tuple[int, Arrays]]:
        if not numbers:
            return
        with _client(scheduler, workers, len(numbers)) as client:
            if not client.nthreads():
                messages.note("--engine dask: the scheduler has no workers yet; waiting for them")
            try:
                yield from _solved(client, study, numbers)
            except GradhesionError:
                raise
            except Exception as error:
                # Dask has a dozen exceptions for a lost scheduler, a worker that dies, and what cannot be loaded.
                interrupts.check()
                remedy = "finished blocks are kept, and the same command resumes on a cluster with enough memory"
                raise OutputError(f"--engine dask: {type(error).__name__}: {error}; {remedy}") from error

    return engine


def _solved(client: Any, study: Study, numbers: Sequence[int]) -> Iterator[tuple[int, Arrays]]:
    """Give the values of blocks as they come, of which a bounded number is with the scheduler."""
    from distributed import as_completed  # noqa: PLC0415

    there = client.submit(pickle.loads, pickle.dumps(study), pure=False)  # a task, which is done again if it is lost
    waiting, running = iter(numbers), as_completed(loop=client.loop)

    def submit(many: int) -> None:
        for number in islice(waiting, max(0, many)):
            key = (f"gradhesion-{client.id}", number)
            running.add(client.submit(solve_there, there, number, versions(), key=key, pure=False))

    submit(LEAST)
    for future in running:
        number, values = future.result()
        future.release()
        submit(max(LEAST, AHEAD * sum(client.nthreads().values())) - running.count())
        yield number, values


def solve_there(study: Study, number: int, needed: dict[str, Any]) -> tuple[int, Arrays]:
    """Solve a block, as a worker does, on one thread; SetupError where its versions may round another way."""
    if (own := versions()) != needed:
        differing = ", ".join(name for name in own if own[name] != needed.get(name))
        remedy = "start workers in the environment of this command"
        raise SetupError(f"--engine dask: a worker has another version ({differing}); {remedy}")
    prepare(study)
    return number, solve_block(study, study.tiling[number], 1)


@contextmanager
def _client(scheduler: str | None, workers: int | None, most: int) -> Iterator[Any]:
    """Make a client of a scheduler, or of `most` processes of one thread on this machine; SetupError if that fails.

    These listen on the loopback interface alone, and to those alone who have a certificate that is made here: on a
    machine with several users the others cannot run code as this one. Dask prints nothing: what goes wrong is reported
    here, once.
    """
    from dask.system import CPU_COUNT  # noqa: PLC0415
    from distributed import Client, LocalCluster, Security  # noqa: PLC0415

    with ExitStack() as stack:
        stack.enter_context(warnings.catch_warnings(action="ignore"))
        stack.callback(logging.disable, logging.root.manager.disable)
        logging.disable(logging.CRITICAL)
        try:
            if scheduler is None:
                here = LocalCluster(
                    n_workers=min(workers or CPU_COUNT, most),
                    threads_per_worker=1,
                    host="127.0.0.1",
                    security=Security.temporary(),
                    dashboard_address=None,
                    local_directory=tempfile.gettempdir(),
                    memory_limit=None,  # as for threads, that is for the system
                    silence_logs=logging.CRITICAL,
                    preload="import signal; signal.signal(signal.SIGINT, signal.SIG_IGN)",  # Ctrl-C is for the command
                )
                address: Any = stack.enter_context(here)
            else:
                address = scheduler if "://" in scheduler else json.loads(Path(scheduler).read_bytes())["address"]
            client = stack.enter_context(Client(address, set_as_default=False))
        except (OSError, RuntimeError, ValueError, TypeError, KeyError) as error:
            where = f"--engine dask: no cluster at {scheduler or 'this machine'} ({error})"
            remedy = "start one with `dask scheduler --scheduler-file FILE` and name FILE, or use --engine threads"
            raise SetupError(f"{where}; {remedy}") from error
        yield client
