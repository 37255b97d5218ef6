"""`gradhesion info`: what a dataset holds, in words."""

from pathlib import Path

import click


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--jumps", is_flag=True, help="List the jumps of all scenes instead, as CSV.")
def info(file: Path, jumps: bool) -> None:
    """Tell in words what the dataset FILE holds."""
    from gradhesion.cli.jump_words import jumps_listed
    from gradhesion.cli.reader import opened
    from gradhesion.cli.words import described

    with opened(file) as dataset:
        for line in jumps_listed(dataset, file) if jumps else described(dataset, file):
            click.echo(line)
