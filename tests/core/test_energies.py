"""The energies of loading and of unloading: the two parts of the dissipated energy, of every profile and control."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import CONTROLS, PARAMETERS, SOLVERS, Harmonic, Loading, Profile, doubts_about, draw_curves, solve
from gradhesion.core.closed.similarity import amplitude_of_ratio
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC
from gradhesion.twin.general import Shape
from gradhesion.twin.stated import deviation, expected

EPS = 2.0**-52
PARTS = ("loading_energy", "unloading_energy")
ALL = ("dissipated_energy", *PARTS)
SCENE = {"k": 0.31, "nu": 0.27, "modulus": 900.0, "c0_over_R": 0.037, "lambda_over_R": 0.083, "A": 0.0237}
RIMS = [0.02, 0.21, 0.47, 0.73, math.inf]
PAIR = (Harmonic(n=1, cos=0.7, sin=0.2), Harmonic(n=2, sin=-0.2))


def _sum_up(found: dict[str, Any]) -> None:
    whole = found["dissipated_energy"]
    finite = np.isfinite(whole)
    loaded, unloaded = (found[part][finite] for part in PARTS)
    size = np.abs(loaded) + np.abs(unloaded)
    assert np.all(np.abs(loaded + unloaded - whole[finite]) <= 4 * EPS * size)
    for part in PARTS:
        assert np.array_equal(np.isfinite(found[part]), finite)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("k", [0.0, 0.31, 1.0])
def test_they_sum_up(solver: str, k: float) -> None:
    scenes: Any = SCENE | {"k": k, "nu": 0.5, "a_max_over_R": RIMS, "A": [[0.0], [0.0237], [0.3]]}
    _sum_up(solve(scenes, ALL, solver=solver))


@pytest.mark.parametrize("profile", [Profile(), Profile(exponent=1.5), Profile(harmonics=PAIR)])
@pytest.mark.parametrize("control", CONTROLS)
def test_they_sum_up_for_every_profile_and_control(profile: Profile, control: str) -> None:
    scenes: Any = SCENE | {"a_max_over_R": RIMS}
    scenes |= {"machine_stiffness": 0.7} if control == "machine" else {}
    _sum_up(solve(scenes, ALL, profile=profile, loading=Loading(control=control)))
    envelopes = solve(SCENE | {"a_max_over_R": RIMS}, ALL, profile=profile, solver="envelope")
    _sum_up(envelopes)


@pytest.mark.parametrize("rim", [0.02, 0.21, 0.47, 0.73])
def test_they_are_those_of_the_jumps(rim: float) -> None:
    """The list of jumps tells which are on unloading."""
    scene = SCENE | {"a_max_over_R": rim}
    jumps, _ = draw_curves(scene, ["jumps"])
    found = solve(scene, ALL)
    for unloading, part in enumerate(PARTS):
        energies = jumps["jump_energy"][jumps["jump_unloading"] == unloading]
        assert float(found[part]) == pytest.approx(energies.sum(), rel=1e-13)


@pytest.mark.parametrize(
    ("shape", "profile"),
    [
        (Shape(), Profile()),
        (Shape(harmonics=((1, 0.7, 0.2), (2, 0.0, -0.2))), Profile(harmonics=PAIR)),
    ],
)
@pytest.mark.parametrize("solver", ["exact", "envelope"])
def test_the_twin_has_the_same(shape: Shape, profile: Profile, solver: str) -> None:
    """Thirty digits, by Gauss's rule in balls; the envelope's closed forms in balls."""
    for rim in (0.21, 0.47):
        scene = SCENE | {"a_max_over_R": rim}
        found = solve(scene, ALL, profile=profile, solver=solver)
        for name, one in expected(scene, ALL, solver, shape).items():
            assert deviation(float(found[name]), one) <= one.error, name


def test_only_that_of_loading_is_in_doubt_where_loading_is_not_one_disc() -> None:
    assert doubts_about("loading_energy") & LOADING_NOT_ONE_DISC
    assert not doubts_about("unloading_energy") & LOADING_NOT_ONE_DISC


def test_short_waves_lose_what_the_envelopes_do() -> None:
    """The square of the wave, which cancels in the sum, is 0.4 chi of what loading loses: a quarter at chi = 0.6."""
    scene = SCENE | {"lambda_over_R": 2e-5, "a_max_over_R": 0.4}
    scene["A"] = float(amplitude_of_ratio(*(scene[name] for name in PARAMETERS[:5]), 0.6))
    exact, envelope = solve(scene, ALL), solve(scene, ALL, solver="envelope")
    for part in PARTS:
        assert float(exact[part]) == pytest.approx(float(envelope[part]), rel=0.03)
