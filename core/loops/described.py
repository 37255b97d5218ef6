"""The results at a minimum of the misfit: values, intervals, correlations and warnings."""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from scipy.special import stdtrit

from gradhesion.core.loops.alike import alike
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


def described(
    misfit: Misfit, found: list[Any], intervals: str, ranges: Mapping[str, tuple[float, float]], *, widened: bool
) -> FittedLoop:
    """Describe the first of some minima; where noise was estimated, intervals are `widened` by reduced chi square."""
    done = found[0]
    names, residual = misfit.names, misfit.residual(done.x)
    degrees = residual.size - len(names)
    covariance = covariance_of(misfit, done.x)
    unit = max(1.0, float(residual @ residual) / degrees) if widened else 1.0
    covariance *= unit
    spread = np.sqrt(np.diag(covariance))
    values, factor = misfit.named(done.x), float(stdtrit(degrees, 0.5 * (1.0 + LEVEL)))
    ends = done.x - factor * spread, done.x + factor * spread
    if intervals == "profile":
        pairs = [
            profile_interval(misfit, done.x, i, covariance[i] / spread[i], factor, unit) for i in range(len(names))
        ]
        ends = np.array([pair[0] for pair in pairs]), np.array([pair[1] for pair in pairs])
    low, high = (misfit.named(np.clip(end, misfit.low, misfit.high)) for end in ends)
    path = misfit.path(done.x)
    assert path is not None  # noqa: S101 (asked before)
    allowed = others(found, covariance / unit, unit)
    flags = ANOTHER_MINIMUM if allowed else 0
    if float(residual @ residual) > poor_from(degrees) * degrees:
        flags |= POOR_FIT
    radius = float(path.radius[path.turn]) / path.scene.R
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
        chi_square=float(residual @ residual),
        degrees_of_freedom=degrees,
        residual=residual,
        loading=path.places[: path.turn + 1],
        unloading=path.places[path.turn :],
        converged=bool(done.status > 0),
        status=status_of(misfit.model, done.x, radius) | flags,
        others=tuple(OtherMinimum(values=misfit.named(one.x), chi_square=2.0 * one.cost) for one in allowed),
        alike=alike(misfit.model, path, misfit.scale, spread),
        turning_radius=radius,
        widening=math.sqrt(unit),
    )


def covariance_of(misfit: Misfit, vector: Floats) -> Floats:
    """Return the covariance of the numbers at a minimum, for residuals of variance 1; refuse equal effects."""
    names, jacobian = misfit.names, misfit.jacobian(vector)
    sizes = np.array([high - low for low, high in zip(misfit.low, misfit.high, strict=True)])
    lengths = np.linalg.norm(jacobian * sizes, axis=0)
    without = [name for name, length in zip(names, lengths, strict=True) if length < _WITHOUT * lengths.max()]
    if without:
        raise ValueError(
            f"{' and '.join(without)}: without effect on this loop; fix {'it' if len(without) == 1 else 'them'}"
        )
    unit = lengths / sizes
    _, singular, rows = np.linalg.svd(jacobian / unit, full_matrices=False)
    if singular[-1] < _SINGULAR * singular[0]:
        weights = np.abs(rows[-1])
        raise CannotTellApartError([name for name, weight in zip(names, weights, strict=True) if weight > 0.2])
    inner = (rows.T / singular**2) @ rows
    return np.asarray(inner / np.outer(unit, unit))
