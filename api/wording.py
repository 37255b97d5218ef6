"""Python wording of messages about a study, or about options in a shell."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from gradhesion.cli.errors import GradhesionError

_OPTIONS: Final = (
    (r"--colour-map\b", "colour_map"),
    (r"write 8 or 0.5,1,2", "write 8 or [0.5, 1, 2]"),
    (r"--(lines|map)\b", r'kind="\1"'),
    (r"--no-(title|caption)\b", r"\1=False"),
    (r"--(xlim|ylim|inset) 0\.1:0\.5", r"\1=(0.1, 0.5)"),
    (r"--(xlim|ylim|inset|band)\b", r"\1"),
    (r"--x indentation --y load", 'x="indentation", y="load"'),
    (r"--(data|set|at|over|variable|x|y|xlabel|ylabel|interpolate|width|height|levels|style|sample|seed)\b", r"\1"),
    (r"(?:; )?name another with -o", ""),
)
"""Options of commands are keywords in Python."""

_TABLES: Final = (
    (r"^(gr\.\w+: )(?:parameters|physical|loading|states|method)\.", r"\1"),
    (r"\{ start = (\S+), stop = (\S+), num = (\S+), spacing = \"log\" \}", r"numpy.geomspace(\1, \2, \3)"),
    (r" (?:under|to) \[(?:parameters|physical|loading|method)\]", ""),
    (r"where \[physical\] gives quantities with units", "beside quantities with units"),
    (r"remove \[physical\]", "remove the quantities with units"),
    (r"\[loading\]", "control"),
    (r"\[states\]", "contact_radius_over_R"),
    (r"\[profile\]", "profile"),
)
"""Keys of a study are keywords of `gradhesion.solve`, without tables."""


def without_options(sentence: str) -> str:
    """
    Name keywords in the place of options.

    >>> without_options("--at A=3: outside the axis; choose another with --at")
    'at A=3: outside the axis; choose another with at'
    """
    return _replaced(sentence, _OPTIONS)


def without_tables(sentence: str) -> str:
    """
    Leave out the tables of a study.

    >>> without_tables("gr.solve: loading.control = 1: add machine_stiffness = 10.0 to [loading]")
    'gr.solve: control = 1: add machine_stiffness = 10.0'
    """
    return _replaced(sentence, _TABLES)


@contextmanager
def in_python() -> Iterator[None]:
    """Have the mistakes of what is done within name keywords in the place of options."""
    try:
        yield
    except GradhesionError as error:
        error.mistakes = tuple(map(without_options, error.mistakes))
        error.args = (error.mistakes,)
        raise


def _replaced(sentence: str, pairs: tuple[tuple[str, str], ...]) -> str:
    """Replace patterns in their order."""
    for pattern, words in pairs:
        sentence = re.sub(pattern, words, sentence)
    return sentence
