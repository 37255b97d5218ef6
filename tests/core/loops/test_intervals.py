"""Profile intervals: of a linear problem its own, and where the misfit has grown to what it is to grow to."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from scipy.optimize import least_squares

from gradhesion.core.loops.intervals import profile_interval


class Line:
    """A straight line through points: intercept and slope, or what is made of the slope."""

    def __init__(self, power: float = 1.0, high: float = 50.0) -> None:
        rng = np.random.default_rng(3)
        self.x = np.linspace(0.0, 1.0, 40)
        self.y = 2.0 + 3.0 * self.x + 0.2 * rng.standard_normal(40)
        self.power = power
        self.low, self.high = np.array([-50.0, 0.1]), np.array([50.0, high])

    def residual(self, vector: Any) -> Any:
        return (self.y - vector[0] - vector[1] ** self.power * self.x) / 0.2

    def refined(self, start: Any, *, held: Sequence[int] = (), most: int = 60, tolerance: float = 1e-14) -> Any:
        free = [i for i in range(2) if i not in held]

        def whole(part: Any) -> Any:
            vector = start.copy()
            vector[free] = part
            return vector

        done = least_squares(
            lambda part: self.residual(whole(part)), start[free], max_nfev=most, xtol=tolerance, ftol=tolerance
        )
        done.x = whole(done.x)
        return done


def ends(line: Any, number: int) -> tuple[tuple[float, float], Any, Any]:
    best = line.refined(np.array([1.0, 1.0])).x
    step = 1e-6
    jacobian = np.column_stack(
        [(line.residual(best + step * unit) - line.residual(best - step * unit)) / (2 * step) for unit in np.eye(2)]
    )
    covariance = np.linalg.inv(jacobian.T @ jacobian)
    along = covariance[number] / np.sqrt(covariance[number, number])
    return profile_interval(line, best, number, along, 1.96, 1.0), best, along


@pytest.mark.parametrize("number", [0, 1])
def test_of_a_linear_problem_they_are_its_own(number: int) -> None:
    (low, high), best, along = ends(Line(), number)
    assert low == pytest.approx(best[number] - 1.96 * along[number], rel=1e-6)
    assert high == pytest.approx(best[number] + 1.96 * along[number], rel=1e-6)


def test_they_are_those_of_a_number_whatever_is_made_of_it() -> None:
    (low, high), _, _ = ends(Line(), 1)
    (cube_low, cube_high), best, along = ends(Line(power=3.0), 1)
    assert cube_low**3 == pytest.approx(low, rel=0.02 * (high - low) / low)
    assert cube_high**3 == pytest.approx(high, rel=0.02 * (high - low) / high)
    assert best[1] - cube_low > 1.02 * 1.96 * along[1] > 1.0 * (cube_high - best[1]), "it is not even"


def test_they_end_at_the_end_of_a_range() -> None:
    (_, high), best, _ = ends(Line(high=3.2), 1)
    assert best[1] < 3.2
    assert high == 3.2
