"""Where the coefficients of an interpolated table are stored: of each piece of [0, 1] that contains k, block by block.

A block is what is filled at once: a bin of the pair or of the moments, four arches, or numbers of fields that are
neighbours. Its coefficients are those of powers of t, -1 <= t <= 1 over the piece, of the shape (terms, numbers).
"""

from dataclasses import dataclass
from typing import Final

from gradhesion.core.struve.layout import ARCHES, ARCHES_AT_ONCE, BIN_TERMS, BINS, MOMENT_BINS, MOMENT_TERMS

TERMS: Final = 8
"""Coefficients of powers of t, at most."""


@dataclass(frozen=True)
class Blocks:
    """The blocks of one field.

    Attributes
    ----------
    field, lacks
        The names of the field, or the first of several, and of the flags of its blocks, "" where all is filled at once.
    number
        How many blocks there are.
    size
        Numbers of a block, a multiple of 4.
    total
        Numbers of the field: the last block ends there, and overlaps the one before where it has to.
    power
        The power of G((1+k)/2) that is taken out.
    first
        The number of doubles before its coefficients.
    terms
        How many coefficients a number has.
    """

    field: str
    lacks: str
    number: int
    size: int
    total: int
    power: int
    first: int = 0
    terms: int = TERMS

    @property
    def end(self) -> int:
        """The number of doubles before what follows its coefficients."""
        return self.first + self.terms * self.size * self.number


OF_BINS: Final = Blocks("bins", "lacks_bin", BINS, 4 * BIN_TERMS, 4 * BIN_TERMS * BINS, 1)
OF_MOMENTS: Final = Blocks(
    "moment_bins", "lacks_moments", MOMENT_BINS, 2 * MOMENT_TERMS, 2 * MOMENT_TERMS * MOMENT_BINS, 2, OF_BINS.end
)
OF_ARCHES: Final = Blocks(
    "arches", "lacks_arches", 1 + ARCHES // ARCHES_AT_ONCE, 6 * ARCHES_AT_ONCE, 6 * (ARCHES + 1), 1, OF_MOMENTS.end
)
OF_FORCES: Final = Blocks("theta_front", "", 3, 32, 81, 0, OF_ARCHES.end)
OF_MANTISSAS: Final = Blocks("power_mantissa", "", 14, 32, 448, 0, OF_FORCES.end, 6)
OF_CYCLES: Final = Blocks("jump_tail", "", 12, 32, 367, 0, OF_MANTISSAS.end)
OF_ENERGIES: Final = Blocks("moment_series", "", 5, 32, 150, 2, OF_CYCLES.end)
"""Fields that every force reads, theta_front to power_mantissa; and that cycles read: to fractional, to
moment_logarithm."""
ALL: Final = (OF_BINS, OF_MOMENTS, OF_ARCHES, OF_FORCES, OF_MANTISSAS, OF_CYCLES, OF_ENERGIES)
