"""The answers of a patterned interface (core/face.py): the path as any profile, the gap by the profile alone."""

import math
from typing import Any, Final

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Patterned, coordinate, level_with_rate
from gradhesion.core.curve.general_energy import energy_from_zero, jump_energy
from gradhesion.core.curve.general_folds import Zeros
from gradhesion.core.curve.patterned import are_too_many, folds_up_to, toughness_at, window
from gradhesion.core.faces import series_contact
from gradhesion.core.harmonics.series import highest_harmonic, sums
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.turning.general_reach import WAVES, envelope_at
from gradhesion.core.types import Harmonics, Work

_OUTERMOST: Final = 1e100

face.window.answers(Patterned)(window)


@face.waves_at.answers(Patterned)
@kernel(contract=True)
def waves_at(basis: Basis, curve: Patterned, x: float, whole: float) -> tuple[float, float, float, float]:
    """Return the waves of the profile with 1 - kappa; `whole` is added to x."""
    table, pattern, _ = basis
    x += whole
    z = TWO_PI * x
    c = 0.5 * (1.0 - table.k)
    power = amplitude_power(table, z)
    _, q, change = level_with_rate(table.k, curve.alpha, curve.beta, power, z)
    own, rate, bend = toughness_at(basis, x)
    lack = 1.0 - own
    w0, w1, v, v1 = 0.0, 0.0, 0.0, 0.0
    if pattern.gain > 0.0:
        w0, w1, v, v1 = sums(table, pattern.cosine_bins, pattern.waves, x, 0.0)
    g = pattern.gain
    return (
        g * w0 + power * lack,
        g * w1 + power * lack,
        g * v + power * (q * lack - z * rate),
        g * v1 + power * (lack * (change - (1.0 - c) * q / z) - (q + c) * rate - z * bend),
    )


@face.depth_of_point.answers(Patterned)
@kernel()
def depth_of_point(basis: Basis, _curve: Patterned) -> float:
    own, _, _ = toughness_at(basis, 0.0)
    return -own if basis.table.k == 1.0 else 0.0


@face.relative_toughness.answers(Patterned)
@kernel(contract=True)
def relative_toughness(basis: Basis, _curve: Patterned, x: float) -> float:
    own, _, _ = toughness_at(basis, x)
    return own


@face.shortest_wave.answers(Patterned)
@kernel()
def shortest_wave(basis: Basis, _curve: Patterned) -> float:
    return max(highest_harmonic(basis.cosine_bins.waves), highest_harmonic(basis.cosine_bins.rows))


@face.punch_of.answers(Patterned)
@kernel()
def punch_of(basis: Basis, _curve: Patterned) -> tuple[Any, Harmonics, float]:
    pattern = basis.cosine_bins
    return pattern.cosine_bins, pattern.waves, pattern.gain


@face.find_all_folds.answers(Patterned)
@kernel()
def find_all_folds(basis: Basis, curve: Patterned, first: float, last: float, zeros: Zeros) -> tuple[int, bool, float]:
    if are_too_many(basis, first, last):
        return -1, False, math.inf
    return folds_up_to(basis, curve, first, last, zeros)


@face.loss_between.answers(Patterned)
@kernel()
def loss_between(basis: Basis, curve: Patterned, start: float, end: float, _work: Work) -> float:
    if end == 0.0:
        return -energy_from_zero(basis, curve, start, coordinate(basis, curve, start))
    return jump_energy(basis, curve, start, end)


@face.loss_from_zero.answers(Patterned)
@kernel()
def loss_from_zero(basis: Basis, curve: Patterned, x: float) -> float:
    return energy_from_zero(basis, curve, x, 0.0)


@face.loss_to_zero.answers(Patterned)
@kernel()
def loss_to_zero(basis: Basis, curve: Patterned, x: float, level: float) -> float:
    return 0.0 if curve.alpha == 0.0 else -energy_from_zero(basis, curve, x, level)


@face.measured_by.answers(Patterned)
@kernel()
def measured_by(curve: Patterned, by_load: bool) -> Patterned:
    B, m, g, _, _ = curve
    return Patterned(B, m, g, 0.0, 1.0) if by_load else Patterned(B, m, g, 1.0, 0.0)


@face.reach.answers(Patterned)
@kernel()
def reach(basis: Basis, curve: Patterned, target: float) -> float:
    table, pattern, _ = basis
    pull, height = pattern.most, 0.0
    for i in range(pattern.waves.shape[0]):
        h = pattern.gain * math.hypot(pattern.waves[i, 1], pattern.waves[i, 2])
        pull += WAVES * table.amplitude * h * pattern.waves[i, 0] ** (0.5 * (1.0 - table.k))
        height += h
    low, high = 1e-30, 1.0
    while envelope_at(curve, table.k, pull, height, high) <= target:
        high *= 2.0
        if high > _OUTERMOST:
            return math.inf
    while high > 1.02 * low:
        middle = math.sqrt(low * high)
        if envelope_at(curve, table.k, pull, height, middle) <= target:
            low = middle
        else:
            high = middle
    return high / TWO_PI


@face.size_at.answers(Patterned)
@kernel()
def size_at(basis: Basis, curve: Patterned, x: float) -> float:
    """Return the size of the terms of the profile, and of that of the largest kappa."""
    table, pattern, _ = basis
    z = TWO_PI * x
    power = amplitude_power(table, z)
    waves = 0.0
    for i in range(pattern.waves.shape[0]):
        n = pattern.waves[i, 0]
        waves += math.hypot(pattern.waves[i, 1], pattern.waves[i, 2]) * n ** (0.5 * (1.0 - table.k))
    height = waves * (1.0 + z * power * table.amplitude)
    share = curve.alpha + curve.beta / (power * power)
    return share * (curve.bend * z**curve.exponent + pattern.gain * height + z * power * pattern.most)


@face.surely_open.answers(Patterned)
@kernel()
def surely_open(basis: Basis, curve: Patterned, x: float) -> float:
    """Return the least stretch outside: at each radius depth_H exceeds the depth by the stretch there."""
    low = basis.cosine_bins.least
    own = math.sqrt(low) if basis.cosine_bins.of_work else low
    return own * series_contact.surely_open(basis, curve, x)


@face.is_always_one_disc.answers(Patterned)
@kernel()
def is_always_one_disc(basis: Basis, _curve: Patterned) -> bool:
    """Return True where the punch is smooth: depth_H rises with the radius, whatever the toughness of the edge."""
    return basis.cosine_bins.waves.shape[0] == 0
