"""The parts of the pair of one cosine for a jump between two radii beyond z = 40: oscillating and slow ones, apart.

With S0 = G0 + w0 and S1 = G1 + (k+1)/z w1, where w0 and w1 oscillate (large.py), the wave's part of z^(k+2) S0^2 has
the oscillating integral of moments.py,

    int z^(k+2) (2 G0 w0 + w0^2 - mean) dz = -z^(1+k) [C even1 - S odd1/z + z (2 S C even2 + (C^2 - S^2) odd2/z)]

with S, C = C z^(-n) sin psi, cos psi and four even polynomials, and mean = C^2/2 z^(-1-k) |P0|^2. Here they, |P0|^2 and
z G0 are polynomials in 2 (40/z)^2 - 1 like those of the pair.
"""

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.struve.layout import MOMENT_TAIL_TERMS, SWITCH
from gradhesion.core.types import Floats, Table

_OF_PAIR = 4
"""Lanes that are copied from the pair's tail: Re P0, z Im P0, Re P1, z Im P1."""


@kernel()
def _values(table: Table, t: float, out: Floats) -> None:
    """Put even1, odd1, even2, odd2 and |P0|^2 at 2 (40/z)^2 - 1 = t into `out`, of shape (5,)."""
    tail = table.moment_tail
    w = 0.5 * (1.0 + t) / (SWITCH * SWITCH)
    for lane in range(4):
        column, total = 2 + lane // 2, 0.0
        for m in range(MOMENT_TAIL_TERMS - 2 + lane % 2, -1, -2):
            total = total * w + tail[m, column]
        out[lane] = total
    real, imaginary = 0.0, 0.0
    for m in range(table.tail.shape[0] - 1, -1, -1):
        real = real * t + table.tail[m, 0]
        imaginary = imaginary * t + table.tail[m, 1]
    out[4] = real * real + imaginary * imaginary * w


@kernel()
def build_jump_tail(table: Table, nodes: Floats, fit: Floats) -> None:
    """Fill the three fields of a table whose tail and moments are complete; nodes and fit are those of large.py."""
    terms = nodes.size
    middle, values = np.empty(5), np.empty((terms, 5))
    _values(table, 0.0, middle)
    for j in range(terms):
        _values(table, nodes[j], values[j])
    for power in range(terms):
        for lane in range(_OF_PAIR):
            table.jump_tail[power, lane] = table.tail[power, lane]
        table.slow_tail[power, 0] = table.tail[power, 4]
        for lane in range(5):
            rest = 0.0
            for j in range(terms):
                rest += fit[power, j] * (values[j, lane] - middle[lane])
            total = (middle[lane] if power == 0 else 0.0) + rest
            if lane < _OF_PAIR:
                table.jump_tail[power, _OF_PAIR + lane] = total
            else:
                table.slow_tail[power, 1] = total
    table.inverse_stretch[0] = 1.0
    for j in range(1, table.inverse_stretch.size):
        table.inverse_stretch[j] = -table.inverse_stretch[j - 1] * (0.5 * (1.0 - table.k) + j - 1.0) / j
