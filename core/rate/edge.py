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
    """The edge of one contact.

    functions   S and C of the exponent k of its half-space
    waves       harmonics of the punch, rows (n, cos, sin)
    exponent    m, the power of the punch
    size        delta_H of the power is size a^m
    height      A lambda, 0 of a smooth punch
    number      2 pi/lambda
    shortest    the shortest wave, inf of a smooth punch
    stretch     Delta is stretch a^((1-k)/2)
    stiffness   K
    spring      1/S of the machine, 0 where the depth is prescribed
    speed       eps = V/v*
    power       n of the law
    root        rho in equilibrium
    sense       1 where rho is above that (opening), -1 where it is below (closing)
    """

    functions: Functions
    waves: Floats
    exponent: float
    size: float
    height: float
    number: float
    shortest: float
    stretch: float
    stiffness: float
    spring: float
    speed: float
    power: float
    root: float
    sense: float


class Place(NamedTuple):
    """What there is at a radius, as in the equations above."""

    depth: float  # depth_H
    load: float  # load_H
    adhesion: float  # Delta
    front: float  # K a^(1+k)
    push: float
    level: float
    drag: float


@kernel
def place_at(edge: Edge, a: float) -> Place:
    """Return what there is at a radius a > 0."""
    k, m, height = edge.functions.k, edge.exponent, edge.height
    depth = edge.size * a**m
    rise, own = m * depth, m / (1.0 + k + m) * depth  # a delta_H', and load_H over K a^(1+k)
    if height > 0.0:
        for h in range(len(edge.waves)):
            n, cos, sin = edge.waves[h]
            z = n * edge.number * a
            S0, C0, S1, C1 = pairs_at(edge.functions, z)
            wave = height * z * (cos * S0 + sin * C0)
            depth += wave
            rise += wave + height * z * z * (cos * (1.0 - z * S1) - sin * z * C1) / (1.0 + k)
            own += wave - height * z * (cos * S1 + sin * C1)
    adhesion, front = edge.stretch * a ** (0.5 * (1.0 - k)), edge.stiffness * a ** (1.0 + k)
    tau = edge.spring * front
    level = (0.5 * (1.0 - k) + tau * 0.5 * (3.0 + k)) / (1.0 + tau)
    return Place(depth, front * own, adhesion, front, rise / adhesion, level, edge.speed * a / ((1.0 + tau) * adhesion))


@kernel
def depth_of(place: Place, rho: float) -> float:
    """Return the depth."""
    return place.depth - place.adhesion * rho


@kernel
def load_of(place: Place, rho: float) -> float:
    """Return the load."""
    return place.load - place.front * place.adhesion * rho


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
