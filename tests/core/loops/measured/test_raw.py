"""Raw points: their noise to its own error, their means, and what is told from a loop: no contact, no order, wrong signs."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.features import fault_of
from gradhesion.core.loops.measured.points import FLOOR, MOST, Averaged, averaged, has_order, noise_of

Array = np.ndarray
Rows = tuple[Array, Array, Array, Array]
"""Depth, load, way and cycle."""
NOISE = (0.3, 2.0)
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
    rows, mix = loop(points, noise=NOISE, seed=5), np.random.default_rng(5).permutation(points)
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
    rows = loop(points, waves, NOISE)
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
    depth, load, back, _ = loop(10_000, noise=NOISE)
    cycle = np.repeat(np.arange(1, 11, dtype=np.int32), 1000)
    found = averaged(depth, load, back, cycle, noise_of(depth, load, back, cycle))
    for number in range(1, 11):
        own, raw = found.cycle == number, cycle == number
        assert found.counts[own].sum() == 1000
        assert (found.load[own] @ found.counts[own]) == pytest.approx(load[raw].sum(), rel=1e-9, abs=1e-6)
        assert set(found.unloading[own]) == set(back[raw])


def test_few_points_stay_as_they_are_and_others_are_averaged_whatever_their_noise_and_order() -> None:
    rows = loop(MOST, noise=NOISE)
    found = averaged(*rows, NOISE)
    for same, row in zip((found.depth, found.load, found.counts), (*rows[:2], np.ones(MOST)), strict=True):
        np.testing.assert_array_equal(same, row)
    rows = loop(100_000, noise=(0.0, 2.0))
    assert averaged(*rows, noise_of(*rows)).depth.size < 1.1 * MOST, "also a displacement without noise"
    rows, mix = loop(10_000, noise=NOISE), np.random.default_rng(1).permutation(10_000)
    found = averaged(*(row[mix] for row in rows), noise=NOISE)
    assert found.depth.size < 1.2 * MOST
    assert np.median(np.abs(far(found, 0, NOISE))) < 1.0


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
