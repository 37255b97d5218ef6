"""How the energy of a jump changes with the numbers of its curve: exact derivatives, at fixed ends of the jump.

    e = int_{z1}^{z2} z [1 - rho^2] dz,   rho = (depth_H - depth_j)/z^c   (curve/cosine_energy.py)

A fold is a stationary point of the depth, and the integrand vanishes where a jump lands, so that the ends may be fixed
while a parameter p changes (docs/theory.md, section 17): with depth_j the depth at the start of the jump,

    de/dp = int -2 z rho (d rho/dp) dz,   d rho/db = (z^2 - z1^2)/(2 z^c),   d rho/dg = (z S0 - z1 S0(z1))/z^c

The same holds for the gradient exponent, which enters everywhere: the energy of a jump between fixed ends is a smooth
function of k, and is differentiated by the tables of four neighbouring exponents (sensitivities/neighbours.py).

The slopes are those by the bend b, the gain g and the exponent, each with the depth of the jump that follows, and by
that depth alone; of a general curve (sensitivities/general_jump_slopes.py) also that by the machine's share.
"""

from typing import Final

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.cosine import Cosine, depth, wave
from gradhesion.core.curve.cosine_energy import (
    LONG,
    NODES,
    SHORT,
    SHORT_NODES,
    SHORT_WEIGHTS,
    WEIGHTS,
    Left,
    energy_from_zero,
    jump_energy,
)
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.sensitivities.neighbours import Near
from gradhesion.core.struve.layout import SWITCH, TAIL_TERMS
from gradhesion.core.struve.moments import moments
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Slopes, Table, Work

BEND, GAIN, EXPONENT, DEPTH, SHARE, SLOPES = 0, 1, 2, 3, 4, 5
_FURTHEST: Final = 64.0
"""In waves: over longer jumps the antiderivative is used, as in curve/cosine_energy.py."""
_POWER_TERMS: Final = 12


@kernel(contract=True)
def _panel_below(
    table: Table, curve: Cosine, start: float, left: Left, begin: float, width: float, nodes: Floats, weights: Floats
) -> tuple[float, float, float]:
    """Integrate -2 z rho d rho over one panel of the x axis, per unit of x, by b, g and the depth.

    Nodes and weights are those of Gauss on [0, 1], of shape (n,).
    """
    b, g, lag = curve
    z1, wave1, stretch1 = left
    by_bend, by_gain, by_depth = 0.0, 0.0, 0.0
    for i in range(nodes.size):
        x = begin + width * nodes[i]
        z, power, s0, _, _, _, _ = wave(table, lag, x)
        bend, gain, stretch = 0.5 * (z + z1) * (TWO_PI * (x - start)), z * s0 - wave1, z * power
        part = -2.0 * weights[i] * z * (b * bend + g * gain + stretch1) / (stretch * stretch)
        by_bend += part * bend
        by_gain += part * gain
        by_depth -= part
    return by_bend * width, by_gain * width, by_depth * width


@kernel(contract=True)
def panel_slopes_above(
    table: Table, curve: Cosine, whole: float, start: float, left: Left, begin: float, width: float, work: Work
) -> tuple[float, float, float]:
    """Do the same where all z >= 40, at places `whole` + x, as `panel_above` of curve/cosine_energy.py."""
    b, g, _ = curve
    z1, wave1, stretch1 = left
    c = 0.5 * (1.0 - table.k)
    middle = TWO_PI * (whole + (begin + 0.5 * width))
    ratio = TWO_PI * 0.5 * width / middle
    stretch_middle = middle * amplitude_power(table, middle)
    tail = table.tail
    cos_phase, sin_phase = table.cos_phase, table.sin_phase
    for i in range(16):
        x = begin + width * NODES[i]
        z = TWO_PI * (whole + x)
        inverse = 1.0 / z
        w = SWITCH * inverse
        t = 2.0 * (w * w) - 1.0
        p, q, height = tail[TAIL_TERMS - 1, 0], tail[TAIL_TERMS - 1, 1], tail[TAIL_TERMS - 1, 4]
        for j in range(TAIL_TERMS - 2, -1, -1):
            p = p * t + tail[j, 0]
            q = q * t + tail[j, 1]
            height = height * t + tail[j, 4]
        eta = ratio * (2.0 * NODES[i] - 1.0)
        power = 1.0
        for j in range(_POWER_TERMS, 0, -1):
            power = 1.0 + power * eta * ((c - j) / (j + 1.0))
        stretch = stretch_middle * (1.0 + power * c * eta)
        sine, cosine = sine_cosine_of_turns(x)
        s = sine * cos_phase - cosine * sin_phase
        cosine_z = cosine * cos_phase + sine * sin_phase
        bend = 0.5 * (z + z1) * (TWO_PI * (x - start))
        gain = height + stretch * (p * s + q * inverse * cosine_z) - wave1
        work[i] = -2.0 * WEIGHTS[i] * z * (b * bend + g * gain + stretch1) / (stretch * stretch)
        work[16 + i] = bend
        work[32 + i] = gain
    by_bend, by_gain, by_depth = 0.0, 0.0, 0.0
    for i in range(16):
        by_bend += work[i] * work[16 + i]
        by_gain += work[i] * work[32 + i]
        by_depth -= work[i]
    return by_bend * width, by_gain * width, by_depth * width


