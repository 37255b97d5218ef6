"""Steps of an edge along ln a, by Radau's collocation of order 11 in the lag of rho.

    d lag/ds = level rho - push + drag u^(-1/n),   s = |ln a/a_0|

is the same for opening (a falls) and for closing while Y rises (a grows); for rho = root + sense lag see edge.py. Near
lag = 0 the last term is as steep as it can be. Newton's method is for the lags at the nodes; a lag is changed by way of
its u^(-1/n) where that stays positive: slowly moving edges have a known slowness, that of the equilibrium curve, and
quickly moving ones a known lag. What the edge meets does not depend on the lag, so that it is evaluated once a node.
"""

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.polynomial import legendre

from gradhesion.core.jit import kernel
from gradhesion.core.rate.edge import Edge, Place, depth_of, lag_of, load_of, place_at, slowness
from gradhesion.core.types import Floats

STAGES: Final = 6
ORDER: Final = 2.0 * STAGES - 1.0
_t: Final = np.append(np.sort(legendre.legroots([0.0] * (STAGES - 1) + [-1.0, 1.0]).real)[:-1], 1.0)
_to_series: Final = np.linalg.inv(legendre.legvander(_t, STAGES - 1))
NODES: Final = 0.5 + 0.5 * _t
"""Parts of a step at which its values are, the last one its end (Hairer & Wanner, Solving ODEs II, IV.5)."""
INTEGRALS: Final = np.ascontiguousarray(
    0.5 * legendre.legval(_t, legendre.legint(np.eye(STAGES), lbnd=-1)).T @ _to_series
)
"""The value at node i is that at the start and h sum_j INTEGRALS[i, j] f_j; (STAGES, STAGES)."""
TAIL: Final = np.ascontiguousarray(_to_series[-2:])
"""Of values at the nodes, the last two coefficients of the Legendre series through them; (2, STAGES)."""
_SPARED: Final = STAGES / (STAGES - 1.0)
"""With r the size of those over that of the values, the error of a step is r^_SPARED times their size, or less."""
_LOST: Final = 0.01
_STIFF: Final = 10.0
"""Where the edge relaxes within a step, collocation loses its higher order (order reduction): from about such a rate on
by this part of the last coefficients. Both from experiment: without, 1e-11 of the force."""
_KINK: Final = 8.0
"""By how much the error may exceed the last coefficients near a kink: from experiment."""
_TOLERANCE: Final = 1e-13
"""Of rho, and of the energy over that of a contact of the largest radius, in a step."""
_NEWTON: Final = 16
_CLOSE: Final = 1e-7
"""A change whose square is below rounding."""
_EPS: Final = 2.0**-52
_LONGEST: Final = 2.0
"""Of a step, in ln a."""
PART: Final = 0.25
"""Longest step in parts of the shortest wave: a slow edge follows the curve between nodes, and could miss a fold."""
_TRIALS: Final = 60
DEPTH, RHO, TROUGH = range(3)
"""What a step can be ended at: a depth; rho; a trough of the load."""


class Room(NamedTuple):
    """Numbers at the nodes of a step, and the track of an edge.

    radii, lags, slow, rates   a, lag, u^(-1/n) and d lag/ds, (STAGES,)
    places   rows of `Place`, (7, STAGES)
    steep    how much a lag changes by itself over the step, (STAGES,)
    work     2 pi a^2 rho^2, (STAGES,)
    matrix   equations of Newton's method, (STAGES, STAGES + 1)
    track    radii, depths and loads where the edge has been, (3, .), their number in [0, 0]; (3, 0) where nobody asks
    """

    radii: Floats
    lags: Floats
    slow: Floats
    rates: Floats
    places: Floats
    steep: Floats
    work: Floats
    matrix: Floats
    track: Floats


@kernel
def room_with(track: Floats) -> Room:
    """Return room for the numbers of steps, with a track."""
    rows, matrix = np.empty((13, STAGES)), np.empty((STAGES, STAGES + 1))
    return Room(rows[0], rows[1], rows[2], rows[3], rows[4:11], rows[11], rows[12], matrix, track)


@kernel
def place_in(room: Room, i: int) -> Place:
    """Return what there is at node i."""
    p = room.places
    return Place(p[0, i], p[1, i], p[2, i], p[3, i], p[4, i], p[5, i], p[6, i])


