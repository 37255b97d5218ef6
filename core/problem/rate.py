"""A work of adhesion that grows with the speed of the edge: opening at G = w_o [1 + (v/v*)^n]."""

from dataclasses import dataclass
from typing import Final

CLOSINGS: Final = ("quasi-static", "same")
"""How the contact closes: at the work of closing whatever the speed, or at w_c/[1 + (v/v*)^n]."""
MOST_WAVES: Final = 16_000.0
"""Most waves of the shortest harmonic that are followed: a table of them has 75 MB."""
EXPONENTS: Final = (0.1, 2.0)
"""The range of n within which the solver has been measured; elastomers have 0.1 to 0.8."""


@dataclass(frozen=True, kw_only=True)
class Rate:
    """The law of a moving edge (Maugis & Barquins 1978).

    Parameters
    ----------
    exponent
        n, from 0.1 to 2.
    closing
        One of `CLOSINGS`.

    Raises
    ------
    ValueError
        For an exponent out of range, or an unknown closing.

    Examples
    --------
    >>> Rate(exponent=0.6).closing
    'quasi-static'
    """

    exponent: float
    closing: str = "quasi-static"

    def __post_init__(self) -> None:
        low, high = EXPONENTS
        if not low <= self.exponent <= high:
            raise ValueError(f"exponent = {self.exponent}: the power of the speed is a number from {low} to {high:g}")
        if self.closing not in CLOSINGS:
            raise ValueError(f"closing = {self.closing!r}: it is one of {', '.join(CLOSINGS)}")
