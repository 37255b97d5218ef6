"""The way to a Dask scheduler, and what the loss of one looks like."""

import json
import logging
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Final, TypeVar

from gradhesion.cli.errors import ClusterError, MissingExtraError, OutputError
from gradhesion.cli.terminal import interrupts

_T = TypeVar("_T")


PATIENCE: Final = {"distributed": {"comm": {"timeouts": {"connect": "10s"}}}}
"""For a scheduler to answer, to write its file, and to come back; unless Dask is configured otherwise."""


def require_dask() -> None:
    """
    Make sure that Dask is there.

    Raises
    ------
    MissingExtraError
        It is not.
    """
    try:
        import cryptography  # noqa: F401, PLC0415 (for a cluster of this machine that is closed to others)
        import distributed  # noqa: F401, PLC0415 (half a second, and not always there)
    except ModuleNotFoundError as error:
        if error.name not in {"cryptography", "dask", "distributed"}:
            raise
        raise MissingExtraError(
            "--engine dask needs Dask: install it with `pip install dask distributed cryptography`"
        ) from None


@contextmanager
def silent() -> Iterator[None]:
    """Keep Dask from printing: what goes wrong there is reported here, once."""
    from distributed.versions import VersionMismatchWarning  # noqa: PLC0415

    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", VersionMismatchWarning)  # each worker is checked before it works
            yield
    finally:
        logging.disable(before)


def client_of(scheduler: str) -> Any:
    """
    Make a client of a scheduler, by its address or its file.

    Raises
    ------
    ClusterError
        It does not answer.
    """
    address = scheduler if "://" in scheduler else _address_in(Path(scheduler))
    try:
        return started(address, timeout=patience())
    except (OSError, TypeError, ValueError, RuntimeError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise ClusterError(
            f"--scheduler {scheduler}: no Dask scheduler answers ({reason}); start one with `dask scheduler`, or "
            "leave --scheduler out for a cluster of this machine"
        ) from None


def started(address: Any, **options: Any) -> Any:
    """
    Start a client of the scheduler of an address or of a cluster, and close it if it does not start.

    Dask closes one that is left open when Python clears it away, in any thread, and waits there for the lock under
    which the next client waits 10 s for its thread: where that is the same thread, the next one does not start either.
    """
    from distributed import Client  # noqa: PLC0415

    client = Client.__new__(Client)
    try:
        client.__init__(address, set_as_default=False, name="gradhesion", **options)
    except BaseException:
        with suppress(OSError, RuntimeError):
            client.close()
        raise
    return client


def patience() -> float:
    """Give the seconds for a scheduler to answer."""
    import dask  # noqa: PLC0415

    dask.config.update_defaults(PATIENCE)
    return float(dask.utils.parse_timedelta(dask.config.get("distributed.comm.timeouts.connect")))


def _address_in(path: Path) -> str:
    """Read the file that a scheduler writes; one that has just been started is waited for."""
    deadline = time.monotonic() + patience()
    while True:
        with suppress(OSError, ValueError, KeyError, TypeError):
            return str(json.loads(path.read_bytes())["address"])
        if time.monotonic() > deadline:
            raise ClusterError(
                f"--scheduler {path}: neither an address, such as tcp://host:8786, nor the file of a scheduler; "
                f"write one with `dask scheduler --scheduler-file {path}`"
            )
        interrupts.check()
        time.sleep(0.1)


def requested(client: Any, call: Callable[[], _T]) -> _T:
    """
    Call what needs the scheduler, again if it was lost meanwhile and has come back.

    Raises
    ------
    OutputError
        It has not.
    """
    deadline = time.monotonic() + 2 * patience()  # its client tries to connect for half of that
    while client.status != "closed" and time.monotonic() < deadline:
        interrupts.check()
        if client.status == "running":
            try:
                return call()
            except Exception as error:
                # Dask has a dozen exceptions for a lost scheduler; the state of its client distinguishes them.
                if client.status == "running" and not isinstance(error, OSError):
                    raise
        time.sleep(0.1)
    raise OutputError(
        "--engine dask: the scheduler no longer answers; finished parts are kept, and the same command resumes once a "
        "scheduler is available"
    )
