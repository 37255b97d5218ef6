"""`gradhesion warmup`: the kernels compiled ahead, for images, clusters and classrooms."""

import time

import click

from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.examples import example


@click.command(epilog=example("warmup --all"))
@click.option("--all", "everything", is_flag=True, help="Other profiles, controls and reports too.")
@click.option("--workers", type=click.IntRange(min=1), help="Parallel processes [all available to the process].")
@click.option("--quiet", is_flag=True, help="Print errors only.")
def warmup(everything: bool, workers: int | None, quiet: bool) -> None:
    """Compile the solver ahead of the first run.

    Runs compile what they need on first use. Without --all, only the kernels for maps and curves of a paraboloid with
    one cosine wave are compiled. They are kept in the user's cache, or in the folder NUMBA_CACHE_DIR, for all runs of
    this version.
    """
    from gradhesion.cli.work.kernels.kernels import missing_of, refuse_without_compiler
    from gradhesion.core import KINDS, place
    from gradhesion.core.compiler.ahead import is_complete
    from gradhesion.core.processors import processors

    refuse_without_compiler()
    from gradhesion.cli.work.kernels.compiling import say_why
    from gradhesion.cli.work.kernels.warming import warm  # it imports kernels, which need the compiler

    kinds = KINDS if everything else ("energy", "envelope", "curves")
    missing, folder, count, start = missing_of(kinds), place().folder, 0, time.monotonic()
    say_why()

    def done(kind: str, names: list[str]) -> None:
        nonlocal count
        count += len(names)
        if not quiet:
            messages.say(
                "compiled", f"{kind}: {counted(len(names), 'kernel')}, {time.monotonic() - start:.0f} s", kind=kind
            )

    if missing:
        warm(kinds, workers or processors(), done)
    if not quiet:
        where = f", kept in {folder}" if folder else ""
        where = ", with the program" if all(map(is_complete, kinds)) else where
        what = (
            f"{counted(count, 'kernel')} compiled in {time.monotonic() - start:.0f} s"
            if missing
            else "all compiled already"
        )
        messages.say("done", what + where, kernels=count)
