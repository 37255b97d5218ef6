"""The contribution of one wave far from zero contact to a cycle: a smooth function of its number.

A place is whole waves and a part, and phases come from the part alone (harmonics/series.py): the number of a wave may
be any real one. Waves are cut where the leading term of V,

    z^c F(u),    F = C sum n^(1+c) [cos_n cos(2 pi n u - phi) - sin_n sin(2 pi n u - phi)],

is least. The rest of D changes slowly, so that there the coordinate falls as long as it falls anywhere in the wave:
every branch lies within one wave.

Loading goes from the highest end of branches of each wave to that of the next, past every end that is higher than all
before; unloading from the lowest start to that of the wave before.
"""

import math
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, YES, constant, kernel
from gradhesion.core.curve.branches import END, START
from gradhesion.core.curve.cells import MOST
from gradhesion.core.curve.general import Basis, Series, coordinate, size, slope
from gradhesion.core.curve.general_branches import END_LEVEL, START_LEVEL, Rows
from gradhesion.core.curve.general_energy import Left, drop, find_landing, place_left
from gradhesion.core.curve.general_folds import folds_of_cell, refine, room
from gradhesion.core.harmonics.series import highest_harmonic, sums
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics, Table


class Room(NamedTuple):
    """Arrays that waves are worked on in."""

    search: Any  # of a search of folds (curve/general_folds.py)
    zeros: Floats  # folds of a cell, of shape (MOST,)
    rows: Floats  # the branches of two waves in the rows of curve/general_branches.py, of shape (2, 4, branches)


class Waves(NamedTuple):
    """Which contribution of waves to a cycle is computed."""

    kind: int  # UP, DOWN or PASSING
    cut: float  # where waves are cut, 0 .. 1
    left: Left  # the place that a jump leaves which passes them; NOWHERE else
    work: Room  # room for waves


