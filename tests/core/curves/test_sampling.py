"""Points between knots: within the tolerance everywhere, few, and the same both ways."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.arrays.tables import table_of
from gradhesion.core.curves.equilibrium import scales_of
from gradhesion.core.curves.forms import PLAIN, Reduced, fill_points
from gradhesion.core.curves.sampling import TOLERANCE, sample
from gradhesion.core.curves.subject import Form

K = 0.41
TABLE = table_of(K)
PULL = Reduced(PLAIN, K, 1.0)


def _knots(places: list[float]) -> Any:
    """The start, the turns of depth and load, and the end of a smooth punch."""
    knots = np.empty((3, len(places)))
    knots[0] = places
    fill_points(TABLE, PULL, knots)
    return knots


@pytest.fixture
def knots() -> Any:
    power = 2.0 / (3.0 + K)
    return _knots([0.0, (0.5 * (1.0 - K)) ** power, (0.5 * (3.0 + K)) ** power, 2.3])


def _sample(knots: Any, joined: Any = None) -> tuple[Any, Any]:
    joined = np.arange(knots.shape[1]) > 0 if joined is None else np.array(joined)
    return sample(TABLE, PULL, np.ascontiguousarray(knots), joined, scales_of(knots))


def test_chords_are_within_the_tolerance_and_hardly_finer(knots: Any, worst_chord: Callable[..., float]) -> None:
    form = Form(TABLE, PULL, 1.0, 1.0, 1.0)
    points, _ = _sample(knots)
    spans = np.ptp(knots, axis=1)
    assert 0.2 * TOLERANCE < worst_chord(form, points, spans=spans) <= 1.1 * TOLERANCE
    # halving pieces wastes at most a factor of two in points: a quarter of them is not enough
    assert worst_chord(form, points[:, ::4], spans=spans) > TOLERANCE
    assert points.shape[1] < 150


def test_knots_are_points(knots: Any) -> None:
    points, owners = _sample(knots)
    last = np.flatnonzero(np.diff(owners, append=knots.shape[1]))
    assert np.array_equal(points[:, last], knots)
    assert np.array_equal(np.unique(owners), np.arange(knots.shape[1]))
    assert (np.diff(points[0]) > 0).all()


def test_points_between_lie_on_the_curve(knots: Any) -> None:
    points, _ = _sample(knots)
    again = points.copy()
    fill_points(TABLE, PULL, again)
    assert np.array_equal(again, points)


def test_the_way_back_has_the_same_points(knots: Any) -> None:
    there, _ = _sample(knots)
    back, _ = _sample(knots[:, ::-1])
    assert np.array_equal(back[:, ::-1], there)


def test_a_straight_step_has_no_points_of_its_own(knots: Any) -> None:
    points, owners = _sample(knots, [False, True, False, True])
    assert (owners == 2).sum() == 1
    assert (owners == 1).sum() > 3
    assert points[0].tolist().count(knots[0, 2]) == 1


def test_more_points_than_there_was_room_for(knots: Any) -> None:
    """One piece that needs more than the room of four points a knot and 64."""
    fine = scales_of(knots) * 1e3
    points, owners = sample(TABLE, PULL, knots, np.arange(4) > 0, fine)
    assert points.shape[1] == owners.size > 1000
    assert (np.diff(points[0]) > 0).all()


def test_one_knot_is_one_point(knots: Any) -> None:
    points, owners = _sample(knots[:, :1])
    assert np.array_equal(points, knots[:, :1])
    assert owners.tolist() == [0]
