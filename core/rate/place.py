"""The quantities of a curve at a radius that a moving edge needs, in the reduced form of core/curve/general.py.

With rho = (delta_H - delta)/Delta the state at a radius is any rho, in equilibrium 1:

    depth = depth_H - Delta rho,   load = load_H - z^(1+k) Delta rho,   Y = alpha depth + beta load
    a d rho/da = q_hat - q0 rho - drag pace u^(-1/n)
    q_hat = a delta_H'/Delta,   drag = z/((alpha + beta z^(1+k)) Delta)
"""

from typing import NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series, level_at
from gradhesion.core.face import waves_at
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power


class Place(NamedTuple):
    """The curve at a radius."""

    z: float
    depth: float  # depth_H
    load: float  # load_H
    adhesion: float  # Delta
    front: float  # z^(1+k)
    push: float  # q_hat
    level: float  # q0
    drag: float


@kernel(contract=True)
def place_at(basis: Basis, curve: Series, x: float) -> Place:
    """Return the curve at x > 0."""
    table, _, _ = basis
    B, m, g, alpha, beta = curve
    z = TWO_PI * x
    power = amplitude_power(table, z)
    stretch, front = z * power, 1.0 / (power * power)
    bend = B * z * z if m == 2.0 else B * z**m
    w0, w1, v, _ = waves_at(basis, curve, x, 0.0)
    t = beta * front
    return Place(
        z,
        bend + g * z * w0,
        front * (bend * (m / (1.0 + table.k + m)) + g * z * w1),
        stretch,
        front,
        (m * bend + g * z * v) / stretch,
        level_at(table.k, alpha, t),
        z / ((alpha + t) * stretch),
    )


@kernel()
def load_of(place: Place, rho: float) -> float:
    """Return the load."""
    return place.load - place.front * place.adhesion * rho


@kernel()
def coordinate_of(curve: Series, place: Place, rho: float) -> float:
    """Return Y."""
    lag = place.adhesion * rho
    return curve.alpha * (place.depth - lag) + curve.beta * (place.load - place.front * lag)
