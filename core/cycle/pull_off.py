"""The pull-off: the lowest load up to a rim.

Every load is above an envelope, which is smooth. From the envelope's lowest place troughs are looked at outwards and
inwards, as long as the envelope lies below the best of them.
"""

from typing import Final, NamedTuple

from gradhesion.core.curve.folds import pair_in, swing_in, zero_in
from gradhesion.core.curve.values import Curve, bin_of, depth_and_load, load_curve, place_of, radius_of, slope_at
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import U1, E, P, T, U, Y, end_of

_MARGIN: Final = 0.006
"""Of the crest: how far the estimate of a trough may be above it, with x = pi/4, a bin in the shortest wave's phase.

The cubic is off by x^4/384, and by x^3/128 where the zero of the linear slope is a bin's eighth off that of the slope.
"""


class Lowest(NamedTuple):
    """The lowest load up to a rim and the second lowest trough, in the unit of the curve (0: none)."""

    load: float
    y: float
    second: float
    second_y: float
    known: bool  # False: the table is too short


@leaf
def serves(lowest: Lowest, rim: float, inner: float) -> bool:
    """Return whether the lowest loads up to a rim are those up to an inner one too, whose own load is no close one.

    A thousandth from a trough the load has risen by more than is looked at.
    """
    return inner == rim or (lowest.known and max(lowest.y, lowest.second_y) < 0.999 * inner < rim)


@leaf
def deeper(best: Lowest, load: float, y: float) -> Lowest:
    """Return the lowest two, another trough taken in."""
    if load < best.load:
        return Lowest(load, y, best.load, best.y, True)
    if load < best.second:
        return Lowest(best.load, best.y, load, y, True)
    return best


@leaf
def _envelope(curve: Curve, crest: float, i: int) -> float:
    """Return a load below all loads near the lower edge of bin i; `crest` bounds (y E - g (U - U1))/(y E)."""
    nodes, table = curve.table.nodes, curve.table
    return nodes[T, i] * ((1.0 - table.share) * curve.B * nodes[P, i] - crest * nodes[Y, i] * nodes[E, i])


@leaf
def _load_at(curve: Curve, i: int) -> float:
    """Return the load at the lower edge of bin i."""
    nodes, table = curve.table.nodes, curve.table
    smooth = (1.0 - table.share) * curve.B * nodes[P, i]
    return nodes[T, i] * (smooth + curve.g * (nodes[U, i] - nodes[U1, i]) - nodes[Y, i] * nodes[E, i])


@leaf
def _may_dip(curve: Curve, crest: float, i: int, before: float, after: float, best: Lowest) -> bool:
    """Return whether bin i, at whose edges D is `before` and `after`, may have a trough among the lowest."""
    may = (before < 0.0) == (after < 0.0) and min(abs(before), abs(after)) <= swing_in(curve, i)
    nodes = curve.table.nodes
    if before < 0.0 <= after:
        # the cubic through values and slopes, at the zero of its linear slope, tells whether the trough can matter
        width = nodes[Y, i + 1] - nodes[Y, i]
        s = before / (before - after)
        r = 1.0 - s
        first, last = nodes[T, i] * before * width, nodes[T, i + 1] * after * width
        ends = _load_at(curve, i) * (1.0 + 2.0 * s) * r * r + _load_at(curve, i + 1) * s * s * (3.0 - 2.0 * s)
        estimate = ends + first * s * r * r - last * s * s * r
        may = estimate - _MARGIN * crest * nodes[T, i + 1] * nodes[Y, i + 1] * nodes[E, i + 1] <= best.load
    return may


@kernel
def _trough(curve: Curve, i: int, before: float, after: float, rim: float, best: Lowest) -> Lowest:
    """Take in the trough of bin i, at whose edges D is `before` and `after`, if there is one within the rim."""
    low, high, found = -1.0, 1.0, True
    guess = 2.0 * before / (before - after) - 1.0
    if (before < 0.0) == (after < 0.0):
        found, t, _ = pair_in(curve, i, -1.0 if before < 0.0 else 1.0)
        if before < 0.0:
            high = t
        else:
            low = t
        guess = 0.5 * (low + high)
    if found:
        t, _ = zero_in(curve, i, low, high, guess, True)
        y, (_, load) = radius_of(curve.table, i, t), depth_and_load(curve, i, t)
        if y <= rim:
            best = deeper(best, load, y)
    return best


@leaf
def envelope_place(curve: Curve) -> float:
    """Return the radius at which the envelope of the load is least."""
    table = curve.table
    crest, power = 1.0 - curve.g * table.lowest, table.exponent - 0.5 * (1.0 - table.k)
    return (crest * 0.5 * (3.0 + table.k) / (curve.B * table.exponent)) ** (1.0 / power)


@leaf
def lowest_load(curve: Curve, rim: float, first: int, last: int) -> Lowest:
    """Return the lowest load for 0 < y <= rim, where the bins `first` to `last` - 1 of the table are filled.

    The bin of a rim within the table is filled as well. `known` is False if others were needed.
    """
    curve = load_curve(curve)
    table = curve.table
    crest = 1.0 - curve.g * table.lowest
    end = end_of(table)
    middle, limit = envelope_place(curve), table.bins
    best = Lowest(0.0, 0.0, 0.0, 0.0, True)
    if rim <= end:
        i, t = place_of(table, rim)
        best, limit = deeper(best, depth_and_load(curve, i, t)[1], rim), i + 1
    unknown = Lowest(0.0, 0.0, 0.0, 0.0, False)
    if rim > end and middle > end:
        return unknown
    start = min(bin_of(table, middle), limit - 1)
    if not first <= start < last:
        return unknown
    i, here = start, _load_at(curve, start)  # the lowest load is no higher, even where the first trough lies inwards
    before = first_slope = slope_at(curve, start)
    while i < limit and (i == start or _envelope(curve, crest, i) <= min(best.load, here)):
        if i >= last:
            return unknown
        after = slope_at(curve, i + 1)
        if _may_dip(curve, crest, i, before, after, best):
            best = _trough(curve, i, before, after, rim, best)
        before = after
        i += 1
    if i >= table.bins and rim > end and _envelope(curve, crest, table.bins) <= min(best.load, here):
        return unknown
    i, after = start - 1, first_slope
    while i >= 0 and _envelope(curve, crest, i + 1) <= best.load:
        if i < first:
            return unknown
        before = slope_at(curve, i)
        if _may_dip(curve, crest, i, before, after, best):
            best = _trough(curve, i, before, after, rim, best)
        after = before
        i -= 1
    return best
