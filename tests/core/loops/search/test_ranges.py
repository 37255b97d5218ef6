"""Zeros are searched where the data may have them, and values at an end of their range are found out."""

import math

import numpy as np
import pytest

from gradhesion.core.loops.measured.features import BaseLine
from gradhesion.core.loops.paths.offsets import Offsets
from gradhesion.core.loops.search.ranges import is_on_bound, searched, zeros_of

POINTS = np.array([[-4.0, 2.0], [-2.0, 2.1], [0.0, 6.0], [1.0, 12.0], [-1.0, -3.0], [-4.0, 2.0]])
BACK = np.array([False, False, False, False, True, True])
LINE = BaseLine(level=2.0, spread=0.1, slope=0.0, slope_deviation=0.01, ends=(-1.5, math.nan))


def test_depths_within_the_data_and_loads_by_the_pull_off_force() -> None:
    found = searched(POINTS, {"E_star": (1.0, 9.0)}, Offsets(slope=True), LINE)
    assert list(found) == ["E_star", "indentation_offset", "load_offset", "load_slope"]
    assert found["indentation_offset"] == (-4.0, 1.0)
    assert found["load_offset"] == pytest.approx((2.0 - 5.5, 2.0 + 5.5)), "5 of pull, 5 times the spread"
    assert found["load_slope"] == (-3.0, 3.0), "as steep as the whole loop"


def test_without_a_base_line_loads_within_the_data() -> None:
    assert searched(POINTS, {}, Offsets(), None)["load_offset"] == (-3.0 - 1.5, 12.0)


def test_given_ranges_are_kept() -> None:
    own = Offsets(indentation=(-1.0, 2.0), load=(-3.0, 4.0))
    assert searched(POINTS, {}, own, LINE) == {"indentation_offset": (-1.0, 2.0), "load_offset": (-3.0, 4.0)}


def test_zeros_as_they_seem_to_be() -> None:
    assert zeros_of(POINTS, BACK, LINE, None) == (2.0, -1.5)
    assert zeros_of(POINTS, BACK, None, None) == (2.0, -4.0), "the first point"


@pytest.mark.parametrize(
    ("value", "ends", "bound"),
    [(1.009, (1.0, 2.0), True), (1.011, (1.0, 2.0), False), (1.04, (1.0, 100.0), True), (1.05, (1.0, 100.0), False),
     (96.0, (1.0, 100.0), True), (-0.99, (-1.0, 1.0), True), (0.0, (-1.0, 1.0), False)],
)  # fmt: skip
def test_a_bound_is_a_hundredth_of_the_range_wide(value: float, ends: tuple[float, float], *, bound: bool) -> None:
    """Of its logarithm, beyond a factor of 10."""
    assert is_on_bound(value, ends) == bound
