"""The effective path that turns where its depth is the greatest of an exact path, as the paper defines a_am."""

import numpy as np
import xarray
from scipy.optimize import brentq

from figures.curves import Values, values_of
from gradhesion.core.equations import effective, envelopes
from gradhesion.core.problem.material import stiffness

_POINTS = 200


def effective_path(dataset: xarray.Dataset) -> tuple[dict[str, Values], float]:
    """Return contact radius, depth and load along the effective path, and a_am; depths hold the mean height."""
    scene = {name: float(dataset[name].item()) for name in ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A")}
    k, length, amplitude = scene["k"], scene["lambda_over_R"], scene["A"]
    material = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    mean = length * amplitude
    s, r = envelopes.adhesion_strength(k, material), envelopes.waviness_strength(k, length, amplitude)
    (depths,) = values_of(dataset, "path_indentation")
    greatest = float(depths.max())
    start, stop = float(effective.jump_in_radius(k, s, r)), float(effective.jump_out_radius(k, s, r))
    turn = float(brentq(lambda a: float(envelopes.indentation(k, a, s - r, mean)) - greatest, start, 10.0, xtol=1e-14))
    up, down = np.linspace(start, turn, _POINTS), np.linspace(turn, stop, _POINTS)
    radius = np.concatenate([[0.0, 0.0], up, down, [0.0]])
    depth = np.concatenate(
        [
            [0.0, mean],
            envelopes.indentation(k, up, s - r, mean),
            envelopes.indentation(k, down, s + r, mean),
            [float(envelopes.indentation(k, stop, s + r, mean))],
        ]
    )
    load = np.concatenate(
        [[0.0, 0.0], envelopes.load(k, material, up, s - r), envelopes.load(k, material, down, s + r), [0.0]]
    )
    return {"contact_radius": radius, "indentation": depth, "load": load}, turn


EARLY = slice(1 + _POINTS, 3 + _POINTS)
"""The two points of an effective path between which it unloads early."""
