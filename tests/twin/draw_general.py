"""Random scenes of any profile and control."""

import math

import numpy as np

from gradhesion.core import Harmonic, Loading, Profile
from gradhesion.core.problem.control import CONTROLS
from gradhesion.twin.general import Shape

EXPONENTS = (0.0, 1e-9, 0.23, 0.5, 0.71, 0.94, 1 - 1e-9, 1.0)
POWERS = (1.0, 1.05, 1.3, 2.0, 3.0, 6.5)


def general_scene(rng: np.random.Generator, most_harmonics: int = 8) -> tuple[dict[str, float], Shape]:
    """Draw a scene; waves may have any sign, and be missing."""
    k = float(rng.choice([*EXPONENTS, rng.random()]))
    m = float(rng.choice(POWERS))
    count = int(rng.integers(1, most_harmonics + 1)) if rng.random() < 0.5 else 1
    numbers = sorted(int(n) for n in rng.choice(np.arange(1, max(12, 2 * count)), count, replace=False))
    harmonics = tuple((n, *(float(rng.choice([0.0, rng.normal() / n])) for _ in range(2))) for n in numbers)
    unbounded = m > 1.6 and rng.random() < 0.15
    scene = {
        "k": k,
        "nu": 0.5 if k > 1 - 1e-3 else float(rng.uniform(-0.5, 0.5)),
        "modulus": 10 ** float(rng.uniform(1, 4)),
        "c0_over_R": 10 ** float(rng.uniform(-2, 0)),
        "lambda_over_R": 10 ** float(rng.uniform(-1.5, 0.3)),
        "A": 10 ** float(rng.uniform(-3.5, -0.5)),
        "a_max_over_R": math.inf if unbounded else 10 ** float(rng.uniform(-1.3, 0.3)),
    }
    control = str(rng.choice(CONTROLS))
    if control == "machine":
        scene["machine_stiffness"] = 10 ** float(rng.uniform(-4, 2))
    return scene, Shape(m, harmonics, control)


def known_to_the_core(shape: Shape) -> dict[str, Profile | Loading]:
    """Give a shape as `solve` of gradhesion.core takes it."""
    waves = tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in shape.harmonics)
    return {
        "profile": Profile(exponent=shape.exponent, harmonics=waves),
        "loading": Loading(control=shape.control),
    }
