"""`gradhesion plot`: a picture of a dataset."""

from pathlib import Path

import click


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
def plot(file: Path) -> None:
    """Draw the dataset FILE."""
