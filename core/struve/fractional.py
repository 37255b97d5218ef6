"""The fractional integral of order c = (1-k)/2, by which the surface outside a contact follows from its depths.

For a function on [0, 1] that is known at the nodes of Gauss's rule, and thereby as a polynomial F, a table has

    (J F)(x) = c int_0^1 v^(c-1) F(x (1 - v)) dv = x^(-c) c int_0^x (x - y)^(c-1) F(y) dy

at the nodes and at x = 1. J is an average with positive weights, for k -> 1 the value F(x) itself, and exact for the
polynomial. It needs

    c int_0^1 v^(c-1) P_m(2v - 1) dv = prod_{i=1}^{m} (c - i)/(c + i)
"""

from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.struve.layout import FRACTIONAL_NODES
from gradhesion.core.types import Floats

_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(FRACTIONAL_NODES)
NODES: Final = 0.5 * (1.0 + _PLACES)
WEIGHTS: Final = 0.5 * _WEIGHTS
_BARYCENTRIC: Final = (-1.0) ** np.arange(FRACTIONAL_NODES) * np.sqrt(NODES * (1.0 - NODES) * WEIGHTS)


@kernel()
def interpolated(values: Floats, x: float) -> float:
    """Return at 0 <= x <= 1 the polynomial of some values at NODES, of shape (FRACTIONAL_NODES,): of J F as of F."""
    total, weights = 0.0, 0.0
    for i in range(NODES.size):
        away = x - NODES[i]
        if away == 0.0:
            value: float = values[i]
            return value
        part = _BARYCENTRIC[i] / away
        total += part * values[i]
        weights += part
    return total / weights


@kernel()
def _end_weights(c: float, weights: Floats) -> None:
    """Fill the weights (FRACTIONAL_NODES,) with which values at NODES give c int_0^1 v^(c-1) F(v) dv."""
    for i in range(weights.size):
        argument = 2.0 * NODES[i] - 1.0
        before, here, moment, total = 0.0, 1.0, 1.0, 0.0
        for m in range(weights.size):
            total += (2.0 * m + 1.0) * moment * here
            moment *= (c - (m + 1.0)) / (c + (m + 1.0))
            before, here = here, ((2.0 * m + 1.0) * argument * here - m * before) / (m + 1.0)
        weights[i] = WEIGHTS[i] * total


@kernel()
def build_fractional(k: float, matrix: Floats) -> None:
    """Fill the columns of J at NODES, and the last one, J at 1: of shape (FRACTIONAL_NODES, FRACTIONAL_NODES + 1)."""
    count = NODES.size
    weights = np.empty(count)
    _end_weights(0.5 * (1.0 - k), weights)
    matrix[:, :] = 0.0
    for i in range(count):
        matrix[i, count] = weights[count - 1 - i]
    parts = np.empty(count)
    for row in range(count):
        for j in range(count):
            place = NODES[row] * (1.0 - NODES[j])
            total = 0.0
            for i in range(count):
                parts[i] = _BARYCENTRIC[i] / (place - NODES[i])  # no product of two nodes is a node
                total += parts[i]
            for i in range(count):
                matrix[i, row] += weights[j] * parts[i] / total
