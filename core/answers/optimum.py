"""Optima of a merit over one or more searched inputs, for many cells at once.

The search is global to a stated resolution: a sweep over all searched inputs finds the basins, and each that can hold
the optimum is refined between the neighbours of its highest point. Merits are smooth but for kinks: the refinement of
one input compares values alone (SciPy's `elementwise.find_minimum`, Chandrupatla's method and golden sections), so that
a peak that is a kink is found as well as a smooth one; then the zero of the exact slope, where there is one, gives the
place to all digits. Several inputs are refined by SciPy's L-BFGS-B with exact slopes, by Nelder and Mead's simplex
where that ends on a kink or at the edge of what is feasible, and by the zero of the slopes.

All searched inputs are counted from 0 to 1 over their ranges here.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter
from scipy.optimize import minimize, root
from scipy.optimize.elementwise import find_minimum, find_root

CLOSE: Final = 1e-9
"""By what share of its size a merit is better than another."""
_WIDTH: Final = 1e-12
"""To which a peak is bracketed, over its range."""
_ROUGH: Final = 2.0**-24
"""The same where a zero of the slope is to follow."""
_NEAR: Final = 2.0**-20
"""Where the slopes beside a peak are looked at for its zero."""
_MOST_BASINS: Final = 12
"""That are refined in a cell: those whose neighbours promise the most."""
_BETWEEN: Final = 7
"""Points that are looked at between two of a sweep, where there may be a peak that is higher than the best."""
_STEEP: Final = 1e-9
"""A slope over the size of the merit, below which a place is stationary."""
SCENES: Final = 2**18
"""That are evaluated at a time in a sweep."""

_Array = NDArray[np.float64]


class Merit(Protocol):
    """What is to be as large as possible, of cells that differ in what is not searched."""

    def values(self, places: _Array, cells: NDArray[np.int64]) -> tuple[_Array, _Array]:
        """Return merits, and margins that are not negative where all is met that is required.

        Parameters
        ----------
        places
            Of shape (inputs, *shape), each from 0 to 1.
        cells
            The numbers of the cells; broadcast to `shape`.

        Returns
        -------
        Two arrays of shape `shape`; merits are NaN where there is no value.
        """

    def slopes(self, places: _Array, cells: NDArray[np.int64]) -> _Array | None:
        """Return the slopes of merits to the searched inputs, as `places`; None if they are not known."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Optima:
    """The optimum of each cell."""

    places: _Array
    """From 0 to 1; shape (inputs, cells). NaN where nothing is feasible."""
    merits: _Array
    too_coarse: NDArray[np.bool_]
    """Whether the sweep at the stated resolution, half of that which was made, does not show the basin; nor is it shown
    where a peak was found between the points of the finer one."""


def axis_of(resolution: int) -> _Array:
    """Return the places of a sweep at twice a resolution: those of the resolution are every second.

    Examples
    --------
    >>> axis_of(3).tolist()
    [0.0, 0.25, 0.5, 0.75, 1.0]
    """
    return np.linspace(0.0, 1.0, 2 * resolution - 1)


