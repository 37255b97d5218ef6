"""`gradhesion explore`: a dataset as one page for a browser."""

from pathlib import Path

import click

from gradhesion.cli.commands import shared


@click.command(epilog=shared.example("explore outputs/study.nc", "explore outputs/study.nc -o part.html --at A=0.02"))
@click.argument("file", type=shared.A_PATH)
@click.option("-o", "--output", type=shared.A_PATH, help="Page: .html [FILE.html].")
@click.option("--variable", "variables", multiple=True, metavar="NAME", help="Variable to include; repeatable [all].")
@shared.choosing
@shared.overwriting
@shared.quietly
def explore(
    file: Path, output: Path | None, variables: tuple[str, ...], at: tuple[str, ...], overwrite: bool, quiet: bool
) -> None:
    """Write a dataset as a page with sliders.

    The page shows maps, sections and a slider for each axis of FILE in any browser. It contains the data and opens
    without a network. Values have 6 digits.
    """
    path = output or file.parent / f"{file.stem or 'dataset'}.html"
    shared.ending_of(path, "page", (".html", ".htm"))

    from gradhesion.cli.dataset.read.reader import opened, refuse_fit
    from gradhesion.cli.dataset.read.selection import nearest_values
    from gradhesion.cli.disk import replacement, writing
    from gradhesion.cli.explorer.page import page

    with opened(file) as dataset, replacement(path, overwrite=overwrite) as temporary:
        refuse_fit(dataset, "a page", file)
        text = page(dataset, file.name, shared.listed(variables), at)
        with writing(path):
            temporary.write_text(text, encoding="utf-8")
        notes = nearest_values(dataset, at)
    if not quiet:
        shared.say_written(path, notes)
