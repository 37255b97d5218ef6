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

from gradhesion.core.compiler.jit import NO, constant, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, LANDING, NEXT, START, Trace
from gradhesion.core.curve.general import Basis, Patterned, coordinate, slope
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
from gradhesion.core.face import shortest_wave
from gradhesion.core.harmonics.series import sums
from gradhesion.core.harmonics.series_by_k import sums_by_k
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.unloading import descend, leave_rim
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
)
from gradhesion.core.sensitivities.cosine_slopes import COUNT as OF_PROFILES
from gradhesion.core.sensitivities.wanted import if_wanted
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


class Sense(NamedTuple):
    """What the sensitivities of all curves of one exponent need."""

    change: Any  # the change of the tables by k (harmonics/series_by_k.py)
    front_by_k: float  # the slope by k of ln of the factor of the punch
    found: Floats  # where the sensitivities go, of shape (3, COUNT, curves, rims)
    force: bool  # whether those of the pull-off force are wanted
    energy: int  # the parts of the cycle of whose energy they are wanted (`part_of` of problem/results.py), 0 for none
    turned: bool  # whether the rims are places where cycles turn


class At(NamedTuple):
    """A place: z, z^c, t, kappa, and the load without adhesion over z^(1+k)."""

    z: float
    stretch: float
    share: float
    toughness: float
    load: float


@kernel()
def fill_parts(basis: Basis, curve: Patterned, sense: Sense, log_length: float, x: float, parts: Floats) -> At:
    """Fill `parts`, of shape (5, COUNT), at x > 0; `log_length` is ln of the unit of z, in R."""
    table, pattern, _ = basis
    B, m, _, alpha, beta = curve
    k, g, change = table.k, pattern.gain, sense.change
    z = TWO_PI * x
    power = amplitude_power(table, z)
    bend, share, log_radius = B * z**m, m / (1.0 + k + m), math.log(z) + log_length
    own, rate, _ = toughness_at(basis, x)
    parts[:] = 0.0
    w0, w1, v, w0_k, w1_k = 0.0, 0.0, 0.0, 0.0, 0.0
    if g > 0.0:
        _, _, v, _ = sums(table, pattern.cosine_bins, pattern.waves, x, 0.0)
        w0, w1, w0_k, w1_k = sums_by_k(table, pattern.cosine_bins, pattern.waves, change[0][0], change[1], x, 0.0)
    wave = g * z
    parts[BY_DEPTH, BY_WAVELENGTH], parts[BY_LOAD, BY_WAVELENGTH] = wave * (w0 - v), wave * ((2.0 + k) * w1 - v)
    parts[BY_DEPTH, BY_AMPLITUDE], parts[BY_LOAD, BY_AMPLITUDE] = wave * w0, wave * w1
    parts[BY_DEPTH, BY_EXPONENT] = bend * sense.front_by_k + wave * w0_k
    parts[BY_LOAD, BY_EXPONENT] = bend * share * (sense.front_by_k - 1.0 / (1.0 + k + m)) + wave * w1_k
    parts[BY_STRETCH, BY_STIFFNESS], parts[BY_STRETCH, BY_EXPONENT] = -0.5, 0.5 * (LN2 - log_radius)
    parts[BY_SHARE, BY_EXPONENT] = log_radius
    if alpha > 0.0:
        parts[BY_SHARE, BY_STIFFNESS], parts[BY_SHARE, BY_MACHINE] = 1.0, -1.0
        parts[BY_SHARE, BY_EXPONENT] -= LN2 + 1.0 / (1.0 + k)
    parts[BY_TOUGHNESS, BY_PATTERN_LENGTH] = -z * rate
    parts[BY_TOUGHNESS, BY_PATTERN] = 0.5 * (own * own - 1.0) / own if pattern.of_work else own - 1.0
    return At(z, z * power, beta / (power * power), own, bend * share + wave * w1)


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
def add_jump(
    basis: Basis, curve: Patterned, sense: Sense, log_length: float, start: float, end: float, room: Room, total: Floats
) -> None:
    """Add the slopes of a jump from the curve at x = start > 0, or from zero contact at Y = 0, to x = end >= 0.

    `total` is of shape (COUNT + 1,), in 2 pi l^2 dgamma.
    """
    parts, level, shortest = room.parts, room.level, shortest_wave(basis, curve)
    level[:] = 0.0
    if start > 0.0:
        at = fill_parts(basis, curve, sense, log_length, start, parts)
        _slopes_of_level(curve, at, parts, level)
    scale = TWO_PI * (1.0 if end > start else -1.0)
    if start > 0.0 and end > 0.0:
        left, low, high = place_left(basis, curve, start, 0.0), min(start, end), max(start, end)
        while low < high:
            width, beyond, first, last = panel_outwards(low, high, 0.0, shortest)
            for i in range(first, last):
                x = low + width * PLACES[i]
                at = fill_parts(basis, curve, sense, log_length, x, parts)
                u = rise_from(basis, curve, left, x, 0.0)
                _add_density(curve, at, parts, level, u, scale * width * SHARES[i], total)
            low = beyond
        return
    high = max(start, end)
    own = coordinate(basis, curve, start) if start > 0.0 else 0.0
    inner, growth = panels_to_zero(basis.table.k, curve.alpha, curve.beta, high, shortest)
    while high > 0.0:
        low, first, last = panel_inwards(high, growth, shortest)
        innermost = not high > inner
        for i in range(0 if innermost else first, INNER_PLACES.size if innermost else last):
            x = high * INNER_PLACES[i] if innermost else low + (high - low) * PLACES[i]
            weight = high * INNER_SHARES[i] if innermost else (high - low) * SHARES[i]
            at = fill_parts(basis, curve, sense, log_length, x, parts)
            value, over = balance(basis, curve, x)
            _add_density(curve, at, parts, level, (value - own) / over, scale * weight, total)
        high = 0.0 if innermost else low


