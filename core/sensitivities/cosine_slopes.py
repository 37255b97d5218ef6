"""How force and energy of one cosine wave change with the numbers of a scene: M, lambda, A, a_max and k.

A curve has two numbers, b ~ lambda^(2-c) M^(1/2) and g ~ A lambda^(1-c) M^(1/2), and its rim x = a_max/lambda
(curve/cosine.py). With the units lambda^(2-c) M^(1/2) of the force and lambda^2 of the energy, and f and h in these
units,

    d ln F/d ln M = 1/2 + (b f_b + g f_g)/2f              d ln H/d ln M = (b h_b + g h_g)/2h
    d ln F/d ln A = g f_g/f                               d ln H/d ln A = g h_g/h
    d ln F/d ln a_max = x f_x/f                           d ln H/d ln a_max = x h_x/h
    d ln F/d ln lambda = (2-c) + [(2-c) b f_b + (1-c) g f_g - x f_x]/f,    2 in the place of the first for H

The pull-off is a minimum of the load, or stands at the rim: its place may be fixed.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.closed import smooth
from gradhesion.core.compiler.jit import ONE, constant, kernel
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
    Trace,
)
from gradhesion.core.curve.cosine import Cosine, curve_of, depth, load, slope, wave
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.results import RADIUS, Results, energy_of
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.sensitivities.jump_slopes import BEND, EXPONENT, GAIN, SLOPES
from gradhesion.core.sensitivities.neighbours import Near
from gradhesion.core.sensitivities.path_slopes import Traced, energy_slopes, fill_loading, with_slopes
from gradhesion.core.sensitivities.wanted import if_wanted
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Table

BY_STIFFNESS, BY_WAVELENGTH, BY_AMPLITUDE, BY_RIM, BY_EXPONENT, BY_MACHINE = map(constant, range(6))
"""Rows of what is found; that of k is at fixed M, and only general scenes have a machine."""
COUNT = 6
FORCE, ENERGY, DEPTH = 0, 1, 2
"""What is differentiated: the last one is the depth at the rim, over R, not its logarithm."""
_PHASELESS: Final = 1e12
"""z from which on a double resolves no phase; the slopes are those of the lowest troughs then."""


class Sense(NamedTuple):
    """What sensitivities need; of all curves for their loop, of one for the rest, without the first axis of curves."""

    tables: Any  # the tables of neighbouring exponents (sensitivities/neighbours.py), of shape (exponents, 4), or (4,)
    weights: Floats  # their weights in d/dk, of the same shape
    found: Floats  # where the sensitivities go, of shape (3, COUNT, curves, rims), or (3, COUNT, rims)
    force: bool  # whether those of the pull-off force are wanted
    energy: int  # the parts of the cycle of whose energy they are wanted (`part_of` of problem/results.py), 0 for none
    turned: bool  # whether the rims are places where cycles turn


class Sensed(NamedTuple):
    """What the sensitivities of one curve need, and where they go."""

    near: Near  # the curve at neighbouring exponents
    units: Floats  # the units there: of force over that of the curve, and of depth in R; of shape (2, 4)
    size: float  # ln L, the size of a contact, in R
    found: Floats  # where the sensitivities go, of shape (3, COUNT, rims)
    force: bool  # as of `Sense`
    energy: int
    turned: bool  # whether the rims are places where cycles turn


class By(NamedTuple):
    """Slopes of a reduced force or energy."""

    bend: float  # by b, of a general curve by ln B
    gain: float  # by g, or ln g
    rim: float  # by ln x
    exponent: float  # by k
    share: float  # of a general curve by ln(beta/alpha)


@kernel()
def _put(
    found: Floats, k: float, curve: Cosine, powers: tuple[float, float], size: float, by: By, value: float, i: int
) -> None:
    """Store the sensitivities of a value of rim number i, into `found` of shape (COUNT, rims), from its slopes.

    `powers` are those of lambda and of M in its unit. The slope by k, at fixed M L^k, becomes that at fixed M by `size`
    (`Sensed`).
    """
    unit, half = powers
    b, g, _ = curve
    c = 0.5 * (1.0 - k)
    if not abs(value) > 0.0:
        found[:, i] = math.nan
        return
    found[BY_MACHINE, i] = 0.0
    bend, gain, rim = b * by.bend / value, g * by.gain / value, by.rim / value
    found[BY_STIFFNESS, i] = half + 0.5 * (bend + gain)
    found[BY_WAVELENGTH, i] = unit + (2.0 - c) * bend + (1.0 - c) * gain - rim
    found[BY_AMPLITUDE, i] = gain
    found[BY_RIM, i] = rim
    found[BY_EXPONENT, i] = by.exponent / value + size * found[BY_STIFFNESS, i]


@kernel()
def _lowest_load_at(table: Table, curve: Cosine, x: float) -> float:
    """Return the load at x, beyond all phases that of the lowest trough there."""
    z = TWO_PI * x
    if z <= _PHASELESS:
        return load(table, curve, x)
    abscissa = z / amplitude_power(table, z)
    lowest: float = abscissa * (curve.bend * abscissa / (3.0 + table.k) - 1.0 - curve.gain * table.amplitude)
    return lowest


@kernel()
def _force_slopes(table: Table, curve: Cosine, sensed: Sensed, x: float, at_rim: bool) -> tuple[float, By]:
    """Return the reduced force at x, and its slopes."""
    (tables, curves, weights), units = sensed.near, sensed.units[0]
    b, g, _ = curve
    k = table.k
    z, power, s0, s1, v, _, _ = wave(table, 0.0, x)
    front = z / (power * power)
    force = -_lowest_load_at(table, curve, x)
    by_gain = -front * (s0 - s1) if z <= _PHASELESS else z / power * table.amplitude
    by_rim, by_exponent = 0.0, 0.0
    if at_rim:
        by_rim = -front * (b * z + g * v - 0.5 * (3.0 + k) * power)
        if z > _PHASELESS:
            abscissa = z / power
            by_rim = -abscissa * (b * abscissa - 0.5 * (3.0 + k) * (1.0 + g * table.amplitude))
    for j in range(weights.size):
        other = Cosine(curves[j, 0], curves[j, 1], 0.0)
        by_exponent -= weights[j] * units[j] * _lowest_load_at(tables[j], other, x)
    return force, By(-front * z / (3.0 + k), by_gain, by_rim, by_exponent, 0.0)


@kernel()
def _put_depth(table: Table, curve: Cosine, sensed: Sensed, unit: float, x: float, i: int) -> None:
    """Store the slopes of the depth at rim number i, x: where the cycle turns at a depth, they say how the place moves.

    `unit` is the unit of depth in R.
    """
    (tables, curves, weights), units, found = sensed.near, sensed.units[1], sensed.found[DEPTH]
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
    total = 0.0
    for j in range(weights.size):
        total += weights[j] * units[j] * depth(tables[j], Cosine(curves[j, 0], curves[j, 1], 0.0), x)
    found[BY_EXPONENT, i] = total + sensed.size * found[BY_STIFFNESS, i]


@kernel()
def smooth_trace(table: Table, curve: Cosine, trace: Trace) -> int:
    """Put the one branch of a smooth punch of b = 1 into a trace (curve/branches.py); return the number of branches."""
    _, z_in, z_out, _ = smooth.smooth_places(table.k)
    trace[RUN, GAP] = math.inf
    trace[START, 0], trace[END, 0], trace[END_DEPTH, 0] = z_out / TWO_PI, math.inf, math.inf
    trace[START_DEPTH, 0] = depth(table, curve, z_out / TWO_PI) if z_out > 0.0 else -1.0
    trace[ARRIVAL, 0], trace[UNLOADING_JUMPS, 0], trace[NEXT, 0] = z_in / TWO_PI, UNKNOWN, -1.0
    trace[LAST_DEPTH, 0] = trace[START_DEPTH, 0]
    return ONE


@if_wanted("sense")
@kernel()
def of_curve(sense: Sense, i: int, which: int) -> Sense:
    """Return the record of curve i, of exponent `which`, from that of all curves."""
    tables, weights, found, force, energy, turned = sense
    return Sense(tables[which], weights[which], found[:, :, i], force, energy, turned)


@if_wanted("sense")
@kernel()
def sensed_by(table: Table, sense: Sense, stretch: float, wavelength: float, amplitude: float) -> Sensed:
    """Return what the sensitivities of a curve (s, lambda/R, A) need.

    k changes at fixed M L^k, L the size of a contact: at fixed M each length would bring its logarithm.
    """
    tables, weights, found, force, energy, turned = sense
    k = table.k
    curves, units = np.empty((weights.size, 2)), np.empty((2, weights.size))
    (b, g, _), length, unit = curve_of(k, stretch, wavelength, amplitude * wavelength)
    # s^2 is 2^(1+k) pi/M: with M L^k it changes by (2 L)^(k' - k), and l^c by l^((k - k')/2)
    size = math.log(2.0 ** (1.0 + k) * math.pi / (stretch * stretch)) / -(3.0 + k)
    rate = 0.5 * (math.log(2.0 / length) + size)
    for j in range(weights.size):
        other = tables[j].k
        ratio = math.exp(rate * (other - k))
        share = (1.0 + k) / ((1.0 + other) * ratio)
        curves[j, 0], curves[j, 1] = b * share, g / ratio
        units[0, j], units[1, j] = share, unit * ratio
    return Sensed(Near(tables, curves, weights), units, size, found, force, energy, turned)


@if_wanted("sensed")
@kernel()
def put_rest(
    table: Table, curve: Cosine, sensed: Sensed, unit: float, wavelength: float, rims: Floats, results: Results
) -> None:
    """Store the sensitivities of the pull-off forces of a curve, whose places and flags are there, for all rims.

    Where cycles turn at a depth, those of the depth at the rim as well; `unit` is that of depth in R, `rims` are
    a_max/R, of shape (rims,).
    """
    powers, found = (2.0 - 0.5 * (1.0 - table.k), 0.5), sensed.found
    for i in range(rims.size):
        if results.status[i] & NO_VALUE or not sensed.force:
            continue
        at_rim = results.status[i] & PULL_OFF_AT_RIM != 0
        x = (rims[i] if at_rim else results.out[results.slots[RADIUS], i]) / wavelength
        force, by = _force_slopes(table, curve, sensed, x, at_rim)
        _put(found[FORCE], table.k, curve, powers, sensed.size, by, force, i)
        if sensed.turned and at_rim:
            _put_depth(table, curve, sensed, unit, x, i)


@if_wanted("sensed")
@kernel()
def put_energy(table: Table, curve: Cosine, sensed: Sensed, slopes: Traced, x: float, energy: float, i: int) -> None:
    """Store the sensitivities of the energy of rim number i, at x, read off the trace that the energy was read off.

    The energy is in 2 pi l^2 dgamma.
    """
    total = np.empty(SLOPES)
    rim_depth = depth(table, curve, x) if x < math.inf else math.inf
    by_rim = energy_slopes(table, curve, sensed.near, slopes, x, rim_depth, sensed.energy, total)
    by = By(total[BEND], total[GAIN], by_rim, total[EXPONENT], 0.0)
    _put(sensed.found[ENERGY], table.k, curve, (2.0, 0.0), sensed.size, by, energy, i)


@if_wanted("sense")
@kernel()
def put_smooth(table: Table, stretch: float, rims: Floats, results: Results, sense: Sense, trace: Trace) -> None:
    """Store the sensitivities of a smooth punch, whose values are there, for all rims a_max/R, of shape (rims,).

    `trace` is room for one branch, of shape (ROWS, 8 or more).
    """
    wavelength = TWO_PI * smooth.smooth_length(table.k, stretch)
    curve, length, unit = curve_of(table.k, stretch, wavelength, 0.0)
    sensed = sensed_by(table, sense, stretch, wavelength, 0.0)
    if sense.energy:
        slopes = with_slopes(smooth_trace(table, curve, trace), trace, 0.0)
        fill_loading(table, curve, sensed.near, slopes)
        scale = TWO_PI * length * length
        for i in range(rims.size):
            energy = energy_of(results, sense.energy, i) / scale
            put_energy(table, curve, sensed, slopes, rims[i] / wavelength, energy, i)
    put_rest(table, curve, sensed, unit, wavelength, rims, results)
    found = sensed.found
    found[:, BY_WAVELENGTH, :] = 0.0 * found[:, BY_WAVELENGTH, :]
    found[:, BY_AMPLITUDE, :] = 0.0 * found[:, BY_AMPLITUDE, :]
