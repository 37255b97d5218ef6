"""Raw points, their noise, means and ways; base lines, the points where loading leaves them, and faults that are told from a loop."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.features import BaseLine, ContactPoint, base_line, contact_point, fault_of
from gradhesion.core.loops.measured.points import FLOOR, MOST, Averaged, averaged, has_order, noise_of, ways
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
    for seed in range(3):
        noise = NOISE * np.random.default_rng(seed).standard_normal(400)
        rows = np.column_stack([depth, np.maximum(depth - 0.3, 0.0) ** 2 + noise])
        assert base_line(rows, np.ones(400, bool), NOISE) is None
        assert base_line(rows, np.zeros(400, bool), NOISE) is not None, "loading begins without contact"
        rows, back = points(seed)
        before = ~back | (rows[:, 0] > -0.2)  # the retraction ends at the pull-off, half a unit below, where it is flat
        flat = back & (rows[:, 0] < 0.0)
        rows[flat, 1] = noise[: flat.sum()] - 0.2
        line = line_of(rows[before], back[before])
        assert line.level == pytest.approx(0.3, abs=5.0 * NOISE / np.sqrt(200))
        assert np.isnan(line.ends[1])


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


Rows = tuple[Array, Array, Array, Array]
"""Depth, load, way and cycle."""
ERRORS = (0.3, 2.0)
SIGNS = {(1, 1): "", (1, -1): "load", (-1, 1): "depth", (-1, -1): "both"}


def curve(depth: Array, back: Array, waves: int = 0) -> Array:
    """A load with jumps at depth 0 of approach and at -40 of retraction, and waves between."""
    inside = (depth > 0.0) | (back & (depth > -40.0))
    load = 1000.0 * np.maximum(depth / 300.0, 0.0) ** 1.5 + np.where(inside, 0.5 * depth - 200.0, 0.0)
    return load + np.where(depth > 0.0, 50.0 * np.sin(2.0 * np.pi * depth / 300.0 * waves), 0.0)


def loop(points: int, waves: int = 0, noise: tuple[float, float] = (0.0, 0.0), seed: int = 0) -> Rows:
    """A loop between the depths -503 and 300."""
    half, rng = points // 2, np.random.default_rng(seed)
    depth = np.concatenate([np.linspace(-503.0, 300.0, half), np.linspace(300.0, -503.0, points - half)])
    back = np.arange(points) >= half
    load = curve(depth, back, waves)
    errors = rng.standard_normal((2, points))
    return depth + noise[0] * errors[0], load + noise[1] * errors[1], back, np.ones(points, np.int32)


@pytest.mark.parametrize("points", [600, 10_000, 200_000])
@pytest.mark.parametrize("size", [1.0, 1e-4])
def test_noise_is_that_of_the_points_with_jumps_and_slopes(points: int, size: float) -> None:
    depth, load, *ways = loop(points, noise=(0.3, 2.0 * size), seed=points)
    found = noise_of(depth, load, *ways)
    bend = 750.0 / 300.0**1.5 / 50.0**0.5 * (1606.0 / points) ** 2 / 6.0**0.5  # second difference at a depth of 50
    rel = 0.1 if points < 10_000 else 0.04
    assert found[0] == pytest.approx(0.3, rel=rel)
    assert found[1] == pytest.approx(2.0 * size, rel=rel, abs=max(bend, FLOOR * np.ptp(load)))


def test_drift_leaves_the_noise_of_neighbours() -> None:
    depth, load, *ways = loop(10_000, noise=(0.0, 2.0), seed=3)
    rng = np.random.default_rng(4)
    slow = np.cumsum(0.02 * rng.standard_normal(10_000)) + 50.0 * np.sin(np.arange(10_000) / 1000.0)
    assert noise_of(depth, load + slow, *ways)[1] == pytest.approx(2.0, rel=0.04)


@pytest.mark.parametrize(("step", "size"), [(10.0, 2.0), (10.0, 0.0), (1.0, 2.0)])
def test_a_coarse_digit_is_noise(step: float, size: float) -> None:
    """Rounding adds step^2/12 to the variance, and is all there is where the step is far above the noise."""
    depth, load, *ways = loop(10_000, noise=(0.0, size), seed=4)
    found = noise_of(depth, step * np.rint(load / step), *ways)
    assert found[1] >= step / np.sqrt(12.0) * (1.0 - 1e-9)
    assert found[1] == pytest.approx(np.hypot(size, step / np.sqrt(12.0)), rel=0.25)


@pytest.mark.parametrize("points", [600, 10_000])
def test_points_in_no_order_have_the_same_noise_of_load(points: int) -> None:
    rows, mix = loop(points, noise=ERRORS, seed=5), np.random.default_rng(5).permutation(points)
    found = noise_of(*(row[mix] for row in rows))
    assert found[1] == pytest.approx(2.0, rel=0.25)
    assert found[0] < 0.3, "that of the depth cannot be seen"


def test_noise_has_a_floor_far_below_instruments() -> None:
    rows = loop(10_000)
    found = noise_of(*rows)
    assert found[0] == FLOOR * 803.0
    assert 0.0 < found[1] < 1.1 * FLOOR * np.ptp(rows[1]), "what the curve bends between points"
    assert all(size > 0.0 for size in noise_of(np.zeros(4), np.zeros(4), np.zeros(4, bool), np.ones(4, np.int32)))


def far(found: Averaged, waves: int, noise: tuple[float, float]) -> Array:
    """How far means are from the curve, in their own standard deviations; those beside a jump are at no depth."""
    level, above, below = (curve(found.depth + off, found.unloading, waves) for off in (0.0, 0.01, -0.01))
    slope = (above - below) / 0.02
    apart = (found.load - level) * np.sqrt(found.counts) / np.hypot(noise[1], noise[0] * slope)
    return apart * (np.abs(found.depth) > 1.0) * (np.abs(found.depth + 40.0) > 1.0)


@pytest.mark.parametrize("points", [10_000, 300_000])
@pytest.mark.parametrize("waves", [0, 20])
def test_means_are_on_the_curve_to_within_their_noise(points: int, waves: int) -> None:
    rows = loop(points, waves, ERRORS)
    noise = noise_of(*rows)
    found = averaged(*rows, noise)
    assert 0.9 * MOST < found.depth.size < 1.6 * MOST
    assert found.counts.sum() == points
    apart = far(found, waves, noise)
    assert np.sqrt(np.mean(apart**2)) == pytest.approx(1.0, abs=0.1), "chi square stays what it is"
    assert np.count_nonzero(np.abs(apart) > 5.0) == 0
    assert found.noise == noise


def test_no_mean_is_across_a_jump_a_branch_or_a_cycle() -> None:
    rows = loop(100_000, noise=(0.003, 0.02))
    found = averaged(*rows, noise_of(*rows))
    at_jump = ~found.unloading & (np.abs(found.depth) < 5.0)
    assert not (at_jump & (found.load > -190.0) & (found.load < -10.0)).any()
    assert found.counts[np.abs(found.depth) < 1.0].min() < 5.0
    assert found.counts.max() == 50.0
    depth, load, back, _ = loop(10_000, noise=ERRORS)
    cycle = np.repeat(np.arange(1, 11, dtype=np.int32), 1000)
    found = averaged(depth, load, back, cycle, noise_of(depth, load, back, cycle))
    for number in range(1, 11):
        own, raw = found.cycle == number, cycle == number
        assert found.counts[own].sum() == 1000
        assert (found.load[own] @ found.counts[own]) == pytest.approx(load[raw].sum(), rel=1e-9, abs=1e-6)
        assert set(found.unloading[own]) == set(back[raw])


def test_few_points_stay_as_they_are_and_others_are_averaged_whatever_their_noise_and_order() -> None:
    rows = loop(MOST, noise=ERRORS)
    found = averaged(*rows, ERRORS)
    for same, row in zip((found.depth, found.load, found.counts), (*rows[:2], np.ones(MOST)), strict=True):
        np.testing.assert_array_equal(same, row)
    rows = loop(100_000, noise=(0.0, 2.0))
    assert averaged(*rows, noise_of(*rows)).depth.size < 1.1 * MOST, "also a displacement without noise"
    rows, mix = loop(10_000, noise=ERRORS), np.random.default_rng(1).permutation(10_000)
    found = averaged(*(row[mix] for row in rows), noise=ERRORS)
    assert found.depth.size < 1.2 * MOST
    assert np.median(np.abs(far(found, 0, ERRORS))) < 1.0


def test_noise_that_is_not_white_is_more_than_that_of_neighbours() -> None:
    """Of an autoregressive noise the mean of m has 1 + 2 sum (1 - i/m) r^i times the variance of white noise."""
    depth, load, *ways = loop(100_000, noise=(0.3, 0.0))
    r, slow = 0.5, np.random.default_rng(2).standard_normal(100_000)
    for i in range(1, slow.size):
        slow[i] = r * slow[i - 1] + np.sqrt(1.0 - r * r) * slow[i]
    load = load + 2.0 * slow
    noise = noise_of(depth, load, *ways)
    assert noise[1] < 1.6, "neighbours are alike"
    found = averaged(depth, load, *ways, noise)
    lags = np.arange(1, 50)
    factor = np.sqrt(1.0 + 2.0 * np.sum((1.0 - lags / 50.0) * r**lags))
    assert found.noise[1] == pytest.approx(2.0 * factor, rel=0.1)
    assert found.noise[0] == noise[0]
    assert found.depth.size < 1.1 * MOST


def told(points: int, seed: int, x: int = 1, y: int = 1, from_: float = -np.inf, to: float = np.inf) -> str:
    """What is said of a part of a noisy loop whose columns have these signs."""
    depth, load, back, _ = loop(points, noise=(0.3, 10.0), seed=seed)
    own = (depth > from_) & (depth < to)
    return fault_of(x * depth[own], y * load[own], np.full(np.count_nonzero(own), 10.0), back[own])


@pytest.mark.parametrize("signs", SIGNS)
@pytest.mark.parametrize("from_", [-500.0, -100.0, -45.0])
@pytest.mark.parametrize("points", [600, 2000])
def test_wrong_signs_are_told_with_a_base_line_long_or_short(signs: tuple[int, int], from_: float, points: int) -> None:
    assert told(points, 1, *signs, from_=from_) == SIGNS[signs]


@pytest.mark.parametrize("to", [5.0, 60.0, 150.0])
@pytest.mark.parametrize("from_", [-500.0, -45.0, 1.0])
def test_loops_that_hardly_press_or_have_no_base_line_are_right(from_: float, to: float) -> None:
    for seed in range(5):
        found = told(2000, seed, from_=from_, to=to)
        assert found == "" or (found == "straight" and from_ == 1.0 and to < 100.0), "bent by no more than the noise"


def test_a_base_line_alone_is_straight_and_rows_without_a_span_are_for_others_to_refuse() -> None:
    rng, depth = np.random.default_rng(2), np.linspace(-1.0, 0.0, 500)
    for tilt in (0.0, 30.0):
        load = tilt * depth + rng.standard_normal(500)
        assert fault_of(depth, load, np.ones(500), depth > 2.0) == "straight"
    load[400:] -= 5.0
    assert fault_of(depth, load, np.ones(500), depth > 2.0) != "straight"
    for row in (np.linspace(0.0, 1.0, 10), np.ones(100)):
        assert fault_of(row, row, np.ones(row.size), np.zeros(row.size, bool)) == ""


def test_order_is_told_with_cycles_and_without() -> None:
    noisy = loop(400, noise=(20.0, 0.0), seed=3)[0]
    mixed = np.random.default_rng(3).permutation(noisy)
    cycle = np.repeat(np.arange(2, dtype=np.int32), 200)
    for row in (noisy, np.tile(noisy, 30), np.array([0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0])):
        assert has_order(row)
    assert has_order(np.concatenate([noisy[::2], noisy[::2]]), cycle)
    assert not has_order(mixed)
    assert not has_order(mixed, cycle)