@kernel
def note(track: Floats, place: Place, a: float, rho: float) -> None:
    """Note where an edge is, in a track that has room for it."""
    if track.shape[1] > 0 and track[0, 0] < track.shape[1] - 1:
        track[0, 0] += 1
        number = int(track[0, 0])
        track[0, number], track[1, number], track[2, number] = a, depth_of(place, rho), load_of(place, rho)


@kernel
def note_nodes(edge: Edge, room: Room) -> None:
    """Note the nodes of a step that has been made."""
    for i in range(STAGES):
        note(room.track, place_in(room, i), room.radii[i], edge.root + edge.sense * room.lags[i])


@kernel
def _solve(matrix: Floats) -> bool:
    """Replace the last column by the solution of the equations in the others, (n, n + 1); False if there is none."""
    n = matrix.shape[0]
    for i in range(n):
        best = i + np.argmax(np.abs(matrix[i:, i]))
        if not abs(matrix[best, i]) > 0.0:
            return False
        for column in range(i, n + 1):
            matrix[i, column], matrix[best, column] = matrix[best, column], matrix[i, column]
        for j in range(i + 1, n):
            factor = matrix[j, i] / matrix[i, i]
            for column in range(i + 1, n + 1):
                matrix[j, column] -= factor * matrix[i, column]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            matrix[i, n] -= matrix[i, j] * matrix[j, n]
        matrix[i, n] /= matrix[i, i]
    return True


@kernel
def _set_equations(edge: Edge, lag: float, h: float, room: Room) -> float:
    """Set the equations of a step of Newton's method from the lags at the nodes; return the size of the terms."""
    size = 0.0
    for j in range(STAGES):
        place = place_in(room, j)
        value, slope = slowness(edge, room.lags[j])
        force = place.drag * value
        room.slow[j] = value
        room.rates[j] = place.level * (edge.root + edge.sense * room.lags[j]) - place.push + force
        room.steep[j] = h * (place.level * edge.sense + force * slope)
        size = max(size, h * (abs(place.push) + force))
    for i in range(STAGES):
        total = 0.0
        for j in range(STAGES):
            total += INTEGRALS[i, j] * room.rates[j]
            room.matrix[i, j] = -INTEGRALS[i, j] * room.steep[j]
        room.matrix[i, i] += 1.0
        room.matrix[i, STAGES] = lag + h * total - room.lags[i]
    return size


@kernel
def advance(edge: Edge, a: float, lag: float, h: float, room: Room) -> bool:
    """Make a step of the length |h| in ln a from the state (a, lag > 0), inwards if h < 0; `room` then has its nodes.

    Return whether Newton's method converged.
    """
    for i in range(STAGES):
        room.radii[i] = a * math.exp(h * NODES[i])
        place = place_at(edge, room.radii[i])
        for row in range(7):
            room.places[row, i] = place[row]
        room.lags[i] = lag
    for _ in range(_NEWTON):
        size = _set_equations(edge, lag, abs(h), room)
        if not _solve(room.matrix):
            return False
        done = True
        for i in range(STAGES):
            change, old = room.matrix[i, STAGES], room.lags[i]
            if not abs(change) < math.inf:
                return False
            _, slope = slowness(edge, old)
            part = slope * change  # of the slowness
            rounding = 4.0 * _EPS * (1.0 + old + size)
            if max(abs(part), abs(change)) > _CLOSE and abs(change) * (1.0 + abs(room.steep[i])) > rounding:
                done = False
            if room.slow[i] > 0.0 and part > -0.9:
                room.slow[i] *= 1.0 + part
                room.lags[i] = lag_of(edge, room.slow[i])
            else:
                room.lags[i] = max(old + change, 0.5 * old)
        if done:
            return True
    return False


@kernel
def spared(values: Floats, loss: float) -> float:
    """Return the error of an integral over a step by the last two coefficients of its values, (STAGES,).

    Where they are t and the values T it is about t (t/T)^1.2, and `loss` t more.
    """
    first = second = most = 0.0
    for j in range(STAGES):
        first, second = first + TAIL[1, j] * values[j], second + TAIL[0, j] * values[j]
        most = max(most, abs(values[j]))
    tail = max(abs(first), 0.1 * abs(second))
    return tail * ((tail / most) ** _SPARED + loss) if tail > 0.0 else 0.0


