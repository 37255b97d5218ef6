"""Ways of points are told from their order, whatever noise, spikes and pauses there are."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.points import ways


def triangle(cycles: int, points: int = 200) -> np.ndarray:
    up = np.linspace(-1.0, 3.0, points)
    return np.concatenate([np.concatenate([up, up[::-1]]) for _ in range(cycles)])


@pytest.mark.parametrize(("cycles", "points"), [(1, 200), (5, 200), (2, 20_000)])
def test_cycles_and_ways_are_told_from_the_order_whatever_the_noise(cycles: int, points: int) -> None:
    rng = np.random.default_rng(cycles)
    depth = triangle(cycles, points)
    unloading, number = ways(depth + 0.05 * rng.standard_normal(depth.size))
    expected = np.tile(np.repeat([False, True], points), cycles)
    assert np.count_nonzero(ways(depth)[0] != expected) <= 2 * cycles, "either of two equal points may be the turn"
    assert np.count_nonzero(unloading != expected) <= 2 * cycles * (4 + 0.06 * points), "near the turns noise decides"
    assert np.unique(number).tolist() == list(range(1, cycles + 1))
    assert abs(np.count_nonzero(number == 1) - 2 * points) <= 2 * (4 + 0.06 * points)


def test_drift_creep_and_a_pause_are_no_turns() -> None:
    up = np.linspace(-1.0, 3.0, 500)
    pause = 3.0 - 0.2 * (1.0 - np.exp(-np.linspace(0.0, 5.0, 300)))
    cycle = np.concatenate([up, pause, pause[-1] - (up - up[0])])
    depth = np.concatenate([cycle, cycle + 0.3, cycle + 0.6])
    unloading, number = ways(depth + 0.01 * np.random.default_rng(2).standard_normal(depth.size))
    assert number.max() == 3
    for i in range(3):
        own = unloading[i * 1300 : (i + 1) * 1300]
        assert not own[10:480].any()
        assert own[820:1290].all()


def test_a_jump_at_the_end_of_a_cycle_belongs_to_its_unloading() -> None:
    """The depth stays while the load jumps to zero; the next cycle begins elsewhere."""
    cycle = np.concatenate([np.linspace(2.0, 250.0, 270), np.linspace(249.0, -63.0, 290), np.full(40, -63.0)])
    depth = np.tile(cycle, 3) + 0.25 * np.random.default_rng(4).standard_normal(1800)
    unloading, number = ways(depth)
    np.testing.assert_array_equal(number, np.repeat([1, 2, 3], 600))
    assert np.count_nonzero(unloading != np.tile(np.arange(600) >= 270, 3)) <= 6


def test_one_spike_is_no_turn_and_one_way_alone_has_none() -> None:
    depth = triangle(1)
    depth[[50, 320]] = 2.5, -0.9
    unloading, number = ways(depth)
    assert number.max() == 1
    assert not unloading[:199].any()
    assert unloading[201:].all()
    unloading, number = ways(np.linspace(0.0, 1.0, 50))
    assert not unloading.any()
    assert (number == 1).all()
    assert not ways(np.zeros(5))[0].any()
    assert ways(np.linspace(1.0, 0.0, 50))[0].tolist() == [False] + 49 * [True]


def test_each_given_cycle_loads_up_to_its_deepest_point() -> None:
    unloading, number = ways(np.array([0.0, 2.0, 1.0, 0.0, 1.0, 0.5]), np.array([4, 4, 4, 7, 7, 7], np.int32))
    assert unloading.tolist() == [False, False, True, False, False, True]
    assert number.tolist() == [4, 4, 4, 7, 7, 7]
    mixed = ways(np.array([0.0, 0.0, 2.0, 1.0, 1.0, 0.5]), np.array([7, 4, 4, 7, 4, 7], np.int32))[0]
    assert mixed.tolist() == [False, False, False, False, True, True], "cycles may be mixed in a file"
