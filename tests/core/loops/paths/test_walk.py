"""The states that a contact passes as a level grows, of functions whose extrema and landings are known."""

import numpy as np
import pytest

from gradhesion.core.loops.paths.walk import between, climb, met


def states(level: np.ndarray, rate: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Rows of a level and of the radius itself, with their derivatives."""
    return np.stack([level, a, rate, np.ones(a.size)])


def cubic(a: np.ndarray) -> np.ndarray:
    """a^3 - 3a, which has its maximum 2 at -1 and is 2 again at 2: cubics are exact for it."""
    return states(a**3 - 3.0 * a, 3.0 * a**2 - 3.0, a)


@pytest.mark.parametrize("count", [11, 52, 1001])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_of_a_cubic_the_fold_and_the_landing_are_found(count: int, sign: float) -> None:
    """Also in a mirror, where the level falls."""
    a = np.linspace(-2.0, 3.0, count)
    radii, passed, jump = climb(a, sign * cubic(a), 0, sign, -10.0)
    at = int(np.flatnonzero(jump)[1])
    assert radii[at - 1] == pytest.approx(-1.0, abs=1e-12)
    assert radii[at] == pytest.approx(2.0, abs=1e-12)
    assert np.array_equal(np.flatnonzero(jump), [0, at])
    assert (np.diff(radii) > 0.0).all()
    expected = sign * cubic(radii)
    np.testing.assert_allclose(passed, expected, atol=1e-9)


def test_what_is_below_all_before_is_passed_over() -> None:
    """Of waves that grow only the first and the highest are reached."""
    a = np.linspace(0.0, 10.0, 201)
    rows = states(a + 3.0 * np.sin(2.0 * a), 1.0 + 6.0 * np.cos(2.0 * a), a)
    radii, passed, jump = climb(a, rows, 0, 1.0, 0.0)
    landed = np.flatnonzero(jump)[1:]
    assert landed.size == 3
    folds = 0.5 * np.arccos(-1.0 / 6.0) + np.pi * np.arange(3)
    np.testing.assert_allclose(radii[landed - 1], folds, atol=1e-5)
    np.testing.assert_allclose(passed[0, landed], passed[0, landed - 1], atol=1e-6)
    np.testing.assert_allclose(radii[landed] + 3.0 * np.sin(2.0 * radii[landed]), passed[0, landed], atol=1e-5)


def test_a_level_is_met_on_a_branch_or_where_a_jump_over_it_ends() -> None:
    a = np.linspace(-2.0, 3.0, 41)
    way = climb(a, cubic(a), 0, 1.0, -10.0)
    at, share = met(*way, (1.0, 0.0), 8.125)
    radius, state = between(*way[:2], at, share)
    assert radius == pytest.approx(2.5, abs=1e-12)
    assert state[0] == pytest.approx(8.125, abs=1e-12)
    assert met(*way, (1.0, 0.0), -2.0) == (0, 1.0)
    assert met(*way, (1.0, 0.0), 18.1)[0] == way[0].size
    landing = int(np.flatnonzero(way[2])[1])
    assert met(*way, (0.0, 1.0), 0.5) == (landing, 1.0), "a jump passes over another coordinate"


def test_a_level_that_starts_high_lands_on_the_first_that_is_higher() -> None:
    a = np.linspace(0.0, 4.0, 41)
    rows = states(a**2, 2.0 * a, a)
    radii, _, jump = climb(a, rows, 0, 1.0, 4.0)
    assert jump[0]
    assert radii[0] == pytest.approx(2.0, abs=1e-9)
    assert climb(a, rows, 0, 1.0, 100.0)[0].size == 0
