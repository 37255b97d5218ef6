"""How force and energy of a general curve change with the numbers of a scene: M, lambda, A, a_max, k and the machine.

A curve has three numbers, B ~ lambda^(m-c) M^(1/2), g ~ A lambda^(1-c) M^(1/2) and the machine's share beta/alpha ~
lambda^(1+k) M/S, c = (1-k)/2 (curve/general.py), and its rim x = a_max/lambda. With f and h in units of
lambda^(2-c) M^(1/2) and lambda^2, and subscripts for slopes by ln B, ln g, ln(beta/alpha) and ln x,

    d ln F/d ln M = 1/2 + (f_B + f_g)/2f                  d ln H/d ln M = (h_B + h_g)/2h + h_s/h
    d ln F/d ln lambda = (2-c) + [(m-c) f_B + (1-c) f_g - f_x]/f
    d ln H/d ln lambda = 2 + [(m-c) h_B + (1-c) h_g + (1+k) h_s - h_x]/h
    d ln H/d ln S = -h_s/h

with S the stiffness of the machine itself; the load does not depend on it. See sensitivities/cosine_slopes.py.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Made, Series, coordinate, slope, state
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.pieces import NOTED_DOWN, NOTED_IN, NOTED_JUMP, NOTED_OUT, NOTED_UP, Notes
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.results import LOADING_PART, RADIUS, UNLOADING_PART, Results
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.sensitivities.cosine_slopes import (
    BY_AMPLITUDE,
    BY_EXPONENT,
    BY_MACHINE,
    BY_RIM,
    BY_STIFFNESS,
    BY_WAVELENGTH,
    DEPTH,
    ENERGY,
    FORCE,
    By,
)
from gradhesion.core.sensitivities.general_jump_slopes import NO_JUMP, Change, parts_of, rim_slope_of, rise_to
from gradhesion.core.sensitivities.general_wave_slopes import WaveSlopes, add_jump, add_jump_from_zero
from gradhesion.core.sensitivities.jump_slopes import BEND, EXPONENT, GAIN, SHARE, SLOPES
from gradhesion.core.sensitivities.jump_slopes import DEPTH as BY_LEVEL
from gradhesion.core.sensitivities.path_slopes import Traced, energy_slopes, fill_loading, with_slopes
from gradhesion.core.sensitivities.wanted import if_wanted
from gradhesion.core.types import Floats, Slopes
from gradhesion.core.waves.general import DOWN, NOWHERE, UP, Waves, room_for_waves
from gradhesion.core.waves.general_sum import add_waves

LN2: Final = math.log(2.0)
_OF_PATTERNS: Final = "gradhesion.core.sensitivities.patterned_slopes"
NOTES: Final = 4096
"""Notes of a cycle that there is room for."""


class Sense(NamedTuple):
    """What the sensitivities of all curves of one exponent need."""

    change: Change  # the change of the tables by k (harmonics/series_by_k.py): one record, of shape (1,), and the flat
    # array
    front_by_k: float  # the slope by k of ln of the factor of the punch (`depth_factor` of `curve_of`)
    k: float  # the exponent of the gradient
    m: float  # that of the punch
    found: Floats  # where the sensitivities go, of shape (3, COUNT, curves, rims)
    force: bool  # whether those of the pull-off force are wanted
    energy: int  # the parts of the cycle of whose energy they are wanted (`part_of` of problem/results.py), 0 for none
    turned: bool  # whether the rims are places where cycles turn


class ByExponent(NamedTuple):
    """Slopes by k at fixed M L^k, L the size of a contact (at fixed M each length would bring its logarithm).

    Those of ln B, ln g, ln of the machine's share, and ln of the units of force and of depth.
    """

    bend: float
    gain: float
    share: float
    force: float
    depth: float


class Sensed(NamedTuple):
    """What the sensitivities of one curve need, and where they go."""

    change: Change  # as of `Sense`
    k: float  # the exponents of the gradient and of the punch
    m: float
    by_k: ByExponent  # how the numbers and units of the curve change with k
    size: float  # ln L, the size of a contact, in R
    found: Floats  # where the sensitivities go, of shape (3, COUNT, rims)
    force: bool  # as of `Sense`
    energy: int
    turned: bool
    wavy: bool  # whether the amplitude is positive


@if_wanted("sense", Sense, _OF_PATTERNS)
@kernel()
def sensed_by(sense: Sense, curves: GeneralCurves, made: Made, i: int) -> Sensed:
    """Return the record of curve number i from that of all."""
    change, front_by_k, k, m, found, force, energy, turned = sense
    stretch, compliance = curves.stretch[i], curves.compliance[i]
    stiffness = 2.0 ** (1.0 + k) * math.pi / (stretch * stretch)
    size = -math.log(stiffness) / (2.0 * m - 1.0 + k)
    length = math.log(made.length)
    unit = 0.5 * (LN2 + size - length)  # of s l^c
    share = length - size - LN2 - 1.0 / (1.0 + k) if 0.0 < compliance < math.inf else 0.0
    by_k = ByExponent(front_by_k - unit, -unit, share, -1.0 / (1.0 + k) - unit, unit)
    return Sensed(change, k, m, by_k, size, found[:, :, i], force, energy, turned, curves.amplitude[i] > 0.0)


@kernel()
def _put(own: Sensed, row: int, powers: tuple[float, float, float], by: By, value: float, i: int) -> None:
    """Store the sensitivities of a value of rim number i, in the row FORCE or ENERGY, from its slopes.

    `powers` are those of lambda and of M in its unit, and the slope by k of ln of this.
    """
    unit, half, unit_by_k = powers
    k, m, by_k, found = own.k, own.m, own.by_k, own.found[row]
    c = 0.5 * (1.0 - k)
    if not abs(value) > 0.0:
        found[:, i] = math.nan
        return
    bend, gain, share, rim = by.bend / value, by.gain / value, by.share / value, by.rim / value
    found[BY_STIFFNESS, i] = half + 0.5 * (bend + gain) + share
    found[BY_WAVELENGTH, i] = unit + (m - c) * bend + (1.0 - c) * gain + (1.0 + k) * share - rim
    found[BY_AMPLITUDE, i] = gain
    found[BY_RIM, i] = rim
    by_exponent = by.exponent / value + by_k.bend * bend + by_k.gain * gain + by_k.share * share + unit_by_k
    found[BY_EXPONENT, i] = by_exponent + own.size * found[BY_STIFFNESS, i]  # at fixed M
    found[BY_MACHINE, i] = -share


@kernel()
def _put_depth(basis: Basis, curve: Series, own: Sensed, unit: float, x: float, i: int) -> None:
    """Store the slopes of the depth at rim number i, x, in R: where cycles turn at a depth, how the place moves."""
    change, k, m, found = own.change, own.k, own.m, own.found
    B, _, g, _, _ = curve
    c = 0.5 * (1.0 - k)
    held = Series(B, m, g, 1.0, 0.0)
    z, _, _, depth, _ = state(basis, curve, x)
    bend, gain, _, by_k = parts_of(basis, held, change, x, 0.0)
    steepness, _, _ = slope(basis, held, x)
    found[DEPTH, BY_STIFFNESS, i] = 0.5 * unit * (bend + gain - depth)
    found[DEPTH, BY_WAVELENGTH, i] = unit * (c * depth + (m - c) * bend + (1.0 - c) * gain - z * steepness)
    found[DEPTH, BY_AMPLITUDE, i] = unit * gain
    found[DEPTH, BY_RIM, i] = unit * z * steepness
    found[DEPTH, BY_MACHINE, i] = 0.0
    by_exponent = unit * (by_k + own.by_k.bend * bend + own.by_k.gain * gain + own.by_k.depth * depth)
    found[DEPTH, BY_EXPONENT, i] = by_exponent + own.size * found[DEPTH, BY_STIFFNESS, i]  # at fixed M


@if_wanted("own", Sensed, _OF_PATTERNS)
@kernel()
def put_rest(basis: Basis, made: Made, own: Sensed, rims: Floats, results: Results) -> None:
    """Store the sensitivities of the pull-off forces of a curve, whose places and flags are there, for all rims.

    Where cycles turn at a depth, those of the depth at the rim as well; `rims` are a_max/R, of shape (rims,).
    """
    curve, (B, m, g, _, _) = made.curve, made.curve
    found = own.found
    pulled = Series(B, m, g, 0.0, 1.0)
    powers = (2.0 - 0.5 * (1.0 - own.k), 0.5, own.by_k.force)
    for i in range(rims.size):
        if results.status[i] & NO_VALUE or not own.force:
            continue
        at_rim = results.status[i] & PULL_OFF_AT_RIM != 0
        x = (rims[i] if at_rim else results.out[results.slots[RADIUS], i]) / made.wavelength
        force = -coordinate(basis, pulled, x)
        bend, gain, _, by_k = parts_of(basis, pulled, own.change, x, 0.0)
        by_rim = 0.0
        if at_rim:
            _, _, rate = slope(basis, pulled, x)
            by_rim = -TWO_PI * x * rate
        _put(own, FORCE, powers, By(-bend, -gain, by_rim, -by_k, 0.0), force, i)
        if own.turned and at_rim:
            _put_depth(basis, curve, own, made.depth, x, i)
    if not own.wavy or basis.series.shape[0] == 0:
        found[:, BY_WAVELENGTH, :] = 0.0 * found[:, BY_WAVELENGTH, :]
        found[:, BY_AMPLITUDE, :] = 0.0 * found[:, BY_AMPLITUDE, :]


@kernel()
def _put_total(own: Sensed, total: Slopes, by_rim: float, energy: float, i: int) -> None:
    """Store the sensitivities of the energy of rim number i, in 2 pi l^2 dgamma, from its slopes (SLOPES,)."""
    by = By(total[BEND], total[GAIN], by_rim, total[EXPONENT], total[SHARE])
    _put(own, ENERGY, (2.0, 0.0, 0.0), by, energy, i)


@if_wanted("own", Sensed, _OF_PATTERNS)
@kernel()
def slopes_of(basis: Basis, curve: Series, own: Sensed, count: int, trace: Floats) -> Traced:
    """Return the slopes that go with a trace of `count` branches; those of loading filled in, if they are wanted."""
    slopes = with_slopes(count, trace, 0.0)
    if own.energy > 0:
        fill_loading(basis, curve, own.change, slopes)
    return slopes


@if_wanted("own", Sensed, _OF_PATTERNS)
@kernel()
def put_energy(basis: Basis, curve: Series, own: Sensed, slopes: Traced, x: float, energy: float, i: int) -> None:
    """Store the sensitivities of the energy of rim number i, at x, read off the trace that the energy was read off.

    The energy is in 2 pi l^2 dgamma.
    """
    if own.energy == 0:
        return
    total = np.empty(SLOPES)
    level = coordinate(basis, curve, x) if x < math.inf else math.inf
    by_rim = energy_slopes(basis, curve, own.change, slopes, x, level, own.energy, total)
    _put_total(own, total, by_rim, energy, i)


@if_wanted("own")
@kernel()
def put_noted(
    basis: Basis, curve: Series, own: Sensed, cut: float, notes: Notes, rim: tuple[float, float], energy: float, i: int
) -> None:
    """Store the sensitivities of the energy of rim number i of a long cycle, in 2 pi l^2 dgamma, from its notes.

    Its waves are cut at `cut` (waves/general.py); the rim is x beyond some whole waves.
    """
    if own.energy == 0:
        return
    change = own.change
    x, whole = rim
    total, by_rim = np.zeros(SLOPES), 0.0
    work = room_for_waves(basis.series)
    count = int(notes[0, 0])
    if count >= notes.shape[0]:
        total[:] = math.nan
        count = 0
    for n in range(1, count + 1):
        kind, waves, start, end = int(notes[n, 0]), notes[n, 1], notes[n, 2], notes[n, 3]
        outwards = kind in (NOTED_UP, NOTED_IN) or (kind == NOTED_JUMP and end > start)
        if not own.energy & (LOADING_PART if outwards else UNLOADING_PART):
            continue
        before = total[BY_LEVEL]
        if kind in (NOTED_UP, NOTED_DOWN):
            run = Waves(UP if kind == NOTED_UP else DOWN, cut, NOWHERE, work)
            add_waves(basis, curve, WaveSlopes(change, NO_JUMP), run, start, end, total)
        elif kind == NOTED_JUMP:
            add_jump(basis, curve, change, start, end, waves, total)
            if notes[n, 4] > 0.0:  # the rim cuts it
                u = rise_to(basis, curve, change, start, waves, end)
                by_rim -= (TWO_PI * (waves + end)) ** 2 * u * (2.0 + u)
        else:
            add_jump_from_zero(basis, curve, change, start, waves, kind == NOTED_OUT, total)
            if notes[n, 4] > 0.0:
                by_rim += rim_slope_of(basis, curve, 0.0, start, waves)
        if kind in (NOTED_JUMP, NOTED_OUT) and waves == whole and start == x:  # unloading leaves the rim
            _, _, rate = slope(basis, curve, x, whole)
            by_rim += (total[BY_LEVEL] - before) * rate * TWO_PI * (whole + x)
    _put_total(own, total, by_rim, energy, i)
