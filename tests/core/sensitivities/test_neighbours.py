"""Neighbouring exponents differentiate polynomials of degree 4 exactly, at the ends of the range as well."""

import numpy as np
import pytest

from gradhesion.core.sensitivities.neighbours import exponents_beside


@pytest.mark.parametrize("k", [0.0, 1e-3, 0.004, 0.31, 0.9999, 1.0])
def test_polynomials(k: float) -> None:
    exponents, weights, middle = exponents_beside(k)
    places = np.array(exponents)
    assert np.all((places >= 0.0) & (places <= 1.0))
    for power in range(5):
        slope = np.dot(weights, (places - k) ** power) + middle * float(power == 0)
        assert slope == pytest.approx(float(power == 1), abs=1e-10)
