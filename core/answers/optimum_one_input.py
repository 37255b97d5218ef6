"""Optima of one searched input: every basin of every cell is refined at once.

Values alone are compared (SciPy's `elementwise.find_minimum`, Chandrupatla's method and golden sections), so that a
peak that is a kink is found as well as a smooth one; then the zero of the exact slope, where there is one, gives the
place to all digits.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from scipy.optimize.elementwise import find_minimum, find_root

from gradhesion.core.answers.optimum_merit import CLOSE, WIDTH, Merit, edge_of, heights_at
from gradhesion.core.types import Floats, Integers, Truths

_ROUGH: Final = 2.0**-24
"""The width of a bracket where a zero of the slope is to follow."""
_NEAR: Final = 2.0**-20
"""Where the slopes beside a peak are evaluated for its zero."""
_BETWEEN: Final = 7
"""Points tried between two of a sweep, where there may be a peak that is higher than the best."""


def refine_one(merit: Merit, heights: Floats, basins: tuple[Integers, ...]) -> tuple[Floats, Floats]:
    """Refine the basins of a sweep (places, cells) of one input, all at once.

    Each basin is the number of a place and of a cell, arrays (basins,). Return places of shape (1, basins) and merits
    of shape (basins,), -inf where none is feasible.
    """
    index, cells = basins
    if not index.size:
        return np.empty((1, 0)), np.empty(0)
    centre, sides, edges = _brackets(merit, heights, index, cells)
    lowest, highest = edges

    def inside(places: Any, cell: Any, low: Any, high: Any) -> Any:
        """Return the value to be minimised, mirrored at the ends of the range and of the feasible region."""
        merits, _ = merit.values(_into(places, low, high)[None], cell.astype(np.int64))
        return -np.where(np.isnan(merits), -np.inf, merits)

    numbers = cells.astype(float)
    left, right = sides
    for edge, beside in zip(edges, sides, strict=True):
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
    width = _ROUGH if has_slopes else WIDTH
    best, around = _lowest(inside, (left, centre, right), (numbers, lowest, highest), width)
    places, settled = to_stationary(merit, _into(best, lowest, highest), cells)
    rest = np.flatnonzero(~settled)
    if has_slopes and rest.size:  # kinks whose slopes are of one sign, steps, and edges
        bracket = tuple(one[rest] for one in around)
        best[rest], _ = _lowest(inside, bracket, (numbers[rest], lowest[rest], highest[rest]), WIDTH)
        places[rest] = _into(best[rest], lowest[rest], highest[rest])
    ends = np.round(places)
    to_ends, _ = merit.values(ends[None], cells)
    merits, _ = merit.values(places[None], cells)
    at_end = (np.abs(places - ends) < _NEAR) & (to_ends >= merits - 2.0**-48 * np.abs(merits))
    places = np.where(at_end, ends, places)
    return places[None], heights_at(merit, places[None], cells)


def _brackets(merit: Merit, heights: Floats, index: Integers, cells: Integers) -> tuple[Floats, list[Floats], Floats]:
    """Return places (n,) of points of a sweep, the place on either side of each, and edges of what is feasible.

    On a side there is an edge or the next place of the sweep; edges, of shape (2, n), are beyond the range where there
    is none.
    """
    last = heights.shape[0] - 1
    centre = np.linspace(0.0, 1.0, last + 1)[index]
    sides, edges = [], np.array([np.full(index.size, -1.0), np.full(index.size, 2.0)])

    def height(places: Any, cell: Any) -> Any:
        return heights_at(merit, places[None], cell)

    for side, edge in zip((-1, 1), edges, strict=True):
        neighbour, beside = np.clip(index + side, 0, last), centre + side / last
        blocked = (neighbour != index) & ~np.isfinite(heights[neighbour, cells])
        if blocked.any():
            own = cells[blocked].astype(float)
            edge[blocked] = edge_of(height, centre[blocked], beside[blocked], (own,), WIDTH**1.2)
            beside[blocked] = edge[blocked]
        sides.append(beside)
    return centre, sides, edges


def _lowest(depth: Callable[..., Floats], bracket: Any, args: Any, width: float) -> tuple[Any, Any]:
    """Return the places of minima in brackets of three arrays (n,), no deeper than the middle, and such brackets.

    `args` are further arguments of `depth`, arrays (n,); the brackets returned are as narrow as `width`.
    """
    tolerances = {"xatol": width, "xrtol": 0.0, "fatol": 0.0, "frtol": 0.0}
    with np.errstate(all="ignore"):  # next to infeasible points merits are infinite
        found = find_minimum(depth, bracket, args=args, tolerances=tolerances)
    is_lower = np.isfinite(found.f_x) & (found.f_x <= depth(bracket[1], *args))
    return np.where(is_lower, found.x, bracket[1]), found.bracket


def peaks_between(merit: Merit, heights: Floats, best: Floats, where: Floats) -> tuple[Integers, Floats, Floats]:
    """Search for peaks between two points of a sweep that the sweep does not show, where they can be above the best.

    `best` and `where` are the optima of the cells so far. Between two points the merit is assumed to rise above both by
    no more than it changes between these, or between one of them and the next; the same is assumed between two of the
    points that are then tried.

    Returns
    -------
    Cells, places and merits of such peaks, refined; shape (peaks,).
    """
    with np.errstate(invalid="ignore"):  # where nothing is feasible
        reach = best + CLOSE * np.abs(best)
    index, cells = np.nonzero(_promised(heights) > reach)
    spacing = 1.0 / (heights.shape[0] - 1)
    inner = np.linspace(0.0, 1.0, _BETWEEN + 2)
    places = spacing * (index + inner[:, None])
    merits = np.empty(places.shape)
    merits[0], merits[-1] = heights[index, cells], heights[index + 1, cells]
    merits[1:-1] = heights_at(merit, places[None, 1:-1], cells)
    promised = _promised(merits)
    peaks = (merits[1:-1] >= merits[:-2]) & (merits[1:-1] > merits[2:])
    peaks &= np.maximum(promised[:-1], promised[1:]) > reach[cells]
    peaks &= np.abs(places[1:-1] - where[cells]) > spacing / (_BETWEEN + 1)
    point, which = np.nonzero(peaks)
    if not point.size:
        return cells[:0], places[0, :0], merits[0, :0]
    bracket = tuple(places[point + side, which] for side in (0, 1, 2))
    cells = cells[which]

    def depth(at: Any, cell: Any) -> Any:
        """Return the value to be minimised."""
        return -heights_at(merit, at[None], cell)

    refined, _ = to_stationary(merit, _lowest(depth, bracket, (cells.astype(float),), WIDTH)[0], cells)
    return cells, refined, -depth(refined, cells)


def _promised(heights: Floats) -> Floats:
    """Return for each interval of the first axis how high a peak within may be; -inf next to infeasible points."""
    with np.errstate(invalid="ignore"):
        steps = np.abs(np.diff(heights, axis=0))
    steps[~np.isfinite(steps)] = 0.0
    steepest = steps.copy()
    steepest[1:] = np.maximum(steepest[1:], steps[:-1])
    steepest[:-1] = np.maximum(steepest[:-1], steps[1:])
    lowest = np.minimum(heights[:-1], heights[1:])
    return np.where(np.isfinite(lowest), np.maximum(heights[:-1], heights[1:]) + steepest, -np.inf)


def to_stationary(merit: Merit, places: Floats, cells: Integers) -> tuple[Floats, Truths]:
    """Move places of one input to the zero of the slope beside them, where it is known and the merit no lower.

    Returns
    -------
    The places, and whether each has been moved, shape (n,): the slope changes its sign there, by a zero or by a jump.
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
    tolerances = {"xatol": WIDTH * 2.0**-10, "xrtol": 0.0, "fatol": 0.0}
    found = find_root(slope, (low[turns], high[turns]), args=(numbers[turns],), tolerances=tolerances)
    moved[turns] = found.x
    before, _ = merit.values(places[None], cells)
    after, margins = merit.values(moved[None], cells)
    settled = turns & (after >= before - 2.0**-48 * np.abs(before)) & (margins >= 0.0)
    return np.where(settled, moved, places), settled


def _into(places: Floats, lowest: Floats, highest: Floats) -> Floats:
    """Mirror places (n,) into the feasible region, and into 0 to 1: a peak at an end has lower points on both sides."""
    inner = np.where(places < lowest, 2.0 * lowest - places, np.where(places > highest, 2.0 * highest - places, places))
    return np.abs(1.0 - np.abs(1.0 - inner))
