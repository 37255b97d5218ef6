"""Ctrl-C and its kin: heard at once, not lost where a library swallows it, and quiet while the work is tidied up."""

import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

BURST: Final = 1.0
"""Seconds in which further signals are taken for the first one, so that they do not disturb the tidying up."""
LAST_WORDS: Final = "interrupted; no output is half-written, any finished blocks are kept, and the same command resumes"
"""What is said at the end of a program that was interrupted."""

_heard: list[float] = []
_deferring: list[None] = []


def listen() -> None:
    """Turn the signals that ask a program to end into KeyboardInterrupt."""
    signal.signal(signal.SIGINT, _hear)
    signal.signal(signal.SIGTERM, _hear)
    hangup = getattr(signal, "SIGHUP", None)  # none on Windows
    if hangup is not None and signal.getsignal(hangup) is not signal.SIG_IGN:  # nohup stays in force
        signal.signal(hangup, _hear)
    sys.unraisablehook = _show


def heard() -> bool:
    """Report whether a signal has come: a library may have swallowed it, or made another error of it."""
    return bool(_heard)


def check() -> None:
    """Raise KeyboardInterrupt if a signal has come."""
    if heard():
        raise KeyboardInterrupt


@contextmanager
def deferred() -> Iterator[None]:
    """Hear signals within what must not stop half-way, and raise KeyboardInterrupt at its end."""
    _deferring.append(None)
    try:
        yield
    finally:
        _deferring.pop()
    check()


def _show(unraisable: "UnraisableHookArgs") -> None:
    """Show what Python cannot raise, but for an interrupt that falls into the end of an object: `check` raises it."""
    if not issubclass(unraisable.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(unraisable)


def _hear(_number: int, _frame: FrameType | None) -> None:
    """Raise KeyboardInterrupt, once in a burst."""
    now = time.monotonic()
    if _heard and now - _heard[-1] < BURST:
        return
    _heard.append(now)
    if not _deferring:
        raise KeyboardInterrupt
