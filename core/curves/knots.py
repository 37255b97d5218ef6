"""Where a drawn curve turns: its folds of depth and its extrema of load, exact to rounding."""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import END, START, Trace
from gradhesion.core.curve.cosine import Cosine, slope
from gradhesion.core.curve.cosine_folds import first_arch, fold_of_arch, last_arch, survey_arch
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.cosine import COUNTABLE, MOST_ARCHES
from gradhesion.core.types import Floats, Table

MOST_FOLDS: Final = 100_000
"""Folds up to which a curve is drawn."""


@kernel()
def polished(table: Table, curve: Cosine, level: float, x: float) -> float:
    """Return a zero of D to rounding from one of some twelve digits (two steps of Newton's)."""
    for _ in range(2):
        d, d1, _, _ = slope(table, curve, level, x)
        step = d / d1 / TWO_PI
        if not abs(step) < 1e-6 * min(1.0, x):  # two folds about to merge: where the slope is zero to rounding anyway
            break
        x -= step
    return x


@kernel()
def landed(table: Table, curve: Cosine, target: float, x: float) -> float:
    """Return where a branch reaches a depth, to rounding, from a place of some nine digits (two steps of Newton's)."""
    for _ in range(2):
        d, _, _, depth = slope(table, curve, 0.5 * (1.0 - table.k), x)
        step = (depth - target) / d / TWO_PI
        if not abs(step) < 1e-6 * min(1.0, x):  # at a fold, where the depth is reached to rounding anyway
            break
        x -= step
    return x


@kernel()
def folds_too_often(table: Table, curve: Cosine, furthest: float) -> bool:
    """Return whether depth or load may have more than `MOST_FOLDS` extrema up to a place, or any without a phase."""
    for level in (0.5 * (1.0 - table.k), 0.5 * (3.0 + table.k)):
        first, last = first_arch(table, curve, level), min(last_arch(table, curve, level), 2.0 * furthest)
        if last - first > MOST_FOLDS or last > max(first, MOST_ARCHES):
            return True
    return False


@kernel()
def polish_branches(table: Table, curve: Cosine, count: int, trace: Trace) -> None:
    """Move the ends of the branches of a trace to where the slope is zero to rounding."""
    level = 0.5 * (1.0 - table.k)
    for row in (START, END):
        for i in range(count):
            if 0.0 < trace[row, i] < math.inf:
                trace[row, i] = polished(table, curve, level, trace[row, i])


@kernel()
def folds_of_load(table: Table, curve: Cosine, furthest: float) -> Floats:
    """Return the x where the load of an exact curve is extremal, outwards up to a place, of shape (n,)."""
    level = 0.5 * (3.0 + table.k)
    first, final = first_arch(table, curve, level), last_arch(table, curve, level)
    places = np.empty(max(8, int(min(final, 2.0 * furthest) - first) + 16))
    count = 0
    i = int(min(first, COUNTABLE))
    while i <= final:
        survey = survey_arch(table, curve, level, i)
        kind, _, _, high = survey
        rising = kind == 1 or (kind == 2 and i % 2 == 0)
        for _ in range(abs(kind)):
            x, _ = fold_of_arch(table, curve, level, i, survey, rising, 0.0)
            x = polished(table, curve, level, x)
            if x >= furthest:
                return places[:count]
            places[count] = x
            count += 1
            rising = not rising
        if high > furthest:
            break
        i += 1
    return places[:count]
