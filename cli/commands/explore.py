"""`gradhesion explore`: a dataset as one page for a browser."""

from pathlib import Path

import click

from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.written import say_written


@click.command(epilog=example("explore outputs/study.nc", "explore outputs/study.nc -o part.html --at A=0.02"))
@click.argument("file", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Page: .html [FILE.html].")
@click.option("--variable", "variables", multiple=True, metavar="NAME", help="Variable to include; repeatable [all].")
@click.option("--at", multiple=True, metavar="AXIS=VALUE", help="Fix an axis at its nearest value; repeatable.")
@click.option("--overwrite", is_flag=True, help="Replace an existing page.")
@click.option("--quiet", is_flag=True, help="Print errors only.")
def explore(
    file: Path, output: Path | None, variables: tuple[str, ...], at: tuple[str, ...], overwrite: bool, quiet: bool
) -> None:
    """Write a dataset as a page with sliders.

    The page shows maps, sections and a slider for each axis of FILE in any browser. It contains the data and opens
    without a network. Values have 6 digits.
    """
    path = output or file.parent / f"{file.stem or 'dataset'}.html"
    if path.suffix.lower() not in {".html", ".htm"}:
        raise click.UsageError(f"{path}: the name of a page ends in .html; name another with -o")
    names = [name.strip() for word in variables for name in word.split(",")]

    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.read.selection import nearest_values
    from gradhesion.cli.dataset.read.soundness import refuse_fit
    from gradhesion.cli.disk import replacement, writing
    from gradhesion.cli.explorer.page import page

    with opened(file) as dataset, replacement(path, overwrite=overwrite) as temporary:
        refuse_fit(dataset, "a page", file)
        text = page(dataset, file.name, names, at)
        with writing(path):
            temporary.write_text(text, encoding="utf-8")
        notes = nearest_values(dataset, at)
    if not quiet:
        say_written(path, notes)
