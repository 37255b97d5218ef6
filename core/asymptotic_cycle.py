"""The leading asymptotic form of a short wave: a cycle of loading and unloading, and all results of a curve.

The path is that of branches.py, loading.py and unloading.py, each wave walked, each rim by itself. The energy of a jump
at the depth d from one contact radius to another is, with D = d - g and rho = (b z^2/2 - D)/z^c + chi sin(z - phi),

    e = int z [1 - rho^2] dz = z^2/2 - b^2 z^(5+k)/(4 (5+k)) + b D z^(3+k)/(3+k) - D^2 z^(1+k)/(1+k)
                               - 2 chi int z^n (b z^2/2 - D) sin(z - phi) dz - chi^2 int z sin^2(z - phi) dz
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
from gradhesion.core.status import NO_VALUE
from gradhesion.core.struve.circle import TWO_PI

START, START_DEPTH, END, END_DEPTH = 0, 1, 2, 3
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_PANEL = 7.8
"""The longest panel, 1.25 waves (jump_energy.py)."""
_SMALL = 4.0
"""z below which the powers of z are felt by Gauss's rule: the variable is z^(1/4) there."""
_LARGE = 40.0
"""z from which the integral of a power times a sine is its asymptotic series."""
_MANY = 512.0
"""Length of a jump from which the antiderivative is taken."""
_STEPS = 100


@kernel()
def _integrand(wave: Wave, target: float, z: float) -> float:
    """Return z (1 - rho^2)."""
    k, b, chi, g, phi = wave
    rho = (0.5 * b * z * z + g - target) / z ** (0.5 * (1.0 - k)) + chi * math.sin(z - phi)
    return z * (1.0 - rho) * (1.0 + rho)


@kernel()
def _by_panels(wave: Wave, target: float, low: float, high: float) -> float:
    """Integrate by Gauss's rule."""
    panels = int((high - low) / _PANEL) + 1
    half = 0.5 * (high - low) / panels
    total = 0.0
    for panel in range(panels):
        centre = low + (2.0 * panel + 1.0) * half
        for node, weight in zip(_NODES, _WEIGHTS):  # noqa: B905 (numba has no strict)
            total += weight * _integrand(wave, target, centre + half * node)
    return total * half


@kernel()
def _near_zero(wave: Wave, target: float, low: float, high: float) -> float:
    """Integrate by Gauss's rule in t = z^(1/4)."""
    start, end = low**0.25, high**0.25
    total = 0.0
    for node, weight in zip(_NODES, _WEIGHTS):  # noqa: B905
        t = 0.5 * (start + end + (end - start) * node)
        total += weight * 4.0 * t**3 * _integrand(wave, target, t**4)
    return total * 0.5 * (end - start)


@kernel()
def _power_times_sine(power: float, phi: float, z: float) -> float:
    """Return int z^power sin(z - phi) dz for z >= 40 (by parts; what is left is below 1e-12)."""
    real, imaginary = 0.0, 1.0  # of the factor of e^(i (z - phi)): the sum of -i (i d/dz)^j
    term = z**power
    total = 0.0
    sine, cosine = math.sin(z - phi), math.cos(z - phi)
    for j in range(10):
        total += term * (real * sine - imaginary * cosine)
        real, imaginary = imaginary, -real
        term *= (power - j) / z
    return total


@kernel()
def _antiderivative(wave: Wave, target: float, z: float) -> float:
    """Return the integral in closed form for z >= 40."""
    k, b, chi, g, phi = wave
    n = 0.5 * (1.0 + k)
    drop = target - g
    square = z * z
    quartic = 0.25 * b * b * square * square / (5.0 + k) - b * drop * square / (3.0 + k) + drop * drop / (1.0 + k)
    linear = 0.5 * b * _power_times_sine(n + 2.0, phi, z) - drop * _power_times_sine(n, phi, z)
    double = 2.0 * (z - phi)
    quadratic = 0.25 * square - 0.25 * z * math.sin(double) - 0.125 * math.cos(double)
    return 0.5 * square - z ** (1.0 + k) * quartic - 2.0 * chi * linear - chi * chi * quadratic


