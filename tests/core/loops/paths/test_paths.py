"""Paths of loops are those that curves are drawn by; distances to them, and how these change as paths move."""

import itertools
import math

import numpy as np
import pytest

from gradhesion.core.loops.fitted import OFFSETS
from gradhesion.core.loops.paths.distance import feet
from gradhesion.core.loops.paths.misfit import LOST, Misfit
from gradhesion.core.loops.paths.path import draw_loop
from tests.core.loops.models import CASES, NOISE, TRUE, TURN, UNIT, Array, Case, R, misfit_of, path_of, vector

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


STEP = 1e-5
"""Of the numbers as they are searched; of offsets, in units of the noise."""
ALL = ("E_star", "work_of_adhesion", "wavelength", "A", *OFFSETS)
SMOOTH = ("E_star", "work_of_adhesion", *OFFSETS)
SEARCHED: dict[str, tuple[str, ...]] = {
    "wavy": ALL,
    "smooth": SMOOTH,
    "series": ALL,
    "rim": ALL,
    "preload": ("preload", *ALL[:4], "load_offset"),
    "machine": (*ALL[:4], "spring_constant", "indentation_max", *OFFSETS),
    "machine at the rim": ("indentation_max", "spring_constant", *ALL),
    "load control": ALL,
    "load control to a depth": ("indentation_max", *ALL[:4], "load_offset"),
    "preload at the rim": ("preload", *ALL[:4], "load_offset"),
    "closing ratio 0.3": ("closing_ratio", *ALL, "turn"),
    "closing ratio 0": ALL,
    "rings": ("toughness_wavelength", "toughness_amplitude", *SMOOTH),
    "graded": ("k", "c0", *ALL),
}
ALONE = {"spring_constant": "machine", "a_max": "rim", "preload": "preload", "indentation_max": "machine"}


