"""`gradhesion select`: a part of a dataset, or one with reduced axes, as a smaller dataset."""

from pathlib import Path

import click

from gradhesion.cli.commands import shared

EXAMPLE = "select outputs/study.nc --at k=0.3 --at A=0.01:0.05 --over a_max_over_R=max -o small.nc"
HOW = "Reduce an axis: max, min, mean, sum, p05, median, p95; repeatable."


@click.command(epilog=shared.example(EXAMPLE))
@click.argument("file", type=shared.A_PATH)
@shared.choosing
@click.option("--over", multiple=True, metavar="AXIS=HOW", help=HOW)
@shared.dataset_to_write(required=True)
@shared.overwriting
@shared.quietly
def select(file: Path, at: tuple[str, ...], over: tuple[str, ...], output: Path, overwrite: bool, quiet: bool) -> None:
    """Write a part of a dataset.

    The result is a dataset like FILE, with its study: fewer values of an axis, or none (--at), or their maximum, mean
    and the like (--over). Of fits of several loops, --at loop=0 takes one.
    """
    from gradhesion.cli.dataset.read.reader import is_fit, opened
    from gradhesion.cli.dataset.read.selection import nearest_values
    from gradhesion.cli.dataset.select import selected, write_dataset

    if not at and not over:
        raise click.UsageError("nothing is selected; add --at AXIS=VALUE or --over AXIS=HOW")
    with opened(file) as dataset:
        part = selected(dataset, at, over)
        notes = [] if is_fit(dataset) else nearest_values(dataset, at)
        part = part.assign_attrs(history=f"{part.attrs.get('history', '')}\n{shared.history_now()}".strip())
        write_dataset(part, output, overwrite=overwrite)
    if not quiet:
        shared.say_written(output, notes)
