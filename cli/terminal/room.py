"""What the environment of a command allows its compiler, which fails at its import where that is too little."""

import os

from gradhesion.cli.errors import CompilerError


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
