"""Steps of an edge, by Radau's collocation of order 11 for its lag over the radius.

    d lag/ds = drive force - need,   s = |ln y/y_0|,   need = push - level rho,   force = drag u^(-1/n)

for rho = root + sense lag see edge.py. Opening goes inwards and closing outwards, with drive 1; after the machine has
turned drive is -1. Where an edge starts at lag = 0, the lag goes as s^(n/(1+n)): steps are along x, s = pace x^grade,
over which nothing is steep there. Radii are known beforehand, so that Newton's method is for the lag at the nodes of a
step alone. It is changed by way of its u^(-1/n) where that stays positive: slowly moving edges have a known slowness,
that of the equilibrium curve, and quickly moving ones a known lag.
"""

import math
from typing import Final, NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import legendre

from gradhesion.core.jit import kernel
from gradhesion.core.rate.edge import Edge, goal, lag_of, place_at, pulls_at, slowness
from gradhesion.core.types import Floats

Pair: TypeAlias = tuple[float, float]
STAGES: Final = 6
_t: Final = np.append(np.sort(legendre.legroots([0.0] * (STAGES - 1) + [-1.0, 1.0]).real)[:-1], 1.0)
_to_series: Final = np.linalg.inv(legendre.legvander(_t, STAGES - 1))
_integral: Final = 0.5 * legendre.legval(_t, legendre.legint(np.eye(STAGES), lbnd=-1)).T @ _to_series
NODES: Final = 0.5 + 0.5 * _t
"""Parts of a step at which its values are, the last one its end (Hairer & Wanner, Solving ODEs II, IV.5)."""
_WEIGHTS: Final = np.ascontiguousarray(_integral[-1])  # the integral over a step of length h is h sum_j _WEIGHTS[j] f_j
_SLOPES: Final = np.linalg.inv(_integral)
"""Slopes at the nodes of the polynomial through them and 0 at the start are sum_j _SLOPES[i, j] f_j/h."""
_TAIL: Final = np.ascontiguousarray(_to_series[-2:])
"""Of values at the nodes, the last two coefficients of the Legendre series through them; (2, STAGES)."""
_TOLERANCE: Final = 1e-13  # error of rho, and of the energy over that of a contact of the largest radius, in a step
_LOST, _KINK = 0.01, 8.0
"""Parts of the last coefficients that a step loses where the edge relaxes in it (order reduction), and at the kinks of
the law, lag = 0 and rho = 0. From experiment: without, 1e-11 and 3e-9 of the force."""
_CLOSE, _ROUNDING = 1e-7, 2.0**-50  # a change whose square is below rounding, and rounding
_LONGEST, _PART = 2.0, 0.25
"""Longest step in ln y, and in parts of the shortest wave: a slow edge follows the curve, and could miss a fold."""
RADIUS, PACE, PUSH, LEVEL, DRAG, LAG, SLOW, BY_LAG, WORK = range(9)
"""Rows of nodes: y; ds/dx; push, level and drag there; lag; u^(-1/n); d lag/dx; y^2 rho^2 ds/dx."""


class Room(NamedTuple):
    """Numbers of a step, and the track of an edge."""

    nodes: Floats  # (9, STAGES)
    matrix: Floats  # equations of Newton's method, (STAGES, STAGES + 1)
    track: Floats  # radii, depths and loads, (3, .), their number in [0, 0]; (3, 0) where nobody asks


class Step(NamedTuple):
    """A step that was made, and where it ends."""

    length: float  # NaN where Newton's method did not converge
    y: float
    lag: float
    slow: float  # u^(-1/n)
    work: float  # int y rho^2 dy
    relaxed: float  # how much the lag relaxes in it


class Way(NamedTuple):
    """How an edge is followed: s = pace x^grade away from where it starts."""

    start: float  # y there
    pace: float
    grade: float
    drive: float  # 1, or -1 where the machine has turned


@kernel
def _along(edge: Edge, way: Way, x: float) -> tuple[float, float]:
    """Return y, and ds/dx."""
    away = way.pace * x**way.grade
    return way.start * math.exp(-edge.sense * away), way.grade * (away / x if x > 0.0 else 1.0)


@kernel
def _solve(matrix: Floats) -> None:
    """Replace the last column by the solution of the equations in the others, (n, n + 1)."""
    n = matrix.shape[0]
    for i in range(n):
        for j in range(i + 1, n):
            factor = matrix[j, i] / matrix[i, i]
            for column in range(i + 1, n + 1):
                matrix[j, column] -= factor * matrix[i, column]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            matrix[i, n] -= matrix[i, j] * matrix[j, n]
        matrix[i, n] /= matrix[i, i]


@kernel
def _set_equations(edge: Edge, drive: float, lag: float, h: float, room: Room) -> float:
    """Set the equations of a step of Newton's method for the lags; return how much the lag relaxes in the step."""
    nodes, matrix, relaxed = room.nodes, room.matrix, 0.0
    for i in range(STAGES):
        change = 0.0
        for j in range(STAGES):
            matrix[i, j] = _SLOPES[i, j] / h
            change += matrix[i, j] * (nodes[LAG, j] - lag)
        (slow, by_lag), pace = slowness(edge, nodes[LAG, i]), nodes[PACE, i]
        rho = edge.root + edge.sense * nodes[LAG, i]
        force, need = nodes[DRAG, i] * slow, nodes[PUSH, i] - nodes[LEVEL, i] * rho
        slope = pace * (drive * force * by_lag + edge.sense * nodes[LEVEL, i])
        matrix[i, i] -= slope
        matrix[i, STAGES] = pace * (drive * force - need) - change
        nodes[SLOW, i], nodes[BY_LAG, i], nodes[WORK, i] = slow, change, pace * (nodes[RADIUS, i] * rho) ** 2
        relaxed = max(relaxed, -h * slope)
    return relaxed


