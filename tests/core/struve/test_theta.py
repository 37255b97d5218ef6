"""The gamma functions of theta from a table, against 40 digits."""

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.struve.theta import front_of, gammas_by_table, gammas_of

EPS = 2.0**-52


def _truth(k: float, square: float) -> mpmath.mpf:
    k, beta = mpmath.mpf(k), mpmath.sqrt(mpmath.mpf(square))
    sinc = mpmath.sinc(mpmath.pi * beta / 2)
    return 1 / (mpmath.gamma((3 + k + beta) / 2) * mpmath.gamma((3 + k - beta) / 2) * sinc)


@pytest.mark.parametrize("k", [0.0, 1e-8, 0.31, 0.5, 0.77, 1.0 - 1e-8, 1.0])
def test_against_forty_digits(k: float, table_of: Callable[[float], Any]) -> None:
    mpmath.mp.dps = 40
    table = table_of(k)
    for square in np.linspace(0.0, 3.0, 61).tolist():
        truth = _truth(k, square)
        # three gamma functions of 3 ulp at most; 16 coefficients whose sizes add up to twice the value
        assert abs(gammas_of(k, square) / truth - 1) <= 12 * EPS
        assert abs(gammas_by_table(table, square) / truth - 1) <= 16 * EPS
    front = mpmath.sqrt(mpmath.pi) * (1 + mpmath.mpf(k)) * mpmath.gamma(1 + mpmath.mpf(k) / 2)
    front *= mpmath.gamma(2 + mpmath.mpf(k)) / mpmath.gamma((1 + mpmath.mpf(k)) / 2)
    assert table["theta_front"] == front_of(k)
    assert abs(front_of(k) / front - 1) <= 12 * EPS
