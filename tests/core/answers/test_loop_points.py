"""Ways of points are told from their order; noise is estimated to its own error."""

import numpy as np
import pytest

from gradhesion.core.answers.loop_points import FLOOR, noise, ways


def triangle(cycles: int, points: int = 200) -> np.ndarray:
    up = np.linspace(-1.0, 3.0, points)
    return np.concatenate([np.concatenate([up, up[::-1]]) for _ in range(cycles)])


@pytest.mark.parametrize("cycles", [1, 2, 5])
def test_cycles_and_ways_are_told_from_the_order_whatever_the_noise(cycles: int) -> None:
    rng = np.random.default_rng(cycles)
    depth = triangle(cycles)
    unloading, number = ways(depth + 0.05 * rng.standard_normal(depth.size))
    expected = np.tile(np.repeat([False, True], 200), cycles)
    assert np.count_nonzero(unloading != expected) <= 8 * 2 * cycles, "near the turns noise decides"
    assert np.unique(number).tolist() == list(range(1, cycles + 1))
    assert abs(np.count_nonzero(number == 1) - 400) <= 8 * 2


def test_a_loop_that_only_loads_has_no_unloading() -> None:
    unloading, number = ways(np.linspace(0.0, 1.0, 50))
    assert not unloading.any()
    assert (number == 1).all()
    assert not ways(np.zeros(5))[0].any()


def test_each_given_cycle_loads_up_to_its_deepest_point() -> None:
    unloading, number = ways(np.array([0.0, 2.0, 1.0, 0.0, 1.0, 0.5]), np.array([4, 4, 4, 7, 7, 7], np.int32))
    assert unloading.tolist() == [False, False, True, False, False, True]
    assert number.tolist() == [4, 4, 4, 7, 7, 7]


def test_retract_only_is_told_by_its_first_point() -> None:
    assert ways(np.linspace(1.0, 0.0, 50))[0].tolist() == [False] + 49 * [True]


def test_noise_is_that_of_the_points_with_jumps_and_slopes() -> None:
    rng = np.random.default_rng(1)
    depth = triangle(3, 1000)
    load = np.where(depth > 0.0, np.abs(depth) ** 1.5, 0.0) - 2.0 * (depth > 1.0)
    unloading, number = np.tile(np.repeat([False, True], 1000), 3), np.repeat(np.arange(1, 4, dtype=np.int32), 2000)
    found = noise(depth + 0.01 * rng.standard_normal(6000), load + 0.03 * rng.standard_normal(6000), unloading, number)
    np.testing.assert_allclose(found, (0.01, 0.03), rtol=0.05)


def test_noise_has_a_floor() -> None:
    depth = triangle(1)
    found = noise(depth, depth, np.repeat([False, True], 200), np.ones(400, np.int32))
    np.testing.assert_allclose(found, FLOOR * 4.0, rtol=1e-12)
