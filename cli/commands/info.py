"""`gradhesion info`: what a dataset holds, in words or as a table."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.output import show, show_block

if TYPE_CHECKING:
    from collections.abc import Iterator

    from xarray import Dataset


@click.command(
    epilog=example("info outputs/study.nc", "info outputs/study.nc --format csv > study.csv", "info a.nc b.nc")
)
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "--format", "form", type=click.Choice(["words", "csv"]), default="words", help="A summary, or all values."
)
@click.option(
    "--variable", "variables", multiple=True, metavar="NAME", help="With csv: a variable or curve; repeatable."
)
@click.option("--jumps", is_flag=True, help="List the jumps of all scenes instead, as CSV.")
def info(files: tuple[Path, ...], form: str, variables: tuple[str, ...], jumps: bool) -> None:
    """Describe a dataset, or print it as CSV.

    Prints the parameters of FILE, the minimum and maximum of each variable with their places, a table of the values of
    up to 12 scenes, the scenes that failed or are doubtful, and the origin of the dataset. Several files are fits of
    the same data, which are compared.
    """
    from contextlib import ExitStack

    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.read.soundness import is_fit
    from gradhesion.cli.words.jump_words import jumps_listed
    from gradhesion.cli.words.table import tabled
    from gradhesion.cli.words.words import described

    if variables and (jumps or form != "csv"):
        raise click.UsageError("--variable selects the columns of a table; add --format csv, and leave --jumps out")
    if len(files) > 1:
        if form != "words" or jumps:
            raise click.UsageError("several files are only compared in words; name one file, or leave the options out")
        from gradhesion.cli.words.comparison_words import fits_compared

        with ExitStack() as stack:
            for line in list(fits_compared([stack.enter_context(opened(file)) for file in files], files)):
                show(line)
        return
    file = files[0]
    with opened(file) as dataset:
        if is_fit(dataset) and not jumps:
            for line in _of_fit(dataset, file, form):
                show(line)
            return
        if not jumps and form == "words":
            for line in described(dataset, file):
                show(line)
            return
        for block in jumps_listed(dataset, file) if jumps else tabled(dataset, file, variables):
            show_block(block)


def _of_fit(dataset: "Dataset", file: Path, form: str) -> "Iterator[str]":
    """Report a fit, or fits of several loops, in words or as a table."""
    from gradhesion.cli.names.fits import LOOP
    from gradhesion.cli.words.fit_words import fit_described, fit_tabled
    from gradhesion.cli.words.loops_words import loops_described, loops_tabled

    if LOOP in dataset.dims:
        return loops_tabled(dataset) if form == "csv" else loops_described(dataset, file)
    return fit_tabled(dataset) if form == "csv" else fit_described(dataset, file)
