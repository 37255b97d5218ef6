"""The energy of a jump from its two ends: an antiderivative of z (1 - rho^2) in place of a quadrature.

At the depth d of the curve at z1, q(z) = b z^2/2 - d is known from differences to z1 alone, q1 = z1^c - g z1 S0(z1), so
that nothing of the size of d^2 is subtracted. Two forms are used; both leave a smooth integral to a few Gauss nodes.

With the moments E2 and W (struve/moments.py) from one end to the other,

    e = int z [1 - (q/z^c)^2] dz - g [ b E2 + g W - 2 d z^(k+2) S1/(k+1) ]_{z1}^{z2}

and where both ends lie beyond z = 40, with h = z G0 and the oscillating parts w0, w1, once + twice of the pair alone
(struve/jump_tail.py),

    e = int z [1 - ((q + g h)/z^c)^2] - g^2 C^2/2 z |P0|^2 dz
        - g [ z^(1+k) {2 q w1 + 2 b (z w0 - (k+2) w1) - g (once + twice)} ]_{z1}^{z2}

The size of the bracket's terms is returned with the energy: one that is much smaller has lost digits.
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine, wave
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import make_horner
from gradhesion.core.numbers.lanes import Lanes, load, rounded, size_of, stand_apart, sum_of
from gradhesion.core.struve.layout import STRETCH_TERMS, SWITCH, TAIL_TERMS
from gradhesion.core.struve.moments import moments
from gradhesion.core.struve.pair import horner8
from gradhesion.core.struve.power import amplitude_power, amplitude_powers
from gradhesion.core.types import Table


def gauss_rule(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss's rule on [-1, 1], with weights that add up to 1."""
    places, weights = np.polynomial.legendre.leggauss(nodes)
    return places, 0.5 * weights


End: TypeAlias = tuple[float, float, float]
"""x, z and z^(-n) at one end of a jump, numbers or eight of them (numbers/lanes.py)."""
_horner_of_slow = make_horner(2, TAIL_TERMS)
NODES, WEIGHTS = gauss_rule(8)
ENOUGH: Final = 0.03
"""Energy over the size of its terms, below which quadrature is used: it loses no digits."""
REACH: Final = 0.1
"""Half a jump over its middle, for which 8 nodes, and the series of z^(-c) in the table, leave 1e-16."""
_NEAR: Final = 0.15
"""The same where powers are not expanded; over longer jumps the smooth integral has a closed form."""


@kernel(contract=True, inline=True)
def _oscillating(table: Table, curve: Cosine, x: float, z: float, power: float) -> tuple[float, float, float]:
    """Return z w0, w1, and the braces of the second form but for their term with q, at z >= 40."""
    b, g, lag = curve
    inverse = 1.0 / z
    w = SWITCH * inverse
    p0, q0, p1, q1, even1, odd1, even2, odd2 = horner8(table.jump_tail, 2.0 * (w * w) - 1.0)
    sine, cosine = sine_cosine_of_turns(x - lag)
    s = power * (sine * table.cos_phase - cosine * table.sin_phase)
    c = power * (cosine * table.cos_phase + sine * table.sin_phase)
    wave0 = rounded(z * (p0 * s + q0 * inverse * c))
    wave1 = q1 * inverse * s - p1 * c
    squares = (c * even1 - s * inverse * odd1) + z * (2.0 * s * c * even2 + (c * c - s * s) * inverse * odd2)
    return wave0, wave1, 2.0 * b * (wave0 - (table.k + 2.0) * wave1) - g * squares


@kernel(contract=True, inline=True)
def inverse_stretch(table: Table, e: float) -> float:
    """Return (1 + e)^(-c) - 1 for |e| <= 0.1; e is a number or eight (numbers/lanes.py)."""
    series = table.inverse_stretch
    less = 0.0 * e
    for j in range(STRETCH_TERMS - 1, 0, -1):
        less = e * (less + series[j])
    return less