NOWHERE: Final = Left(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
Step: TypeAlias = tuple[float, float, int]
"""The loss of the jumps of a wave, their number, and their pattern: 0 for none, -1 where they are not regular."""
UP, DOWN, PASSING = map(constant, range(3))
"""Loading through a wave, unloading through it, and a jump that passes it."""
NEAREST: Final = 8.0
"""The innermost wave: z > 40 there."""
_ROUNDING: Final = 32.0 * 2.0**-52
"""Rounding of the difference of two coordinates, in parts of their size."""
_SAMPLES: Final = 16
_HALVINGS: Final = 50
_STEPS: Final = 8
_LEVEL: Final = 1e-8
"""Distance from a crest in z, whose square is below rounding."""
_MODULUS: Final = 2_147_483_647


@kernel()
def _leading(table: Table, series: Harmonics, u: float) -> tuple[float, float]:
    """Return F and its slope over 2 pi."""
    value, rate = 0.0, 0.0
    power = 0.5 * (3.0 - table.k)
    for i in range(series.shape[0]):
        n = series[i, 0]
        sine, cosine = sine_cosine_of_turns(n * u)
        c = cosine * table.cos_phase + sine * table.sin_phase
        s = sine * table.cos_phase - cosine * table.sin_phase
        value += n**power * (series[i, 1] * c - series[i, 2] * s)
        rate -= n ** (power + 1.0) * (series[i, 1] * s + series[i, 2] * c)
    return value, rate


@kernel()
def cut_of(table: Table, series: Harmonics) -> float:
    """Return u in 0 .. 1 at which F is least."""
    samples = int(_SAMPLES * highest_harmonic(series))
    least, best = math.inf, 0
    for j in range(samples):
        value, _ = _leading(table, series, j / samples)
        if value < least:
            least, best = value, j
    low, high = (best - 1.0) / samples, (best + 1.0) / samples
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        _, rate = _leading(table, series, middle)
        if rate < 0.0:
            low = middle
        else:
            high = middle
    cut = 0.5 * (low + high)
    return cut - np.floor(cut)


@kernel()
def room_for_waves(series: Harmonics) -> Room:
    """Return room for the waves of a series, rows (n, cos, sin) of shape (harmonics, 3)."""
    return Room(room(), np.empty(MOST), np.empty((2, 4, 2 * int(highest_harmonic(series)) + 8)))


@kernel()
def falls_at_cut(basis: Basis, curve: Series, cut: float, wave: float) -> bool:
    """Return whether a wave begins with a fall."""
    value, _, _ = slope(basis, curve, cut, wave)
    return value < 0.0


@kernel()
def _branch_of_one_harmonic(basis: Basis, curve: Series, wave: float, low: float, at_low: float, rows: Rows) -> int:
    """Do what `branches_of_wave` does for one harmonic: D has one crest a wave, and rises and falls monotonously.

    Of what else is in D the rise over a wave is a part 3/z, at most, of what the waves themselves rise, or no fold is
    left.
    """
    table, _, series = basis
    _, _, g, _, _ = curve
    z = TWO_PI * (wave + low)
    bend = g * table.amplitude * math.hypot(series[0, 1], series[0, 2]) * z * amplitude_power(table, z)
    high = low + 1.0
    at_high, _, _ = slope(basis, curve, high, wave)
    if at_high >= 0.0:
        return -1
    crest = low + 0.5
    value, rate, _ = slope(basis, curve, crest, wave)
    for _ in range(_STEPS):
        step = rate / bend
        if value > 0.0 or abs(step) < _LEVEL:
            break
        crest += min(max(step / TWO_PI, -0.1), 0.1)
        value, rate, _ = slope(basis, curve, crest, wave)
    if value <= 0.0:
        return 0
    rows[START, 0], _ = refine(basis, curve, _between(low, crest, at_low, value), low, crest, YES, wave)
    rows[END, 0], _ = refine(basis, curve, _between(high, crest, at_high, value), crest, high, NO, wave)
    rows[START_LEVEL, 0] = coordinate(basis, curve, rows[START, 0], wave)
    rows[END_LEVEL, 0] = coordinate(basis, curve, rows[END, 0], wave)
    return 1


@kernel()
def _between(trough: float, crest: float, below: float, above: float) -> float:
    """Return about where a half wave of a cosine is zero, from its values at its two ends."""
    return trough + (crest - trough) * math.acos(1.0 - 2.0 * below / (below - above)) / math.pi


@kernel()
def branches_of_wave(basis: Basis, curve: Series, wave: float, low: float, work: Room, rows: Rows) -> int:
    """Put the branches between wave + low and wave + low + 1 into `rows`; return their number, -1 if one is cut."""
    _, _, series = basis
    search, zeros, _ = work
    cells = 4 * int(highest_harmonic(series))
    value, _, _ = slope(basis, curve, low, wave)
    if value >= 0.0:
        return -1
    if series.shape[0] == 1 and series[0, 0] == 1.0:
        return _branch_of_one_harmonic(basis, curve, wave, low, value, rows)
    count, inside = 0, False
    for i in range(cells):
        begin, end = low + i / cells, low + (i + 1) / cells
        found, value, _ = folds_of_cell(basis, curve, begin, end, value, search, zeros, wave)
        for j in range(found):
            if count == rows.shape[1]:
                return -1
            level = coordinate(basis, curve, zeros[j], wave)
            if inside:
                rows[END, count], rows[END_LEVEL, count] = zeros[j], level
                count += 1
            else:
                rows[START, count], rows[START_LEVEL, count] = zeros[j], level
            inside = not inside
    return -1 if inside else count


@kernel()
def furthest_end(kind: int, rows: Rows, count: int) -> tuple[int, float, float]:
    """Return the branch that ends highest (UP) or starts lowest, the coordinate and the place there; -1 without any."""
    sign, best, level, x = (1.0 if kind == UP else -1.0), -1, -math.inf, math.nan
    for i in range(count):
        here = rows[END_LEVEL if kind == UP else START_LEVEL, i]
        if sign * here > level:
            best, level, x = i, sign * here, rows[END if kind == UP else START, i]
    return best, sign * level, x


@kernel()
def let_reach(kind: int, rows: Rows, count: int, level: float) -> None:
    """Let a wave that reaches a coordinate do so in its branches too, if only just: its highest end or lowest start."""
    best, here, _ = furthest_end(kind, rows, count)
    if best >= 0 and kind == UP:
        rows[END_LEVEL, best] = max(here, np.nextafter(level, math.inf))
    elif best >= 0:
        rows[START_LEVEL, best] = min(here, np.nextafter(level, -math.inf))


@kernel()
def _rise_at(basis: Basis, curve: Series, x: float, wave: float) -> float:
    """Return z dY/dz at a fixed phase, all but the 1/z-th part of its waves.

    The waves z w0 are z^c times a function of the phase and the sum of all cosines, z w1 has the first part alone.
    """
    table, cosine_bins, series = basis
    B, m, g, alpha, beta = curve
    c = 0.5 * (1.0 - table.k)
    z = TWO_PI * (wave + x)
    power = amplitude_power(table, z)
    w0, w1, _, _ = sums(table, cosine_bins, series, x, wave)
    bend, stretch, height = m * B * z**m, z * power, 0.0
    for i in range(series.shape[0]):
        height += series[i, 1]
    depth = bend + c * (g * (z * w0 - height) - stretch)
    return alpha * depth + beta / (power * power) * (bend + (2.0 - c) * (g * z * w1 - stretch))


@kernel()
def rises_by(basis: Basis, curve: Series, x: float, wave: float, difference: float) -> float:
    """Return the difference of the coordinates of waves about one, where it is lost in rounding another of its sign."""
    if abs(difference) > _ROUNDING * size(basis, curve, x, wave):
        return difference
    return _rise_at(basis, curve, x, wave)


@kernel()
def step_between(basis: Basis, curve: Series, waves: Waves, wave: float) -> tuple[tuple[int, float, float], Rows, int]:
    """Return the end that the step of a wave leaves (`furthest_end`), the branches that it goes to, and their number.

    The end is of the wave before, and the branches of this one, or the other way round (DOWN); all places are beyond
    `wave` - 1 whole waves.
    """
    kind, cut, _, (_, _, rows) = waves
    ahead = 1.0 if kind == UP else 0.0
    left, other = (rows[0], rows[1]) if kind == UP else (rows[1], rows[0])
    inside = branches_of_wave(basis, curve, wave - 1.0, cut + (1.0 - ahead), waves.work, left)
    beyond = branches_of_wave(basis, curve, wave - 1.0, cut + ahead, waves.work, other)
    return furthest_end(kind, left, inside), other, beyond


@kernel()
def _step(basis: Basis, curve: Series, waves: Waves, wave: float, losses: bool) -> Step:
    """Load from the highest end of the wave before to that of a wave, or unload from the lowest start back."""
    kind, before = waves.kind, wave - 1.0
    (first, level, left), rows, count = step_between(basis, curve, waves, wave)
    if first < 0 or count < 0:
        return 0.0, 0.0, -1
    loss, jumps, pattern = 0.0, 0.0, count * 4099 + first
    sign, end, end_level = (1.0, END, END_LEVEL) if kind == UP else (-1.0, START, START_LEVEL)
    furthest, _, _ = furthest_end(kind, rows, count)
    for j in range(count):
        i = j if kind == UP else count - 1 - j
        there, x = rows[end_level, i], rows[end, i]
        missing = sign * (level - there)
        if missing >= 0.0 and not (i == furthest and missing <= _ROUNDING * size(basis, curve, x, before)):
            continue
        if losses:
            place = place_left(basis, curve, left, before)
            landing = find_landing(basis, curve, place, rows[START, i], rows[END, i], before)
            low, high = (left, landing) if kind == UP else (landing, left)
            loss += sign * drop(basis, curve, place, low, high, before)
        jumps += 1.0
        level, left = there, x
        pattern = (pattern * 4099 + i + 1) % _MODULUS
    return TWO_PI * TWO_PI * loss, jumps, pattern if jumps > 0.0 else -1


@kernel()
def step_of_wave(basis: Basis, curve: Series, waves: Waves, wave: float, losses: bool) -> Step:
    """Return what a wave adds: to loading or unloading, or to a jump outwards that passes it."""
    if waves.kind != PASSING:
        return _step(basis, curve, waves, wave, losses)
    return TWO_PI * TWO_PI * drop(basis, curve, waves.left, 0.0, 1.0, wave), 0.0, 0
