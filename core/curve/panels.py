"""Panels of Gauss's rule along a jump on a general curve, as many nodes in each as its waves need.

The integrand has the square of every wave, and branch points where powers of z have them: at z = 0, and under a machine
beside the panel. A panel is as long as the longest rule allows, and short against its distance from those. Its places
are a part of `PLACES`, with the weights `SHARES`.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NONE, ONE, kernel
from gradhesion.core.curve.cosine_energy import LONG, NODES, WEIGHTS, unit_rule
from gradhesion.core.numbers.circle import TWO_PI

_RULES: Final = {12: 0.8, 16: LONG, 20: 1.85, 24: 2.6, 32: 4.2}
"""The most of the shortest waves for a rule of so many nodes: its error is 1e-15 of the square of a wave."""
_REACH: Final = np.array([*_RULES.values()])
_BEGIN: Final = np.cumsum([0, *_RULES])
PLACES: Final = np.concatenate([unit_rule(nodes)[0] for nodes in _RULES])
SHARES: Final = np.concatenate([unit_rule(nodes)[1] for nodes in _RULES])
GROWTH: Final = 4.5
"""Outer over inner end of a panel: its distance from the branch point leaves 1e-15."""
GROWTH_OF_MACHINE: Final = 3.0
"""The same where alpha + beta z^(1+k) has zeros beside the panel."""
_POWER: Final = 7
INNER_PLACES: Final = NODES**_POWER
INNER_SHARES: Final = WEIGHTS * _POWER * NODES ** (_POWER - 1)
"""The innermost panel, down to 0: x = h t^7 makes the powers of z smooth. With 16 nodes that leaves 2e-15 of its share,
and 1e-15 of waves that turn by no more than 1/4 there."""
SMOOTH: Final = 1.0 / 9.0
"""Innermost panel over the radius, or over that where powers of z change their balance."""


@kernel()
def _rule(waves: float, least: int) -> tuple[int, int]:
    """Return where the places of a rule for so many of the shortest waves begin and end; `least` is the first."""
    rule = least
    while rule < _REACH.size - 1 and waves > _REACH[rule]:
        rule += 1
    return _BEGIN[rule], _BEGIN[rule + 1]


@kernel()
def panel_outwards(low: float, high: float, whole: float, shortest: float) -> tuple[float, float, int, int]:
    """Return the width of the panel that begins `whole` + low waves out, where it ends, and the range of its places.

    `shortest` is the number of the highest harmonic; the last panel ends at `high`.
    """
    width = 2.0 * (whole + low)
    if shortest * width > _REACH[-1]:
        width = _REACH[-1] / shortest
    panels = max(1, math.ceil((high - low) / width - 1e-9))
    width = (high - low) / panels if panels < 3 else width
    begin, end = _rule(shortest * width, NONE if width <= whole + low else ONE)
    return width, low + width if panels > 1 else high, begin, end


@kernel()
def panel_inwards(high: float, growth: float, shortest: float) -> tuple[float, int, int]:
    """Return where the panel begins that ends at `high`, on the way to zero, and the range of its places."""
    low = high / growth
    if shortest * (high - low) > _REACH[-1]:
        low = high - _REACH[-1] / shortest
    begin, end = _rule(shortest * (high - low), ONE)
    return low, begin, end


@kernel()
def panel_after(low: float, growth: float, shortest: float) -> float:
    """Return where the panel ends that begins at `low`, where panels go outwards from places of their own."""
    return min(low * growth, low + _REACH[-1] / shortest)


@kernel()
def rule_between(low: float, high: float, shortest: float) -> tuple[int, int]:
    """Return the range of places of a panel away from zero, which may be the part of one."""
    return _rule(shortest * (high - low), ONE)


@kernel()
def panels_to_zero(k: float, alpha: float, beta: float, x: float, shortest: float) -> tuple[float, float]:
    """Return where the innermost panel ends at most, and by how much those beyond it may grow."""
    inner, growth = SMOOTH * x, GROWTH
    if shortest * inner > 0.25 / TWO_PI:
        inner = 0.25 / (TWO_PI * shortest)
    if alpha * beta > 0.0:  # the machine's share of the stiffness changes there
        growth = GROWTH_OF_MACHINE
        inner = min(inner, SMOOTH * (alpha / beta) ** (1.0 / (1.0 + k)) / TWO_PI)
    return inner, growth
