"""Where each key of a TOML text stands: the parser does not keep lines, but a message needs them.

A statement of TOML (a table header, or `key = value` over one or more lines) parses on its own, and no shorter run of
its lines does. So the parser itself finds where each statement ends, and names the keys that it sets.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any, Final

Path = tuple[str | int, ...]
"""A key as the steps to it: `("parameters", "k", 3)` is item 3 of `parameters.k`."""

DEEPEST: Final = 32
"""Levels of tables and lists: a study has four."""

_DOTS: Final = 100 * DEEPEST
"""Dots of one key that are far too many: the parser takes a time that grows with their square."""

PATIENCE: Final = 50
"""Line ends to try for one statement before giving its later keys up. A heuristic bound: they only lose their lines."""


def is_deep(data: Any) -> bool:
    """
    Check whether tables and lists are nested more deeply than in any study, without going down them all.

    >>> is_deep({"parameters": {"k": [0.0, 0.5]}}), is_deep(eval(40 * '[' + 40 * ']'))
    (False, True)
    """
    level = [data]
    for _ in range(DEEPEST):
        nested = (one.values() if isinstance(one, Mapping) else one for one in level if isinstance(one, Mapping | list))
        level = [item for items in nested for item in items if isinstance(item, Mapping | list)]
        if not level:
            return False
    return True


def is_deep_text(text: str) -> bool:
    """Check whether a text has keys so deep that to parse it takes long; numbers of a list have commas between them."""
    long = (line for line in text.split("\n") if line.count(".") > _DOTS)
    return any(piece.count(".") > _DOTS for line in long for piece in re.split("[,=]", line))


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


def lines_of(text: str) -> dict[Path, int]:
    r"""
    Find the line (from 1) of each key of a valid TOML text.

    >>> lines_of("layout = 'grid'\n[parameters]\nk = [\n  0.1,\n  0.2,\n]\nA = 0.3\n")
    {('layout',): 1, ('parameters',): 2, ('parameters', 'k'): 3, ('parameters', 'A'): 7}
    >>> lines_of("kind = 'map'\n\r\n[method]\r\nsolver = 'exact'\n")
    {('kind',): 1, ('method',): 3, ('method', 'solver'): 4}
    """
    lines = [line.removesuffix("\r") for line in text.split("\n")]  # as TOML counts them; Python has more line ends
    found: dict[Path, int] = {}
    table: Path = ()
    first = 0
    while first < len(lines):
        statement, end = _statement(lines, first)
        if lines[first].lstrip().startswith("["):
            table = next(iter(sorted(_paths(statement), key=len, reverse=True)), ())
            below: Path = ()
        else:
            below = table
        for path in _paths(statement):
            found.setdefault(below + path, first + 1)
        first = end
    return found


def _statement(lines: list[str], first: int) -> tuple[dict[str, Any], int]:
    """Parse the statement that begins at line `first`, and give the line after it."""
    tries = 0
    for end in range(first + 1, len(lines) + 1):
        # Only a line that closes something can end a statement of several lines.
        if end > first + 1 and not any(mark in lines[end - 1] for mark in ("]", "}", '"""', "'''")):
            continue
        try:
            return tomllib.loads("\n".join(lines[first:end])), end
        except (ValueError, RecursionError):
            tries += 1
            if tries == PATIENCE:
                break
    return {}, first + 1


def _paths(data: Any, above: Path = ()) -> Iterator[Path]:
    """Name every key in nested tables, the outer before the inner."""
    tables = [data] if isinstance(data, dict) else data if isinstance(data, list) else []
    for table in tables:
        if isinstance(table, dict):
            for key, value in table.items():
                yield (*above, key)
                yield from _paths(value, (*above, key))
