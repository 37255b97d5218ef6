"""Radau's rule by what it integrates exactly."""

import numpy as np
from numpy.polynomial import legendre

from gradhesion.core.rate.radau import INTEGRALS, NODES, STAGES, TAIL

EPS = 2.0**-52


def test_a_step_integrates_polynomials_of_twice_the_degree() -> None:
    for degree in range(2 * STAGES - 1):
        assert abs(INTEGRALS[-1] @ NODES**degree - 1.0 / (degree + 1.0)) < 4 * EPS
    assert abs(INTEGRALS[-1] @ NODES ** (2 * STAGES - 1) - 0.5 / STAGES) > 1e-8


def test_nodes_integrate_polynomials_of_their_number() -> None:
    for degree in range(STAGES):
        assert np.abs(INTEGRALS @ NODES**degree - NODES ** (degree + 1) / (degree + 1.0)).max() < 4 * EPS
    assert NODES[-1] == 1.0


def test_the_tail_is_the_end_of_the_legendre_series() -> None:
    coefficients = np.arange(1.0, STAGES + 1.0)
    values = legendre.legval(2.0 * NODES - 1.0, coefficients)
    assert np.abs(TAIL @ values - coefficients[-2:]).max() < 100 * STAGES * EPS
