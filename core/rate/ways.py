"""The two ways of an edge: opening from a radius down to separation, and closing from zero contact until it rests.

Both put their results into a column, in the units of tables, and NaN where the edge could not be followed.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.jit import kernel
from gradhesion.core.rate import step as steps
from gradhesion.core.rate.edge import Edge, lag_of, place_at, state_of
from gradhesion.core.rate.step import AWAY, LAG, SLOW, TROUGH, Room, end_of_step, measure, note, step_until, stride
from gradhesion.core.types import Floats

_ENDS: Final = 1e-12
"""How far inwards opening is followed, over its start: at most as much of the energy remains. And where closing starts,
over the shortest of wave, rim and the length of a smooth contact."""
_LEFT: Final = 1e-13
"""Remaining ln y that is left to the leading term where closing comes to rest."""


class _Point(NamedTuple):
    """The load on the way inwards, at a node of a step."""

    length: float  # of the step up to there
    away: float  # s
    load: float
    slope: float  # d load/ds
    turning: float  # positive while the load falls, 0 in a trough


@kernel
def _point_at(edge: Edge, y: float, length: float, away: float, lag: float, slow: float) -> _Point:
    """Return the load in a state, at a distance `away` from y."""
    place = place_at(edge, y * math.exp(-away))
    need, force = (0.5 * (3.0 + edge.table.k) - place.level) * (1.0 + lag), place.drag * slow
    slope = place.front * place.adhesion * (need - force)
    return _Point(length, away, state_of(place, 1.0 + lag)[1], slope, math.log(force / need))


@kernel
def _bound(first: _Point, last: _Point) -> float:
    """Return a load above which a trough between two points lies, by its tangents there."""
    between = last.away - first.away
    share = (last.load - first.load - last.slope * between) / (first.slope - last.slope)
    return first.load + first.slope * share


@kernel
def open_edge(edge: Edge, start: float, room: Room, out: Floats) -> None:
    """Follow an edge inwards from the radius at which it rests to separation.

    Results: the lowest load; where that is; the speed there in v*; int y rho^2 dy of the whole way; the depth at
    separation. Near y = 0 the depth is constant, which gives the rest of the work.
    """
    place, nodes, k = place_at(edge, start), room.nodes, edge.table.k
    h = 0.1 * min(0.1, lag_of(edge, (1.0 + abs(place.push - place.level)) / place.drag))
    y, lag, slow, work, low = start, 0.0, math.inf, 0.0, math.inf
    before = _Point(0.0, 0.0, state_of(place, 1.0)[1], -math.inf, math.inf)
    note(edge, y, lag, room.track)
    while y > _ENDS * start:
        length, h = stride(edge, 1.0, y, lag, h, start * start, room)
        if math.isnan(length):
            return
        first, last, floor = before, before, low
        for i in range(steps.STAGES):
            point = _point_at(edge, y, length * steps.NODES[i], nodes[AWAY, i], nodes[LAG, i], nodes[SLOW, i])
            note(edge, y * math.exp(-nodes[AWAY, i]), nodes[LAG, i], room.track)
            if before.turning > 0.0 >= point.turning and not _bound(before, point) >= floor:  # NaN at the same radius
                first, last, floor = before, point, _bound(before, point)
            before = point
        before = _Point(0.0, 0.0, before.load, before.slope, before.turning)
        next_y, next_lag, slow, part = end_of_step(edge, y, length, room)
        if last.length > first.length:
            step_until(edge, 1.0, y, lag, (first.length, last.length), (first.turning, last.turning, 0.0), TROUGH, room)
            radius, own, slow_there, _ = end_of_step(edge, y, length, room)
            load = state_of(place_at(edge, radius), 1.0 + own)[1]
            if load < low:
                low = out[0] = load
                out[1], out[2] = radius, 1.0 / slow_there
        y, lag, work = next_y, next_lag, work + part
    depth, load = state_of(place_at(edge, y), 1.0 + lag)
    depth += edge.by_load * load - edge.speed * y * slow * edge.power / (edge.power + 1.0 - k)
    out[3], out[4] = work + depth * depth * y ** (1.0 + k) / (1.0 + k), depth


@kernel
def close_edge(edge: Edge, rim: float, target: float, furthest: float, room: Room, out: Floats) -> float:
    """Follow an edge outwards from zero contact at Y = 0 until it rests; return how far it was followed.

    That is at the rim, where the machine turns as well if it has not, or where G = w_c after the machine has turned at
    the depth `target`. A contact starts where rho is next to 0: it follows the equilibrium of Y = 0, quickly at first.
    Results: the radius at which the edge rests; the depth when the machine turned; int y rho^2 dy of the whole way; how
    far the far end of the spring will move from there before the edge opens.
    """
    size = edge.B ** (-1.0 / (edge.table.exponent - 0.5 * (1.0 - edge.table.k)))
    y, work, depth, h, drive = _ENDS * min(rim, edge.shortest, size), 0.0, 0.0, 1.0, 1.0 if target > 0.0 else -1.0
    place = place_at(edge, y)
    lag = edge.root - (place.depth + edge.by_load * place.load) / ((1.0 + edge.by_load * place.front) * place.adhesion)
    rests = False
    while not rests:
        w, change = steps.rates(edge, drive, y, lag)
        left = -lag * w / change * edge.power / (1.0 + edge.power)  # to lag = 0, by the leading term
        if drive < 0.0 and change < -0.5 and left < _LEFT and y * (1.0 + left) < rim:
            y, lag, work, rests = y * (1.0 + left), 0.0, work + (y * edge.root) ** 2 * left, True
            note(edge, y, lag, room.track)
            continue
        length, h = stride(edge, drive, y, lag, h, y * y, room)
        next_y, next_lag, slow, part = end_of_step(edge, y, length, room)
        reached = measure(edge, next_y, next_lag, slow, steps.DEPTH)
        what, values = steps.RHO, (edge.root - lag, edge.root - next_lag, 0.0)  # a step ends at the kink of u^(-1/n)
        if next_y >= rim:
            what, values = steps.RADIUS, (math.log(y), math.log(next_y), math.log(rim))
        if drive > 0.0 and reached >= target:
            what, values = steps.DEPTH, (depth, reached, target)
        if what != steps.RHO or values[0] * values[1] < 0.0:
            whole = length
            length = step_until(edge, drive, y, lag, (0.0, whole), values, what, room)
            next_y, next_lag, slow, part = end_of_step(edge, y, length, room)
            next_lag, h = edge.root if what == steps.RHO else next_lag, max(whole - length, 1e-3 * whole)
        if math.isnan(length) or next_y > furthest:
            return float(next_y)
        for i in range(steps.STAGES):
            note(edge, y * math.exp(room.nodes[AWAY, i]), room.nodes[LAG, i], room.track)
        y, lag, work, rests = rim if what == steps.RADIUS else next_y, next_lag, work + part, what == steps.RADIUS
        depth = measure(edge, y, lag, slow, steps.DEPTH) if drive > 0.0 else depth
        if what == steps.DEPTH:
            drive, h = -1.0, min(h, 0.1 * lag)
    place = place_at(edge, y)
    out[0], out[1], out[2] = y, depth, work
    out[3] = (1.0 - edge.root + lag) * place.adhesion * (1.0 + edge.by_load * place.front)
    return float(y)