def misfit(name: str, seed: int, points: int = 400) -> tuple[Misfit, Array]:
    """A loop of a kind whose points lie about its path, also within jumps and beyond the turn."""
    case = CASES.get(name, CASES["wavy"])
    names = tuple(one for one in SEARCHED[name] if one != "c0")
    model = case.model(names, {"c0": 0.1 * R} if name == "graded" else None)
    here = vector(model, **(case.own | ({"k": 0.3} if name == "graded" else {})))
    drawn, rng = path_of(model, here), np.random.default_rng(seed)
    piece, share = rng.integers(0, len(drawn.places) - 1, points), rng.random(points)
    corners = np.flatnonzero(drawn.jump | np.roll(drawn.jump, -1))
    at = rng.choice([*corners, drawn.turn], points // 4)
    piece[: at.size], share[: at.size] = np.minimum(at, len(drawn.places) - 2), 0.0
    spots = (1.0 - share)[:, None] * drawn.places[piece] + share[:, None] * drawn.places[piece + 1]
    spots += 2.0 * rng.standard_normal((points, 2)) * NOISE
    return misfit_of(model, here, spots, piece >= drawn.turn, count=4.0), here


def feet_of(own: Misfit, here: Array) -> Array:
    """Where the points have their feet, in m and N over the noise; of the path of some numbers."""
    nearest = own.nearest(here).feet
    assert nearest is not None
    return own.points - nearest.distance[:, None] * nearest.normal


@pytest.mark.parametrize("name", SEARCHED)
def test_distances_change_as_those_to_a_path_that_is_drawn_again(name: str) -> None:
    """But of the few points whose nearest place is another one as the path moves.

    Vertices move along the path too, as it is drawn again, so that differences have the error of pieces between them.
    """
    own, here = misfit(name, seed=1)
    exact = own.jacobian(here)[:400]
    units = {OFFSETS[0]: NOISE[0], OFFSETS[1]: NOISE[1], "indentation_max": NOISE[0], "turn": NOISE[0]}
    for i, one in enumerate(own.names):
        step = STEP * units.get(one, 1.0)
        ends = [here + sign * step * np.eye(here.size)[i] for sign in (1.0, -1.0)]
        places = [feet_of(own, end) for end in ends]
        same = np.hypot(*(places[0] - places[1]).T) < 0.3
        above, below = (own.residual(end)[:400] for end in ends)
        apart = np.abs((above - below) / (2.0 * step) - exact[:, i])
        size = np.sqrt(np.mean(exact[:, i] ** 2))
        assert np.mean(same) > 0.98, one
        assert np.median(apart[same]) < 0.006 * size, one
        assert np.mean(apart[same] > 0.2 * size) < 0.035, one
        if name in ("rim", "wavy", "smooth"):
            assert apart[same].max() < 0.15 * size, one


@pytest.mark.parametrize("name", ["wavy", "rim"])
def test_the_turn_follows_what_it_is_prescribed_by(name: str) -> None:
    """A point beyond the end of a path is as far as the end is: that moves along its branch with the zero of depth."""
    own, here = misfit(name, seed=2)
    i, step = own.names.index(OFFSETS[0]), 1e-3 * NOISE[0]
    drawn = path_of(own.model, here)
    one = misfit_of(own.model, here, drawn.places[[drawn.turn]] + [0.0, 5.0 * NOISE[1]], np.zeros(1, bool))
    ends = [one.residual(here + sign * step * np.eye(here.size)[i])[0] for sign in (1.0, -1.0)]
    assert one.jacobian(here)[0, i] == pytest.approx((ends[0] - ends[1]) / (2.0 * step), rel=1e-3)


@pytest.mark.parametrize(("one", "name"), ALONE.items())
def test_one_number_that_leaves_equilibrium_as_it_is_may_be_searched_alone(one: str, name: str) -> None:
    model = CASES[name].model((one,))
    here = vector(model, **CASES[name].own)
    drawn = path_of(model, here)
    spots = drawn.places + 2.0 * np.random.default_rng(3).standard_normal(drawn.places.shape) * NOISE
    spots[drawn.turn] = drawn.places[drawn.turn] + 5.0 * np.array(NOISE)  # beyond the end
    own = misfit_of(model, here, spots, np.arange(len(spots)) > drawn.turn)
    step = 1e-3 * NOISE[0] if one == "indentation_max" else STEP
    exact, below, above = own.jacobian(here)[:, 0], own.residual(here - step), own.residual(here + step)
    assert np.abs(exact).max() > 1.0
    assert np.median(np.abs((above - below) / (2.0 * step) - exact)) < 0.01 * np.abs(exact).max()
    if one == "a_max":  # the corners where the rim is met, and to which the contact is pressed on
        rim = np.flatnonzero(drawn.radius == drawn.scene.rim)[:2]
        np.testing.assert_allclose(exact[rim], ((above - below) / (2.0 * step))[rim], rtol=1e-4, atol=1e-2)


def test_works_of_closing_down_to_0_have_derivatives() -> None:
    """At an end of what there is, the difference has one side only."""
    model = CASES["closing ratio 0"].model(("E_star", "closing_ratio"))
    here = vector(model, closing_ratio=0.0)
    drawn = path_of(model, here)
    data = drawn.places, np.arange(len(drawn.places)) > drawn.turn, NOISE, np.ones(len(drawn.places))
    slopes = Misfit(*data, model, here - 0.1, here + 1.0).jacobian(here)
    assert np.isfinite(slopes).all()
    assert slopes[:, 1].any()


def test_a_scene_without_a_path_is_far_from_all_points_and_outliers_hardly_count() -> None:
    model = CASES["wavy"].model(("E_star", "wavelength"))
    here = vector(model)
    drawn = path_of(model, here)
    own = misfit_of(model, here, drawn.places, np.arange(len(drawn.places)) > drawn.turn)
    assert np.abs(own.residual(here)).max() < 1e-6, "its own points"
    nowhere = here - [0.0, 20.0]  # waves of 1e-15 m: too many radii
    assert draw_loop(own.model, nowhere) is None
    assert set(own.residual(nowhere)) == {LOST}
    assert not own.jacobian(nowhere).any()
    spots = drawn.places.copy()
    spots[5] += 1e3 * np.array(NOISE)
    far = misfit_of(model, here, spots, np.arange(len(spots)) > drawn.turn)
    assert far.size(here) - own.size(here) < np.log1p(2e6) + 1e-3
