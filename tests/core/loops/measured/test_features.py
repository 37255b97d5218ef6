"""Base lines with drift, tilt and noise, none, and the point where loading leaves them."""

import numpy as np
import pytest

from gradhesion.core.loops.measured.features import BaseLine, ContactPoint, base_line, contact_point
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