@kernel(contract=True)
def _slopes_from_zero(table: Table, curve: Cosine, x: float, depth: float) -> tuple[float, float, float]:
    """Return the slopes of `energy_from_zero` by b and g at a fixed depth, and by the depth."""
    b, g, lag = curve
    k = table.k
    z, power, _, s1, _, _, _ = wave(table, lag, x)
    e2, w = moments(table, x, power)
    front = 1.0 / (power * power)  # z^(1+k)
    square = z * z
    first, mixed = 1.0 / (3.0 + k), 2.0 * s1 / (z * (k + 1.0))
    by_bend = front * square * (depth * first - square * (0.5 * b / (5.0 + k) + g * e2))
    by_gain = front * square * (depth * mixed - square * (b * e2 + 2.0 * g * w))
    return by_bend, by_gain, front * (square * (b * first + g * mixed) - 2.0 * depth / (1.0 + k))


@kernel()
def energies_nearby(near: Near, start: float, end: float, work: Work) -> float:
    """Return the slope by k of the energy of a jump but for what the exponent itself adds to the sum."""
    tables, curves, weights = near
    total = 0.0
    for j in range(weights.size):
        curve = Cosine(curves[j, 0], curves[j, 1], 0.0)
        total += weights[j] * jump_energy(tables[j], curve, start, end, work)
    return total


@kernel()
def add_slopes_to_zero(table: Table, curve: Cosine, near: Near, x: float, inwards: bool, total: Slopes) -> None:
    """Add the slopes of the jump-out from x at the depth there (inwards), or of the jump-in to x at the depth 0."""
    tables, curves, weights = near
    level = depth(table, curve, x) if inwards else 0.0
    by_bend, by_gain, by_depth = _slopes_from_zero(table, curve, x, level)
    sign = 1.0
    if inwards:
        z, _, s0, _, _, _, _ = wave(table, curve.lag, x)
        by_bend += by_depth * 0.5 * z * z
        by_gain += by_depth * z * s0
        sign = -1.0
    total[BEND] += sign * by_bend
    total[GAIN] += sign * by_gain
    total[DEPTH] += sign * by_depth
    for j in range(weights.size):
        other = Cosine(curves[j, 0], curves[j, 1], 0.0)
        level = depth(tables[j], other, x) if inwards else 0.0
        total[EXPONENT] += sign * weights[j] * energy_from_zero(tables[j], other, x, level)


@kernel(contract=True)
def add_slopes(table: Table, curve: Cosine, near: Near, start: float, end: float, work: Work, total: Slopes) -> None:
    """Add the slopes of a jump that leaves the curve at x = start and ends at x = end; `work` holds 48 floats."""
    b, g, lag = curve
    if end == 0.0:  # k = 1: the contact shrinks to a point
        add_slopes_to_zero(table, curve, near, start, YES, total)
        return
    z1, power, s0, _, _, _, _ = wave(table, lag, start)
    left = (z1, z1 * s0, z1 * power)
    total[EXPONENT] += energies_nearby(near, start, end, work)
    if abs(end - start) > _FURTHEST:
        level = z1 * (0.5 * b * z1 + g * s0 - power)
        bend2, gain2, depth2 = _slopes_from_zero(table, curve, end, level)
        bend1, gain1, depth1 = _slopes_from_zero(table, curve, start, level)
        by_depth = depth2 - depth1
        total[BEND] += bend2 - bend1 + by_depth * 0.5 * z1 * z1
        total[GAIN] += gain2 - gain1 + by_depth * z1 * s0
        total[DEPTH] += by_depth
        return
    begin, high = min(start, end), max(start, end)
    bends, gains, depths = 0.0, 0.0, 0.0
    while high - begin > 2.0 * begin and begin < 0.5 * LONG:  # as curve/cosine_energy.py
        bend, gain, level = _panel_below(table, curve, start, left, begin, 2.0 * begin, NODES, WEIGHTS)
        bends, gains, depths = bends + bend, gains + gain, depths + level
        begin *= 3.0
    panels = int((high - begin) / LONG) + 1
    width = (high - begin) / panels
    for _ in range(panels):
        if TWO_PI * begin >= SWITCH:
            whole = float(int(begin))
            bend, gain, level = panel_slopes_above(table, curve, whole, start - whole, left, begin - whole, width, work)
        elif width <= min(SHORT, begin):
            bend, gain, level = _panel_below(table, curve, start, left, begin, width, SHORT_NODES, SHORT_WEIGHTS)
        else:
            bend, gain, level = _panel_below(table, curve, start, left, begin, width, NODES, WEIGHTS)
        bends, gains, depths = bends + bend, gains + gain, depths + level
        begin += width
    sign = TWO_PI if end > start else -TWO_PI
    total[BEND] += sign * bends
    total[GAIN] += sign * gains
    total[DEPTH] += sign * depths


@kernel()
def rim_slope(table: Table, curve: Cosine, level: float, x: float) -> float:
    """Return z (1 - rho^2) z, the slope by ln x of the energy of a jump at a depth that ends at x, on no branch."""
    b, g, lag = curve
    z, power, s0, _, _, _, _ = wave(table, lag, x)
    rho = (0.5 * b * z * z + g * z * s0 - level) / (z * power)
    return z * z * (1.0 - rho) * (1.0 + rho)
