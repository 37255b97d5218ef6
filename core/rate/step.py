"""Steps of an edge along the arc of its curve (s, lag), s = |ln y/y_0|, by Radau's collocation of order 11.

    ds/dx = w,  d lag/dx = w [drive force - need],  1/w = sqrt(1 + need^2) + force
    need = push - level rho,   force = drag u^(-1/n)

for rho = root + sense lag see edge.py. Opening goes inwards and closing outwards, with drive 1; after the machine has
turned drive is -1. Along x nothing is steep at lag = 0, where s changes as lag^(1 + 1/n). Newton's method is for s and
the lag at the nodes of a step; a lag is changed by way of its u^(-1/n) where that stays positive: slowly moving edges
have a known slowness, that of the equilibrium curve, and quickly moving ones a known lag.
"""

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.polynomial import legendre

from gradhesion.core.jit import kernel
from gradhesion.core.rate.edge import Edge, lag_of, place_at, slowness, state_of
from gradhesion.core.types import Floats

STAGES: Final = 6
_t: Final = np.append(np.sort(legendre.legroots([0.0] * (STAGES - 1) + [-1.0, 1.0]).real)[:-1], 1.0)
_to_series: Final = np.linalg.inv(legendre.legvander(_t, STAGES - 1))
NODES: Final = 0.5 + 0.5 * _t
"""Parts of a step at which its values are, the last one its end (Hairer & Wanner, Solving ODEs II, IV.5)."""
_A: Final = np.ascontiguousarray(0.5 * legendre.legval(_t, legendre.legint(np.eye(STAGES), lbnd=-1)).T @ _to_series)
"""The value at node i is that at the start and h sum_j _A[i, j] f_j; (STAGES, STAGES)."""
_SLOPES: Final = np.ascontiguousarray(np.linalg.inv(_A))
"""The other way round: from changes of the value to h f_j."""
_TAIL: Final = np.ascontiguousarray(_to_series[-2:])
"""Of values at the nodes, the last two coefficients of the Legendre series through them; (2, STAGES)."""
_TOLERANCE: Final = 1e-13
"""Error of ln y, of rho, and of the energy over that of a contact of the largest radius, in a step."""
_LOST, _KINK = 0.01, 8.0
"""Parts of the last coefficients that a step loses where the edge relaxes in it (order reduction), and at the kinks of
the law, lag = 0 and rho = 0. From experiment: without, 1e-11 and 3e-9 of the force."""
_CLOSE, _ROUNDING = 1e-7, 2.0**-50
"""A change whose square is below rounding, and rounding."""
_LONGEST, _PART = 2.0, 0.25
"""Longest step in ln y, and in parts of the shortest wave: a slow edge follows the curve, and could miss a fold."""
RADIUS, DEPTH, RHO, TROUGH = range(4)
"""What a step can be ended at: ln y; a depth; rho; a trough of the load."""
AWAY, LAG, SLOW, BY_AWAY, BY_LAG, WORK = range(6)
"""Rows of nodes: s from the start of the step; lag; u^(-1/n); ds/dx; d lag/dx; y^2 rho^2 ds/dx."""


class Room(NamedTuple):
    """Numbers of a step, and the track of an edge."""

    nodes: Floats  # (6, STAGES)
    matrix: Floats  # equations of Newton's method, (2 STAGES, 2 STAGES + 1)
    track: Floats  # radii, depths and loads, (3, .), their number in [0, 0]; (3, 0) where nobody asks


@kernel
def note(edge: Edge, y: float, lag: float, track: Floats) -> None:
    """Note where an edge is, in a track that has room for it."""
    if track.shape[1] > 0 and track[0, 0] < track.shape[1] - 1:
        track[0, 0] += 1
        number = int(track[0, 0])
        track[0, number] = y
        track[1, number], track[2, number] = state_of(place_at(edge, y), edge.root + edge.sense * lag)


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
def rates(edge: Edge, drive: float, y: float, lag: float) -> tuple[float, float]:
    """Return ds/dx and d lag/dx in a state."""
    if lag == 0.0:
        return 0.0, drive
    place = place_at(edge, y)
    need = place.push - place.level * (edge.root + edge.sense * lag)
    force = place.drag * slowness(edge, lag)[0]
    w = 1.0 / (math.sqrt(1.0 + need * need) + force)
    return w, w * (drive * force - need)


