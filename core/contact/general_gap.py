"""The gap outside a contact for any profile: core/contact/cosine_gap.py with the depths of any power and series.

The gap follows from depth_H alone, whatever is prescribed. Up to a positive factor it is the *opening*

    O(r) = X^(-c) c int_0^X P^(c-1) F dP,   P = z_r^2 - s^2,   X = z_r^2 - z_a^2,
    F = (depth_H(s) - depth(z_a))/z_a^c (z_a/s)^(2c)

1 at the edge, below 0 where the surfaces overlap. Far outside the integral over the contact is shorter (the second form
of docs/theory.md, section 12). Lengths of panels are told in waves of the highest harmonic.
"""

import math
from typing import Any, Final, TypeAlias

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.touch import profile_at
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.fractional import NODES, WEIGHTS
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.struve.series import sums

Edge: TypeAlias = tuple[float, float, float, float]
"""x, B z^m, g z w0 and z^c at the edge of a contact."""

_LAST_PANEL: Final = 0.7
"""Shortest waves, for which the polynomial of the panel that ends at r leaves 1e-12 of a cosine."""
_PANEL: Final = 2.0
"""Shortest waves a Gauss panel."""
_NEAR: Final = 0.75
"""Inner over outer radius of the last panel, at least: the branch point at s = 0 then leaves 1e-13."""
_FAR: Final = 2.0
"""Contact radii from which on the integral over the contact is taken."""
_LOW_POWER: Final = 7.0
"""m up to which z^m is smooth enough for the panel at the centre; above it must have become negligible there."""
_NEGLIGIBLE: Final = 40.0
"""Logarithm of what is."""
_GROWTH: Final = 4.0
"""Logarithm of how much the power z^m may grow in a panel: 16 nodes leave 1e-12 of it."""


@kernel()
def shortest_wave(series: Any) -> float:
    """Return the length of the shortest wave in lambda, inf for a smooth punch."""
    highest = 0.0
    for i in range(series.shape[0]):
        highest = max(highest, series[i, 0])
    return 1.0 / highest if highest > 0.0 else math.inf


@kernel()
def growth_of_a_panel(m: float) -> float:
    """Return the largest ratio of the radii of a panel for the sake of the power z^m."""
    return math.exp(_GROWTH / m)


@kernel(contract=True)
def edge_at(basis: Basis, curve: Series, x: float) -> Edge:
    """Return the edge of a contact of radius x > 0."""
    table, cosine_bins, series = basis
    B, m, g, _, _ = curve
    z = TWO_PI * x
    w0, _, _, _ = sums(table, cosine_bins, series, x, 0.0)
    return x, B * z**m, g * z * w0, z * amplitude_power(table, z)


@kernel(contract=True)
def _excess(basis: Basis, curve: Series, edge: Edge, x: float) -> float:
    """Return by how much depth_H at the radius x exceeds the depth of the contact."""
    table, cosine_bins, series = basis
    _, m, g, _, _ = curve
    x1, bend1, wave1, stretch1 = edge
    w0, _, _, _ = sums(table, cosine_bins, series, x, 0.0)
    # each term's difference first, as in curve/general_energy.py
    return bend1 * math.expm1(m * math.log1p((x - x1) / x1)) + (g * (TWO_PI * x) * w0 - wave1) + stretch1


@kernel(contract=True)
def height(basis: Basis, curve: Series, edge: Edge, x: float) -> float:
    """Return F at the radius x."""
    table, _, _ = basis
    _, _, _, stretch1 = edge
    z = TWO_PI * x
    stretch = z * amplitude_power(table, z)
    return _excess(basis, curve, edge, x) * stretch1 / (stretch * stretch)


@kernel(contract=True)
def opening_far(basis: Basis, curve: Series, edge: Edge, r: float) -> float:
    """Return the opening at a radius far outside, for k < 1.

    gap = f(r) - depth + (2/pi) cos(k pi/2) int_0^a s^k (depth - depth_H) (r^2 - s^2)^(-(1+k)/2) ds
    """
    table, _, series = basis
    _, m, _, _, _ = curve
    k = table.k
    a, bend1, wave1, stretch1 = edge
    level = bend1 + wave1 - stretch1
    short, growth = shortest_wave(series), growth_of_a_panel(m)
    total, high = 0.0, a
    while high > 0.0:
        low = max(high - _PANEL * short, high * max(0.5, 1.0 / growth))
        last = high <= 0.25 * short and (m <= _LOW_POWER or m * math.log(a / high) > _NEGLIGIBLE)
        for i in range(NODES.size):
            share = NODES[i] ** 4 if last else NODES[i]  # s^k has a branch point at 0
            rate = 4.0 * NODES[i] ** 3 * high if last else high - low
            x = high * share if last else low + (high - low) * share
            below = -_excess(basis, curve, edge, x)
            total += WEIGHTS[i] * rate * below * x**k * ((r - x) * (r + x)) ** (-0.5 * (1.0 + k))
        high = 0.0 if last else low
    c = 0.5 * (1.0 - k)
    sine = math.sin(math.pi * c)
    gap = profile_at(basis, curve, r) - level + 2.0 / math.pi * sine * total
    return gap * math.pi * c / sine * (TWO_PI * (r - a) / a * (r + a)) ** (-c)


@kernel(contract=True)
def opening_near(basis: Basis, curve: Series, edge: Edge, r: float) -> float:
    """Return the opening at the radius r > a from the depths between the two.

    Panels go inwards from r: the first with the weights of struve/fractional.py, which take the singular factor into
    account, the others by Gauss's rule. Error: 1e-11 of the largest F.
    """
    table, _, series = basis
    _, m, _, _, _ = curve
    x1, _, _, _ = edge
    count = NODES.size
    short, growth = shortest_wave(series), growth_of_a_panel(m)
    whole = (r - x1) * (r + x1)
    low = max(x1, r - _LAST_PANEL * short, r * max(_NEAR, 1.0 / growth))
    part = (r - low) * (r + low)
    total = 0.0
    for i in range(count):
        total += table.fractional[i, count] * height(basis, curve, edge, math.sqrt(low * low + part * NODES[i]))
    share = part / whole
    total *= share * amplitude_power(table, share)
    c = 0.5 * (1.0 - table.k)
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
            total += c * WEIGHTS[i] * width / whole * amplitude_power(table, share) * height(basis, curve, edge, x)
    return total


@kernel()
def opening(basis: Basis, curve: Series, edge: Edge, r: float) -> float:
    """Return the opening at the radius r > a, by the shorter of the two integrals."""
    table, _, _ = basis
    a, _, _, _ = edge
    if r > _FAR * a and table.k < 1.0:
        return opening_far(basis, curve, edge, r)
    return opening_near(basis, curve, edge, r)


@kernel(contract=True)
def openings_between(
    basis: Basis, curve: Series, edge: Edge, low: float, high: float, heights: Any, openings: Any
) -> None:
    """Fill F at the nodes of low .. high, and what F contributes from there to the opening, at the nodes and at `high`.

    As `openings_between` of core/contact/cosine_gap.py; at most a shortest wave is taken at a time.
    """
    table, _, _ = basis
    count = NODES.size
    width = (high - low) * (high + low)
    for i in range(count):
        heights[i] = height(basis, curve, edge, math.sqrt(low * low + width * NODES[i]))
    openings[: count + 1] = 0.0
    for i in range(count):
        for place in range(count + 1):
            openings[place] += table.fractional[i, place] * heights[i]
