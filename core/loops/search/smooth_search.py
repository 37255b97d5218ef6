"""Where to start a fit of a smooth punch: contact points over all depths of the data, some works of adhesion with each.

Each has the modulus that gives the largest load. Those with the least misfit are refined on a part of the points.
"""

import itertools
import math
from typing import Final

import numpy as np

from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.offsets import DEPTH_ZERO, LOAD_ZERO
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.search.starts import COARSE, coarse, distinct, is_noise, near_best, put, shares_of
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
    few, (begun, likely) = coarse(misfit, COARSE), _begun(misfit, load_zero, contact, seed)
    sizes = [misfit.size(vector, few) for vector in begun]
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


def _begun(misfit: Misfit, load_zero: float, contact: float, seed: int) -> tuple[list[Floats], list[int]]:
    """Return starts, and the numbers of those whose contact is at the end of the base line; as of `smooth_starts`."""
    model, lows, highs = misfit.model, misfit.low, misfit.high
    depths, works = np.array([0.0]), np.zeros(_WORKS)
    if (i := model.place_of((DEPTH_ZERO,))) is not None:
        depths = np.append(shares_of(misfit, i, _CONTACTS), contact)
        depths = np.clip(depths[np.isfinite(depths)], lows[i], highs[i])
    if (i := model.place_of(("work_of_adhesion",))) is not None:
        works = shares_of(misfit, i, _WORKS)
    others = [i for i, name in enumerate(misfit.names) if name not in (*OFFSETS, *_MODULI, "work_of_adhesion")]
    drawn = np.empty((1, 0))
    if others:
        from scipy.stats import qmc  # noqa: PLC0415 (it takes longer than most fits)

        drawn = qmc.Sobol(len(others), seed=seed).random(2**6)
    begun = []
    for number, (work, depth) in enumerate(itertools.product(works, depths)):
        vector = 0.5 * (lows + highs)
        vector[others] = lows[others] + drawn[number % len(drawn)] * (highs - lows)[others]
        put(misfit, vector, {DEPTH_ZERO: depth, LOAD_ZERO: load_zero, "work_of_adhesion": work})
        begun.append(matched(misfit, vector, load_zero))
    return begun, [*range(depths.size - 1, len(begun), depths.size)] if math.isfinite(contact) else []


def held_start(misfit: Misfit, begun: Floats, load_zero: float, contact: float) -> Floats:
    """Return a start with both zeros from the base line, refined in everything else."""
    vector, zeros = begun.copy(), {DEPTH_ZERO: contact, LOAD_ZERO: load_zero}
    held = put(misfit, vector, {name: zero for name, zero in zeros.items() if math.isfinite(zero)})
    vector = matched(misfit, np.clip(vector, misfit.low, misfit.high), load_zero)
    found: Floats = misfit.refined(vector, coarse(misfit, COARSE), loss="soft_l1", most=40, held=held, tolerance=1e-6).x
    return found


def matched(misfit: Misfit, vector: Floats, load_zero: float) -> Floats:
    """Return a vector with the modulus at which contact without adhesion has the largest load of the data."""
    model = misfit.model
    i, zero = model.place_of(_MODULI), model.place_of((DEPTH_ZERO,))
    if i is None:
        return vector
    scene = model.scenes(vector[None]).one
    depth = 0.0 if zero is None else float(vector[zero])
    deepest, load = misfit.points[int(np.argmax(misfit.points[:, 0]))] * misfit.scale
    place = (max(float(deepest) - depth, 0.0) / scene.rise) ** (1.0 / model.profile.exponent)
    if place > 0.0:
        m, power = model.profile.exponent, 1.0 + scene.k
        pressed = scene.rise * place**m * scene.disc * place**power * m / (power + m)
        ratio = (float(load) - load_zero) / pressed
        if ratio > 0.0:
            vector[i] = np.clip(vector[i] + math.log(ratio), misfit.low[i], misfit.high[i])
    return vector
