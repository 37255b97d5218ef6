"""How force and energy of one cosine wave change with what a scene is made of: M, lambda, A, a_max and k.

A curve has two numbers, b ~ lambda^(2-c) M^(1/2) and g ~ A lambda^(1-c) M^(1/2), and its rim x = a_max/lambda
(curve/cosine.py). With the units lambda^(2-c) M^(1/2) of the force and lambda^2 of the energy, and f and h in these
units,

    d ln F/d ln M = 1/2 + (b f_b + g f_g)/2f              d ln H/d ln M = (b h_b + g h_g)/2h
    d ln F/d ln A = g f_g/f                               d ln H/d ln A = g h_g/h
    d ln F/d ln a_max = x f_x/f                           d ln H/d ln a_max = x h_x/h
    d ln F/d ln lambda = (2-c) + [(2-c) b f_b + (1-c) g f_g - x f_x]/f,    2 in the place of the first for H

The pull-off is a minimum of the load, or stands at the rim: its place may be held.
"""

import math
from typing import Any

import numpy as np

from gradhesion.core._jit import NO, constant, kernel
from gradhesion.core.closed import smooth
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    GAP,
    LAST_DEPTH,
    NEXT,
    RUN,
    START,
    START_DEPTH,
    UNKNOWN,
    UNLOADING_JUMPS,
)
from gradhesion.core.curve.cosine import Curve, curve_of, depth, force_unit, load, slope, wave
from gradhesion.core.path.cosine import extent, is_endless_wave, is_long, is_smooth, stride, walk
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.pull_off.cosine import PHASELESS
from gradhesion.core.sensitivities.jump_slopes import BEND, EXPONENT, GAIN, SLOPES
from gradhesion.core.sensitivities.path_slopes import ROWS, add_loading, add_unloading, fill_loading
from gradhesion.core.sensitivities.wave_slopes import ROOM
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power

BY_STIFFNESS, BY_WAVELENGTH, BY_AMPLITUDE, BY_RIM, BY_EXPONENT = map(constant, range(5))
"""Rows of what is found; that of k is at fixed M."""
COUNT = 5
FORCE, ENERGY, DEPTH = 0, 1, 2
"""What is differentiated: the last one is the depth at the rim, over R, not its logarithm."""


@kernel()
def _put(found: Any, k: float, curve: Curve, unit: float, half: float, by: Any, value: float, i: int) -> None:
    """Store the sensitivities of a value from its slopes by b, g, x and k; `unit` is its power of lambda."""
    b, g, _ = curve
    c = 0.5 * (1.0 - k)
    if not value > 0.0:
        found[:, i] = math.nan
        return
    bend, gain, rim = b * by[0] / value, g * by[1] / value, by[2] / value
    found[BY_STIFFNESS, i] = half + 0.5 * (bend + gain)
    found[BY_WAVELENGTH, i] = unit + (2.0 - c) * bend + (1.0 - c) * gain - rim
    found[BY_AMPLITUDE, i] = gain
    found[BY_RIM, i] = rim
    found[BY_EXPONENT, i] = by[3] / value


@kernel()
def _lowest_load_at(table: Any, curve: Curve, x: float) -> float:
    """Return the load at x, beyond all phases that of the lowest trough there (pull_off/cosine.py)."""
    z = TWO_PI * x
    if z <= PHASELESS:
        return load(table, curve, x)
    abscissa = z / amplitude_power(table, z)
    lowest: float = abscissa * (curve[0] * abscissa / (3.0 + table.k) - 1.0 - curve[1] * table.amplitude)
    return lowest


@kernel()
def _force_slopes(
    table: Any, curve: Curve, near: Any, units: Any, middle: float, x: float, at_rim: bool, by: Any
) -> float:
    """Put the slopes of the reduced force by b, g, ln x and k into `by`; return the force."""
    tables, curves, weights = near
    b, g, _ = curve
    k = table.k
    z, power, s0, s1, v, _, _ = wave(table, 0.0, x)
    front = z / (power * power)
    force = -_lowest_load_at(table, curve, x)
    by[0] = -front * z / (3.0 + k)
    by[1] = -front * (s0 - s1) if z <= PHASELESS else z / power * table.amplitude
    by[2] = 0.0
    if at_rim:
        by[2] = -front * (b * z + g * v - 0.5 * (3.0 + k) * power)
        if z > PHASELESS:
            abscissa = z / power
            by[2] = -abscissa * (b * abscissa - 0.5 * (3.0 + k) * (1.0 + g * table.amplitude))
    by[3] = middle * force
    for j in range(weights.size):
        other = (curves[j, 0], curves[j, 1], 0.0)
        by[3] -= weights[j] * units[j] * _lowest_load_at(tables[j], other, x)
    return force


