"""The contents of a table: one record of constants and coefficients that depend on the gradient exponent k alone.

With z = 2 pi a/lambda and alpha_j = (k-1)/2 + j, the universal pair is

    S_j(k, z) = int_0^1 (1 - t^2)^alpha_j sin(z t) dt,    j = 0, 1

Below z = 40 it is kept as polynomials in bins of width 1/2. From there on it is the sum of two parts that vary slowly,
each a polynomial in (40/z)^2: the contributions of the ends t = 0 and t = 1 of the path of steepest descent.
"""

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
