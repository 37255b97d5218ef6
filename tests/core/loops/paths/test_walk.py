"""The radii that a level passes as it grows, of functions whose extrema and landings are known."""

import numpy as np
import pytest

from gradhesion.core.loops.paths.walk import climb, met


def cubic(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """a^3 - 3a, which has its maximum 2 at -1 and is 2 again at 2, with its derivative."""
    return a**3 - 3.0 * a, 3.0 * a**2 - 3.0


@pytest.mark.parametrize("count", [11, 51, 1001])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_of_a_cubic_the_fold_and_the_landing_are_found(count: int, sign: float) -> None:
    """Also in a mirror, where the radius falls; cubics are exact for a cubic."""
    a = np.union1d(np.linspace(-2.0, 3.0, count), [-1.0, 1.0])
    level, rate = cubic(a)
    radii, jump = climb(sign * a, level, sign * rate, -10.0)
    at = int(np.flatnonzero(jump)[1])
    assert sign * radii[at - 1] == -1.0
    assert sign * radii[at] == pytest.approx(2.0, abs=1e-12)
    assert np.array_equal(np.flatnonzero(jump), [0, at])
    assert (np.diff(sign * radii) > 0.0).all()


def test_what_is_below_all_before_is_passed_over() -> None:
    """Of waves that grow only the first and the highest are reached."""
    folds = 0.5 * np.arccos(-1.0 / 6.0) + np.pi * np.arange(4)
    a = np.union1d(np.linspace(0.0, 10.0, 201), [*folds, *(np.pi - folds + 2.0 * np.pi)])
    radii, jump = climb(a, a + 3.0 * np.sin(2.0 * a), 1.0 + 6.0 * np.cos(2.0 * a), 0.0)
    landed = np.flatnonzero(jump)[1:]
    assert landed.size == 3
    assert np.isin(radii[landed - 1], folds).all()
    np.testing.assert_allclose(*(radii[at] + 3.0 * np.sin(2.0 * radii[at]) for at in (landed, landed - 1)), atol=1e-6)


def test_a_level_is_met_on_a_branch_or_where_a_jump_over_it_ends() -> None:
    a = np.union1d(np.linspace(-2.0, 3.0, 41), [-1.0, 1.0])
    walk = climb(a, *cubic(a), -10.0)
    level, rate = cubic(walk[0])
    assert met(*walk, level, rate, 8.125) == pytest.approx(2.5, abs=1e-12)
    assert met(*walk, level, rate, -2.0) == -2.0
    assert np.isnan(met(*walk, level, rate, 18.1))
    depth = np.arange(walk[0].size, dtype=float)  # another coordinate, which a jump passes over
    landing = int(np.flatnonzero(walk[1])[1])
    assert met(*walk, depth, 0.0 * depth + 1.0, landing - 0.5) == walk[0][landing]


def test_a_level_that_starts_high_lands_on_the_first_that_is_higher() -> None:
    a = np.linspace(0.0, 4.0, 41)
    radii, jump = climb(a, a**2, 2.0 * a, 4.0)
    assert jump[0]
    assert radii[0] == pytest.approx(2.0, abs=1e-9)
    assert climb(a, a**2, 2.0 * a, 100.0)[0].size == 0
