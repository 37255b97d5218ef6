"""Compiling that explains itself: what is compiled, how far it is, and how long it took."""

import math
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from gradhesion.cli.terminal import messages
from gradhesion.cli.work.kernels.kernels import compile_kinds, missing_of, refuse_without_compiler
from gradhesion.core import CPU_SECONDS, KERNELS, place
from gradhesion.core.compiler.ahead import why_not

WORDS = {
    "tables": "tables",
    "force": "the pull-off force",
    "energy": "cycles and energies",
    "long": "cycles of many waves",
    "long_sensitivities": "sensitivities of cycles of many waves",
    "smooth": "smooth punches",
    "reports": "errors and gains",
    "turning": "turning points",
    "asymptotic": "the asymptotic solver",
    "envelope": "the envelope solver",
    "curves": "curves",
    "loops": "fits of loops",
    "sensitivities": "sensitivities",
    "edge": "edges that close at less work",
    "patterned": "patterns of toughness",
    "patterned_turning": "turning points on patterns of toughness",
    "patterned_curves": "curves on patterns of toughness",
    "patterned_sensitivities": "sensitivities on patterns of toughness",
    "patterned_reports": "errors and gains on patterns of toughness",
    "rate": "edges with a speed",
}
"""The kinds of work, in words."""


def prepare(kinds: Sequence[str], *, quiet: bool = False) -> None:
    """
    Compile the kernels of some kinds of work that no process has compiled before, and show how far that is.

    With `quiet` one line says so, and nothing else. What follows can be timed: it compiles nothing.
    """
    refuse_without_compiler()
    missing = missing_of(kinds)
    if not missing:
        return
    say_why()
    total = sum(KERNELS[kind] for kind in missing)
    what = _in_words(missing)
    expected = math.ceil(sum(CPU_SECONDS[kind] for kind in missing))
    work = f"about {total} kernels, {expected} CPU seconds of one core, " if total else ""
    messages.say("compile", f"compiling {work}for {what}, once per version and kind of work")
    start = time.monotonic()
    with _shown(total, quiet=quiet) as done:
        compile_kinds(kinds, done)
    if not quiet:
        seconds = time.monotonic() - start
        messages.say("compiled", f"compiled in {seconds:.0f} s", seconds=seconds, kinds=missing)


def say_why() -> None:
    """Report why kernels are not kept in the usual folder, and why those that came with the program are not used."""
    for why in filter(None, (place().why, why_not())):
        messages.say("cache", why)


def _in_words(kinds: Sequence[str]) -> str:
    """
    Write down what is compiled.

    >>> _in_words(["tables", "force", "energy"]), _in_words(["general_force"])
    ('tables, the pull-off force, cycles and energies', 'the pull-off force of other profiles and controls')
    """
    plain = [WORDS[kind] for kind in kinds if not kind.startswith("general_")]
    general = [WORDS[kind.removeprefix("general_")] for kind in kinds if kind.startswith("general_")]
    if general:
        general[-1] += " of other profiles and controls"
    return ", ".join([*plain, *general])


@contextmanager
def _shown(total: int, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Draw a bar on a terminal; elsewhere nothing."""
    if quiet or messages.in_json() or not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console  # noqa: PLC0415 (a run that compiles nothing draws no bar)
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn  # noqa: PLC0415

    columns = (BarColumn(), TextColumn("{task.completed} of about {task.total} kernels"), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("kernels", total=total)

        def done(_name: str) -> None:
            finished = int(bar.tasks[0].completed) + 1
            bar.update(task, completed=finished, total=max(total, finished))

        yield done
