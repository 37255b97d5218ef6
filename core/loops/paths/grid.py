"""The radii at which branches of a loop are searched, and how far they are to reach."""

import math
from typing import Final

import numpy as np

from gradhesion.core.loops.paths.model import Model, Scenes
from gradhesion.core.types import Floats

_A_WAVE: Final = 48
"""Radii of the grid within the shortest wave."""
_SMOOTH: Final = 320
"""Radii of the grid without waves, each a fixed part further out than the last."""
_SMALLEST: Final = 0.02
"""Smallest radius of the grid, in radii at which adhesion outweighs the curvature of the punch."""
_MOST: Final = 400_000
"""Radii of the grid at most."""


def grid_of(model: Model, scene: Scenes, end: float, fineness: int) -> Floats | None:
    """Return the radii of one scene in m up to an end, of shape (n,), `fineness` times as many; None for too many."""
    step, count = model.shortest(scene) / (_A_WAVE * fineness), _SMOOTH * fineness
    if end / step > _MOST:
        return None
    low = min(_SMALLEST * scene.neck, 0.02 * end)
    growth = math.log(end / low) / count
    begin = max(step / growth, low)  # where both kinds of steps are equal
    if begin >= end:
        return low * np.exp(growth * np.arange(count + 1.0))
    inner, outer = math.ceil(math.log(begin / low) / growth), max(7, math.ceil((end - begin) / step))
    near = math.log(begin / low) / max(1, inner) * np.arange(float(inner))
    return np.concatenate([low * np.exp(near), begin + (end - begin) / outer * np.arange(outer + 1.0)])


def reach_of(model: Model, scene: Scenes, target: float, *, by_load: bool) -> float:
    """Return the radius in m of contact without adhesion of one scene at a load in N, or at a depth in m."""
    m, power = model.profile.exponent, 1.0 + scene.k
    swell = 2.0 * scene.A * scene.wavelength * scene.R if model.has_waves else 0.0
    if by_load:
        place = (max(target, 0.0) * (power + m) / (scene.rise * scene.disc * m)) ** (1.0 / (power + m))
    else:
        place = (max(target, 0.0) / scene.rise) ** (1.0 / m)
    return float(scene.R * (place + (swell / scene.rise) ** (1.0 / m)))
