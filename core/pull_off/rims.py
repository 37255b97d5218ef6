"""The pull-off of many rims of one curve.

That of the largest rim is valid for all beyond its place. For the others the search goes from the rim inwards
(pull_off/general.py), in cells that are the same for all of them: the troughs of a cell are found once.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.dispatch import face_of
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.arches import is_one_cosine
from gradhesion.core.curve.cells import MOST
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Series, coordinate, slope
from gradhesion.core.curve.general_folds import Search, Zeros, cell_width, folds_of_cell
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.pull_off.general import (
    INWARDS,
    WORTH,
    Terms,
    chi_terms,
    floor_of_cell,
    innermost,
    load_at_rim,
    lowest_load,
)
from gradhesion.core.pull_off.lowest_two import Lowest, lower
from gradhesion.core.types import Floats, Integers

_MOST_CELLS: Final = 8192
_FEW: Final = 4
"""Number of rims up to which keeping cells saves no time."""
_UNKNOWN: Final = -1


class Cells(NamedTuple):
    """Cells of a curve from a place inwards, and the troughs of the load in them."""

    ends: Floats  # x between which they stand, falling, of shape (cells + 1,)
    counts: Integers  # the troughs of each, _UNKNOWN until it is searched, int64 of shape (cells + 1,)
    troughs: Floats  # x and load of each trough, of shape (cells + 1, 4, 2)
    zeros: Floats  # room for the folds of one cell, of shape (MOST,)


@kernel()
def _fill_cell(
    basis: Basis, curve: Series, low: float, high: float, work: Search, zeros: Zeros, troughs: Floats
) -> int:
    """Put x and load of the troughs of a cell into `troughs`, of shape (4, 2); return their number."""
    at_low, _, _ = slope(basis, curve, low)
    found, _, _ = folds_of_cell(basis, curve, low, high, at_low, work, zeros, 0.0)
    falling, count = at_low < 0.0, 0
    for i in range(found):
        if falling and count < troughs.shape[0]:
            troughs[count, 0], troughs[count, 1] = zeros[i], coordinate(basis, curve, zeros[i])
            count += 1
        falling = not falling
    return count


@kernel()
def _inwards(
    basis: Basis, curve: Series, terms: Terms, rim: float, best: Lowest, cells: Cells, work: Search
) -> tuple[bool, Lowest]:
    """Return the lowest load within a rim; whether the cells reach that far in."""
    ends, counts, troughs, zeros = cells
    k = basis[0].k
    for c in range(ends.size - 1):
        high, low = min(ends[c], rim), ends[c + 1]
        if low >= rim:
            continue
        if best[0] < 0.0 and innermost(terms, k, 0.0, TWO_PI * high) >= best[0] * WORTH:
            return True, best
        if best[0] < 0.0 and floor_of_cell(terms, curve, k, 0.0, TWO_PI * low, TWO_PI * high) >= best[0] * WORTH:
            continue
        if counts[c] == _UNKNOWN:
            counts[c] = _fill_cell(basis, curve, low, ends[c], work, zeros, troughs[c])
        for i in range(counts[c]):
            if troughs[c, i, 0] < rim:
                best = lower(best, troughs[c, i, 1], troughs[c, i, 0])
    return False, best


@kernel()
def _cells_from(basis: Basis, high: float) -> Floats:
    """Return the ends of cells from x = `high` inwards, of shape (cells + 1,), as far as there is room."""
    _, _, series = basis
    ends = np.empty(_MOST_CELLS + 1)
    ends[0] = high
    for c in range(_MOST_CELLS):
        ends[c + 1] = ends[c] - min(cell_width(series, ends[c]), INWARDS * ends[c])
        if ends[c + 1] < 1e-9 * high:
            return ends[: c + 2]
    return ends


@face_of(Series, "gradhesion.core.pull_off.patterned")
@kernel()
def lowest_loads(
    basis: Basis, curve: Series, rims: Floats, rims_low: Floats, work: Search, deepest: float, found: Floats
) -> None:
    """Put what `lowest_load` (pull_off/general.py) returns for each rim x + its rounding error into a row of `found`.

    Rims and rounding errors are of shape (rims,), `found` of shape (rims, 3). Rims that are not above 0 are left out;
    NaN where no load below 0 is found.
    """
    table, _, series = basis
    B, m, g, _, _ = curve
    furthest, inner = 0, 0.0
    number = 0
    for i in range(rims.size):
        number += rims[i] > 0.0
        if rims[i] > rims[furthest] or not rims[furthest] > 0.0:
            furthest = i
    if number == 0:
        return
    free = lowest_load(basis, curve, rims[furthest], rims_low[furthest], work, deepest)
    shared = free[0] < 0.0 and free[2] >= free[0] * (1.0 - CLOSE)
    left = 0
    for i in range(rims.size):
        if not rims[i] > 0.0:
            continue
        found[i, 0], found[i, 1], found[i, 2] = free
        if i != furthest and not (shared and free[1] < rims[i]):
            found[i, 0] = math.nan
            inner = max(inner, rims[i])
            left += 1
    together = left > _FEW and not is_one_cosine(series, m) and inner / cell_width(series, inner) < 0.5 * _MOST_CELLS
    if together:
        controlled = Series(B, m, g, 0.0, 1.0)
        terms = chi_terms(table, series, g, deepest)
        ends = _cells_from(basis, inner)
        counts, troughs = np.full(ends.size, _UNKNOWN), np.empty((ends.size, 4, 2))
        cells = Cells(ends, counts, troughs, np.empty(MOST))
    for i in range(rims.size):
        if not (rims[i] > 0.0 and math.isnan(found[i, 0])) or (i == furthest):
            continue
        done, best = False, (0.0, 0.0, 0.0)
        if together:
            at_rim = load_at_rim(basis, controlled, rims[i], rims_low[i])
            if at_rim < 0.0:
                best = (at_rim, rims[i], 0.0)
            done, best = _inwards(basis, controlled, terms, rims[i], best, cells, work)
        if not done:
            best = lowest_load(basis, curve, rims[i], rims_low[i], work, deepest)
        found[i, 0], found[i, 1], found[i, 2] = best
    for i in range(rims.size):
        if not found[i, 0] < 0.0:
            found[i, 0] = found[i, 1] = math.nan
