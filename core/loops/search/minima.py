"""The minima of the misfit of a loop: several starts refined, and which of them the noise allows."""

import math
from operator import attrgetter
from typing import Any, Final

import numpy as np
from scipy.special import chdtri

from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import WAVELENGTHS
from gradhesion.core.loops.search.starts import coarse, distinct, is_noise
from gradhesion.core.types import Floats

_COST: Final = attrgetter("cost")
_FEW: Final = 300
"""Largest number of points by which starts are refined."""
_WHOLE: Final = 4
"""How many of the starts that fit some of the points best are refined by all points."""
_ALLOWED: Final = 0.95
"""Quantile of the rise of chi square: the noise allows other minima below it."""
_WAVES: Final = (-1.0, -0.5, 0.5, 1.0)
"""Differences of the number of waves within the contact that are tried."""
_FEWEST: Final = 0.2
"""Least number of waves that is tried."""
_HOPS: Final = 5
"""Most rounds in which these are tried."""
_BETTER: Final = 1e-6
"""Relative difference of sums of squares, below which two minima are the same."""
_APART: Final = 9.0, 4.0
"""Another minimum is further away, in squared standard deviations, than the first, and than the second times the rise
of chi square; two places in one valley are not."""


def refined(misfit: Misfit, begun: list[Floats]) -> list[Any]:
    """Refine starts, by some of the points and then the best of them by all; the best minimum first.

    Where a wavelength is searched, minima with some waves more or less in the contact than the best has are tried too,
    until none is better.
    """
    few = coarse(misfit, _FEW)
    found = sorted((_robust(misfit, start, few) for start in begun), key=_COST)
    whole = _by_all(misfit, distinct([done.x for done in found], misfit)[:_WHOLE])
    for _ in range(_HOPS):
        least = whole[0].cost * (1.0 - _BETTER)
        beside = sorted((_robust(misfit, start, few) for start in _beside(misfit, whole[0].x)), key=_COST)
        whole = sorted([*whole, *_by_all(misfit, [done.x for done in beside[:2]])], key=_COST)
        if not whole[0].cost < least:
            break
    return whole


def _by_all(misfit: Misfit, vectors: list[Floats]) -> list[Any]:
    """Refine vectors by all points, the best first."""
    return sorted((misfit.refined(vector, most=100) for vector in vectors), key=_COST)


def _robust(misfit: Misfit, start: Floats, few: slice) -> Any:
    """Refine a start by some of the points, first with a loss that outliers hardly move, unless only noise is left."""
    if not is_noise(misfit, start, few):
        start = misfit.refined(start, few, loss="soft_l1", most=40, tolerance=1e-6).x
    return misfit.refined(start, few, most=30, tolerance=1e-6)


def _beside(misfit: Misfit, vector: Floats) -> list[Floats]:
    """Return a vector with some waves more or less in the contact; none where the wavelength is not searched."""
    i = misfit.model.place_of(WAVELENGTHS)
    path = misfit.path(vector)
    if i is None or path is None or not misfit.model.has_waves:
        return []
    waves = float(path.radius.max()) / (path.scene.wavelength * path.scene.R)
    step = np.eye(vector.size)[i]
    moved = [vector - step * math.log((waves + more) / waves) for more in _WAVES if waves + more > _FEWEST]
    return [other for other in moved if misfit.low[i] < other[i] < misfit.high[i]]


def polished(fine: Misfit, found: list[Any]) -> list[Any]:
    """Refine the minima that the noise may allow by a finer grid; the best first."""
    allowed = _rise(found[0]) * max(1.0, 2.0 * found[0].cost / fine.back.size)
    near = [done.x for done in found if 2.0 * (done.cost - found[0].cost) <= 2.0 * allowed]
    return _by_all(fine, distinct(near, fine))


def _rise(done: Any) -> float:
    """Return by how much chi square rises from a minimum to what the noise allows."""
    return float(chdtri(done.x.size, 1.0 - _ALLOWED))


def others(found: list[Any], covariance: Floats, unit: float) -> list[Any]:
    """Return the minima other than the first that the noise allows.

    Parameters
    ----------
    found
        Minima, the best first.
    covariance
        Of the best, in the numbers that are searched.
    unit
        The variance of a residual.
    """
    best = found[0]
    allowed = _rise(best) * unit
    inverse = np.linalg.pinv(covariance)
    kept: list[Any] = []
    for done in found[1:]:
        rise = 2.0 * (done.cost - best.cost)
        far = all(
            (away := done.x - other.x) @ inverse @ away > max(_APART[0], _APART[1] * rise / unit)
            for other in (best, *kept)
        )
        if rise <= allowed and far:
            kept.append(done)
    return kept
