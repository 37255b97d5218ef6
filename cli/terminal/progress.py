"""What a long run prints on stderr: a bar on a terminal, a plain line every now and then elsewhere."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final, Protocol

from gradhesion.cli.terminal import messages


class Advance(Protocol):
    """Counts scenes that are done, or were done before."""

    def __call__(self, scenes: int, /, *, reused: bool = False) -> None:
        """Count them."""


PERIOD: Final = 10.0
"""Seconds between two plain lines."""


@contextmanager
def progress(total: int, *, quiet: bool, noun: str = "scene") -> Iterator[Advance]:
    """Show how many of `total` scenes, or loops, are done: call what is given with the number of newly done ones."""
    if quiet:
        yield lambda _, **__: None
    elif sys.stderr.isatty():
        with _bar(total, noun) as advance:
            yield advance
    else:
        yield _lines(total, noun)


@contextmanager
def _bar(total: int, noun: str) -> Iterator[Advance]:
    """Draw a bar with rate and time left."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    count = TextColumn(f"{{task.completed:,.0f}} of {{task.total:,.0f}} {noun}s {{task.fields[rate]}}")
    columns = (BarColumn(), TaskProgressColumn(), count, TimeRemainingColumn())
    start, solved = time.monotonic(), 0
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(f"{noun}s", total=total, rate="")

        def advance(scenes: int, /, *, reused: bool = False) -> None:
            nonlocal solved
            solved += 0 if reused else scenes
            bar.update(task, advance=scenes, rate=f"{rate(solved, time.monotonic() - start)} per s")

        yield advance


def _lines(total: int, noun: str) -> Advance:
    """Print a line when the last one is `PERIOD` seconds old."""
    start = last = time.monotonic()
    done = solved = 0

    def advance(scenes: int, /, *, reused: bool = False) -> None:
        nonlocal done, solved, last
        done += scenes
        solved += 0 if reused else scenes
        now = time.monotonic()
        if now - last >= PERIOD and done < total:
            last = now
            left = f", {(now - start) * (total - done) / solved:.0f} s left" if solved else ""
            speed = rate(solved, now - start)
            messages.say(f"{done:,} of {total:,} {noun}s ({done / total:.0%}), {speed} per s{left}")

    return advance


def rate(scenes: int, seconds: float) -> str:
    """Write a number of scenes per second with two significant digits or so.

    >>> rate(123_456, 1.0), rate(30, 10.0)
    ('120,000', '3')
    """
    speed = scenes / max(seconds, 1e-9)
    return f"{float(f'{speed:.2g}'):,.0f}" if speed >= 1 else f"{speed:.2g}"