@kernel(contract=True, inline=True)
def _slow(
    table: Table,
    curve: Cosine,
    z1: float,
    stretch: float,
    wave1: float,
    way: tuple[float, float],
    front: tuple[float, float],
    node: float,
) -> float:
    """Return the smooth part of the second form at a node from -1 to 1 of the way from z1 to z1 + dz.

    z1^c and z S0 at z1 are given. The way is dz, and half of that over the middle; the front is what `inverse_stretch`
    returns of the way back to z1, and 1 over 1 more than it. Powers are (1 + eta)^(-c), for a half panel eta = -ratio
    at z1. It is rho_s - 1 that is computed: in 1 - rho_s it would lose 1/chi. Ends and node are numbers, or one of both
    is eight (numbers/lanes.py).
    """
    b, g, _ = curve
    dz, ratio = way
    left, start = front
    strength = 0.5 * (g * table.amplitude) * (g * table.amplitude)
    series = table.inverse_stretch
    eta = ratio * node
    z = (z1 + 0.5 * dz) * (1.0 + eta)
    w = SWITCH / z
    height, square = _horner_of_slow(table.slow_tail, 2.0 * (w * w) - 1.0)
    eta2 = eta * eta
    odd, even = (
        series[STRETCH_TERMS - 4] + eta2 * series[STRETCH_TERMS - 2],
        series[STRETCH_TERMS - 3] + eta2 * series[STRETCH_TERMS - 1],
    )
    for j in range(STRETCH_TERMS - 6, 0, -2):
        odd = odd * eta2 + series[j]
        even = even * eta2 + series[j + 1]
    power = eta * (odd + eta * even)
    rise = 0.25 * b * (z + z1) * (dz * (1.0 + node)) + g * (height - wave1)
    excess = (1.0 + power) * ((start / stretch) * rise) + start * (power - left)
    return z * (-excess * (2.0 + excess) - strength * square)


@kernel(contract=True, inline=True)
def _ends(table: Table, curve: Cosine, start: End, end: End, dz: float) -> tuple[float, float, float, float]:
    """Return what the bracket of the second form is at the two ends, and z^c and z S0 at the first."""
    b, g, _ = curve
    x1, z1, power1 = start
    x2, z2, power2 = end
    wave0, wave1, braces1 = _oscillating(table, curve, x1, z1, power1)
    _, wave2, braces2 = _oscillating(table, curve, x2, z2, power2)
    w = SWITCH / z1
    height, _ = _horner_of_slow(table.slow_tail, 2.0 * (w * w) - 1.0)
    wave0 = wave0 + height
    stretch = z1 * power1
    q1 = stretch - g * wave0
    q2 = q1 + 0.5 * b * (z1 + z2) * dz
    first = (2.0 * q1 * wave1 + braces1) / (power1 * power1)
    last = (2.0 * q2 * wave2 + braces2) / (power2 * power2)
    return first, last, stretch, wave0


@kernel(contract=True)
def _beyond(table: Table, curve: Cosine, start: float, end: float) -> tuple[float, float]:
    """Return e, and the size of its terms, where both ends lie at z >= 40 and not too far from each other."""
    _, g, _ = curve
    z1, z2, dz = TWO_PI * start, TWO_PI * end, TWO_PI * (end - start)
    ends = (start, z1, amplitude_power(table, z1)), (end, z2, amplitude_power(table, z2))
    first, last, stretch, wave1 = _ends(table, curve, ends[0], ends[1], dz)
    ratio = 0.5 * dz / (z1 + 0.5 * dz)
    left = inverse_stretch(table, -ratio)
    front = left, 1.0 / (1.0 + left)
    smooth = sum_of(load(WEIGHTS, 0) * _slow(table, curve, z1, stretch, wave1, (dz, ratio), front, load(NODES, 0)))
    return smooth * dz - g * (last - first), g * (abs(last) + abs(first))


