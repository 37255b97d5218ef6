"""The two ways of an edge: opening from a radius down to separation, and closing from zero contact until it rests.

Both put their results into a column, in the units of tables, and NaN where the edge could not be followed.
"""

import math
from typing import Final

from gradhesion.core.jit import kernel
from gradhesion.core.rate import step as steps
from gradhesion.core.rate.edge import Edge, lag_of, place_at, state_of
from gradhesion.core.rate.step import Room, Way, end_of_step, goal, load_at, note, pulls_at, step_until, stride
from gradhesion.core.types import Floats

_ENDS: Final = 1e-12
"""How far inwards opening is followed, over its start: at most as much of the energy remains. And where closing starts,
over the shortest of wave, rim and the length of a smooth contact."""
_LEFT: Final = 1e-13
"""Remaining ln y that is left to the leading term where closing comes to rest."""


@kernel
def open_edge(edge: Edge, start: float, room: Room, out: Floats) -> None:
    """Follow an edge inwards from the radius at which it rests to separation.

    Results: the lowest load; where that is; the speed there in v*; int y rho^2 dy of the whole way; the depth at
    separation. Near y = 0 the depth is constant, which gives the rest of the work. Along x the lag starts as x.
    """
    place, nodes, k, n = place_at(edge, start), room.nodes, edge.curve.table.k, edge.power
    way = Way(start, 2.0 ** (1.0 / n) / ((1.0 + 1.0 / n) * place.drag), 1.0 + 1.0 / n, 1.0)
    h = 0.1 * min(0.1, lag_of(edge, (1.0 + abs(place.push - place.level)) / place.drag))
    x, y, lag, slow, work, low, before = 0.0, start, 0.0, math.inf, 0.0, math.inf, 1.0
    note(edge, y, lag, room.track)
    while y > _ENDS * start:
        length, h = stride(edge, way, x, lag, h, start * start, room)
        if math.isnan(length):
            return
        floor, ends, values, begin = low, (0.0, 0.0), (before, before), 0.0
        for i in range(steps.STAGES):
            radius, own, slow = nodes[steps.RADIUS, i], nodes[steps.LAG, i], nodes[steps.SLOW, i]
            note(edge, radius, own, room.track)
            (load, slope, falls), end = load_at(edge, radius, own, slow), length * steps.NODES[i]
            bound = load + slope * math.log(y / radius)  # a trough between is above, by the tangent
            if before > 0.0 >= falls and bound < floor:
                floor, ends, values = bound, (begin, end), (before, falls)
            before, begin, y = falls, end, radius
        _, next_lag, slow, part = end_of_step(length, room)
        if floor < low:
            step_until(edge, way, x, lag, ends, values, 0.0, room)
            radius, own, slow_there, _ = end_of_step(length, room)
            load = load_at(edge, radius, own, slow_there)[0]
            if load < low:
                low = out[0] = load
                out[1], out[2] = radius, 1.0 / slow_there
        x, lag, work = x + length, next_lag, work + part
    depth, load = state_of(place_at(edge, y), 1.0 + lag)
    depth += edge.curve.by_load * load - edge.speed * y * slow * n / (n + 1.0 - k)
    out[3], out[4] = work + depth * depth * y ** (1.0 + k) / (1.0 + k), depth


@kernel
def close_edge(edge: Edge, rim: float, target: float, furthest: float, room: Room, out: Floats) -> float:
    """Follow an edge outwards from zero contact at Y = 0 until it rests; return how far it was followed.

    That is at the rim, where the machine turns as well if it has not, or where G = w_c after the machine has turned at
    the depth `target`. A contact starts where rho is next to 0: it follows the equilibrium of Y = 0, quickly at first.
    Results: the radius at which the edge rests; the depth when the machine turned; int y rho^2 dy of the whole way; how
    far the far end of the spring will move from there before the edge opens.
    """
    size = edge.curve.B ** (-1.0 / (edge.curve.table.exponent - 0.5 * (1.0 - edge.curve.table.k)))
    y, x, h, work, depth, rests = _ENDS * min(rim, edge.shortest, size), 0.0, 1.0, 0.0, 0.0, False
    way, last, place = Way(y, 1.0, 1.0, 1.0 if target > 0.0 else -1.0), math.log(rim / y), place_at(edge, y)
    lag = edge.root - (place.depth + edge.curve.by_load * place.load) / (
        (1.0 + edge.curve.by_load * place.front) * place.adhesion
    )
    while not rests:
        need, force = pulls_at(edge, y, lag)
        left = lag / (need + force * (1.0 + 1.0 / edge.power))  # to lag = 0, by the leading term
        if way.drive < 0.0 < left < min(_LEFT, last - x):
            y, lag, work, rests = y * (1.0 + left), 0.0, work + (y * edge.root) ** 2 * left, True
            note(edge, y, lag, room.track)
            continue
        length, h = stride(edge, way, x, lag, min(h, last - x), y * y, room)
        rests, (next_y, next_lag, slow, part) = length == last - x, end_of_step(length, room)
        over = goal(edge, next_y, next_lag, slow, target)
        turns = way.drive > 0.0 and over >= 0.0
        if turns:
            length = step_until(edge, way, x, lag, (0.0, length), (depth - target, over), target, room)
            rests, (next_y, next_lag, slow, part) = False, end_of_step(length, room)
        if math.isnan(length) or next_y > furthest:
            return float(next_y)
        for i in range(steps.STAGES):
            note(edge, room.nodes[steps.RADIUS, i], room.nodes[steps.LAG, i], room.track)
        x, y, lag, work = x + length, rim if rests else next_y, next_lag, work + part
        if way.drive > 0.0:
            depth = state_of(place_at(edge, y), edge.root - lag)[0]
        if turns:
            way, h = Way(way.start, 1.0, 1.0, -1.0), 0.1 * lag
    place = place_at(edge, y)
    out[0], out[1], out[2] = y, depth, work
    out[3] = (1.0 - edge.root + lag) * place.adhesion * (1.0 + edge.curve.by_load * place.front)
    return float(y)