@kernel()
def _add_loading(
    basis: Basis,
    curve: Patterned,
    sense: Sense,
    log_length: float,
    walked: Walked,
    rim: float,
    room: Room,
    total: Floats,
) -> None:
    """Add the slopes of loading up to a rim."""
    count, trace = walked
    left, level = 0.0, 0.0
    for branch in range(count):
        if trace[ARRIVAL, branch] <= rim and trace[ARRIVAL, branch] < math.inf:
            if trace[ARRIVAL, branch] > 0.0:
                add_jump(basis, curve, sense, log_length, left, trace[ARRIVAL, branch], room, total)
            left, level = trace[END, branch], trace[END_DEPTH, branch]
    if left < rim:
        add_jump(basis, curve, sense, log_length, left, rim, room, total)
        value, over = balance(basis, curve, rim)
        own, _, _ = toughness_at(basis, rim)
        u = (value - level) / over
        total[BY_RIM] -= (TWO_PI * rim) ** 2 * u * (2.0 * own + u)


@kernel()
def _add_unloading(
    basis: Basis,
    curve: Patterned,
    sense: Sense,
    log_length: float,
    walked: Walked,
    rim: float,
    room: Room,
    total: Floats,
) -> None:
    """Add the slopes of unloading from a rim; under a dead load the jump-out has no energy."""
    count, trace = walked
    level = coordinate(basis, curve, rim) if rim < math.inf else math.inf
    now, landing = leave_rim(basis, curve, count, trace, rim, level)
    if now < 0 or landing != rim:
        before = total[LEVEL]
        if now >= 0 or curve.alpha > 0.0:
            add_jump(basis, curve, sense, log_length, rim, landing if now >= 0 else 0.0, room, total)
        _, _, rate = slope(basis, curve, rim)
        total[BY_RIM] += (total[LEVEL] - before) * rate * TWO_PI * rim
    if now >= 0:
        descend(basis, curve, trace, now, NO)
    while now >= 0 and trace[START, now] > 0.0:
        lower = int(trace[NEXT, now])
        if lower >= 0 or curve.alpha > 0.0:
            end = trace[LANDING, now] if lower >= 0 else 0.0
            add_jump(basis, curve, sense, log_length, trace[START, now], end, room, total)
        now = lower


@if_wanted("sense")
@kernel()
def put_energy(
    basis: Basis,
    curve: Patterned,
    sense: Sense,
    of_curve: tuple[float, int],
    walked: Walked,
    x: float,
    energy: float,
    rim: int,
) -> None:
    """Store the sensitivities of the energy, in 2 pi l^2 dgamma, of a rim at x: ln l and number of the curve first."""
    log_length, i = of_curve
    total, room = np.zeros(COUNT + 1), Room(np.empty((5, COUNT)), np.empty(COUNT))
    if sense.energy & LOADING_PART:
        _add_loading(basis, curve, sense, log_length, walked, x, room, total)
    if sense.energy & UNLOADING_PART:
        _add_unloading(basis, curve, sense, log_length, walked, x, room, total)
    for p in range(COUNT):
        sense.found[ENERGY, p, i, rim] = total[p] / energy if energy > 0.0 else math.nan


@if_wanted("sense")
@kernel()
def put_forces(
    basis: Basis, curve: Patterned, sense: Sense, i: int, units: tuple[float, float, float], rims: Floats, own: Results
) -> None:
    """Store the sensitivities of the pull-off forces of a curve for all rims a_max/R, and those of the depth there."""
    unit, length, depth = units
    parts, log_length, k = np.empty((5, COUNT)), math.log(length), basis.table.k
    for rim in range(rims.size):
        if own.status[rim] & NO_VALUE or not sense.force:
            continue
        at_rim = own.status[rim] & PULL_OFF_AT_RIM != 0
        x = (rims[rim] if at_rim else own.out[own.slots[RADIUS], rim]) / unit
        if not x > 0.0:
            continue
        at = fill_parts(basis, curve, sense, log_length, x, parts)
        load = at.load - at.toughness * at.stretch
        for p in range(COUNT):
            fall = at.stretch * (parts[BY_TOUGHNESS, p] + at.toughness * parts[BY_STRETCH, p])
            sense.found[FORCE, p, i, rim] = (parts[BY_LOAD, p] - fall) / load
            sense.found[DEPTH, p, i, rim] = depth * (parts[BY_DEPTH, p] - fall)
        sense.found[FORCE, BY_STIFFNESS, i, rim] += 1.0
        sense.found[FORCE, BY_EXPONENT, i, rim] += math.log(at.z) + log_length - LN2 - 1.0 / (1.0 + k)
        if at_rim:
            B, m, g, _, _ = curve
            front = (at.z / at.stretch) ** 2
            _, _, rate = slope(basis, Patterned(B, m, g, 0.0, 1.0), x)
            sense.found[FORCE, BY_RIM, i, rim] = at.z * rate / (front * load)
            _, _, rate = slope(basis, Patterned(B, m, g, 1.0, 0.0), x)
            sense.found[DEPTH, BY_RIM, i, rim] = depth * at.z * rate
