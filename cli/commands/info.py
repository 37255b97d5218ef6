"""`gradhesion info`: what a dataset holds, in words or as a table."""

from contextlib import ExitStack
from pathlib import Path

import click

from gradhesion.cli.commands.shared import A_PATH, choosing, example
from gradhesion.cli.terminal.messages import show, show_block

TO_CSV = "info outputs/study.nc --format csv > study.csv"


@click.command(epilog=example("info outputs/study.nc", TO_CSV, "info a.nc b.nc"))
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=A_PATH)
@choosing
@click.option("--format", "form", type=click.Choice(["words", "csv"]), default="words", help="A summary or all values.")
@click.option("--variable", "variables", multiple=True, metavar="NAME", help="With csv: a variable; repeatable.")
@click.option("--jumps", is_flag=True, help="List the jumps of all scenes instead, as CSV.")
def info(files: tuple[Path, ...], at: tuple[str, ...], form: str, variables: tuple[str, ...], jumps: bool) -> None:
    """Describe a dataset, or print it as CSV.

    Prints the parameters of FILE, the minimum and maximum of each variable with their places, or all values of up to 12
    scenes, the scenes that failed or are doubtful, and the origin of the dataset. Several files are fits of the same
    data, which are compared.
    """
    from gradhesion.cli.dataset.read.reader import is_fit, opened
    from gradhesion.cli.dataset.select import selected
    from gradhesion.cli.words.table import fits_tabled, jumps_listed, tabled
    from gradhesion.cli.words.words import described

    if variables and (jumps or form != "csv"):
        raise click.UsageError("--variable selects the columns of a table; add --format csv, and leave --jumps out")
    if len(files) > 1 and (form != "words" or jumps or at):
        raise click.UsageError("several files are only compared in words; name one file, or leave the options out")
    file = files[0]
    with ExitStack() as stack:
        datasets = [stack.enter_context(opened(each)) for each in files]
        dataset = selected(datasets[0], at) if at else datasets[0]
        if jumps or form == "csv":
            of_values = fits_tabled(dataset) if is_fit(dataset) else tabled(dataset, file, variables)
            for block in jumps_listed(dataset, file) if jumps else of_values:
                show_block(block)
            return
        lines = described(dataset, file)
        if len(files) > 1 or is_fit(dataset):
            from gradhesion.cli.words.fit_words import fits_compared, fits_described

            lines = fits_compared(datasets, files) if len(files) > 1 else fits_described(dataset, file)
        for line in lines:
            show(line)