@kernel
def work_in(edge: Edge, h: float, room: Room) -> float:
    """Return int 2 pi a^2 rho^2 ds over a step of length h; `room.work` then has its integrand."""
    total = 0.0
    for j in range(STAGES):
        room.work[j] = 2.0 * math.pi * (room.radii[j] * (edge.root + edge.sense * room.lags[j])) ** 2
        total += abs(h) * INTEGRALS[STAGES - 1, j] * room.work[j]
    return total


@kernel
def kink(edge: Edge, lags: Floats) -> float:
    """Return how much of its last coefficients the error of a step has that comes near rho = 0, where the law has a kink."""
    low, high = edge.root - np.max(lags), edge.root - np.min(lags)
    return _KINK if edge.sense < 0.0 and 2.0 * low < high and high > 0.0 else 0.0


@kernel
def _error(edge: Edge, h: float, area: float, room: Room) -> float:
    """Return the estimated error of a step: of rho, or of its work over 2 pi `area`."""
    loss = _LOST * min(1.0, (max(0.0, -np.min(room.steep)) / _STIFF) ** (STAGES - 1)) + kink(edge, room.lags)
    of_rho = spared(room.rates, loss) / (1.0 + room.lags[STAGES - 1])
    return h * max(of_rho, spared(room.work, 0.0) / (2.0 * math.pi * area))


@kernel
def stride(
    edge: Edge, a: float, lag: float, h: float, end: float, area: float, room: Room
) -> tuple[float, float, float]:
    """Make a step as long as its error allows, |h| at first, from the state (a, lag) towards the radius `end`.

    Return its length (NaN if none is possible), one to try after it, and its work.
    """
    most = min(abs(math.log(end / a)), _LONGEST, PART * edge.shortest / a)
    sign = 1.0 if end > a else -1.0
    h = min(abs(h), most)
    while h > 1e-40 * most:
        error, work = math.inf, 0.0
        if advance(edge, a, lag, sign * h, room):
            work = work_in(edge, h, room)
            error = _error(edge, h, area, room)
        if error <= _TOLERANCE:
            longer = min(4.0, 0.9 * (_TOLERANCE / max(error, _EPS * _TOLERANCE)) ** (1.0 / ORDER))
            return sign * h, h * longer, work
        h *= max(0.15, 0.9 * (_TOLERANCE / error) ** (1.0 / ORDER)) if error < math.inf else 0.15
    return math.nan, 0.0, 0.0


@kernel
def measure(edge: Edge, place: Place, lag: float, slow: float, what: int) -> float:
    """Return a quantity of `DEPTH`, `RHO` and `TROUGH` in a state; that of a trough falls to 0 there as a falls.

    a dP/da = K a^(1+k) Delta [drag u^(-1/n) - need],   need = ((3+k)/2 - level) rho
    """
    rho = edge.root + edge.sense * lag
    if what == DEPTH:
        return depth_of(place, rho)
    if what == RHO:
        return rho
    return math.log(place.drag * slow / ((0.5 * (3.0 + edge.functions.k) - place.level) * rho))


@kernel
def measure_in(edge: Edge, room: Room, i: int, what: int) -> float:
    """Return the same at node i."""
    return measure(edge, place_in(room, i), room.lags[i], room.slow[i], what)


@kernel
def step_until(
    edge: Edge,
    a: float,
    lag: float,
    lengths: tuple[float, float],
    values: tuple[float, float],
    what: int,
    target: float,
    room: Room,
) -> float:
    """Make the step from (a, lag) at whose end a quantity `what` meets a target; return its length, NaN if that fails.

    At two `lengths` of a step the quantity has `values` on either side of it. The rule of false position (Illinois):
    each try is a step of its own.
    """
    low, high = lengths
    first, last = values[0] - target, values[1] - target
    length, side = high, 0
    for _ in range(_TRIALS):
        length = (low * last - high * first) / (last - first)
        if not min(low, high) < length < max(low, high):
            length = 0.5 * (low + high)
        if not advance(edge, a, lag, length, room):
            return math.nan
        value = measure_in(edge, room, STAGES - 1, what) - target
        if value == 0.0 or not abs(high - low) > 2e-15 * abs(high):
            break
        if (value < 0.0) == (first < 0.0):
            low, first, last, side = length, value, 0.5 * last if side < 0 else last, -1
        else:
            high, last, first, side = length, value, 0.5 * first if side > 0 else first, 1
    return length
