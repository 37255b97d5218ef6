"""The gap outside a contact at the depth delta(a), for any curve whose kind has the functions for it (core/face.py).

    gap(r) = (2/pi) cos(k pi/2) int_a^r s^k (delta_H(s) - delta(a)) (r^2 - s^2)^(-(1+k)/2) ds

Up to a positive factor it is the *opening*

    O(r) = X^(-c) c int_0^X P^(c-1) F dP,   P = z_r^2 - s^2,   X = z_r^2 - z_a^2,
    F = (depth_H(s) - depth(z_a))/z_a^c (z_a/s)^(2c)

1 at the edge, below 0 where the surfaces overlap; at k = 1 it is the integrand itself. Far outside the integral over
the contact is shorter (docs/theory.md, section 12).
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.face import AnyCurve, AnyTable, excess_at, fill_heights, panels_of, profile_at, table_of
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import LANES, eight, load, store
from gradhesion.core.struve.fractional import NODES, WEIGHTS
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats

_LAST_PANEL: Final = 0.7
"""Shortest waves, for which the polynomial of the panel that ends at r leaves 1e-12 of a cosine."""
_PANEL: Final = 2.0
"""Shortest waves a Gauss panel."""
_NEAR: Final = 0.75
"""Inner over outer radius of the last panel, at least: the branch point at s = 0 then leaves 1e-13."""
_FAR: Final = 2.0
"""Contact radii from which on the integral over the contact is used."""
GROWTH: Final = 4.0
"""Logarithm of how much the power z^m may grow in a panel: 16 nodes leave 1e-12 of it."""
_LOW_POWER: Final = 7.0
"""m up to which z^m is smooth enough for the panel at the centre; above it must have become negligible there."""
_NEGLIGIBLE: Final = 40.0
"""Logarithm of a negligible power."""


class Edge(NamedTuple):
    """The edge of a contact: its radius, the depths of the power and of the waves there, and z^c, in units of s l^c."""

    x: float
    bend: float
    wave: float
    stretch: float


@kernel(contract=True)
def height(table: AnyTable, curve: AnyCurve, edge: Edge, x: float) -> float:
    """Return F at the radius x."""
    over, stretch = excess_at(table, curve, edge, x)
    return over * edge.stretch / (stretch * stretch)


@kernel(contract=True)
def opening_far(table: AnyTable, curve: AnyCurve, edge: Edge, r: float) -> float:
    """Return the opening at a radius far outside, for k < 1.

    gap = f(r) - depth + (2/pi) cos(k pi/2) int_0^a s^k (depth - depth_H) (r^2 - s^2)^(-(1+k)/2) ds
    """
    k = table_of(table, curve).k
    a, level = edge.x, edge.bend + edge.wave - edge.stretch
    short, growth = panels_of(table, curve)
    m = GROWTH / math.log(growth)  # 0 where the power is a polynomial
    total, high = 0.0, a
    while high > 0.0:
        low = max(high - _PANEL * short, high * max(0.5, 1.0 / growth))
        last = high <= 0.25 * short and (m <= _LOW_POWER or m * math.log(a / high) > _NEGLIGIBLE)
        for i in range(NODES.size):
            share = NODES[i] ** 4 if last else NODES[i]  # s^k has a branch point at 0
            rate = 4.0 * NODES[i] ** 3 * high if last else high - low
            x = high * share if last else low + (high - low) * share
            over, _ = excess_at(table, curve, edge, x)
            total -= WEIGHTS[i] * rate * over * x**k * ((r - x) * (r + x)) ** (-0.5 * (1.0 + k))
        high = 0.0 if last else low
    c = 0.5 * (1.0 - k)
    sine = math.sin(math.pi * c)
    gap = profile_at(table, curve, r) - level + 2.0 / math.pi * sine * total
    return gap * math.pi * c / sine * (TWO_PI * (r - a) / a * (r + a)) ** (-c)


@kernel(contract=True)
def opening_near(table: AnyTable, curve: AnyCurve, edge: Edge, r: float) -> float:
    """Return the opening at the radius r > a from the depths between the two: 1e-11 of the largest F.

    Panels go inwards from r: the first with the weights of struve/fractional.py, which take the singular factor into
    account, the others by Gauss's rule.
    """
    own = table_of(table, curve)
    x1, count = edge.x, NODES.size
    short, growth = panels_of(table, curve)
    whole = (r - x1) * (r + x1)
    low = max(x1, r - _LAST_PANEL * short, r * max(_NEAR, 1.0 / growth))
    part = (r - low) * (r + low)
    total = 0.0
    for i in range(count):
        total += own.fractional[i, count] * height(table, curve, edge, math.sqrt(low * low + part * NODES[i]))
    share = part / whole
    total *= share * amplitude_power(own, share)
    c = 0.5 * (1.0 - own.k)
    while low > x1 and c > 0.0:
        high = low
        # P at most four times as large at the far end: its singularity lies at r
        reach = r * r - 4.0 * (r - high) * (r + high)
        low = max(x1, high * max(0.5, 1.0 / growth), high - _PANEL * short, math.sqrt(max(0.0, reach)))
        width = (high - low) * (high + low)
        for i in range(count):
            square = (r - high) * (r + high) + width * NODES[i]
            x = math.sqrt(r * r - square)
            share = square / whole
            total += c * WEIGHTS[i] * width / whole * amplitude_power(own, share) * height(table, curve, edge, x)
    return total


@kernel()
def opening(table: AnyTable, curve: AnyCurve, edge: Edge, r: float) -> float:
    """Return the opening at the radius r > a, by the shorter of the two integrals."""
    if r > _FAR * edge.x and table_of(table, curve).k < 1.0:
        return opening_far(table, curve, edge, r)
    return opening_near(table, curve, edge, r)


@kernel(contract=True)
def openings_between(
    table: AnyTable, curve: AnyCurve, edge: Edge, low: float, high: float, heights: Floats, openings: Floats
) -> None:
    """Fill F at the nodes of low .. high, and what F contributes from there to the opening, at the nodes and at `high`.

    The contributions are over (x^2 - low^2)^c in place of X^c: for low = a they are the opening itself, else their
    signs are what matters. The nodes divide x^2. At most one shortest wave at a time. `heights` has the shape (16,),
    `openings` (17,).
    """
    own, count = table_of(table, curve), NODES.size
    fill_heights(table, curve, edge, low, (high - low) * (high + low), heights)
    for first in range(0, count, LANES):
        total = eight(0.0)
        for i in range(count):
            total = total + load(own.fractional[i], first) * heights[i]
        store(openings, first, total)
    last = 0.0
    for i in range(count):
        last += own.fractional[i, count] * heights[i]
    openings[count] = last
