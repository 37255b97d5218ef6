"""States as curves: their pressure carries the load of the path, and their surface lies on the punch and opens from it."""

import math

import numpy as np
import pytest

from gradhesion.core import Profile, draw_curves, solve
from gradhesion.core.draw import states
from gradhesion.core.equations import general, quadrature
from tests.core.scene import ENDLESS, material_of, profile_of, scene_of

SCENE = scene_of(0.1, 0.3, 500.0, 0.01, 0.2, 0.055, 0.45)


def test_named_states_lie_on_the_path() -> None:
    found, status = states.named_states(SCENE)
    path, _ = draw_curves(SCENE, ["path"])
    radius, depth, load = (path[f"path_{name}"] for name in ("contact_radius", "indentation", "load"))
    turn = np.flatnonzero(path["path_unloading"] == 1)[0] - 1
    last = int(np.flatnonzero(path["path_jump"] == 1)[-1]) - 1
    for state, i in zip(found.T, (turn, int(np.argmin(load)), last), strict=True):
        np.testing.assert_allclose(state, [radius[i], depth[i]], rtol=1e-9)
    assert status == int(solve(SCENE)["status"])


def test_absent_states_are_nan() -> None:
    unbounded, _ = states.named_states(SCENE | ENDLESS)
    assert np.isnan(unbounded[:, 0]).all()
    assert np.isfinite(unbounded[:, 1:]).all()
    linear = SCENE | {"k": 1.0, "nu": 0.5, "A": 0.0}  # contact shrinks to a point
    assert np.isnan(states.named_states(linear)[0][:, 2]).all()
    given = states.equilibrium_states(SCENE, [0.2, 0.46, 0.0, -1.0])
    assert np.isnan(given[:, 1:]).all()
    drawn = states.draw_states(SCENE, given, states.STATE_CURVES)
    assert all(np.isnan(values[1:]).all() and not np.isnan(values[0, 0]) for values in drawn.values())


@pytest.mark.parametrize("profile", [Profile(), profile_of(1.7, (1, 1.0, 0.0), (3, 0.0, 0.2))])
def test_the_pressure_is_that_of_the_equation_up_to_the_edge(profile: Profile) -> None:
    given = states.equilibrium_states(SCENE, [0.11, 0.31], profile)
    found = states.draw_states(SCENE, given, ["pressure"], profile)
    M, wave = material_of(SCENE), (0.2, *states.series_of(0.055, profile), profile.exponent)
    for (a, depth), r, p in zip(given.T, found["pressure_radius"], found["pressure"], strict=True):
        assert depth == pytest.approx(float(general.indentation(0.1, M, a, *wave)), rel=1e-12)
        assert 0.0 <= r[0] < r[-1] < a
        inside = r > 0.0
        np.testing.assert_allclose(p[inside], quadrature.pressure(0.1, M, r[inside], a, depth, *wave), rtol=1e-9)


def test_the_surface_lies_on_the_punch_and_opens_from_it() -> None:
    chosen, _ = states.named_states(SCENE)
    found = states.draw_states(SCENE, chosen, ["surface"])
    columns = (found[f"surface_{name}"] for name in ("radius", "displacement", "gap"))
    for (a, depth), r, u, gap in zip(chosen.T, *columns, strict=True):
        height = 0.5 * r * r + 0.011 * (1 - np.cos(2 * math.pi * r / 0.2))
        assert a in r
        assert np.array_equal(np.isnan(gap), r > 0.45)
        assert (gap[r <= a] == 0).all()
        shown = ~np.isnan(gap)
        np.testing.assert_allclose(u[shown], (depth - height + gap)[shown], atol=1e-15)
        assert (gap[shown] >= 0).all()  # the scene is one disc
        assert abs(u[-1]) < 0.5 * abs(depth - height[-1])  # far away the surface is at rest
