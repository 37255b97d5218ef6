"""Is the profile nowhere negative? Against dense radii, and against punches whose least height is known."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.special import beta

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.contact.touch import front_at, profile_at, touches_at_centre
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.problem.shape import depth_factor_of


def _basis(k: float, rows: list[tuple[float, float, float]]) -> Any:
    return Basis(*tables_of(k), np.array(rows))


def _power(k: float, m: float, factor: float) -> tuple[float, ...]:
    """The curve whose profile is factor (2 pi x)^m + waves of the amplitudes of the series."""
    return Series(factor * m * 0.5 * float(beta(0.5 * m, 0.5 * (1.0 + k))), m, 1.0, 1.0, 0.0)


@pytest.mark.parametrize("k", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("m", [1.0, 2.0, 3.7, 900.0])
def test_the_front(k: float, m: float) -> None:
    # logarithms of the gamma function up to 2,600 leave 1e-12
    assert front_at(k, m) == pytest.approx(depth_factor_of(k, m), rel=1e-12)


@pytest.mark.parametrize("m", [1.0, 1.5, 2.0, 4.0])
def test_a_sine_at_its_threshold(m: float) -> None:
    """factor z^m + sin z: the least of it is 0 where factor = max of -sin z/z^m, here by a bracketed maximum."""
    z = np.linspace(math.pi, 2 * math.pi, 2_000_001)
    critical = float((-np.sin(z) / z**m).max())
    basis = _basis(0.4, [(1.0, 0.0, 1.0)])
    # the grid's maximum is good to 1e-12
    assert touches_at_centre(basis, _power(0.4, m, critical * (1 + 1e-10)), 3.0)
    assert not touches_at_centre(basis, _power(0.4, m, critical * (1 - 1e-10)), 3.0)
    # what lies beyond the radius that is asked for does not count
    assert touches_at_centre(basis, _power(0.4, m, 0.5 * critical), 0.5)


@pytest.mark.parametrize("m", [1.0, 2.0])
def test_the_centre_decides(m: float) -> None:
    """A cone is never below 0 near the centre if its slope is not; a paraboloid with a falling sine always is."""
    falling = _basis(0.0, [(1.0, 0.0, -0.3), (2.0, 0.1, 0.0)])
    assert touches_at_centre(falling, _power(0.0, m, 0.31), 1e-6) == (m == 1.0)
    assert not touches_at_centre(falling, _power(0.0, m, 0.29), 1e-6)
    # 1/2 z^2 - sum (1 - cos n z) a_n has the curvature 1 - sum n^2 a_n there
    for sum_of_curvatures in (1 - 1e-6, 1 + 1e-6):
        bent = _basis(0.0, [(1.0, -0.2, 0.0), (2.0, -0.25 * (sum_of_curvatures - 0.2), 0.0)])
        assert touches_at_centre(bent, _power(0.0, 2.0, 0.5), 1.0) == (sum_of_curvatures < 1.0)


def test_against_dense_radii() -> None:
    """Two hundred random series; a scan of 40 points a shortest wave misses the least by 1 % of the amplitudes."""
    rng = np.random.default_rng(11)
    found = []
    for _ in range(200):
        numbers = sorted(rng.choice(np.arange(1, 12), 3, replace=False))
        rows = [(float(n), float(rng.uniform(-0.2, 1)) / n, float(rng.uniform(-0.1, 0.5)) / n) for n in numbers]
        m = float(rng.choice([1.0, 1.6, 2.0, 5.0]))
        curve, end = _power(0.3, m, 10 ** rng.uniform(-4, 0)), float(rng.uniform(0.2, 3.0))
        basis = _basis(0.3, rows)
        x = np.concatenate([np.geomspace(1e-9, 1e-2, 200), np.arange(0.01, end, 1 / 40 / max(numbers)), [end]])
        heights = np.array([profile_at(basis, curve, place) for place in x])
        one = touches_at_centre(basis, curve, end)
        assert one or heights.min() < 0.01 * sum(math.hypot(even, odd) for _, even, odd in rows)
        assert not one or heights.min() >= -1e-15
        found.append(one)
    assert 40 < sum(found) < 160
