"""Chebyshev coefficients from values at the nodes."""

import numpy as np
from numpy.polynomial import Chebyshev

from gradhesion.core.numbers.chebyshev import chebyshev_fit

EPS = 2.0**-52


def test_a_polynomial_gives_its_coefficients() -> None:
    coefficients = np.random.default_rng(4).normal(size=12)
    nodes, fit = chebyshev_fit(20, 12)
    np.testing.assert_allclose(fit @ Chebyshev(coefficients)(nodes), coefficients, atol=40 * EPS)


def test_what_is_left_out_is_aliased_to_what_is_not_taken() -> None:
    nodes, fit = chebyshev_fit(16, 8)
    for degree in range(8, 24):  # T_n looks like T_(32-n) at 16 nodes
        values = Chebyshev.basis(degree)(nodes)
        np.testing.assert_allclose(fit @ values, 0.0, atol=40 * EPS)
