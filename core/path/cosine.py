"""A cycle of loading and unloading under displacement control: its jumps and the energy that they cost.

A curve of moderate length is walked branch by branch, once for all its rims: loading does not depend on the rim until
it gets there, and unloading does not depend on where it came from. On a long one only the branches near its beginning
and near the rim are walked; the run of waves between them is regular and summed (waves/cosine_sum.py). The two pieces
stand in one trace, and what passes the gap enters as what loading has lost where it arrives beyond it, and as what
unloading still has to lose.
"""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core._jit import NO, NONE, YES, kernel
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    GAP,
    LAST_DEPTH,
    LOADING_JUMPS,
    LOADING_LOSS,
    RUN,
    RUN_AFTER,
    RUN_BEFORE,
    RUN_FIRST,
    RUN_LANDING,
    RUN_LAST,
    RUN_LOWEST,
    START,
    START_DEPTH,
    TANGENCY,
    UNKNOWN,
    UNLOADING_JUMPS,
    UNLOADING_LOSS,
    WORK,
    append_branches,
    ends,
    find_depth,
    room_for,
)
from gradhesion.core.curve.cosine import Curve
from gradhesion.core.curve.cosine_energy import energy_from_zero, jump_energy
from gradhesion.core.curve.cosine_folds import first_arch, last_arch
from gradhesion.core.path.loading import arrive, climb, load_up
from gradhesion.core.path.ties import note_loading
from gradhesion.core.path.unloading import descend, leave, next_lower
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.waves.cosine import branch_of_wave, fold_of_wave, jump_of_wave
from gradhesion.core.waves.cosine_sum import sum_of_waves

LONGEST_WALK: Final = 160.0
"""Arches, two a wave, up to which a curve is walked."""
BEGINNING: Final = 16.0
"""Waves walked at the beginning of a long curve; z > 150 there."""
COUNTABLE: Final = 2.0**53
LARGEST: Final = 1e60
"""Bend and gain of a curve, and waves within its rim, above which powers of them may overflow."""
SMALLEST: Final = 1e-60
"""Radius over wavelength below which powers of it may underflow."""
_FURTHEST: Final = 1e300
"""An arch that stands for all beyond: numbers of arches are subtracted from each other."""
_HALVINGS: Final = 200
MOST_ARCHES: Final = 2.0e9
"""Arches up to which the phase of a radius is told well enough to walk there."""
_MOST_NEAR_RIM: Final = 2.0e13
"""The same near a rim: to a hundredth, of waves that are 10^-13 of all."""
_ORDERED: Final = 20.0
"""Times the square of what rounding leaves of a phase, below which neighbours need not be in order (is_told)."""
_NEGLIGIBLE: Final = 2.0**-56
"""Curvature of the waviness over that of the paraboloid below which it is lost in rounding."""
NEAR_RIM: Final = 10.0
"""Waves walked before the rim, or before the folds end."""


@kernel()
def extent(table: Any, curve: Curve) -> tuple[float, float]:
    """Return the first and the last arch on which the curve can fold."""
    level = 0.5 * (1.0 - table.k)
    return min(_FURTHEST, first_arch(table, curve, level)), min(_FURTHEST, last_arch(table, curve, level))


@kernel()
def is_long(table: Any, arches: tuple[float, float], rim: float) -> bool:
    """Return whether a rim is too far out to walk there."""
    return min(arches[1], 2.0 * rim - table.phase / math.pi) - arches[0] > LONGEST_WALK


@kernel()
def is_endless_wave(wavelength: float, amplitude: float) -> bool:
    """Return whether a wave (lambda/R, A) is so long that its curvature 4 pi^2 A/lambda is nothing beside 1/R."""
    return TWO_PI * TWO_PI * amplitude <= _NEGLIGIBLE * wavelength


@kernel()
def is_unresolved(arches: tuple[float, float], rim: float) -> bool:
    """Return whether a rim has no value: up to it folds are beyond counting, or powers of it underflow."""
    return min(arches[1], 2.0 * rim) > COUNTABLE or rim < SMALLEST or LARGEST < rim < math.inf


@kernel()
def is_smooth(arches: tuple[float, float]) -> bool:
    """Return whether folds could stand only so far out, and on so few waves, that they are of the size of rounding."""
    return arches[0] > MOST_ARCHES and arches[1] - arches[0] <= LONGEST_WALK


@kernel()
def is_told(table: Any, curve: Curve, arch: float) -> bool:
    """Return whether a float tells places on an arch well enough to walk there.

    A fold that is off by e has a depth that is off by e^2/2 of the wave; neighbours differ by 2 pi b z^n/(g C) of it.
    """
    b, g, _ = curve
    z = math.pi * arch
    e = 2.0**-52 * z
    rise = TWO_PI * b / (amplitude_power(table, z) * g * table.amplitude)
    return arch < MOST_ARCHES or (arch < _MOST_NEAR_RIM and _ORDERED * e * e < rise)


