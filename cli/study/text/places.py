"""Where each key of a TOML text stands: the parser does not keep lines, but a message needs them."""

import re
from typing import Final

Path = tuple[str | int, ...]
"""A key as the steps to it: `("parameters", "k", 3)` is item 3 of `parameters.k`."""

_VEILED: Final = re.compile(
    r'"""(?:\\.|[^\\])*?"""|\'\'\'.*?\'\'\'|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\'|#[^\n]*', re.DOTALL
)
"""Strings and comments, in which brackets and equals signs mean nothing."""
_KEY: Final = r"\s*([\w-]+(?:\s*\.\s*[\w-]+)*)\s*"
_HEADER: Final = re.compile(rf"\s*\[\[?{_KEY}\]")
_ENTRY: Final = re.compile(rf"{_KEY}=")
_STEPS: Final = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


def dotted(path: Path) -> str:
    """
    Write a path as a message shows it.

    >>> dotted(("parameters", "k", 3))
    'parameters.k[3]'
    """
    text = ""
    for step in path:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def steps_of(path: str) -> Path:
    """
    Take a dotted key apart.

    >>> steps_of("parameters.k[3]")
    ('parameters', 'k', 3)
    """
    return tuple(int(item) if item else name for name, item in _STEPS.findall(path))


def lines_of(text: str) -> dict[Path, int]:
    r"""
    Find the line (from 1) of each table and each key of a valid TOML text; those within a value are at its beginning.

    >>> lines_of("layout = 'grid'\n[parameters]\nk = [\n  0.1,\n  0.2,\n]\nA = 0.3\n")
    {('layout',): 1, ('parameters',): 2, ('parameters', 'k'): 3, ('parameters', 'A'): 7}
    """
    found: dict[Path, int] = {}
    table: Path = ()
    depth = 0
    for number, line in enumerate(_VEILED.sub(lambda veiled: "\n" * veiled[0].count("\n"), text).split("\n"), 1):
        header, entry = (_HEADER.match(line), _ENTRY.match(line)) if depth == 0 else (None, None)
        if header:
            path = table = tuple(header[1].replace(" ", "").split("."))
        else:
            path = (*table, *entry[1].replace(" ", "").split(".")) if entry else ()
            depth += sum(map(line.count, "[{")) - sum(map(line.count, "]}"))
        for steps in range(1, len(path) + 1):
            found.setdefault(path[:steps], number)
    return found
