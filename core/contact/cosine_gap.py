"""The gap between the surfaces outside a contact of radius a at the depth delta(a).

    gap(r) = (2/pi) cos(k pi/2) int_a^r s^k (delta_H(s) - delta(a)) (r^2 - s^2)^(-(1+k)/2) ds

With P = z_r^2 - s^2 for the variable and X = z_r^2 - z_a^2 its range this is, in units of the depth,

    gap = sin(pi c)/(pi c) (X/z_a^2)^c z_a^c O(r),   O = X^(-c) c int_0^X P^(c-1) F dP,   F = h z_a^c/s^(2c)

with h = (depth_H(s) - depth)/z_a^c, which is 1 at the edge. The *opening* O tells the sign: it is the gap over that of
the edge alone, 1 at r = a, below 0 where the surfaces overlap. At k = 1, c = 0, it is h itself: there the surface
follows the punch locally.
"""

import math
from typing import Any, Final, TypeAlias

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine, wave
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.fractional import NODES, WEIGHTS
from gradhesion.core.struve.lanes import LANES, Lanes, eight, load, root_of, store
from gradhesion.core.struve.pair import first_functions
from gradhesion.core.struve.power import amplitude_power, amplitude_powers

Edge: TypeAlias = tuple[float, float, float, float]
"""x, z, z S0 and z^c at the edge of a contact."""

_LAST_PANEL: Final = 0.7
"""Waves, for which the polynomial of the panel that ends at r leaves 1e-12 of a cosine."""
_PANEL: Final = 2.0
"""Waves a Gauss panel."""
_NEAR: Final = 0.75
"""Inner over outer radius of the last panel, at least: the branch point at s = 0 then leaves 1e-13."""


@kernel(contract=True)
def edge_at(table: Any, curve: Cosine, x: float) -> Edge:
    """Return the edge of a contact of radius x."""
    _, _, lag = curve
    z, power, s0, _, _, _, _ = wave(table, lag, x)
    return x, z, z * s0, z * power


@kernel(contract=True)
def _excess(curve: Cosine, edge: Edge, x: float, z: float, power: float, s0: float) -> float:
    """Return F where z^(-n) and S0 are known, at one place or at eight (struve/lanes.py)."""
    b, g, _ = curve
    x1, z1, wave1, stretch1 = edge
    # differences first, as in curve/cosine_energy.py
    rise = 0.5 * b * (z + z1) * (TWO_PI * (x - x1)) + g * (z * s0 - wave1)
    stretch = z * power
    return (rise + stretch1) * stretch1 / (stretch * stretch)


@kernel(contract=True)
def height(table: Any, curve: Cosine, edge: Edge, x: float) -> float:
    """Return F at the radius x: by how much depth_H exceeds the depth of the contact, weighted."""
    _, _, lag = curve
    z, power, s0, _, _, _, _ = wave(table, lag, x)
    return _excess(curve, edge, x, z, power, s0)


@kernel(contract=True)
def _heights(table: Any, curve: Cosine, edge: Edge, x: Lanes) -> Lanes:
    """Return F at eight radii, the innermost first."""
    _, _, lag = curve
    z = TWO_PI * x
    power = amplitude_powers(table, z)
    return _excess(curve, edge, x, z, power, first_functions(table, lag, x, z, power))


@kernel(contract=True)
def opening(table: Any, curve: Cosine, edge: Edge, r: float) -> float:
    """Return the opening at the radius r > a.

    Panels go inwards from r: the first with the weights of fractional.py, which take the singular factor into
    account, the others by Gauss's rule. Error: 1e-11 of the largest F.
    """
    x1, _, _, _ = edge
    count = NODES.size
    whole = (r - x1) * (r + x1)
    low = max(x1, _NEAR * r, r - _LAST_PANEL)
    part = (r - low) * (r + low)
    total = 0.0
    for i in range(count):
        total += table.fractional[i, count] * height(table, curve, edge, math.sqrt(low * low + part * NODES[i]))
    share = part / whole
    total *= share * amplitude_power(table, share)
    c = 0.5 * (1.0 - table.k)
    while low > x1:
        high = low
        # P at most four times as large at the far end: its singularity lies at r
        reach = r * r - 4.0 * (r - high) * (r + high)
        low = max(x1, 0.5 * high, high - _PANEL, math.sqrt(max(0.0, reach)))
        width = (high - low) * (high + low)
        for i in range(count):
            square = (r - high) * (r + high) + width * NODES[i]
            x = math.sqrt(r * r - square)
            share = square / whole
            total += c * WEIGHTS[i] * width / whole * amplitude_power(table, share) * height(table, curve, edge, x)
    return total


@kernel(contract=True)
def openings_between(
    table: Any, curve: Cosine, edge: Edge, low: float, high: float, heights: Any, openings: Any
) -> None:
    """Fill F at the nodes of low .. high, and what F contributes from there to the opening, at the nodes and at `high`.

    The contributions are over (x^2 - low^2)^c in place of X^c: for low = a they are the opening itself, else their
    signs are what matters. The nodes divide x^2. At most a wave is taken at a time.
    """
    count = NODES.size
    width = (high - low) * (high + low)
    for first in range(0, count, LANES):
        radii = root_of(low * low + width * load(NODES, first))
        store(heights, first, _heights(table, curve, edge, radii))
    for first in range(0, count, LANES):
        total = eight(0.0)
        for i in range(count):
            total = total + load(table.fractional[i], first) * heights[i]
        store(openings, first, total)
    last = 0.0
    for i in range(count):
        last += table.fractional[i, count] * heights[i]
    openings[count] = last


@kernel(contract=True)
def trough_gap(table: Any, curve: Cosine, edge: Edge, r: float) -> float:
    """Return the gap in units of the depth at a trough of the profile, r a whole number, far outside the contact.

    The integral from 0 to r is the profile itself, (1+k) b z^2/4 at a trough; what lies within the contact is left:

        gap = f(r) - depth + (2/pi) cos(k pi/2) int_0^a s^k (depth - depth_H) (r^2 - s^2)^(-(1+k)/2) ds
    """
    b, g, lag = curve
    k = table.k
    a, z1, wave1, stretch1 = edge
    level = 0.5 * b * z1 * z1 + g * wave1 - stretch1
    total = 0.0
    panels = int(a) + 1
    for panel in range(panels):
        low, high = a * panel / panels, a * (panel + 1) / panels
        for i in range(NODES.size):
            share = NODES[i] if panel > 0 else NODES[i] ** 4  # s^k has a branch point at 0
            rate = high - low if panel > 0 else 4.0 * NODES[i] ** 3 * high
            x = low + (high - low) * share
            z, _, s0, _, _, _, _ = wave(table, lag, x)
            below = level - z * (0.5 * b * z + g * s0)
            total += WEIGHTS[i] * rate * below * x**k * ((r - x) * (r + x)) ** (-0.5 * (1.0 + k))
    z = TWO_PI * r
    return 0.25 * (1.0 + k) * b * z * z - level + 2.0 / math.pi * math.sin(0.5 * math.pi * (1.0 - k)) * total
