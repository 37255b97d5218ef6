"""Random scenes, drawn in the similarity variables lambda/L, chi = r/s and a_max/L and rounded to a study's doubles."""

import math
from dataclasses import dataclass, field

import numpy as np
from flint import arb

from gradhesion.twin.curve import Curve
from gradhesion.twin.window import window

EDGES = (0.0, 1e-9, 1 - 1e-9, 1.0, 0.5)
"""Exponents in every pool, beside 35 random ones."""


LONGEST = 2000.0
"""Largest phase up to which an unbounded scene may have folds (300 waves); others are drawn again."""


@dataclass(frozen=True)
class Request:
    """A scene to be solved: the set it belongs to, its parameters, and what is special about it."""

    group: str
    parameters: dict[str, float] = field(hash=False)
    note: str = ""


def pool(rng: np.random.Generator) -> list[float]:
    """The exponents of a draw, in order."""
    return sorted([*EDGES, *(float(k) for k in rng.uniform(0, 1, 35))])


def similar(
    k: float, nu: float, modulus: float, c0: float, wavelength: float, chi: float, a_max: float
) -> dict[str, float]:
    """The study's parameters of a scene given by lambda/L, chi and a_max/L (infinite for an unbounded punch)."""
    start = {"k": k, "nu": nu, "modulus": modulus, "c0_over_R": c0, "lambda_over_R": 1.0, "A": 0.0, "a_max_over_R": 1.0}
    curve = Curve(start)
    length = float((1 / curve.modulus) ** (1 / (3 + curve.k)))
    lam = wavelength * length
    unit = arb.pi() ** ((1 - curve.k) / 2) * ((1 + curve.k) / 2).gamma() * arb(lam) ** ((1 + curve.k) / 2)
    return start | {"lambda_over_R": lam, "A": float(chi * curve.adhesion / unit), "a_max_over_R": a_max * length}


def random_scene(rng: np.random.Generator, k: float, *, unbounded: bool = False) -> dict[str, float]:
    """One draw at the exponent k; near k = 1 only nu = 1/2 has a stiffness."""
    nu = 0.5 if k > 1 - 1e-3 else float(rng.uniform(-0.3, 0.5))
    modulus, c0 = 10 ** float(rng.uniform(1, 5)), 10 ** float(rng.uniform(-3, 0))
    wavelength = 0.06 * (2 / 0.06) ** float(rng.uniform(0, 1))
    chi, a_max = float(rng.uniform(0, 1.5)), float(rng.uniform(1, 4))
    return similar(k, nu, modulus, c0, wavelength, chi, math.inf if unbounded else a_max)


def last_phase(parameters: dict[str, float]) -> float:
    """The phase beyond which the curve of a scene surely has no fold."""
    curve = Curve(parameters)
    return float(window(curve, curve.fold)[1])


def draw(seed: int, bounded: int, unbounded: int) -> list[Request]:
    """All random scenes of a seed."""
    rng = np.random.default_rng(seed)
    exponents = pool(rng)
    made = [Request("random", random_scene(rng, exponents[i % len(exponents)])) for i in range(bounded)]
    for i in range(unbounded):
        parameters = random_scene(rng, exponents[i % len(exponents)], unbounded=True)
        while last_phase(parameters) > LONGEST:
            parameters = random_scene(rng, exponents[i % len(exponents)], unbounded=True)
        made.append(Request("unbounded", parameters))
    return made
