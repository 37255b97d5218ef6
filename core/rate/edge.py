"""What a moving edge meets at a radius, and the law of its speed.

With rho = (delta_H - delta)/Delta the state at a radius is any rho; in equilibrium it is 1 (opening) or sqrt(Gamma)
(closing), and the edge lags behind that:

    opening  rho = 1 + lag             u = rho^2 - 1
    closing  rho = sqrt(Gamma) - lag   u = Gamma/rho^2 - 1
    depth = depth_H - Delta rho,   load = load_H - K a^(1+k) Delta rho,   Y = depth + load/S
    a d rho/da = push - level rho - drag u^(-1/n)
    push = a delta_H'/Delta,   drag = eps a/((1+tau) Delta),   tau = K a^(1+k)/S

v = v* u^(1/n) is the speed of the edge. Its slowness u^(-1/n) falls from infinity at lag = 0; where closing meets
rho <= 0 it is 0: the edge follows at once. Lengths are in R, loads in R dgamma, energies in R^2 dgamma.
"""

import math
from typing import NamedTuple

from gradhesion.core.jit import kernel
from gradhesion.core.table.functions import Functions, pairs_at
from gradhesion.core.types import Floats


class Edge(NamedTuple):
    """The edge of one contact."""

    functions: Functions  # S and C of the exponent k of its half-space
    waves: Floats  # harmonics of the punch, rows (n, cos, sin)
    exponent: float  # m, the power of the punch
    size: float  # delta_H of the power is size a^m
    height: float  # A lambda, 0 of a smooth punch
    number: float  # 2 pi/lambda
    shortest: float  # the shortest wave, inf of a smooth punch
    stretch: float  # Delta is stretch a^((1-k)/2)
    stiffness: float  # K
    spring: float  # 1/S of the machine, 0 where the depth is prescribed
    speed: float  # eps = V/v*
    power: float  # n of the law
    root: float  # rho in equilibrium
    sense: float  # 1 where rho is above that (opening), -1 where it is below (closing)


class Place(NamedTuple):
    """What there is at a radius, and the slopes of it, times a, that a step needs."""

    depth: float  # depth_H
    load: float  # load_H
    adhesion: float  # Delta
    front: float  # K a^(1+k)
    push: float
    level: float
    drag: float
    push_slope: float
    level_slope: float
    drag_slope: float  # of ln drag


@kernel
def place_at(edge: Edge, a: float) -> Place:
    """Return what there is at a radius a > 0."""
    k, m, height = edge.functions.k, edge.exponent, edge.height
    depth = edge.size * a**m
    rise, bend, own = m * depth, m * m * depth, m / (1.0 + k + m) * depth  # (a d/da)^1, ^2 of depth_H; load_H/K a^(1+k)
    if height > 0.0:
        for h in range(len(edge.waves)):
            n, cos, sin = edge.waves[h]
            z = n * edge.number * a
            S0, C0, S1, C1 = pairs_at(edge.functions, z)
            value, more = height * z * (cos * S0 + sin * C0), height * z * (cos * S1 + sin * C1)
            slope = height * z * z * (cos * (1.0 - z * S1) - sin * z * C1) / (1.0 + k)
            depth, own = depth + value, own + value - more
            rise, bend = rise + value + slope, bend + value + 3.0 * slope + z * z * (more - value)
    adhesion, front = edge.stretch * a ** (0.5 * (1.0 - k)), edge.stiffness * a ** (1.0 + k)
    tau = edge.spring * front
    share, push = tau / (1.0 + tau), rise / adhesion
    return Place(
        depth=depth,
        load=front * own,
        adhesion=adhesion,
        front=front,
        push=push,
        level=0.5 * (1.0 - k) + (1.0 + k) * share,
        drag=edge.speed * a / ((1.0 + tau) * adhesion),
        push_slope=bend / adhesion - 0.5 * (1.0 - k) * push,
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
    return u / (1.0 + far) if edge.sense > 0.0 else edge.root * u / (far * (1.0 + far))
