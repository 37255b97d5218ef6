"""The leading asymptotic form of a short wave: a cycle of loading and unloading, and all results of a curve.

The path is that of branches.py, loading.py and unloading.py, each wave walked, each rim by itself: with so few waves
nothing is shared between rims but the branches.
"""

import math
from typing import Any

import numpy as np

from gradhesion.core import envelope
from gradhesion.core._jit import kernel
from gradhesion.core.asymptotic import (
    FURTHEST,
    MOST_HALVES,
    Wave,
    depth,
    depth_slope,
    folds_of_half,
    half_at,
    lowest_load,
    window_end,
)
from gradhesion.core.asymptotic_jump import loss_of_jump
from gradhesion.core.branches import END, END_DEPTH, START, START_DEPTH
from gradhesion.core.curve import curve_of, force_unit
from gradhesion.core.results import put_all, wants_folds, wants_force
from gradhesion.core.status import NO_VALUE
from gradhesion.core.struve.circle import TWO_PI

_STEPS = 100


@kernel()
def find_depth(wave: Wave, target: float, low: float, high: float) -> float:
    """Return where the branch between low and high meets a depth, low if it is nowhere so deep."""
    if depth(wave, low) >= target:
        return low
    if high == math.inf:
        step = 1.0
        high = low + step
        while depth(wave, high) <= target:
            low = high
            step *= 2.0
            high += step
    z = 0.5 * (low + high)
    for _ in range(_STEPS):
        rest = depth(wave, z) - target
        if rest < 0.0:
            low = z
        else:
            high = z
        new = z - rest / depth_slope(wave, z)
        if not low < new < high:
            new = 0.5 * (low + high)
            if new <= low or new >= high:
                break
        if abs(new - z) < 1e-9 * min(1.0, z):
            return new
        z = new
    return z


@kernel()
def trace_branches(wave: Wave, furthest: float) -> tuple[int, Any]:
    """Return the rising branches that begin within `furthest`, their number first: -1 if there are too many."""
    k, _, chi, _, _ = wave
    level = 0.5 * (1.0 - k)
    begin = 0.0 if chi >= 1.0 else window_end(wave, level, chi)
    end = window_end(wave, level, -chi)
    i = max(0.0, half_at(wave, level, begin) - 2.0)
    last = half_at(wave, level, min(end, furthest)) + 2.0
    if not (min(end, furthest) < FURTHEST and last - i <= MOST_HALVES):
        return -1, np.empty((4, 0))
    trace = np.empty((4, int(max(0.0, last - i)) + 4))
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
def load_to(wave: Wave, count: int, trace: Any, rim: float) -> tuple[float, float, float]:
    """Return what loading up to the rim loses, its jumps, and the largest depth before the rim."""
    loss, jumps = 0.0, 0.0
    left, level = 0.0, 0.0
    for now in range(count):
        if trace[START, now] > rim:
            break
        top = trace[END_DEPTH, now] if trace[END, now] < rim or rim == math.inf else depth(wave, rim)
        if top > level:
            landing = find_depth(wave, level, trace[START, now], trace[END, now])
            loss += loss_of_jump(wave, level, left, landing)
            jumps += 1.0
            if trace[END, now] >= rim:
                return loss, jumps, level
            left, level = trace[END, now], trace[END_DEPTH, now]
    return loss + loss_of_jump(wave, level, left, rim), jumps + 1.0, level


@kernel()
def unload_from(wave: Wave, count: int, trace: Any, rim: float) -> tuple[float, float, float]:
    """Return what unloading from the rim loses, its jumps, and the depth at which contact ends."""
    loss, jumps = 0.0, 0.0
    now = count - 1
    while now >= 0 and trace[START, now] > rim:
        now -= 1
    if now >= 0 and trace[END, now] >= rim:
        left, level = trace[START, now], trace[START_DEPTH, now]
        now -= 1
    else:
        left, level = rim, depth(wave, rim)
    while now >= 0:
        if trace[START_DEPTH, now] < level:
            loss += loss_of_jump(wave, level, left, find_depth(wave, level, trace[START, now], trace[END, now]))
            jumps += 1.0
            left, level = trace[START, now], trace[START_DEPTH, now]
        now -= 1
    if left > 0.0:
        loss += loss_of_jump(wave, level, left, 0.0)
        jumps += 1.0
    return loss, jumps, level


@kernel()
def solve_curve(
    table: Any, stretch: float, wavelength: float, amplitude: float, rims: Any, slots: Any, out: Any, status: Any
) -> None:
    """Solve one curve for all its rims."""
    if amplitude == 0.0:
        envelope.solve_curve(table, stretch, wavelength, amplitude, rims, slots, out)
        return
    k = table.k
    (bend, gain, _), length, depth_scale = curve_of(k, stretch, wavelength, amplitude * wavelength)
    wave = (k, bend, table.amplitude * gain, gain, table.phase)
    force_scale = force_unit(k, length, depth_scale)
    energy_scale = TWO_PI * length * length
    force, folds = wants_force(slots), wants_folds(slots)
    count, trace = -1, np.empty((4, 0))
    if folds:
        count, trace = trace_branches(wave, rims.max() / length)
    shared = count >= 0 or rims.size == 1  # else a rim with fewer waves may still have its own
    for i in range(rims.size):
        z_rim = rims[i] / length
        lowest = place = loss = loss_back = loading = unloading = deepest = last = math.nan
        if force:
            lowest, place = lowest_load(wave, z_rim)
        if folds and not shared:
            count, trace = trace_branches(wave, z_rim)
        if folds and count >= 0:
            loss, loading, deepest = load_to(wave, count, trace, z_rim)
            loss_back, unloading, last = unload_from(wave, count, trace, z_rim)
            if loss + loss_back < 0.0:  # no cycle gains energy: the contact is no larger than a wave, out of range here
                loss = loss_back = loading = unloading = deepest = last = math.nan
            elif z_rim < math.inf:
                deepest = max(deepest, depth(wave, z_rim))
            else:
                deepest = math.inf
        fine = (loss + loss_back >= 0.0 or not folds) and (lowest < 0.0 or not force)
        status[i] = 0 if fine else NO_VALUE
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
        put_all(out, slots, i, values)
