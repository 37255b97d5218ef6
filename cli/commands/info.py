"""`gradhesion info`: what a dataset holds, in words or as a table."""

from pathlib import Path

import click

from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.output import show, show_block


@click.command(
    epilog=example("info outputs/study.nc", "info outputs/study.nc --format csv > study.csv", "info a.nc b.nc")
)
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "--at", multiple=True, metavar="AXIS=VALUE", help="Only of this value of an axis, or range LOW:HIGH; repeatable."
)
@click.option(
    "--format", "form", type=click.Choice(["words", "csv"]), default="words", help="A summary, or all values."
)
@click.option(
    "--variable", "variables", multiple=True, metavar="NAME", help="With csv: a variable or curve; repeatable."
)
@click.option("--jumps", is_flag=True, help="List the jumps of all scenes instead, as CSV.")
def info(files: tuple[Path, ...], at: tuple[str, ...], form: str, variables: tuple[str, ...], jumps: bool) -> None:
    """Describe a dataset, or print it as CSV.

    Prints the parameters of FILE, the minimum and maximum of each variable with their places, or all values of up to 12
    scenes, the scenes that failed or are doubtful, and the origin of the dataset. Several files are fits of the same
    data, which are compared.
    """
    from contextlib import ExitStack

    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.read.soundness import is_fit
    from gradhesion.cli.words.table import fits_tabled, jumps_listed, tabled
    from gradhesion.cli.words.words import described

    if variables and (jumps or form != "csv"):
        raise click.UsageError("--variable selects the columns of a table; add --format csv, and leave --jumps out")
    if len(files) > 1 and (form != "words" or jumps or at):
        raise click.UsageError("several files are only compared in words; name one file, or leave the options out")
    file = files[0]
    with ExitStack() as stack:
        datasets = [stack.enter_context(opened(each)) for each in files]
        dataset = datasets[0]
        if at:
            from gradhesion.cli.dataset.select import selected

            dataset = selected(dataset, at)
        if jumps or (form == "csv" and not is_fit(dataset)):
            for block in jumps_listed(dataset, file) if jumps else tabled(dataset, file, variables):
                show_block(block)
        elif form == "csv":
            for block in fits_tabled(dataset):
                show_block(block)
        else:
            lines = described(dataset, file)
            if len(files) > 1 or is_fit(dataset):
                from gradhesion.cli.words.fit_words import fits_compared, fits_described

                lines = iter([*fits_compared(datasets, files)]) if len(files) > 1 else fits_described(dataset, file)
            for line in lines:
                show(line)
