"""The lowest load of any profile: on curves of many waves against ball arithmetic."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Profile, solve
from gradhesion.core.closed.similarity import amplitude_of_ratio
from gradhesion.core.problem.material import stiffness
from gradhesion.twin.general import Shape
from tests.twin.far import pull_off_force

pytestmark = pytest.mark.slow

NAMES = ("pull_off_force", "pull_off_radius")
SHAPES = {
    "one cosine": Shape(2.0, ((1, 1.0, 0.0),)),
    "sine": Shape(2.0, ((1, 0.0, 1.0),)),
    "negative": Shape(2.0, ((1, -1.0, 0.0),)),
    "two harmonics": Shape(2.0, ((1, 0.6, -0.3), (2, -0.2, 0.25))),
    "seven harmonics": Shape(2.0, tuple((n, math.cos(n * n) / n, math.sin(n * n) / n) for n in range(1, 8))),
    "exponent 5": Shape(5.0, ((1, 0.8, 0.6),)),
    "cone": Shape(1.0, ((2, 0.3, 0.4),)),
}


def _profile(shape: Shape) -> Profile:
    return Profile(
        exponent=shape.exponent,
        harmonics=tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in shape.harmonics),
    )


def _scene(shape: Shape, waves: float, ratio: float, chi: float, k: float) -> dict[str, float]:
    """Give a scene with so many waves up to its rim, whose size is `ratio` of the length of similarity."""
    rim, c0 = 0.3, 0.1
    M = (rim / ratio) ** (1.0 - 2.0 * shape.exponent - k)
    nu = 0.5 if k == 1.0 else 0.3
    material: Any = {"k": k, "nu": nu, "modulus": M / float(stiffness(k, nu, 1.0, c0)), "c0_over_R": c0}
    material |= {"lambda_over_R": rim / waves}
    return {**material, "A": float(amplitude_of_ratio(**material, chi=chi)), "a_max_over_R": rim}


@pytest.mark.parametrize("waves", [330.7, 4.1e3, 6.3e4, 4.9e5])
@pytest.mark.parametrize("name", SHAPES)
def test_many_waves(name: str, waves: float) -> None:
    """At the rim, and about the lowest trough, wherever the phase is."""
    shape = SHAPES[name]
    rng = np.random.default_rng(int(waves) % 1000)
    for ratio in (0.05, 30.0):
        scene = _scene(shape, waves, ratio, 10.0 ** rng.uniform(-2.0, 0.3), float(rng.choice([0.0, 0.3, 0.8, 1.0])))
        found = solve(scene, NAMES, profile=_profile(shape))
        force, radius = (float(found[name]) for name in NAMES)
        assert (radius > 0.99 * scene["a_max_over_R"]) == (ratio < 1.0)
        expected = pull_off_force(scene, shape, radius)
        assert abs(force - float(expected)) <= 1e-12 * max(1.0, waves / 1000.0) * float(expected), scene
        for other in (0.8, 1.25):  # some waves away
            if other * radius < scene["a_max_over_R"]:
                assert pull_off_force(scene, shape, other * radius) < expected
