"""Means of raw points lie on the curve to within their noise, never across a jump."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.averaging import MOST, Averaged, averaged
from gradhesion.core.loops.measured.noise import noise_of

Array = np.ndarray


def curve(depth: Array, waves: int) -> Array:
    """A load on approach with one jump at depth 0, and waves behind it."""
    load = np.where(depth > 0.0, 1000.0 * np.abs(depth / 300.0) ** 1.5 - 200.0, 0.0)
    return load + np.where(depth > 0.0, 50.0 * np.sin(2.0 * np.pi * depth / 300.0 * waves), 0.0)


def drawn(points: int, waves: int = 0, seed: int = 0, size: float = 1.0) -> tuple[Array, Array, Array, Array]:
    """Raw points of two branches with noise of 0.3 and 2.0."""
    rng = np.random.default_rng(seed)
    half = points // 2
    true = np.concatenate([np.linspace(-503.0, 300.0, half), np.linspace(300.0, -503.0, points - half)])
    depth = true + 0.3 * size * rng.standard_normal(points)
    load = curve(true, waves) + 2.0 * size * rng.standard_normal(points)
    return depth, load, np.arange(points) >= half, np.ones(points, np.int32)


def far(found: Averaged, waves: int, noise: tuple[float, float]) -> Array:
    """How far means are from the curve, in their own standard deviations; those beside the jump are at no depth."""
    slope = (curve(found.depth + 0.01, waves) - curve(found.depth - 0.01, waves)) / 0.02
    apart = (found.load - curve(found.depth, waves)) * np.sqrt(found.counts) / np.hypot(noise[1], noise[0] * slope)
    return apart * (np.abs(found.depth) > 1.0)


@pytest.mark.parametrize("points", [10_000, 300_000])
@pytest.mark.parametrize("waves", [0, 20])
def test_means_are_on_the_curve_to_within_their_noise(points: int, waves: int) -> None:
    raw = drawn(points, waves)
    noise = noise_of(*raw)
    found = averaged(*raw, noise)
    assert 0.9 * MOST < found.depth.size < 1.6 * MOST
    assert found.counts.sum() == points
    apart = far(found, waves, noise)
    assert np.sqrt(np.mean(apart**2)) == pytest.approx(1.0, abs=0.1), "chi square stays what it is"
    assert np.count_nonzero(np.abs(apart) > 5.0) == 0
    assert found.noise == noise


def test_no_mean_is_across_a_jump() -> None:
    raw = drawn(100_000, size=0.01)
    found = averaged(*raw, noise_of(*raw))
    between = (found.load > -190.0) & (found.load < -10.0) & (np.abs(found.depth) < 5.0)
    assert not between.any()
    assert found.counts[np.abs(found.depth) < 1.0].min() < 5.0
    assert found.counts.max() == 50.0


def test_branches_and_cycles_stay_apart() -> None:
    depth, load, back, _ = drawn(10_000)
    cycle = np.repeat(np.arange(1, 11, dtype=np.int32), 1000)
    found = averaged(depth, load, back, cycle, noise_of(depth, load, back, cycle))
    for number in range(1, 11):
        own, raw = found.cycle == number, cycle == number
        assert found.counts[own].sum() == 1000
        assert (found.load[own] @ found.counts[own]) == pytest.approx(load[raw].sum(), rel=1e-9, abs=1e-6)
        assert set(found.unloading[own]) == set(back[raw])


def test_few_points_stay_as_they_are_and_others_are_averaged_whatever_their_noise_and_order() -> None:
    raw = drawn(MOST)
    found = averaged(*raw, (0.3, 2.0))
    np.testing.assert_array_equal(found.depth, raw[0])
    np.testing.assert_array_equal(found.load, raw[1])
    assert (found.counts == 1.0).all()
    _, load, back, cycle = drawn(100_000)
    depth = np.concatenate([np.linspace(-500.0, 300.0, 50_000), np.linspace(300.0, -500.0, 50_000)])
    found = averaged(depth, load, back, cycle, noise_of(depth, load, back, cycle))
    assert found.depth.size < 1.1 * MOST, "also a displacement without noise"
    raw = drawn(10_000)
    mix = np.random.default_rng(1).permutation(10_000)
    found = averaged(*(row[mix] for row in raw), noise=(0.3, 2.0))
    assert found.depth.size < 1.2 * MOST
    assert np.median(np.abs(far(found, 0, (0.3, 2.0)))) < 1.0


def test_noise_that_is_not_white_is_more_than_that_of_neighbours() -> None:
    """Of an autoregressive noise the mean of m has 1 + 2 sum (1 - i/m) r^i times the variance of white noise."""
    rng = np.random.default_rng(2)
    depth, load, back, cycle = drawn(100_000, size=0.0)
    r, slow = 0.5, rng.standard_normal(100_000)
    for i in range(1, slow.size):
        slow[i] = r * slow[i - 1] + np.sqrt(1.0 - r * r) * slow[i]
    noisy = load + 2.0 * slow, depth + 0.3 * rng.standard_normal(depth.size)
    noise = noise_of(noisy[1], noisy[0], back, cycle)
    assert noise[1] < 1.6, "neighbours are alike"
    found = averaged(noisy[1], noisy[0], back, cycle, noise)
    lags = np.arange(1, 50)
    factor = np.sqrt(1.0 + 2.0 * np.sum((1.0 - lags / 50.0) * r**lags))
    assert found.noise[1] == pytest.approx(2.0 * factor, rel=0.1)
    assert found.noise[0] == noise[0]
    assert found.depth.size < 1.1 * MOST
