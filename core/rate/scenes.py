"""The two ways of an edge: opening from a radius down to separation, and closing from zero contact until it rests.

Arrays of scenes are solved one scene at a time, those of one exponent on one table.
"""

import math
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.curve.values import Curve
from gradhesion.core.jit import kernel
from gradhesion.core.problem.names import SPEED, TURNS
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET, TOO_MANY_WAVES
from gradhesion.core.problem.toughness import MOST_WAVES, Rate
from gradhesion.core.processors import processors
from gradhesion.core.rate import edge as steps
from gradhesion.core.rate.edge import Edge, Room, Step, Way, advance, lag_of, place_at, pulls_at, state_of, stride
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import AT_RIM, UNIT_OF_FORCE, Punch, reduced_of
from gradhesion.core.scenes.requests import columns_of, scenes_of
from gradhesion.core.scenes.tables import ends_of_exponents, long_table
from gradhesion.core.sweep import request_of
from gradhesion.core.table.basis import basis_of, make_known
from gradhesion.core.table.layout import EXACT, Table
from gradhesion.core.types import Floats

Pair: TypeAlias = tuple[float, float]
OPENED: Final = ("pull_off_force", "pull_off_radius", "edge_speed_at_pull_off", "opening_energy", "delta_jump_out")
CLOSED: Final = ("turning_radius", "delta_max", "closing_energy", "pinned_depth")
"""The results of opening and closing, in the order of the rows."""
_SLOWEST: Final = 1e-15
"""(V/v*)^n below which a step may pass the end of a branch unseen: the lag there is below rounding."""
_AT_RIM: Final = 1.0 - 1e-9  # part of the radius where it started beyond which an edge has not moved
_ENDS: Final = 1e-12
"""How far inwards opening is followed, over its start: at most as much of the energy remains. And where closing starts,
over the shortest of wave, rim and the length of a smooth contact."""
_LEFT: Final = 1e-13  # remaining ln y that is left to the leading term where closing comes to rest


@kernel
def note(edge: Edge, y: float, lag: float, track: Floats) -> None:
    """Note where an edge is, in a track that has room for it."""
    if track.shape[1] > 0 and track[0, 0] < track.shape[1] - 1:
        track[0, 0] += 1
        number = int(track[0, 0])
        track[0, number] = y
        track[1, number], track[2, number] = state_of(place_at(edge, y), edge.root + edge.sense * lag)


@kernel
def load_at(edge: Edge, y: float, lag: float, slow: float) -> tuple[float, float, float]:
    """Return the load in opening, its slope by ln y, and what falls from 1 to -1 as y does, through 0 in a trough.

    y dP/dy = T Delta [force - ((3+k)/2 - level) rho]
    """
    place, rho = place_at(edge, y), edge.root + edge.sense * lag
    need, force = (0.5 * (3.0 + edge.curve.table.k) - place.level) * rho, place.drag * slow
    return state_of(place, rho)[1], place.front * place.adhesion * (force - need), (force - need) / (force + need)


@kernel
def goal(edge: Edge, y: float, lag: float, slow: float, target: float) -> float:
    """Return what is 0 where a step is to end: a trough of the load in opening, the depth `target` in closing."""
    if edge.sense > 0.0:
        return load_at(edge, y, lag, slow)[2]
    return state_of(place_at(edge, y), edge.root - lag)[0] - target


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
        step, h = stride(edge, way, x, lag, h, start * start, room)
        if math.isnan(step.length):
            return
        floor, ends, values, begin = low, (0.0, 0.0), (before, before), 0.0
        for i in range(steps.STAGES):
            radius, own, slow = nodes[steps.RADIUS, i], nodes[steps.LAG, i], nodes[steps.SLOW, i]
            note(edge, radius, own, room.track)
            (load, slope, falls), end = load_at(edge, radius, own, slow), step.length * steps.NODES[i]
            bound = load + slope * math.log(y / radius)  # a trough between is above, by the tangent
            if before > 0.0 >= falls and bound < floor:
                floor, ends, values = bound, (begin, end), (before, falls)
            before, begin, y = falls, end, radius
        if floor < low:
            least = step_until(edge, way, x, lag, ends, values, 0.0, room)
            load = load_at(edge, least.y, least.lag, least.slow)[0]
            if load < low:
                low = out[0] = load
                out[1], out[2] = least.y, 1.0 / least.slow
        x, lag, work = x + step.length, step.lag, work + step.work
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
        step, h = stride(edge, way, x, lag, min(h, last - x), y * y, room)
        over = goal(edge, step.y, step.lag, step.slow, target)
        turns = way.drive > 0.0 and over >= 0.0
        rests = step.length == last - x and not turns
        if turns:
            step = step_until(edge, way, x, lag, (0.0, step.length), (depth - target, over), target, room)
        if math.isnan(step.length) or step.y > furthest:
            return step.y
        for i in range(steps.STAGES):
            note(edge, room.nodes[steps.RADIUS, i], room.nodes[steps.LAG, i], room.track)
        x, y, lag, work = x + step.length, rim if rests else step.y, step.lag, work + step.work
        if way.drive > 0.0:
            depth = state_of(place_at(edge, y), edge.root - lag)[0]
        if turns:
            way, h = Way(way.start, 1.0, 1.0, -1.0), 0.1 * lag
    place = place_at(edge, y)
    out[0], out[1], out[2] = y, depth, work
    out[3] = (1.0 - edge.root + lag) * place.adhesion * (1.0 + edge.curve.by_load * place.front)
    return y


