"""The two ways of an edge: opening from a radius down to separation, and closing from zero contact until it rests."""

import math
from typing import Final, NamedTuple

from gradhesion.core.jit import kernel
from gradhesion.core.rate.edge import Edge, lag_of, place_at, slowness, state_of
from gradhesion.core.rate.step import (
    AWAY,
    DEPTH,
    LAG,
    NODES,
    RADIUS,
    RHO,
    SLOW,
    STAGES,
    TROUGH,
    Room,
    end_of_step,
    measure,
    note,
    step_until,
    stride,
    work_in,
)

_END: Final = 1e-12
"""How far inwards opening is followed, over its start: at most as much of the energy remains."""
_INNERMOST: Final = 1e-12
"""Where closing starts, over the shortest of wave, rim and the length of a smooth contact."""
_LEFT: Final = 1e-13
"""Remaining ln y that is left to the leading term where closing comes to rest."""


class Opened(NamedTuple):
    """The results of opening; NaN where it could not be followed."""

    load: float  # the lowest
    radius: float  # where that is
    speed: float  # of the edge there, in v*
    work: float  # int y rho^2 dy of the whole way
    depth: float  # at separation


class Closed(NamedTuple):
    """The results of closing; NaN where it could not be followed."""

    radius: float  # where the edge rests
    lag: float  # there
    work: float  # int y rho^2 dy of the whole way
    depth: float  # when the machine turns, or the rim is met


class _Node(NamedTuple):
    """The load at a place on the way inwards."""

    length: float  # of the step up to there
    away: float  # s
    load: float
    slope: float  # d load/ds
    turning: float  # positive while the load falls, 0 in a trough


@kernel
def _node(edge: Edge, y: float, length: float, away: float, lag: float, slow: float) -> _Node:
    """Return the load in a state, at a distance `away` from y."""
    place = place_at(edge, y * math.exp(-away))
    need, force = (0.5 * (3.0 + edge.table.k) - place.level) * (1.0 + lag), place.drag * slow
    load = state_of(place, 1.0 + lag)[1]
    return _Node(length, away, load, place.front * place.adhesion * (need - force), math.log(force / need))


@kernel
def _bound(before: _Node, after: _Node) -> float:
    """Return a load above which a trough between two nodes lies, by its tangents there."""
    between = after.away - before.away
    share = (after.load - before.load - after.slope * between) / ((before.slope - after.slope) * between)
    return before.load + before.slope * share * between


@kernel
def open_edge(edge: Edge, start: float, room: Room) -> Opened:
    """Follow an edge inwards from the radius at which it rests to separation.

    Near y = 0 the depth is constant, which gives the rest of the work.
    """
    place = place_at(edge, start)
    h = 0.1 * min(0.1, lag_of(edge, (1.0 + abs(place.push - place.level)) / place.drag))
    y, lag, slow, work = start, 0.0, math.inf, 0.0
    low, radius, speed = math.inf, start, 0.0
    before = _Node(0.0, 0.0, state_of(place, 1.0)[1], -math.inf, math.inf)
    note(edge, y, lag, room.track)
    while y > _END * start:
        length, h = stride(edge, 1.0, y, lag, h, start * start, room)
        if math.isnan(length):
            return Opened(math.nan, math.nan, math.nan, math.nan, math.nan)
        first, last, floor = before, before, low
        for i in range(STAGES):
            nodes = room.nodes
            node = _node(edge, y, length * NODES[i], nodes[AWAY, i], nodes[LAG, i], nodes[SLOW, i])
            note(edge, y * math.exp(-nodes[AWAY, i]), nodes[LAG, i], room.track)
            if before.turning > 0.0 >= node.turning:
                bound = _bound(before, node)
                if not bound >= floor:  # nor where two radii are one to rounding
                    first, last, floor = before, node, bound
            before = node
        before = _Node(0.0, 0.0, before.load, before.slope, before.turning)
        next_a, next_lag, slow = end_of_step(edge, y, room)
        work += work_in(length, room)
        if last.length > first.length:
            ends, turnings = (first.length, last.length), (first.turning, last.turning)
            step_until(edge, 1.0, y, lag, ends, turnings, TROUGH, 0.0, room)
            where, own, slow_there = end_of_step(edge, y, room)
            load = state_of(place_at(edge, where), 1.0 + own)[1]
            if not load >= low:
                low, radius, speed = load, where, 1.0 / slow_there
        y, lag = next_a, next_lag
    n, k = edge.power, edge.table.k
    depth, load = state_of(place_at(edge, y), 1.0 + lag)
    depth += edge.by_load * load - edge.speed * y * slow * n / (n + 1.0 - k)
    work += depth * depth * y ** (1.0 + k) / (1.0 + k)
    return Opened(low, radius, speed, work, depth)


@kernel
def close_edge(edge: Edge, rim: float, target: float, furthest: float, room: Room) -> Closed:
    """Follow an edge outwards from zero contact at Y = 0 until it rests.

    That is at the rim, where the machine turns as well if it has not, or where G = w_c after the machine has turned at
    the depth `target`. A contact starts where rho is next to 0: it follows the equilibrium of Y = 0, quickly at first.
    """
    y = _INNERMOST * min(rim, edge.shortest, edge.B ** (-1.0 / (edge.table.exponent - 0.5 * (1.0 - edge.table.k))))
    place = place_at(edge, y)
    lag = edge.root - (place.depth + edge.by_load * place.load) / ((1.0 + edge.by_load * place.front) * place.adhesion)
    depth, work, h = 0.0, 0.0, 1.0
    drive = 1.0 if target > 0.0 else -1.0
    while y <= furthest:
        place, slow = place_at(edge, y), slowness(edge, lag)[0]
        need, force = place.push - place.level * (edge.root - lag), place.drag * slow
        left = lag / (need + force) * edge.power / (1.0 + edge.power)  # to lag = 0, by the leading term
        if drive < 0.0 and 0.0 < left < _LEFT and force > need and y * (1.0 + left) < rim:
            note(edge, y * (1.0 + left), 0.0, room.track)
            return Closed(y * (1.0 + left), 0.0, work + (y * edge.root) ** 2 * left, depth)
        length, h = stride(edge, drive, y, lag, h, y * y, room)
        next_a, next_lag, slow = end_of_step(edge, y, room)
        reached = measure(edge, next_a, next_lag, slow, DEPTH)
        what, aim, values = RHO, 0.0, (edge.root - lag, edge.root - next_lag)  # a step ends at the kink of u^(-1/n)
        if next_a >= rim:
            what, aim, values = RADIUS, math.log(rim), (math.log(y), math.log(next_a))
        if drive > 0.0 and reached >= target:
            what, aim, values = DEPTH, target, (depth, reached)
        if what != RHO or values[0] * values[1] < 0.0:
            whole = length
            length = step_until(edge, drive, y, lag, (0.0, whole), values, what, aim, room)
            h = max(whole - length, 1e-3 * whole)
            next_a, next_lag, slow = end_of_step(edge, y, room)
            next_lag = edge.root if what == RHO else next_lag
        if math.isnan(length):
            break
        for i in range(STAGES):
            note(edge, y * math.exp(room.nodes[AWAY, i]), room.nodes[LAG, i], room.track)
        y, lag, work = next_a, next_lag, work + work_in(length, room)
        depth = measure(edge, y, lag, slow, DEPTH) if drive > 0.0 else depth
        if what == RADIUS:
            return Closed(rim, lag, work, depth)
        if what == DEPTH:
            drive, h = -1.0, min(h, 0.1 * lag)
    return Closed(y, math.nan, math.nan, math.nan)
