"""Where loading of one cosine first reaches a depth or a load, branch by branch of a trace (curve/branches.py).

Loading follows the running maximum of the depth. So a depth is first reached on the first branch that ends deeper.
Along a branch the load, whose slope has the level (3+k)/2 (curve/cosine.py), falls at first and in the end; it is
searched arch by arch, between the place where loading arrives and the place that it leaves. A load that a jump passes
turns the cycle where the jump ends.
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, YES, kernel
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    GAP,
    RUN,
    RUN_AFTER,
    RUN_BEFORE,
    RUN_FIRST,
    RUN_LANDING,
    RUN_LAST,
    START,
    Trace,
    ends,
    find_depth,
)
from gradhesion.core.curve.cosine import Cosine, depth, load, slope
from gradhesion.core.curve.cosine_folds import fold_of_arch, survey_arch
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.cosine_waves import first_wave_above
from gradhesion.core.path.ties import tolerance
from gradhesion.core.struve.arches import inner_edge
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.turning.cosine_at_once import SURE
from gradhesion.core.types import Floats, Table
from gradhesion.core.waves.cosine import branch_of_wave, fold_of_wave, landing_of_wave

Turn: TypeAlias = tuple[float, bool]
"""Where a cycle turns (inf if not here), and whether a step of that is close."""
Peaks: TypeAlias = Floats
"""The largest load of loading on each branch of a trace, or a bound of it, of shape (branches,): `peaks_of`."""
_STEPS: Final = 200
_FEW: Final = 3
"""Number of turning points of a curve up to which each is searched separately."""


@kernel()
def _size(table: Table, curve: Cosine, x: float) -> float:
    """Return CLOSE times the size of the terms of the load."""
    power = amplitude_power(table, TWO_PI * x)
    return tolerance(table, curve, x) / (power * power)


@kernel()
def _find(table: Table, curve: Cosine, low: float, high: float, target: float, by_load: bool) -> float:
    """Return where the depth (or the load) rises through a target between two places (Newton, kept in the bracket)."""
    k = table.k
    level = 0.5 * (3.0 + k) if by_load else 0.5 * (1.0 - k)
    x = 0.5 * (low + high)
    if not by_load:
        branch = (low, depth(table, curve, low) if low > 0.0 else -1.0, high, depth(table, curve, high))
        x = find_depth(table, curve, target, branch)
    for _ in range(_STEPS):
        d, d1, _, rest = slope(table, curve, level, x)
        rate = d
        if by_load:
            power = amplitude_power(table, TWO_PI * x)
            rate /= power * power
            rest = load(table, curve, x)
        rest -= target
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        step = -rest / rate
        small = abs(step) * (abs(d1) + abs(d)) <= SURE * min(1.0, TWO_PI * x) * abs(d)  # what is left is its square
        x += step / TWO_PI
        if small and low < x < high:
            return x
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
    return x


@kernel()
def _load_between(table: Table, curve: Cosine, low: float, high: float, target: float) -> Turn:
    """Return where the load first reaches a target between two places; at `low` it is below."""
    level = 0.5 * (3.0 + table.k)
    close = False
    before = low
    i = max(0, int(2.0 * low - table.phase / math.pi) - 1)
    edge, _, _ = inner_edge(table, i)
    while edge < high:
        survey = survey_arch(table, curve, level, i)
        kind = survey[0]
        rising = kind == 1 or (kind == 2 and i % 2 == 0)
        for _ in range(abs(kind)):
            x, _ = fold_of_arch(table, curve, level, i, survey, rising, 0.0)
            if low < x < high:
                if not rising:  # the load is largest here
                    above = load(table, curve, x) - target
                    close = close or abs(above) <= _size(table, curve, x)
                    if above >= 0.0:
                        return _find(table, curve, before, x, target, YES), close
                before = x
            rising = not rising
        edge = survey[3]
        i += 1
    above = load(table, curve, high) - target
    close = close or abs(above) <= _size(table, curve, high)
    return _find(table, curve, before, high, target, YES) if above >= 0.0 else math.inf, close


@kernel()
def _turn_on(
    table: Table, curve: Cosine, arrival: float, branch: tuple[float, float, float, float], reach: float, target: float
) -> Turn:
    """Return where the load first reaches a target on a branch that loading visits from its arrival on."""
    _, _, end, _ = branch
    high = min(end, reach)
    if load(table, curve, arrival) >= target:
        return arrival, False
    if not arrival < high:
        return math.inf, False
    return _load_between(table, curve, arrival, high, target)


@kernel()
def _depth_among(table: Table, curve: Cosine, first: int, last: int, trace: Trace, reach: float, target: float) -> Turn:
    """Return where loading first reaches a depth on the branches `first` to `last` - 1 of a trace."""
    close = False
    for branch in range(first, last):
        end, bottom = trace[END, branch], trace[END_DEPTH, branch]
        if end < math.inf:
            close = close or abs(bottom - target) <= tolerance(table, curve, end)
        if bottom > target:
            high = min(end, reach)
            if high <= trace[START, branch] or depth(table, curve, high) < target:
                return math.inf, close  # beyond the rim
            return _find(table, curve, trace[START, branch], high, target, NO), close
    return math.inf, close


@kernel()
def _peak(table: Table, curve: Cosine, low: float, high: float) -> float:
    """Return the largest load between the place where loading arrives on a branch and the end of that."""
    level = 0.5 * (3.0 + table.k)
    highest = max(load(table, curve, low), load(table, curve, high))
    i = max(0, int(2.0 * low - table.phase / math.pi) - 1)
    edge, _, _ = inner_edge(table, i)
    while edge < high:
        survey = survey_arch(table, curve, level, i)
        kind = survey[0]
        if kind in (-1, 2):
            x, _ = fold_of_arch(table, curve, level, i, survey, NO, 0.0)
            if low < x < high:
                highest = max(highest, load(table, curve, x))
        edge = survey[3]
        i += 1
    return highest


@kernel()
def peaks_of(table: Table, curve: Cosine, count: int, trace: Trace, inner: float, targets: int) -> Peaks:
    """Return the largest load of loading on each branch, or a bound of it.

    It is -inf for a branch that ends before `inner`, where no target is reached, and inf for one that does not end, or
    where `targets` are so few that it is not worth knowing.
    """
    peaks = np.full(count, math.inf)
    for branch in range(count):
        if trace[END, branch] < inner:
            peaks[branch] = -math.inf
        elif targets > _FEW and trace[ARRIVAL, branch] < math.inf and trace[END, branch] < math.inf:
            peaks[branch] = _peak(table, curve, trace[ARRIVAL, branch], trace[END, branch])
    return peaks


@kernel()
def _load_among(
    table: Table, curve: Cosine, first: int, last: int, trace: Trace, peaks: Peaks, reach: float, target: float
) -> Turn:
    """Return where loading first reaches a load on the branches `first` to `last` - 1 of a trace."""
    close = False
    for branch in range(first, last):
        arrival, peak = trace[ARRIVAL, branch], peaks[branch]
        if not arrival <= reach:
            continue
        if peak < target:
            close = close or target - peak <= _size(table, curve, trace[END, branch])
            continue
        x, near = _turn_on(table, curve, arrival, ends(trace, branch), reach, target)
        close = close or near
        if x < math.inf:
            return x, close
    return math.inf, close


@kernel()
def _turn_on_wave(table: Table, curve: Cosine, trace: Trace, wave: float, reach: float, target: float) -> Turn:
    """Return where loading first reaches a load on a regular wave."""
    arrival = trace[RUN, RUN_LANDING] if wave == trace[RUN, RUN_FIRST] else 0.0
    if arrival == 0.0:
        arrival = wave - 1.0 + landing_of_wave(table, curve, wave - 1.0, YES)
    return _turn_on(table, curve, arrival, branch_of_wave(table, curve, wave), reach, target)


@kernel()
def _wave_at_load(table: Table, curve: Cosine, target: float) -> float:
    """Return about the wave that carries a load: on the envelope X [b X/(3+k) - 1 + chi] above it, X = z^((3+k)/2)."""
    b, g, _ = curve
    half = 0.5 * (3.0 + table.k)
    pull = 1.0 - g * table.amplitude
    abscissa = half / b * (pull + math.sqrt(pull * pull + 2.0 * b * target / half))
    return np.floor(max(0.0, abscissa) ** (1.0 / half) / TWO_PI - table.phase / TWO_PI)


@kernel()
def turn_on_waves(table: Table, curve: Cosine, trace: Trace, reach: float, target: float) -> Turn:
    """Return where loading first reaches a load on the regular waves that it visits: their loads rise outwards."""
    low, high = trace[RUN, RUN_FIRST] - 1.0, trace[RUN, RUN_LAST] + 1.0
    found, close = math.inf, False
    middle, step = _wave_at_load(table, curve, target), 1.0
    while high - low > 1.0:  # the load is not reached on `low`, and surely is on `high` if there is such a wave
        middle = max(low + 1.0, min(high - 1.0, middle))
        x, near = _turn_on_wave(table, curve, trace, middle, reach, target)
        if x < math.inf:
            high, found, close, middle = middle, x, near, middle - step
        else:
            low, close, middle = middle, close or near, middle + step
        step *= 2.0
        if not low < middle < high:
            middle = np.floor(0.5 * (low + high))
    return found, close


@kernel()
def turn_at_load(
    table: Table, curve: Cosine, count: int, trace: Trace, peaks: Peaks, reach: float, target: float
) -> Turn:
    """Return where loading first reaches a load on the branches of a trace, or on the waves in a gap of it."""
    gap = int(min(trace[RUN, GAP], count))
    x, close = _load_among(table, curve, NONE, gap, trace, peaks, reach, target)
    if x == math.inf and trace[RUN, GAP] < math.inf:
        x, near = turn_on_waves(table, curve, trace, reach, target)
        close = close or near
        if x == math.inf:
            x, near = _load_among(table, curve, gap, count, trace, peaks, reach, target)
            close = close or near
    return x, close


@kernel()
def turn_at_depth(table: Table, curve: Cosine, count: int, trace: Trace, reach: float, target: float) -> Turn:
    """Return where loading first reaches a depth on the branches of a trace, or on the waves in a gap of it."""
    gap = int(min(trace[RUN, GAP], count))
    x, close = _depth_among(table, curve, NONE, gap, trace, reach, target)
    if x < math.inf or trace[RUN, GAP] == math.inf:
        return x, close
    if gap == count or trace[END_DEPTH, gap] > target:
        before, after = trace[RUN, RUN_BEFORE], trace[RUN, RUN_AFTER]
        wave, end, bottom, place, below = first_wave_above(table, curve, before, after, target)
        if wave < after or gap == count:
            start, _ = fold_of_wave(table, curve, wave, YES)
            if math.isnan(end):
                end, bottom = fold_of_wave(table, curve, wave, NO)
            if not math.isnan(place):
                close = close or abs(below - target) <= tolerance(table, curve, place)
            close = close or abs(bottom - target) <= tolerance(table, curve, end)
            return _find(table, curve, start, end, target, NO), close
    x, near = _depth_among(table, curve, gap, count, trace, reach, target)
    return x, close or near