def sweep(merit: Merit, inputs: int, cells: int, resolution: int) -> tuple[_Array, _Array]:
    """Return merits and margins at all places of `axis_of` for all cells, of shape (*places, cells)."""
    axis = axis_of(resolution)
    shape = (axis.size,) * inputs
    total = axis.size**inputs
    merits, margins = np.empty((total, cells)), np.empty((total, cells))
    step = max(1, SCENES // cells)
    for start in range(0, total, step):
        numbers = np.arange(start, min(total, start + step))
        places = axis[np.array(np.unravel_index(numbers, shape))][..., None]
        merits[numbers], margins[numbers] = merit.values(places, np.arange(cells))
    return merits.reshape(*shape, cells), margins.reshape(*shape, cells)


def optima(merit: Merit, inputs: int, cells: int, resolution: int) -> Optima:
    """Return the optimum of each cell.

    Parameters
    ----------
    merit
        What is to be as large as possible.
    inputs, cells
        How many inputs are searched, in how many cells.
    resolution
        Points of the sweep along each input, 3 or more. A second sweep at twice that shows basins between them.

    Returns
    -------
    Places to 1e-12 of their ranges where the peak is a kink, or where exact slopes are known; else to some 1e-8, where
    the merit is within rounding of its peak. Peaks narrower than half a spacing may be missed.
    """
    merits, margins = sweep(merit, inputs, cells, resolution)
    return optima_of(merit, merits, margins)


def optima_of(merit: Merit, merits: _Array, margins: _Array) -> Optima:
    """Return the optima from a sweep that is made."""
    inputs, cells = merits.ndim - 1, merits.shape[-1]
    heights = np.where((margins >= 0.0) & ~np.isnan(merits), merits, -np.inf)
    basins, promised = _basins(heights)
    if inputs == 1:
        places, found = _refine_one(merit, heights, basins)
    else:
        places, found = _refine_many(merit, heights, basins, promised, constrained=bool((margins < 0.0).any()))
    best = np.full(cells, -np.inf)
    where = np.full((inputs, cells), np.nan)
    for number in np.argsort(found, kind="stable"):  # the best of a cell last
        cell = basins[-1][number]
        if np.isfinite(found[number]):
            best[cell], where[:, cell] = found[number], places[:, number]
    too_coarse = _is_new(heights, where)
    if inputs == 1:
        for cell, place, height in zip(*_between(merit, heights, best), strict=True):
            if height > best[cell] + CLOSE * abs(best[cell]):
                best[cell], where[0, cell], too_coarse[cell] = height, place, True
    best = np.where(np.isfinite(best), best, np.nan)
    return Optima(places=where, merits=best, too_coarse=too_coarse)


def _between(merit: Merit, heights: _Array, best: _Array) -> tuple[NDArray[np.int64], _Array, _Array]:
    """Look for peaks between two points of a sweep, where a line through the points beside them leads above the best.

    Returns
    -------
    Cells, places and merits of the peaks that are higher, refined.
    """
    with np.errstate(invalid="ignore"):  # beside what is not feasible
        rise = np.diff(heights, axis=0, prepend=heights[:1], append=heights[-1:])
        upwards = np.nan_to_num(np.maximum(rise[:-1], 0.0), posinf=0.0)
        downwards = np.nan_to_num(np.maximum(-rise[1:], 0.0), posinf=0.0)
        promised = np.maximum((heights + upwards)[:-1], (heights + downwards)[1:])
    index, cells = np.nonzero((promised >= best) & np.isfinite(heights[:-1]) & np.isfinite(heights[1:]))
    spacing = 1.0 / (heights.shape[0] - 1)
    inner = np.linspace(0.0, 1.0, _BETWEEN + 2)
    places = spacing * (index + inner[:, None])
    merits, margins = merit.values(places[None], cells)
    merits = np.where((margins >= 0.0) & ~np.isnan(merits), merits, -np.inf)
    highest = np.clip(np.argmax(merits, axis=0), 1, _BETWEEN)
    every = np.arange(index.size)
    higher = merits[highest, every] > best[cells] * (1.0 + np.sign(best[cells]) * CLOSE)
    if not higher.any():
        return cells[:0], places[0, :0], merits[0, :0]
    bracket = tuple((places[highest + side, every])[higher] for side in (-1, 0, 1))

    def depth(at: Any, cell: Any) -> Any:
        """Return what is to be least."""
        values, allowed = merit.values(at[None], cell.astype(np.int64))
        return np.where((allowed >= 0.0) & ~np.isnan(values), -values, np.inf)

    with np.errstate(all="ignore"):
        tolerances = {"xatol": _WIDTH, "xrtol": 0.0, "fatol": 0.0, "frtol": 0.0}
        found = find_minimum(depth, bracket, args=(cells[higher].astype(float),), tolerances=tolerances)
    refined = np.where(np.isfinite(found.f_x), found.x, bracket[1])
    refined, _ = _stationary(merit, refined, cells[higher])
    return cells[higher], refined, -depth(refined, cells[higher].astype(float))


def _basins(heights: _Array) -> tuple[tuple[NDArray[np.int64], ...], _Array]:
    """Find the highest points of basins that may hold the optimum of their cell: indices, the cells last.

    And what each of them promises: its height, and as much more as it is above its neighbours.
    """
    inputs = heights.ndim - 1
    neighbours = maximum_filter(heights, size=(*(3 for _ in range(inputs)), 1), mode="nearest")
    peaks = (heights == neighbours) & np.isfinite(heights)
    rise = np.zeros_like(heights)
    for axis in range(inputs):
        steps = np.abs(np.diff(np.where(np.isfinite(heights), heights, np.nan), axis=axis))
        steps = np.where(np.isnan(steps), np.inf, steps)  # beside what is not feasible there is no saying
        ends = [(0, 0)] * heights.ndim
        ends[axis] = (1, 1)
        padded = np.pad(steps, ends)
        first, last = [slice(None)] * heights.ndim, [slice(None)] * heights.ndim
        first[axis], last[axis] = slice(None, -1), slice(1, None)
        rise += np.maximum(padded[tuple(first)], padded[tuple(last)])
    promised = np.full(heights.shape, -np.inf)
    promised[peaks] = heights[peaks] + rise[peaks]
    best = heights.reshape(-1, heights.shape[-1]).max(axis=0)
    peaks &= promised >= best
    flat = np.where(peaks, promised, -np.inf).reshape(-1, heights.shape[-1])
    if flat.shape[0] > _MOST_BASINS:
        least = -np.partition(-flat, _MOST_BASINS - 1, axis=0)[_MOST_BASINS - 1]
        highest = np.argmax(heights.reshape(flat.shape), axis=0)
        kept = (flat >= least) & np.isfinite(flat)
        kept[highest, np.arange(flat.shape[1])] |= np.isfinite(best)
        peaks = kept.reshape(heights.shape)
    return tuple(np.nonzero(peaks)), promised[peaks]


def _is_new(heights: _Array, places: _Array) -> NDArray[np.bool_]:
    """Report where a sweep at half the resolution has no basin where the optimum is."""
    inputs = heights.ndim - 1
    coarse = heights[(*(slice(None, None, 2) for _ in range(inputs)), slice(None))]
    peaks = (coarse == maximum_filter(coarse, size=(*(3 for _ in range(inputs)), 1), mode="nearest")) & np.isfinite(
        coarse
    )
    indices = np.nonzero(peaks)
    shown: NDArray[np.bool_] = np.any(np.isnan(places), axis=0)  # where nothing is feasible there is nothing to miss
    spacing = 1.0 / (coarse.shape[0] - 1)
    near = np.ones(indices[-1].size, bool)
    for own, index in zip(places, indices[:-1], strict=True):
        near &= np.abs(own[indices[-1]] - spacing * index) <= spacing * (1.0 + _WIDTH)
    shown[indices[-1][near]] = True
    return np.logical_not(shown)


def _folded(places: _Array) -> _Array:
    """Mirror places beyond 0 and 1 into the range, so that a peak at an end has lower points on both sides."""
    return np.abs(1.0 - np.abs(1.0 - places))


def _into(places: _Array, lowest: _Array, highest: _Array) -> _Array:
    """Mirror places into what is feasible, and into the range."""
    inner = np.where(places < lowest, 2.0 * lowest - places, np.where(places > highest, 2.0 * highest - places, places))
    return _folded(inner)


def _refine_one(merit: Merit, heights: _Array, basins: tuple[NDArray[np.int64], ...]) -> tuple[_Array, _Array]:
    """Refine the basins of one searched input, all at once."""
    index, cells = basins
    if not index.size:
        return np.empty((1, 0)), np.empty(0)
    last = heights.shape[0] - 1
    axis = np.linspace(0.0, 1.0, last + 1)
    centre, lowest, highest = axis[index], np.full(index.size, -1.0), np.full(index.size, 2.0)
    sides = []
    for side in (-1, 1):
        neighbour = np.clip(index + side, 0, last)
        beside = centre + side / last
        blocked = (neighbour != index) & ~np.isfinite(heights[neighbour, cells])
        if blocked.any():
            edge = _edges(merit, centre[blocked], beside[blocked], cells[blocked])
            (lowest if side < 0 else highest)[blocked] = edge
            beside[blocked] = edge
        sides.append(beside)

    def inside(places: Any, cell: Any, low: Any, high: Any) -> Any:
        """Return what is to be least, mirrored where the range ends or what is feasible does."""
        merits, _ = merit.values(_into(places, low, high)[None], cell.astype(np.int64))
        return -np.where(np.isnan(merits), -np.inf, merits)

    numbers = cells.astype(float)
    left, right = sides
    for edge, beside in ((lowest, sides[0]), (highest, sides[1])):
        height = inside(centre, numbers, lowest, highest)
        higher = (edge == beside) & (inside(beside, numbers, lowest, highest) < height)
        # the peak is between the edge and the centre, whose mirror image is beyond the edge
        image = 2.0 * beside - centre
        left, right = (
            np.where(higher, np.minimum(centre, image), left),
            np.where(higher, np.maximum(centre, image), right),
        )
        centre = np.where(higher, beside, centre)
    has_slopes = merit.slopes(centre[None, :1], cells[:1]) is not None

    def peaks(bracket: tuple[Any, Any, Any], some: Any, width: float) -> tuple[Any, Any]:
        """Return the peaks within brackets, and brackets of them that are as narrow."""
        with np.errstate(all="ignore"):  # beside what is not feasible, merits are infinite
            found = find_minimum(
                inside,
                bracket,
                args=(numbers[some], lowest[some], highest[some]),
                tolerances={"xatol": width, "xrtol": 0.0, "fatol": 0.0, "frtol": 0.0},
            )
        middle = bracket[1]
        height = inside(middle, numbers[some], lowest[some], highest[some])
        best = np.where(np.isfinite(found.f_x) & (found.f_x <= height), found.x, middle)
        return best, found.bracket

    every = np.arange(index.size)
    best, around = peaks((left, centre, right), every, _ROUGH if has_slopes else _WIDTH)
    places, settled = _stationary(merit, _into(best, lowest, highest), cells)
    rest = np.flatnonzero(~settled)
    if has_slopes and rest.size:  # kinks whose slopes are of one sign, steps, and edges
        best[rest], _ = peaks(tuple(one[rest] for one in around), rest, _WIDTH)
        places[rest] = _into(best[rest], lowest[rest], highest[rest])
    ends = np.round(places)
    to_ends, _ = merit.values(ends[None], cells)
    merits, _ = merit.values(places[None], cells)
    at_end = (np.abs(places - ends) < _NEAR) & (to_ends >= merits - 2.0**-48 * np.abs(merits))
    places = np.where(at_end, ends, places)
    merits, margins = merit.values(places[None], cells)
    return places[None], np.where((margins >= 0.0) & ~np.isnan(merits), merits, -np.inf)


def _edges(merit: Merit, inside: _Array, outside: _Array, cells: NDArray[np.int64]) -> _Array:
    """Return where what is required ceases to be met between two places, on the side on which it is."""

    def side(places: Any, cell: Any) -> Any:
        merits, margins = merit.values(places[None], cell.astype(np.int64))
        return np.where((margins >= 0.0) & ~np.isnan(merits), 1.0, -1.0)

    tolerances = {"xatol": _WIDTH**1.2, "xrtol": 0.0, "fatol": 0.0}
    found = find_root(side, (inside, outside), args=(cells.astype(float),), tolerances=tolerances)
    (one, other), (side_of_one, _) = found.bracket, found.f_bracket
    return np.where(side_of_one > 0.0, one, other)


def _stationary(merit: Merit, places: _Array, cells: NDArray[np.int64]) -> tuple[_Array, NDArray[np.bool_]]:
    """Move places of one input to the zero of the slope beside them, where it is known and the merit no lower.

    Returns
    -------
    The places, and whether each has been moved: the slope changes its sign there, by a zero or by a jump.
    """
    moved, settled = places.copy(), np.zeros(places.shape, bool)
    if merit.slopes(places[None, :1], cells[:1]) is None:
        return moved, settled

    def slope(at: Any, cell: Any) -> Any:
        slopes = merit.slopes(at[None], cell.astype(np.int64))
        assert slopes is not None  # noqa: S101 (they are known)
        return slopes[0]

    numbers = cells.astype(float)
    low, high = np.maximum(places - _NEAR, 0.0), np.minimum(places + _NEAR, 1.0)
    turns = (slope(low, numbers) > 0.0) & (slope(high, numbers) < 0.0)
    if not turns.any():
        return moved, settled
    tolerances = {"xatol": _WIDTH * 2.0**-10, "xrtol": 0.0, "fatol": 0.0}
    found = find_root(slope, (low[turns], high[turns]), args=(numbers[turns],), tolerances=tolerances)
    moved[turns] = found.x
    before, _ = merit.values(places[None], cells)
    after, margins = merit.values(moved[None], cells)
    settled = turns & (after >= before - 2.0**-48 * np.abs(before)) & (margins >= 0.0)
    return np.where(settled, moved, places), settled


def _refine_many(
    merit: Merit,
    heights: _Array,
    basins: tuple[NDArray[np.int64], ...],
    promised: _Array,
    *,
    constrained: bool,
) -> tuple[_Array, _Array]:
    """Refine the basins of several searched inputs, one after the other; of a cell the highest first.

    Those that promise no more than another has turned out to hold are left as they are.
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


def _refined(
    merit: Merit, start: _Array, cell: NDArray[np.int64], spacing: float, *, constrained: bool
) -> tuple[_Array, float]:
    """Refine one basin of several searched inputs within two spacings of its highest point."""
    bounds = list(zip(np.maximum(start - 2.0 * spacing, 0.0), np.minimum(start + 2.0 * spacing, 1.0), strict=True))
    low, high = np.array(bounds).T

    def height(place: _Array) -> float:
        """Return what is to be least: infinite where something is not met."""
        merits, margins = merit.values(np.clip(place, low, high), cell)
        return -float(merits) if float(margins) >= 0.0 and not np.isnan(merits) else np.inf

    def downwards(place: _Array) -> _Array:
        slopes = merit.slopes(np.clip(place, low, high), cell)
        assert slopes is not None  # noqa: S101 (they are known)
        return -np.asarray(slopes, dtype=float)

    has_slopes = merit.slopes(start, cell) is not None
    options: dict[str, Any]
    best, value = start, height(start)

    def better(place: _Array, than: float) -> bool:
        return height(place) < than

    if not constrained:
        options = {"ftol": 0.0, "gtol": 1e-13 * abs(value), "maxiter": 200, "maxls": 40}
        one = minimize(
            height, best, method="L-BFGS-B", jac=downwards if has_slopes else None, bounds=bounds, options=options
        )
        if better(one.x, value):
            best, value = one.x, height(one.x)
        if has_slopes and _is_stationary(downwards(best), best, low, high, abs(value)):
            return _to_zero_slopes(downwards, height, best, value)
    if constrained:
        best = _along_the_edge(merit, cell, height, downwards if has_slopes else None, best, bounds)
        value = height(best)
    for size in (0.25, 0.02):  # a simplex may collapse on a ridge: another one starts there
        simplex = np.clip(np.vstack([best, best + size * spacing * np.eye(best.size)]), low, high)
        simplex[1:] = np.where(simplex[1:] == best, np.clip(best - size * spacing, low, high), simplex[1:]) * np.eye(
            best.size
        ) + best * (1.0 - np.eye(best.size))
        options = {"xatol": _WIDTH, "fatol": 1e-15 * abs(value), "maxiter": 400, "initial_simplex": simplex}
        one = minimize(height, best, method="Nelder-Mead", bounds=bounds, options=options)
        if not better(one.x, value):
            break
        gain, best, value = value - height(one.x), one.x, height(one.x)
        if gain <= 1e-13 * abs(value):
            break
    return best, -value


def _along_the_edge(
    merit: Merit,
    cell: NDArray[np.int64],
    height: Callable[[_Array], float],
    downwards: Callable[[_Array], _Array] | None,
    best: _Array,
    bounds: list[tuple[float, float]],
) -> _Array:
    """Move a feasible place to a better one where what is required is met, smooth as far as that goes."""

    def plain(place: _Array) -> float:
        merits, _ = merit.values(place, cell)
        return -float(np.nan_to_num(merits, nan=-np.inf))

    def margin(place: _Array) -> float:
        _, margins = merit.values(place, cell)
        return float(np.maximum(margins, -1e30))

    options: dict[str, Any] = {"ftol": 1e-15, "maxiter": 100}
    with np.errstate(all="ignore"):
        one = minimize(
            plain,
            best,
            method="SLSQP",
            jac=downwards,
            bounds=bounds,
            constraints=[{"type": "ineq", "fun": margin}],
            options=options,
        )
    there = np.clip(one.x, *np.array(bounds).T)
    if not np.isfinite(there).all():
        return best
    if not np.isfinite(height(there)):  # by a rounding beyond the edge, or on the wrong side

        def side(share: Any) -> Any:
            inner = best[:, None] + np.atleast_1d(share) * (there - best)[:, None]
            merits, margins = merit.values(inner, np.broadcast_to(cell, inner.shape[1:]))
            return np.where((margins >= 0.0) & ~np.isnan(merits), 1.0, -1.0).reshape(np.shape(share))

        tolerances = {"xatol": 2.0**-52, "xrtol": 0.0, "fatol": 0.0}
        found = find_root(side, (0.0, 1.0), tolerances=tolerances)
        shares = [float(end) for end, own in zip(found.bracket, found.f_bracket, strict=True) if own > 0.0]
        there = best + max(shares, default=0.0) * (there - best)
    return there if height(there) < height(best) else best


def _is_stationary(slopes: _Array, place: _Array, low: _Array, high: _Array, size: float) -> bool:
    """Report whether no slope leads on, but against an end of the range."""
    at_end = ((place <= low) & (slopes > 0.0)) | ((place >= high) & (slopes < 0.0))
    inner_edge = at_end & (place > 0.0) & (place < 1.0)
    return bool(np.all((np.abs(slopes) <= 1e3 * _STEEP * size) | at_end) and not inner_edge.any())


def _to_zero_slopes(
    downwards: Callable[[_Array], _Array], height: Callable[[_Array], float], best: _Array, value: float
) -> tuple[_Array, float]:
    """Move a smooth peak to the zero of its slopes; an input at the end of its range stays there."""
    free = (best > 0.0) & (best < 1.0)
    if not free.any():
        return best, -value

    def slopes(inner: _Array) -> _Array:
        place = best.copy()
        place[free] = inner
        return downwards(place)[free]

    found = root(slopes, best[free], method="hybr", options={"xtol": 1e-14})
    moved = best.copy()
    moved[free] = np.clip(found.x, 0.0, 1.0)
    near = np.all(np.abs(moved - best) < 1e-4)
    if near and height(moved) <= value + 2.0**-48 * abs(value):
        return moved, -min(value, height(moved))
    return best, -value


def front(values: Sequence[_Array]) -> NDArray[np.int64]:
    """Return the numbers of the points that no other one excels in both values, by falling first value.

    Parameters
    ----------
    values
        Two arrays of one dimension, each to be as large as possible; points with NaN are left out.

    Examples
    --------
    >>> front([np.array([1.0, 3.0, 2.0, 2.0]), np.array([5.0, 1.0, 4.0, 3.0])]).tolist()
    [1, 2, 0]
    """
    first, second = values
    there = np.flatnonzero(~(np.isnan(first) | np.isnan(second)))
    order = there[np.lexsort((-second[there], -first[there]))]
    highest = np.maximum.accumulate(second[order])
    before = np.concatenate([[-np.inf], highest[:-1]])
    return order[second[order] > before]
