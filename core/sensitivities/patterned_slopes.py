"""How force and energy on a patterned interface change with the numbers of a scene: exact derivatives.

At fixed radii (docs/theory.md): folds are stationary and the integrand of a jump vanishes where it lands, so that

    dF/dp = -dP/dp                de/dp = int 2 z [kappa kappa_p - rho rho_p] dz
    rho_p = [alpha depth_p + t load_p + t_p (load - rho z^c) - Y_p]/((alpha + t) z^c) - rho (ln Delta)_p

with t = beta z^(1+k), depth and load those of the punch without adhesion, the load over z^(1+k), and Y_p that of the
place which the jump leaves. Lengths and depths are held in units of the curve as it is: p are ln M, ln lambda, ln A,
ln a_max, k at fixed M, ln S, ln lambda_t and the logarithm of the amplitude of the pattern.
"""

import math
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, YES, constant, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, LANDING, NEXT, START, Trace
from gradhesion.core.curve.general import Basis, Made, Patterned, coordinate, slope
from gradhesion.core.curve.general_energy import balance, place_left, rise_from
from gradhesion.core.curve.panels import (
    INNER_PLACES,
    INNER_SHARES,
    PLACES,
    SHARES,
    panel_inwards,
    panel_outwards,
    panels_to_zero,
)
from gradhesion.core.curve.patterned import toughness_at
from gradhesion.core.face import measured_by, shortest_wave
from gradhesion.core.harmonics.series import sums
from gradhesion.core.harmonics.series_by_k import sums_by_k
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.unloading import descend, leave_rim
from gradhesion.core.problem.curves import PatternedCurves
from gradhesion.core.problem.results import LOADING_PART, RADIUS, UNLOADING_PART, Results
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.sensitivities import general_slopes
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
)
from gradhesion.core.sensitivities.cosine_slopes import COUNT as OF_PROFILES
from gradhesion.core.sensitivities.general_slopes import Sense
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats

BY_PATTERN_LENGTH, BY_PATTERN = constant(OF_PROFILES), constant(OF_PROFILES + 1)
"""Rows of what is found, behind those of cosine_slopes.py."""
COUNT: Final = OF_PROFILES + 2
LEVEL: Final = constant(COUNT)
"""The slope of the energy of a jump by its coordinate alone, in the column behind."""
BY_DEPTH, BY_LOAD, BY_TOUGHNESS, BY_STRETCH, BY_SHARE = map(constant, range(5))
"""Rows of `parts`: depth, load, kappa, and the logarithms of Delta and of t, by all p."""
LN2: Final = math.log(2.0)

Walked: TypeAlias = tuple[int, Trace]
"""The number of branches, and the trace (path/general.py)."""


class PatternedSense(Sense):
    """What the sensitivities of all curves of one exponent need; `COUNT` is that of this module."""

    __slots__ = ()


class Sensed(NamedTuple):
    """What the sensitivities of one curve need, and where they go."""

    change: Any  # as of `Sense`
    front_by_k: float
    log_length: float  # ln of the unit of z, in R
    found: Floats  # where the sensitivities go, of shape (3, COUNT, rims)
    force: bool  # as of `Sense`
    energy: int


class At(NamedTuple):
    """A place: z, z^c, t, kappa, and the load without adhesion over z^(1+k)."""

    z: float
    stretch: float
    share: float
    toughness: float
    load: float


@general_slopes.sensed_by.answers(PatternedSense)
@kernel()
def sensed_by(sense: Sense, _curves: PatternedCurves, made: Made, i: int) -> Sensed:
    """Return the record of curve number i from that of all."""
    found = sense.found[:, :, i]
    return Sensed(sense.change, sense.front_by_k, math.log(made.length), found, sense.force, sense.energy)


@general_slopes.slopes_of.answers(Sensed)
@kernel()
def slopes_of(_basis: Basis, _curve: Patterned, _own: Sensed, count: int, trace: Trace) -> Walked:
    """Return the trace as it is."""
    return count, trace


