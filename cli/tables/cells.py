"""One cell of a table: the number that it is, or why it is none."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal, InvalidOperation
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.terminal.wording import did_you_mean, shown

_NUMBER: Final = re.compile(
    r"[+-]?(?:(?:\d+(?:\.\d*)?|\.\d+)(?:e[+-]?\d+)?|inf(?:inity)?|nan)", re.ASCII | re.IGNORECASE
)
"""A number as files have it: what Python reads besides (`1_000`, digits of other scripts) is a mistake there."""
_MISTYPED: Final = re.compile(
    r"[-+\u2212]?[.,]?\d[\d.,' \u00a0\u202f_]*(?:[edED][-+\u2212]?\d{1,4}|\s?[^\W\d_]{1,3}|\s?%|x[\da-fA-F]{1,8})?"
)
"""What was meant as a number."""
ERRORS: Final = r"#(?:N/A|DIV/0!|VALUE!|REF!|NUM!|NAME\?|NULL!)"
"""What a spreadsheet writes where it has no number."""
_LONGEST: Final = 24
"""Characters of a cell that is shown."""
_REMEDIES: Final = (
    (r".*\d[,' \u00a0\u202f_]\d.*", "write a point for the decimals and nothing between thousands"),
    (r"\u2212.*", "write a hyphen for the minus sign"),
    (r"0x.*", "write it in decimal digits"),
    (r".*\dd[-+]?\d+", "write its exponent with an e, as 1e-3"),
    (r".*\d\s?[^\W\d_]+", "write its unit in the header, in brackets after the name"),
)
"""What to do about what was meant as a number."""


def number(cell: str) -> float:
    """
    Give the number in a cell; NaN if it is empty, or an error of a spreadsheet.

    Raises
    ------
    ValueError
        It has none; the message says so and what to do.

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
        remedies = (remedy for form, remedy in _REMEDIES if re.fullmatch(form, cell, re.IGNORECASE))
        remedy = next(remedies, "write one") if _is_mistyped(cell) else "write one"
        raise ValueError(f"is not a number; {remedy}")
    value = float(cell)
    if math.isinf(value) and "n" not in cell.lower():
        raise ValueError("is beyond 1.8e308, the largest number; write it in a larger unit, or inf")
    return value


def is_number(cell: str) -> bool:
    """Tell whether a cell is a number."""
    return _NUMBER.fullmatch(cell.strip()) is not None


def word(cell: str, words: Mapping[str, float]) -> float:
    """
    Give the number for a word, or that in its place; NaN if there is none.

    Raises
    ------
    ValueError
        It is none of these; the message says so and which there are.

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


@dataclass(frozen=True)
class WholeNumbers:
    """The whole numbers of a column: each is read as the number, from 0, under which it is kept here."""

    kept: dict[Decimal, int] = field(default_factory=dict)

    def code(self, cell: str) -> float:
        """
        Keep the number in a cell; NaN if there is none.

        Raises
        ------
        ValueError
            It is not whole; the message says so.

        >>> numbers = WholeNumbers()
        >>> [numbers.code(cell) for cell in ("7", "9007199254740993", "7.0", "9007199254740992")]
        [0.0, 1.0, 0.0, 2.0]
        """
        if not is_number(cell):
            return number(cell)
        try:
            own = Decimal(cell.strip())
            whole = own.is_finite() and own == own.to_integral_value()
        except InvalidOperation:  # an exponent beyond all bounds
            own, whole = Decimal(0), False
        if own.is_nan():
            return math.nan
        if not whole:
            raise ValueError("is not a whole number; write one")
        return float(self.kept.setdefault(own, len(self.kept)))

    def numbers(self, codes: NDArray[np.float64]) -> NDArray[np.int64]:
        """Give the numbers that were kept, or their ranks from 1 if one of them has more than 64 bits; 0 for NaN."""
        fit = all(-(2**63) <= own < 2**63 for own in self.kept)
        ranks = {own: rank for rank, own in enumerate(sorted(self.kept), 1)}
        table = np.array([*((int(own) if fit else ranks[own]) for own in self.kept), 0], np.int64)
        return table[np.where(np.isnan(codes), -1, codes).astype(np.intp)]


def _is_mistyped(cell: str) -> bool:
    """Tell whether a cell was meant as a number."""
    return len(cell) <= _LONGEST and _MISTYPED.fullmatch(cell) is not None


def quoted(cell: str) -> str:
    """
    Show a cell behind the name of its column, if it is a number or was meant as one: else it is nobody's business.

    >>> quoted("1,5"), quoted("hunter2")
    (' = "1,5"', '')
    """
    cell = cell.strip()
    return f" = {shown(cell)}" if _is_mistyped(cell) or (is_number(cell) and len(cell) <= _LONGEST) else ""
