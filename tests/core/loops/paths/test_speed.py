"""Loops whose edge has a speed: the path is that of the moving edge, and speed and material come back from it."""

import math

import numpy as np
import pytest

from gradhesion.core import draw_curves
from gradhesion.core.loops.fit import fit_loop
from gradhesion.core.loops.paths.offsets import NO_OFFSETS
from gradhesion.core.loops.paths.speed import SpeedModel
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Rate
from tests.core.loops.models import CASES, SCENE, TRUE, TURN, UNIT, Array, R

RATE = Rate(exponent=0.6)
FIXED = {"k": 0.0, "nu": 0.3, "R": R, "A": 0.0}


def moving(speed: float) -> tuple[Array, Array, Array]:
    """Depth, load and branch of a smooth ball at a speed over the reference, from `draw_curves`."""
    scene = SCENE | {"A": 0.0, "a_max_over_R": math.inf, "indentation_max_over_R": TURN, "speed_over_reference": speed}
    path = draw_curves(scene, ["path"], rate=RATE)[0]
    return R * path["path_indentation"], UNIT * path["path_load"], path["path_unloading"] == 1


def model(names: tuple[str, ...], **more: float) -> SpeedModel:
    fixed = {name: value for name, value in (FIXED | TRUE | {"A": 0.0} | more).items() if name not in names}
    ends = {"furthest": (TURN * R, -math.inf), "first": -0.2 * R}
    return SpeedModel(fixed, names, rate=RATE, profile=Profile(), **ends)


def test_the_path_is_that_of_the_moving_edge() -> None:
    own = model(("speed_over_reference",))
    drawn = own.path(np.log([0.3]))
    assert drawn is not None
    depth, load, back = moving(0.3)
    ours = drawn.places[drawn.turn + 1 : -1]
    assert ours[:, 1].min() == pytest.approx(load[back].min(), rel=1e-9)
    assert ours[:, 0].min() == pytest.approx(depth[back].min(), rel=1e-9)
    assert ours[:, 1].min() < 1.2 * np.min(CASES["smooth"].drawn()["y"]), "the speed has an effect"


@pytest.mark.slow
def test_speed_and_material_come_back() -> None:
    depth, load, back = moving(0.3)
    line = np.linspace(depth.min() - 0.02 * R, depth.min(), 20)
    depth, load = np.concatenate([line, depth[::4]]), np.concatenate([0.0 * line, load[::4]])
    noise = (2e-5 * R, 0.01 * UNIT)
    errors = np.random.default_rng(4).standard_normal((2, depth.size))
    found = fit_loop(
        depth + noise[0] * errors[0], load + noise[1] * errors[1], np.concatenate([line > 0.0, back[::4]]), FIXED,
        {"E_star": (2e6, 2e8), "work_of_adhesion": (5e-3, 0.2), "speed_over_reference": (0.01, 10.0)},
        noise=noise, offsets=NO_OFFSETS, rate=RATE,
    )  # fmt: skip
    assert found.converged
    assert found.status == 0
    for name, value in {"E_star": 1e7, "work_of_adhesion": 0.03, "speed_over_reference": 0.3}.items():
        assert abs(found.values[name] - value) < 4.5 * found.standard_deviations[name], name
        assert found.standard_deviations[name] < 0.2 * value, name