@kernel
def _set_equations(edge: Edge, drive: float, y: float, lag: float, h: float, room: Room) -> float:
    """Set the equations of a step of Newton's method for the nodes; return how much the lag relaxes in the step."""
    nodes, matrix, relaxed, n = room.nodes, room.matrix, 0.0, STAGES
    for i in range(2 * n):
        for j in range(2 * n):
            matrix[i, j] = 1.0 if i == j else 0.0
        matrix[i, 2 * n] = -nodes[AWAY, i] if i < n else lag - nodes[LAG, i - n]
    for j in range(n):
        own = nodes[LAG, j]
        place, rho = place_at(edge, y * math.exp(-edge.sense * nodes[AWAY, j])), edge.root + edge.sense * own
        nodes[SLOW, j], slope = slowness(edge, own)
        need, force = place.push - place.level * rho, place.drag * nodes[SLOW, j]
        size = math.sqrt(1.0 + need * need)
        w = 1.0 / (size + force)
        pull = drive * force - need
        for i in range(n):
            matrix[i, 2 * n] += h * _A[i, j] * w
            matrix[i + n, 2 * n] += h * _A[i, j] * w * pull
        for by_lag in range(2):  # slopes by s, and by the lag
            of_need = -edge.sense * (place.level if by_lag else place.push_slope - place.level_slope * rho)
            of_force = force * (slope if by_lag else -edge.sense * place.drag_slope)
            of_w = -w * w * (need / size * of_need + of_force)
            of_change = of_w * pull + w * (drive * of_force - of_need)
            for i in range(n):
                matrix[i, j + by_lag * n] -= h * _A[i, j] * of_w
                matrix[i + n, j + by_lag * n] -= h * _A[i, j] * of_change
            relaxed = max(relaxed, -h * of_change) if by_lag else relaxed
    return relaxed


@kernel
def advance(edge: Edge, drive: float, y: float, lag: float, h: float, room: Room) -> float:
    """Make a step of length h from the state (y, lag); `room` then has its nodes.

    Return how much the lag relaxes in the step, NaN if Newton's method did not converge.
    """
    nodes, (w, change) = room.nodes, rates(edge, drive, y, lag)
    for i in range(STAGES):
        nodes[AWAY, i], nodes[LAG, i] = w * h * NODES[i], max(lag + change * h * NODES[i], 0.5 * lag)
    for _ in range(16):
        relaxed, done = _set_equations(edge, drive, y, lag, h, room), True
        _solve(room.matrix)
        for i in range(STAGES):
            away, change, old = room.matrix[i, 2 * STAGES], room.matrix[i + STAGES, 2 * STAGES], nodes[LAG, i]
            if not abs(away) + abs(change) < math.inf:
                return math.nan
            part = slowness(edge, old)[1] * change  # of the slowness
            nodes[AWAY, i] += away
            if nodes[SLOW, i] > 0.0 and part > -0.9:
                nodes[LAG, i] = lag_of(edge, nodes[SLOW, i] * (1.0 + part))
            else:
                nodes[LAG, i] = max(old + change, 0.5 * old)
            close = max(abs(part), abs(change)) < _CLOSE or abs(change) * (1.0 + relaxed) < _ROUNDING * (1.0 + old)
            done = done and close and abs(away) <= _CLOSE * abs(nodes[AWAY, i])
        if done:
            for i in range(STAGES):  # slopes of the polynomials through the nodes
                nodes[BY_AWAY, i] = nodes[BY_LAG, i] = 0.0
                for j in range(STAGES):
                    nodes[BY_AWAY, i] += _SLOPES[i, j] * nodes[AWAY, j] / h
                    nodes[BY_LAG, i] += _SLOPES[i, j] * (nodes[LAG, j] - lag) / h
                radius, rho = y * math.exp(-edge.sense * nodes[AWAY, i]), edge.root + edge.sense * nodes[LAG, i]
                nodes[SLOW, i], nodes[WORK, i] = (
                    slowness(edge, nodes[LAG, i])[0],
                    nodes[BY_AWAY, i] * (radius * rho) ** 2,
                )
            return relaxed
    return math.nan


