"""Closing after the machine has turned: Y falls, and the edge goes on outwards until it has caught up, or to the rim.

    ds/dy = w,  d lag/dy = -w [need + force],  need = q_hat - q0 rho,  force = drag pace u^(-1/n),
    1/w = sqrt(1 + need^2) + force

has no steep term on the way to lag = 0, where s settles as lag^(1 + 1/n): each step leaves a part of the lag.
Collocation as in step.py, its equations solved by repetition.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.rate.bracket import TRIALS, Bracket, is_found, narrowed, place_to_try
from gradhesion.core.rate.closing import Reached
from gradhesion.core.rate.law import Law, slowness
from gradhesion.core.rate.place import place_at
from gradhesion.core.rate.radau import INTEGRALS, ORDER, STAGES, TAIL
from gradhesion.core.rate.step import note
from gradhesion.core.rate.stride import PART, spared
from gradhesion.core.types import Floats

_MOST: Final = 40
"""Repetitions."""
_SAME: Final = 4.0 * 2.0**-52
_TOLERANCE: Final = 1e-15
"""Error of ln a and of the lag in a step: there are few steps."""
_LEFT: Final = 1e-13
"""Remaining ln a that is left to the leading term near lag = 0."""
_STEPS: Final = 200_000


@kernel()
def _rates(basis: Basis, curve: Series, law: Law, x: float, lag: float) -> tuple[float, float, float]:
    """Return ds/dy, d lag/dy and d energy/dy at a place."""
    place, rho = place_at(basis, curve, x), law.root - lag
    need = place.push - place.level * rho
    slow, _ = slowness(law, lag)
    force = law.pace * place.drag * slow
    w = 1.0 / (math.sqrt(1.0 + need * need) + force)
    return w, -(need + force) * w, w * (place.z * rho) ** 2


@kernel()
def _step(
    basis: Basis, curve: Series, law: Law, x: float, state: tuple[float, float], h: float, nodes: Floats
) -> tuple[float, float, float, float]:
    """Solve a step of length h from the state (s, lag), with room for nodes, shape (5, STAGES).

    Return s, lag and energy at its end, and estimated errors of s and lag: inf where it cannot be solved.
    """
    s, lag = state
    failed = (s, lag, 0.0, math.inf)
    nodes[0], nodes[1] = s, lag
    change = math.inf
    for _ in range(_MOST):
        for i in range(STAGES):
            if not nodes[1, i] > 0.0:
                return failed
            nodes[2, i], nodes[3, i], nodes[4, i] = _rates(basis, curve, law, x * math.exp(nodes[0, i]), nodes[1, i])
        change = 0.0
        for i in range(STAGES):
            first, second = s, lag
            for j in range(STAGES):
                first += h * INTEGRALS[i, j] * nodes[2, j]
                second += h * INTEGRALS[i, j] * nodes[3, j]
            change = max(change, abs(first - nodes[0, i]), abs(second - nodes[1, i]))
            nodes[0, i], nodes[1, i] = first, second
        if not _SAME * (s + lag) < change < math.inf:
            break
    energy, error = 0.0, 0.0
    low, high = law.root - np.max(nodes[1]), law.root - np.min(nodes[1])
    near = 1.0 if 2.0 * low < high - low and high > 0.0 else 0.0  # to rho = 0, where u^(-1/n) is not smooth
    for row in (2, 3):
        first, second, most = 0.0, 0.0, 0.0
        for j in range(STAGES):
            first, second = first + TAIL[0, j] * nodes[row, j], second + TAIL[1, j] * nodes[row, j]
            most = max(most, abs(nodes[row, j]))
        error = max(error, h * spared(second, first, most, near))
    for j in range(STAGES):
        energy += h * INTEGRALS[STAGES - 1, j] * nodes[4, j]
    if not change <= _SAME * (s + lag) or not nodes[1, STAGES - 1] > 0.0:
        return failed
    return nodes[0, STAGES - 1], nodes[1, STAGES - 1], energy, error


@kernel()
def stop_edge(
    basis: Basis, curve: Series, law: Law, rim: float, shortest: float, turn: Reached, furthest: float, track: Floats
) -> Reached:
    """Follow the edge from where it is when the machine turns to where it stops, at a lag of 0 or at the rim.

    The rim, the shortest wave and the largest place are in wavelengths, inf where there is none; where the edge goes is
    stored in its track (rate/step.py).
    """
    nodes = np.empty((5, STAGES))
    x, end = turn.x, math.log(rim / turn.x)
    s, lag, energy, wrong = 0.0, turn.lag, turn.energy, turn.of_rho
    h = 0.1 * lag
    for _ in range(_STEPS):
        w, fall, spent = _rates(basis, curve, law, x * math.exp(s), lag)
        left = lag * w * law.exponent / (1.0 + law.exponent)
        if lag * w < _LEFT and fall < -0.5 and s + left < end:
            x *= math.exp(s + left)
            note(track, x, law.root)
            return Reached(x, 0.0, energy + spent / w * left, wrong, turn.of_energy, True, x)
        h = min(h, PART * shortest / (x * math.exp(s)) / w)
        s1, lag1, part, error = _step(basis, curve, law, x, (s, lag), h, nodes)
        if error > _TOLERANCE:
            h *= max(0.3, 0.9 * (_TOLERANCE / error) ** (1.0 / ORDER))
            continue
        if s1 >= end:  # a step that ends at the rim
            bracket = Bracket(0.0, h, s - end, s1 - end, 0)
            for _ in range(TRIALS):
                length = place_to_try(bracket)
                s1, lag1, part, _ = _step(basis, curve, law, x, (s, lag), length, nodes)
                if is_found(bracket, s1 - end, _SAME * end):
                    break
                bracket = narrowed(bracket, length, s1 - end)
            note(track, rim, law.root - lag1)
            return Reached(rim, lag1, energy + part, wrong, turn.of_energy, True, rim)
        note(track, x * math.exp(s1), law.root - lag1)
        s, lag, energy, wrong = s1, lag1, energy + part, wrong + error
        h *= min(2.0, 0.9 * (_TOLERANCE / max(error, 1e-3 * _TOLERANCE)) ** (1.0 / ORDER))
        if x * math.exp(s) > furthest:
            break
    return Reached(math.nan, math.nan, math.nan, math.nan, math.nan, True, x * math.exp(s))
