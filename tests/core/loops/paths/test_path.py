"""Paths of loops are those that curves are drawn by; distances to connected curves are those to a fine subdivision."""

import itertools
import math

import numpy as np
import pytest

from gradhesion.core.loops.paths.distance import feet
from tests.core.loops.models import CASES, TRUE, TURN, UNIT, Case, R, path_of, vector

WAVE = np.array([2e-3 * R, 0.3 * UNIT])
"""Depth and load of a wave of the scene, as a loop shows it: a hundredth of it is below any noise."""


@pytest.mark.parametrize("name", CASES)
def test_a_path_lies_where_drawn_curves_do(name: str) -> None:
    """Within 0.003 of a wave, jumps and turn included; ends of jumps along them to 1e-4 of the radius."""
    case = CASES[name]
    own, drawn = case.model(), case.drawn()
    found = path_of(own, vector(own))
    back, jump = drawn["path_unloading"] > 0, drawn["path_jump"] > 0
    assert np.count_nonzero(found.jump & (found.radius > 0.0)) >= np.count_nonzero(jump) - 2
    inside = found.radius > 0.0
    for piece, sign in ((slice(0, found.turn + 1), 1.0), (slice(found.turn, None), -1.0)):
        assert (sign * np.diff(found.radius[piece][inside[piece]]) >= 0.0).all(), "no branch turns back at its end"
    end = found.turn - (found.pressed is not None)  # what is drawn turns at the rim
    most = max(0.0, drawn["y"].max())
    assert max(0.0, found.places[: end + 1, 1].max()) == pytest.approx(most, abs=1e-5 * UNIT), "by a cubic"
    assert found.places[end, 0] == pytest.approx(drawn["x"].max(), rel=1e-6)
    points = np.column_stack([drawn["x"], drawn["y"]])
    for way, piece in ((~back, slice(0, found.turn + 1)), (back, slice(found.turn, None))):
        own_points = points[way]
        if own_points.size:
            rows = (row[piece] / WAVE for row in (found.places, found.tangents))
            nearest = feet(own_points / WAVE, *rows, found.curved[piece])
            assert np.abs(nearest.distance).max() < 3e-3


def test_it_turns_where_the_data_do_and_goes_on_within_the_noise_to_the_end_of_the_branch() -> None:
    own = Case({"A": 0.03}).model()

    def end(blur: float) -> float:
        own.blur = blur
        found = path_of(own, vector(own))
        return float(found.places[found.turn, 0])

    assert end(0.0) == pytest.approx(TURN * R, rel=1e-10)
    assert end(1e-12) == pytest.approx(TURN * R + 1e-12, rel=1e-10)
    beyond = path_of(own, vector(own))
    own.furthest = (0.2 * TURN * R, -math.inf)
    folds = beyond.places[np.flatnonzero(beyond.jump[: beyond.turn]) - 1, 0]
    assert end(R) == pytest.approx(folds[folds >= 0.2 * TURN * R][0], rel=1e-6), "at a jump it ends"


def test_where_works_differ_the_turn_is_a_number() -> None:
    own = CASES["closing ratio 0.3"].model(("E_star", "turn"))
    found = path_of(own, vector(own, turn=1.02 * TURN * R))
    assert found.places[found.turn, 0] == pytest.approx(1.02 * TURN * R, rel=1e-10)
    assert found.radius[found.turn] == found.radius[found.turn + 1]
    assert found.places[found.turn + 1, 0] < found.places[found.turn, 0], "the edge is pinned"


def test_zeros_and_a_tilt_are_added() -> None:
    plain, shifted = (CASES["wavy"].model(names) for names in (
        ("E_star",), ("E_star", "indentation_offset", "load_offset", "load_slope")))  # fmt: skip
    plain.furthest = (TURN * R - 2e-9, -math.inf)
    before, after = (path_of(one, vector(one)) for one in (plain, shifted))
    x = before.places[1:-1, 0] + 2e-9
    np.testing.assert_allclose(after.places[1:-1, 0], x, rtol=1e-9)
    np.testing.assert_allclose(after.places[1:-1, 1], before.places[1:-1, 1] + 1e-8 + 0.02 * x, atol=1e-9 * UNIT)


@pytest.mark.parametrize("name", ["rim", "preload at the rim"])
def test_an_edge_pressed_on_at_the_rim_is_a_flat_punch(name: str) -> None:
    own = CASES[name].model()
    found = path_of(own, vector(own))
    assert found.pressed is not None
    rim, end = found.places[found.turn - 1], found.places[found.turn]
    assert (end[1] - rim[1]) / (end[0] - rim[0]) == pytest.approx(2.0 * TRUE["E_star"] * 0.2 * R, rel=1e-9)
    assert not found.curved[found.turn]
    if name != "rim":
        assert rim[1] < 0.6 * end[1] == pytest.approx(0.6 * 6e-6, rel=1e-12), "the preload is reached"


def test_no_contact_is_a_line_of_no_load() -> None:
    own = Case(more={"furthest": (-0.01 * R, -math.inf)}).model()
    found = path_of(own, vector(own))
    assert not found.places[:, 1].any()
    assert not found.radius.any()


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