@kernel(contract=True)
def beyond_from(table: Table, curve: Cosine, start: End, end: End, dz: Lanes) -> tuple[Lanes, Lanes]:
    """Return what `beyond_at_once` does, from x for the phase, z and z^(-n) at both ends, and how far z is between."""
    stand_apart()
    _, g, _ = curve
    _, z1, _ = start
    first, last, stretch, wave1 = _ends(table, curve, start, end, dz)
    ratio = 0.5 * dz / (z1 + 0.5 * dz)
    left = inverse_stretch(table, -ratio)
    front = left, 1.0 / (1.0 + left)
    smooth = 0.0 * dz
    for i in range(NODES.size):
        smooth = smooth + WEIGHTS[i] * _slow(table, curve, z1, stretch, wave1, (dz, ratio), front, NODES[i])
    return smooth * dz - g * (last - first), g * (size_of(last) + size_of(first))


@kernel(contract=True)
def beyond_at_once(table: Table, curve: Cosine, start: Lanes, end: Lanes) -> tuple[Lanes, Lanes]:
    """Return what `energy_between` does for eight jumps with both ends beyond z = 40, each within REACH."""
    z1, z2, dz = TWO_PI * start, TWO_PI * end, TWO_PI * (end - start)
    ends = (start, z1, amplitude_powers(table, z1)), (end, z2, amplitude_powers(table, z2))
    return beyond_from(table, curve, ends[0], ends[1], dz)


@kernel(contract=True)
def _anywhere(table: Table, curve: Cosine, start: float, end: float) -> tuple[float, float]:
    """Return e, and the size of its terms, by the first form."""
    b, g, _ = curve
    k = table.k
    gain = 1.0 / (1.0 + k)
    z1, power1, s01, s11, _, _, _ = wave(table, 0.0, start)
    z2, power2, _, s12, _, _, _ = wave(table, 0.0, end)
    e1, w1 = moments(table, start, power1)
    e2, w2 = moments(table, end, power2)
    front1, front2 = 1.0 / (power1 * power1), 1.0 / (power2 * power2)
    square1, square2 = z1 * z1, z2 * z2
    q1 = z1 * power1 - g * z1 * s01
    depth = 0.5 * b * square1 - q1
    first = front1 * (square1 * square1 * (b * e1 + g * w1) - 2.0 * depth * gain * z1 * s11)
    last = front2 * (square2 * square2 * (b * e2 + g * w2) - 2.0 * depth * gain * z2 * s12)
    total, size = -g * (last - first), g * (abs(last) + abs(first))
    dz = TWO_PI * (end - start)
    if abs(dz) < _NEAR * (z1 + z2):
        shift = 0.5 * dz * (1.0 + load(NODES, 0))
        z = z1 + shift
        rho = (0.5 * b * shift * (z + z1) + q1) / (z * amplitude_powers(table, z))
        smooth = sum_of(load(WEIGHTS, 0) * z * ((1.0 - rho) * (1.0 + rho)))
        return total + dz * smooth, size
    a, c, d = 0.25 * b * b / (5.0 + k), b * depth / (3.0 + k), depth * depth * gain
    inner, outer = front1 * ((a * square1 - c) * square1 + d), front2 * ((a * square2 - c) * square2 + d)
    most = max(square1, square2)
    size += most + max(front1, front2) * (a * most * most + d)
    return total + 0.5 * (square2 - square1) - (outer - inner), size


@kernel()
def energy_between(table: Table, curve: Cosine, start: float, end: float) -> tuple[float, float]:
    """Return e of a jump from x = start > 0 on the curve to x = end > 0, and the size of the terms it is made of.

    The size is infinite where neither form applies.
    """
    _, _, lag = curve
    if TWO_PI * min(start, end) >= SWITCH:
        if abs(end - start) > REACH * (start + end):
            return 0.0, math.inf
        return _beyond(table, curve, start, end)
    if lag != 0.0:
        return 0.0, math.inf
    return _anywhere(table, curve, start, end)
