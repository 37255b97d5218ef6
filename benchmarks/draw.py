"""Scenes to measure."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.special import gamma

from gradhesion.core.problem.material import stiffness

EXPONENTS = (0.0, 0.1, 0.3, 0.5, 0.7, 0.9)
NU, C0 = 0.3, 0.01
Parameters = Mapping[str, Any]


def amplitude(k: Any, modulus: Any, wavelength: Any, r_over_s: Any) -> Any:
    """Return A of a given r/s."""
    s = np.sqrt(2.0 ** (1 + k) * np.pi / stiffness(k, NU, modulus, C0))
    return r_over_s * s / (np.pi ** ((1 - k) / 2) * gamma((1 + k) / 2) * wavelength ** ((1 + k) / 2))


def mixture(number: int, spacing: str) -> Parameters:
    """Draw scenes: lambda/L from 0.06 to 2 (spacing log or linear), r/s from 0 to 1.5, a_max/L from 1 to 4."""
    rng = np.random.default_rng(3)
    k, modulus = rng.choice(EXPONENTS, number), 10 ** rng.uniform(1.5, 4, number)
    length = stiffness(k, NU, modulus, C0) ** (-1 / (3 + k))
    low, high = 0.06, 2.0
    share = rng.random(number)
    wavelength = length * (low * (high / low) ** share if spacing == "log" else low + (high - low) * share)
    return {
        "k": k,
        "nu": NU,
        "modulus": modulus,
        "c0_over_R": C0,
        "lambda_over_R": wavelength,
        "A": amplitude(k, modulus, wavelength, rng.uniform(0, 1.5, number)),
        "a_max_over_R": length * rng.uniform(1, 4, number),
    }


def waves(wavelength: float, r_over_s: float | None, curves: int = 60) -> Parameters:
    """Return nearly equal scenes whose folds persist to the rim at R, with A = 0.02 or a given r/s."""
    near = wavelength * (1 + 1e-3 * np.linspace(0, 1, curves))
    A = 0.02 if r_over_s is None else amplitude(0.3, 500.0, near, r_over_s)
    return {"k": 0.3, "nu": NU, "modulus": 500.0, "c0_over_R": C0, "lambda_over_R": near, "A": A, "a_max_over_R": 1.0}
