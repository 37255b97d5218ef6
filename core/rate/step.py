"""One step of the edge: the lag over ln a by Radau's collocation, with the slowness of the edge as unknown if stiff.

    d lag/ds = f,   f = q0 rho - q_hat + drag pace u^(-1/n),   s = |ln a/a_0|

is the same for opening (a falls) and closing (a grows). Near lag = 0 the last term is as steep as it can be. Newton's
method is for the lags at the nodes; a lag is changed by way of its u^(-1/n) where that stays positive: slowly moving
edges have a known slowness, that of the equilibrium curve, and quickly moving ones a known lag. The curve does not
depend on the lag, so that it is evaluated once a node.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.rate.law import Law, lag_of, slowness
from gradhesion.core.rate.place import Place, place_at
from gradhesion.core.rate.radau import INTEGRALS, NODES, STAGES
from gradhesion.core.types import Floats

_MOST: Final = 16
"""Newton's steps."""
_CLOSE: Final = 1e-7
"""A change whose square is below rounding."""
_MUCH: Final = 0.9
"""Largest relative drop of the slowness in one step of Newton's."""
_EPS: Final = 2.0**-52


class Start(NamedTuple):
    """Where an edge starts, and the variable y of the step: s = scale y^power."""

    x: float  # in wavelengths
    sign: float  # -1 inwards, 1 outwards
    scale: float
    power: float


class Room(NamedTuple):
    """Numbers of the nodes of a step."""

    curve: Floats  # rows of `Place`, ds/dy, and how an edge relaxes over the step; shape (10, STAGES)
    lags: Floats  # shape (STAGES,)
    slow: Floats  # u^(-1/n)
    rates: Floats  # d lag/dy
    matrix: Floats  # shape (STAGES, STAGES + 2)
    sizes: Floats  # the largest relaxation within the step, and the largest change of the lag by a term; shape (2,)
    track: Floats  # where an edge has been: places in wavelengths and rho; shape (2, points), their number in [0, 0]


@kernel()
def room_for_steps(points: int = 0) -> Room:
    """Return room for the numbers of a step, and for a track of an edge if it has points."""
    track = np.zeros((2, points))
    rows, matrix = np.empty((10, STAGES)), np.empty((STAGES, STAGES + 2))
    return Room(rows, np.empty(STAGES), np.empty(STAGES), np.empty(STAGES), matrix, np.empty(2), track)


@kernel()
def note(track: Floats, x: float, rho: float) -> None:
    """Note that an edge is at x wavelengths, in a track that has room for it."""
    if track.shape[1] > 0:
        number = int(track[0, 0]) + 1
        if number < track.shape[1]:
            track[0, number], track[1, number], track[0, 0] = x, rho, number


@kernel()
def note_nodes(law: Law, room: Room) -> None:
    """Note the nodes of a step that has been made."""
    if room.track.shape[1] > 0:
        for i in range(STAGES):
            note(room.track, room.curve[0, i] / TWO_PI, law.root + law.sense * room.lags[i])


@kernel()
def way(start: Start, y: float) -> tuple[float, float]:
    """Return s and ds/dy."""
    if start.power == 1.0:
        return start.scale * y, start.scale
    s = start.scale * y**start.power
    return s, start.power * s / y if y > 0.0 else 0.0


@kernel()
def place_in(room: Room, i: int) -> Place:
    """Return the curve at node i."""
    c = room.curve
    return Place(c[0, i], c[1, i], c[2, i], c[3, i], c[4, i], c[5, i], c[6, i], c[7, i])


@kernel()
def _set_curve(basis: Basis, curve: Series, start: Start, y: float, h: float, room: Room) -> None:
    """Evaluate the curve at the nodes."""
    for i in range(STAGES):
        s, rate = way(start, y + h * NODES[i])
        place = place_at(basis, curve, start.x * math.exp(start.sign * s))
        for j in range(8):
            room.curve[j, i] = place[j]
        room.curve[8, i] = rate


