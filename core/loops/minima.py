"""The minima of the misfit of a loop: several starts refined, and which of them the noise allows."""

import math
from operator import attrgetter
from typing import Any, Final

import numpy as np
from scipy.special import chdtri

from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import WAVELENGTHS
from gradhesion.core.types import Floats

COST: Final = attrgetter("cost")
_FEW: Final = 300  # largest number of points by which starts are refined
_WHOLE: Final = 4  # how many of the starts that fit some of the points best are refined by all points
_ALLOWED: Final = 0.95  # quantile of the rise of chi square: the noise allows other minima below it
_WAVES: Final = (-1.0, -0.5, 0.5, 1.0)  # differences of the number of waves within the contact that are tried
_HOPELESS: Final = 25.0
"""Half the sum of squares of some of the points by which a minimum may be worse than one that leaves only noise."""
_VALLEY: Final = 3.0
"""Standard deviations of the least certain combination by which a smooth fit is begun anew on both sides."""
_FEWEST: Final = 0.2  # least number of waves that is tried
_HOPS: Final = 5  # most rounds in which these are tried
_BETTER: Final = 1e-6  # relative difference of sums of squares, below which two minima are the same
_APART: Final = 9.0, 4.0
"""Another minimum is further away, in squared standard deviations, than the first, and than the second times the rise
of chi square; two places in one valley are not."""


def minima(misfit: Misfit, begun: list[Floats]) -> list[Any]:
    """Refine starts, by some of the points and then the best of them by all; the best minimum first.

    Minima beside the best one are tried too, until none is better: with some waves more or less in the contact, or
    along the valley of a smooth punch.
    """
    few = misfit.thinned(_FEW)

    def best(vectors: list[Floats], count: int) -> list[Any]:
        rough = sorted((few.refined(vector, most=30, tolerance=1e-6) for vector in vectors), key=COST)
        if rough and few.is_noise(rough[0].cost):
            rough = [done for done in rough if done.cost < rough[0].cost + _HOPELESS]
        return [misfit.refined(vector, most=100) for vector in distinct([done.x for done in rough], misfit)[:count]]

    whole = sorted(best(begun, _WHOLE), key=COST)
    for _ in range(_HOPS):
        least = whole[0].cost * (1.0 - _BETTER)
        whole = sorted([*whole, *best(_beside(misfit, whole[0].x), 2)], key=COST)
        if not whole[0].cost < least:
            break
    return whole


def distinct(vectors: list[Floats], misfit: Misfit, near: float = 1e-3) -> list[Floats]:
    """Return those of some vectors that are not near an earlier one: a part of the ranges in every number."""
    kept: list[Floats] = []
    for vector in vectors:
        if all(np.max(np.abs(vector - other) / (misfit.high - misfit.low)) > near for other in kept):
            kept.append(vector)
    return kept


def _beside(misfit: Misfit, vector: Floats) -> list[Floats]:
    """Return where minima may lie beside one: with some waves more or less in the contact, or along the valley."""
    i, path = misfit.model.place_of(WAVELENGTHS), misfit.nearest(vector).drawn
    if path is None or misfit.model.rate is not None:
        return []
    if i is None or not misfit.model.has_waves:  # a jump between two points may be nearer to either of them
        widths = misfit.high - misfit.low
        _, singular, rows = np.linalg.svd(misfit.jacobian(vector) * widths, full_matrices=False)
        step = _VALLEY / max(singular[-1], 1e-300) * rows[-1] * widths
        return [np.clip(vector + sign * step, misfit.low, misfit.high) for sign in (-1.0, 1.0)]
    waves = float(path.radius.max()) / (path.scene.wavelength * path.scene.R)
    step = np.eye(vector.size)[i]
    moved = [vector - step * math.log((waves + more) / waves) for more in _WAVES if waves + more > _FEWEST]
    return [other for other in moved if misfit.low[i] < other[i] < misfit.high[i]]


def others(found: list[Any], covariance: Floats, unit: float) -> list[Any]:
    """Return the minima after the first that noise allows, by the covariance of the first and a residual's variance."""
    best, inverse = found[0], np.linalg.pinv(covariance)
    allowed = float(chdtri(best.x.size, 1.0 - _ALLOWED)) * unit
    kept: list[Any] = []
    for done in found[1:]:
        rise = 2.0 * (done.cost - best.cost)
        least = max(_APART[0], _APART[1] * rise / unit)
        away = [done.x - other.x for other in (best, *kept)]
        if rise <= allowed and all(apart @ inverse @ apart > least for apart in away):
            kept.append(done)
    return kept
