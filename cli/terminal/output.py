"""What is printed: without anything that a terminal would obey, and without a message ever deciding over a result."""

import os
import sys

import click

from gradhesion.cli.errors import OutputError
from gradhesion.cli.terminal.printable import printable, printable_line


def show(line: str) -> None:
    """Print a line of what was asked for to stdout, as `show_block`."""
    show_block(printable_line(line))


def show_block(text: str) -> None:
    """
    Print what was asked for to stdout: one or several lines.

    Raises
    ------
    OutputError
        It cannot be written.
    BrokenPipeError
        Nobody reads it any more.
    """
    if getattr(sys, "stdout", None) is None:
        raise OutputError("standard output: is closed; redirect it, as with > FILE")
    try:
        click.echo(printable(text))
    except BrokenPipeError:
        raise
    except OSError as error:
        raise OutputError(
            f"standard output: cannot be written ({error.strerror}); make room, or redirect it to another file"
        ) from error


def complain(text: str) -> None:
    """Print a message to stderr, if it can be printed."""
    try:
        click.echo(printable(text), err=True)
    except (OSError, ValueError):
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115 (for all that follows)


def open_streams() -> None:
    """Give closed streams somewhere to go, so that no file takes their numbers, and let none fail on a character."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)  # noqa: FBT003 (the lowest number that is free)
    if getattr(sys, "stderr", None) is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
