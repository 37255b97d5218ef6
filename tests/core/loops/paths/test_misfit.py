"""Distances in units of the noise, what a scene without a path leaves, and starts that are refined within ranges."""

import numpy as np

from gradhesion.core.loops.paths.misfit import LOST, Data, Misfit
from tests.core.loops.models import CASES, UNIT, Array, R, vector

NOISE = (1e-4 * R, 0.01 * UNIT)
MOVED = np.array([0.5, -0.7])


def of(name: str, names: tuple[str, ...]) -> tuple[Misfit, Array]:
    """A loop without noise: the vertices of its path."""
    model = CASES[name].model(names)
    here = vector(model)
    drawn = model.path(here)
    assert drawn is not None
    back = np.arange(len(drawn.places)) > drawn.turn
    data = Data(drawn.places, back, NOISE, np.ones(back.size))
    return Misfit(data, model, here - 2.0, here + 2.0), here


def test_a_scene_without_a_path_is_far_from_all_points_and_flat() -> None:
    own, here = of("wavy", ("E_star", "wavelength"))
    assert np.abs(own.residual(here)).max() < 1e-6, "its own points"
    nowhere = here - [0.0, 20.0]  # waves of 1e-15 m: too many radii
    assert own.model.path(nowhere) is None
    assert set(own.residual(nowhere)) == {LOST}
    assert not own.jacobian(nowhere).any()


def test_a_start_is_refined_within_the_ranges_and_what_is_held_stays() -> None:
    own, here = of("smooth", ("E_star", "work_of_adhesion"))
    found = own.refined(here + MOVED)
    np.testing.assert_allclose(found.x, here, atol=1e-6)
    held = own.refined(here + MOVED, held=[0])
    assert held.x[0] == here[0] + 0.5
    assert held.cost > 1.0


def test_outliers_hardly_change_the_size() -> None:
    own, here = of("smooth", ("E_star",))
    before = own.size(here)
    own.points[5] += 1e3
    own = Misfit(own.data._replace(points=own.points * own.scale), own.model, own.low, own.high)
    assert own.size(here) - before < np.log1p(2e6) + 1e-3


def test_works_of_closing_down_to_0_have_derivatives() -> None:
    """At an end of what there is, the difference has one side only."""
    model = CASES["closing ratio 0"].model(("E_star", "closing_ratio"))
    here = vector(model, closing_ratio=0.0)
    drawn = model.path(here)
    assert drawn is not None
    data = Data(drawn.places, np.arange(len(drawn.places)) > drawn.turn, NOISE, np.ones(len(drawn.places)))
    own = Misfit(data, model, here - 0.1, here + 1.0)
    assert np.isfinite(own.jacobian(here)).all()
    assert own.jacobian(here)[:, 1].any()
