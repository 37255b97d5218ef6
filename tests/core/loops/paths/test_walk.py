"""The radii that a level passes as it grows, of functions whose extrema and landings are known."""

import numpy as np
import pytest

from gradhesion.core.loops.paths.walk import climb


@pytest.mark.parametrize("count", [51, 200, 1001])
def test_of_a_cubic_the_fold_and_the_landing_are_found(count: int) -> None:
    """a^3 - 3a has its maximum 2 at -1 and is 2 again at 2."""
    a = np.linspace(-2.0, 3.0, count)
    radii, jump, level = climb(a, a**3 - 3.0 * a, -10.0)
    at = int(np.flatnonzero(jump)[1])
    near = (5.0 / count) ** 2
    assert radii[at - 1] == pytest.approx(-1.0, abs=near)
    assert level[at - 1] == pytest.approx(2.0, abs=near**2 + 2.0 * near * 5.0 / count)
    assert radii[at] == pytest.approx(2.0, abs=near)
    assert (np.diff(radii) >= 0.0).all()
    assert (np.diff(level) >= 0.0).all()


def test_downwards_it_is_the_same_in_a_mirror() -> None:
    a = np.linspace(-2.0, 3.0, 80)
    up, down = climb(a, a**3 - 3.0 * a, -10.0), climb(-a, a**3 - 3.0 * a, -10.0)
    np.testing.assert_allclose(up[0], -down[0], atol=1e-14)
    np.testing.assert_array_equal(up[1], down[1])


def test_what_is_below_all_before_is_passed_over() -> None:
    """Of waves that grow only the first and the highest are reached."""
    a = np.linspace(0.0, 10.0, 2001)
    radii, jump, level = climb(a, a + 3.0 * np.sin(2.0 * a), 0.0)
    assert np.count_nonzero(jump[1:]) == 3
    for at in np.flatnonzero(jump)[1:]:
        fold = radii[at - 1]
        assert 1.0 + 6.0 * np.cos(2.0 * fold) == pytest.approx(0.0, abs=1e-3), "a maximum"
        assert radii[at] + 3.0 * np.sin(2.0 * radii[at]) == pytest.approx(level[at - 1], abs=1e-6), "at its level"


def test_a_level_that_starts_high_lands_on_the_first_that_is_higher() -> None:
    a = np.linspace(0.0, 4.0, 41)
    radii, jump, _ = climb(a, a**2, 4.0)
    assert jump[0]
    assert radii[0] == pytest.approx(2.0, abs=1e-9)
    assert climb(a, a**2, 100.0)[0].size == 0
