"""Sums over waves up to any of them, from the same samples for all.

Every rim of a long curve ends its sum at another wave. What a jump loses is a smooth function e of the wave's index
(waves/cosine.py), so that the run of waves is cut into panels, four to eight times as far from the branch point
`inner` of waves/cosine_sum.py at their end as at their begin, and two more, at a half and at 0.85 of the way, before
the outer one. In each panel e is a polynomial through 16 places, in v or y of that module, and so is its integral, and

    sum_{w=p}^{q} e_w = S + [ int e dw - (e'/24 - 7 e'''/5760 + 31 e^(5)/967680) ]_{begin of the panel}^{q+1/2}

costs no further sample; S is the sum up to the panel. First waves within twelve of the branch point are summed one by
one. A panel is filled when a sum first ends in it. Its places depend on the curve alone, so that a rim has the same
value, to the last bit, whatever rims share its curve.

Against the sum wave by wave, of 10^2 to 2 10^4 of them: 1e-13 of the loss, mostly 1e-15 (test_cosine_running.py).
"""

import math
from typing import Any, Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NONE, constant, kernel
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.numbers.chebyshev import chebyshev_fit
from gradhesion.core.numbers.lanes import chosen, lane_of, load, root_of
from gradhesion.core.types import Floats, Table
from gradhesion.core.waves.cosine_at_once import BATCH, LOSSES, WAVES, Batch, jumps_in_a_row, jumps_of_batch
from gradhesion.core.waves.cosine_sum import branch_points, sum_of_waves

_SINGLE: Final = 12
"""Waves that are summed one by one at most at the begin of a run."""
_CLEAR: Final = 12.5
"""Waves from the inner branch point, and from `_INNERMOST`, to the first panel."""
_INNERMOST: Final = 8.0
_NEAREST: Final = 6.0
"""Waves from the inner branch point at which the first panel may begin at the nearest."""
_TERMS: Final = BATCH
_PLACES, _FIT = chebyshev_fit(_TERMS, _TERMS)
_FIRST_GROWTH: Final = 4.0
_GROWTH: Final = 8.0
"""Distance of the end of a panel from the inner branch point over that of its begin: of the first one, and others."""
_MIDDLE: Final = 0.5
_LATE: Final = 0.85
"""Begins of the last two panels, in parts of the way from one branch point to the other."""
_OUTER_HALF: Final = 0.7
"""Part of the way to `_MIDDLE` from which on a panel is a polynomial in y."""
_LEAST: Final = 8.0
"""Waves that a panel has at least."""
_BEFORE: Final = 8.0
"""Waves from the last one of any sum to the outer branch point, at least."""
_MOST: Final = 2.0**52
"""Waves up to which a double resolves half a wave."""
_LINKED: Final = 3
"""Panels in a row, of which the first one begins with a sum of its own and the others with that of the one before."""
_PANELS: Final = 32
NOT_BEGUN: Final = constant(-1)
BEGIN, END, BASE, LOW, HIGH, IN_Y, _AT_BEGIN, _LOSS, _INTEGRAL = 0, 1, 2, 3, 4, 5, 6, 8, 24
"""A panel: where it begins and ends, the sum up to its begin (NaN: not filled), the variable at both ends,
which one it is, `_up_to` at the begin, and the coefficients of the loss and of its integral."""
_COLUMNS: Final = 41
Panel: TypeAlias = Floats
"""One panel, of shape (_COLUMNS,)."""
SUMS: Final = np.dtype(
    [
        ("first", "f8"),  # the first wave
        ("inner", "f8"),  # the branch points
        ("outer", "f8"),
        ("count", "i8"),  # the number of panels, -1 before the sums have begun
        ("samples", "i8"),  # the waves whose jump has been found
        ("single", "i8"),  # how many of the first waves are to be summed one by one,
        ("known", "i8"),  # how many are,
        ("totals", "f8", (_SINGLE,)),  # and their sums up to each
        ("panels", "f8", (_PANELS, _COLUMNS)),  # the first row is not used
    ]
)
"""The record of the sums in one direction."""
Sums: TypeAlias = Any
"""One record `SUMS`; numba knows its fields."""
_AROUND: Final = np.array([-1.25, -0.75, -0.25, 0.25, 0.75, 1.25, 1.25, 1.25])
"""Waves around a half wave at which the loss gives its derivatives; the last ones fill eight."""


