"""Optima of several searched inputs: basins are refined one after the other.

By SciPy's L-BFGS-B with exact slopes, by Nelder and Mead's simplex where that ends on a kink or at the edge of the
feasible region (found by SLSQP), and by the zero of the slopes.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from scipy.optimize import Bounds, minimize, root

from gradhesion.core.answers.optimum_merit import WIDTH, Merit, edge_of, heights_at
from gradhesion.core.types import Floats, Integers

_STEEP: Final = 1e-9
"""A slope over the size of the merit, below which a place is stationary."""


def refine_many(
    merit: Merit, heights: Floats, basins: tuple[Integers, ...], promised: Floats, *, constrained: bool
) -> tuple[Floats, Floats]:
    """Refine the basins of several searched inputs, one after the other; of a cell the highest first.

    Those whose bound is below an optimum already found are not refined.
    """
    *indices, cells = basins
    spacing = 1.0 / (heights.shape[0] - 1)
    starts = spacing * np.array(indices, dtype=float)
    places, found = starts.copy(), heights[basins].copy()
    best = np.full(heights.shape[-1], -np.inf)
    for number in np.argsort(-found, kind="stable"):
        cell = cells[number]
        if promised[number] < best[cell]:
            continue
        start = starts[:, number]
        places[:, number], found[number] = _refined(merit, start, np.array(cell), spacing, constrained=constrained)
        best[cell] = max(best[cell], found[number])
    return places, found


def _refined(merit: Merit, start: Floats, cell: Integers, spacing: float, *, constrained: bool) -> tuple[Floats, float]:
    """Refine a basin of several inputs within two spacings of its highest point; return place (inputs,) and merit."""
    low, high = np.maximum(start - 2.0 * spacing, 0.0), np.minimum(start + 2.0 * spacing, 1.0)
    bounds = Bounds(low, high)

    def height(place: Floats) -> float:
        """Return the value to be minimised: infinite where a requirement is not met."""
        return -float(heights_at(merit, np.clip(place, low, high), cell))

    def downwards(place: Floats) -> Floats:
        slopes = merit.slopes(np.clip(place, low, high), cell)
        assert slopes is not None  # noqa: S101 (they are known)
        return -np.asarray(slopes, dtype=float)

    slopes = downwards if merit.slopes(start, cell) is not None else None
    options: dict[str, Any]
    if constrained:
        best = _along_the_edge(merit, cell, height, slopes, start, bounds)
        value = height(best)
    else:
        best, value = start, height(start)
        options = {"ftol": 0.0, "gtol": 1e-13 * abs(value), "maxiter": 200, "maxls": 40}
        one = minimize(height, best, method="L-BFGS-B", jac=slopes, bounds=bounds, options=options)
        if (lower := height(one.x)) < value:
            best, value = one.x, lower
        if slopes is not None and _is_stationary(slopes(best), best, low, high, abs(value)):
            return _to_zero_slopes(slopes, height, best, value)
    for size in (0.25, 0.02):  # a simplex may collapse on a ridge: another one starts there
        corner = np.clip(best + size * spacing, low, high)
        corner = np.where(corner == best, np.clip(best - size * spacing, low, high), corner)
        simplex = np.vstack([best, np.where(np.eye(best.size, dtype=bool), corner, best)])
        options = {"xatol": WIDTH, "fatol": 1e-15 * abs(value), "maxiter": 400, "initial_simplex": simplex}
        one = minimize(height, best, method="Nelder-Mead", bounds=bounds, options=options)
        gain = value - (lower := height(one.x))
        if not gain > 0.0:
            break
        best, value = one.x, lower
        if gain <= 1e-13 * abs(value):
            break
    return best, -value


def _along_the_edge(
    merit: Merit,
    cell: Integers,
    height: Callable[[Floats], float],
    slopes: Callable[[Floats], Floats] | None,
    best: Floats,
    bounds: Bounds,
) -> Floats:
    """Move a feasible place (inputs,) to a better feasible one, by steps that assume smoothness."""

    def plain(place: Floats) -> float:
        merits, _ = merit.values(place, cell)
        return -float(np.nan_to_num(merits, nan=-np.inf))

    def margin(place: Floats) -> float:
        _, margins = merit.values(place, cell)
        return float(np.maximum(margins, -1e30))

    limit = [{"type": "ineq", "fun": margin}]
    options: dict[str, Any] = {"ftol": 1e-15, "maxiter": 100}
    with np.errstate(all="ignore"):
        one = minimize(plain, best, method="SLSQP", jac=slopes, bounds=bounds, constraints=limit, options=options)
    there = np.clip(one.x, bounds.lb, bounds.ub)
    if not np.isfinite(there).all():
        return best
    if not np.isfinite(height(there)):  # by a rounding beyond the edge, or on the wrong side

        def along(share: Any) -> Any:
            inner = best[:, None] + np.atleast_1d(share) * (there - best)[:, None]
            return heights_at(merit, inner, np.broadcast_to(cell, inner.shape[1:])).reshape(np.shape(share))

        there = best + edge_of(along, 0.0, 1.0, (), 2.0**-52) * (there - best)
    return there if height(there) < height(best) else best


def _is_stationary(slopes: Floats, place: Floats, low: Floats, high: Floats, size: float) -> bool:
    """Report whether all slopes are zero, but for those towards an end of the range."""
    at_end = ((place <= low) & (slopes > 0.0)) | ((place >= high) & (slopes < 0.0))
    inner_edge = at_end & (place > 0.0) & (place < 1.0)
    return bool(np.all((np.abs(slopes) <= 1e3 * _STEEP * size) | at_end) and not inner_edge.any())


def _to_zero_slopes(
    downwards: Callable[[Floats], Floats], height: Callable[[Floats], float], best: Floats, value: float
) -> tuple[Floats, float]:
    """Move a smooth peak to the zero of its slopes; an input at the end of its range stays there."""
    free = (best > 0.0) & (best < 1.0)
    if not free.any():
        return best, -value

    def slopes(inner: Floats) -> Floats:
        place = best.copy()
        place[free] = inner
        return downwards(place)[free]

    found = root(slopes, best[free], method="hybr", options={"xtol": 1e-14})
    moved = best.copy()
    moved[free] = np.clip(found.x, 0.0, 1.0)
    lower, near = height(moved), np.all(np.abs(moved - best) < 1e-4)
    if near and lower <= value + 2.0**-48 * abs(value):
        return moved, -min(value, lower)
    return best, -value
