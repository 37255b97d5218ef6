"""What commands share: options, the examples of their help, names of files to write, and what is said of those."""

import os
import shlex
import sys
from collections.abc import Callable, Iterable, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

import click

from gradhesion.cli.errors import StudyError
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import bytes_in_words

OF_DATASETS: Final = (".nc", ".nc4", ".cdf", ".netcdf")
OF_PICTURES: Final = (".png", ".svg", ".pdf")
"""How the names of files end."""
A_PATH: Final = click.Path(path_type=Path)
overriding = click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Override a key; repeatable.")
overwriting = click.option("--overwrite", is_flag=True, help="Replace an existing file.")
threading = click.option("--threads", type=click.IntRange(min=1), help="Threads [all]; values do not depend on them.")
quietly = click.option(
    "--quiet", is_flag=True, help="Print errors only.", expose_value=False,
    callback=lambda context, _option, given: context.meta.update({messages.QUIET: given}),
)  # fmt: skip
as_json = click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
AT: Final = "Fix an axis at its nearest value, or cut it: A=0.01:0.05; repeatable."
choosing = click.option("--at", multiple=True, metavar="AXIS=VALUE", help=AT)


def example(*calls: str) -> str:
    """Write calls of the program below each other, as click leaves them."""
    head = "Example:" if len(calls) == 1 else "Examples:"
    return "\n".join(["\b", head, *(f"  gradhesion {call}" for call in calls)])


def given_up(option: str, instead: str) -> Callable[[Any], Any]:
    """Make an option that is in no help, and whose use is refused with what to use instead."""

    def refuse(_context: click.Context, _option: click.Parameter, given: bool) -> None:
        if given:
            raise click.UsageError(f"{option} was given up in version 0.4; {instead}")

    settings: dict[str, Any] = {"is_flag": True, "is_eager": True, "hidden": True, "expose_value": False}
    return click.option(option, callback=refuse, help=f"Given up: {instead}.", **settings)


def _of_a_dataset(_context: click.Context, _option: click.Parameter, path: Path | None) -> Path | None:
    """Check the name of a dataset: another ending, or none, promises another kind of file."""
    if path is None or path.suffix.lower() in OF_DATASETS or os.path.exists(path):  # noqa: PTH110 (for any name)
        return path  # whoever writes there says why nothing can be
    better = path.with_suffix(".nc")
    raise StudyError(f"-o {path}: a dataset is a NetCDF file, and its name ends in .nc; write -o {better}")


def dataset_to_write(about: str = "Dataset to write.", *, required: bool = False) -> Callable[[Any], Any]:
    """Make the option -o of a command that writes a dataset."""
    return click.option("-o", "--output", required=required, type=A_PATH, callback=_of_a_dataset, help=about)


def ending_of(path: Path, what: str, endings: Sequence[str]) -> str:
    """Give the ending of the name of a file to write, without its dot; refuse any but these."""
    if path.suffix.lower() not in endings:
        raise click.UsageError(f"{path}: the name of a {what} ends in {' or '.join(endings)}; name another with -o")
    return path.suffix[1:].lower()


def listed(words: Sequence[str]) -> list[str]:
    """List names that are given one by one, or with commas between them."""
    return [name.strip() for word in words for name in word.split(",")]


def history_now() -> str:
    """Write the line of `history` for this command."""
    return messages.printable_line(f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} gradhesion {shlex.join(sys.argv[1:])}")


def say_written(path: Path, notes: Iterable[str] = ()) -> None:
    """Note that a file was written, and what is to be known of it."""
    messages.note(*notes, f"{path}: written, {bytes_in_words(path.stat().st_size)}")
