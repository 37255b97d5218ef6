"""The keys of a study: for each of them, once, all that schema, messages, manual, datasets and pictures say of it."""

from typing import Final

from gradhesion.cli.keys.inputs import (
    ADHESION_RANGE,
    CLOSING,
    CLOSING_WORK,
    INPUTS,
    INTERACTION,
    MACHINE,
    PARAMETERS,
    PATTERN,
    PHYSICAL,
    REDUCED,
    SPEED,
    SPRING,
    TURNS,
)
from gradhesion.cli.keys.key import Key, Path
from gradhesion.cli.keys.settings import SETTINGS

__all__ = [
    "ADHESION_RANGE",
    "CLOSING",
    "CLOSING_WORK",
    "FILE_KEYS",
    "INPUTS",
    "INTERACTION",
    "KEYS",
    "MACHINE",
    "PARAMETERS",
    "PATTERN",
    "PHYSICAL",
    "REDUCED",
    "SETTINGS",
    "SPEED",
    "SPRING",
    "TURNS",
    "Key",
    "Path",
    "keys_of",
]

KEYS: Final[dict[str, Key]] = SETTINGS | INPUTS
"""Every key of a study."""


FILE_KEYS: Final = ("file", "sha256")
"""The keys of the table of a file, in the place of its name."""


def keys_of(table: str) -> tuple[str, ...]:
    """
    Name the keys of a table.

    >>> keys_of("loading"), keys_of("harmonics")
    (('control', 'machine_stiffness'), ('n', 'cos', 'sin'))
    """
    return tuple(name for name, key in KEYS.items() if table in (key.table, *key.also))
