"""Parameters from a measured loop of load and depth: least squares on the distance to the path.

The path of a cycle is a connected curve in the plane of depth and load, its jumps straight lines in it, so that the
distance of a measured point to it is continuous in all parameters; the difference of loads at one depth is not. Both
axes are scaled by their noise. Loading begins, and unloading ends, on the line of no load. The path turns where the
data do.

There are many local minima: the scenes of a Sobol set over the searched ranges that have about the force and the depth
of the last contact are compared with some of the points, and several of the best are refined, first with a loss that
outliers hardly move, then by plain least squares (scipy). Standard deviations are those of the linear problem at the
minimum. Parameters that the loop cannot tell apart (E*, c0 and nu act through one number M, docs/theory.md) make its
Jacobian singular and are refused.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.stats import t
from threadpoolctl import threadpool_limits

from gradhesion.core.answers.loop_intervals import profile_interval
from gradhesion.core.answers.loop_misfit import Misfit
from gradhesion.core.answers.loop_path import LINEAR
from gradhesion.core.answers.loop_search import starts_of
from gradhesion.core.problem.profile import Profile

_Array = NDArray[np.float64]

ONE_NUMBER: Final = ("E_star", "E", "modulus", "c0", "c0_over_R", "nu")
"""What acts on a loop through M = theta(k, nu) E*/c0^k alone."""
_FEW: Final = 300
"""Points that starts are refined by, at most."""
_SINGULAR: Final = 3e-4
"""Of singular values over the largest: below it a combination of parameters has no effect but that of chords."""
_SIGMAS: Final = 3.0
"""Of the distribution of chi square: a start that is refined to within is not followed by others."""
INTERVALS: Final = ("linear", "profile")
"""Where intervals come from."""
LEVEL: Final = 0.95
"""What an interval covers."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FittedLoop:
    """The result of a fit to a loop.

    Attributes
    ----------
    names
        The free parameters in their order, then `OFFSETS` if these are fitted.
    values, standard_deviations, low, high
        By name; low and high bound the 95 % interval, of the linear problem (of its logarithm where that is searched)
        or by profile likelihood.
    correlation
        Of all of them, a square in the order of the names.
    on_bound
        The names that ended at an end of their range.
    chi_square, degrees_of_freedom
        The sum of squares of the residual, and the number of points less that of what is fitted.
    residual
        The signed distance of every point to the path, in standard deviations of the noise.
    loading, unloading
        The vertices of the path, offsets included: rows of depth in m and load in N.
    converged
        Whether the last refinement did.
    status
        What `solve` reports of the fitted cycle.
    """

    names: tuple[str, ...]
    values: dict[str, float]
    standard_deviations: dict[str, float]
    low: dict[str, float]
    high: dict[str, float]
    correlation: _Array
    on_bound: tuple[str, ...]
    chi_square: float
    degrees_of_freedom: int
    residual: _Array
    loading: _Array
    unloading: _Array
    converged: bool
    status: int
    turning_radius: float = math.nan
    """The radius a/R at which the fitted cycle turns."""


class CannotTellApartError(ValueError):
    """The free parameters have one effect; `names` has those of them that a loop cannot tell apart."""

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        listed = " and ".join(names) if len(names) < 3 else f"{', '.join(names[:-1])} and {names[-1]}"
        super().__init__(
            f"a loop cannot tell {listed} apart: together they have one effect on it (modulus, c0 and nu act through "
            "one number); fix all but one of them"
        )


