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
from scipy.optimize import least_squares
from scipy.stats import qmc, t
from threadpoolctl import threadpool_limits

from gradhesion.core.curves.draw import draw_curves
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.sweep import solve
from gradhesion.core.variables.reduced import parameters_from

_Array = NDArray[np.float64]

OFFSETS: Final = ("indentation_offset", "load_offset")
"""What is added to the depth and the load of the path."""
ONE_NUMBER: Final = ("E_star", "E", "modulus", "c0", "c0_over_R", "nu")
"""What acts on a loop through M = theta(k, nu) E*/c0^k alone."""
_LINEAR: Final = ("k", "nu")
"""Parameters that are searched as they are; all others by their logarithm."""
_MANY: Final = 32
"""Combinations whose force and last depth are found for one whose path is drawn."""
_COARSE: Final = 60
"""Points that candidates are compared with."""
_FEW: Final = 300
"""Points that starts are refined by, at most."""
_STEP: Final = 4e-3
"""Of the differences for the Jacobian: the path is drawn by chords that are off by 2e-4 of its span."""
_CHORD: Final = 1e-4
"""Standard deviation of the chords, in parts of the spans: it adds to the noise."""
_SINGULAR: Final = 3e-4
"""Of singular values over the largest: below it a combination of parameters has no effect but that of chords."""
_LOST: Final = 1e3
"""Distance, in standard deviations, of points of a scene that has no path."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FittedLoop:
    """What a loop says.

    Attributes
    ----------
    names
        The free parameters in their order, then `OFFSETS` if these are fitted.
    values, standard_deviations, low, high
        By name; low and high bound the 95 % interval of the linear problem (of its logarithm where that is searched).
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
    candidates: int = 512,
    starts: int = 8,
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
    noise
        Standard deviations of depth (m) and load (N) of a point, both > 0. That of the chords by which the path is
        drawn, 1e-4 of the spans, is added.
    offsets
        Whether the zeros of depth and load are fitted too; they are taken to be right to a tenth of the spans.
    profile
        The shape of the punch, a paraboloid with one cosine wave if not given.
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
        For too few points, no points of loading or unloading, ranges or noise out of range, or where no candidate has a
        path.

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
    points = np.column_stack([np.asarray(indentation, dtype=float).ravel(), np.asarray(load, dtype=float).ravel()])
    back = np.asarray(unloading, dtype=bool).ravel()
    names = tuple(free)
    unknown = len(names) + 2 * offsets
    if points.shape[0] != back.size or not np.isfinite(points).all():
        raise ValueError("depths, loads and unloading are lists of one length, of finite numbers")
    if points.shape[0] <= unknown:
        raise ValueError(f"{points.shape[0]} points cannot give {unknown} numbers; measure more or fix some")
    if back.all() or not back.any():
        missing = "loading" if back.all() else "unloading"
        raise ValueError(f"the loop has no points of {missing}; a fit needs both ways")
    if not (noise[0] > 0.0 and noise[1] > 0.0):
        raise ValueError(f"noise = {noise}: both standard deviations are above 0")
    for name, (low, high) in free.items():
        if not low < high or (name not in _LINEAR and not low > 0.0):
            raise ValueError(f"{name}: the ends {low:g} and {high:g} of a range rise, and are above 0 but for k and nu")
    through_stiffness = [name for name in names if name in ONE_NUMBER]
    if len(through_stiffness) > 1:
        raise CannotTellApartError(through_stiffness)
    fit = _Loop(points, back, dict(fixed), dict(free), noise, profile or Profile(), offsets=offsets)
    with threadpool_limits(1):  # matrices of a few columns: threads only wait for each other
        return fit.found(candidates, starts, seed)


