"""The slopes of jumps of any length on a general curve, and of sums over its waves.

At a fixed pattern the slopes of a wave are as smooth a function of its number as its loss, so that what sums the losses
(waves/general_sum.py) sums them: all of them at once, since they stand between the same places.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.branches import END, START
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_branches import END_LEVEL, START_LEVEL
from gradhesion.core.curve.general_energy import find_landing, place_left
from gradhesion.core.sensitivities.general_jump_slopes import (
    NOTHING,
    Change,
    Jump,
    add_drop,
    add_from_zero,
    drop_slopes,
    jump_from,
    parts_of,
)
from gradhesion.core.sensitivities.jump_slopes import BEND, EXPONENT, GAIN, SHARE, SLOPES
from gradhesion.core.types import Floats, Slopes
from gradhesion.core.waves.cosine_sum import limit_terms
from gradhesion.core.waves.general import (
    PASSING,
    UP,
    Waves,
    branches_of_wave,
    highest_end,
    lowest_start,
    room_for_waves,
    step_of_wave,
)
from gradhesion.core.waves.general_jump import _INNER, LONG, near_zero
from gradhesion.core.waves.general_sum import (
    _DIRECT,
    _EDGE,
    _MOST_STEPS,
    _NARROW,
    _PLACES,
    _POINTS,
    _ROOM,
    _TOLERANCE,
    _angle_of,
    _integrate,
    _last_of_run,
    _wave_at,
)

_TOP: Final = 64


@kernel()
def slopes_of_step(
    basis: Basis, curve: Series, change: Change, waves: Waves, jump: Jump, wave: float, found: Slopes
) -> int:
    """Put the slopes of what `step_of_wave` of waves/general.py adds into `found`; return the pattern of the jumps.

    `jump` is the one that passes the wave, NO_JUMP else; `found` is of shape (SLOPES,), in 2 pi l^2 dgamma.
    """
    kind, cut, _, work = waves
    found[:] = 0.0
    if kind == PASSING:
        drop_slopes(basis, curve, change, jump, (0.0, 1.0), wave, 1.0, found)
        return 0
    _, _, pattern = step_of_wave(basis, curve, waves, wave, NO)
    if pattern < 0:
        return pattern
    _, _, rows = work
    before = wave - 1.0
    inner = branches_of_wave(basis, curve, before, cut, work, rows[0])
    outer = branches_of_wave(basis, curve, before, cut + 1.0, work, rows[1])
    if kind == UP:
        first = highest_end(rows[0], inner)
        level, place = rows[0, END_LEVEL, first], rows[0, END, first]
        for i in range(outer):
            if rows[1, END_LEVEL, i] > level:
                start = place_left(basis, curve, place, before, 0.0)
                x = find_landing(basis, curve, start, rows[1, START, i], rows[1, END, i], before)
                add_drop(basis, curve, change, place, before, x, 1.0, found)
                level, place = rows[1, END_LEVEL, i], rows[1, END, i]
        return pattern
    first = lowest_start(rows[1], outer)
    level, place = rows[1, START_LEVEL, first], rows[1, START, first]
    for i in range(inner - 1, -1, -1):
        if rows[0, START_LEVEL, i] < level:
            start = place_left(basis, curve, place, before, 0.0)
            x = find_landing(basis, curve, start, rows[0, START, i], rows[0, END, i], before)
            add_drop(basis, curve, change, place, before, x, -1.0, found)
            level, place = rows[0, START_LEVEL, i], rows[0, START, i]
    return pattern


@kernel()
def _integrals_of_run(
    basis: Basis,
    curve: Series,
    change: Change,
    waves: Waves,
    jump: Jump,
    run: tuple[float, float],
    scales: Floats,
    total: Slopes,
) -> tuple[bool, int, Floats, int, int]:
    """Add the integrals over a run without its ends to `total`, as `_integral_of_run` of waves/general_sum.py.

    `scales` are the sizes of the largest parts so far; both are of shape (SLOPES,), in 2 pi l^2 dgamma.

    Returns
    -------
    Whether it is done, the pattern, the runs to take instead, of shape (n, 2), their number, and the steps that it
    took.
    """
    first, last = run
    low = math.log(first - 0.5)
    span = math.log(last + 0.5) - low
    runs, panels = np.empty((2 * _POINTS, 2)), np.empty((_TOP, 2))
    panels[0, 0] = _angle_of(first + _EDGE - 0.5, low, span)
    panels[0, 1] = _angle_of(last - _EDGE + 0.5, low, span)
    top, steps, pattern = 0, 0, 0
    sums, part, rests, found = np.zeros(SLOPES), np.empty(SLOPES), np.empty(SLOPES), np.empty(SLOPES)
    values, places, patterns = np.empty((SLOPES, _POINTS)), np.empty(_POINTS), np.empty(_POINTS, np.int64)
    while top >= 0:
        begin, end = panels[top]
        top -= 1
        half = 0.5 * (end - begin)
        for i in range(_POINTS):
            angle = begin + half * (1.0 + _PLACES[i])
            places[i] = _wave_at(angle, low, span)
            patterns[i] = slopes_of_step(basis, curve, change, waves, jump, places[i], found)
            values[:, i] = found * (places[i] * 0.5 * span * math.sin(angle))
        steps += _POINTS
        pattern = patterns[0]
        count, start = 0, first
        for i in range(_POINTS - 1):
            if patterns[i + 1] != patterns[i]:
                here, there = max(start, np.floor(places[i])), min(last, np.floor(places[i + 1]) + 1.0)
                if there > here:
                    here, taken = _last_of_run(basis, curve, waves, here, there)
                    steps += taken
                    runs[count, 0], runs[count, 1] = start, here
                    start = here + 1.0
                    count += 1
        if count > 0:
            runs[count, 0], runs[count, 1] = start, last
            return False, 0, runs, count + 1, steps
        for j in range(SLOPES):
            part[j], rests[j] = _integrate(values[j])
            part[j] *= half
            scales[j] = max(scales[j], abs(part[j]))
        common = max(scales[BEND], scales[GAIN], scales[SHARE], scales[EXPONENT])  # one may be 0 but for rounding
        settled = True
        for j in range(SLOPES):
            settled = settled and half * rests[j] <= _TOLERANCE * max(common, scales[j])
        if settled:
            sums += part
        elif places[_POINTS - 1] - places[0] < _NARROW or top + 2 >= _TOP:
            begin, end = np.floor(places[0]), np.floor(places[_POINTS - 1]) + 1.0
            runs[0, 0], runs[0, 1] = first, begin - 1.0
            runs[1, 0], runs[1, 1] = begin, end
            runs[2, 0], runs[2, 1] = end + 1.0, last
            return False, 0, runs, 3, steps
        else:
            panels[top + 1, 0], panels[top + 1, 1] = begin, begin + half
            panels[top + 2, 0], panels[top + 2, 1] = begin + half, end
            top += 2
    total += sums
    return True, pattern, runs, 0, steps


@kernel()
def _add_ends(
    basis: Basis,
    curve: Series,
    change: Change,
    waves: Waves,
    jump: Jump,
    run: tuple[float, float],
    pattern: int,
    total: Slopes,
) -> bool:
    """Add the waves at both ends of a run, and Euler's and Maclaurin's terms; return whether all have one pattern.

    `total` is of shape (SLOPES,), in 2 pi l^2 dgamma.
    """
    begin, end = run
    found, values, even = np.empty(SLOPES), np.empty((SLOPES, 6)), True
    for side in range(2):
        for i in range(_EDGE + 3):
            wave = begin + i if side == 0 else end - i
            there = slopes_of_step(basis, curve, change, waves, jump, wave, found)
            even = even and there == pattern
            if i < _EDGE:
                total += found
            if i >= _EDGE - 3:
                values[:, i - _EDGE + 3 if side == 0 else _EDGE + 2 - i] = found
        for j in range(SLOPES):
            total[j] += limit_terms(values[j]) if side == 0 else -limit_terms(values[j])
    return even


@kernel()
def add_waves(
    basis: Basis, curve: Series, change: Change, waves: Waves, jump: Jump, first: float, last: float, total: Slopes
) -> None:
    """Add the slopes of the waves `first` to `last`, as `sum_of_waves` of waves/general_sum.py; NaN if not regular.

    `total` is of shape (SLOPES,), in 2 pi l^2 dgamma.
    """
    stack = np.empty((_ROOM, 2))
    stack[0, 0], stack[0, 1] = first, last
    found, part, scales = np.empty(SLOPES), np.empty(SLOPES), np.zeros(SLOPES)
    top, steps = 0, 0
    while top >= 0:
        begin, end = stack[top]
        top -= 1
        if end - begin < _DIRECT:
            wave = begin
            while wave <= end:
                if slopes_of_step(basis, curve, change, waves, jump, wave, found) < 0:
                    total[:] = math.nan
                    return
                total += found
                wave += 1.0
                steps += 1
            continue
        part[:] = 0.0
        done, pattern, runs, count, taken = _integrals_of_run(
            basis, curve, change, waves, jump, (begin, end), scales, part
        )
        steps += taken
        if steps > _MOST_STEPS or (done and pattern < 0) or top + max(count, 3) >= _ROOM:
            total[:] = math.nan
            return
        for i in range(count):
            if runs[i, 1] >= runs[i, 0]:
                top += 1
                stack[top, 0], stack[top, 1] = runs[i, 0], runs[i, 1]
        if not done:
            continue
        steps += 2 * _EDGE + 6
        if _add_ends(basis, curve, change, waves, jump, (begin, end), pattern, part):
            total += part
        else:  # a pattern of some waves at an end: these one by one
            stack[top + 1, 0], stack[top + 1, 1] = begin, begin + _EDGE + 3.0
            stack[top + 2, 0], stack[top + 2, 1] = begin + _EDGE + 4.0, end - _EDGE - 4.0
            stack[top + 3, 0], stack[top + 3, 1] = end - _EDGE - 3.0, end
            top += 3


@kernel()
def _add_passage(
    basis: Basis,
    curve: Series,
    change: Change,
    jump: Jump,
    way: tuple[float, float],
    whole: float,
    sign: float,
    total: Slopes,
) -> None:
    """Add `sign` times the slopes of a long jump between the x of its way beyond whole waves, from _INNER on.

    `total` is of shape (SLOPES,), in 2 pi l^2 dgamma.
    """
    low, high = way
    begin, end = np.ceil(whole + low), np.floor(whole + high) - 1.0
    inner, outer = begin - 1.0, end + 1.0
    drop_slopes(basis, curve, change, jump, ((whole - inner) + low, 1.0), inner, sign, total)
    drop_slopes(basis, curve, change, jump, (0.0, (whole - outer) + high), outer, sign, total)
    middle = np.zeros(SLOPES)
    waves = Waves(PASSING, 0.0, jump.left, room_for_waves(basis.series))
    add_waves(basis, curve, change, waves, jump, begin, end, middle)
    total += sign * middle


@kernel()
def add_jump(
    basis: Basis, curve: Series, change: Change, start: float, end: float, whole: float, total: Slopes
) -> None:
    """Add the slopes of a jump that leaves the curve at whole + start and ends at whole + end > 0."""
    _, _, series = basis
    sign = 1.0 if end > start else -1.0
    start, end, whole = near_zero(start, end, whole)
    if abs(end - start) <= LONG or series.shape[0] == 0:
        add_drop(basis, curve, change, start, whole, end, sign, total)
        return
    jump = jump_from(basis, curve, change, start, whole)
    low, high = min(start, end), max(start, end)
    if whole + low < _INNER:
        drop_slopes(basis, curve, change, jump, (whole + low, _INNER), 0.0, sign, total)
        low = _INNER - whole
    _add_passage(basis, curve, change, jump, (low, high), whole, sign, total)


@kernel()
def add_jump_from_zero(
    basis: Basis, curve: Series, change: Change, x: float, whole: float, inwards: bool, total: Slopes
) -> None:
    """Add the slopes of the jump-out from whole + x (inwards), 0 under a dead load, or of the jump-in that ends there.

    The jump-out is at the coordinate of its place, the jump-in at 0.
    """
    _, _, series = basis
    _, _, _, alpha, _ = curve
    if inwards and alpha == 0.0:
        return
    here = coordinate(basis, curve, x, whole)
    parts = parts_of(basis, curve, change, x, whole)
    level, moved, sign = (here, parts, -1.0) if inwards else (0.0, NOTHING, 1.0)
    if whole + x <= LONG or series.shape[0] == 0:
        add_from_zero(basis, curve, change, moved, whole + x, level, sign, total)
        return
    more = (parts[0] - moved[0], parts[1] - moved[1], parts[2] - moved[2], 0.0)
    add_from_zero(basis, curve, change, moved, _INNER, level, sign, total)
    jump = Jump(place_left(basis, curve, x, whole, here - level), more, moved[3])
    _add_passage(basis, curve, change, jump, (_INNER - whole, x), whole, sign, total)
