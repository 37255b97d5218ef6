"""A work of adhesion that grows with the speed of the edge: opening at G = w_o [1 + (v/v*)^n]."""

from dataclasses import dataclass
from typing import Final

from gradhesion.core.problem.settings import check_settings, setting

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

    exponent: float = setting(
        "power n of the speed of the edge in its work, 1 + (v/v*)^n", "0.6", ge=EXPONENTS[0], le=EXPONENTS[1]
    )
    closing: str = setting(
        "law of closing: quasi-static whatever the speed, or the same law as for opening",
        '"same"',
        default="quasi-static",
        choices=CLOSINGS,
    )

    def __post_init__(self) -> None:
        check_settings(self)
