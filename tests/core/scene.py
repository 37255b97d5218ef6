"""Scenes, profiles and patterns in one line each, and the strengths of adhesion and waves in a scene."""

import math
from typing import Any

from gradhesion.core import PARAMETERS, Harmonic, Profile
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

Scene = dict[str, Any]
Waves = tuple[tuple[int, float, float], ...]
"""Rows of a number, a cosine and a sine."""
ENDLESS = {"a_max_over_R": math.inf}


def scene_of(*values: Any, **more: Any) -> Scene:
    """The parameters of `solve`: k, nu, E*, c0, lambda, A and the rim, in this order; and others by name."""
    return dict(zip(PARAMETERS, values, strict=True)) | more


def profile_of(exponent: float, *waves: tuple[int, float, float]) -> Profile:
    return Profile(exponent=exponent, harmonics=tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in waves))


def pattern_of(of: str, *waves: tuple[int, float, float]) -> Toughness:
    return Toughness(tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd in waves), of)


def material_of(scene: Scene) -> float:
    """M."""
    return float(stiffness(*(scene[name] for name in PARAMETERS[:4])))


def adhesion(k: float, M: float) -> float:
    """The strength of adhesion, s."""
    return math.sqrt(2 ** (1 + k) * math.pi / M)


def waviness(k: float, wavelength: float, A: float) -> float:
    """The strength of one cosine, r."""
    return math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * A * wavelength ** ((1 + k) / 2)


def strengths_of(scene: Scene) -> tuple[float, float]:
    """The strengths s and r of a scene."""
    k = scene["k"]
    return adhesion(k, material_of(scene)), waviness(k, scene["lambda_over_R"], scene["A"])


def scene_of_ratio(k: float, M: float, wavelength: float, chi: float, a_max: float) -> Scene:
    """A scene of a stiffness M and of a ratio chi = r/s."""
    nu, c0 = 0.5 if k == 1.0 else 0.27, 0.13
    A = chi * adhesion(k, M) / waviness(k, wavelength, 1.0)
    return scene_of(k, nu, M / float(stiffness(k, nu, 1.0, c0)), c0, wavelength, A, a_max)
