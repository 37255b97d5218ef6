"""One cell of a table: the number that it is, or why it is none."""

import math
import re
from collections.abc import Mapping
from typing import Final

from gradhesion.cli.terminal.wording import did_you_mean

_NUMBER: Final = re.compile(
    r"[+-]?(?:(?:\d+(?:\.\d*)?|\.\d+)(?:e[+-]?\d+)?|inf(?:inity)?|nan)", re.ASCII | re.IGNORECASE
)
"""A number as files have it: what Python reads besides (`1_000`, digits of other scripts) is a mistake there."""
ERRORS: Final = r"#(?:N/A|DIV/0!|VALUE!|REF!|NUM!|NAME\?|NULL!)"
"""What a spreadsheet writes where it has no number."""
_FORM: Final = ", with a point for the decimals, nothing between thousands, and its unit in the header"
"""How a number is written."""
_LARGEST: Final = 2.0**53
"""From here on not every whole number is a float."""


def number(cell: str) -> float:
    """Give the number in a cell; NaN if it is empty, or an error of a spreadsheet.

    >>> number("1e3"), number(" "), number("-inf")
    (1000.0, nan, -inf)
    """
    try:
        value = float(cell)
        if math.isfinite(value) and "_" not in cell and cell.isascii():
            return value
    except ValueError:
        pass
    cell = cell.strip()
    if not cell or re.fullmatch(ERRORS, cell):
        return math.nan
    if not _NUMBER.fullmatch(cell):
        remedy = "write one" + (_FORM if any(map(str.isdigit, cell)) else "")
        raise ValueError(f"is not a number; {remedy}")
    value = float(cell)
    if math.isinf(value) and "n" not in cell.lower():
        raise ValueError("is beyond 1.8e308, the largest number; write it in a larger unit, or inf")
    return value


def is_number(cell: str) -> bool:
    """Tell whether a cell is a number."""
    return _NUMBER.fullmatch(cell.strip()) is not None


def word(cell: str, words: Mapping[str, float]) -> float:
    """Give the number for a word, or that in its place; NaN if there is none.

    >>> word("Unloading", {"loading": 0.0, "unloading": 1.0}), word("1.0", {"loading": 0.0, "unloading": 1.0})
    (1.0, 1.0)
    """
    found = cell.strip().lower()
    if found in words:
        return words[found]
    value = number(found) if not found or is_number(found) else math.inf
    if math.isnan(value) or value in words.values():
        return value
    raise ValueError(f"is not one of its words; {did_you_mean(found, tuple(words))}")


def whole_number(cell: str) -> float:
    """Give the whole number in a cell; NaN if there is none.

    >>> whole_number("7.0"), whole_number("")
    (7.0, nan)
    """
    value = number(cell)
    if math.isinf(value) or (math.isfinite(value) and value != math.floor(value)):
        raise ValueError("is not a whole number; write one")
    if abs(value) >= _LARGEST:
        raise ValueError("is a whole number of more than 15 digits; write a smaller one")
    return value