def fit_loop(
    indentation: ArrayLike,
    load: ArrayLike,
    unloading: ArrayLike,
    fixed: Mapping[str, float],
    free: Mapping[str, tuple[float, float]],
    *,
    noise: tuple[float, float],
    offsets: bool = True,
    profile: Profile | None = None,
    through_machine: bool = False,
    intervals: str = "linear",
    candidates: int = 512,
    starts: int = 32,
    seed: int = 0,
) -> FittedLoop:
    """Fit parameters to the points of a loop.

    Parameters
    ----------
    indentation, load
        Depth in m and load in N (positive presses) of the points, in any order; of one or several equal cycles.
    unloading
        Whether each point belongs to unloading.
    fixed
        Numbers by name, in SI units: R, E_star (or E), work_of_adhesion, c0, wavelength, A (or amplitude), k, nu and,
        where the rim is met, a_max. What has no effect may be left out, as in a study.
    free
        The ends of the range of each name that is fitted: positive, but for k and nu.
        The cycle turns where the data do, unless indentation_max (m) or preload (N) is given too.
    noise
        Standard deviations of depth (m) and load (N) of a point, both > 0. That of the chords by which the path is
        drawn, 3e-5 of the spans, is added.
    offsets
        Whether the zeros of depth and load are fitted too; they are taken to be right to a tenth of the spans.
    profile
        The shape of the punch, a paraboloid with one cosine wave if not given.
    through_machine
        Whether the depths are those of the far end of a machine, depth + load/spring_constant; then spring_constant in
        N/m is fixed or free.
    intervals
        "linear", those of the linear problem at the minimum, or "profile", by profile likelihoods (loop_intervals.py).
    candidates, starts
        How many combinations over the ranges have their paths compared, the best by force and last depth of 32 times as
        many, and how many of them are refined.
    seed
        Of the Sobol set.

    Returns
    -------
    The fit. Where `converged` is false or `on_bound` has names, it is not to be trusted.

    Raises
    ------
    CannotTellApartError
        Some of the free parameters have one effect.
    ValueError
        For other intervals, too few points, no points of unloading, ranges or noise out of range, or where no
        candidate has a path.

    Examples
    --------
    A smooth ball gives its modulus and work of adhesion back (Johnson, Kendall & Roberts 1971):

    >>> from gradhesion.core import draw_curves
    >>> R, E_star, work = 5e-6, 1e7, 0.03
    >>> scene = dict(k=0.0, nu=0.3, modulus=E_star * R / work, c0_over_R=1.0, lambda_over_R=1.0, A=0.0)
    >>> path = draw_curves(scene | {"a_max_over_R": np.inf, "indentation_max_over_R": 0.03}, ["path"])[0]
    >>> depth, force = R * path["path_indentation"], 1.5 * np.pi * R * work * path["path_load"]
    >>> fixed, free = dict(k=0.0, nu=0.3, A=0.0, R=R), dict(E_star=(1e6, 1e8), work_of_adhesion=(5e-3, 0.2))
    >>> found = fit_loop(depth, force, path["path_unloading"] == 1, fixed, free, noise=(1e-10, 1e-9), candidates=64)
    >>> round(found.values["E_star"] / E_star, 3), round(found.values["work_of_adhesion"] / work, 3)
    (1.0, 1.0)
    """
    if intervals not in INTERVALS:
        raise ValueError(f"intervals = {intervals!r}: they are {' or '.join(INTERVALS)}")
    points = np.column_stack([np.asarray(indentation, dtype=float).ravel(), np.asarray(load, dtype=float).ravel()])
    back = np.asarray(unloading, dtype=bool).ravel()
    _check(points, back, free, noise, unknown=len(free) + 2 * offsets)
    misfit = Misfit(
        points, back, fixed, free, noise, profile or Profile(), offsets=offsets, through_machine=through_machine
    )
    with threadpool_limits(1):  # matrices of a few columns: threads only wait for each other
        few = slice(None, None, max(1, back.size // _FEW))
        done = misfit.refined(_best(misfit, starts_of(misfit, candidates, seed)[:starts], few))
        return _described(misfit, done, intervals)


def _best(misfit: Misfit, begun: _Array, few: slice) -> _Array:
    """Refine starts (n, unknown) by a loss that outliers hardly move, until one leaves no more than the noise."""
    count = misfit.back[few].size
    enough = count * (1.0 + _SIGMAS * math.sqrt(2.0 / count))
    best: _Array = begun[0]
    least = math.inf
    for start in begun:
        found: _Array = misfit.refined(start, few, loss="soft_l1", most=40).x
        size = float(np.sum(misfit.residual(found, few) ** 2))
        if size < least:
            best, least = found, size
        if least < enough:
            break
    return best


def _check(
    points: _Array,
    back: NDArray[np.bool_],
    free: Mapping[str, tuple[float, float]],
    noise: tuple[float, float],
    *,
    unknown: int,
) -> None:
    """Refuse what cannot be fitted: points (n, 2) of depth and load, and whether each unloads, (n,)."""
    if points.shape[0] != back.size or not np.isfinite(points).all():
        raise ValueError("depths, loads and unloading are lists of one length, of finite numbers")
    if points.shape[0] <= unknown:
        raise ValueError(f"{points.shape[0]} points cannot give {unknown} numbers; measure more or fix some")
    if not back.any():
        raise ValueError("the loop has no points of unloading; a fit needs them, with or without those of loading")
    if not (noise[0] > 0.0 and noise[1] > 0.0):
        raise ValueError(f"noise = {noise}: both standard deviations are above 0")
    for name, (low, high) in free.items():
        if not low < high or (name not in LINEAR and not low > 0.0):
            raise ValueError(f"{name}: the ends {low:g} and {high:g} of a range rise, and are above 0 but for k and nu")
    through_stiffness = [name for name in free if name in ONE_NUMBER]
    if len(through_stiffness) > 1:
        raise CannotTellApartError(through_stiffness)


def _described(misfit: Misfit, done: Any, intervals: str) -> FittedLoop:
    """Describe a minimum."""
    names, residual = misfit.names, misfit.residual(done.x)
    sizes = misfit.sizes(done.x)
    jacobian = misfit.jacobian(done.x) * sizes
    lengths = np.linalg.norm(jacobian, axis=0)
    without = [names[i] for i in range(misfit.physical) if lengths[i] < 1e-6 * lengths.max()]
    if without:
        raise ValueError(
            f"{' and '.join(without)}: without effect on this loop; fix {'it' if len(without) == 1 else 'them'}"
        )
    _, singular, rows = np.linalg.svd(jacobian / lengths)
    if singular[-1] < _SINGULAR * singular[0]:
        weights = np.abs(rows[-1])
        raise CannotTellApartError([name for name, w in zip(names, weights, strict=True) if w > 0.2])
    degrees = residual.size - len(names)
    covariance = np.linalg.inv(jacobian.T @ jacobian) * np.outer(sizes, sizes)
    unit = max(1.0, float(residual @ residual) / degrees)  # noise may be larger than it was said to be
    covariance *= unit
    spread = np.sqrt(np.diag(covariance))
    values, factor = misfit.named(done.x), float(t.ppf(0.5 * (1.0 + LEVEL), degrees))
    ends = done.x - factor * spread, done.x + factor * spread
    if intervals == "profile":
        pairs = [
            profile_interval(misfit, done.x, i, covariance[i] / spread[i], factor, unit) for i in range(len(names))
        ]
        ends = np.array([pair[0] for pair in pairs]), np.array([pair[1] for pair in pairs])
    low, high = misfit.named(ends[0]), misfit.named(ends[1])
    by_value = {name: 1.0 if name in LINEAR else values[name] for name in names}
    path = misfit.path(done.x)
    if path is None:
        raise ValueError("the fit ends where the cycle has no path; narrow the ranges")
    return FittedLoop(
        names=names,
        values=values,
        standard_deviations={name: float(by_value[name] * sd) for name, sd in zip(names, spread, strict=True)},
        low=low,
        high=high,
        correlation=covariance / np.outer(spread, spread),
        on_bound=tuple(name for name, end in zip(names, misfit.at_end(done.x), strict=True) if end),
        chi_square=float(residual @ residual),
        degrees_of_freedom=degrees,
        residual=residual,
        loading=path.places[: path.turn + 1],
        unloading=path.places[path.turn :],
        converged=bool(done.status > 0),
        status=misfit.model.status(done.x),
        turning_radius=float(path.radius[path.turn] / misfit.model.given(misfit.model.values(done.x))["R"]),
    )
