"""Distances to a connected curve: against a fine subdivision of it, of a circle, and against its motion."""

import itertools

import numpy as np
import pytest

from gradhesion.core.loops.paths.distance import feet


def test_distances_are_those_to_a_connected_curve() -> None:
    rng = np.random.default_rng(2)
    chain, points = rng.standard_normal((7, 2)), rng.standard_normal((40, 2))
    fine = np.concatenate([np.linspace(one, other, 20_001) for one, other in itertools.pairwise(chain)])
    expected = [np.hypot(*(fine - point).T).min() for point in points]
    np.testing.assert_allclose(np.abs(feet(points, chain).distance), expected, atol=1e-6)
    np.testing.assert_allclose(feet(points, chain[::-1]).distance, -feet(points, chain).distance, atol=1e-12)


@pytest.mark.parametrize(("away", "most"), [(0.0, 1e-6), (1e-3, 1e-6), (0.03, 2e-6)])
def test_of_a_circle_curved_pieces_have_its_distances(away: float, most: float) -> None:
    """Chords are off by 1e-3 of the radius; on the curve, the error of the cubics falls with the fourth power."""
    rng, errors = np.random.default_rng(1), []
    for count in (65, 129):
        angle = np.linspace(0.0, 2.0 * np.pi, count)
        circle = np.column_stack([np.cos(angle), np.sin(angle)])
        at, off = rng.uniform(0.2, 2.0 * np.pi - 0.2, 500), rng.uniform(-away, away, 500)
        points = (1.0 + off)[:, None] * np.column_stack([np.cos(at), np.sin(at)])
        curved, tangents = np.append(False, np.ones(count - 1, bool)), circle[:, ::-1] * [-3.0, 3.0]
        errors.append(np.abs(feet(points, circle, tangents, curved).distance + off).max())
        assert np.abs(feet(points, circle).distance + off).max() > 30.0 * errors[-1], "chords are worse"
    assert errors[0] < most
    assert errors[1] < errors[0] * (0.08 if away == 0.0 else 0.5)


@pytest.mark.parametrize(("count", "most"), [(9, 4e-3), (17, 3e-4), (33, 2e-5)])
def test_points_far_outside_of_a_sharp_bend_have_its_distances(count: int, most: float) -> None:
    """Their feet are between chords, where a distance to the tangent of a vertex jumps from one to the next."""
    angle, around = np.linspace(0.0, 2.0 * np.pi, count), np.linspace(1.0, 5.0, 10_001)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    points = 5.0 * np.column_stack([np.cos(around), np.sin(around)])
    found = feet(points, circle, circle[:, ::-1] * [-1.0, 1.0], np.append(False, np.ones(count - 1, bool)))
    np.testing.assert_allclose(found.distance, -4.0, atol=most)
    assert np.abs(np.diff(found.distance)).max() < most / 100.0, "without jumps"
