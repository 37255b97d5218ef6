"""The contents of a table: one record of constants and coefficients that depend on the gradient exponent k alone.

With z = 2 pi a/lambda and alpha_j = (k-1)/2 + j, the universal pair is

    S_j(k, z) = int_0^1 (1 - t^2)^alpha_j sin(z t) dt,    j = 0, 1

Below z = 40 it is kept as polynomials in bins of width 1/2. From there on it is the sum of two parts that vary slowly,
each a polynomial in (40/z)^2: the contributions of the ends t = 0 and t = 1 of the path of steepest descent.

The coefficients of an interpolated table (interpolated.py) are stored for each piece of [0, 1] that contains k, block
by block. A block is what is filled at once: a bin of the pair or of the moments, four arches, or numbers of fields that
are neighbours. Its coefficients are those of powers of t, -1 <= t <= 1 over the piece, of the shape (terms, numbers).
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

SWITCH: Final = 40.0
"""z from which the expansion at large z is used."""
BIN_WIDTH: Final = 0.5
BINS: Final = 80
BIN_TERMS: Final = 11
"""Coefficients a bin; 10 would give 7e-16, 11 give 3e-16."""
TAIL_TERMS: Final = 8
MANTISSA_BITS: Final = 6
"""The power z^(-(1+k)/2) has one polynomial for each of 2^6 slices of the mantissa."""
POWER_TERMS: Final = 7
EXPONENT_SPAN: Final = 512
"""The power is tabulated for z from 2^-512 up to 2^512."""
MOMENT_START: Final = 2.0
"""z below which the moments of S0 come from their power series."""
MOMENT_SERIES_TERMS: Final = 14
MOMENT_BINS: Final = 76
MOMENT_TERMS: Final = 14
MOMENT_TAIL_TERMS: Final = 24
ARCHES: Final = 256
"""Arches of the fold function that are tabulated, two a wave; those further out are computed on request."""
ARCHES_AT_ONCE: Final = 4
"""Arches that are filled together where a table is interpolated."""
STRETCH_TERMS: Final = 15
"""An odd number; where |eta| <= 0.1 they leave 1e-17."""
FRACTIONAL_NODES: Final = 16
"""Nodes of the fractional integral over one wave: its polynomial leaves 1e-10 of a cosine."""
THETA_TERMS: Final = 16

TABLE: Final = np.dtype(
    [
        ("k", "f8"),
        ("rounding", "f8"),  # its errors over those of a table that is built for its exponent
        ("amplitude", "f8"),  # C = 2^((k-1)/2) G((1+k)/2), the amplitude of z^((1+k)/2) S0
        ("phase", "f8"),  # phi = (1+k) pi/4
        ("cos_phase", "f8"),  # C cos phi
        ("sin_phase", "f8"),  # C sin phi
        ("gamma", "f8"),  # G((1+k)/2)
        ("place", "f8"),  # this and what follows to lacks_arches: see filling.py and current.py
        ("source", "i8"),
        ("recipes", "i8"),
        ("for_forces", "i1"),
        ("lacks_bin", "i1", (BINS,)),
        ("lacks_moments", "i1", (MOMENT_BINS,)),
        ("lacks_arches", "i1", (1 + ARCHES // ARCHES_AT_ONCE,)),
        ("theta_front", "f8"),  # sqrt(pi) (1+k) G(1+k/2) G(2+k)/G((1+k)/2)
        ("theta", "f8", (THETA_TERMS,)),  # see theta.py
        ("tail", "f8", (TAIL_TERMS, 8)),  # Re P0, z Im P0, Re P1, z Im P1, z G0, z G1, z^2 G0', z^2 G1'
        ("power_mantissa", "f8", (2**MANTISSA_BITS, POWER_TERMS)),
        ("jump_tail", "f8", (TAIL_TERMS, 8)),  # Re P0, z Im P0, Re P1, z Im P1, and four of jump_tail.py
        ("slow_tail", "f8", (TAIL_TERMS, 2)),  # z G0, |P0|^2
        ("inverse_stretch", "f8", (STRETCH_TERMS,)),  # of (1 + eta)^(-(1-k)/2) in eta
        ("fractional", "f8", (FRACTIONAL_NODES, FRACTIONAL_NODES + 1)),  # see fractional.py
        ("moment_series", "f8", (MOMENT_SERIES_TERMS, 2)),  # E2/z^(5+k), W/z^(5+k) in z^2
        ("moment_tail", "f8", (MOMENT_TAIL_TERMS, 5)),  # see moments.py
        ("moment_constant", "f8"),
        ("moment_logarithm", "f8"),
        ("power_exponent", "f8", (2 * EXPONENT_SPAN,)),
        ("bins", "f8", (BINS, BIN_TERMS, 4)),  # S0/z, S1/z, S0', S1' in t = 4 z - (2 bin + 1)
        ("moment_bins", "f8", (MOMENT_BINS, MOMENT_TERMS, 2)),  # the moments in t
        ("arches", "f8", (ARCHES + 1, 6)),  # x, X, Q at the inner edge, then at the summit; see arches.py
    ],
    align=True,
)
"""The record; `build_table` in table.py fills it, pair.py and moments.py read it."""
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
