"""Base lines and the points where loading leaves them; and the ways of points, told from their order, whatever noise there is."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.features import BaseLine, ContactPoint, base_line, contact_point
from gradhesion.core.loops.measured.points import ways
from tests.core.loops.models import Array

NOISE = 1e-2


def points(seed: int, *, first: float = -1.0, tilt: float = 0.0, drift: float = 0.0) -> tuple[Array, Array]:
    """A branch of loading and one of unloading that sticks down to -0.2; its zero of load is 0.3."""
    rng = np.random.default_rng(seed)
    depth = np.concatenate([np.linspace(first, 1.0, 400), np.linspace(1.0, first, 400)])
    back = np.arange(800) >= 400
    contact = depth > np.where(back, -0.2, 0.0)
    load = np.where(contact, np.maximum(depth + 0.2, 0.0) ** 1.5 - 0.5, 0.0)  # it jumps into contact, and out of it
    load += 0.3 + tilt * depth + drift * np.arange(800) / 800 + NOISE * rng.standard_normal(800)
    return np.column_stack([depth, load]), back


def contact_of(rows: Array, back: Array) -> ContactPoint | None:
    return contact_point(rows, back, base_line(rows, back, NOISE), (1e-3, NOISE))


def line_of(rows: Array, back: Array, noise: float = NOISE) -> BaseLine:
    line = base_line(rows, back, noise)
    assert line is not None
    return line


@pytest.mark.parametrize("seed", range(3))
def test_the_zero_and_the_tilt_are_those_of_the_line(seed: int) -> None:
    line, tilted, drifting = (line_of(*points(seed, **more)) for more in ({}, {"tilt": 0.03}, {"drift": 0.04}))
    assert line.level == pytest.approx(0.3, abs=5.0 * NOISE / np.sqrt(300))
    assert abs(line.slope) < min(0.02, 4.5 * line.slope_deviation)
    assert line.ends == pytest.approx((0.0, -0.2), abs=0.12)
    assert abs(tilted.slope - 0.03) < min(0.01, 4.5 * tilted.slope_deviation)
    assert tilted.slope_deviation == pytest.approx(line.slope_deviation, rel=0.2), "what is left is the noise"
    assert drifting.level == pytest.approx(0.32, abs=0.015)
    assert NOISE < drifting.spread < 0.04, "drift of the zero is a spread"


def test_contact_is_where_loading_leaves_the_line() -> None:
    """To a step of the points, where it jumps into contact."""
    rows, back = points(2)
    found = contact_of(rows, back)
    assert found is not None
    assert found.depth == pytest.approx(0.0, abs=0.006)
    assert found.deviation > 0.0
    moved = contact_of(rows + np.array([7.0, -3.0]), back)
    assert moved is not None
    assert moved.depth == pytest.approx(found.depth + 7.0, abs=1e-9)
    assert contact_of(rows[back], back[back]) is None, "loading has none"


def test_what_is_flat_at_the_lowest_load_of_unloading_is_no_base_line() -> None:
    depth = np.linspace(0.0, 1.0, 400)
    rows = np.column_stack([depth, np.maximum(depth - 0.3, 0.0) ** 2])
    assert base_line(rows, np.ones(400, bool), NOISE) is None
    assert base_line(rows, np.zeros(400, bool), NOISE) is not None, "loading begins without contact"


def test_without_a_base_line_or_with_nothing_else_there_is_no_contact_point() -> None:
    """Six points are the least that a line is found from."""
    rows, back = points(1, first=0.2)
    rows[:, 1] = np.abs(rows[:, 0]) ** 1.5
    assert base_line(rows, back, 1e-5) is None
    assert contact_point(rows, back, None, (1e-3, 1e-5)) is None
    assert base_line(rows[:3], back[:3], NOISE) is None
    depth, back = np.concatenate([np.linspace(-1.0, -0.5, 6), np.linspace(1.0, -1.0, 200)]), np.arange(206) >= 6
    load = np.where(back, np.maximum(depth + 0.2, 0.0) ** 1.5, 0.0)
    rows = np.column_stack([depth, load + 1e-3 * np.random.default_rng(0).standard_normal(206)])
    line = line_of(rows, back, 1e-3)
    assert line.ends[0] == -0.5
    assert contact_point(rows, back, line, (1e-3, 1e-3)) is None


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
