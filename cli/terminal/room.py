"""What the environment of a command allows it; libraries end the process, or fail, where that is too little."""

import os
from typing import Final

from gradhesion.cli.errors import CompilerError, OutputError
from gradhesion.cli.terminal.amounts import bytes_in_words

SOLVING: Final = 1.5e9
"""Bytes of address space of a command that compiles or solves: 1.0 GB as measured on two cores, and the compiler."""
READING: Final = 0.7e9
"""The same of one that reads, draws or joins datasets: 0.5 GB as measured."""
NEEDED: Final = dict.fromkeys(("run", "plan", "warmup"), SOLVING) | dict.fromkeys(
    ("info", "plot", "explore", "select", "verify", "merge", "profile", "validate"), READING
)
"""By the command; the others need less than any shell allows."""


def refuse_without_room(command: str) -> None:
    """
    Make sure that a command has the address space that it needs.

    Raises
    ------
    OutputError
        It has not.
    """
    allowed, needed = _allowed(), NEEDED.get(command, 0.0)
    if allowed < needed:
        raise OutputError(
            f"the shell allows {bytes_in_words(allowed)} of address space, and `gradhesion {command}` needs "
            f"{bytes_in_words(needed)}; raise the limit, as with `ulimit -v unlimited`"
        )


def refuse_without_threads() -> None:
    """
    Make sure that the compiler may have a thread: numba fails at its import otherwise, or prints a traceback.

    An empty number is that of a shell variable which is not set; it is removed.

    Raises
    ------
    CompilerError
        The environment says that it may not.
    """
    number = os.environ.get("NUMBA_NUM_THREADS", "").strip()
    if not number:
        os.environ.pop("NUMBA_NUM_THREADS", None)
    elif not number.isdecimal() or int(number) < 1:
        raise CompilerError(
            f"NUMBA_NUM_THREADS = {number}: the number of threads is a whole number from 1 on; change it, or unset it"
        )


def _allowed() -> float:
    """Give the bytes of address space that this process may have."""
    try:
        import resource
    except ModuleNotFoundError:  # Windows
        return float("inf")
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return float("inf") if limit == resource.RLIM_INFINITY else float(limit)
