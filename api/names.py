"""What is called how in Python: parameters with their meanings, and options of commands."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from gradhesion.cli.errors import GradhesionError
from gradhesion.core.problem import names
from gradhesion.core.problem.inputs import INPUTS

PARAMETERS: Final = {name: INPUTS[name].about for name in names.PARAMETERS}
"""Every parameter of a scene, in the order of a dataset's dimensions, with its `long_name`."""


@contextmanager
def as_keywords() -> Iterator[None]:
    """Have mistakes of what is done within name the keyword `at` where a command has the option `--at`."""
    try:
        yield
    except GradhesionError as error:
        error.mistakes = tuple(sentence.replace("--", "") for sentence in error.mistakes)
        error.args = (error.mistakes,)
        raise
