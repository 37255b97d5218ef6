"""Points without contact, in no order or with a wrong sign are told from those of a loop."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.plausible import fault_of
from gradhesion.core.loops.measured.points import has_order
from tests.core.loops.measured.test_noise import loop

SIGNS = {(1, 1): "", (1, -1): "load", (-1, 1): "depth", (-1, -1): "both"}


def told(points: int, seed: int, x: int = 1, y: int = 1, from_: float = -np.inf, to: float = np.inf) -> str:
    """What is said of a part of a noisy loop whose columns have these signs."""
    rng = np.random.default_rng(seed)
    depth, load, back, _ = loop(points)
    own = (depth > from_) & (depth < to)
    depth, load, back = depth[own], load[own], back[own]
    noisy = depth + 0.3 * rng.standard_normal(depth.size), load + 10.0 * rng.standard_normal(depth.size)
    return fault_of(x * noisy[0], y * noisy[1], np.full(depth.size, 10.0), back)


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


def test_a_base_line_alone_is_straight_tilted_or_not() -> None:
    rng = np.random.default_rng(2)
    depth = np.linspace(-1.0, 0.0, 500)
    for tilt in (0.0, 30.0):
        load = tilt * depth + rng.standard_normal(500)
        assert fault_of(depth, load, np.ones(500), depth > 2.0) == "straight"
    load[400:] -= 5.0
    assert fault_of(depth, load, np.ones(500), depth > 2.0) != "straight"


def test_few_points_and_rows_without_a_span_are_for_others_to_refuse() -> None:
    few, back = np.linspace(0.0, 1.0, 10), np.zeros(10, bool)
    assert fault_of(few, few, np.ones(10), back) == ""
    assert fault_of(np.zeros(100), np.ones(100), np.ones(100), np.zeros(100, bool)) == ""


def test_order_is_told_with_cycles_and_without() -> None:
    rng = np.random.default_rng(3)
    depth, _, _, _ = loop(400)
    noisy = depth + 20.0 * rng.standard_normal(400)
    assert has_order(noisy)
    assert has_order(np.tile(noisy, 30))
    assert has_order(np.array([0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0]))
    mixed = rng.permutation(noisy)
    assert not has_order(mixed)
    cycle = np.repeat(np.arange(2, dtype=np.int32), 200)
    assert has_order(np.concatenate([noisy[::2], noisy[::2]]), cycle)
    assert not has_order(mixed, cycle)
