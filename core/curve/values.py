"""A curve of equilibrium: depth, load and slope at a radius.

A curve is a table and four numbers: B and g, the sizes of the power and of the waves in the units of table/layout.py,
and the weights of depth and load in what is prescribed, the coordinate

    Yc = by_depth depth + by_load load

(1, 0) under displacement control, (0, 1) under load control, (1, K l^(1+k)/S) through a machine of stiffness S. All
radii are y = 2 pi a/lambda; a place in bin i is t, from -1 at its lower edge to 1 at its upper one.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table import layout as at
from gradhesion.core.table.filling import waves_at
from gradhesion.core.table.layout import GEOMETRIC, LANES, RATIO, N, Source, Table, end_of

_STEEP: Final = 1.0 / math.log(RATIO)


class Curve(NamedTuple):
    """A curve of equilibrium, in the units of its table.

    table       functions of its exponent, power and series
    B           size of the power, B y^m
    g           size of the waves, g U
    by_depth    weight of the depth in what is prescribed
    by_load     weight of the load
    """

    table: Table
    B: float
    g: float
    by_depth: float
    by_load: float


@leaf
def load_curve(curve: Curve) -> Curve:
    """Return the same curve with the load prescribed."""
    return Curve(curve.table, curve.B, curve.g, 0.0, 1.0)


@leaf
def bin_of(table: Table, y: float) -> int:
    """Return the bin of a radius, the first or last one beyond the table."""
    if y >= table.start:
        return min(table.geometric + int((y - table.start) / table.width), table.bins - 1)
    if table.geometric == 0:
        return 0
    return max(0, min(table.geometric - 1, GEOMETRIC + int(math.floor(math.log(y / table.start) * _STEEP))))


@leaf
def place_of(table: Table, y: float) -> tuple[int, float]:
    """Return the bin of a radius and the place in it."""
    i = bin_of(table, y)
    return i, (y - table.nodes[at.YC, i]) / table.nodes[at.HALF, i]


@leaf
def radius_of(table: Table, i: int, t: float) -> float:
    """Return the radius of a place in bin i."""
    return table.nodes[at.YC, i] + table.nodes[at.HALF, i] * t


@leaf
def depth_and_load(curve: Curve, i: int, t: float) -> tuple[float, float]:
    """Return depth and load at a place in bin i."""
    table, polys = curve.table, curve.table.polys
    share = table.share * curve.B
    flat = waves = stretch = 0.0
    for n in range(N - 1, -1, -1):
        flat = flat * t + (curve.B * polys[i, at.PP, n] + curve.g * polys[i, at.PU, n])
        waves = waves * t + (share * polys[i, at.PP, n] + curve.g * polys[i, at.PU1, n])
        stretch = stretch * t + polys[i, at.PE, n]
    depth = flat - radius_of(table, i, t) * stretch
    return depth, (depth - waves) / (stretch * stretch)


@leaf
def state_in(curve: Curve, y: float) -> tuple[float, float]:
    """Return depth and load at a radius within the table."""
    i, t = place_of(curve.table, y)
    return depth_and_load(curve, i, t)


@kernel
def state_at(curve: Curve, source: Source, y: float) -> tuple[float, float]:
    """Return depth and load at a radius, also beyond the table of an interface without pattern."""
    if y > end_of(curve.table):
        k = curve.table.k
        u, u1 = waves_at(source, y)
        power = curve.B * y**curve.table.exponent
        depth = power + curve.g * u - y ** (0.5 * (1.0 - k))
        return depth, y ** (1.0 + k) * (depth - curve.table.share * power - curve.g * u1)
    i, t = place_of(curve.table, y)
    return depth_and_load(curve, i, t)


@leaf
def coordinate_of(curve: Curve, depth: float, load: float) -> float:
    """Return what is prescribed at a state."""
    return curve.by_depth * depth + curve.by_load * load


@leaf
def softness(curve: Curve, stiffness: float) -> float:
    """Return by how much the coordinate rises with the depth of a contact of a stiffness T = y^(1+k) that is pinned."""
    return curve.by_depth + curve.by_load * stiffness


@leaf
def level_at(curve: Curve, i: int) -> float:
    """Return (1+k) tau/(1+tau) at the lower edge of bin i: the share of the load in the level of folds."""
    x = curve.by_load * curve.table.nodes[at.T, i]
    return (1.0 + curve.table.k) * x / (curve.by_depth + x)


@leaf
def slope_at(curve: Curve, i: int) -> float:
    """Return D at the lower edge of bin i, whose sign is that of the slope of what is prescribed."""
    level = level_at(curve, i) if curve.by_load != 0.0 else 0.0
    nodes = curve.table.nodes
    D = curve.B * nodes[at.SLOPE, i] + curve.g * nodes[at.V, i] - 0.5 * (1.0 - curve.table.k) * nodes[at.E, i]
    return D - level * nodes[at.KE, i]


@leaf
def depth_at_centre(curve: Curve) -> float:
    """Return the depth at a first fold below the table, where B y^m + g U is a straight line and the toughness kappa.

    The line rises there as fast as kappa q y^(eta-1), eta = (1-k)/2. Where k is almost 1, much of the stretch kappa
    y^eta is left at that radius, however small it is.
    """
    k, nodes = curve.table.k, curve.table.nodes
    y, eta, kappa = nodes[at.Y, 0], 0.5 * (1.0 - k), max(nodes[at.KE, 0] / nodes[at.E, 0], 0.0)
    q = eta if curve.by_depth > 0.0 else eta + 1.0 + k
    excess = (kappa - 1.0) * nodes[at.E, 0]  # which the row U of a pattern has taken off
    rise = curve.B * nodes[at.SLOPE, 0] + curve.g * nodes[at.V, 0] + eta * excess
    flat = curve.B * nodes[at.P, 0] + curve.g * nodes[at.U, 0] + y * excess
    return flat - y * rise - (1.0 - q) * kappa * (kappa * q / rise) ** (eta / (1.0 - eta))


@leaf
def slope_in(curve: Curve, i: int, t: float) -> tuple[float, float, float, float]:
    """Return D and its first two derivatives by t, times the half width of bin i, and the depth, at a place in it.

    D = B m y^(m-1) + g U' - [(1-k)/2 E + (1+k) share kappa E], with `share` that of the load in what is prescribed:
    the terms are `flat1`, `rest` and `level`, each times the half width.
    """
    table, polys = curve.table, curve.table.polys
    k = table.k
    flat = flat1 = flat2 = flat3 = stretch = 0.0
    for n in range(N - 1, -1, -1):
        flat3 = flat3 * t + flat2
        flat2 = flat2 * t + flat1
        flat1 = flat1 * t + flat
        flat = flat * t + (curve.B * polys[i, at.PP, n] + curve.g * polys[i, at.PU, n])
        stretch = stretch * t + polys[i, at.PE, n]
    half = table.nodes[at.HALF, i]
    y = radius_of(table, i, t)
    x = half / y  # d E/dt = -(1+k)/2 x E, and so on
    power = 0.5 * (1.0 + k)
    rest = half * stretch * 0.5 * (1.0 - k)
    depth = flat - y * stretch
    D, D1, D2 = flat1 - rest, 2.0 * flat2 + power * x * rest, 6.0 * flat3 - power * (power + 1.0) * x * x * rest
    if curve.by_load == 0.0:
        return D, D1, D2, depth
    tau = curve.by_load / (stretch * stretch)
    share = tau / (curve.by_depth + tau)
    change = (1.0 + k) * x * share * (1.0 - share)  # of the share, by t
    if polys.shape[1] == LANES:
        level, level1 = (1.0 + k) * half * share * stretch, (1.0 + k) * half * change * stretch
        D2 -= power * x * ((power + 1.0) * x * level - 2.0 * level1)
        return D - level, D1 + power * x * level - level1, D2, depth
    waves = waves1 = 0.0  # kappa E = E + W/y; its second derivative is left out, which costs a step of a search
    for n in range(N - 1, -1, -1):
        waves1 = waves1 * t + waves
        waves = waves * t + polys[i, at.PW, n]
    own, own1 = stretch + waves / y, -power * x * stretch + (waves1 - waves * x) / y
    weight = (1.0 + k) * half
    return D - weight * share * own, D1 - weight * (share * own1 + change * own), D2, depth


@kernel
def slope_near(curve: Curve, i: int, t: float) -> tuple[float, float, float, float]:
    """Return what `slope_in` does, where it is seldom wanted: compiled once, not into its callers."""
    return slope_in(curve, i, t)


@leaf
def coordinate_at(curve: Curve, i: int) -> float:
    """Return what is prescribed at the lower edge of bin i."""
    nodes = curve.table.nodes
    power = curve.B * nodes[at.P, i]
    depth = power + curve.g * nodes[at.U, i] - nodes[at.Y, i] * nodes[at.E, i]
    if curve.by_load == 0.0:
        return depth
    load = nodes[at.T, i] * (depth - curve.table.share * power - curve.g * nodes[at.U1, i])
    return coordinate_of(curve, depth, load)


@leaf
def terms_at(curve: Curve, i: int) -> float:
    """Return the sum of the sizes of the terms of the coordinate at the lower edge of bin i."""
    nodes = curve.table.nodes
    power = curve.B * nodes[at.P, i]
    terms = power + abs(curve.g * nodes[at.U, i]) + nodes[at.Y, i] * nodes[at.E, i]
    if curve.by_load == 0.0:
        return terms
    load = nodes[at.T, i] * (terms + curve.table.share * power + abs(curve.g * nodes[at.U1, i]))
    return coordinate_of(curve, terms, load)


@leaf
def slope_terms_at(curve: Curve, i: int) -> float:
    """Return the sum of the sizes of the terms of D at the lower edge of bin i."""
    level = level_at(curve, i) if curve.by_load != 0.0 else 0.0
    nodes = curve.table.nodes
    power = curve.B * nodes[at.SLOPE, i]
    return (
        power + abs(curve.g * nodes[at.V, i]) + 0.5 * (1.0 - curve.table.k) * nodes[at.E, i] + level * nodes[at.KE, i]
    )
