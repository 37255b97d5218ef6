"""What a command says of a file that it is to write, or has written."""

from collections.abc import Iterable
from pathlib import Path
from typing import Final

import click

from gradhesion.cli.errors import StudyError
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import bytes_in_words

ENDINGS: Final = (".nc", ".nc4", ".cdf", ".netcdf")
"""Of the names of datasets."""


def dataset_to_write(_context: click.Context, _option: click.Parameter, path: Path | None) -> Path | None:
    """
    Check the name of a dataset: another ending, or none, promises another kind of file.

    Raises
    ------
    StudyError
        It is not that of a dataset.
    """
    if path is None or path.suffix.lower() in ENDINGS:
        return path
    try:
        if path.exists() and not path.is_file():
            return path
    except OSError:  # no such name can be: whoever writes there says why
        return path
    name = path.with_suffix(".nc") if path.suffix[1:].isalpha() else f"{path}.nc"
    raise StudyError(f"-o {path}: a dataset is a NetCDF file, and its name ends in .nc; write -o {name}")


def say_written(path: Path, notes: Iterable[str] = ()) -> None:
    """Say that a file was written, and what is to be known of it."""
    for note in notes:
        messages.say(note)
    size = path.stat().st_size
    messages.say(f"{path}: written, {bytes_in_words(size)}")