@kernel()
def walk(
    table: Any, curve: Curve, arches: tuple[float, float], furthest: float, trace: Any, losses: bool
) -> tuple[int, Any]:
    """Walk a curve of moderate length outwards to `furthest`; return the number of its branches and the trace."""
    first, final = arches
    trace = room_for(trace, min(final, 2.0 * furthest) - first + 8.0)
    count = append_branches(table, curve, int(min(first, COUNTABLE)), final, furthest, trace, NONE)
    trace[RUN, GAP] = math.inf
    load_up(table, curve, count, trace, furthest, losses)
    note_loading(table, curve, count, trace, furthest)
    return count, trace


@kernel()
def wave_of(table: Any, start: float) -> float:
    """Return the number of the wave whose branch starts at x: half a wave to none before its centre."""
    return np.floor(start - table.phase / TWO_PI + 0.75)


@kernel()
def first_wave_above(table: Any, curve: Curve, low: float, high: float, level: float) -> float:
    """Return the first wave after `low`, which ends below a depth, that ends above it; `high` does.

    It is where the upper envelope b z^2/2 - (1 - C g) z^c + g passes the depth, or next to it.
    """
    b, g, _ = curve
    stretch = 1.0 - g * table.amplitude
    z = math.sqrt(2.0 * (max(level - g, 0.0) + max(stretch, 0.0)) / b) + TWO_PI * low
    for _ in range(8):
        pull = stretch * z * amplitude_power(table, z)
        z -= (0.5 * b * z * z - pull + g - level) / (b * z - 0.5 * (1.0 - table.k) * pull / z)
        z = max(z, TWO_PI * low)
    middle = np.floor(z / TWO_PI - table.phase / TWO_PI)
    step = 1.0
    for _ in range(_HALVINGS):
        if high - low <= 1.0:
            break
        middle = max(low + 1.0, min(high - 1.0, middle))
        _, end_depth = fold_of_wave(table, curve, middle, NO)
        if end_depth > level:
            high, middle = middle, middle - step
        else:
            low, middle = middle, middle + step
        step *= 2.0
        if not low < middle < high:
            middle = np.floor(0.5 * (low + high))
    return high


@kernel()
def _lowest_wave(table: Any, curve: Curve, low: float, high: float) -> float:
    """Return the wave between two others whose branch starts lowest; the starts fall up to it and rise from it on.

    It is where the lower envelope b z^2/2 - (1 + C g) z^c is lowest, or next to it.
    """
    b, g, _ = curve
    k = table.k
    z = (0.5 * (1.0 - k) * (1.0 + g * table.amplitude) / b) ** (2.0 / (3.0 + k))
    middle = np.floor(z / TWO_PI - table.phase / TWO_PI)
    step = 1.0
    for _ in range(_HALVINGS):  # the lowest is one of low .. high
        if high <= low:
            break
        middle = max(low, min(high - 1.0, middle))
        _, here = fold_of_wave(table, curve, middle, YES)
        _, beyond = fold_of_wave(table, curve, middle + 1.0, YES)
        if beyond < here:
            low, middle = middle + 1.0, middle + step
        else:
            high, middle = middle, middle - step
        step *= 2.0
        if not low <= middle < high:
            middle = np.floor(0.5 * (low + high))
    return low


@kernel()
def _load_through(
    table: Any, curve: Curve, near: int, count: int, waves: Any, trace: Any, rim: float, losses: bool
) -> None:
    """Follow loading from the `near` branches of the beginning through the gap to those near the rim."""
    before, after, final = waves  # the last wave before the gap, the first one after it, and the last arch
    trace[ARRIVAL, near:count] = math.inf
    trace[RUN, GAP], trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST] = near, 0.0, -1.0
    now = load_up(table, curve, near, trace, math.inf, losses)
    left, level = (trace[END, now], trace[END_DEPTH, now]) if now >= 0 else (0.0, 0.0)
    if trace[END_DEPTH, near] > level:
        wave, x, loss, jumps = before, 0.0, 0.0, 0.0
        if 0 <= now == near - 1:
            loss, jumps = trace[LOADING_LOSS, now], trace[LOADING_JUMPS, now]
        else:  # into the gap, by one long jump
            wave = first_wave_above(table, curve, before, after, level)
            beyond = ends(trace, near) if wave == after else branch_of_wave(table, curve, wave)
            x = find_depth(table, curve, level, beyond)
            if now >= 0:
                loss, jumps = trace[LOADING_LOSS, now], trace[LOADING_JUMPS, now]
            if losses and now >= 0:
                loss += jump_energy(table, curve, left, x, trace[WORK])
            elif losses:
                loss = energy_from_zero(table, curve, x, 0.0)
            jumps += 1.0
        if wave < after:
            trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST], trace[RUN, RUN_LANDING] = wave, after - 1.0, x
            if losses:
                loss += sum_of_waves(table, curve, wave, after - 1.0, YES, final, trace[WORK])
            beyond_wave, _ = jump_of_wave(table, curve, after - 1.0, YES, trace[WORK])
            x = after - 1.0 + beyond_wave
            jumps += after - wave
        arrive(trace, near, x, loss, jumps)
        now = near
    climb(table, curve, now, count, trace, rim, losses)


