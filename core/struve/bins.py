"""The pair below z = 40, as polynomials in bins, from Taylor steps of its differential equation.

    z S0'' + (k+1) S0' + z S0 = 1,    S1 = (1 - (k+1) S0')/z

With h the half width of a bin and z = z_c + h t, the Taylor coefficients s_n of S0 in t obey

    s_(n+2) = [h^2 (n = 0) - h (n+1)(n+k+1) s_(n+1) - h^2 z_c s_n - h^3 s_(n-1)] / (z_c (n+1)(n+2))

The solution of the homogeneous equation decays upwards, so stepping from bin to bin is stable; in double-double
arithmetic the stored coefficients are good to half a unit in the last place.
"""

from fractions import Fraction
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers import double_double as dd
from gradhesion.core.struve.layout import BIN_TERMS, BIN_WIDTH
from gradhesion.core.types import Floats

Taylor: TypeAlias = Floats
"""Taylor coefficients in t, each a sum of two floats: of shape (terms, 2)."""
TAYLOR: Final = 20
"""Taylor coefficients of a bin: as h^20/20! and S0 are small, the rest is below 1e-20."""
_SERIES: Final = 14
"""Terms of the power series at z = 1/4."""


def economisation(taylor_terms: int, terms: int) -> Floats:
    """Return the matrix that turns Taylor coefficients into those of the truncated Chebyshev series.

    Shape (terms, taylor_terms); each column is one power of t, re-expanded in exact rational arithmetic.
    """
    chebyshev = [[Fraction(1)], [Fraction(0), Fraction(1)]]
    while len(chebyshev) < taylor_terms:
        doubled = [Fraction(0), *(2 * c for c in chebyshev[-1])]
        for power, c in enumerate(chebyshev[-2]):
            doubled[power] -= c
        chebyshev.append(doubled)
    matrix = np.zeros((terms, taylor_terms))
    for column in range(taylor_terms):
        rest = [Fraction(0)] * column + [Fraction(1)]
        for degree in range(column, terms - 1, -1):
            factor = rest[degree] / chebyshev[degree][degree]
            for power, c in enumerate(chebyshev[degree]):
                rest[power] -= factor * c
        for power in range(min(terms, len(rest))):
            matrix[power, column] = float(rest[power])
    return matrix


ECONOMISATION: Final = economisation(TAYLOR - 1, BIN_TERMS)


