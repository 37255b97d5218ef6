"""Commands tried on what was changed: each ends with one of its exit codes, in time, and without a traceback."""

import signal
import traceback
from collections.abc import Sequence
from pathlib import Path
from types import FrameType

from click.testing import CliRunner

from gradhesion.cli.main import cli
from gradhesion.cli.terminal.printable import printable

SECONDS = 60
"""For one command."""


class LateError(BaseException):
    """A command takes too long."""


def _late(_number: int, _frame: FrameType | None) -> None:
    raise LateError


def fault_of(*words: str | Path, codes: Sequence[int] = (0, 2, 3, 4)) -> str:
    """Run a command in this process, and say what it does that none may do; "" if there is nothing."""
    before = signal.signal(signal.SIGALRM, _late)
    signal.alarm(SECONDS)
    try:
        result = CliRunner().invoke(cli, [str(word) for word in words])
    except LateError:
        return f"takes more than {SECONDS} s"
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        where = traceback.extract_tb(result.exception.__traceback__)
        ours = [frame for frame in where if "/cli/" in frame.filename or "/core/" in frame.filename][-1:]
        place = f"{Path(ours[0].filename).name}:{ours[0].lineno}" if ours else "?"
        return f"{type(result.exception).__name__} at {place}: {str(result.exception)[:200]!r}"
    if result.exit_code not in codes:
        return f"exit code {result.exit_code}"
    if result.exit_code and not result.stderr:
        return "no word of why"
    told = result.stdout + result.stderr
    return "" if printable(told) == told else "prints what a terminal obeys"
