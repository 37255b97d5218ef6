"""Distances to paths, how they change as paths move, and a scene without a path."""

import numpy as np
import pytest

from gradhesion.core.loops.fitted import OFFSETS
from gradhesion.core.loops.paths.misfit import LOST, Misfit
from tests.core.loops.models import CASES, NOISE, Array, R, misfit_of, path_of, vector

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
    found = np.empty((own.weights.size, 2))
    for way, _, nearest in own.nearest(here).branches:
        found[way] = own.points[way] - nearest.distance[:, None] * nearest.normal
    return found


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
    assert own.model.path(nowhere) is None
    assert set(own.residual(nowhere)) == {LOST}
    assert not own.jacobian(nowhere).any()
    spots = drawn.places.copy()
    spots[5] += 1e3 * np.array(NOISE)
    far = misfit_of(model, here, spots, np.arange(len(spots)) > drawn.turn)
    assert far.size(here) - own.size(here) < np.log1p(2e6) + 1e-3
