"""`gradhesion plot`: the right picture for the shape of a dataset."""

from pathlib import Path
from typing import Final

import click

from gradhesion.cli.commands.examples import example
from gradhesion.cli.commands.written import say_written

FORMS: Final = ("png", "svg", "pdf")


@click.command(epilog=example("plot outputs/study.nc", "plot outputs/study.nc -o map.pdf --at A=0.02 --over k=max"))
@click.argument("file", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Picture: .png, .svg or .pdf [FILE.png].")
@click.option("--variable", "variables", multiple=True, metavar="NAME", help="What to draw; repeat it for several.")
@click.option("--at", multiple=True, metavar="AXIS=VALUE", help="Fix an axis at its value nearest to this one.")
@click.option("--interpolate", is_flag=True, help="Interpolate between the values of --at instead.")
@click.option(
    "--over", multiple=True, metavar="AXIS=HOW", help="Reduce an axis by max, min or mean, or to argmax or argmin."
)
@click.option("--x", metavar="AXIS", help="The axis along the abscissa.")
@click.option("--y", metavar="AXIS", help="The axis along the ordinate of a map.")
@click.option("--overwrite", is_flag=True, help="Replace an existing picture.")
@click.option("--quiet", is_flag=True, help="Say nothing unless something is wrong.")
def plot(
    file: Path,
    output: Path | None,
    variables: tuple[str, ...],
    at: tuple[str, ...],
    interpolate: bool,
    over: tuple[str, ...],
    x: str | None,
    y: str | None,
    overwrite: bool,
    quiet: bool,
) -> None:
    """Draw a dataset: lines, maps, panels or curves.

    What suits the shape of FILE: lines over one axis, a map over two, panels of maps over more; curves as curves.
    Options choose what of it: an axis is fixed (--at A=0.02), reduced (--over k=max) or given its place (--x, --y).
    """
    path = output or file.parent / f"{file.stem or 'dataset'}.png"
    form = path.suffix[1:].lower()
    if form not in FORMS:
        raise click.UsageError(f"{path}: the name of a picture ends in .png, .svg or .pdf; name another with -o")
    names = [name.strip() for word in variables for name in word.split(",")]

    from gradhesion.cli.dataset.reader import has_curves, opened
    from gradhesion.cli.dataset.selection import nearest_values, selection_of
    from gradhesion.cli.disk import replacement, writing
    from gradhesion.cli.errors import DatasetError
    from gradhesion.cli.picture.curve_picture import drawn_curves
    from gradhesion.cli.picture.picture import drawn
    from gradhesion.cli.picture.pictured import save

    with opened(file) as dataset, replacement(path, overwrite=overwrite) as temporary:
        selection = selection_of(dataset, at, over, interpolate=interpolate)
        if not has_curves(dataset):
            figure = drawn(dataset, names, selection, x=x, y=y)
        elif given := [
            word for word, on in (("--over", over), ("--x", x), ("--y", y), ("--interpolate", interpolate)) if on
        ]:
            raise DatasetError(f"{given[0]}: curves are drawn as they are; choose scenes with --at")
        else:
            figure = drawn_curves(selection.narrowed(dataset), names)
        with writing(path):
            save(figure, temporary, form)
        notes = [] if interpolate else nearest_values(dataset, at)
    if not quiet:
        say_written(path, notes)