class _Loop:
    """The points of a loop in units of their noise, and the search."""

    def __init__(
        self,
        points: _Array,
        back: NDArray[np.bool_],
        fixed: dict[str, float],
        free: dict[str, tuple[float, float]],
        noise: tuple[float, float],
        profile: Profile,
        *,
        offsets: bool,
    ) -> None:
        self.scale = np.hypot(noise, _CHORD * np.ptp(points, axis=0))
        self.points, self.back = points / self.scale, back
        self.fixed, self.profile = fixed, profile
        self.names = (*free, *(OFFSETS if offsets else ()))
        self.span = np.ptp(points, axis=0)
        ends = [free[name] if name in _LINEAR else tuple(np.log(free[name])) for name in free]
        ends += [(-0.1 * size, 0.1 * size) for size in self.span] if offsets else []
        self.low, self.high = np.array(ends).T
        self.deepest = float(points[:, 0].max())
        self.first = float(points[:, 0].min() - self.span[0])

    def values(self, vector: _Array) -> dict[str, float]:
        """Give what is searched its names and units."""
        return {
            name: float(value if name in (*_LINEAR, *OFFSETS) else math.exp(value))
            for name, value in zip(self.names, vector, strict=True)
        }

    def path(self, vector: _Array) -> tuple[_Array, _Array] | None:
        """Draw loading and unloading, in m and N; None where the scene has no path."""
        own = self.values(vector)
        shift = np.array([own.pop(name, 0.0) for name in OFFSETS])
        given = self._given(own)
        made = {name: float(value) for name, value in parameters_from(given).items()}
        R, work = given["R"], given["work_of_adhesion"]
        scene = {name: made[name] for name in PARAMETERS}
        scene["indentation_max_over_R"] = (self.deepest - shift[0]) / R
        drawn, _ = draw_curves(scene, ["path"], self.profile)
        places = np.column_stack([R * drawn["path_indentation"], 1.5 * math.pi * R * work * drawn["path_load"]]) + shift
        if not np.isfinite(places).all() or places.shape[0] < 2:
            return None
        last = int(np.count_nonzero(drawn["path_unloading"] == 0))
        far = np.array([[self.first, shift[1]]])
        zero = np.array([[places[0, 0], shift[1]]])
        return np.concatenate([far, zero, places[:last]]), np.concatenate([places[max(0, last - 1) :], far])

    def residual(self, vector: _Array, use: slice = slice(None)) -> _Array:
        """Return the signed distances of points to the path."""
        points, back = self.points[use], self.back[use]
        drawn = self.path(vector)
        if drawn is None:
            return np.full(points.shape[0], _LOST)
        found = np.empty(points.shape[0])
        for chain, own in zip(drawn, (~back, back), strict=True):
            found[own] = distances(points[own], chain / self.scale)
        return found

    def found(self, candidates: int, starts: int, seed: int) -> FittedLoop:
        """Compare candidates, refine the best, and describe the least."""
        drawn = qmc.Sobol(self.low.size, seed=seed).random(_MANY * candidates)
        middle = len(self.names) - (2 if self.names[-1] == OFFSETS[-1] else 0)
        drawn[:, middle:] = 0.5  # offsets are searched later
        vectors = self.low + drawn * (self.high - self.low)
        vectors = vectors[np.argsort(self._apart(vectors), kind="stable")[:candidates]]
        count = self.points.shape[0]
        coarse, few = (slice(None, None, max(1, count // most)) for most in (_COARSE, _FEW))
        sizes = np.array([np.sum(np.log1p(self.residual(vector, coarse) ** 2)) for vector in vectors])
        order = np.argsort(sizes)
        if sizes[order[0]] >= np.log1p(_LOST**2) * self.points[coarse].shape[0]:
            raise ValueError("no combination within the ranges has a path; widen them")
        refined = [self._refined(vectors[i], few, "soft_l1", 40) for i in order[:starts]]
        best = min(refined, key=lambda done: float(np.sum(self.residual(done.x, few) ** 2)))
        done = self._refined(best.x, slice(None), "linear", 60)
        return self._described(done)

    def _apart(self, vectors: _Array) -> _Array:
        """Return how far force and depth of the last contact are from those of the data, in parts of the spans."""
        columns = {name: np.exp(row) if name not in (*_LINEAR, *OFFSETS) else row
                   for name, row in zip(self.names, vectors.T, strict=True)}  # fmt: skip
        given = self._given({name: row for name, row in columns.items() if name not in OFFSETS})
        made = parameters_from(given)
        R, work = given["R"], given["work_of_adhesion"]
        scenes = {name: made[name] for name in PARAMETERS}
        wanted = ("pull_off_force", "delta_jump_out")
        found = solve(scenes, wanted, check_contact=False, profile=self.profile)
        depth, load = (self.points * self.scale).T
        pulled = self.back & (load < 0.1 * load.min())
        last = float(depth[pulled].min()) if pulled.any() else float(depth.min())
        force, out = 1.5 * math.pi * R * work * found["pull_off_force"], R * found["delta_jump_out"]
        size = ((force + load.min()) / self.span[1]) ** 2 + ((out - last) / self.span[0]) ** 2
        return np.where(np.isfinite(size), size, np.inf)

    def _given(self, own: Mapping[str, Any]) -> dict[str, Any]:
        """Put what is searched beside what is fixed, and what has no effect in the place of what is left out."""
        given = {"a_max_over_R": math.inf, "c0_over_R": 1.0, "lambda_over_R": 1.0} | self.fixed | dict(own)
        for name, other in (("a_max", "a_max_over_R"), ("c0", "c0_over_R"), ("wavelength", "lambda_over_R")):
            if name in given:
                given.pop(other, None)
        return given

    def _refined(self, start: _Array, use: slice, loss: str, most: int) -> Any:
        """Refine a start within the ranges."""
        width = self.high - self.low
        inner = np.clip(start, self.low + 1e-6 * width, self.high - 1e-6 * width)
        return least_squares(
            lambda vector: self.residual(vector, use),
            inner,
            jac=lambda vector: self._jacobian(vector, use),
            bounds=(self.low, self.high),
            x_scale=width,
            loss=loss,
            xtol=1e-7,
            ftol=1e-7,
            max_nfev=most,
        )

    def _steps(self) -> _Array:
        """Return the steps of differences: of offsets in parts of the span, of the others in parts of themselves."""
        steps = np.full(self.low.size, _STEP)
        if self.names[-1] == OFFSETS[-1]:
            steps[-2:] = _STEP * self.span
        return steps

    def _jacobian(self, vector: _Array, use: slice = slice(None)) -> _Array:
        """Return the derivatives of the distances, by central differences within the ranges."""
        columns = []
        for i, step in enumerate(self._steps()):
            ends = []
            for sign in (1.0, -1.0):
                moved = vector.copy()
                moved[i] = np.clip(moved[i] + sign * step, self.low[i], self.high[i])
                ends.append((self.residual(moved, use), moved[i]))
            (above, at_high), (below, at_low) = ends
            columns.append((above - below) / (at_high - at_low))
        return np.column_stack(columns)

    def _described(self, done: Any) -> FittedLoop:
        """Describe a minimum."""
        residual = self.residual(done.x)
        jacobian = self._jacobian(done.x) * self._steps()
        lengths = np.linalg.norm(jacobian, axis=0)
        free = len(self.names) - (2 if self.names[-1] == OFFSETS[-1] else 0)
        without = [self.names[i] for i in range(free) if lengths[i] < 1e-6 * lengths.max()]
        if without:
            raise ValueError(
                f"{' and '.join(without)}: without effect on this loop; fix {'it' if len(without) == 1 else 'them'}"
            )
        _, sizes, rows = np.linalg.svd(jacobian / lengths)
        if sizes[-1] < _SINGULAR * sizes[0]:
            weights = np.abs(rows[-1])
            raise CannotTellApartError([name for name, w in zip(self.names, weights, strict=True) if w > 0.2])
        degrees = residual.size - len(self.names)
        covariance = np.linalg.inv((jacobian / self._steps()).T @ (jacobian / self._steps()))
        covariance *= max(1.0, float(residual @ residual) / degrees)  # noise may be larger than it was said to be
        spread = np.sqrt(np.diag(covariance))
        values, factor = self.values(done.x), float(t.ppf(0.975, degrees))
        low, high = self.values(done.x - factor * spread), self.values(done.x + factor * spread)
        sizes_of = {name: 1.0 if name in (*_LINEAR, *OFFSETS) else values[name] for name in self.names}
        width = self.high - self.low
        at_end = (done.x - self.low < 1e-4 * width) | (self.high - done.x < 1e-4 * width)
        path = self.path(done.x)
        assert path is not None  # noqa: S101 (tells the types what holds: it has a finite residual)
        return FittedLoop(
            names=self.names,
            values=values,
            standard_deviations={
                name: float(size * sd) for (name, size), sd in zip(sizes_of.items(), spread, strict=True)
            },
            low=low,
            high=high,
            correlation=covariance / np.outer(spread, spread),
            on_bound=tuple(name for name, end in zip(self.names, at_end, strict=True) if end),
            chi_square=float(residual @ residual),
            degrees_of_freedom=degrees,
            residual=residual,
            loading=path[0],
            unloading=path[1],
            converged=bool(done.status > 0),
        )


def distances(points: _Array, chain: _Array) -> _Array:
    """Return the signed distance of points to a connected curve, positive on the left of its nearest piece.

    Parameters
    ----------
    points
        Rows of x and y.
    chain
        The vertices in order, rows of x and y.

    Examples
    --------
    >>> distances(np.array([[0.5, 1.0], [0.5, -2.0], [3.0, 0.0]]), np.array([[0.0, 0.0], [1.0, 0.0]])).tolist()
    [1.0, -2.0, 2.0]
    """
    start, run = chain[:-1], np.diff(chain, axis=0)
    length = np.maximum(np.sum(run**2, axis=1), np.finfo(float).tiny)
    away = points[:, None, :] - start
    along = np.clip(np.einsum("ijk,jk->ij", away, run) / length, 0.0, 1.0)
    left = away - along[..., None] * run
    size = np.sum(left**2, axis=-1)
    nearest = np.argmin(size, axis=1)
    rows = np.arange(points.shape[0])
    unit = run / np.sqrt(length)[:, None]
    share, ahead, behind = along[rows, nearest], np.minimum(nearest + 1, len(run) - 1), np.maximum(nearest - 1, 0)
    way = unit[nearest] + np.where(
        (share == 1.0)[:, None], unit[ahead], np.where((share == 0.0)[:, None], unit[behind], 0.0)
    )
    beyond = left[rows, nearest]  # of a corner the side is that of both its pieces
    cross = way[:, 0] * beyond[:, 1] - way[:, 1] * beyond[:, 0]
    found: _Array = np.where(cross < 0.0, -1.0, 1.0) * np.sqrt(size[rows, nearest])
    return found
