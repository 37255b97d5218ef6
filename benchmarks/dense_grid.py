"""The script that people write: Struve functions on a grid of radii, running maximum and minimum of the depth.

Both depth and load come from SciPy on the same grid, points at which it returns NaN are left out, the pull-off force is
the least load, and the energy of the cycle is the trapezoidal integral of load over depth along the path.
"""

import math
from collections.abc import Mapping

import numpy as np
from scipy.special import gamma, struve

from gradhesion.core.problem.material import stiffness


def solve_on_grid(scene: Mapping[str, float], points: int) -> tuple[float, float]:
    """Return pull-off force and dissipated energy, normalised as in a dataset, from a grid of `points` radii."""
    k, wavelength, A, rim = (scene[name] for name in ("k", "lambda_over_R", "A", "a_max_over_R"))
    M = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    K = 2 ** (1 - k) * M / (1 + k)
    a = np.linspace(0, rim, points + 1)[1:]
    z = 2 * np.pi * a / wavelength
    s0 = math.sqrt(math.pi) / 2 * gamma((1 + k) / 2) * (z / 2) ** (-k / 2) * struve(k / 2, z)
    s1 = math.sqrt(math.pi) / 2 * gamma((3 + k) / 2) * (z / 2) ** (-1 - k / 2) * struve(1 + k / 2, z)
    stretch = np.sqrt(2 ** (1 + k) * np.pi * a ** (1 - k) / M)
    depth = a**2 / (1 + k) + 2 * np.pi * A * a * s0 - stretch
    moment = a ** (3 + k) / (3 + k) + 2 * np.pi * A * a ** (2 + k) * s1
    load = K * (a ** (1 + k) * (depth + stretch) - moment - a ** (1 + k) * stretch)
    good = np.isfinite(depth) & np.isfinite(load)
    depth, load = depth[good], load[good]

    loading = np.maximum.accumulate(np.maximum(depth, 0))
    unloading = np.minimum.accumulate(depth[::-1])
    # pinned at the rim, from the last depth of loading down to the curve: linear
    drop = loading[-1] - depth[-1]
    pinned = drop * (load[-1] + K * rim ** (1 + k) * drop / 2)
    energy = np.trapezoid(load, loading) - pinned + np.trapezoid(load[::-1], unloading)
    return -float(load.min()) / (1.5 * math.pi), float(energy)