@kernel()
def fill_parts(basis: Basis, curve: Patterned, own: Sensed, x: float, parts: Floats) -> At:
    """Fill `parts`, of shape (5, COUNT), at x > 0."""
    table, pattern, _ = basis
    B, m, _, alpha, beta = curve
    k, g, change = table.k, pattern.gain, own.change
    z = TWO_PI * x
    power = amplitude_power(table, z)
    bend, share, log_radius = B * z**m, m / (1.0 + k + m), math.log(z) + own.log_length
    kappa, rate, _ = toughness_at(basis, x)
    parts[:] = 0.0
    w0, w1, v, w0_k, w1_k = 0.0, 0.0, 0.0, 0.0, 0.0
    if g > 0.0:
        _, _, v, _ = sums(table, pattern.cosine_bins, pattern.waves, x, 0.0)
        w0, w1, w0_k, w1_k = sums_by_k(table, pattern.cosine_bins, pattern.waves, change[0][0], change[1], x, 0.0)
    wave = g * z
    parts[BY_DEPTH, BY_WAVELENGTH], parts[BY_LOAD, BY_WAVELENGTH] = wave * (w0 - v), wave * ((2.0 + k) * w1 - v)
    parts[BY_DEPTH, BY_AMPLITUDE], parts[BY_LOAD, BY_AMPLITUDE] = wave * w0, wave * w1
    parts[BY_DEPTH, BY_EXPONENT] = bend * own.front_by_k + wave * w0_k
    parts[BY_LOAD, BY_EXPONENT] = bend * share * (own.front_by_k - 1.0 / (1.0 + k + m)) + wave * w1_k
    parts[BY_STRETCH, BY_STIFFNESS], parts[BY_STRETCH, BY_EXPONENT] = -0.5, 0.5 * (LN2 - log_radius)
    parts[BY_SHARE, BY_EXPONENT] = log_radius
    if alpha > 0.0:
        parts[BY_SHARE, BY_STIFFNESS], parts[BY_SHARE, BY_MACHINE] = 1.0, -1.0
        parts[BY_SHARE, BY_EXPONENT] -= LN2 + 1.0 / (1.0 + k)
    parts[BY_TOUGHNESS, BY_PATTERN_LENGTH] = -z * rate
    parts[BY_TOUGHNESS, BY_PATTERN] = 0.5 * (kappa * kappa - 1.0) / kappa if pattern.of_work else kappa - 1.0
    return At(z, z * power, beta / (power * power), kappa, bend * share + wave * w1)


@kernel()
def _slopes_of_level(curve: Patterned, at: At, parts: Floats, level: Floats) -> None:
    """Put the slopes of the coordinate at a place into `level`, of shape (COUNT,)."""
    pull = at.toughness * at.stretch
    for p in range(COUNT):
        fall = at.stretch * (parts[BY_TOUGHNESS, p] + at.toughness * parts[BY_STRETCH, p])
        level[p] = curve.alpha * (parts[BY_DEPTH, p] - fall)
        level[p] += at.share * (parts[BY_LOAD, p] - fall + parts[BY_SHARE, p] * (at.load - pull))


@kernel()
def _add_density(
    curve: Patterned, at: At, parts: Floats, level: Floats, u: float, weight: float, total: Floats
) -> None:
    """Add `weight` times the integrand; u is rho - kappa."""
    rho, over = at.toughness + u, 1.0 / ((curve.alpha + at.share) * at.stretch)
    for p in range(COUNT):
        rise = curve.alpha * parts[BY_DEPTH, p] - level[p]
        rise += at.share * (parts[BY_LOAD, p] + parts[BY_SHARE, p] * (at.load - rho * at.stretch))
        by_rho = rise * over - rho * parts[BY_STRETCH, p]
        total[p] += 2.0 * weight * at.z * (at.toughness * parts[BY_TOUGHNESS, p] - rho * by_rho)
    total[LEVEL] += 2.0 * weight * at.z * rho * over


class Room(NamedTuple):
    """Room for the numbers of a place, and of the coordinate of a jump."""

    parts: Floats  # of shape (5, COUNT)
    level: Floats  # of shape (COUNT,)


@kernel()
def add_jump(basis: Basis, curve: Patterned, own: Sensed, start: float, end: float, room: Room, total: Floats) -> None:
    """Add the slopes of a jump from the curve at x = start > 0, or from zero contact at Y = 0, to x = end >= 0.

    `total` is of shape (COUNT + 1,), in 2 pi l^2 dgamma.
    """
    parts, level, shortest = room.parts, room.level, shortest_wave(basis, curve)
    level[:] = 0.0
    if start > 0.0:
        at = fill_parts(basis, curve, own, start, parts)
        _slopes_of_level(curve, at, parts, level)
    scale = TWO_PI * (1.0 if end > start else -1.0)
    if start > 0.0 and end > 0.0:
        left, low, high = place_left(basis, curve, start, 0.0), min(start, end), max(start, end)
        while low < high:
            width, beyond, first, last = panel_outwards(low, high, 0.0, shortest)
            for i in range(first, last):
                x = low + width * PLACES[i]
                at = fill_parts(basis, curve, own, x, parts)
                u = rise_from(basis, curve, left, x, 0.0)
                _add_density(curve, at, parts, level, u, scale * width * SHARES[i], total)
            low = beyond
        return
    high = max(start, end)
    of_start = coordinate(basis, curve, start) if start > 0.0 else 0.0
    inner, growth = panels_to_zero(basis.table.k, curve.alpha, curve.beta, high, shortest)
    while high > 0.0:
        low, first, last = panel_inwards(high, growth, shortest)
        innermost = not high > inner
        for i in range(0 if innermost else first, INNER_PLACES.size if innermost else last):
            x = high * INNER_PLACES[i] if innermost else low + (high - low) * PLACES[i]
            weight = high * INNER_SHARES[i] if innermost else (high - low) * SHARES[i]
            at = fill_parts(basis, curve, own, x, parts)
            value, over = balance(basis, curve, x)
            _add_density(curve, at, parts, level, (value - of_start) / over, scale * weight, total)
        high = 0.0 if innermost else low


