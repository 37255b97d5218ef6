"""A moving edge: what it meets at a radius, the law of its speed, and its steps.

With rho = (delta_H - delta)/Delta the state at a radius is any rho; in equilibrium it is 1 (opening) or sqrt(Gamma)
(closing), and the edge lags behind that:

    opening  rho = 1 + lag             u = rho^2 - 1
    closing  rho = sqrt(Gamma) - lag   u = Gamma/rho^2 - 1
    depth = depth_H - Delta rho,   load = load_H - T Delta rho,   Y = depth + by_load load
    d lag/ds = drive force - need,   s = |ln y/y_0|,   need = push - level rho,   force = drag u^(-1/n)
    push = y depth_H'/Delta,   drag = eps y/((1+tau) Delta),   tau = by_load T,   T = y^(1+k)

v = v* u^(1/n) is the speed of the edge. Its slowness u^(-1/n) falls from infinity at lag = 0; where closing meets
rho <= 0 it is 0: the edge follows at once. Units are those of tables (table/layout.py), radii y = 2 pi a/lambda.

Steps are by Radau's collocation of order 11 for the lag over the radius. Opening goes inwards and closing outwards,
with drive 1; after the machine has turned drive is -1. Where an edge starts at lag = 0, the lag goes as s^(n/(1+n)):
steps are along x, s = pace x^grade, over which nothing is steep there. Radii are known beforehand, so that Newton's
method is for the lag at the nodes of a step alone. It is changed by way of its u^(-1/n) where that stays positive:
slowly moving edges have a known slowness, that of the equilibrium curve, and quickly moving ones a known lag.
"""

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.polynomial import legendre

from gradhesion.core.curve.values import Curve, place_of
from gradhesion.core.jit import kernel
from gradhesion.core.table.layout import HALF, PU, PU1, N, Y
from gradhesion.core.types import Floats

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
    for _ in range(200):
        step, error = advance(edge, way, x, lag, h, room), math.inf
        if not math.isnan(step.length):
            low, high = math.inf, -math.inf
            for i in range(STAGES):
                low, high = min(low, edge.root - nodes[LAG, i]), max(high, edge.root - nodes[LAG, i])
            loss = _LOST * min(1.0, (0.1 * step.relaxed) ** (STAGES - 1))
            loss += _KINK if lag == 0.0 or (edge.sense < 0.0 and 2.0 * low < high and high > 0.0) else 0.0
            error = h * max(_spared(nodes[BY_LAG], loss) / (1.0 + step.lag), _spared(nodes[WORK], 0.0) / area)
        factor = 0.9 * (_TOLERANCE / max(error, 1e-16 * _TOLERANCE)) ** (1.0 / (2 * STAGES - 1))
        if error <= _TOLERANCE:
            return step, h * min(4.0, factor)
        h *= max(0.15, factor)
    return Step(math.nan, math.nan, math.nan, math.nan, math.nan, math.nan), 0.0