@kernel()
def _put_depth(
    table: Any, curve: Curve, near: Any, units: Any, middle: float, unit: float, x: float, found: Any, i: int
) -> None:
    """Store the slopes of the depth at a rim: where the cycle turns at a depth, they say how the place moves."""
    tables, curves, weights = near
    b, g, _ = curve
    k = table.k
    c = 0.5 * (1.0 - k)
    z, _, s0, _, _, _, _ = wave(table, 0.0, x)
    d, _, _, value = slope(table, curve, c, x)
    bend, gain = 0.5 * b * z * z, g * z * s0
    found[BY_STIFFNESS, i] = 0.5 * unit * (bend + gain - value)
    found[BY_WAVELENGTH, i] = unit * (c * value + (2.0 - c) * bend + (1.0 - c) * gain - z * d)
    found[BY_AMPLITUDE, i] = unit * gain
    found[BY_RIM, i] = unit * z * d
    total = middle * unit * value
    for j in range(weights.size):
        total += weights[j] * units[j] * depth(tables[j], (curves[j, 0], curves[j, 1], 0.0), x)
    found[BY_EXPONENT, i] = total


@kernel()
def _smooth_trace(table: Any, curve: Curve, constants: Any, trace: Any) -> int:
    """Put the one branch of a smooth punch of b = 1 into the trace; return the number of branches."""
    _, z_in, _, z_out, _, _ = constants
    trace[RUN, GAP] = math.inf
    trace[START, 0], trace[END, 0], trace[END_DEPTH, 0] = z_out / TWO_PI, math.inf, math.inf
    trace[START_DEPTH, 0] = depth(table, curve, z_out / TWO_PI) if z_out > 0.0 else -1.0
    trace[ARRIVAL, 0], trace[UNLOADING_JUMPS, 0], trace[NEXT, 0] = z_in / TWO_PI, UNKNOWN, -1.0
    trace[LAST_DEPTH, 0] = trace[START_DEPTH, 0]
    return 1


@kernel()
def _energy_slopes(
    table: Any, curve: Curve, near: Any, count: int, trace: Any, x: float, final: float, slopes: Any, by: Any
) -> None:
    """Put the slopes of the reduced energy of a rim by b, g, ln x and k into `by`."""
    total = slopes[ROWS + 1, SLOPES : 2 * SLOPES]
    total[:] = 0.0
    rim_depth = depth(table, curve, x) if x < math.inf else math.inf
    by[2] = add_loading(table, curve, near, count, trace, x, slopes, total)
    by[2] += add_unloading(table, curve, near, count, trace, x, rim_depth, final, slopes, total)
    by[0], by[1], by[3] = total[BEND], total[GAIN], total[EXPONENT]


@kernel()
def _slopes_for(trace: Any) -> Any:
    """Return room for the slopes of a trace."""
    slopes = np.empty((ROWS + 2, max(trace.shape[1], ROOM)))
    slopes[:ROWS] = 0.0
    return slopes


@kernel()
def _energies(
    table: Any,
    curve: Curve,
    near: Any,
    middle: float,
    scale: float,
    wavelength: float,
    rims: Any,
    energies: Any,
    found: Any,
    status: Any,
    smooth_constants: Any,
    is_even: bool,
    arches: Any,
    scratch: Any,
) -> None:
    """Find the sensitivities of the energy for all rims of a curve."""
    k = table.k
    by = np.zeros(4)
    furthest = 0.0
    for i in range(rims.size):
        x = rims[i] / wavelength
        if not status[i] & NO_VALUE and (is_even or not is_long(table, arches, x)):
            furthest = max(furthest, x)
    if furthest > 0.0:
        if is_even:
            trace = scratch
            count = _smooth_trace(table, curve, smooth_constants, trace)
        else:
            count, trace = walk(table, curve, arches, furthest, scratch, NO)
        slopes = _slopes_for(trace)
        fill_loading(table, curve, near, count, trace, arches[1], slopes)
        for i in range(rims.size):
            x = rims[i] / wavelength
            if not status[i] & NO_VALUE and (is_even or not is_long(table, arches, x)):
                _energy_slopes(table, curve, near, count, trace, x, arches[1], slopes, by)
                value = energies[i] / scale
                by[3] += middle * value
                _put(found, k, curve, 2.0, 0.0, by, value, i)
    for i in range(rims.size):
        x = rims[i] / wavelength
        if not status[i] & NO_VALUE and not is_even and is_long(table, arches, x):
            count, trace = stride(table, curve, arches, x, scratch, NO, 1.0)
            slopes = _slopes_for(trace)
            fill_loading(table, curve, near, count, trace, arches[1], slopes)
            _energy_slopes(table, curve, near, count, trace, x, arches[1], slopes, by)
            value = energies[i] / scale
            by[3] += middle * value
            _put(found, k, curve, 2.0, 0.0, by, value, i)