@kernel
def end_of_step(edge: Edge, y: float, h: float, room: Room) -> tuple[float, float, float, float]:
    """Return radius, lag and slowness at the end of a step of length h, and its work, int y rho^2 dy."""
    work = 0.0
    for j in range(STAGES):
        work += h * _A[STAGES - 1, j] * room.nodes[WORK, j]
    return y * math.exp(-edge.sense * room.nodes[AWAY, -1]), room.nodes[LAG, -1], room.nodes[SLOW, -1], work


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
def stride(edge: Edge, drive: float, y: float, lag: float, h: float, area: float, room: Room) -> tuple[float, float]:
    """Make a step as long as its error allows, h at first, from the state (y, lag); `area` is the largest y^2.

    Return its length (NaN if none is possible), and one to try after it.
    """
    nodes, longest = room.nodes, min(_LONGEST, _PART * edge.shortest / y)
    for _ in range(200):
        relaxed = advance(edge, drive, y, lag, h, room)
        away, error = nodes[AWAY, -1], math.inf
        if away <= 1.2 * longest and not math.isnan(relaxed):
            low, high = edge.root - np.max(nodes[LAG]), edge.root - np.min(nodes[LAG])
            loss = _LOST * min(1.0, (0.1 * relaxed) ** (STAGES - 1))
            loss += _KINK if lag == 0.0 or (edge.sense < 0.0 and 2.0 * low < high and high > 0.0) else 0.0
            of_lag, of_away = _spared(nodes[BY_LAG], loss) / (1.0 + nodes[LAG, -1]), _spared(nodes[BY_AWAY], loss)
            error = h * max(of_lag, of_away, _spared(nodes[WORK], 0.0) / area)
        factor = 0.9 * (_TOLERANCE / max(error, 1e-16 * _TOLERANCE)) ** (1.0 / (2 * STAGES - 1))
        if error <= _TOLERANCE:
            return h, h * min(4.0, factor, longest / away)
        h *= max(0.15, factor)
    return math.nan, 0.0


@kernel
def measure(edge: Edge, y: float, lag: float, slow: float, what: int) -> float:
    """Return a quantity of `RADIUS` to `TROUGH` in a state; that of a trough falls to 0 there as y falls.

    y dP/dy = T Delta [force - ((3+k)/2 - level) rho]
    """
    place, rho = place_at(edge, y), edge.root + edge.sense * lag
    if what == RADIUS:
        return math.log(y)
    if what == DEPTH:
        return state_of(place, rho)[0]
    if what == RHO:
        return rho
    return math.log(place.drag * slow / ((0.5 * (3.0 + edge.table.k) - place.level) * rho))


@kernel
def step_until(
    edge: Edge,
    drive: float,
    y: float,
    lag: float,
    lengths: tuple[float, float],
    values: tuple[float, float, float],
    what: int,
    room: Room,
) -> float:
    """Make the step from (y, lag) at whose end a quantity `what` meets a target; return its length, NaN if that fails.

    At two `lengths` of a step the quantity has `values` on either side of it, (low, high, target). The rule of false
    position (Illinois): each try is a step of its own.
    """
    (low, high), (first, last, target) = lengths, values
    first, last, length, side = first - target, last - target, high, 0
    for _ in range(60):
        length = (low * last - high * first) / (last - first)
        if not low < length < high:
            length = 0.5 * (low + high)
        if math.isnan(advance(edge, drive, y, lag, length, room)):
            return math.nan
        there, own, slow, _ = end_of_step(edge, y, length, room)
        value = measure(edge, there, own, slow, what) - target
        if value == 0.0 or not high - low > 2e-15 * high:
            break
        if (value < 0.0) == (first < 0.0):
            low, first, last, side = length, value, 0.5 * last if side < 0 else last, -1
        else:
            high, last, first, side = length, value, 0.5 * first if side > 0 else first, 1
    return length
