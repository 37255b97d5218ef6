"""Hostile scenes: log-uniform draws over the whole of the numbers that a study may hold, and draws where much happens."""

import math
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core import PARAMETERS
from gradhesion.core.problem.material import stiffness

Scenes: TypeAlias = dict[str, NDArray[np.float64]]

EXPONENTS: Final = (0.0, 1e-16, 1e-12, 1e-6, 0.5, 1 - 1e-6, 1 - 1e-12, 1 - 2.0**-53, 1.0)
"""Exponents in every draw, beside random ones; each has a table of its own."""
POOL: Final = 40


def log_uniform(rng: np.random.Generator, low: float, high: float, size: int) -> NDArray[np.float64]:
    values: NDArray[np.float64] = 10.0 ** rng.uniform(math.log10(low), math.log10(high), size)
    return values


def _materials(rng: np.random.Generator, size: int) -> Scenes:
    pool = np.concatenate([EXPONENTS, rng.uniform(0, 1, POOL - len(EXPONENTS))])
    k = rng.choice(pool, size)
    nu = rng.choice([0.5, -0.99, 0.0, 0.3, math.nan], size)
    nu = np.where(np.isnan(nu), rng.uniform(-0.99, 0.5, size), nu)
    return {
        "k": k,
        "nu": np.where(k == 1.0, 0.5, nu),
        "modulus": log_uniform(rng, 1e-9, 1e15, size),
        "c0_over_R": log_uniform(rng, 1e-12, 1e9, size),
    }


def groups(scenes: Scenes) -> dict[str, NDArray[np.float64]]:
    """Give L, chi = r/s and the waves up to which folds may stand (section 6 of docs/theory.md)."""
    k = scenes["k"]
    m = stiffness(k, scenes["nu"], scenes["modulus"], scenes["c0_over_R"])
    wavelength = scenes["lambda_over_R"]
    n = 0.5 * (1 + k)
    with np.errstate(all="ignore"):
        s = np.sqrt(2 ** (1 + k) * np.pi / m)
        gamma = np.array([math.gamma(value) for value in n])
        chi = np.pi ** (1 - n) * gamma * scenes["A"] * wavelength**n / s
        length = wavelength / (2 * np.pi)
        bend = 2 * length ** (1 + n) / ((1 + k) * s)
        waves = ((1.35 * chi + 0.5 * (1 - k)) / bend) ** (1 / n) / (2 * np.pi)
        loading = ((1 + k) * s) ** (2 / (3 + k))
    return {"L": m ** (-1 / (3 + k)), "chi": chi, "waves": waves, "jump_in": loading}


def hostile(seed: int, size: int, most_waves: float = math.inf) -> Scenes:
    """Draw every parameter by itself, over twenty and more decades; a tenth is smooth, a tenth unbounded."""
    rng = np.random.default_rng([seed, 1])
    scenes = _materials(rng, size) | {
        "lambda_over_R": log_uniform(rng, 1e-12, 1e6, size),
        "A": np.where(rng.uniform(size=size) < 0.5, *(log_uniform(rng, low, 1e3, size) for low in (1e-300, 1e-9))),
        "a_max_over_R": log_uniform(rng, 1e-12, 1e9, size),
    }
    scenes["A"][rng.uniform(size=size) < 0.1] = 0.0
    scenes["a_max_over_R"][rng.uniform(size=size) < 0.1] = math.inf
    return limited(scenes, most_waves)


def eventful(seed: int, size: int, most_waves: float = math.inf) -> Scenes:
    """Draw the similarity groups around where folds are, on materials over all decades."""
    rng = np.random.default_rng([seed, 2])
    scenes = _materials(rng, size)
    ones = np.ones(size)
    unit = groups(scenes | {"lambda_over_R": ones, "A": ones})["L"]
    scenes["lambda_over_R"] = log_uniform(rng, 1e-4, 1e2, size) * unit
    scenes["A"] = log_uniform(rng, 1e-3, 30, size) / groups(scenes | {"A": ones})["chi"]
    scenes["a_max_over_R"] = log_uniform(rng, 1e-2, 20, size) * unit
    scenes["a_max_over_R"][rng.uniform(size=size) < 0.1] = math.inf
    return limited(scenes, most_waves)


def limited(scenes: Scenes, most_waves: float) -> Scenes:
    with np.errstate(all="ignore"):
        waves = np.minimum(scenes["a_max_over_R"] / scenes["lambda_over_R"], groups(scenes)["waves"])
    return {name: scenes[name][~(waves > most_waves)] for name in PARAMETERS}