@kernel()
def _solve(matrix: Floats) -> bool:
    """Replace the last two columns by the solutions of the equations in the others; shape (n, n + 2)."""
    n = matrix.shape[0]
    for i in range(n):
        best = i
        for j in range(i + 1, n):
            if abs(matrix[j, i]) > abs(matrix[best, i]):
                best = j
        if not abs(matrix[best, i]) > 0.0:
            return False
        if best != i:
            for j in range(i, n + 2):
                matrix[i, j], matrix[best, j] = matrix[best, j], matrix[i, j]
        inverse = 1.0 / matrix[i, i]
        for j in range(i + 1, n):
            factor = matrix[j, i] * inverse
            for column in range(i + 1, n + 2):
                matrix[j, column] -= factor * matrix[i, column]
    for i in range(n - 1, -1, -1):
        first, second = matrix[i, n], matrix[i, n + 1]
        for j in range(i + 1, n):
            first -= matrix[i, j] * matrix[j, n]
            second -= matrix[i, j] * matrix[j, n + 1]
        matrix[i, n], matrix[i, n + 1] = first / matrix[i, i], second / matrix[i, i]
    return True


@kernel()
def _set_equations(law: Law, lag: float, h: float, room: Room) -> None:
    """Set the equations of a step of Newton's method from the lags at the nodes, and of how a change of lag grows."""
    c, lags, slow, rates, matrix, sizes, _ = room
    sizes[:] = 0.0
    for j in range(STAGES):
        force = law.pace * c[7, j]
        value, slope = slowness(law, lags[j])
        rates[j] = c[8, j] * (c[6, j] * (law.root + law.sense * lags[j]) - c[5, j] + force * value)
        slow[j] = value
        steep = h * c[8, j] * (c[6, j] * law.sense + force * slope * value)
        c[9, j] = steep
        sizes[0] = max(sizes[0], -steep)
        sizes[1] = max(sizes[1], h * c[8, j] * (abs(c[5, j]) + force * value))
        for i in range(STAGES):
            matrix[i, j] = -INTEGRALS[i, j] * steep
        matrix[j, STAGES + 1] = 1.0
    for i in range(STAGES):
        total = 0.0
        for j in range(STAGES):
            total += INTEGRALS[i, j] * rates[j]
        matrix[i, STAGES] = lag + h * total - lags[i]
        matrix[i, i] += 1.0


@kernel()
def advance(
    basis: Basis, curve: Series, law: Law, start: Start, state: tuple[float, float], h: float, room: Room
) -> bool:
    """Solve a step of length h from the state (y, lag); `room` then has the values at the nodes.

    Return whether Newton's method converged.
    """
    y, lag = state
    _set_curve(basis, curve, start, y, h, room)
    c, lags, slow, _, matrix, sizes, _ = room
    if lag > 0.0:
        lags[:] = lag
    else:
        _guess_first(law, start, y, h, room)
    for _ in range(_MOST):
        _set_equations(law, lag, h, room)
        if not _solve(matrix):
            return False
        done = True
        for i in range(STAGES):
            change = matrix[i, STAGES]
            if not abs(change) < math.inf:
                return False
            _, slope = slowness(law, lags[i])
            part = slope * change  # of the slowness
            rounding = 4.0 * _EPS * (1.0 + lags[i] + sizes[1])
            if max(abs(part), abs(change)) > _CLOSE and abs(change) * (1.0 + abs(c[9, i])) > rounding:
                done = False
            if slow[i] > 0.0 and part > -_MUCH:
                slow[i] *= 1.0 + part
                lags[i] = lag_of(law, slow[i])
            else:
                lags[i] = max(lags[i] + change, 0.5 * lags[i])
        if done:
            return True
    return False


@kernel()
def _guess_first(law: Law, start: Start, y: float, h: float, room: Room) -> None:
    """Guess the lags of a step from lag = 0, by their leading term."""
    n = law.exponent
    for i in range(STAGES):
        s, _ = way(start, y + h * NODES[i])
        room.lags[i] = ((1.0 + n) / n * law.pace * room.curve[7, i] * 2.0 ** (-1.0 / n) * s) ** (n / (1.0 + n))
