"""`gradhesion info`: what a dataset holds, in words or as a table."""

from pathlib import Path

import click

from gradhesion.cli.commands.examples import example
from gradhesion.cli.terminal.output import show, show_block


@click.command(epilog=example("info outputs/study.nc", "info outputs/study.nc --format csv > study.csv"))
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--format", "form", type=click.Choice(["words", "csv"]), default="words", help="A summary, or all values."
)
@click.option(
    "--variable", "variables", multiple=True, metavar="NAME", help="With csv: a variable or curve; repeatable."
)
@click.option("--jumps", is_flag=True, help="List the jumps of all scenes instead, as CSV.")
def info(file: Path, form: str, variables: tuple[str, ...], jumps: bool) -> None:
    """Describe a dataset, or print it as CSV.

    Prints the parameters of FILE, the minimum and maximum of each variable with their places, the scenes that failed
    or are doubtful, and the origin of the dataset.
    """
    from gradhesion.cli.dataset.reader import opened
    from gradhesion.cli.dataset.soundness import is_fit
    from gradhesion.cli.words.fit_words import fit_described, fit_tabled
    from gradhesion.cli.words.jump_words import jumps_listed
    from gradhesion.cli.words.table import tabled
    from gradhesion.cli.words.words import described

    if variables and (jumps or form != "csv"):
        raise click.UsageError("--variable chooses what a table has; add --format csv, and leave --jumps out")
    with opened(file) as dataset:
        if is_fit(dataset) and not jumps:
            for line in fit_tabled(dataset) if form == "csv" else fit_described(dataset, file):
                show(line)
            return
        if not jumps and form == "words":
            for line in described(dataset, file):
                show(line)
            return
        for block in jumps_listed(dataset, file) if jumps else tabled(dataset, file, variables):
            show_block(block)
