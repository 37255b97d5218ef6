"""The two ways of an edge: opening from a radius down to separation, and closing from zero contact out.

Near a = 0 opening has a constant depth, which is that of the rest of the work. Closing starts at an a where rho is next
to 0: it follows the equilibrium of Y = 0 outwards, quickly at first.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.jit import kernel
from gradhesion.core.rate.arc import Moved, failed, leave_rest
from gradhesion.core.rate.edge import Edge, Place, load_of, place_at, slowness
from gradhesion.core.rate.step import (
    DEPTH,
    NODES,
    RHO,
    STAGES,
    TROUGH,
    Room,
    measure,
    measure_in,
    note,
    note_nodes,
    place_in,
    step_until,
    stride,
    work_in,
)

_END: Final = 1e-12
"""How far inwards opening is followed, over its start: at most as much of the energy remains."""
_INNERMOST: Final = 1e-12
"""Where closing starts, over the shortest of wave, rim and the length of a smooth contact."""


class Opened(NamedTuple):
    """The results of opening; NaN where it could not be followed.

    load    the lowest
    radius  where that is
    speed   of the edge there, in v*
    work    int 2 pi a rho^2 da, of the whole way
    depth   at separation
    """

    load: float
    radius: float
    speed: float
    work: float
    depth: float


class _Node(NamedTuple):
    """The load at a place on the way inwards."""

    length: float  # of the step up to there
    a: float
    load: float
    slope: float  # -a dP/da
    turning: float  # positive while the load falls, 0 in a trough


@kernel
def _node(edge: Edge, place: Place, length: float, a: float, lag: float, slow: float) -> _Node:
    """Return the load in a state."""
    rho = 1.0 + lag
    turning = measure(edge, place, lag, slow, TROUGH)
    need = (0.5 * (3.0 + edge.functions.k) - place.level) * rho
    slope = place.front * place.adhesion * (need - place.drag * slow)
    return _Node(length, a, load_of(place, rho), slope, turning)


@kernel
def _bound(before: _Node, after: _Node) -> float:
    """Return a load above which a trough between two nodes lies, by its tangents there."""
    between = math.log(before.a / after.a)
    share = (after.load - before.load - after.slope * between) / ((before.slope - after.slope) * between)
    return before.load + before.slope * share * between


@kernel
def open_edge(edge: Edge, start: float, room: Room) -> Opened:
    """Follow an edge inwards from the radius at which it rests to separation."""
    lost = Opened(math.nan, math.nan, math.nan, math.nan, math.nan)
    note(room.track, place_at(edge, start), start, 1.0)
    moved = leave_rest(edge, start)
    if not moved.turned:
        return lost
    a, lag, work = moved.a, moved.lag, moved.work
    place, slow = place_at(edge, a), slowness(edge, lag)[0]
    before = _node(edge, place, 0.0, a, lag, slow)
    low, radius, speed, end = math.inf, start, 0.0, _END * start
    h = lag / (place.drag * slow)
    while a > end * (1.0 + 1e-9):
        whole, h, spent = stride(edge, a, lag, h, end, start * start, room)
        if math.isnan(whole):
            return lost
        note_nodes(edge, room)
        first, last, floor = before, before, low
        for i in range(STAGES):
            node = _node(edge, place_in(room, i), whole * NODES[i], room.radii[i], room.lags[i], room.slow[i])
            if before.turning > 0.0 >= node.turning:
                bound = _bound(before, node)
                if not bound >= floor:  # nor where two radii are one to rounding
                    first, last, floor = before, node, bound
            before = node
        before = _Node(0.0, before.a, before.load, before.slope, before.turning)
        place, slow, next_a, next_lag = place_in(room, STAGES - 1), room.slow[-1], room.radii[-1], room.lags[-1]
        if first.length != last.length:
            lengths, turnings = (first.length, last.length), (first.turning, last.turning)
            if math.isnan(step_until(edge, a, lag, lengths, turnings, TROUGH, 0.0, room)):
                return lost
            load = load_of(place_in(room, STAGES - 1), 1.0 + room.lags[-1])
            if load < low:
                low, radius, speed = load, room.radii[-1], 1.0 / room.slow[-1]
        a, lag, work = next_a, next_lag, work + spent
    rho, n, k = 1.0 + lag, edge.power, edge.functions.k
    coordinate = measure(edge, place, lag, slow, DEPTH) + edge.spring * load_of(place, rho)
    depth = coordinate - edge.speed * a * slow * n / (n + 1.0 - k)
    work += 2.0 * math.pi * (depth / edge.stretch) ** 2 * a ** (1.0 + k) / (1.0 + k)
    return Opened(low, radius, speed, work, depth)


@kernel
def close_edge(edge: Edge, rim: float, target: float, furthest: float, room: Room) -> Moved:
    """Follow an edge outwards from zero contact at Y = 0, to the rim or to the depth at which the machine turns."""
    size = edge.stretch ** (2.0 / (3.0 + edge.functions.k))
    a, work, h = _INNERMOST * min(rim, edge.shortest, size), 0.0, 1.0
    place = place_at(edge, a)
    tau = edge.spring * place.front
    lag = edge.root - (place.depth + edge.spring * place.load) / ((1.0 + tau) * place.adhesion)
    depth = measure(edge, place, lag, 1.0, DEPTH)
    if target <= 0.0:
        return Moved(a, lag, 0.0, True)
    while a < rim:
        length, h, spent = stride(edge, a, lag, h, min(rim, 2.0 * furthest), a * a, room)
        if math.isnan(length) or a > furthest:
            return failed(a)
        reached, rho = measure_in(edge, room, STAGES - 1, DEPTH), edge.root - room.lags[-1]
        what, aim, values = DEPTH, target, (depth, reached)
        if reached < target:  # u^(-1/n) is not smooth at rho = 0: a step ends there
            what, aim, values = RHO, 0.0, (edge.root - lag, rho)
        shorter = reached >= target or values[0] * values[1] < 0.0
        if shorter:
            whole = length
            length = step_until(edge, a, lag, (0.0, whole), values, what, aim, room)
            if math.isnan(length):
                return failed(a)
            h, spent = max(whole - length, 1e-3 * whole), work_in(edge, length, room)
        note_nodes(edge, room)
        a, work, depth = room.radii[-1], work + spent, measure_in(edge, room, STAGES - 1, DEPTH)
        lag = edge.root if shorter and what == RHO else room.lags[-1]
        if reached >= target:
            return Moved(a, lag, work, True)
        if a >= rim * (1.0 - 1e-15):
            break
    return Moved(rim, lag, work, False)
