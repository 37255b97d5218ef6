"""Steps of an edge along the arc of its curve (s, lag), where its lag is next to 0: s = |ln a/a_0|.

    ds/dy = w,  d lag/dy = w [drive force - need],   force = drag u^(-1/n),   need = push - level rho,
    1/w = sqrt(1 + need^2) + force

has no steep term on either side of lag = 0, where s changes as lag^(1 + 1/n): the first moments of opening (drive 1),
and the last ones of closing, after the machine has turned (drive -1). Collocation as in step.py, its equations solved
by repetition.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.jit import kernel
from gradhesion.core.rate.edge import Edge, lag_of, place_at, slowness
from gradhesion.core.rate.step import INTEGRALS, NODES, ORDER, PART, STAGES, Room, kink, note, spared
from gradhesion.core.types import Floats

_REPETITIONS: Final = 40
_SAME: Final = 4.0 * 2.0**-52
_TOLERANCE: Final = 1e-15
"""Error of ln a and of the lag in a step: there are few steps."""
_LEFT: Final = 1e-13
"""Remaining ln a that is left to the leading term near lag = 0."""
_STEPS: Final = 200_000
_FAR: Final = 0.01
"""Lag at which an edge is no longer next to its start."""


class Moved(NamedTuple):
    """The state of an edge on its way: NaN where it could not be followed.

    a       its radius
    lag     of rho
    work    int 2 pi a rho^2 da so far
    turned  whether the machine has turned
    """

    a: float
    lag: float
    work: float
    turned: bool


@kernel
def failed(a: float) -> Moved:
    """Return the state of an edge that was lost at a radius."""
    return Moved(a, math.nan, math.nan, False)


@kernel
def _rates(edge: Edge, a: float, lag: float, drive: float) -> tuple[float, float, float]:
    """Return ds/dy, d lag/dy and d work/dy in a state."""
    place, rho = place_at(edge, a), edge.root + edge.sense * lag
    need, force = place.push - place.level * rho, place.drag * slowness(edge, lag)[0]
    w = 1.0 / (math.sqrt(1.0 + need * need) + force)
    return w, w * (drive * force - need), w * 2.0 * math.pi * (a * rho) ** 2


@kernel
def _arc(edge: Edge, a: float, lag: float, h: float, drive: float, nodes: Floats) -> tuple[float, float, float, float]:
    """Make a step of length h of y, with room for nodes (5, STAGES); opening goes inwards, closing outwards.

    Return s, the lag and the work at its end, and the estimated error of s and lag: inf where it is impossible.
    """
    for i in range(STAGES):
        nodes[0, i], nodes[1, i] = 0.0, lag + (h * NODES[i] if drive > 0.0 else 0.0)
    change = math.inf
    for _ in range(_REPETITIONS):
        for i in range(STAGES):
            if not nodes[1, i] > 0.0:
                return 0.0, lag, 0.0, math.inf
            radius = a * math.exp(-edge.sense * nodes[0, i])
            nodes[2, i], nodes[3, i], nodes[4, i] = _rates(edge, radius, nodes[1, i], drive)
        change = 0.0
        for i in range(STAGES):
            first, second = 0.0, lag
            for j in range(STAGES):
                first += h * INTEGRALS[i, j] * nodes[2, j]
                second += h * INTEGRALS[i, j] * nodes[3, j]
            change = max(change, abs(first - nodes[0, i]), abs(second - nodes[1, i]))
            nodes[0, i], nodes[1, i] = first, second
        if not _SAME * (nodes[0, STAGES - 1] + max(lag, nodes[1, STAGES - 1])) < change < math.inf:
            break
    end, lag_end = nodes[0, STAGES - 1], nodes[1, STAGES - 1]
    if not change <= _SAME * (end + max(lag, lag_end)) or not lag_end > 0.0:
        return 0.0, lag, 0.0, math.inf
    loss = kink(edge, nodes[1])
    work = 0.0
    for j in range(STAGES):
        work += h * INTEGRALS[STAGES - 1, j] * nodes[4, j]
    return end, lag_end, work, h * max(spared(nodes[2], loss), spared(nodes[3], loss))


@kernel
def _next_length(h: float, error: float) -> float:
    """Return the length of the next step, or of the next try."""
    return h * min(2.0, max(0.3, 0.9 * (_TOLERANCE / max(error, 1e-3 * _TOLERANCE)) ** (1.0 / ORDER)))


@kernel
def leave_rest(edge: Edge, a: float) -> Moved:
    """Let opening begin at a radius, up to half of the lag at which the edge settles or the load is least."""
    place = place_at(edge, a)
    end, trough = _FAR, 0.5 * (3.0 + edge.functions.k) - place.level
    for need in (place.push - place.level, trough):
        if need > 0.0:
            end = min(end, 0.5 * lag_of(edge, need / place.drag))
    nodes = np.empty((5, STAGES))
    lag, work, h = 0.0, 0.0, 0.1 * end
    for _ in range(_STEPS):
        s, next_lag, part, error = _arc(edge, a, lag, h, 1.0, nodes)
        if error <= _TOLERANCE:
            a, lag, work = a * math.exp(-s), next_lag, work + part
            if lag >= end:
                return Moved(a, lag, work, True)
        h = min(_next_length(h, error), end)
    return failed(a)


@kernel
def come_to_rest(edge: Edge, turn: Moved, rim: float, furthest: float, room: Room) -> Moved:
    """Follow closing from where the edge is when the machine turns to where it stops, at a lag of 0 or at the rim."""
    nodes = np.empty((5, STAGES))
    a, lag, work, h = turn.a, turn.lag, turn.work, 0.1 * turn.lag
    for _ in range(_STEPS):
        w, fall, spent = _rates(edge, a, lag, -1.0)
        left = lag * w * edge.power / (1.0 + edge.power)
        if lag * w < _LEFT and fall < -0.5 and a * math.exp(left) < rim:
            a *= math.exp(left)
            note(room.track, place_at(edge, a), a, edge.root)
            return Moved(a, 0.0, work + spent / w * left, True)
        h = min(h, PART * edge.shortest / (a * w))
        s, next_lag, part, error = _arc(edge, a, lag, h, -1.0, nodes)
        if error <= _TOLERANCE and a * math.exp(s) >= rim:
            return _to_the_rim(edge, Moved(a, lag, work, True), rim, h, room)
        if error <= _TOLERANCE:
            a, lag, work = a * math.exp(s), next_lag, work + part
            note(room.track, place_at(edge, a), a, edge.root - lag)
        h = _next_length(h, error)
        if a > furthest:
            break
    return failed(a)


@kernel
def _to_the_rim(edge: Edge, before: Moved, rim: float, h: float, room: Room) -> Moved:
    """Follow closing to the rim, which a step of length h passes: Newton's method, by the rate of s."""
    nodes, far = np.empty((5, STAGES)), math.log(rim / before.a)
    low, high = 0.0, h
    lag, part = before.lag, 0.0
    for _ in range(60):
        s, lag, part, _ = _arc(edge, before.a, before.lag, h, -1.0, nodes)
        low, high = (h, high) if s < far else (low, h)
        if abs(s - far) <= _SAME * far or not high - low > _SAME * high:
            break
        h += (far - s) / nodes[2, STAGES - 1]
        h = h if low < h < high else 0.5 * (low + high)
    note(room.track, place_at(edge, rim), rim, edge.root - lag)
    return Moved(rim, lag, before.work + part, True)
