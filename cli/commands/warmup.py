"""`gradhesion warmup`: the solver compiled ahead, for images, clusters and classrooms."""

import time

import click

from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.examples import example


@click.command(epilog=example("warmup --all"))
@click.option("--all", "everything", is_flag=True, help="Other profiles, controls and reports too.")
@click.option("--workers", type=click.IntRange(min=1), hidden=True, help="Without effect: one process compiles.")
@click.option("--quiet", is_flag=True, help="Print errors only.")
def warmup(everything: bool, workers: int | None, quiet: bool) -> None:  # noqa: ARG001 (accepted, and without effect)
    """Compile the solver ahead of the first run.

    Runs compile what they need on first use. Without --all, only what maps and curves of a paraboloid with one cosine
    wave need is compiled. It is kept in the user's cache, or in the folder NUMBA_CACHE_DIR, for all runs of this
    version.
    """
    from gradhesion.cli.work.compiling import alone, refuse_without_compiler, say_why
    from gradhesion.core import place

    refuse_without_compiler()
    from gradhesion.core import warm_up  # it imports kernels, which need the compiler

    say_why()

    def report(kind: str, seconds: float) -> None:
        if not quiet:
            messages.say(f"{kind}: {seconds:.1f} s")

    start = time.monotonic()
    with alone():
        warm_up(report, everything=everything)
    if not quiet:
        where = f", kept in {place().folder}" if place().folder else ""
        messages.say(f"all compiled in {time.monotonic() - start:.0f} s{where}")
