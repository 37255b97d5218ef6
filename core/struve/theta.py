"""The gamma functions of the stiffness theta, as a polynomial of beta^2 in the table of an exponent.

theta (problem/material.py) depends on Poisson's ratio by

    H(beta^2) = 1/[G((3+k+beta)/2) G((3+k-beta)/2) sinc(beta/2)],    sinc(x) = sin(pi x)/(pi x)

and a factor of simple form. H is even in beta, and its one pole near 0 <= beta^2 <= 3 is beta^2 = 4, so that 16
Chebyshev coefficients of (4 - beta^2) H leave 4 eps where three gamma functions take ten times as long.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.chebyshev import chebyshev_fit
from gradhesion.core.struve.layout import THETA_TERMS
from gradhesion.core.types import Floats, Table

_LARGEST: Final = 3.0
"""beta^2 at k = 1 and Poisson's ratio -1."""
NODES, FIT = chebyshev_fit(THETA_TERMS, THETA_TERMS)


@kernel()
def sinc(x: float) -> float:
    """Return sin(pi x)/(pi x)."""
    return math.sin(math.pi * x) / (math.pi * x) if x != 0.0 else 1.0


@kernel()
def gammas_of(k: float, square: float) -> float:
    """Return H at beta^2 = `square`."""
    beta = math.sqrt(square)
    return 1.0 / (math.gamma(0.5 * (3.0 + k + beta)) * math.gamma(0.5 * (3.0 + k - beta)) * sinc(0.5 * beta))


@kernel()
def front_of(k: float) -> float:
    """Return sqrt(pi) (1+k) G(1+k/2) G(2+k)/G((1+k)/2)."""
    gammas = math.gamma(1.0 + 0.5 * k) / math.gamma(0.5 * (1.0 + k)) * math.gamma(2.0 + k)
    return math.sqrt(math.pi) * (1.0 + k) * gammas


@kernel()
def build_theta(k: float, coefficients: Floats, nodes: Floats, fit: Floats) -> None:
    """Fill the coefficients of (4 - beta^2) H, of shape (THETA_TERMS,), by values at NODES and the matrix FIT."""
    coefficients[:] = 0.0
    for j in range(nodes.size):
        square = 0.5 * _LARGEST * (1.0 + nodes[j])
        value = (4.0 - square) * gammas_of(k, square)
        for i in range(nodes.size):
            coefficients[i] += fit[i, j] * value


@kernel()
def gammas_by_table(table: Table, square: float) -> float:
    """Return H from a table (Clenshaw)."""
    t = 2.0 / _LARGEST * square - 1.0
    here, before = 0.0, 0.0
    for i in range(THETA_TERMS - 1, 0, -1):
        here, before = table.theta[i] + 2.0 * t * here - before, here
    return (table.theta[0] + t * here - before) / (4.0 - square)
