"""The slopes of jumps of any length on a general curve, and of sums over its waves.

At a fixed pattern the slopes of a wave are as smooth a function of its number as its loss, so that they are summed as
the losses are (waves/general_sum.py): all of them at once, since they stand between the same places.
"""

from typing import NamedTuple

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
from gradhesion.core.types import Slopes
from gradhesion.core.waves.general import PASSING, UP, Waves, room_for_waves, step_between, step_of_wave
from gradhesion.core.waves.general_jump import _INNER, LONG, near_zero
from gradhesion.core.waves.general_sum import add_waves, common_size, fill_wave


class WaveSlopes(NamedTuple):
    """The summands over waves: the slopes of the losses of their jumps, by the numbers of jump_slopes.py."""

    change: Change
    jump: Jump  # the one that passes the waves, NO_JUMP else


@fill_wave.answers(WaveSlopes)
@kernel()
def slopes_of_step(
    basis: Basis, curve: Series, term: WaveSlopes, waves: Waves, wave: float, found: Slopes
) -> tuple[float, int]:
    """Put the slopes of the losses of `step_of_wave` (waves/general.py), in 2 pi l^2 dgamma; counts no jumps."""
    change, jump = term
    found[:] = 0.0
    if waves.kind == PASSING:
        drop_slopes(basis, curve, change, jump, (0.0, 1.0), wave, 1.0, found)
        return 0.0, 0
    _, _, pattern = step_of_wave(basis, curve, waves, wave, NO)
    if pattern < 0:
        return 0.0, pattern
    up, before = waves.kind == UP, wave - 1.0
    (_, level, place), rows, count = step_between(basis, curve, waves, wave)
    sign, end, end_level = (1.0, END, END_LEVEL) if up else (-1.0, START, START_LEVEL)
    for j in range(count):
        i = j if up else count - 1 - j
        if sign * rows[end_level, i] > sign * level:
            start = place_left(basis, curve, place, before, 0.0)
            x = find_landing(basis, curve, start, rows[START, i], rows[END, i], before)
            add_drop(basis, curve, change, place, before, x, sign, found)
            level, place = rows[end_level, i], rows[end, i]
    return 0.0, pattern


@common_size.answers(WaveSlopes)
@kernel()
def size_of_slopes(_term: WaveSlopes, sizes: Slopes) -> float:
    """Return the size of the largest by a number of the curve: one may be 0 but for rounding."""
    return float(max(sizes[BEND], sizes[GAIN], sizes[SHARE], sizes[EXPONENT]))


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
    add_waves(basis, curve, WaveSlopes(change, jump), waves, begin, end, middle)
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