@kernel
def advance(edge: Edge, way: Way, x: float, lag: float, h: float, room: Room) -> Step:
    """Make a step of length h from the state (x, lag); `room` then has its nodes."""
    nodes, change, done, relaxed, length = room.nodes, way.drive, False, 0.0, math.nan
    if lag > 0.0:
        y, pace = _along(edge, way, x)
        need, force = pulls_at(edge, y, lag)
        change = pace * (way.drive * force - need)
    for i in range(STAGES):
        nodes[RADIUS, i], nodes[PACE, i] = _along(edge, way, x + h * NODES[i])
        place = place_at(edge, nodes[RADIUS, i])
        nodes[PUSH, i], nodes[LEVEL, i], nodes[DRAG, i] = place.push, place.level, place.drag
        nodes[LAG, i] = max(lag + change * h * NODES[i], 0.5 * lag)
    for _ in range(17):
        relaxed = _set_equations(edge, way.drive, lag, h, room)
        if done:
            length = h
            break
        _solve(room.matrix)
        done = True
        for i in range(STAGES):
            change, old = room.matrix[i, STAGES], nodes[LAG, i]
            part = slowness(edge, old)[1] * change  # of the slowness
            if nodes[SLOW, i] > 0.0 and part > -0.9:
                nodes[LAG, i] = lag_of(edge, nodes[SLOW, i] * (1.0 + part))
            else:
                nodes[LAG, i] = max(old + change, 0.5 * old)
            settled = abs(change) * (1.0 + relaxed) < _ROUNDING * (1.0 + old)
            done = done and (settled or max(abs(part), abs(change)) < _CLOSE)
    work = 0.0
    for j in range(STAGES):
        work += h * _WEIGHTS[j] * nodes[WORK, j]
    return Step(length, nodes[RADIUS, -1], nodes[LAG, -1], nodes[SLOW, -1], work, relaxed)


@kernel
def _spared(values: Floats, loss: float) -> float:
    """Return the error of an integral over a step by the last two coefficients of its values, (STAGES,).

    Where they are t and the values T it is about t (t/T)^1.2, and `loss` t more.
    """
    first = second = most = 0.0
    for j in range(STAGES):
        first, second = first + _TAIL[1, j] * values[j], second + _TAIL[0, j] * values[j]
        most = max(most, abs(values[j]))
    tail = max(abs(first), 0.1 * abs(second))
    return tail * ((tail / most) ** (STAGES / (STAGES - 1.0)) + loss) if tail > 0.0 else 0.0


@kernel
def stride(edge: Edge, way: Way, x: float, lag: float, h: float, area: float, room: Room) -> tuple[Step, float]:
    """Make a step as long as its error allows, at most h, from the state (x, lag); `area` is the largest y^2.

    Return it (its length is NaN if none is possible), and a length to try after it.
    """
    nodes, longest = room.nodes, min(_LONGEST, _PART * edge.shortest / _along(edge, way, x)[0])
    h = min(h, (x**way.grade + longest / way.pace) ** (1.0 / way.grade) - x)
    step = advance(edge, way, x, lag, h, room)
    for _ in range(200):
        error = math.inf
        if not math.isnan(step.length):
            low, high = edge.root - np.max(nodes[LAG]), edge.root - np.min(nodes[LAG])
            loss = _LOST * min(1.0, (0.1 * step.relaxed) ** (STAGES - 1))
            loss += _KINK if lag == 0.0 or (edge.sense < 0.0 and 2.0 * low < high and high > 0.0) else 0.0
            error = h * max(_spared(nodes[BY_LAG], loss) / (1.0 + step.lag), _spared(nodes[WORK], 0.0) / area)
        factor = 0.9 * (_TOLERANCE / max(error, 1e-16 * _TOLERANCE)) ** (1.0 / (2 * STAGES - 1))
        if error <= _TOLERANCE:
            return step, h * min(4.0, factor)
        h *= max(0.15, factor)
        step = advance(edge, way, x, lag, h, room)
    return Step(math.nan, math.nan, math.nan, math.nan, math.nan, math.nan), 0.0


@kernel
def step_until(edge: Edge, way: Way, x: float, lag: float, ends: Pair, values: Pair, target: float, room: Room) -> Step:
    """Make the step from (x, lag) whose end is the goal; its length is NaN if that fails.

    Steps of two lengths `ends` reach `values` on either side of it. The rule of false position (Illinois).
    """
    (old, length), (first, last) = ends, values
    for _ in range(60):
        new = length - last * (length - old) / (last - first)
        step = advance(edge, way, x, lag, new, room)
        value = goal(edge, step.y, step.lag, step.slow, target)
        if value * last > 0.0:
            first *= 0.5
        else:
            old, first = length, last
        length, last = new, value
        if value == 0.0 or not abs(length - old) > 2e-15 * abs(length):
            break
    return step