@kernel()
def room_for_sums() -> Any:
    """Return room for the sums outwards and inwards of one curve, records `SUMS` of shape (2,); none has begun."""
    sums = np.empty(2, SUMS)
    for i in range(2):
        sums[i].count = NOT_BEGUN
    return sums


@kernel()
def begin_sums(table: Table, curve: Cosine, sums: Sums, first: float, outwards: bool, final: float) -> None:
    """Lay the panels of the sums that begin with the jump of wave `first`; `sums` is the record of one direction.

    `final` is the last arch on which the curve folds. There are no panels where the first wave stands well within the
    inner branch point (with k next to 1 and waves that are much steeper than adhesion is strong): each sum is then one
    of its own.
    """
    sums.first, sums.samples, sums.known = first, NONE, NONE
    sums.inner, sums.outer = branch_points(table, curve, final, outwards)
    inner, outer = max(0.0, sums.inner), sums.outer
    sums.count, sums.single = NONE, NONE
    single = max(0.0, min(float(_SINGLE), math.ceil(max(inner, _INNERMOST) + _CLEAR - first)))
    if first + single < inner + _NEAREST:
        return
    sums.single = int(single)
    begin = first + (single - 0.5)
    middle = inner + _MIDDLE * (outer - inner)
    late = inner + _LATE * (outer - inner)
    count = 0
    while begin < outer and begin < _MOST:
        end = math.floor(inner + (_GROWTH if count > 0 else _FIRST_GROWTH) * (begin - inner)) + 0.5
        if end >= _OUTER_HALF * (middle - inner) + inner:
            end = math.floor(middle) + 0.5 if begin + _LEAST < middle else math.floor(late) + 0.5
            if begin + _LEAST >= late:
                end = outer
        count += 1
        if count == _PANELS or not begin < end:
            return
        panel = sums.panels[count]
        panel[BEGIN], panel[END], panel[BASE] = begin, end, math.nan
        panel[IN_Y] = 1.0 if begin >= inner + _OUTER_HALF * (middle - inner) else 0.0
        begin = end
    sums.count = count


@kernel(contract=True)
def _variable(sums: Sums, panel: Panel, wave: float) -> float:
    """Return y or v, of a wave or of eight (numbers/lanes.py); `panel` is one row of the panels of `sums`."""
    if panel[IN_Y] > 0.0:
        rest = 1.0 - root_of(root_of(wave / sums.outer))
        return root_of(chosen(rest, 0.0, 0.0, rest))
    return root_of(wave - sums.inner)


@kernel(contract=True)
def _series(panel: Panel, at: int, terms: int, t: float) -> float:
    """Return the Chebyshev series of `terms` coefficients, from column `at` of a panel on, at t, a number or eight."""
    here, before = 0.0 * t, 0.0 * t
    for j in range(terms - 1, 0, -1):
        here, before = panel[at + j] + 2.0 * t * here - before, here
    return panel[at] + t * here - before


@kernel(contract=True)
def _place(sums: Sums, panel: Panel, wave: float) -> float:
    """Return the place of a wave, or of eight, on the [-1, 1] of its panel."""
    low, high = panel[LOW], panel[HIGH]
    return (2.0 * _variable(sums, panel, wave) - low - high) / (high - low)


@kernel(contract=True)
def _up_to(sums: Sums, panel: Panel, wave: float) -> float:
    """Return the integral up to a half wave less e'/24 - 7 e'''/5760 + 31 e^(5)/967680 there."""
    total = _series(panel, _INTEGRAL, _TERMS + 1, _place(sums, panel, wave))
    around = _series(panel, _LOSS, _TERMS, _place(sums, panel, wave + load(_AROUND, 0)))
    one = lane_of(around, 3) - lane_of(around, 2)
    two, three = lane_of(around, 4) - lane_of(around, 1), lane_of(around, 5) - lane_of(around, 0)
    third, fifth = two - 3.0 * one, three - 5.0 * two + 10.0 * one
    slope = one - third / 24.0 + 3.0 * fifth / 640.0  # by half a wave
    return total - (slope / 12.0 - 7.0 / 720.0 * (third - fifth / 8.0) + 31.0 / 30240.0 * fifth)


