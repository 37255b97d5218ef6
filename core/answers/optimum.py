"""Optima of a merit over one or more searched inputs, for many cells at once, and Pareto fronts of two merits.

A sweep over all searched inputs finds the peaks that can hold the optimum of their cell. Those of all cells are refined
together, in three steps: by Newton's method where slopes are known; where that does not settle, as on a kink, a step or
the edge of what is feasible, by values alone at points about the best one; and from there by Newton's method again.

Here each searched input runs from 0 to 1 over its range. A merit is smooth but for kinks and steps; it is to be
maximised, NaN where there is no value, and -inf where a requirement is not met.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np
from numpy.typing import ArrayLike
from scipy.ndimage import maximum_filter, maximum_filter1d

from gradhesion.core.types import Floats, Integers, Truths

_SCENES: Final = 2**18  # scenes evaluated at a time in a sweep
_CLOSE: Final = 1e-9  # relative difference by which a merit is better than another
_ALIKE: Final = 2.0**-44  # relative difference by which it may be no better: rounding of a merit
_ROUNDING: Final = 2.0**-50  # relative difference of merits next to the best below which there is no more to gain
_WIDTH: Final = 2.0**-48  # distance from the best place below which none is tried
_MOST_PEAKS: Final = 12  # number of peaks of a sweep that are refined in a cell: the highest
_BETWEEN: Final = 7  # points tried between two of a sweep, where there may be a peak that is higher than the best
_NEWTON: Final = 8  # steps of Newton's method at most; from within its reach, four suffice
_NEAR: Final = 2.0**-16
"""Where slopes beside a place are taken for their change, and within which a peak at an end of the range is there."""
_LINE: Final = np.array([[-1.0, -0.75, -0.5, -0.25, 0.25, 0.5, 0.75, 1.0]])
"""Points tried about the best one of one input, in parts of a range; the next is a spacing of these."""
_TRIED: Final = 16  # points tried about the best one of several inputs in a round; this and the next from experiment
_CHOSEN: Final = 4  # those of them next to which the next points are tried
_KEPT: Final = 3  # rounds whose choice is kept
_ROUNDS: Final = 200  # rounds at most
_WIDER: Final = (1.3 / (_KEPT * _CHOSEN)) ** 0.5
"""Weights of sums of steps: by the root of 1.3 wider than these are apart."""


class Merit(Protocol):
    """The merit of cells that differ in the inputs that are not searched."""

    def values(self, places: Floats, cells: Integers) -> Floats:
        """Return merits of shape `shape` at places (inputs, *shape), of cells whose numbers broadcast to `shape`."""

    def slopes(self, places: Floats, cells: Integers) -> Floats | None:
        """Return the slopes of merits to the searched inputs, as `places`; None if they are not known."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Optima:
    """The optimum of each cell."""

    places: Floats
    """From 0 to 1; shape (inputs, cells). NaN where nothing is feasible."""
    merits: Floats
    too_coarse: Truths
    """Whether the sweep at the stated resolution, half of that computed, misses the basin."""


def axis_of(resolution: int) -> Floats:
    """Return the places of a sweep at twice a resolution: those of the resolution are every second.

    Examples
    --------
    >>> axis_of(3).tolist()
    [0.0, 0.25, 0.5, 0.75, 1.0]
    """
    return np.linspace(0.0, 1.0, 2 * resolution - 1)