@kernel()
def _add_loading(
    basis: Basis, curve: Patterned, own: Sensed, walked: Walked, rim: float, room: Room, total: Floats
) -> None:
    """Add the slopes of loading up to a rim."""
    count, trace = walked
    left, level = 0.0, 0.0
    for branch in range(count):
        if trace[ARRIVAL, branch] <= rim and trace[ARRIVAL, branch] < math.inf:
            if trace[ARRIVAL, branch] > 0.0:
                add_jump(basis, curve, own, left, trace[ARRIVAL, branch], room, total)
            left, level = trace[END, branch], trace[END_DEPTH, branch]
    if left < rim:
        add_jump(basis, curve, own, left, rim, room, total)
        value, over = balance(basis, curve, rim)
        kappa, _, _ = toughness_at(basis, rim)
        u = (value - level) / over
        total[BY_RIM] -= (TWO_PI * rim) ** 2 * u * (2.0 * kappa + u)


@kernel()
def _add_unloading(
    basis: Basis, curve: Patterned, own: Sensed, walked: Walked, rim: float, room: Room, total: Floats
) -> None:
    """Add the slopes of unloading from a rim; under a dead load the jump-out has no energy."""
    count, trace = walked
    level = coordinate(basis, curve, rim) if rim < math.inf else math.inf
    now, landing = leave_rim(basis, curve, count, trace, rim, level)
    if now < 0 or landing != rim:
        before = total[LEVEL]
        if now >= 0 or curve.alpha > 0.0:
            add_jump(basis, curve, own, rim, landing if now >= 0 else 0.0, room, total)
        _, _, rate = slope(basis, curve, rim)
        total[BY_RIM] += (total[LEVEL] - before) * rate * TWO_PI * rim
    if now >= 0:
        descend(basis, curve, trace, now, NO)
    while now >= 0 and trace[START, now] > 0.0:
        lower = int(trace[NEXT, now])
        if lower >= 0 or curve.alpha > 0.0:
            end = trace[LANDING, now] if lower >= 0 else 0.0
            add_jump(basis, curve, own, trace[START, now], end, room, total)
        now = lower


@general_slopes.put_energy.answers(Sensed)
@kernel()
def put_energy(basis: Basis, curve: Patterned, own: Sensed, walked: Walked, x: float, energy: float, i: int) -> None:
    """Store the sensitivities of the energy from all jumps of the trace, each by quadrature."""
    if own.energy == 0:
        return
    total, room = np.zeros(COUNT + 1), Room(np.empty((5, COUNT)), np.empty(COUNT))
    if own.energy & LOADING_PART:
        _add_loading(basis, curve, own, walked, x, room, total)
    if own.energy & UNLOADING_PART:
        _add_unloading(basis, curve, own, walked, x, room, total)
    for p in range(COUNT):
        own.found[ENERGY, p, i] = total[p] / energy if energy > 0.0 else math.nan


@general_slopes.put_rest.answers(Sensed)
@kernel()
def put_rest(basis: Basis, made: Made, own: Sensed, rims: Floats, results: Results) -> None:
    """Store those of the depth for all rims as well."""
    curve, k, parts, found = made.curve, basis.table.k, np.empty((5, COUNT)), own.found
    for i in range(rims.size):
        if results.status[i] & NO_VALUE or not own.force:
            continue
        at_rim = results.status[i] & PULL_OFF_AT_RIM != 0
        x = (rims[i] if at_rim else results.out[results.slots[RADIUS], i]) / made.wavelength
        if not x > 0.0:
            continue
        at = fill_parts(basis, curve, own, x, parts)
        load = at.load - at.toughness * at.stretch
        for p in range(COUNT):
            fall = at.stretch * (parts[BY_TOUGHNESS, p] + at.toughness * parts[BY_STRETCH, p])
            found[FORCE, p, i] = (parts[BY_LOAD, p] - fall) / load
            found[DEPTH, p, i] = made.depth * (parts[BY_DEPTH, p] - fall)
        found[FORCE, BY_STIFFNESS, i] += 1.0
        found[FORCE, BY_EXPONENT, i] += math.log(at.z) + own.log_length - LN2 - 1.0 / (1.0 + k)
        if at_rim:
            front = (at.z / at.stretch) ** 2
            _, _, rate = slope(basis, measured_by(curve, YES), x)
            found[FORCE, BY_RIM, i] = at.z * rate / (front * load)
            _, _, rate = slope(basis, measured_by(curve, NO), x)
            found[DEPTH, BY_RIM, i] = made.depth * at.z * rate
