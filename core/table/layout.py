"""The layout of a table: what stands in each row, and in which unit.

With y = 2 pi a/lambda, in units of the stretch at y = 1, a curve of equilibrium is

    depth(y) = B y^m + g U(y) - y E(y)            U  = y sum_n n [cos_n S0(n y) + sin_n C0(n y)],  E = y^(-(1+k)/2)
    load(y)  = T [depth - mu B y^m - g U1(y)]     U1 = y sum_n n [cos_n S1(n y) + sin_n C1(n y)],  T = y^(1+k)

with mu = (1+k)/(1+k+m) (3.9, 3.10). Its slopes share one function, D(q) = B m y^(m-1) + g U' - q E:

    d depth/dy = D((1-k)/2),    d load/dy = T D((3+k)/2)

A table holds all of this that does not depend on B and g. It is cut into bins: geometric ones towards 0, then uniform
ones, eight for each shortest wave. Within a bin U, U1, y^m and E are polynomials of degree 11 in t, -1 < t < 1.

On an interface whose toughness varies with the radius, kappa(y) multiplies E. Then the lane U holds g U - W with
W = (kappa - 1) y E, so that the depth keeps its form with g = 1, and the row KE holds kappa E.
"""

from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.jit import leaf
from gradhesion.core.table.functions import Functions
from gradhesion.core.types import Floats

N: Final = 12
"""Coefficients of a bin: y^p at a ratio of 5/4, and cos y over an eighth of a wave, to 1e-15."""
GEOMETRIC: Final = 90
"""Bins below the uniform ones."""
RATIO: Final = 1.25
"""Of the ends of a geometric bin: 1.25^-90 is 2e-9."""
FIRST: Final = 4
"""The uniform bins begin here, in widths: at half the shortest wave."""
PER_WAVE: Final = 8
"""Uniform bins of the shortest wave."""
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(N)
"""Gauss's rule on (-1, 1), at whose points bins are sampled."""

# Rows of `nodes` at the lower edge of each bin (the last column is the upper edge of the last bin).
Y, SLOPE, V, E, KE, P, U, U1, T = range(9)
# y; m y^(m-1); U'; E; kappa E; y^m; U; U1; y^(1+k)
QUP, QPOW, RLOW, RPOW = range(9, 13)
# running bounds: largest V/E up to here; SLOPE/E; least V/(y E) from here on; SLOPE/(y E)
HM, HP, HPP, HU, HPU, HUU = range(13, 19)
# integrals from 0 to the edges of geometric bins: of y kappa^2, and of y^k times y^m, y^2m, U, y^m U, U^2
# Rows of `nodes` of each bin.
BV, BP, BE = range(19, 22)
# bounds of h^2/2 times the second derivatives of U', m y^(m-1) and E, h being the half width
M0, K0, K1, K2, KU, KUU, KV = range(22, 29)
# integrals over the bin of y kappa^2, and of y^k times 1, u, u^2, U, u U, U^2, where u = y^m - PC
PC, YC, HALF = range(29, 32)
# y^m at the centre; the centre; the half width
ROWS: Final = 32
PU, PU1, PP, PE, PW = range(5)
"""Lanes of `polys`: U, U1, y^m, E, and W of an interface with a pattern of toughness."""
LANES: Final = 4
"""Lanes of an interface without pattern."""


class Table(NamedTuple):
    """The functions of one exponent, power and series, as far as they are filled.

    k           exponent of the gradient
    exponent    m, the power of the punch
    share       mu = (1+k)/(1+k+m)
    start       y at which the uniform bins begin
    width       of a uniform bin
    lowest      a bound below (U - U1)/(y E)
    geometric   number of geometric bins (0: a piece of uniform bins alone)
    bins        number of bins that are filled
    nodes       rows at edges and of bins, (ROWS, at least bins + 1)
    polys       coefficients of powers of t, (at least bins, LANES or LANES + 1, N)
    """

    k: float
    exponent: float
    share: float
    start: float
    width: float
    lowest: float
    geometric: int
    bins: int
    nodes: Floats
    polys: Floats


class Source(NamedTuple):
    """What bins of one exponent are filled from, at any radius (filling.py).

    k, exponent, start, width   as of `Table`
    waves       the harmonics, rows (n, cos, sin)
    functions   S and C of this exponent
    far_waves   expansions of U and U1 beyond y = 40 at every point of the bins of one wave, (2, TAIL, bins, N)
    far_mean    of their part without waves, (2, TAIL)
    form        EXACT, or the leading terms of short waves (leading.py)
    shift       the uniform bins end at (a whole number + shift) width
    """

    k: float
    exponent: float
    start: float
    width: float
    waves: Floats
    functions: Functions
    far_waves: Floats
    far_mean: Floats
    form: int
    shift: float


EXACT, BY_DEPTH, BY_LOAD = range(3)
"""Forms of a table: exact; the leading terms of depth; those of load."""


@leaf
def end_of(table: Table) -> float:
    """Return the y at which a table ends."""
    return table.nodes[Y, table.bins]


def span_of(table: Table) -> float:
    """Return the y at which a table ends, outside kernels."""
    return float(table.nodes[Y, table.bins])
