"""Optima of merits whose peaks are known: smooth, kinks, at ends, at edges of what is feasible, hidden; and fronts."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.answers.optimum import Optima, axis_of, front, optima_of, sweep

Array = NDArray[np.float64]
PEAKS = np.array([0.0, 0.137, 0.5, 0.73141592, 1.0])
"""One a cell."""


@dataclass
class Known:
    """A merit by formula; called, it finds the optimum of each cell from a sweep at a resolution."""

    height: Callable[..., Any]
    slope: Callable[..., Any] | None = None

    def values(self, places: Array, cells: NDArray[np.int64]) -> Array:
        return np.asarray(self.height(*places, cells)) + 0.0 * places[0] + 0.0 * cells

    def slopes(self, places: Array, cells: NDArray[np.int64]) -> Array | None:
        return None if self.slope is None else np.array(np.broadcast_arrays(*self.slope(*places, cells)))

    def __call__(self, inputs: int, cells: int, resolution: int) -> Optima:
        return optima_of(self, sweep(self.values, inputs, cells, resolution))


def _ripple(x: Array, cells: NDArray[np.int64]) -> Array:
    return np.cos(x - PEAKS[cells]) + 0.02 * np.cos(40.0 * np.pi * (x - PEAKS[cells]))


def _slope_of_ripple(x: Array, cells: NDArray[np.int64]) -> tuple[Array]:
    return (-np.sin(x - PEAKS[cells]) - 0.8 * np.pi * np.sin(40.0 * np.pi * (x - PEAKS[cells])),)


def test_a_smooth_peak_among_others() -> None:
    """Values alone give the place to the root of rounding, slopes to rounding; at an end of the range it is exact."""
    for slope, error in ((None, 3e-9), (_slope_of_ripple, 1e-15)):
        found = Known(_ripple, slope)(1, PEAKS.size, 100)
        np.testing.assert_allclose(found.places[0], PEAKS, rtol=0.0, atol=error)
        assert found.places[0, [0, -1]].tolist() == [0.0, 1.0]
        np.testing.assert_allclose(found.merits, 1.02, rtol=4e-16)
        assert not found.too_coarse.any()


def test_a_peak_much_closer_to_an_end_than_points_of_the_sweep() -> None:
    """The end itself is higher than any point of the sweep, and than those that are tried first."""
    beside = np.array([0.003, 0.997])
    found = Known(lambda x, cells: -np.abs(x - beside[cells]))(1, 2, 10)
    np.testing.assert_allclose(found.places[0], beside, rtol=0.0, atol=2e-12)


@pytest.mark.parametrize("steep", [1.3, 1e3])
def test_a_peak_that_is_a_kink(steep: float) -> None:
    """With slopes or without: there is no place where they are zero."""
    height = lambda x, cells: np.where(x < PEAKS[cells], -steep, -0.7) * np.abs(x - PEAKS[cells])  # noqa: E731
    slope = lambda x, cells: (np.where(x < PEAKS[cells], steep, -0.7),)  # noqa: E731
    for merit in (Known(height), Known(height, slope)):
        np.testing.assert_allclose(merit(1, PEAKS.size, 20).places[0], PEAKS, rtol=0.0, atol=2e-12)


def test_a_basin_that_only_the_finer_sweep_shows() -> None:
    """A peak of half the width of a spacing; and one beside whose two points nothing rises towards it."""
    axis = axis_of(20)

    def peaks(x: Array, cells: NDArray[np.int64]) -> Array:
        return -np.abs(x - 0.9) + np.where(cells == 1, 2.0, 0.0) * np.exp(-(((x - axis[7]) / 0.01) ** 2))

    def hidden(heights: Array, middle: float, x: Array, _cells: Any) -> Array:
        return np.maximum(np.interp(x, axis, heights), 0.3 - 10.0 * np.abs(x - middle) / (0.3 * axis[1]))

    found = Known(peaks)(1, 2, 20)
    assert found.too_coarse.tolist() == [False, True]
    assert found.places[0] == pytest.approx([0.9, axis[7]], abs=1e-3)
    inner, outer, rest = [-9.0, -8.0, 0.0, -5.0, -4.5, -4.0, -6.0], [-6.0, 0.0, -5.0, -4.5], np.full(axis.size, -10.0)
    for before, heights in ((3, [*inner, *rest[7:]]), (axis.size - 2, [*rest[4:], *outer])):  # also next to an end
        middle = axis[before : before + 2].mean()
        found = Known(partial(hidden, np.array(heights), middle))(1, 1, 20)
        assert found.places[0, 0] == pytest.approx(middle, abs=2e-12)
        assert found.merits[0] == pytest.approx(0.3, rel=1e-9)
        assert found.too_coarse.all()


@pytest.mark.parametrize("edge", [0.777, 0.25])
@pytest.mark.parametrize("slope", [None, _slope_of_ripple])
def test_an_optimum_at_the_edge_of_what_is_feasible(edge: float, slope: Any) -> None:
    """The peak is beyond it, or within."""
    found = Known(lambda x, cells: np.where(x <= edge, _ripple(x, cells), -np.inf), slope)(1, PEAKS.size, 100)
    for number, (place, merit) in enumerate(zip(found.places[0], found.merits, strict=True)):
        assert place <= edge
        assert merit >= _ripple(np.linspace(0.0, edge, 400_001), np.array(number)).max() - 1e-14
        if PEAKS[number] <= edge:
            assert place == pytest.approx(PEAKS[number], abs=3e-9)


def test_nothing_that_is_feasible_and_nothing_that_has_a_value() -> None:
    nothing = Known(lambda x, _: np.where(x < 2.0, -np.inf, x))(1, 2, 5)
    assert np.isnan([*nothing.places, nothing.merits]).all()
    assert not nothing.too_coarse.any()
    gaps = Known(lambda x, _: np.where(x < 0.4, np.nan, -x))(1, 1, 21)
    assert gaps.places[0, 0] == pytest.approx(0.4, abs=2e-12)


ROOT = np.sqrt(10.0)
ON_DISC = [0.5 + 0.9 / ROOT, 0.5 + 0.3 / ROOT]
SEVERAL: dict[str, tuple[Any, list[float], float, float]] = {  # merit, place, its value, error of the place
    "ridge": (lambda x, y, _: -np.abs(x + 2.0 * y - 1.1) - 0.1 * (x - 0.41) ** 2, [0.41, 0.345], 0.0, 1e-7),
    "bent ridge": (lambda x, y, _: -np.abs(y - x * x) - 0.1 * (x - 0.61) ** 2, [0.61, 0.3721], 0.0, 1e-3),
    "corner": (lambda x, y, _: -np.abs(x - 0.31) - np.abs(y - x - 0.2), [0.31, 0.51], 0.0, 1e-9),
    "end": (lambda x, y, _: np.cos(x - 0.3) + y - x, [0.0, 1.0], 1.0 + np.cos(0.3), 0.0),
    "plane over a disc": (lambda x, y, _: np.where((x - 0.5) ** 2 + (y - 0.5) ** 2 <= 0.09, 3.0 * x + y, -np.inf), ON_DISC, 2.0 + 0.3 * ROOT, 1e-6),
    "step": (lambda x, y, _: 3.0 * x + y - 5.0 * ((x - 0.5) ** 2 + (y - 0.5) ** 2 > 0.09), ON_DISC, 2.0 + 0.3 * ROOT, 1e-6),
    "three": (lambda x, y, z, _: -np.abs(x + 2.0 * y - z - 0.7) - np.abs(x - y + 0.01) - 0.1 * (x - 0.41) ** 2, [0.41, 0.42, 0.55], 0.0, 1e-7),
}  # fmt: skip


@pytest.mark.parametrize("name", SEVERAL)
def test_several_inputs_without_slopes(name: str) -> None:
    height, place, merit, error = SEVERAL[name]
    found = Known(height)(len(place), 1, 40 if len(place) == 2 else 15)
    np.testing.assert_allclose(found.places[:, 0], place, rtol=0.0, atol=error)
    assert found.merits[0] == pytest.approx(merit, rel=1e-12, abs=1e-8 if name == "bent ridge" else 1e-12)


def test_two_inputs_with_a_smooth_peak() -> None:
    """A narrow bent valley (Rosenbrock's), turned over, by slopes; and a peak at an end of one input alone."""

    def height(x: Array, y: Array, cells: Any) -> Array:
        return np.where(cells == 0, -((0.4 - x) ** 2) - 100.0 * (y - x * x) ** 2, y - (x - 0.3) ** 2)

    def slope(x: Array, y: Array, cells: Any) -> tuple[Array, Array]:
        along = np.where(cells == 0, 2.0 * (0.4 - x) + 400.0 * x * (y - x * x), 0.6 - 2.0 * x)
        return along, np.where(cells == 0, -200.0 * (y - x * x), 1.0)

    found = Known(height, slope)(2, 2, 12)
    np.testing.assert_allclose(found.places, [[0.4, 0.3], [0.16, 1.0]], rtol=0.0, atol=1e-13)


def test_what_is_found_of_a_cell_does_not_depend_on_the_others() -> None:
    shifts = np.linspace(0.0, 0.2, 5)
    height = lambda x, y, cells: -np.abs(x + 2.0 * y - 1.1 - shifts[cells]) - 0.1 * (x - 0.41) ** 2  # noqa: E731
    together = Known(height)(2, 5, 10)
    for cell in range(5):
        alone = Known(lambda x, y, _, cell=cell: height(x, y, cell))(2, 1, 10)
        np.testing.assert_array_equal(alone.places[:, 0], together.places[:, cell])


def test_a_sweep_has_every_place_also_in_pieces() -> None:
    cells = 2**18 + 1
    merits = sweep(Known(lambda x, cells: 0.25 * x + cells).values, 1, cells, 2)
    np.testing.assert_array_equal(merits, 0.25 * axis_of(2)[:, None] + np.arange(cells))


def test_no_point_of_a_front_is_excelled_and_every_other_is() -> None:
    first, second = np.random.default_rng(4).normal(size=(2, 300)).round(1)
    second[7] = np.nan
    chosen = front([first, second])
    for i in range(300):
        excelled = np.any((first >= first[i]) & (second >= second[i]) & ((first > first[i]) | (second > second[i])))
        alike = np.any((first[chosen] == first[i]) & (second[chosen] == second[i]))
        assert not excelled if i in chosen else excelled or alike or i == 7
    assert np.all(np.diff(first[chosen]) < 0.0)
