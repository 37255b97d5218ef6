"""Rules for integrals of Abel's kind: nodes, and weights that account for the branch point at one end.

Panels are no wider than a width, which is half the shortest wave of what is integrated, and no wider than their
distance from s = 0, where profiles have branch points of their own. On each the error is that of Gauss's rule of 24
points: below 1e-14 of the largest value for a wave that is half a panel long or more.
"""

import math
from functools import lru_cache
from typing import Final

import numpy as np
from scipy.special import roots_jacobi, roots_legendre

from gradhesion.core.equations._arguments import Array

_NODES: Final = 24
_LEGENDRE: Final = roots_legendre(_NODES)
_GRADES: Final = 56
"""Halvings towards 0, after which the rest of the integral of a bounded function is below rounding."""


def below(a: float, power: float, widest: float = math.inf) -> tuple[Array, Array]:
    """Return nodes s and weights w, sum w g(s) = int_0^a g(s) (a^2-s^2)^power ds, for power > -1."""
    edges = [a]
    edges.append(a - min(0.5 * a, widest))
    for _ in range(_GRADES):
        while edges[-1] > 2.0 * widest:
            edges.append(edges[-1] - widest)
        edges.append(0.5 * edges[-1])
    edges.append(0.0)
    limits = np.array(edges[::-1])
    s, w = _legendre(limits[:-1])
    last, weights = _jacobi(limits[-2], a, power, upper=True)
    return (
        np.concatenate([s, last]),
        np.concatenate([w * ((a - s) * (a + s)) ** power, weights * (a + last) ** power]),
    )


def beyond(r: float, a: float, power: float, widest: float = math.inf) -> tuple[Array, Array]:
    """Return nodes s and weights w, sum w g(s) = int_r^a g(s) (s^2-r^2)^power ds, for 0 < r < a and power > -1."""
    edges = [r, min(a, r + min(widest, 0.5 * r))]
    while edges[-1] < a:
        low = edges[-1]
        edges.append(min(a, low + min(widest, low - r)))
    limits = np.array(edges)
    first, weights = _jacobi(r, limits[1], power, upper=False)
    s, w = _legendre(limits[1:])
    return (
        np.concatenate([first, s]),
        np.concatenate([weights * (first + r) ** power, w * ((s - r) * (s + r)) ** power]),
    )


def from_zero(a: float, power: float, widest: float = math.inf) -> tuple[Array, Array]:
    """Return nodes s and weights w, sum w g(s) = int_0^a g(s) s^power ds, for power > -1 and g smooth at 0."""
    first = min(a, widest)
    edges = np.linspace(first, a, 1 + math.ceil((a - first) / widest)) if a > first else np.array([first])
    near, weights = _jacobi(0.0, first, power, upper=False)
    s, w = _legendre(edges)
    return np.concatenate([near, s]), np.concatenate([weights, w * s**power])


def _legendre(edges: Array) -> tuple[Array, Array]:
    """Return Gauss's rule on every panel between edges."""
    nodes, weights = _LEGENDRE
    centre, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * (edges[1:] - edges[:-1])
    return (centre[:, None] + half[:, None] * nodes).ravel(), (half[:, None] * weights).ravel()


@lru_cache(maxsize=64)
def jacobi_rule(alpha: float, beta: float) -> tuple[Array, Array]:
    """Return the rule on (-1, 1), kept: it takes as long as the panels of a point."""
    nodes, weights = roots_jacobi(_NODES, alpha, beta)
    return nodes, weights


def _jacobi(low: float, high: float, power: float, *, upper: bool) -> tuple[Array, Array]:
    """Return the rule of int (high-s)^power g ds, or of int (s-low)^power g ds, on one panel."""
    nodes, weights = jacobi_rule(power, 0.0) if upper else jacobi_rule(0.0, power)
    half = 0.5 * (high - low)
    return 0.5 * (high + low) + half * nodes, half ** (1.0 + power) * weights
