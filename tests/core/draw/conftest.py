"""Scenes of every kind, and all their curves."""

import math
from functools import cache
from typing import Any

import pytest

from gradhesion.core import CURVES, draw_curves
from gradhesion.core.problem.status import NO_VALUE
from tests.core.scene import scene_of

SCENE = scene_of(0.31, 0.27, 1730.0, 0.037, 0.043, 0.0137, 0.47)
BEYOND = {"k": 0.0164, "nu": -0.09, "modulus": 88.0, "c0_over_R": 0.11, "lambda_over_R": 0.128, "A": 0.167}
SCENES: dict[str, dict[str, float]] = {
    "wavy": {},
    "homogeneous": {"k": 0.0},
    "half": {"k": 0.5},
    "linear": {"k": 1.0, "nu": 0.5},
    "nearly linear": {"k": 1.0 - 1e-9, "nu": 0.5},
    "smooth": {"A": 0.0},
    "unbounded": {"a_max_over_R": math.inf},
    "unbounded smooth": {"a_max_over_R": math.inf, "A": 0.0},
    "short waves": {"lambda_over_R": 7e-4},
    "one long wave": {"lambda_over_R": 3e4},
    "r > s": {"A": 0.21},
    "r > s, unbounded": {"A": 0.21, "a_max_over_R": math.inf},
    "r > s, linear": {"k": 1.0, "nu": 0.5, "A": 0.4},
    "small rim": {"a_max_over_R": 0.01},
    "smooth with a small rim": {"a_max_over_R": 0.03, "A": 0.0},
    "hardly wavy": {"A": 1e-14},
    "large rim": {"a_max_over_R": 300.0},
    "waves beyond the folds": BEYOND | {"a_max_over_R": math.inf},
    "waves beyond the folds, finer": {"lambda_over_R": 0.0031, "A": 0.003, "a_max_over_R": 1.9},
}


@pytest.fixture
def scene() -> dict[str, float]:
    """A scene off every round number, with several jumps both ways."""
    return dict(SCENE)


@pytest.fixture(params=SCENES, ids=str)
def any_scene(request: pytest.FixtureRequest) -> dict[str, float]:
    return SCENE | SCENES[request.param]


@cache
def _all_curves(*values: float) -> tuple[dict[str, Any], int]:
    return draw_curves(dict(zip(SCENE, values, strict=True)), list(CURVES))


@pytest.fixture
def drawn(any_scene: dict[str, float]) -> dict[str, Any]:
    """All curves of a scene, which no test may change."""
    variables, status = _all_curves(*(any_scene[name] for name in SCENE))
    assert not status & NO_VALUE
    return variables
