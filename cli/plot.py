"""`gradhesion plot`: the right picture for the shape of a dataset."""

from pathlib import Path
from typing import Final

import click

FORMS: Final = ("png", "svg", "pdf")


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Picture: .png, .svg or .pdf [FILE.png].")
@click.option("--variable", "variables", multiple=True, metavar="NAME", help="What to draw; repeat it for several.")
@click.option("--overwrite", is_flag=True, help="Replace an existing picture.")
def plot(file: Path, output: Path | None, variables: tuple[str, ...], overwrite: bool) -> None:
    """Draw the dataset FILE: lines over one axis, a map over two, panels of maps over more; curves as curves."""
    path = output or file.with_suffix(".png")
    form = path.suffix[1:].lower()
    if form not in FORMS:
        raise click.UsageError(f"{path}: the name of a picture ends in .png, .svg or .pdf; name another with -o")

    from gradhesion.cli.curve_picture import drawn_curves
    from gradhesion.cli.disk import replacement, writing
    from gradhesion.cli.picture import drawn, save
    from gradhesion.cli.reader import has_curves, opened

    with opened(file) as dataset, replacement(path, overwrite=overwrite) as temporary:
        figure = (drawn_curves if has_curves(dataset) else drawn)(dataset, variables)
        with writing(path):
            save(figure, temporary, form)
