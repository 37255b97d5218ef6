"""The universal pair and its derivatives at one radius, from a table.

    S0' = (1 - z S1)/(1+k),   S1' = ((1+k) S0 - (2+k) S1)/z,   S0'' = S1 - S0

S0' is kept as a function of its own: by the first identity it would lose eps z^((1+k)/2), 1.6e-9 at x = 1e6.
"""

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import TWO_PI, TWO_PI_LOW, sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import fma, make_horner
from gradhesion.core.numbers.lanes import LANES, Lanes, lane_of, with_lane
from gradhesion.core.struve.filling import ask_for_bin
from gradhesion.core.struve.layout import BIN_TERMS, SWITCH, TAIL_TERMS
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Table

horner4 = make_horner(4, BIN_TERMS)
horner8 = make_horner(8, TAIL_TERMS)


@kernel(contract=True)
def pair_below(table: Table, x: float, z: float) -> tuple[float, float, float, float]:
    """Return S0, S1, S0', S1' for z = 2 pi x < 40."""
    i = int(2.0 * z)
    t = fma(4.0 * TWO_PI, x, -(2.0 * i + 1.0)) + 4.0 * TWO_PI_LOW * x  # of the exact 2 pi x
    ask_for_bin(table, i)
    s0_over_z, s1_over_z, s0_slope, s1_slope = horner4(table.bins[i], t)
    return z * s0_over_z, z * s1_over_z, s0_slope, s1_slope


@kernel(contract=True)
def pair_above(table: Table, x: float, z: float, power: float) -> tuple[float, float, float, float]:
    """Return S0, S1, S0', S1' for z = 2 pi x >= 40, with power = z^(-(1+k)/2)."""
    k = table.k
    inverse = 1.0 / z
    w = SWITCH * inverse
    p0, q0, p1, q1, g0, g1, h0, h1 = horner8(table.tail, 2.0 * (w * w) - 1.0)
    sine, cosine = sine_cosine_of_turns(x)
    s = power * (sine * table.cos_phase - cosine * table.sin_phase)
    c = power * (cosine * table.cos_phase + sine * table.sin_phase)
    wave0 = p0 * s + q0 * inverse * c
    wave1 = q1 * inverse * s - p1 * c
    s0 = g0 * inverse + wave0
    s1 = inverse * (g1 + (k + 1.0) * wave1)
    s0_slope = h0 * inverse * inverse - wave1
    s1_slope = inverse * (h1 * inverse + (k + 1.0) * (wave0 - (k + 2.0) * inverse * wave1))
    return s0, s1, s0_slope, s1_slope


@kernel(contract=True)
def first_functions(table: Table, lag: float, x: Lanes, z: Lanes, power: Lanes) -> Lanes:
    """Return S0 at eight places x > 0, the innermost first; beyond z = 40 the waves are `lag` turns behind."""
    if lane_of(z, 0) >= SWITCH:
        s0, _, _, _ = pair_above(table, x - lag, z, power)
        return s0
    values = z
    for lane in range(LANES):
        place, here = lane_of(x, lane), lane_of(z, lane)
        if here < SWITCH:
            value, _, _, _ = pair_below(table, place, here)
        else:
            value, _, _, _ = pair_above(table, place - lag, here, lane_of(power, lane))
        values = with_lane(values, lane, value)
    return values


@kernel(contract=True)
def pair(table: Table, x: float) -> tuple[float, float, float, float]:
    """Return S0, S1, S0', S1' at z = 2 pi x, x >= 0."""
    z = TWO_PI * x
    if z < SWITCH:
        return pair_below(table, x, z)
    return pair_above(table, x, z, amplitude_power(table, z))
