"""What is printed: nothing that a terminal would obey, and no message that decides over a result."""

import os
import re
import sys
from typing import Final

import click

from gradhesion.cli.errors import OutputError

_UNSAFE: Final = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters, what turns the direction of text, and bytes of a name that are not UTF-8."""
QUIET: Final = "gradhesion.quiet"
"""What a command with --quiet notes in its context."""


def printable(text: str) -> str:
    r"""Write characters that a terminal would obey, or cannot show, as their escapes; ends of lines and tabs stay.

    >>> printable("\x1b[2Jout.nc"), printable("caf\u00e9\n\udcff")
    ('\\x1b[2Jout.nc', 'café\n\\udcff')
    """
    return _UNSAFE.sub(lambda found: found[0].encode("unicode_escape").decode(), text)


def printable_line(text: str) -> str:
    r"""Do so for a text that is to be one line: the name of a file may have several.

    >>> printable_line("out\n.nc")
    'out\\n.nc'
    """
    return printable(text).replace("\n", "\\n")


def show(*lines: str) -> None:
    """Print lines of what was asked for to stdout, as `show_block`."""
    show_block("\n".join(map(printable_line, lines)))


def show_block(text: str) -> None:
    """Print what was asked for to stdout, one or several lines (OutputError, or BrokenPipeError if nobody reads it)."""
    if getattr(sys, "stdout", None) is None:
        raise OutputError("standard output: is closed; redirect it, as with > FILE")
    try:
        click.echo(printable(text))
    except BrokenPipeError:
        raise
    except OSError as error:
        remedy = "make room, or redirect it to another file"
        raise OutputError(f"standard output: cannot be written ({error.strerror}); {remedy}") from error


def say(*sentences: str) -> None:
    """Print each sentence on a line of stderr."""
    for sentence in sentences:
        complain(printable_line(sentence))


def note(*sentences: str) -> None:
    """Say what a command leaves out with --quiet."""
    if not is_quiet():
        say(*sentences)


def is_quiet() -> bool:
    """Report whether the command that runs prints errors only; in Python there is none."""
    context = click.get_current_context(silent=True)
    return context is not None and bool(context.meta.get(QUIET))


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
