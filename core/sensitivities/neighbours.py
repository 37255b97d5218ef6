"""The derivative by the gradient exponent: values at four neighbouring exponents, each with a table of its own.

What is differentiated is a smooth function of k (sensitivities/jump_slopes.py), beyond both ends of 0 <= k <= 1 as
well, where there is no solid but still a universal pair (k > -1): five points give it to some 2e-12.
"""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.problem.shape import depth_factor_of
from gradhesion.core.types import Floats

_STEP: Final = 2.0**-11
"""Rounding leaves some eps/step, 5e-13, and the formula step^4/30 of the fifth derivative, which is (ln z)^5/32."""
_PLACES: Final = (-2.0, -1.0, 1.0, 2.0)
"""In steps; the exponent itself has no weight."""
_WEIGHTS: Final = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0


class Near(NamedTuple):
    """A curve at neighbouring exponents of the gradient."""

    tables: Any  # their tables, of shape (4,)
    curves: Floats  # b and g of each, of shape (4, 2)
    weights: Floats  # their weights in d/dk, of shape (4,)


def exponents_beside(k: float) -> tuple[list[float], NDArray[np.float64]]:
    """Return four exponents next to k, 0 to 1, and their weights in d/dk (Fornberg 1988)."""
    return [k + _STEP * place for place in _PLACES], _WEIGHTS / _STEP


def depth_factor_by_k(k: float, exponent: float) -> float:
    """Return the slope by k of ln of the factor of a punch of an exponent (`depth_factor_of` of problem/shape.py)."""
    exponents, weights = exponents_beside(k)
    return float(weights @ np.log([depth_factor_of(other, exponent) for other in exponents]))
