"""What a moving edge meets at a radius, and the law of its speed.

With rho = (delta_H - delta)/Delta the state at a radius is any rho; in equilibrium it is 1 (opening) or sqrt(Gamma)
(closing), and the edge lags behind that:

    opening  rho = 1 + lag             u = rho^2 - 1
    closing  rho = sqrt(Gamma) - lag   u = Gamma/rho^2 - 1
    depth = depth_H - Delta rho,   load = load_H - T Delta rho,   Y = depth + by_load load
    y d rho/dy = push - level rho - drag u^(-1/n)
    push = y depth_H'/Delta,   drag = eps y/((1+tau) Delta),   tau = by_load T,   T = y^(1+k)

v = v* u^(1/n) is the speed of the edge. Its slowness u^(-1/n) falls from infinity at lag = 0; where closing meets
rho <= 0 it is 0: the edge follows at once. Units are those of tables (table/layout.py), radii y = 2 pi a/lambda.
"""

import math
from typing import NamedTuple

from gradhesion.core.curve.values import place_of
from gradhesion.core.jit import kernel
from gradhesion.core.table.layout import HALF, PU, PU1, N, Table, Y


class Edge(NamedTuple):
    """The edge of one contact."""

    table: Table
    B: float  # size of the power, B y^m
    g: float  # size of the waves, g U
    by_load: float  # weight of the load in what moves at the speed V, that of the depth being 1
    shortest: float  # the shortest wave, inf of a smooth punch
    speed: float  # eps = V/v* in the unit of depth over that of length
    power: float  # n of the law
    root: float  # rho in equilibrium
    sense: float  # 1 where rho is above that (opening), -1 where it is below (closing)


class Place(NamedTuple):
    """What there is at a radius, and slopes by ln y that a step needs."""

    depth: float  # depth_H
    load: float  # load_H
    adhesion: float  # Delta
    front: float  # T
    push: float
    level: float
    drag: float
    push_slope: float
    level_slope: float
    drag_slope: float  # of ln drag


@kernel
def place_at(edge: Edge, y: float) -> Place:
    """Return what there is at a radius y > 0 within the table; below it, U and U1 are straight."""
    table, k, m = edge.table, edge.table.k, edge.table.exponent
    stretch = y ** (-0.5 * (1.0 + k))
    adhesion, front = y * stretch, 1.0 / (stretch * stretch)
    power = edge.B * (y * y if m == 2.0 else y**m)
    waves = waves1 = slope = bend = 0.0
    if edge.g != 0.0:
        first = table.nodes[Y, 0]
        inner = max(y, first)
        i, t = place_of(table, inner)
        for n in range(N - 1, -1, -1):
            bend = bend * t + slope
            slope = slope * t + waves
            waves = waves * t + table.polys[i, PU, n]
            waves1 = waves1 * t + table.polys[i, PU1, n]
        part, steep = edge.g * min(1.0, y / first), inner / table.nodes[HALF, i]
        waves, waves1, slope, bend = part * waves, part * waves1, part * steep * slope, part * 2.0 * steep**2 * bend
    tau = edge.by_load * front
    share, push = tau / (1.0 + tau), (m * power + slope) / adhesion
    return Place(
        depth=power + waves,
        load=front * ((1.0 - table.share) * power + waves - waves1),
        adhesion=adhesion,
        front=front,
        push=push,
        level=0.5 * (1.0 - k) + (1.0 + k) * share,
        drag=edge.speed * y / ((1.0 + tau) * adhesion),
        push_slope=(m * m * power + slope + bend) / adhesion - 0.5 * (1.0 - k) * push,
        level_slope=(1.0 + k) ** 2 * share * (1.0 - share),
        drag_slope=0.5 * (1.0 + k) - (1.0 + k) * share,
    )


@kernel
def state_of(place: Place, rho: float) -> tuple[float, float]:
    """Return depth and load."""
    return place.depth - place.adhesion * rho, place.load - place.front * place.adhesion * rho


@kernel
def slowness(edge: Edge, lag: float) -> tuple[float, float]:
    """Return u^(-1/n) at a lag > 0, and its slope over it, which is negative."""
    n, root = edge.power, edge.root
    if edge.sense > 0.0:
        u = lag * (2.0 + lag)
        return u ** (-1.0 / n), -2.0 * (1.0 + lag) / (n * u)
    rho = root - lag
    if rho <= 0.0:
        return 0.0, 0.0
    u = lag * (root + rho) / (rho * rho)
    return u ** (-1.0 / n), -2.0 * root * root / (n * u * rho * rho * rho)


@kernel
def lag_of(edge: Edge, slow: float) -> float:
    """Return the lag at which the slowness has a positive value."""
    u = slow ** (-edge.power)
    far = math.sqrt(1.0 + u)
    return float(u / (1.0 + far) if edge.sense > 0.0 else edge.root * u / (far * (1.0 + far)))
