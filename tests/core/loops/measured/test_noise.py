"""Noise is estimated to its own error: of many points, of coarse digits, of points in no order, and of nothing else."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.noise import FLOOR, noise_of

Array = np.ndarray


def loop(points: int, waves: int = 0) -> tuple[Array, Array, Array, Array]:
    """A loop without noise: depth, load, way and cycle, with two jumps and perhaps with waves."""
    half = points // 2
    depth = np.concatenate([np.linspace(-500.0, 300.0, half), np.linspace(300.0, -500.0, points - half)])
    back = np.arange(points) >= half
    inside = (depth > 0.0) | (back & (depth > -40.0))
    load = 1000.0 * np.maximum(depth / 300.0, 0.0) ** 1.5 + np.where(inside, 0.5 * depth - 200.0, 0.0)
    load += np.where(depth > 0.0, 50.0 * np.sin(2.0 * np.pi * depth / 300.0 * waves), 0.0)
    return depth, load, back, np.ones(points, np.int32)


@pytest.mark.parametrize("points", [600, 10_000, 200_000])
@pytest.mark.parametrize("size", [1.0, 1e-4])
def test_noise_is_that_of_the_points_with_jumps_and_slopes(points: int, size: float) -> None:
    rng = np.random.default_rng(points)
    depth, load, back, cycle = loop(points)
    errors = rng.standard_normal((2, points))
    found = noise_of(depth + 0.3 * errors[0], load + 2.0 * size * errors[1], back, cycle)
    bend = 750.0 / 300.0**1.5 / 50.0**0.5 * (1600.0 / points) ** 2 / 6.0**0.5  # second difference at a depth of 50
    assert found[0] == pytest.approx(0.3, rel=0.1 if points < 10_000 else 0.04)
    bend = max(bend, FLOOR * np.ptp(load))
    assert found[1] == pytest.approx(2.0 * size, rel=0.1 if points < 10_000 else 0.04, abs=bend)


def test_drift_leaves_the_noise_of_neighbours() -> None:
    rng = np.random.default_rng(3)
    depth, load, back, cycle = loop(10_000)
    slow = np.cumsum(0.02 * rng.standard_normal(10_000)) + 50.0 * np.sin(np.arange(10_000) / 1000.0)
    found = noise_of(depth, load + slow + 2.0 * rng.standard_normal(10_000), back, cycle)
    assert found[1] == pytest.approx(2.0, rel=0.04)


@pytest.mark.parametrize(("step", "size"), [(10.0, 2.0), (10.0, 0.0), (1.0, 2.0)])
def test_a_coarse_digit_is_noise(step: float, size: float) -> None:
    """Rounding adds step^2/12 to the variance, and is all there is where the step is far above the noise."""
    rng = np.random.default_rng(4)
    depth, load, back, cycle = loop(10_000)
    found = noise_of(depth, step * np.rint((load + size * rng.standard_normal(10_000)) / step), back, cycle)
    assert found[1] >= step / np.sqrt(12.0) * (1.0 - 1e-9)
    assert found[1] == pytest.approx(np.hypot(size, step / np.sqrt(12.0)), rel=0.25)


@pytest.mark.parametrize("points", [600, 10_000])
def test_points_in_no_order_have_the_same_noise_of_load(points: int) -> None:
    rng = np.random.default_rng(5)
    depth, load, back, cycle = loop(points)
    depth, load = depth + 0.3 * rng.standard_normal(points), load + 2.0 * rng.standard_normal(points)
    mix = rng.permutation(points)
    found = noise_of(depth[mix], load[mix], back[mix], cycle)
    assert found[1] == pytest.approx(2.0, rel=0.25)
    assert found[0] < 0.3, "that of the depth cannot be seen"


def test_noise_has_a_floor_far_below_instruments() -> None:
    depth, load, back, cycle = loop(10_000)
    found = noise_of(depth, load, back, cycle)
    assert found[0] == FLOOR * 800.0
    assert 0.0 < found[1] < 1.1 * FLOOR * np.ptp(load), "what the curve bends between points"
    assert all(size > 0.0 for size in noise_of(np.zeros(4), np.zeros(4), np.zeros(4, bool), np.ones(4, np.int32)))
