"""The equilibrium curve of one wave in reduced form: depth, load and their slopes at a contact radius.

With z = 2 pi a/lambda, l = lambda/2 pi, c = (1-k)/2, n = (1+k)/2 and the surface's adhesive stretch
s = sqrt(2^(1+k) pi dgamma/M), depths in units of s l^c and loads in units of K l^(1+k) s l^c are

    depth(z) = b z^2/2 + g z S0 - z^c
    load(z)  = z^(1+k) [b z^2/(3+k) + g z (S0 - S1) - z^c]
    b = 2 l^(2-c)/((1+k) R s),     g = A lambda/(s l^c)

so that besides k a curve has two numbers: b, the *bend* of the paraboloid, and g, the *gain* of the waviness (chi = r/s
of the asymptotic theory is C g). Both slopes have one form,

    d depth/dz = D(z; (1-k)/2),    d load/dz = z^(1+k) D(z; (3+k)/2),    D(z; level) = b z + g V - level z^(-n)

with V = S0 + z S0', and machines of finite stiffness have levels in between. The unknown is x = a/lambda, never z: the
phase of the wave is exact at any x.

A third number is zero for every real curve: the *lag*, in turns, by which the waves of large z are shifted against the
punch. With it the wave number becomes continuous (waves/cosine.py).
"""

from typing import NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import Lanes
from gradhesion.core.struve.layout import SWITCH
from gradhesion.core.struve.pair import pair_above, pair_below
from gradhesion.core.struve.power import amplitude_power, amplitude_powers
from gradhesion.core.types import Table


class Cosine(NamedTuple):
    """One cosine on a paraboloid under displacement control: b, g, and the lag."""

    bend: float
    gain: float
    lag: float


class Wave(NamedTuple):
    """The universal pair at a place, and what is made of it (above)."""

    z: float
    power: float  # z^(-n)
    s0: float
    s1: float
    v: float  # V, and its first two derivatives by z
    v1: float
    v2: float


@kernel()
def curve_of(k: float, stretch: float, wavelength: float, mean_height: float) -> tuple[Cosine, float, float]:
    """Return the curve of a scene of k, s, lambda and lambda A, l, and the unit of depth s l^c; lengths are in R."""
    length = wavelength / TWO_PI
    unit = stretch * length ** (0.5 * (1.0 - k))
    return Cosine(2.0 * length * length / ((1.0 + k) * unit), mean_height / unit, 0.0), length, unit


@kernel()
def force_unit(k: float, length: float, unit: float) -> float:
    """Return the unit of load K l^(1+k) s l^c in 1.5 pi R dgamma, for l and the unit of depth s l^c."""
    # it is K s^2 l^2/(s l^c), and K s^2 = 4 pi R dgamma/(1+k)
    return 8.0 / (3.0 * (1.0 + k)) * length * length / unit


@kernel(contract=True)
def wave(table: Table, lag: float, x: float) -> Wave:
    """Return z, z^(-n), S0, S1, V, V', V'' at x > 0."""
    k = table.k
    z = TWO_PI * x
    power = amplitude_power(table, z)
    s0, s1, d0, _ = pair_below(table, x, z) if z < SWITCH else pair_above(table, x - lag, z, power)
    v = s0 + z * d0
    v1 = 2.0 * d0 + z * (s1 - s0)
    v2 = (1.0 - k) * s1 - (2.0 - k) * s0 - z * d0
    return Wave(z, power, s0, s1, v, v1, v2)


@kernel(contract=True)
def depth(table: Table, curve: Cosine, x: float) -> float:
    """Return the reduced depth at x > 0."""
    b, g, lag = curve
    z, power, s0, _, _, _, _ = wave(table, lag, x)
    return z * (0.5 * b * z + g * s0 - power)


@kernel(contract=True)
def load(table: Table, curve: Cosine, x: float) -> float:
    """Return the reduced load at x > 0."""
    b, g, lag = curve
    z, power, s0, s1, _, _, _ = wave(table, lag, x)
    return z / (power * power) * (b * z / (3.0 + table.k) + g * (s0 - s1) - power)


@kernel(contract=True)
def slope(table: Table, curve: Cosine, level: float, x: float) -> tuple[float, float, float, float]:
    """Return D, its first two derivatives with respect to z, and the depth, at x > 0."""
    b, g, lag = curve
    n = 0.5 * (1.0 + table.k)
    z, power, s0, _, v, v1, v2 = wave(table, lag, x)
    pull = level * power
    bend = n * pull / z
    return b * z + g * v - pull, b + g * v1 + bend, g * v2 - (n + 1.0) * bend / z, z * (0.5 * b * z + g * s0 - power)


@kernel(contract=True)
def _slopes_of(
    k: float, curve: Cosine, level: float, z: float, power: float, pair: tuple[float, float, float, float]
) -> tuple[float, float, float, float, float]:
    """Return what `slopes` does, from z^(-n) and the pair; z is a number or eight (numbers/lanes.py)."""
    b, g, _ = curve
    n = 0.5 * (1.0 + k)
    s0, s1, d0, d1 = pair
    pull = level * power
    inverse = 1.0 / z
    bend = n * pull * inverse
    bow = (n + 1.0) * bend * inverse
    return (
        b * z + g * (s0 + z * d0) - pull,
        b + g * (2.0 * d0 + z * (s1 - s0)) + bend,
        g * ((1.0 - k) * s1 - (2.0 - k) * s0 - z * d0) - bow,
        g * ((1.0 - k) * d1 - (3.0 - k) * d0 - z * (s1 - s0)) + (n + 2.0) * bow * inverse,
        z * (0.5 * b * z + g * s0 - power),
    )


@kernel(contract=True)
def slopes(table: Table, curve: Cosine, level: float, x: float) -> tuple[float, float, float, float, float]:
    """Return D, its first three derivatives with respect to z, and the depth, at x > 0."""
    _, _, lag = curve
    z = TWO_PI * x
    power = amplitude_power(table, z)
    pair = pair_below(table, x, z) if z < SWITCH else pair_above(table, x - lag, z, power)
    return _slopes_of(table.k, curve, level, z, power, pair)


@kernel(contract=True)
def slopes_at_once(table: Table, curve: Cosine, level: float, x: Lanes) -> tuple[Lanes, Lanes, Lanes, Lanes, Lanes]:
    """Return what `slopes` does at eight places beyond z = 40."""
    _, _, lag = curve
    z = TWO_PI * x
    power = amplitude_powers(table, z)
    return _slopes_of(table.k, curve, level, z, power, pair_above(table, x - lag, z, power))


@kernel()
def depth_size(table: Table, curve: Cosine, x: float) -> float:
    """Return the size of the terms of the reduced depth at x; 1 where x is 0 or NaN."""
    b, g, _ = curve
    z = TWO_PI * x
    if not z > 0.0:
        return 1.0
    return 0.5 * b * z * z + z * amplitude_power(table, z) * (1.0 + g * table.amplitude) + g


@kernel()
def most_depth_size(table: Table, curve: Cosine, x: float) -> float:
    """Return a bound of `depth_size` at x >= 0 that needs no power: z^c <= 1 + z/2 for c <= 1/2."""
    b, g, _ = curve
    z = TWO_PI * x
    return 1.0 + z * (0.5 * b * z + 0.5 + g * table.amplitude) + g * (1.0 + table.amplitude)
