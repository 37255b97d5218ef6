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

from gradhesion.core.curve.values import Curve, place_of
from gradhesion.core.jit import kernel
from gradhesion.core.table.layout import HALF, PU, PU1, N, Y


class Edge(NamedTuple):
    """The edge of one contact."""

    curve: Curve  # what moves at the speed V is the depth, and the load by its weight
    shortest: float  # the shortest wave, inf of a smooth punch
    speed: float  # eps = V/v* in the unit of depth over that of length
    power: float  # n of the law
    root: float  # rho in equilibrium
    sense: float  # 1 where rho is above that (opening), -1 where it is below (closing)


class Place(NamedTuple):
    """What there is at a radius."""

    depth: float  # depth_H
    load: float  # load_H
    adhesion: float  # Delta
    front: float  # T
    push: float
    level: float
    drag: float


@kernel
def place_at(edge: Edge, y: float) -> Place:
    """Return what there is at a radius y > 0 within the table; below it, U and U1 are straight."""
    table, B, g, _, by_load = edge.curve
    k, m = table.k, table.exponent
    stretch = y ** (-0.5 * (1.0 + k))
    adhesion, front = y * stretch, 1.0 / (stretch * stretch)
    power = B * (y * y if m == 2.0 else y**m)
    waves = waves1 = slope = 0.0
    if g != 0.0:
        first = table.nodes[Y, 0]
        inner = max(y, first)
        i, t = place_of(table, inner)
        for n in range(N - 1, -1, -1):
            slope = slope * t + waves
            waves = waves * t + table.polys[i, PU, n]
            waves1 = waves1 * t + table.polys[i, PU1, n]
        part = g * min(1.0, y / first)
        waves, waves1, slope = part * waves, part * waves1, part * slope * inner / table.nodes[HALF, i]
    tau = by_load * front
    return Place(
        depth=power + waves,
        load=front * ((1.0 - table.share) * power + waves - waves1),
        adhesion=adhesion,
        front=front,
        push=(m * power + slope) / adhesion,
        level=0.5 * (1.0 - k) + (1.0 + k) * tau / (1.0 + tau),
        drag=edge.speed * y / ((1.0 + tau) * adhesion),
    )


@kernel
def state_of(place: Place, rho: float) -> tuple[float, float]:
    """Return depth and load."""
    return place.depth - place.adhesion * rho, place.load - place.front * place.adhesion * rho


@kernel
def slowness(edge: Edge, lag: float) -> tuple[float, float]:
    """Return u^(-1/n) at a lag > 0, and its slope over it, which is negative; 1 + u goes as rho^2, or as 1/rho^2."""
    rho = edge.root + edge.sense * lag
    if rho <= 0.0:
        return 0.0, 0.0
    u = lag * (edge.root + rho) / min(edge.root, rho) ** 2
    return u ** (-1.0 / edge.power), -2.0 * (1.0 + u) / (edge.power * u * rho)


@kernel
def lag_of(edge: Edge, slow: float) -> float:
    """Return the lag at which the slowness has a positive value."""
    u = slow ** (-edge.power)
    far = math.sqrt(1.0 + u)
    return float(u / (1.0 + far) if edge.sense > 0.0 else edge.root * u / (far * (1.0 + far)))


@kernel
def pulls_at(edge: Edge, y: float, lag: float) -> tuple[float, float]:
    """Return need and force at a radius with a lag > 0."""
    place = place_at(edge, y)
    return place.push - place.level * (edge.root + edge.sense * lag), place.drag * slowness(edge, lag)[0]


@kernel
def load_at(edge: Edge, y: float, lag: float, slow: float) -> tuple[float, float, float]:
    """Return the load in opening, its slope by ln y, and what falls from 1 to -1 as y does, through 0 in a trough.

    y dP/dy = T Delta [force - ((3+k)/2 - level) rho]
    """
    place, rho = place_at(edge, y), edge.root + edge.sense * lag
    need, force = (0.5 * (3.0 + edge.curve.table.k) - place.level) * rho, place.drag * slow
    return state_of(place, rho)[1], place.front * place.adhesion * (force - need), (force - need) / (force + need)


@kernel
def goal(edge: Edge, y: float, lag: float, slow: float, target: float) -> float:
    """Return what is 0 where a step is to end: a trough of the load in opening, the depth `target` in closing."""
    if edge.sense > 0.0:
        return load_at(edge, y, lag, slow)[2]
    return state_of(place_at(edge, y), edge.root - lag)[0] - target
