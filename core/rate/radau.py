"""Radau's collocation of high order: nodes, weights, and a measure of how fast a polynomial converges.

For y' = f the values at the nodes are y_i = y_0 + h sum_j INTEGRALS[i, j] f_j, the last of them at the end of the step:
order 2 STAGES - 1, L-stable, stiffly accurate (Hairer & Wanner, Solving Ordinary Differential Equations II, IV.5). The
nodes are the roots of P_s(2c - 1) - P_(s-1)(2c - 1).
"""

from typing import Final

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

STAGES: Final = 6


def _nodes(stages: int) -> NDArray[np.float64]:
    """Return the nodes in (0, 1], refined by Newton's method."""
    series = np.zeros(stages + 1)
    series[-1], series[-2] = 1.0, -1.0
    t = np.sort(legendre.legroots(series).real)
    for _ in range(3):
        t[:-1] -= legendre.legval(t[:-1], series) / legendre.legval(t[:-1], legendre.legder(series))
    t[-1] = 1.0
    return 0.5 * (1.0 + t)


def _integrals(nodes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the integrals from 0 to node i of Lagrange's polynomial of node j."""
    places, shares = legendre.leggauss(nodes.size)
    found = np.empty((nodes.size, nodes.size))
    for j in range(nodes.size):
        others = np.delete(nodes, j)
        for i, end in enumerate(nodes):
            t = 0.5 * end * (1.0 + places)
            found[i, j] = 0.5 * end * shares @ np.prod((t[:, None] - others) / (nodes[j] - others), axis=1)
    return found


NODES: Final = _nodes(STAGES)
INTEGRALS: Final = _integrals(NODES)
TAIL: Final = np.ascontiguousarray(np.linalg.inv(legendre.legvander(2.0 * NODES - 1.0, STAGES - 1))[-2:])
"""Of values at the nodes, the last two coefficients of the Legendre series through them; shape (2, STAGES)."""
SPARED: Final = STAGES / (STAGES - 1.0)
"""With r the size of those over that of the values, the error of a step is r^SPARED times their size, or less."""
ORDER: Final = 2.0 * STAGES - 1.0
