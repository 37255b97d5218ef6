"""What is printed on stderr while a command works: in words, as JSON lines for a program, or not at all."""

import json
import time
from typing import IO, Any

import click

from gradhesion.cli.errors import GradhesionError
from gradhesion.cli.terminal.output import complain
from gradhesion.cli.terminal.printable import printable_line

_json: list[bool] = []


def speak_json(_context: click.Context, _option: click.Parameter, value: bool) -> bool:
    """Choose JSON lines, or words, as the option of a command says."""
    _json[:] = [value]
    return value


def in_json() -> bool:
    """Report whether JSON lines are asked for."""
    return any(_json)


def say(event: str, sentence: str, **fields: Any) -> None:
    """Report a sentence, or the same as a JSON line with more fields."""
    if in_json():
        say_json(event, message=sentence, **fields)
    else:
        complain(printable_line(sentence))


def say_json(event: str, **fields: Any) -> None:
    """Print one JSON object on a line of stderr."""
    complain(json.dumps({"event": event, "time": round(time.time(), 3), **fields}))


class Failure(click.ClickException):
    """A failure that the user can fix, as click prints it and ends with its exit code."""

    def __init__(self, error: GradhesionError) -> None:
        super().__init__("\n".join(map(printable_line, error.mistakes)))
        vars(self)["exit_code"] = error.exit_code  # of the class, for click

    def show(self, file: IO[Any] | None = None) -> None:
        """Print the message to `file` (stderr if None)."""
        if in_json() and file is None:
            say_json("error", exit_code=self.exit_code, message=self.message)
        elif file is None:
            complain(self.message)
        else:
            click.echo(self.message, file=file)