@kernel()
def _unload_through(table: Any, curve: Curve, near: int, waves: Any, trace: Any, losses: bool) -> None:
    """Give the first branch after the gap what unloading loses from there, if it goes on into the gap."""
    before, after, final = waves
    lowest = _lowest_wave(table, curve, before, after)
    trace[RUN, RUN_BEFORE], trace[RUN, RUN_AFTER], trace[RUN, RUN_LOWEST] = before, after, lowest
    if lowest == after:  # nothing in the gap is lower
        return
    loss, jumps, last = 0.0, 1.0, 0.0
    if lowest == before and near > 0:
        descend(table, curve, trace, near - 1, losses)
        loss, jumps, last = (
            trace[UNLOADING_LOSS, near - 1],
            trace[UNLOADING_JUMPS, near - 1],
            trace[LAST_DEPTH, near - 1],
        )
    else:
        start, level, _, _ = branch_of_wave(table, curve, lowest)
        lower = next_lower(trace, near - 1, level)
        if lower >= 0:
            descend(table, curve, trace, lower, losses)
            landing = find_depth(table, curve, level, ends(trace, lower))
            loss = jump_energy(table, curve, start, landing, trace[WORK]) if losses else 0.0
            loss, jumps, last = (
                loss + trace[UNLOADING_LOSS, lower],
                1.0 + trace[UNLOADING_JUMPS, lower],
                trace[LAST_DEPTH, lower],
            )
        else:
            loss, last = -energy_from_zero(table, curve, start, level) if losses else 0.0, level
    if losses:
        loss += sum_of_waves(table, curve, lowest + 1.0, after, NO, final, trace[WORK])
    leave(trace, near, loss, jumps + after - lowest, last)


@kernel()
def _nominal_branch(table: Any, curve: Curve, rim: float, final: float, trace: Any, near: int) -> float:
    """Put the branch of a rim whose phase no float tells into the trace, by the envelopes; return its wave.

    Beyond the end of the folds at wave `final` it is the last one, which has no end.
    """
    b, g, _ = curve
    place = min(rim, final)
    z = TWO_PI * place
    pull, chi = z * amplitude_power(table, z), g * table.amplitude
    trace[START, near], trace[START_DEPTH, near] = place, 0.5 * b * z * z - (1.0 + chi) * pull + g
    trace[END, near], trace[END_DEPTH, near] = math.inf, 0.5 * b * z * z - (1.0 - chi) * pull + g
    if rim > final:
        trace[END_DEPTH, near] = math.inf
    trace[UNLOADING_JUMPS, near] = UNKNOWN
    return np.floor(place - table.phase / TWO_PI)


@kernel()
def stride(
    table: Any, curve: Curve, arches: tuple[float, float], rim: float, trace: Any, losses: bool, reach: float = 1.0
) -> tuple[int, Any]:
    """Do what `walk` does for one rim of a long curve, leaving out the regular waves in the middle.

    A `reach` of up to 2 walks that many times as many at either end, which tells how good the sum is
    (scene/cosine_report.py).
    """
    first, final = arches
    trace = room_for(trace, 4.0 * reach * (BEGINNING + NEAR_RIM))
    trace[TANGENCY, 0] = math.inf
    last = min(final, 2.0 * rim - table.phase / math.pi + 3.0)
    near, before = 0, 0.5 * first
    if first < MOST_ARCHES:
        beginning = (0.5 * first + reach * BEGINNING) + table.phase / TWO_PI
        near = append_branches(table, curve, int(first), final, beginning, trace, NONE)
        before = wave_of(table, trace[START, near - 1]) if near > 0 else before
    count = near
    if is_told(table, curve, last):
        count = append_branches(table, curve, 2 * int(0.5 * last - reach * NEAR_RIM) - 1, final, rim, trace, near)
        after = wave_of(table, trace[START, near]) if count > near else 0.0
    nominal = count == near
    if nominal:
        after = _nominal_branch(table, curve, rim, 0.5 * final, trace, near)
        count = near + 1
    waves = (before, after, final)
    _load_through(table, curve, near, count, waves, trace, rim, losses)
    if nominal and trace[ARRIVAL, near] < math.inf and rim <= 0.5 * final:
        trace[ARRIVAL, near] = trace[START, near]
    _unload_through(table, curve, near, waves, trace, losses)
    note_loading(table, curve, count, trace, rim)
    return count, trace
