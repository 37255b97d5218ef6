"""The ways to fail: one exception and one exit code each; every message tells what to do next."""

from collections.abc import Sequence
from typing import IO, Any, Final

import click

from gradhesion.cli import messages

EXIT_CODES: Final = {
    0: "fine",
    2: "the command, the study or the dataset is wrong; no scheduler answers, or no worker can do the work",
    3: "written, but some scenes have failed (their `status` says why); or `verify` has found a value beyond its "
    "stated error",
    4: "the output cannot be written (it exists, no space, no right, another run is at work on it, or parts of another "
    "study are kept), or the scheduler has gone; what stood there is untouched",
    130: "interrupted; what stood there is untouched, finished parts are kept, and the same command goes on",
    141: "nobody reads on what is told, as with `| head`; nothing is said about it",
}
"""What every exit code means."""


class GradhesionError(click.ClickException):
    """A failure that the user can mend; `str()` of it is the message, `exit_code` what the command returns."""

    exit_code = 1

    def show(self, file: IO[Any] | None = None) -> None:
        """Print the message to `file` (stderr if None)."""
        if messages.in_json() and file is None:
            messages.say_json("error", exit_code=self.exit_code, message=self.message)
        else:
            click.echo(self.message, file=file, err=file is None)


class StudyError(GradhesionError):
    """The study is wrong: `mistakes` has a sentence for each of its mistakes."""

    exit_code = 2

    def __init__(self, mistakes: Sequence[str]) -> None:
        super().__init__("\n".join(mistakes))
        self.mistakes = tuple(mistakes)


class DatasetError(GradhesionError):
    """A dataset cannot be read, or has not what was asked for."""

    exit_code = 2


class ScenesFailedError(GradhesionError):
    """The dataset is written, but some of its scenes have no value."""

    exit_code = 3


class MissingExtraError(GradhesionError):
    """A command needs a package that the plain installation leaves out."""

    exit_code = 2


class DeviationError(GradhesionError):
    """Values of a dataset deviate by more than is stated for them."""

    exit_code = 3


class OutputError(GradhesionError):
    """The output cannot be written."""

    exit_code = 4


class ClusterError(GradhesionError):
    """A cluster cannot be used: no scheduler answers, or no worker can do the work."""

    exit_code = 2
