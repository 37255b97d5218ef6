"""Optima of merits whose peaks are known: smooth, kinks, at ends, at edges of what is feasible, hidden; and of forces."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.answers.optimum import Optima, axis_of, optima_of, sweep

Array = NDArray[np.float64]
PEAKS = np.array([0.0, 0.137, 0.5, 0.73141592, 1.0])
"""One a cell."""


@dataclass
class Known:
    """A merit by formula."""

    height: Callable[..., Any]
    slope: Callable[..., Any] | None = None
    margin: Callable[..., Any] | None = None

    def values(self, places: Array, cells: NDArray[np.int64]) -> tuple[Array, Array]:
        merits = np.asarray(self.height(*places, cells)) + 0.0 * places[0] + 0.0 * cells
        margins = np.zeros(merits.shape) if self.margin is None else self.margin(*places) + 0.0 * merits
        return merits, margins

    def slopes(self, places: Array, cells: NDArray[np.int64]) -> Array | None:
        return None if self.slope is None else np.array(np.broadcast_arrays(*self.slope(*places, cells)))


def optima(merit: Known, inputs: int, cells: int, resolution: int) -> Optima:
    """The optimum of each cell, from a sweep at a resolution."""
    return optima_of(merit, *sweep(merit, inputs, cells, resolution))


def _ripple(x: Array, cells: NDArray[np.int64]) -> Array:
    return np.cos(x - PEAKS[cells]) + 0.02 * np.cos(40.0 * np.pi * (x - PEAKS[cells]))


def _slope_of_ripple(x: Array, cells: NDArray[np.int64]) -> tuple[Array]:
    return (-np.sin(x - PEAKS[cells]) - 0.8 * np.pi * np.sin(40.0 * np.pi * (x - PEAKS[cells])),)


def test_a_smooth_peak_among_others() -> None:
    """Values alone give the place to the root of rounding, slopes to rounding."""
    for slope, error in ((None, 3e-9), (_slope_of_ripple, 1e-15)):
        found = optima(Known(_ripple, slope), 1, PEAKS.size, 100)
        np.testing.assert_allclose(found.places[0], PEAKS, rtol=0.0, atol=error)
        np.testing.assert_allclose(found.merits, 1.02, rtol=4e-16)
        assert not found.too_coarse.any()


def test_a_peak_that_is_a_kink() -> None:
    found = optima(Known(lambda x, cells: -np.abs(x - PEAKS[cells]) - 0.3 * (x - PEAKS[cells])), 1, PEAKS.size, 20)
    np.testing.assert_allclose(found.places[0], PEAKS, rtol=0.0, atol=2e-12)


def test_a_basin_that_only_the_finer_sweep_shows() -> None:
    """A peak of half the width of a spacing, between two points of the stated resolution."""
    at = axis_of(20)[7]
    hidden = Known(
        lambda x, cells: -np.abs(x - 0.9) + np.where(cells == 1, 2.0, 0.0) * np.exp(-(((x - at) / 0.01) ** 2))
    )
    found = optima(hidden, 1, 2, 20)
    assert found.too_coarse.tolist() == [False, True]
    assert found.places[0] == pytest.approx([0.9, at], abs=1e-3)


def test_a_peak_between_two_points_beside_which_nothing_rises_towards_it() -> None:
    """The merit falls steeply to the one point, and rises beyond the other."""
    axis, own = axis_of(20), np.array([-9.0, -8.0, 0.0, -5.0, -4.5, -4.0, -6.0])
    heights = np.concatenate([own, np.full(axis.size - own.size, -10.0)])
    middle, width = axis[3:5].mean(), 0.3 * axis[1]
    hidden = Known(lambda x, _: np.maximum(np.interp(x, axis, heights), 0.3 - 10.0 * np.abs(x - middle) / width))
    found = optima(hidden, 1, 1, 20)
    assert found.places[0, 0] == pytest.approx(middle, abs=2e-12)
    assert found.merits[0] == pytest.approx(0.3, rel=1e-9)
    assert found.too_coarse.all()


@pytest.mark.parametrize("edge", [0.777, 0.25])
def test_an_optimum_at_the_edge_of_what_is_feasible(edge: float) -> None:
    """Told by a margin that only says yes or no; the peak is beyond it, or within."""
    found = optima(Known(_ripple, margin=lambda x: np.where(x <= edge, 1.0, -1.0)), 1, PEAKS.size, 100)
    for peak, place, merit in zip(PEAKS, found.places[0], found.merits, strict=True):
        assert place <= edge
        fine = np.linspace(0.0, edge, 400_001)
        best = _ripple(fine, np.array(PEAKS.tolist().index(peak))).max()
        assert merit >= best - 1e-14
        if peak <= edge:
            assert place == pytest.approx(peak, abs=3e-9)


def test_nothing_that_is_feasible_and_nothing_that_has_a_value() -> None:
    nothing = optima(Known(_ripple, margin=lambda x: x - 2.0), 1, 2, 5)
    assert np.isnan(nothing.places).all()
    assert np.isnan(nothing.merits).all()
    gaps = optima(Known(lambda x, cells: np.where(x < 0.4, np.nan, -x) + 0.0 * cells), 1, 1, 21)
    assert gaps.places[0, 0] == pytest.approx(0.4, abs=2e-12)


def test_two_inputs_with_a_smooth_peak() -> None:
    """A narrow bent valley (Rosenbrock's), turned over; and one whose peak is at an end of one input."""

    def height(x: Array, y: Array, _cells: Any) -> Array:
        return -((0.4 - x) ** 2) - 100.0 * (y - x * x) ** 2

    def slope(x: Array, y: Array, _cells: Any) -> tuple[Array, Array]:
        inner = y - x * x
        return 2.0 * (0.4 - x) + 400.0 * x * inner, -200.0 * inner

    found = optima(Known(height, slope), 2, 1, 12)
    np.testing.assert_allclose(found.places[:, 0], [0.4, 0.16], rtol=0.0, atol=1e-13)
    end = optima(Known(lambda x, y, _cells: np.cos(x - 0.3) + y * x), 2, 1, 12)
    assert end.places[1, 0] == 1.0
    np.testing.assert_allclose(
        end.merits[0], np.max(np.cos(x := np.linspace(0, 1, 10**6 + 1) - 0.3) + x + 0.3), rtol=1e-12
    )


def test_two_inputs_with_a_ridge_of_kinks() -> None:
    found = optima(Known(lambda x, y, _cells: -np.abs(x + 2.0 * y - 1.1) - 0.1 * (x - 0.41) ** 2), 2, 1, 15)
    assert found.merits[0] == pytest.approx(0.0, abs=1e-10)
    corner = optima(Known(lambda x, y, _cells: -np.abs(x - 0.31) - np.abs(y - x - 0.2)), 2, 1, 15)
    np.testing.assert_allclose(corner.places[:, 0], [0.31, 0.51], rtol=0.0, atol=1e-9)


def test_two_inputs_at_the_edge_of_what_is_feasible() -> None:
    """The highest point of a plane over a disc."""
    plane = Known(lambda x, y, _cells: 3.0 * x + y, margin=lambda x, y: 0.09 - (x - 0.5) ** 2 - (y - 0.5) ** 2)
    found = optima(plane, 2, 1, 25)
    highest = 2.0 + 0.3 * np.sqrt(10.0)
    assert highest * (1.0 - 1e-6) < found.merits[0] <= highest * (1.0 + 1e-15)


def test_a_sweep_has_every_place() -> None:
    merits, margins = sweep(Known(lambda x, y, cells: 100.0 * x + 10.0 * y + cells), 2, 3, 3)
    axis = axis_of(3)
    np.testing.assert_array_equal(merits, 100.0 * axis[:, None, None] + 10.0 * axis[:, None] + np.arange(3))
    assert merits.shape == margins.shape == (5, 5, 3)