def sweep(values: Callable[[Floats, Integers], Floats], inputs: int, cells: int, resolution: int) -> Floats:
    """Return values (*places, cells) at all places of `axis_of` for all cells; several values have a first axis."""
    axis = axis_of(resolution)
    step = max(1, _SCENES // cells)
    grid = axis[np.indices((axis.size,) * inputs).reshape(inputs, -1, 1)]
    parts = [values(grid[:, i : i + step], np.arange(cells)) for i in range(0, grid.shape[1], step)]
    found = np.concatenate(parts, axis=-2)
    return found.reshape(*found.shape[:-2], *(axis.size,) * inputs, cells)


def optima_of(merit: Merit, merits: Floats) -> Optima:
    """Return the optimum of each cell from `merits`, those of `sweep` at a resolution of 3 or more.

    It has twice as many points, which show basins between those of the resolution. Places are right to 1e-12 of their
    ranges where the peak is a kink of one input, or where exact slopes are known; else to some 1e-8, where the merit is
    within rounding of its peak. Peaks narrower than half a spacing may be missed: a finer resolution is the remedy.
    """
    inputs, cells = merits.ndim - 1, merits.shape[-1]
    heights, spacing = _finite(merits), 1.0 / (merits.shape[0] - 1)
    *indices, own = _peaks_that_count(heights)
    starts = spacing * np.array(indices, dtype=float)
    places, found = _refined(merit, starts, own, spacing)
    best, where, first = np.full(cells, -np.inf), *np.full((2, inputs, cells), np.nan)
    np.maximum.at(best, own, found)
    last = found >= best[own] - _ALIKE * np.abs(best[own])  # of those alike, as on a plateau, the last
    best[own[last]], where[:, own[last]], first[:, own[last]] = found[last], places[:, last], starts[:, last]
    too_coarse = _is_new(heights, where)
    if inputs == 1:
        way = merit.values(first + (where - first) * np.array([[[0.0], [0.25], [0.5], [0.75]]]), np.arange(cells))
        too_coarse |= (way < way[0] - _ALIKE * np.abs(way[0])).any(axis=0)  # a valley lies between, so another peak
        starts, own = _between(merit, heights, best, where)
        places, found = _refined(merit, starts, own, spacing / (_BETWEEN + 1))
        for i in np.argsort(found):
            if found[i] > best[own[i]] + _CLOSE * abs(best[own[i]]):
                best[own[i]], where[:, own[i]], too_coarse[own[i]] = found[i], places[:, i], True
    return Optima(places=where, merits=np.where(np.isfinite(best), best, np.nan), too_coarse=too_coarse)


def front(values: ArrayLike) -> Integers:
    """Return the numbers, shape (n,), of the points that no other one excels in both values, by falling first value.

    `values`, (2, points), are to be maximised; points with NaN are left out.

    Examples
    --------
    >>> front([[1.0, 3.0, 2.0, 2.0], [5.0, 1.0, 4.0, 3.0]]).tolist()
    [1, 2, 0]
    """
    first, second = np.asarray(values, dtype=float)
    there = np.flatnonzero(~(np.isnan(first) | np.isnan(second)))
    order = there[np.lexsort((-second[there], -first[there]))]
    highest = np.maximum.accumulate(second[order])
    return order[second[order] > np.concatenate([[-np.inf], highest[:-1]])]


def _finite(merits: Floats) -> Floats:
    """Return merits of any shape, -inf where they have no value."""
    return np.where(np.isnan(merits), -np.inf, merits)


def _peaks(heights: Floats) -> Truths:
    """Return where finite heights of a sweep (*places, cells) are not below their neighbours, diagonal ones too."""
    neighbours = maximum_filter(heights, size=(*(3 for _ in heights.shape[1:]), 1), mode="nearest")
    return (heights == neighbours) & np.isfinite(heights)


def _peaks_that_count(heights: Floats) -> tuple[Integers, ...]:
    """Return the indices, arrays (peaks,), of peaks of a sweep (*places, cells) that may hold the optimum of a cell.

    A peak is assumed to rise above its highest point by no more than that is above its neighbours, all axes together;
    next to what is infeasible there is no bound.
    """
    rise = np.zeros_like(heights)
    with np.errstate(invalid="ignore"):  # where nothing is feasible
        for axis in range(heights.ndim - 1):
            apart = np.abs(np.diff(heights, axis=axis))
            apart[np.isnan(apart)] = np.inf
            ends = np.zeros_like(heights.take([0], axis))
            rise += np.maximum(np.concatenate([ends, apart], axis), np.concatenate([apart, ends], axis))
        best = heights.max(axis=tuple(range(heights.ndim - 1)))
        *places, cells = np.nonzero(_peaks(heights) & (rise >= best - heights))
    order = np.lexsort((-np.arange(cells.size), -heights[(*places, cells)], cells))  # of a plateau the last
    rank = np.arange(cells.size) - np.searchsorted(cells[order], cells[order])
    kept = np.sort(order[rank < _MOST_PEAKS])
    return tuple(index[kept] for index in (*places, cells))


def _is_new(heights: Floats, places: Floats) -> Truths:
    """Report for each cell, shape (cells,), whether a sweep at half the resolution has no basin where its optimum is.

    `heights` are those of the sweep, (*places, cells), `places` the optima, (inputs, cells), NaN where there is none.
    """
    *indices, cells = np.nonzero(_peaks(heights[(*(slice(None, None, 2) for _ in places), slice(None))]))
    spacing = 2.0 / (heights.shape[0] - 1)
    apart = np.abs(places[:, cells] - spacing * np.array(indices)).max(axis=0)
    shown: Truths = np.any(np.isnan(places), axis=0)  # where nothing is feasible no optimum is missed
    shown[cells[apart <= spacing * (1.0 + _NEAR)]] = True
    return ~shown


def _between(merit: Merit, heights: Floats, best: Floats, where: Floats) -> tuple[Floats, Integers]:
    """Return places (1, peaks), and cells, of peaks between the points of a sweep that may be above the best.

    That is `best` (cells,), at `where` (1, cells). Between two feasible points a merit of one input is assumed to rise
    above both by no more than it changes between them, or from one of them to the next.
    """
    with np.errstate(invalid="ignore"):
        steps = np.abs(np.diff(heights, axis=0))
        steps[~np.isfinite(steps)] = 0.0
        promised = np.maximum(heights[:-1], heights[1:]) + maximum_filter1d(steps, 3, axis=0, mode="nearest")
        promised[~np.isfinite(heights[:-1] + heights[1:])] = -np.inf
        index, cells = np.nonzero(promised > best + _CLOSE * np.abs(best))
    spacing = 1.0 / (heights.shape[0] - 1)
    places = spacing * (index + np.linspace(0.0, 1.0, _BETWEEN + 2)[:, None])
    peaks = _peaks(_finite(merit.values(places[None], cells)))[1:-1]
    peaks &= np.abs(places[1:-1] - where[0, cells]) > spacing / (_BETWEEN + 1)
    return places[1:-1][peaks][None], np.broadcast_to(cells, peaks.shape)[peaks]


def _refined(merit: Merit, starts: Floats, cells: Integers, spacing: float) -> tuple[Floats, Floats]:
    """Move starts (inputs, n) of cells (n,) to the peaks within some spacings; return places and heights (n,)."""
    places, settled = _stationary(merit, starts, cells, spacing)
    rest = np.flatnonzero(~settled)
    if rest.size:
        own = cells[rest]
        climbed = _climbed(merit, starts[:, rest], own, spacing)
        ends = np.where(np.abs(climbed - np.round(climbed)) < _NEAR, np.round(climbed), climbed)
        climbed = np.where(_is_as_high(merit, ends, climbed, own), ends, climbed)
        places[:, rest], _ = _stationary(merit, climbed, own, _NEAR)
    return places, _finite(merit.values(places, cells))


def _is_as_high(merit: Merit, places: Floats, others: Floats, cells: Integers) -> Truths:
    """Report where places (inputs, n) are feasible and no lower than others but for rounding."""
    own, other = merit.values(places, cells), merit.values(others, cells)
    with np.errstate(invalid="ignore"):
        return np.isfinite(own) & (own >= other - _ALIKE * np.abs(other))


def _stationary(merit: Merit, starts: Floats, cells: Integers, reach: float) -> tuple[Floats, Truths]:
    """Move places (inputs, n) to where the slopes are zero, or outwards at an end of the range, within a reach.

    Return places, and whether each was found, (n,). Where not, or where the merit is lower there, it is the start. By
    Newton's method, with the change of the slopes by differences, and uphill whatever the sign of that change.
    """
    inputs, count = starts.shape
    places, settled = starts.copy(), np.zeros(count, bool)
    if not count or merit.slopes(starts[:, :1], cells[:1]) is None:
        return places, settled
    sides = _NEAR * np.concatenate([np.zeros((inputs, 1)), np.eye(inputs), -np.eye(inputs)], axis=1)[..., None]
    live = np.arange(count)
    for _ in range(_NEWTON):
        at = places[:, live]
        around = np.clip(at[:, None] + sides, 0.0, 1.0)
        slopes = merit.slopes(around, cells[live])
        assert slopes is not None  # noqa: S101 (they are known)
        slope, ahead, behind = np.split(np.nan_to_num(slopes), [1, 1 + inputs], axis=1)
        width = np.diagonal(around[:, 1 : 1 + inputs] - around[:, 1 + inputs :]).T
        fixed = ((at == 0.0) & (slope[:, 0] < 0.0)) | ((at == 1.0) & (slope[:, 0] > 0.0))
        bend = np.where(fixed | fixed[:, None], -np.eye(inputs)[..., None], (ahead - behind) / width)
        sizes, ways = np.linalg.eigh(np.moveaxis(0.5 * (bend + bend.swapaxes(0, 1)), -1, 0))
        along = np.einsum("nij,in->nj", ways, np.where(fixed, 0.0, slope[:, 0]))
        with np.errstate(all="ignore"):  # on a plateau there is nowhere to go
            move = np.einsum("nij,nj->in", ways, np.nan_to_num(along / np.abs(sizes)))
        low, high = np.maximum(starts[:, live] - reach, 0.0), np.minimum(starts[:, live] + reach, 1.0)
        places[:, live] = np.clip(at + move, low, high)
        done = (np.abs(move).max(axis=0) < _NEAR**2) & (sizes < 0.0).all(axis=1)
        settled[live[done]] = True
        live = live[~done]
        if not live.size:
            break
    settled &= _is_as_high(merit, places, starts, cells)
    return np.where(settled, places, starts), settled


def _climbed(merit: Merit, starts: Floats, cells: Integers, spacing: float) -> Floats:
    """Move places (inputs, n) to the highest ones nearby, by values alone.

    In each round points about the best are tried. Of one input they are evenly spaced, in a range that shrinks to their
    spacing. Of several they are random sums of steps from the best to those next to it in the last rounds, so that they
    spread along ridges and edges, and gather where there is nowhere to go.
    """
    inputs, count = starts.shape
    rng, best, live = np.random.default_rng(1), starts.copy(), np.arange(count)
    one = inputs == 1
    steps = np.full((1, 1, 1), spacing) if one else spacing * rng.standard_normal((inputs, _KEPT * _CHOSEN, 1))
    steps = np.repeat(steps, count, axis=2)
    for _ in range(_ROUNDS):
        own = steps[..., live]
        shares = _LINE if one else _WIDER * rng.standard_normal((_KEPT * _CHOSEN, _TRIED))
        moved = best[:, None, live] + np.einsum("ikn,km->imn", own, shares)
        tried = np.concatenate([best[:, None, live], np.clip(moved, 0.0, 1.0)], axis=1)
        heights = _finite(merit.values(tried, cells[live]))
        heights[1:][(tried[:, 1:] == tried[:, :1]).all(axis=0)] = -np.inf  # cut off at an end: the best itself
        order = np.argsort(-heights, axis=0, kind="stable")[: _CHOSEN + 1]
        heights, chosen = np.take_along_axis(heights, order, 0), np.take_along_axis(tried, order[None], 1)
        best[:, live] = chosen[:, 0]
        apart = np.where(np.isfinite(heights[1:]), chosen[:, 1:] - chosen[:, :1], 0.0)
        own = own * 0.25 if one else np.concatenate([own[:, _CHOSEN:], apart], axis=1)
        steps[..., live] = own
        level = heights[0] - heights[-1] <= _ROUNDING * np.abs(heights[0])
        live = live[~level & (np.abs(own).max(axis=(0, 1)) > _WIDTH)]
        if not live.size:
            break
    return best
