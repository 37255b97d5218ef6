"""All folds of a curve between two radii, cell by cell (curve/cells.py), refined on the curve itself."""

import math
from typing import Final, NamedTuple, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cells import DEGREE, MOST, NODES, NOISE, PLACES, STACK, isolate
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Series, level_at, slope
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics

MOST_CELLS: Final = 333_000
"""Most cells, of three quarters of the shortest wave, that are searched."""
MOST_FOLDS: Final = 400_000
_SHARE: Final = 0.7
"""Longest cell over its distance from zero contact, where powers of z have a branch point."""
WAVES: Final = 0.75
"""Longest cell in shortest waves."""
_STEPS: Final = 80
_SURE: Final = 1e-15
_ENOUGH: Final = 1e-8
"""Step over the bracket, which holds one zero and no other: its square is below rounding."""
_NEAR: Final = 1e-6
"""Least |D| over the ends' below which it is compared with the terms of D."""


Zeros: TypeAlias = Floats
"""Folds in order: x, beyond some whole waves where these are given; of shape (MOST_FOLDS,), (MOST,) in a cell."""


class Search(NamedTuple):
    """Room for a search for folds (curve/cells.py)."""

    values: Floats  # D and its slopes at the places of a cell, of shape (DEGREE + 1,)
    stack: Floats  # polynomials that are still to be searched, of shape (STACK, DEGREE + 1)
    spans: Floats  # where they stand, of shape (STACK, 3)
    found: Floats  # what is found, of shape (MOST, 5)


@kernel()
def room() -> Search:
    """Return room for a search for folds."""
    return Search(np.empty(DEGREE + 1), np.empty((STACK, DEGREE + 1)), np.empty((STACK, 3)), np.empty((MOST, 5)))


@kernel()
def cell_width(series: Harmonics, x: float) -> float:
    """Return the width of the cell that begins or ends at x."""
    shortest = highest_harmonic(series)
    return min(WAVES / shortest, _SHARE * x) if shortest > 0.0 else _SHARE * x


@kernel()
def refine(
    basis: Basis, curve: Series, guess: float, low: float, high: float, rising: bool, whole: float
) -> tuple[float, float]:
    """Return where D goes through zero between two radii of different signs, and dD/dz there or nearby.

    Newton's method from a guess, kept in the bracket.
    """
    x = guess if low < guess < high else 0.5 * (low + high)
    enough = _ENOUGH * (high - low)
    last, rate = 0.0, 0.0
    for _ in range(_STEPS):
        value, rate, _ = slope(basis, curve, x, whole)
        if value == 0.0:
            break
        if (value < 0.0) == rising:
            low = x
        else:
            high = x
        step = -value / (TWO_PI * rate)
        x += step
        if not low < x < high:
            x = 0.5 * (low + high)
            last = 0.0
            if x <= low or x >= high:
                break
        elif abs(step) <= enough or step * step <= _SURE * abs(x) * abs(last):  # what is left is less than step^2/last
            break
        else:
            last = step
    return x, rate


@kernel(entry=True)
def _extremum(basis: Basis, curve: Series, low: float, high: float, whole: float) -> float:
    """Return where D has its extremum between two close radii (regula falsi of its slope, then bisection)."""
    _, first, _ = slope(basis, curve, low, whole)
    for _ in range(_STEPS):
        x = 0.5 * (low + high)
        if x <= low or x >= high:
            break
        _, rate, _ = slope(basis, curve, x, whole)
        if (rate < 0.0) == (first < 0.0):
            low = x
        else:
            high = x
    return 0.5 * (low + high)


@kernel()
def folds_of_cell(
    basis: Basis, curve: Series, low: float, high: float, at_low: float, work: Search, zeros: Zeros, whole: float = 0.0
) -> tuple[int, float, float]:
    """Put the zeros of D in a cell into `zeros`, in order; return their number, D at the far end, and the nearest miss.

    The nearest miss is the least |D| over its terms at an extremum that is no pair of zeros, or hardly one; else inf.
    """
    values, stack, spans, found = work
    values[0] = at_low
    for i in range(1, PLACES):
        x = high if i == PLACES - 1 else low + (high - low) * NODES[i]
        values[i], rate, _ = slope(basis, curve, x, whole)
        values[PLACES - 1 + i] = TWO_PI * (high - low) * rate
    at_high = values[PLACES - 1]
    count, miss = 0, math.inf
    here, negative = low, at_low < 0.0
    rows, nearest = isolate(values, stack, spans, found)
    if nearest <= _NEAR * max(abs(at_low), abs(at_high)):
        terms = _terms(basis, curve, low, whole)
        largest = terms
        for i in range(PLACES):
            largest = max(largest, abs(values[i]))
        miss = max(0.0, nearest - NOISE * largest) / terms
    for row in range(rows):
        left, right = low + (high - low) * found[row, 0], low + (high - low) * found[row, 1]
        points = 2
        middle = right
        if found[row, 3] == 2.0:
            points = 3
            middle = _extremum(basis, curve, left, right, whole)
            value, _, _ = slope(basis, curve, middle, whole)
            miss = min(miss, abs(value) / _terms(basis, curve, middle, whole))
        for i in range(points):
            x = left if i == 0 else (middle if i == 1 else right)
            if x <= here:
                continue
            value = at_high
            if x < high:
                value, _, _ = slope(basis, curve, x, whole)
            if (value < 0.0) != negative:
                guess = low + (high - low) * found[row, 4]
                zeros[count], _ = refine(basis, curve, guess, here, x, negative, whole)
                count += 1
                negative = value < 0.0
            elif points == 2 and i == 1:  # a zero of the interpolant alone: of a pair that D has not, or hardly
                miss = min(miss, abs(value) / _terms(basis, curve, x, whole))
            here = x
    if (at_high < 0.0) != negative:
        zeros[count], _ = refine(basis, curve, here, here, high, negative, whole)
        count += 1
    return count, at_high, miss


@kernel(entry=True)
def _terms(basis: Basis, curve: Series, x: float, whole: float) -> float:
    """Return the size of the terms of D."""
    table, _, _ = basis
    B, m, _, alpha, beta = curve
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    return m * B * z ** (m - 1.0) + level_at(table.k, alpha, beta / (power * power)) * power


@kernel()
def find_folds(
    basis: Basis, curve: Series, first: float, last: float, work: Search, zeros: Zeros, whole: float = 0.0
) -> tuple[int, bool, float]:
    """Put all zeros of D between two radii, `whole` waves further out, into `zeros`, in order.

    Returns
    -------
    Their number, -1 if there are too many for `zeros` or too many cells; whether the coordinate rises at the
    first radius; and the first place of a pair of folds that an error of CLOSE could make or unmake, else inf.
    """
    _, _, series = basis
    cell_zeros = np.empty(MOST)
    value, _, _ = slope(basis, curve, first, whole)
    rises = value >= 0.0
    count, tangency = 0, math.inf
    x = first
    for _ in range(MOST_CELLS):
        if x >= last:
            return count, rises, tangency
        high = x + cell_width(series, whole + x)
        if not high < last:
            high = last
        found, value, miss = folds_of_cell(basis, curve, x, high, value, work, cell_zeros, whole)
        if miss <= CLOSE:
            tangency = min(tangency, x)
        if count + found > zeros.size:
            return -1, rises, tangency
        for i in range(found):
            zeros[count] = cell_zeros[i]
            count += 1
        x = high
    return -1, rises, tangency
