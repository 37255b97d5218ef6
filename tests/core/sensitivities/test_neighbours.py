"""Neighbouring exponents differentiate polynomials of degree 4 exactly, and what is beyond the ends to 3e-12."""

import numpy as np
import pytest

from gradhesion.core.sensitivities.neighbours import exponents_beside


@pytest.mark.parametrize("k", [0.0, 1e-3, 0.004, 0.31, 0.9999, 1.0])
def test_polynomials(k: float) -> None:
    exponents, weights = exponents_beside(k)
    places = np.array(exponents)
    for power in range(5):
        slope = np.dot(weights, (places - k) ** power)
        assert slope == pytest.approx(float(power == 1), abs=1e-10)
