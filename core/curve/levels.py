"""Where a branch has a given level of what is prescribed: landings of jumps, turning points."""

import math
from typing import Final

from gradhesion.core.curve.values import (
    Curve,
    bin_of,
    coordinate_at,
    coordinate_of,
    depth_and_load,
    place_of,
    radius_of,
    slope_at,
    slope_in,
    slope_near,
    softness,
)
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import HALF, PE, YC, N, T, end_of

LANDING: Final = 4e-4
"""Accuracy of a landing, in half widths, before its last step, whose error is the cube: energies forgive its square."""
EXACTLY: Final = 1e-6
"""The same where the radius itself is asked for."""
_UNDER_LOAD: Final = 2e-5
"""Where a load counts, the depth of a landing is not stationary."""
BEYOND: Final = -1.0
"""In the place of a radius: beyond the table."""


@leaf
def _bin_of_level(curve: Curve, level: float, low: float, high: float) -> int:
    """Return the bin between two radii on a branch that has a level; the number of bins if it is beyond the table."""
    bins = curve.table.bins
    i = bin_of(curve.table, low) if low > 0.0 else 0
    j = bin_of(curve.table, min(high, end_of(curve.table)))
    if high >= end_of(curve.table):  # how far out is not known: ever longer strides
        stride, edge = 1, i + 1
        while edge < bins and coordinate_at(curve, edge) < level:
            i = edge
            edge += stride
            stride *= 2
        j = min(edge, bins) - 1
        if edge >= bins and coordinate_at(curve, bins) < level:
            i = j = bins
    while i < j:
        middle = (i + j) // 2
        if coordinate_at(curve, middle + 1) < level:
            i = middle + 1
        else:
            j = middle
    return i


@leaf
def _guess(curve: Curve, i: int, level: float) -> float:
    """Return where in bin i the level is about: a step from the chord, by the cubic through values and slopes."""
    low, high = coordinate_at(curve, i), coordinate_at(curve, i + 1)
    first = slope_at(curve, i) * softness(curve, curve.table.nodes[T, i])
    last = slope_at(curve, i + 1) * softness(curve, curve.table.nodes[T, i + 1])
    width = 2.0 * curve.table.nodes[HALF, i]
    rise = high - low
    s = (level - low) / rise
    p, q = first * width - rise, last * width - rise
    slope = rise + p * (1.0 - s) * (1.0 - 3.0 * s) - q * s * (2.0 - 3.0 * s)
    return 2.0 * (s - s * (1.0 - s) * (p * (1.0 - s) - q * s) / slope) - 1.0


@leaf
def _value_in(curve: Curve, i: int, t: float) -> tuple[float, float, float]:
    """Return what is prescribed at a place in bin i, and its first two derivatives by t."""
    table = curve.table
    D, D1, _, depth = slope_in(curve, i, t)
    if curve.by_load == 0.0:
        return depth, D, D1
    depth, load = depth_and_load(curve, i, t)
    stretch = 0.0
    for n in range(N - 1, -1, -1):
        stretch = stretch * t + table.polys[i, PE, n]
    stiffness = 1.0 / (stretch * stretch)
    weight = softness(curve, stiffness)
    ratio = table.nodes[HALF, i] / radius_of(table, i, t)
    change = curve.by_load * stiffness * (1.0 + table.k) * ratio
    return coordinate_of(curve, depth, load), D * weight, D1 * weight + D * change


@leaf
def _radius_of_level(curve: Curve, level: float, i: int, low: float, high: float, accuracy: float) -> float:
    """Return the radius in bin i, between two on a branch, at which what is prescribed is `level`."""
    centre, half = curve.table.nodes[YC, i], curve.table.nodes[HALF, i]
    a = max(-1.0, (low - centre) / half)
    b = min(1.0, (high - centre) / half)
    t = _guess(curve, i, level)
    if not (a < t < b):
        t = 0.5 * (a + b)
    bend = 4e-2  # the next step is this one times the square of its part of the distance to a fold
    if curve.by_load != 0.0:
        accuracy, bend = min(accuracy, _UNDER_LOAD), 1e-4
    for _ in range(60):
        value, D, D1 = _value_in(curve, i, t)
        value -= level
        if value > 0.0:
            b = t
        else:
            a = t
        ahead = t - 2.0 * value * D / (2.0 * D * D - value * D1)
        if not (a <= ahead <= b):
            ahead = 0.5 * (a + b)
        step = abs(ahead - t)
        t = ahead
        if (step < accuracy and step * abs(D1) < bend * abs(D)) or b - a < 1e-12:
            break
    return radius_of(curve.table, i, t)


@kernel
def at_level(curve: Curve, level: float, low: float, high: float, accuracy: float) -> float:
    """Return the radius between `low` and `high`, on a branch, at which what is prescribed is `level`.

    `high` may be inf; BEYOND is returned if the level is not reached within the table.
    """
    i = _bin_of_level(curve, level, low, high)
    if i >= curve.table.bins:
        return BEYOND
    return _radius_of_level(curve, level, i, low, high, accuracy)


@kernel
def polished(curve: Curve, y: float, level: float) -> float:
    """Return a fold (`level` NaN), or where a branch has a level, to rounding: one step of Newton's method.

    Values forgive the square of the error of a radius, slopes do not.
    """
    step = math.inf
    if 0.0 < y < end_of(curve.table):
        i, t = place_of(curve.table, y)
        if math.isnan(level):
            D, D1, _, _ = slope_near(curve, i, t)
            step = D / D1
        else:
            value, D, _ = _value_in(curve, i, t)
            step = (value - level) / D
        y -= step * curve.table.nodes[HALF, i] if abs(step) < 1e-4 else 0.0
    return y