@kernel
def move_edges(
    punch: Punch, table: Table, scenes: Floats, reduced: Floats, n: float, opens: bool, room: Room, out: Floats
) -> None:
    """Open or close the contacts of scenes of one exponent by a law of the power n.

    `scenes` and `reduced` are those of scenes/rows.py, the first with a last row of V/v*. `out` has a row a result,
    NaN where nothing is stored, and a last one of status. The track of the room takes where the last edge has been.
    """
    shortest_wave = 2.0 * math.pi / punch.waves[-1, 0]
    for i in range(scenes.shape[1]):
        speed, units, found = scenes[-1, i], reduced[:, i], out[:, i]
        root, rim = 1.0 if opens else math.sqrt(scenes[at.RATIO, i]), units[at.RIM_Y]
        target = math.inf if punch.turn == AT_RIM else units[at.TARGET_VALUE]
        if not (units[at.VALID] and 0.0 < speed < math.inf and root > 0.0 and min(rim, target) < math.inf):
            continue
        shortest = shortest_wave if units[at.BY_WAVES] > 0.0 else math.inf
        curve = Curve(table, units[at.BY_POWER], units[at.BY_WAVES], 1.0, units[at.BY_LOAD])
        furthest = MOST_WAVES * shortest
        edge = Edge(curve, shortest, speed * units[at.LENGTH] / units[at.DEPTH], n, root, 1.0 if opens else -1.0)
        if target == math.inf and rim > furthest:
            status = NO_VALUE | TOO_MANY_WAVES
        elif opens:
            open_edge(edge, rim, room, found)
            moved = PULL_OFF_AT_RIM if found[1] >= _AT_RIM * rim else 0
            status = NO_VALUE if math.isnan(found[0] + found[4]) else moved
        elif target < 0.0:
            found[0], found[1], found[2], found[3], status = 0.0, target, 0.0, 0.0, NO_CONTACT
        else:
            reached = close_edge(edge, rim, target, furthest, room, found)
            status = 0 if not math.isnan(found[3]) else NO_VALUE | (TOO_MANY_WAVES if reached > furthest else 0)
        too_slow = speed**n < _SLOWEST and not status & (NO_VALUE | NO_CONTACT)
        found[-1] = status | (TOLERANCE_NOT_MET if too_slow else 0)


def move(
    parameters: Mapping[str, ArrayLike], rate: Rate, known: Mapping[str, Any], *, opens: bool, points: int = 0
) -> dict[str, NDArray[Any]]:
    """Return the results of contacts that open, or close by the same law G = w_c/[1 + (v/v*)^n], at a speed.

    `parameters` are those of `solve` of core/sweep.py, arrays (scenes,), and speed_over_reference V/v* > 0;
    a_max_over_R is where opening starts. `known` has profile, loading and threads as of `solve`. `points` is the length
    of the track of the last scene, 0 if there is more than one.

    Returns arrays (scenes,) by the names of `OPENED` or `CLOSED`: those of results of cycles, and opening_energy and
    closing_energy, int 2 pi a G da in R^2 dgamma. `status` (int16): pull_off_at_rim (the edge has moved by less than
    1e-9), tolerance_not_met ((V/v*)^n below 1e-15), no_contact, no_value (all values are NaN), and too_many_waves with
    it. `track`, (3, .): radii and depths in R, loads in 1.5 pi R dgamma, step by step.
    """
    turn = TURNS[0] if TURNS[0] in parameters and not opens else None
    request = request_of(parameters, turn, known["profile"], known["loading"], None)
    punch, names, (columns, count) = request.punch, OPENED if opens else CLOSED, columns_of(request)
    scenes = np.vstack([scenes_of(columns, 0, count), np.broadcast_to(parameters[SPEED], request.shape).reshape(1, -1)])
    basis = basis_of(punch.exponent, punch.waves)
    make_known(basis, *ends_of_exponents(np.sort(scenes[at.K])))
    reduced = reduced_of(punch, basis, scenes, np.ones(count), np.zeros(count))
    out, track = np.full((len(names) + 1, count), np.nan), np.zeros((3, points))
    out[-1] = NO_VALUE
    far = np.where(reduced[at.BY_WAVES] > 0.0, reduced[at.RIM_Y if turn is None else at.NEED], 0.0)
    far = np.fmin(np.where(far < np.inf, far, 0.0), 2.0 * math.pi * MOST_WAVES / punch.waves[:, 0].max())

    def work(k: float) -> None:
        """Solve the scenes of one exponent."""
        own = np.flatnonzero(scenes[at.K] == k)
        table = long_table(punch, k, EXACT, 1, float(far[own].max()))[0]
        chosen, numbers, found = (np.ascontiguousarray(array[:, own]) for array in (scenes, reduced, out))
        room = Room(np.empty((9, steps.STAGES)), np.empty((steps.STAGES, steps.STAGES + 1)), track)
        move_edges(punch, table, chosen, numbers, rate.exponent, opens, room, found)
        out[:, own] = found

    with ThreadPoolExecutor(known["threads"] or processors()) as pool:
        list(pool.map(work, [k for k in np.unique(scenes[at.K]).tolist() if 0.0 <= k <= 1.0]))
    length, depth = reduced[at.LENGTH], reduced[at.DEPTH]
    load, area = reduced[at.LOAD] * UNIT_OF_FORCE, 2.0 * math.pi * length**2
    units = (-load, length, 1.0, area, depth) if opens else (length, depth, area, depth)
    found: dict[str, NDArray[Any]] = {name: row * unit for name, row, unit in zip(names, out, units, strict=False)}
    if not opens:  # a rim that is met is the one that was given
        rim, radius = scenes[at.RIM], found["turning_radius"]
        found["turning_radius"] = np.where(radius > rim * (1.0 - 1e-15), rim, radius)
    if points > 0:
        found["track"] = track[:, 1 : int(track[0, 0]) + 1] * np.array([length, depth, load])
    return found | {"status": out[-1].astype(np.int16)}
