"""`gradhesion plot`: the right picture for the shape of a dataset."""

from pathlib import Path
from typing import Any

import click

from gradhesion.cli.commands import shared


@click.command(
    epilog=shared.example(
        "plot outputs/study.nc", "plot outputs/study.nc -o map.pdf --at A=0.02 --over k=max --width column --no-title"
    )
)
@click.argument("file", type=shared.A_PATH)
@click.option("-o", "--output", type=shared.A_PATH, help="Picture: .png, .svg or .pdf [FILE.png].")
@click.option("--variable", "variables", multiple=True, metavar="NAME", help="Variable to draw; repeatable.")
@shared.choosing
@click.option("--interpolate", is_flag=True, help="Interpolate to the value of --at instead.")
@click.option(
    "--over", multiple=True, metavar="AXIS=HOW", help="Reduce an axis: max, min, mean, p05, p50, p95, argmax, argmin."
)
@click.option("--x", metavar="AXIS", help="Horizontal axis; of curves contact_radius, indentation or load.")
@click.option("--y", metavar="AXIS", help="Vertical axis of a map, or the axis with a line for each value.")
@click.option("--lines", "kind", flag_value="lines", help="Draw lines, even if an axis has many values.")
@click.option("--map", "kind", flag_value="map", help="Draw a map, even if an axis has few values.")
@click.option("--width", metavar="SIZE", help='Width: inches, "8 cm", column (90 mm) or page (190 mm).')
@click.option("--height", metavar="SIZE", help='Height: inches or "8 cm" [to suit the width].')
@click.option("--colour-map", "--color-map", metavar="NAME", help="Colour map of matplotlib [viridis].")
@click.option("--levels", metavar="LEVELS", help='Contour levels: a number (8) or values (0.5,1,2 or "1 nJ,2 nJ").')
@click.option("--labels/--no-labels", default=True, help="Number the contours [yes].")
@click.option("--xlim", metavar="LOW:HIGH", help="Part of the horizontal axis to draw; either end may be left out.")
@click.option("--ylim", metavar="LOW:HIGH", help="Part of the vertical axis to draw.")
@click.option("--band", metavar="HOW", help="Spread of uncertain values: quantiles, std or none [what there is].")
@click.option("--title", metavar="TEXT", help="Title [that of the study].")
@click.option("--no-title", "title", flag_value="", help="Print no title.")
@click.option("--xlabel", metavar="TEXT", help="Name of the horizontal axis [that of what is along it].")
@click.option("--ylabel", metavar="TEXT", help="Name of the vertical axis.")
@click.option("--clabel", metavar="TEXT", help="Name of the bar of colours of a map.")
@click.option("--caption/--no-caption", default=True, help="Print the fixed parameters [yes].")
@click.option("--style", metavar="STYLE", help="Matplotlib style to add: a name or a file.")
@click.option("--data", type=shared.A_PATH, help="Measured points to draw on curves: a table in a file.")
@shared.overwriting
@shared.quietly
@shared.given_up("--inset", "draw one with `inset_axes` of matplotlib on the axes that `gr.plot` returns")
def plot(
    file: Path,
    output: Path | None,
    variables: tuple[str, ...],
    at: tuple[str, ...],
    interpolate: bool,
    over: tuple[str, ...],
    x: str | None,
    y: str | None,
    data: Path | None,
    overwrite: bool,
    quiet: bool,
    **looks: Any,
) -> None:
    """Draw a dataset: lines, maps, panels or curves.

    The shape of FILE decides: lines over one axis, a map over two, panels over more; curves are drawn as curves, and a
    fit with its data and residuals; of fits of several loops the values, or one of them (--at loop=0).
    Options fix an axis (--at A=0.02), reduce it (--over k=max) or place it (--x, --y), and set size, colours, labels.
    """
    path = output or file.parent / f"{file.stem or 'dataset'}.png"
    form = shared.ending_of(path, "picture", shared.OF_PICTURES)

    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.disk import replacement, writing
    from gradhesion.cli.picture.looks import looks_of
    from gradhesion.cli.picture.picture import picture_of
    from gradhesion.cli.picture.pictured import save

    chosen, notes = looks_of(**looks), list[str]()
    choices: dict[str, Any] = {"at": at, "over": over, "interpolate": interpolate, "x": x, "y": y, "data": data}
    with opened(file) as dataset, replacement(path, overwrite=overwrite) as temporary:
        figure = picture_of(dataset, shared.listed(variables), chosen, **choices, notes=notes.append)
        with writing(path):
            save(figure, temporary, form, chosen)
    if not quiet:
        shared.say_written(path, notes)
