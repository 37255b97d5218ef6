"""`gradhesion info`: what a dataset holds, in words."""

from pathlib import Path

import click


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
def info(file: Path) -> None:
    """Tell in words what the dataset FILE holds."""
    from gradhesion.cli.reader import opened
    from gradhesion.cli.words import described

    with opened(file) as dataset:
        for line in described(dataset, file):
            click.echo(line)
