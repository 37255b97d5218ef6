"""Neighbouring exponents differentiate polynomials of degree 4 exactly, at the ends of the range as well."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.sensitivities.neighbours import neighbours_of


@pytest.mark.parametrize("k", [0.0, 1e-3, 0.004, 0.31, 0.9999, 1.0])
def test_polynomials(k: float, table_of: Callable[[float], Any]) -> None:
    tables, weights, middle = neighbours_of(k, table_of)
    places = np.array([table["k"] for table in tables])
    assert np.all((places >= 0.0) & (places <= 1.0))
    for power in range(5):
        slope = np.dot(weights, (places - k) ** power) + middle * float(power == 0)
        assert slope == pytest.approx(float(power == 1), abs=1e-10)
