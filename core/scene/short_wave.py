"""The leading asymptotic form of a short wave: a cycle of loading and unloading, and all results of a curve.

The path is that of path/loading.py and path/unloading.py, which ask what core/face.py declares; each wave is walked.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.closed import envelope
from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    HIGHEST,
    ROWS,
    START,
    START_DEPTH,
    UNKNOWN,
    UNLOADING_JUMPS,
    Trace,
)
from gradhesion.core.curve.cosine import curve_of, force_unit
from gradhesion.core.curve.short_wave import (
    FURTHEST,
    MOST_HALVES,
    ShortWave,
    depth,
    folds_of_half,
    half_at,
    lowest_load,
    window_end,
)
from gradhesion.core.path.loading import highest_depth, load_up, loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.results import OUTERMOST, Results, put, put_all, wants_folds, wants_force
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.types import Floats, Table

NOTHING: Final = ()
"""The tables that the leading form needs."""


@kernel()
def trace_branches(wave: ShortWave, furthest: float) -> tuple[int, Trace]:
    """Return the rising branches that begin within `furthest`, their number first: -1 if there are too many."""
    k, _, chi, _, _ = wave
    level = 0.5 * (1.0 - k)
    begin = 0.0 if chi >= 1.0 else window_end(wave, level, chi)
    end = window_end(wave, level, -chi)
    i = max(0.0, half_at(wave, level, begin) - 2.0)
    last = half_at(wave, level, min(end, furthest)) + 2.0
    if not (min(end, furthest) < FURTHEST and last - i <= MOST_HALVES):
        return -1, np.empty((ROWS, 0))
    trace = np.empty((ROWS, int(max(0.0, last - i)) + 4))
    count = 0
    inside = level == 0.0
    if inside:  # k = 1: depth rises from zero contact
        trace[START, 0], trace[START_DEPTH, 0] = 0.0, depth(wave, 0.0)
        i = 0.0
    while i <= last:
        folds, z, outer, rising = folds_of_half(wave, level, i)
        for _ in range(folds):
            if rising and z > furthest:
                return count, trace
            row = START if rising else END
            trace[row, count], trace[row + 1, count] = z, depth(wave, z)
            count += 0 if rising else 1
            inside = rising
            rising = not rising
            z = outer
        i += 1.0
    if inside:
        trace[END, count] = trace[END_DEPTH, count] = math.inf
        count += 1
    return count, trace


@kernel()
def _follow(wave: ShortWave, count: int, trace: Trace, furthest: float) -> None:
    """Fill the records of the cycle on the branches."""
    load_up(NOTHING, wave, count, trace, furthest, YES)
    highest = 0.0
    for branch in range(count):
        highest = max(highest, trace[END_DEPTH, branch])
        trace[HIGHEST, branch], trace[UNLOADING_JUMPS, branch] = highest, UNKNOWN


@kernel()
def solve_curve(
    table: Table, stretch: float, wavelength: float, amplitude: float, rims: Floats, results: Results
) -> None:
    """Solve one curve (s, lambda/R, A) for all its rims a_max/R, of shape (rims,)."""
    if amplitude == 0.0:
        envelope.solve_curve(table, stretch, wavelength, amplitude, rims, results)
        return
    k = table.k
    (bend, gain, _), length, depth_scale = curve_of(k, stretch, wavelength, amplitude * wavelength)
    wave = ShortWave(k, bend, table.amplitude * gain, gain, table.phase)
    force_scale = force_unit(k, length, depth_scale)
    energy_scale = TWO_PI * length * length
    force, folds = wants_force(results.slots), wants_folds(results.slots)
    count, trace = -1, np.empty((ROWS, 0))
    if folds:
        count, trace = trace_branches(wave, rims.max() / length)
        _follow(wave, max(0, count), trace, rims.max() / length)
    shared = count >= 0 or rims.size == 1  # else a rim with fewer waves may still have its own
    for i in range(rims.size):
        z_rim = rims[i] / length
        lowest = place = loss = loss_back = loading = unloading = deepest = last = math.nan
        if force:
            lowest, place = lowest_load(wave, z_rim)
        if folds and not shared:
            count, trace = trace_branches(wave, z_rim)
            _follow(wave, max(0, count), trace, z_rim)
        if folds and count >= 0:
            rim_depth = depth(wave, z_rim) if z_rim < math.inf else math.inf
            loss, loading = loading_to(NOTHING, wave, count, trace, z_rim, YES)
            loss_back, unloading, last = unloading_from(NOTHING, wave, count, trace, z_rim, rim_depth, YES)
            deepest = highest_depth(count, trace, z_rim, rim_depth)
            if loss + loss_back < 0.0:  # no cycle gains energy: the contact is no larger than a wave, out of range here
                loss = loss_back = loading = unloading = deepest = last = math.nan
        fine = (loss + loss_back >= 0.0 or not folds) and (lowest < 0.0 or not force)
        results.status[i] = 0 if fine else NO_VALUE
        values = (
            -force_scale * lowest,
            place * length if place < z_rim else rims[i],
            energy_scale * (loss + loss_back),
            loading,
            unloading,
            depth_scale * deepest,
            depth_scale * last,
            energy_scale * loss,
            energy_scale * loss_back,
        )
        put_all(results, i, values)
        if folds:
            put(results, OUTERMOST, i, trace[ARRIVAL, count - 1] * length if count > 0 else math.nan)