@kernel()
def _fill(table: Table, curve: Cosine, sums: Sums, panel: Panel, outwards: bool, room: Batch) -> None:
    """Put the coefficients of the loss, in 2 pi l^2 dgamma, and of its integral over waves into a panel of `sums`."""
    low, high = _variable(sums, panel, panel[BEGIN]), _variable(sums, panel, panel[END])
    panel[LOW], panel[HIGH] = low, high
    half = 0.5 * (high - low)
    panel[_LOSS : _INTEGRAL + _TERMS + 1] = 0.0
    steps, rates = np.zeros(_TERMS + 2), np.zeros(_TERMS)
    for i in range(_TERMS):
        variable = 0.5 * (low + high) + half * _PLACES[i]
        rest = 1.0 - variable * variable
        is_y = panel[IN_Y] > 0.0
        room[WAVES + i] = sums.outer * rest**4 if is_y else sums.inner + variable * variable
        rates[i] = half * (-8.0 * sums.outer * variable * rest**3 if is_y else 2.0 * variable)
    jumps_of_batch(table, curve, outwards, room)
    for i in range(_TERMS):
        loss = room[LOSSES + i]
        for j in range(_TERMS):
            panel[_LOSS + j] += _FIT[j, i] * loss
            steps[j] += _FIT[j, i] * (loss * rates[i])
    sums.samples += _TERMS
    panel[_INTEGRAL + 1] = steps[0] - 0.5 * steps[2]
    for j in range(2, _TERMS + 1):
        panel[_INTEGRAL + j] = 0.5 / j * (steps[j - 1] - steps[j + 1])
    panel[_AT_BEGIN] = _up_to(sums, panel, panel[BEGIN])


@kernel()
def _first_waves(table: Table, curve: Cosine, sums: Sums, count: int, outwards: bool, room: Batch) -> float:
    """Return the sum over `count` of the first waves, in 2 pi l^2 dgamma; all that are single are found at once."""
    if sums.known == 0 and count > 0:
        last = min(sums.first + (sums.single - 1.0), max(sums.first, sums.outer - _BEFORE))
        jumps_in_a_row(table, curve, sums.first, last, outwards, room)
        total = 0.0
        for i in range(sums.single):
            total += room[LOSSES + i]
            sums.totals[i] = total
        sums.samples += sums.single
        sums.known = sums.single
    return sums.totals[count - 1] if count > 0 else 0.0


@kernel()
def sum_up_to(table: Table, curve: Cosine, sums: Sums, last: float, outwards: bool, final: float, room: Batch) -> float:
    """Return the sum of what the jumps from the first wave to wave `last` lose, in 2 pi l^2 dgamma.

    `last` stands eight waves or more before the outer branch point; `sums` is the record that `begin_sums` has begun
    for the direction; `final` is the last arch on which the curve folds, and `room` that of waves/cosine_at_once.py.
    """
    count = last - sums.first + 1.0
    if count <= sums.single:
        return _first_waves(table, curve, sums, max(0, int(count)), outwards, room)
    if sums.count < 1:
        return sum_of_waves(table, curve, sums.first, last, outwards, final, room)
    panels = sums.panels
    number = 1
    while number < sums.count and panels[number, END] < last:
        number += 1
    # inwards to a panel that is filled, or whose sum is found without the one before it
    start = number
    while math.isnan(panels[start, BASE]) and (start - 1) % _LINKED > 0:
        start -= 1
    for i in range(start, number + 1):
        panel = panels[i]
        if not math.isnan(panel[BASE]):
            continue
        if i == 1:
            base = _first_waves(table, curve, sums, sums.single, outwards, room)
        elif (i - 1) % _LINKED == 0:
            base = sum_of_waves(table, curve, sums.first, panel[BEGIN] - 0.5, outwards, final, room)
        else:
            before = panels[i - 1]
            base = before[BASE] + (_up_to(sums, before, before[END]) - before[_AT_BEGIN])
        _fill(table, curve, sums, panel, outwards, room)
        panel[BASE] = base
    panel = panels[number]
    return panel[BASE] + (_up_to(sums, panel, last + 0.5) - panel[_AT_BEGIN])
