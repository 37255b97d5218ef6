"""The slowness of the edge against its definition at 30 digits."""

import math

import mpmath
import pytest

from gradhesion.core.rate.law import Law, lag_of, slowness


@pytest.mark.parametrize("n", [0.1, 0.6, 2.0])
@pytest.mark.parametrize(("root", "sense"), [(1.0, 1.0), (1.0, -1.0), (math.sqrt(0.3), -1.0)])
@pytest.mark.parametrize("lag", [1e-12, 1e-3, 0.37])
def test_slowness(n: float, root: float, sense: float, lag: float) -> None:
    law = Law(n, root, sense, 1.0)

    def exact(lag: mpmath.mpf) -> mpmath.mpf:
        rho = mpmath.mpf(root) + sense * lag
        return (rho**2 - 1 if sense > 0 else mpmath.mpf(root) ** 2 / rho**2 - 1) ** (-1 / mpmath.mpf(n))

    value, slope = slowness(law, lag)
    assert value == pytest.approx(float(exact(mpmath.mpf(lag))), rel=2e-15 / n)
    assert slope == pytest.approx(float(mpmath.diff(exact, mpmath.mpf(lag)) / exact(mpmath.mpf(lag))), rel=1e-12)
    assert lag_of(law, value) == pytest.approx(lag, rel=1e-14)


def test_an_edge_that_follows_at_once() -> None:
    law = Law(0.6, 0.5, -1.0, 1.0)
    assert slowness(law, 0.5) == slowness(law, 0.8) == (0.0, 0.0)
