"""What a long run prints on stderr: a bar on a terminal, a plain line every now and then elsewhere."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Final

from gradhesion.cli.terminal import messages

Advance = Callable[..., None]
"""Counts so many scenes as done; with `reused=True` as done before."""
PERIOD: Final = 10.0
"""Seconds between two plain lines."""


@contextmanager
def progress(total: int, noun: str = "scene") -> Iterator[Advance]:
    """Show how many of `total` scenes, or loops, are done: call what is given with the number of newly done ones."""
    with ExitStack() as stack:
        bar = None
        quiet = messages.is_quiet()
        if not quiet and sys.stderr.isatty():
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

            count = TextColumn(f"{{task.completed:,.0f}} of {{task.total:,.0f}} {noun}s {{task.fields[rate]}}")
            columns = (BarColumn(), TaskProgressColumn(), count, TimeRemainingColumn())
            bar = stack.enter_context(Progress(*columns, console=Console(stderr=True), transient=True))
            bar.add_task(f"{noun}s", total=total, rate="")
        start = last = time.monotonic()
        done = solved = 0

        def advance(scenes: int, *, reused: bool = False) -> None:
            nonlocal done, solved, last
            done += scenes
            solved += 0 if reused else scenes
            now = time.monotonic()
            speed = f"{rate(solved, now - start)} per s"
            if bar is not None:
                bar.update(bar.task_ids[0], completed=done, rate=speed)
            elif not quiet and now - last >= PERIOD and done < total:
                last = now
                left = f", {(now - start) * (total - done) / solved:.0f} s left" if solved else ""
                messages.say(f"{done:,} of {total:,} {noun}s ({done / total:.0%}), {speed}{left}")

        yield advance


def rate(scenes: int, seconds: float) -> str:
    """Write a number of scenes per second with two significant digits or so.

    >>> rate(123_456, 1.0), rate(30, 10.0)
    ('120,000', '3')
    """
    speed = scenes / max(seconds, 1e-9)
    return f"{float(f'{speed:.2g}'):,.0f}" if speed >= 1 else f"{speed:.2g}"