@kernel()
def _sense_curve(
    table: Any,
    tables: Any,
    weights: Any,
    middle: float,
    stiffness: float,
    wavelength: float,
    amplitude: float,
    rims: Any,
    values: Any,
    radii: Any,
    turned: bool,
    found: Any,
    status: Any,
    scratch: Any,
) -> None:
    """Find the sensitivities of one curve for all its rims."""
    k = table.k
    stretch = math.sqrt(2.0 ** (1.0 + k) * math.pi / stiffness)
    constants = smooth.smooth_constants(k)
    even = is_endless_wave(wavelength, amplitude)
    if even:
        wavelength, amplitude = TWO_PI * smooth.smooth_length(k, stretch), 0.0
    curve, length, _ = curve_of(k, stretch, wavelength, amplitude * wavelength)
    arches = (0.0, 0.0)
    if not even and values[ENERGY].size > 0:
        arches = extent(table, curve)
        if is_smooth(arches):
            even = True
            wavelength, amplitude = TWO_PI * smooth.smooth_length(k, stretch), 0.0
            curve, length, _ = curve_of(k, stretch, wavelength, 0.0)
    # k changes at fixed M L^k, L the size of a contact: at fixed M each length would bring its logarithm
    scale_of_contact = stiffness ** (-1.0 / (3.0 + k))
    curves, units, depth_units = np.empty((weights.size, 2)), np.empty(weights.size), np.empty(weights.size)
    _, _, unit = curve_of(k, stretch, wavelength, 0.0)
    base = force_unit(k, length, unit)
    for j in range(weights.size):
        other = tables[j].k
        stretch = math.sqrt(2.0 ** (1.0 + other) * math.pi / stiffness * scale_of_contact ** (other - k))
        around, _, depth_units[j] = curve_of(other, stretch, wavelength, amplitude * wavelength)
        curves[j, 0], curves[j, 1], _ = around
        units[j] = force_unit(other, length, depth_units[j]) / base
    near = (tables, curves, weights)
    if values[FORCE].size > 0:
        by = np.zeros(4)
        for i in range(rims.size):
            if status[i] & NO_VALUE:
                continue
            at_rim = status[i] & PULL_OFF_AT_RIM != 0
            x = (rims[i] if at_rim else radii[i]) / wavelength
            force = _force_slopes(table, curve, near, units, middle, x, at_rim, by)
            _put(found[FORCE], k, curve, 2.0 - 0.5 * (1.0 - k), 0.5, by, force, i)
            if turned and at_rim:
                _put_depth(table, curve, near, depth_units, middle, unit, x, found[DEPTH], i)
    if values[ENERGY].size > 0:
        scale = TWO_PI * length * length
        _energies(
            table,
            curve,
            near,
            middle,
            scale,
            wavelength,
            rims,
            values[ENERGY],
            found[ENERGY],
            status,
            constants,
            even,
            arches,
            scratch,
        )
    found[:, BY_EXPONENT, :] += math.log(scale_of_contact) * found[:, BY_STIFFNESS, :]
    if even:
        found[:, BY_WAVELENGTH, :] = 0.0 * found[:, BY_WAVELENGTH, :]
        found[:, BY_AMPLITUDE, :] = 0.0 * found[:, BY_AMPLITUDE, :]


@kernel()
def sense_curves(
    table: Any,
    tables: Any,
    weights: Any,
    middle: float,
    index: Any,
    stiffness: Any,
    wavelength: Any,
    amplitude: Any,
    rims: Any,
    force: bool,
    energy: bool,
    values: Any,
    radii: Any,
    turned: bool,
    found: Any,
    status: Any,
    scratch: Any,
) -> None:
    """Find the sensitivities of the curves `index` of one exponent.

    Parameters
    ----------
    table, index, stiffness, wavelength, amplitude, rims, scratch
        As those of the loops of scene/solvers.py.
    tables, weights, middle
        What `neighbours_of` gives.
    force, energy
        What is asked for.
    values, radii, status
        What is solved already: the energies, the places of the pull-off, and the flags; shape (curves, rims).
    turned
        Whether the rims are places where cycles turn at a depth: the slopes of the depth there are found too.
    found
        Where the sensitivities go; shape (3, COUNT, curves, rims).
    """
    nothing = np.empty(0)
    for j in range(index.size):
        i = index[j]
        row = rims[i if rims.shape[0] > 1 else 0]
        if np.all((status[i] & NO_VALUE) != 0):
            continue
        solved = (values[i] if force else nothing, values[i] if energy else nothing)
        _sense_curve(
            table,
            tables,
            weights,
            middle,
            stiffness[i],
            wavelength[i],
            amplitude[i],
            row,
            solved,
            radii[i],
            turned,
            found[:, :, i],
            status[i],
            scratch,
        )