@kernel()
def _start(k: float, z: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return S0 and S0' at a small z from S0 = sum c_n z^(2n+1), c_n = -c_(n-1)/((2n+1)(2n+1+k))."""
    term = dd.divide((1.0, 0.0), dd.two_sum(1.0, k))
    value = dd.scale(term, z)
    slope = term
    for n in range(1, _SERIES):
        odd = 2.0 * n + 1.0
        term = dd.divide(dd.scale(term, -z * z), dd.scale(dd.two_sum(odd, k), odd))
        value = dd.add(value, dd.scale(term, z))
        slope = dd.add(slope, dd.scale(term, odd))
    return value, slope


@kernel()
def over_z(taylor: Taylor, quotient: Taylor, centre: float, half: float) -> None:
    """Put a Taylor series over z = centre + half t into `quotient`."""
    rest = (taylor[0, 0], taylor[0, 1])
    quotient[0, 0], quotient[0, 1] = dd.shrink(rest, centre)
    for n in range(1, len(taylor)):
        rest = dd.add((taylor[n, 0], taylor[n, 1]), dd.scale((quotient[n - 1, 0], quotient[n - 1, 1]), -half))
        quotient[n, 0], quotient[n, 1] = dd.shrink(rest, centre)


@kernel()
def differentiate(taylor: Taylor, slope: Taylor, half: float) -> None:
    """Put the derivative of a Taylor series with respect to z into `slope`."""
    for n in range(len(taylor) - 1):
        slope[n, 0], slope[n, 1] = dd.scale((taylor[n + 1, 0], taylor[n + 1, 1]), (n + 1.0) / half)


@kernel()
def taylor_of(s: Taylor, k: float, centre: float, half: float, source: float) -> None:
    """Continue s[0], s[1] by the recurrence of the equation, whose right side is `source` (1, or 0 for the cosine)."""
    square = half * half
    for n in range(len(s) - 2):
        factor = dd.scale(dd.two_sum(n + 1.0, k), -half * (n + 1.0))
        right = dd.multiply(factor, (s[n + 1, 0], s[n + 1, 1]))
        right = dd.add(right, dd.scale((s[n, 0], s[n, 1]), -square * centre))
        if n == 0:
            right = dd.add(right, (source * square, 0.0))
        else:
            right = dd.add(right, dd.scale((s[n - 1, 0], s[n - 1, 1]), -square * half))
        s[n + 2, 0], s[n + 2, 1] = dd.shrink(right, centre * ((n + 1.0) * (n + 2.0)))


@kernel()
def at_next_centre(taylor: Taylor, terms: int) -> tuple[float, float]:
    """Sum `terms` of a Taylor series at t = 2, the centre of the next bin; return a sum of two floats."""
    total = (0.0, 0.0)
    for n in range(terms - 1, -1, -1):
        total = dd.add(dd.scale(total, 2.0), (taylor[n, 0], taylor[n, 1]))
    return total


@kernel()
def economise(taylor: Taylor, matrix: Floats, coefficients: Floats) -> None:
    """Put a Taylor series at the degree of a bin into `coefficients` (terms,) by a matrix of `economisation`."""
    terms, taylor_terms = matrix.shape
    for j in range(terms):
        rest = 0.0
        for n in range(taylor_terms - 1, terms - 1, -1):
            rest += matrix[j, n] * taylor[n, 0]
        coefficients[j] = taylor[j, 0] + (taylor[j, 1] + rest)


@kernel()
def build_bins(k: float, bins: Floats, matrix: Floats) -> None:
    """Fill bins, of shape (BINS, BIN_TERMS, 4), with S0/z, S1/z, S0', S1'; `matrix` is ECONOMISATION."""
    half = 0.5 * BIN_WIDTH
    s0 = np.zeros((TAYLOR + 2, 2))
    s0_slope = np.zeros((TAYLOR + 2, 2))
    s0_over_z = np.zeros((TAYLOR, 2))
    numerator = np.zeros((TAYLOR, 2))
    s1 = np.zeros((TAYLOR, 2))
    s1_slope = np.zeros((TAYLOR, 2))
    s1_over_z = np.zeros((TAYLOR, 2))
    minus_k1 = dd.scale(dd.two_sum(1.0, k), -1.0)
    value, slope = _start(k, half)
    for i in range(len(bins)):
        centre = BIN_WIDTH * i + half
        s0[0, 0], s0[0, 1] = value
        s0[1, 0], s0[1, 1] = dd.scale(slope, half)
        taylor_of(s0, k, centre, half, 1.0)
        differentiate(s0, s0_slope, half)
        for n in range(TAYLOR):
            term = dd.multiply((s0_slope[n, 0], s0_slope[n, 1]), minus_k1)
            if n == 0:
                term = dd.add(term, (1.0, 0.0))
            numerator[n, 0], numerator[n, 1] = term
        over_z(numerator, s1, centre, half)
        differentiate(s1, s1_slope, half)
        over_z(s0[:TAYLOR], s0_over_z, centre, half)
        over_z(s1, s1_over_z, centre, half)
        economise(s0_over_z, matrix, bins[i, :, 0])
        economise(s1_over_z, matrix, bins[i, :, 1])
        economise(s0_slope, matrix, bins[i, :, 2])
        economise(s1_slope, matrix, bins[i, :, 3])
        value = at_next_centre(s0, TAYLOR + 2)
        slope = at_next_centre(s0_slope, TAYLOR + 1)
