"""How far out a coordinate is reached for sure, from the sizes of the waves."""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.numbers.circle import TWO_PI

WAVES: Final = 1.06
"""The most by which the waves of depth and load exceed their leading terms, far out."""
_OUTERMOST: Final = 1e100
_HALVINGS: Final = 8


@kernel()
def envelope_at(curve: Series, k: float, pull: float, height: float, z: float) -> float:
    """Return about the least that Y can be at z."""
    B, m, _, alpha, beta = curve
    power, front = z ** (0.5 * (1.0 - k)), z ** (1.0 + k)
    bend = B * z**m
    below = pull * power + height
    return alpha * (bend - below) + beta * front * (bend * (m / (1.0 + k + m)) - below)


@kernel()
def reach(basis: Basis, curve: Series, target: float) -> float:
    """Do what `reach` of core/face.py says."""
    table, _, series = basis
    _, _, g, _, _ = curve
    swing, height = 0.0, 0.0
    for i in range(series.shape[0]):
        h = math.hypot(series[i, 1], series[i, 2])
        swing += h * series[i, 0] ** (0.5 * (1.0 - table.k))
        height += h
    pull, height = 1.0 + WAVES * g * table.amplitude * swing, g * height
    low, high = 0.0, 1.0
    while envelope_at(curve, table.k, pull, height, high) <= target:
        low, high = high, 2.0 * high
        if high > _OUTERMOST:
            return math.inf
    while low == 0.0:
        if envelope_at(curve, table.k, pull, height, 0.5 * high) <= target or high * _OUTERMOST < 1.0:
            low = 0.5 * high
        else:
            high *= 0.5
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if envelope_at(curve, table.k, pull, height, middle) <= target:
            low = middle
        else:
            high = middle
    return high / TWO_PI
