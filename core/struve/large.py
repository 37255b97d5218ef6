"""The pair from z = 40 on: steepest descent from t = 0 and from t = 1.

With alpha_j = (k-1)/2 + j, phi_j = (1+k) pi/4 + j pi/2 and C_j = 2^alpha_j G(1 + alpha_j),

    S_j = G_j(z) + Im[ C_j z^(-1-alpha_j) e^(i (z - phi_j)) P_j(z) ]
    G_j = int_0^inf (1+u^2)^alpha_j e^(-z u) du
    P_j = 1/G(1+alpha_j) int_0^inf v^alpha_j e^(-v) (1 + i v/(2 z))^alpha_j dv

Re P, z Im P, z G and z^2 G' are even in z and vary slowly: each is one polynomial in 2 (40/z)^2 - 1, fitted at
Chebyshev nodes to the asymptotic series, which is cut at its smallest term (without that it is wrong by 1e-12 at z =
40).
"""

import math
from typing import Final

import numpy as np
from numpy.polynomial import chebyshev

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.struve.layout import SWITCH, TAIL_TERMS
from gradhesion.core.types import Floats

NODES: Final = np.cos(np.pi * (2 * np.arange(TAIL_TERMS) + 1) / (2 * TAIL_TERMS))
_DEGREES: Final = np.arange(TAIL_TERMS)[:, None]
_TRANSFORM: Final = np.cos(_DEGREES * np.arccos(NODES)) * np.where(_DEGREES > 0, 2.0, 1.0) / TAIL_TERMS
_MONOMIALS: Final = np.array(
    [np.pad(chebyshev.cheb2poly(row), (0, TAIL_TERMS - 1 - m)) for m, row in enumerate(np.eye(TAIL_TERMS))]
).T
FIT: Final = _MONOMIALS @ _TRANSFORM
"""From the values at `NODES` to the coefficients of the powers of t."""
_NEGLIGIBLE: Final = 1e-18


@kernel()
def _descent_from_one(alpha: float, z: float) -> tuple[float, float]:
    """Return Re P and z Im P."""
    real, imaginary, term = 1.0, 0.0, 1.0
    for n in range(40):
        factor = (alpha - n) * (1.0 + alpha + n) / (2.0 * z * (n + 1.0))
        if abs(factor) >= 1.0:
            break
        term *= factor
        quarter = n & 3
        if quarter == 0:
            imaginary += term
        elif quarter == 1:
            real -= term
        elif quarter == 2:
            imaginary -= term
        else:
            real += term
        if abs(term) < _NEGLIGIBLE:
            break
    return real, imaginary * z


@kernel()
def _descent_from_zero(alpha: float, z: float) -> tuple[float, float]:
    """Return z G and z^2 G'."""
    value, slope = 1.0, 1.0
    value_term, slope_term = 1.0, 1.0
    for n in range(40):
        factor = (alpha - n) * 2.0 * (2.0 * n + 1.0) / (z * z)
        if abs(factor) >= 1.0 or abs(slope_term) < _NEGLIGIBLE:
            break
        value_term *= factor
        slope_term *= (alpha - n) * 2.0 * (2.0 * n + 3.0) / (z * z)
        value += value_term
        slope += slope_term
    return value, -slope


@kernel()
def _slow_parts(k: float, z: float, out: Floats) -> None:
    """Put P0, P1, G0, G1 and the slopes of these, as the columns of `tail` (layout.py), at z into `out`, shape (8,)."""
    alpha = 0.5 * (k - 1.0)
    out[0], out[1] = _descent_from_one(alpha, z)
    out[2], out[3] = _descent_from_one(alpha + 1.0, z)
    out[4], out[6] = _descent_from_zero(alpha, z)
    out[5], out[7] = _descent_from_zero(alpha + 1.0, z)


@kernel()
def build_tail(k: float, tail: Floats, nodes: Floats, fit: Floats) -> None:
    """Fill `tail`, of shape (TAIL_TERMS, 8), by the values at NODES and the matrix FIT.

    The value at the middle is left out of the fit to keep its rounding small.
    """
    lanes = tail.shape[1]
    middle = np.empty(lanes)
    values = np.empty((nodes.size, lanes))
    _slow_parts(k, SWITCH * math.sqrt(2.0), middle)
    for j in range(nodes.size):
        _slow_parts(k, SWITCH / math.sqrt(0.5 * (1.0 + nodes[j])), values[j])
    for power in range(nodes.size):
        for lane in range(lanes):
            total = middle[lane] if power == 0 else 0.0
            rest = 0.0
            for j in range(nodes.size):
                rest += fit[power, j] * (values[j, lane] - middle[lane])
            tail[power, lane] = total + rest
