"""Distances to a connected curve: against a fine subdivision of it, and against its motion."""

import itertools

import numpy as np

from gradhesion.core.answers.loop_distance import feet


def test_distances_are_those_to_a_connected_curve() -> None:
    rng = np.random.default_rng(2)
    chain, points = rng.standard_normal((7, 2)), rng.standard_normal((40, 2))
    fine = np.concatenate([np.linspace(one, other, 20_001) for one, other in itertools.pairwise(chain)])
    expected = [np.hypot(*(fine - point).T).min() for point in points]
    np.testing.assert_allclose(np.abs(feet(points, chain).distance), expected, atol=1e-6)
    np.testing.assert_allclose(feet(points, chain[::-1]).distance, -feet(points, chain).distance, atol=1e-12)


def test_slopes_are_those_of_the_distances_as_the_vertices_move() -> None:
    rng = np.random.default_rng(4)
    chain, points = rng.standard_normal((7, 2)), rng.standard_normal((40, 2))
    moving, none = rng.standard_normal((7, 2, 3)), np.zeros(7, bool)
    found, step = feet(points, chain).slopes(moving, none), 1e-6
    for i in range(3):
        above, below = (feet(points, chain + sign * step * moving[:, :, i]) for sign in (1.0, -1.0))
        same = above.piece == below.piece  # a point between two pieces may change from one to the other
        assert np.count_nonzero(same) >= 38
        np.testing.assert_allclose(((above.distance - below.distance) / (2.0 * step))[same], found[same, i], atol=1e-6)


def test_a_jump_moves_as_the_fold_does_that_it_starts_from() -> None:
    chain = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [2.0, 2.0]])
    moving = np.array([[[0.0], [0.0]], [[3.0], [0.0]], [[50.0], [0.0]], [[50.0], [0.0]]])
    jump = np.array([False, False, True, False])
    assert feet(np.array([[1.1, 1.0]]), chain).slopes(moving, jump).tolist() == [[3.0]]
