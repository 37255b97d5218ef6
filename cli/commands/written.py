"""What a command says when it has written a file."""

from collections.abc import Iterable
from pathlib import Path

from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import bytes_in_words


def say_written(path: Path, notes: Iterable[str] = ()) -> None:
    """Say that a file was written, and what is to be known of it."""
    for note in notes:
        messages.say("note", note)
    size = path.stat().st_size
    messages.say("done", f"{path}: written, {bytes_in_words(size)}", bytes=size)