@kernel()
def loss_of_jump(wave: Wave, target: float, start: float, end: float) -> float:
    """Return e for a jump at the depth `target` from z = start to z = end, either of which may be 0."""
    low, high = min(start, end), max(start, end)
    total = 0.0
    if low < _SMALL:
        edge = min(_SMALL, high)
        total += _near_zero(wave, target, low, edge)
        low = edge
    if high - low > _MANY:
        if low < _LARGE:
            total += _by_panels(wave, target, low, _LARGE)
            low = _LARGE
        total += _antiderivative(wave, target, high) - _antiderivative(wave, target, low)
    elif high > low:
        total += _by_panels(wave, target, low, high)
    return total if end > start else -total


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
    table: Any, stiffness: float, wavelength: float, amplitude: float, rims: Any, slots: Any, out: Any, status: Any
) -> None:
    """Solve one curve for all its rims."""
    k = table.k
    stretch = math.sqrt(2.0 ** (1.0 + k) * math.pi / stiffness)
    length = wavelength / TWO_PI
    depth_scale = stretch * length ** (0.5 * (1.0 - k))
    gain = amplitude * wavelength / depth_scale
    wave = (k, 2.0 * length * length / ((1.0 + k) * depth_scale), table.amplitude * gain, gain, table.phase)
    force_scale = 8.0 / (3.0 * (1.0 + k)) * length * length / depth_scale
    energy_scale = TWO_PI * length * length
    wants_force = slots[0] >= 0 or slots[1] >= 0
    wants_cycle = slots[2:].max() >= 0
    count, trace = -1, np.empty((4, 0))
    if wants_cycle:
        count, trace = trace_branches(wave, rims.max() / length)
    shared = count >= 0 or rims.size == 1  # else a rim with fewer waves may still have its own
    for i in range(rims.size):
        z_rim = rims[i] / length
        lowest = place = loss = loading = unloading = deepest = last = math.nan
        if wants_force:
            lowest, place = lowest_load(wave, z_rim)
        if wants_cycle and not shared:
            count, trace = trace_branches(wave, z_rim)
        if wants_cycle and count >= 0:
            loss, loading, deepest = load_to(wave, count, trace, z_rim)
            loss_back, unloading, last = unload_from(wave, count, trace, z_rim)
            loss += loss_back
            if loss < 0.0:  # no cycle gains energy: the contact is no larger than a wave, out of range here
                loss = loading = unloading = deepest = last = math.nan
            elif z_rim < math.inf:
                deepest = max(deepest, depth(wave, z_rim))
            else:
                deepest = math.inf
        fine = (loss >= 0.0 or not wants_cycle) and (lowest < 0.0 or not wants_force)
        status[i] = 0 if fine else NO_VALUE
        values = (
            -force_scale * lowest,
            place * length if place < z_rim else rims[i],
            energy_scale * loss,
            loading,
            unloading,
            depth_scale * deepest,
            depth_scale * last,
        )
        envelope.store(values, slots, out, i)


@kernel()
def solve_curves(
    table: Any,
    index: Any,
    stiffness: Any,
    wavelength: Any,
    amplitude: Any,
    rims: Any,
    slots: Any,
    out: Any,
    status: Any,
    scratch: Any,
) -> None:
    """Solve the curves `index` of one gradient exponent; `rims` has one row, or one a curve (as scene.py)."""
    for j in range(index.size):
        i = index[j]
        row = rims[i if rims.shape[0] > 1 else 0]
        valid = stiffness[i] > 0.0 and 0.0 < wavelength[i] < math.inf and 0.0 < amplitude[i] < math.inf
        if valid and row.min() > 0.0:
            solve_curve(table, stiffness[i], wavelength[i], amplitude[i], row, slots, out[:, i], status[i])
        else:  # the smooth punch, and what has no value
            one = index[j : j + 1]
            envelope.solve_curves(table, one, stiffness, wavelength, amplitude, rims, slots, out, status, scratch)
