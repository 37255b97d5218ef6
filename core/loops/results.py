"""The results at a minimum of the misfit: values, intervals, correlations and warnings."""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from scipy.special import stdtrit

from gradhesion.core.loops.alternatives import alternatives
from gradhesion.core.loops.fitted import CannotTellApartError, FittedLoop, OtherMinimum, poor_from
from gradhesion.core.loops.intervals import profile_interval
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import LINEAR
from gradhesion.core.loops.report import status_of
from gradhesion.core.loops.search.minima import others
from gradhesion.core.loops.search.ranges import is_on_bound
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT
from gradhesion.core.types import Floats

_SINGULAR: Final = 1e-6
"""Singular value over the largest, below which a combination of parameters has no effect but rounding."""
_WITHOUT: Final = 1e-6
"""Effect of a parameter over the largest, below which it has none."""
LEVEL: Final = 0.95
"""Probability that an interval covers."""


def results_at(
    misfit: Misfit, minima: list[Any], intervals: str, ranges: Mapping[str, tuple[float, float]], *, widened: bool
) -> FittedLoop:
    """Return the results at the first of some minima, the results of `refined`.

    `intervals` is one of those of fit.py; `ranges` are the ends of what is searched, in SI units; where noise was
    estimated, deviations and intervals are `widened` by the root of the reduced chi square.
    """
    best = minima[0].x
    names, residual, path = misfit.names, misfit.residual(best), misfit.path(best)
    assert path is not None  # noqa: S101 (fit.py has refused those without)
    chi_square, degrees = float(residual @ residual), residual.size - len(names)
    unit = max(1.0, chi_square / degrees) if widened else 1.0
    covariance = covariance_of(misfit, best) * unit
    spread = np.sqrt(np.diag(covariance))
    values, factor = misfit.named(best), float(stdtrit(degrees, 0.5 * (1.0 + LEVEL)))
    ends = np.array([best - factor * spread, best + factor * spread])
    if intervals == "profile":
        ways = covariance / spread[:, None]
        ends = np.array([profile_interval(misfit, best, i, way, factor, unit) for i, way in enumerate(ways)]).T
    low, high = (misfit.named(np.clip(end, misfit.low, misfit.high)) for end in ends)
    allowed = others(minima, covariance / unit, unit)
    radius = float(path.radius[path.turn]) / path.scene.R
    status = status_of(misfit.model, best, radius) | (ANOTHER_MINIMUM if allowed else 0)
    return FittedLoop(
        names=names,
        values=values,
        standard_deviations={
            name: float(sd if name in LINEAR else values[name] * sd) for name, sd in zip(names, spread, strict=True)
        },
        low=low,
        high=high,
        ranges=dict(ranges),
        correlation=covariance / np.outer(spread, spread),
        on_bound=tuple(name for name in names if is_on_bound(values[name], ranges[name])),
        chi_square=chi_square,
        degrees_of_freedom=degrees,
        residual=residual,
        loading=path.places[: path.turn + 1],
        unloading=path.places[path.turn :],
        converged=bool(minima[0].status > 0),
        status=status | (POOR_FIT if chi_square > poor_from(degrees) * degrees else 0),
        others=tuple(OtherMinimum(values=misfit.named(one.x), chi_square=2.0 * one.cost) for one in allowed),
        alike=alternatives(misfit.model, path, misfit.scale, spread),
        turning_radius=radius,
        widening=math.sqrt(unit),
    )


def covariance_of(misfit: Misfit, vector: Floats) -> Floats:
    """Return the covariance of the numbers at a minimum, for residuals of variance 1; refuse equal effects."""
    names, jacobian, widths = misfit.names, misfit.jacobian(vector), misfit.high - misfit.low
    lengths = np.linalg.norm(jacobian * widths, axis=0)
    without = [name for name, length in zip(names, lengths, strict=True) if length <= _WITHOUT * lengths.max()]
    if without:
        raise ValueError(
            f"{' and '.join(without)}: without effect on this loop; fix {'it' if len(without) == 1 else 'them'}"
        )
    unit = lengths / widths
    _, singular, rows = np.linalg.svd(jacobian / unit, full_matrices=False)
    if singular[-1] < _SINGULAR * singular[0]:
        weights = np.abs(rows[-1])
        raise CannotTellApartError([name for name, weight in zip(names, weights, strict=True) if weight > 0.2])
    inner = (rows.T / singular**2) @ rows
    return np.asarray(inner / np.outer(unit, unit))
