"""What is printed on stderr while a command works, and when it fails."""

from typing import IO, Any

import click

from gradhesion.cli.errors import GradhesionError
from gradhesion.cli.terminal.output import complain
from gradhesion.cli.terminal.printable import printable_line


def say(sentence: str) -> None:
    """Print a sentence on a line of stderr."""
    complain(printable_line(sentence))


class Failure(click.ClickException):
    """A failure that the user can fix, as click prints it and ends with its exit code."""

    def __init__(self, error: GradhesionError) -> None:
        super().__init__("\n".join(map(printable_line, error.mistakes)))
        vars(self)["exit_code"] = error.exit_code  # of the class, for click

    def show(self, file: IO[Any] | None = None) -> None:
        """Print the message to `file` (stderr if None)."""
        if file is None:
            complain(self.message)
        else:
            click.echo(self.message, file=file)
