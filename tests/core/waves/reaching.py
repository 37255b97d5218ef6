"""Punches without a rim whose waves fold up to a given one."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from gradhesion.core.closed.similarity import amplitude_of_ratio
from gradhesion.core.problem.material import stiffness


def reaching(material: Mapping[str, Any], ratio: Any, waves: Any) -> dict[str, Any]:
    """Give scenes on which folds end at a given wave, about: k, nu, modulus and c0_over_R, chi, and the wave."""
    half = 0.5 * (1.0 + material["k"])
    stretch = np.sqrt(2.0 ** (2.0 * half) * np.pi / stiffness(*material.values()))
    length = (ratio / (2.0 * np.pi * waves) ** half * half * stretch) ** (1.0 / (1.0 + half))
    wavelength = 2.0 * np.pi * length
    amplitude = amplitude_of_ratio(*material.values(), wavelength, ratio)
    return {**material, "lambda_over_R": wavelength, "A": amplitude, "a_max_over_R": np.inf}
