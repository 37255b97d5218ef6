"""`gradhesion info`, `plot`, `explore`, `select`, `verify`: a dataset in words, drawn, in part, and recomputed."""

from contextlib import ExitStack
from pathlib import Path
from typing import Any

import click

from gradhesion.cli.commands import shared
from gradhesion.cli.errors import DoubtfulError
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.messages import show, show_block
from gradhesion.cli.terminal.progress import progress

TO_CSV = "info outputs/study.nc --format csv > study.csv"
SELECT = "select outputs/study.nc --at k=0.3 --at A=0.01:0.05 --over a_max_over_R=max -o small.nc"
HOW = "Reduce an axis: max, min, mean, sum, p05, median, p95; repeatable."


@click.command(epilog=shared.example("info outputs/study.nc", TO_CSV, "info a.nc b.nc"))
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=shared.A_PATH)
@shared.choosing
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
    from gradhesion.cli.words.fit_words import fits_compared
    from gradhesion.cli.words.table import csv_of, fit_values, jumps_listed, tabled
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
            of_values = [fit_values(dataset)] if is_fit(dataset) else tabled(dataset, file, variables)
            for lines in csv_of(jumps_listed(dataset, file) if jumps else of_values):
                show_block(lines)
            return
        show(*(fits_compared(datasets, files) if len(files) > 1 else described(dataset, file)))


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
@click.option("--xlim", metavar="LOW:HIGH", help='Part of the horizontal axis, in SI or as "5 nm:20 nm"; or an end.')
@click.option("--ylim", metavar="LOW:HIGH", help="Part of the vertical axis to draw.")
@click.option("--band", metavar="HOW", help="Spread of uncertain values: quantiles, std or none [what there is].")
@click.option("--title", metavar="TEXT", help="Title [that of the study].")
@click.option("--no-title", "title", flag_value="", help="Print no title.")
@click.option("--xlabel", metavar="TEXT", help='Name of the horizontal axis; its end is the unit: "radius (nm)".')
@click.option("--ylabel", metavar="TEXT", help="Name of the vertical axis.")
@click.option("--clabel", metavar="TEXT", help="Name of the bar of colours of a map.")
@click.option("--caption/--no-caption", default=True, help="Print the fixed parameters [yes].")
@click.option("--style", metavar="STYLE", help="Matplotlib style to add: a name or a file.")
@click.option("--data", type=shared.A_PATH, help="Measured points to draw on curves: a table in a file.")
@shared.overwriting
@shared.quietly
@shared.given_up("--inset", "draw one with `inset_axes` of matplotlib on the axes that `gr.plot` returns")
def plot(file: Path, output: Path | None, variables: tuple[str, ...], overwrite: bool, **settings: Any) -> None:
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

    chosen, notes = looks_of(variables=shared.listed(variables), **settings), list[str]()
    with opened(file) as dataset, replacement(path, overwrite=overwrite) as temporary:
        figure = picture_of(dataset, chosen, notes.append)
        with writing(path):
            save(figure, temporary, form, chosen)
    shared.say_written(path, notes)


@click.command(epilog=shared.example("explore outputs/study.nc", "explore outputs/study.nc -o part.html --at A=0.02"))
@click.argument("file", type=shared.A_PATH)
@click.option("-o", "--output", type=shared.A_PATH, help="Page: .html [FILE.html].")
@click.option("--variable", "variables", multiple=True, metavar="NAME", help="Variable to include; repeatable [all].")
@shared.choosing
@shared.overwriting
@shared.quietly
def explore(file: Path, output: Path | None, variables: tuple[str, ...], at: tuple[str, ...], overwrite: bool) -> None:
    """Write a dataset as a page with sliders.

    The page shows maps, sections and a slider for each axis of FILE in any browser. It contains the data and opens
    without a network. Values have 6 digits.
    """
    path = output or file.parent / f"{file.stem or 'dataset'}.html"
    shared.ending_of(path, "page", (".html", ".htm"))

    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.read.selection import selection_of
    from gradhesion.cli.explorer.page import write_page

    with opened(file) as dataset:
        write_page(dataset, file.name, shared.listed(variables), at, path, overwrite=overwrite)
        notes = selection_of(dataset, at).notes
    shared.say_written(path, notes)


@click.command(epilog=shared.example(SELECT))
@click.argument("file", type=shared.A_PATH)
@shared.choosing
@click.option("--over", multiple=True, metavar="AXIS=HOW", help=HOW)
@shared.dataset_to_write(required=True)
@shared.overwriting
@shared.quietly
def select(file: Path, at: tuple[str, ...], over: tuple[str, ...], output: Path, overwrite: bool) -> None:
    """Write a part of a dataset.

    The result is a dataset like FILE, with its study: fewer values of an axis, or none (--at), or their maximum, mean
    and the like (--over). Of fits of several loops, --at loop=0 takes one.
    """
    from gradhesion.cli.dataset.read.reader import is_fit, opened
    from gradhesion.cli.dataset.read.selection import selection_of
    from gradhesion.cli.dataset.select import selected, write_dataset

    if not at and not over:
        raise click.UsageError("nothing is selected; add --at AXIS=VALUE or --over AXIS=HOW")
    with opened(file) as dataset:
        part = selected(dataset, at, over)
        notes = [] if is_fit(dataset) else selection_of(dataset, at).notes
        part = part.assign_attrs(history=f"{part.attrs.get('history', '')}\n{shared.history_now()}".strip())
        write_dataset(part, output, overwrite=overwrite)
    shared.say_written(output, notes)


@click.command(epilog=shared.example("verify outputs/study.nc --sample 50"))
@click.argument("file", type=shared.A_PATH)
@click.option("--sample", type=click.IntRange(min=1), default=20, show_default=True, help="Scenes to recompute.")
@click.option("--seed", type=click.IntRange(min=0), help="Seed of the random sample [random].")
@shared.given_up("--digits", "in Python, gr.verify(FILE).deviations has each value beside the one recomputed")
def verify(file: Path, sample: int, seed: int | None) -> None:
    """Recompute maps to 30 digits and compare.

    The study stored in FILE must be unchanged and match its coordinates. A random sample of the scenes is then solved
    from the integral definitions, in 51-digit arithmetic and without the kernels that made the dataset. The deviations
    are printed, largest first. A scene usually takes less than 0.1 s, and at most 15 s: scenes of more than 1,000
    waves, or fewer for a series of many harmonics, are replaced by others.

    The exit code is 3 if a value deviates by more than its stated error.
    """
    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.verify import in_words, recompute

    with opened(file) as dataset:
        found = recompute(dataset, file, sample=sample, seed=seed, progress=progress)
        title = str(dataset.attrs["title"])
    show(*in_words(found, title, file))
    if found.exceeding:
        many = f"{found.exceeding:,} of {counted(len(found.deviations), 'value')}"
        remedy = "write it again with `gradhesion run`, and report it if they still do"
        raise DoubtfulError(f"{file}: {many} deviate by more than their stated errors; {remedy}")
