"""Where to start a fit of a smooth punch: contact points over all depths of the data, some works of adhesion with each.

Each has the modulus that gives the largest load. Those with the least misfit are refined on a part of the points.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.search.starts import COARSE, coarse, distinct, is_noise, near_best
from gradhesion.core.types import Floats

_MODULI: Final = ("E_star", "E", "modulus")
_CONTACTS: Final = 12
"""Contact points that are tried, beside the end of the base line."""
_WORKS: Final = 3
"""Works of adhesion that are tried with each."""
_KEPT: Final = 8
"""Starts of a smooth punch that are refined."""
_ROBUST: Final = 4
"""How many of these are also refined with a loss that outliers hardly affect."""


def smooth_starts(misfit: Misfit, load_zero: float, contact: float, seed: int) -> list[Floats]:
    """Return refined starts of a loop whose punch has no waves that are searched, the best first.

    Parameters
    ----------
    misfit
        The loop.
    load_zero, contact
        Load of the base line, and the depth at which it ends (NaN if it has none).
    seed
        Of the Sobol set of the other searched numbers.
    """
    names, few = misfit.names, coarse(misfit, COARSE)
    lows, highs = misfit.low, misfit.high
    depths = np.array([0.0])
    if OFFSETS[0] in names:
        i = names.index(OFFSETS[0])
        shares = (np.arange(_CONTACTS) + 0.5) / _CONTACTS
        depths = np.append(lows[i] + shares * (highs[i] - lows[i]), contact)
        depths = np.clip(depths[np.isfinite(depths)], lows[i], highs[i])
    others = [i for i, name in enumerate(names) if name not in (*OFFSETS, *_MODULI, "work_of_adhesion")]
    drawn = np.empty((1, 0))
    if others:
        from scipy.stats import qmc  # noqa: PLC0415 (it takes longer than most fits)

        drawn = qmc.Sobol(len(others), seed=seed).random(2**6)
    begun = []
    for number, depth in enumerate(np.tile(depths, _WORKS)):
        vector = 0.5 * (lows + highs)
        vector[others] = lows[others] + drawn[number % len(drawn)][: len(others)] * (highs - lows)[others]
        for name, value in ((OFFSETS[0], depth), (OFFSETS[1], load_zero)):
            if name in names:
                vector[names.index(name)] = value
        if "work_of_adhesion" in names:
            i = names.index("work_of_adhesion")
            vector[i] = lows[i] + (number // depths.size + 0.5) / _WORKS * (highs[i] - lows[i])
        begun.append(matched(misfit, vector, load_zero))
    sizes = [misfit.size(vector, few) for vector in begun]
    likely = [i for i in range(len(begun)) if i % depths.size == depths.size - 1] if math.isfinite(contact) else []
    order = [*likely, *(i for i in np.argsort(sizes, kind="stable")[:_KEPT].tolist() if i not in likely)]
    found: list[Floats] = []
    for number, i in enumerate(order):
        found.append(misfit.refined(begun[i], few, most=40, tolerance=1e-6).x)
        if is_noise(misfit, found[-1], few):
            break  # other contact points have a larger misfit
        if number < _ROBUST:
            found.append(misfit.refined(begun[i], few, loss="soft_l1", most=40, tolerance=1e-6).x)
    squares = [float(np.sum(misfit.residual(vector, few) ** 2)) for vector in found]
    return near_best(distinct([found[i] for i in np.argsort(squares, kind="stable")], misfit), misfit)


def held_start(misfit: Misfit, begun: Floats, load_zero: float, contact: float) -> Floats:
    """Return a start with both zeros from the base line, refined in everything else."""
    vector, held = begun.copy(), []
    for name, value in ((OFFSETS[0], contact), (OFFSETS[1], load_zero)):
        if name in misfit.names and math.isfinite(value):
            held.append(misfit.names.index(name))
            vector[held[-1]] = value
    vector = np.clip(vector, misfit.low, misfit.high)
    found: Floats = misfit.refined(
        matched(misfit, vector, load_zero), coarse(misfit, COARSE), loss="soft_l1", most=40, held=held, tolerance=1e-6
    ).x
    return found


def matched(misfit: Misfit, vector: Floats, load_zero: float) -> Floats:
    """Return a vector with the modulus at which contact without adhesion has the largest load of the data."""
    name = next((name for name in _MODULI if name in misfit.names), None)
    if name is None:
        return vector
    i, model = misfit.names.index(name), misfit.model
    scene = model.scenes(vector[None]).one
    depth = float(vector[misfit.names.index(OFFSETS[0])]) if OFFSETS[0] in misfit.names else 0.0
    at = int(np.argmax(misfit.points[:, 0]))
    deepest, load = misfit.points[at] * misfit.scale
    place = (max(float(deepest) - depth, 0.0) / scene.rise) ** (1.0 / model.profile.exponent)
    if place > 0.0:
        m, power = model.profile.exponent, 1.0 + scene.k
        pressed = scene.rise * place**m * scene.disc * place**power * m / (power + m)
        ratio = (float(load) - load_zero) / pressed
        if ratio > 0.0:
            vector[i] = np.clip(vector[i] + math.log(ratio), misfit.low[i], misfit.high[i])
    return vector
