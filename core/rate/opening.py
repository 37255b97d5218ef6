"""Opening from a radius a_t, where rho = 1, down to separation: pull-off, energy, depth at separation.

Near a_t the lag rises as (a_t - a)^(n/(1+n)): the distance from there is measured by a root of s in which the lag and
its later terms are smooth. Near a = 0 the depth is constant, and so is the depth in the rest of the energy.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.rate.bracket import TRIALS, Bracket, is_found, narrowed, place_to_try
from gradhesion.core.rate.law import Law
from gradhesion.core.rate.place import Place, coordinate_of, load_of, place_at
from gradhesion.core.rate.radau import NODES, STAGES
from gradhesion.core.rate.step import Room, Start, advance, note_nodes, place_in, way
from gradhesion.core.rate.stride import PART, longest, stride

_END: Final = math.log(1e12)
"""How far inwards the edge is followed, in ln a: at most 1e-12 of the energy remains."""
_SURE: Final = 1e-14


class Opened(NamedTuple):
    """The results of opening, in reduced units; NaN where it could not be followed."""

    load: float  # the lowest
    z: float  # where it is
    speed: float  # of the edge there, in v*
    energy: float
    depth: float  # at separation
    of_load: float  # estimated errors
    of_energy: float


class _Node(NamedTuple):
    """The load at a node of a step."""

    part: float  # of the step, from 0 to 1
    z: float
    load: float
    slope: float  # dP/ds
    turning: float  # positive while the load falls inwards, 0 at a trough


@kernel()
def smooth_power(n: float) -> float:
    """Return q for which lag = y^q makes lag, lag^(1/n) and their products smooth enough functions of y."""
    return 2.0 if n <= 0.5 else 6.0


@kernel()
def _start_of(law: Law, place: Place, x: float, shortest: float) -> Start:
    """Return the start, with y such that at y = 1 the edge moves about as the equilibrium curve does."""
    n = law.exponent
    force, need = law.pace * place.drag, place.push - place.level
    far = min(0.1, PART * shortest / x)
    if need > 0.0:
        u = (force / need) ** n
        lag = u / (1.0 + math.sqrt(1.0 + u))
        far = min(far, n / (1.0 + n) * lag * (2.0 * lag) ** (1.0 / n) / force)
    return Start(x, -1.0, far, smooth_power(n) * (1.0 + n) / n)


@kernel()
def _node(k: float, law: Law, room: Room, i: int) -> _Node:
    """Return load and slope at node i: a dP/da = z^(1+k) Delta [drag pace u^(-1/n) - (1+k) rho/(1+tau)]."""
    place, rho = place_in(room, i), 1.0 + room.lags[i]
    need = (0.5 * (3.0 + k) - place.level) * rho
    force = law.pace * place.drag * room.slow[i]
    slope = place.front * place.adhesion * (need - force)
    return _Node(NODES[i], place.z, load_of(place, rho), slope, math.log(force / need))


@kernel()
def _bound(before: _Node, after: _Node) -> float:
    """Return a load above which a trough between two nodes lies, by its tangents there."""
    between = math.log(before.z / after.z)
    share = (after.load - before.load - after.slope * between) / ((before.slope - after.slope) * between)
    return before.load + before.slope * share * between


@kernel()
def _trough(
    basis: Basis,
    curve: Series,
    law: Law,
    start: Start,
    state: tuple[float, float],
    h: float,
    ends: tuple[_Node, _Node],
    room: Room,
) -> tuple[float, float, float]:
    """Return load, z and speed where dP/da = 0 between two nodes of a step of length h from the state (y, lag).

    Each place that is tried is reached by a step of its own.
    """
    k, node = basis[0].k, ends[1]
    bracket = Bracket(h * ends[0].part, h * ends[1].part, ends[0].turning, ends[1].turning, 0)
    for _ in range(TRIALS):
        length = place_to_try(bracket)
        if not advance(basis, curve, law, start, state, length, room):
            return math.nan, math.nan, math.nan
        node = _node(k, law, room, STAGES - 1)
        if is_found(bracket, node.turning, _SURE):
            break
        bracket = narrowed(bracket, length, node.turning)
    return node.load, node.z, 1.0 / room.slow[STAGES - 1]


@kernel()
def open_edge(basis: Basis, curve: Series, law: Law, x: float, shortest: float, room: Room) -> Opened:
    """Follow an edge from x wavelengths to separation; `shortest` is the shortest wave, inf where there is none."""
    n, k = law.exponent, basis[0].k
    place = place_at(basis, curve, x)
    start, y, end = _start_of(law, place, x, shortest), 0.0, 1.0
    area = place.z * place.z
    lag, h, error = 0.0, 0.5, 0.0
    low, z, speed, energy, of_load, of_energy = math.inf, 0.0, 0.0, 0.0, 0.0, 0.0
    before = _Node(0.0, place.z, math.inf, -math.inf, math.inf)
    failed = Opened(math.nan, math.nan, math.nan, math.nan, math.nan, math.nan, math.nan)
    while y < end:
        s, _ = way(start, y)
        most = end - y
        if start.power == 1.0:
            most = min(most, longest(x * math.exp(-s), -1.0, shortest))
        step = stride(basis, curve, law, start, (y, lag), (h, most), area, room)
        if not step.good:
            return failed
        note_nodes(law, room)
        found, ends, floor = 0, (before, before), low
        for i in range(STAGES):
            node = _node(k, law, room, i)
            if before.turning > 0.0 >= node.turning:
                bound = _bound(before, node) if before.load < math.inf else -math.inf
                if not bound >= floor:  # nor where two nodes are one to rounding
                    found, ends, floor = 1, (before, node), bound
            before = node
        before = _Node(0.0, before.z, before.load, before.slope, before.turning)
        place = place_in(room, STAGES - 1)
        slow = room.slow[STAGES - 1]
        error = step.growth * error + step.of_rho * (1.0 + step.lag)
        energy += step.energy
        of_energy += area * step.of_energy + 2.0 * step.energy * error / (1.0 + step.lag)
        if found > 0:
            load, where, fast = _trough(basis, curve, law, start, (y, lag), step.h, ends, room)
            if not load > -math.inf:
                return failed
            if load < low:
                low, z, speed, of_load = load, where, fast, error * place.front * place.adhesion
        y, lag, h = y + step.h if step.h < most or most < end - y else end, step.lag, step.next
        if y == end and start.power != 1.0:
            h *= start.scale * start.power
            y, end, start = start.scale, _END, Start(x, start.sign, 1.0, 1.0)
    rho = 1.0 + lag
    depth = (coordinate_of(curve, place, rho) - law.pace * place.z * slow * n / (n + 1.0 - k)) / curve.alpha
    energy += depth * depth * place.front / (1.0 + k)
    return Opened(low, z, speed, energy, depth, of_load, of_energy)
