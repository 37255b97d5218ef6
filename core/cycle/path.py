"""The path: loading follows the running maximum of what is prescribed outwards, unloading its running minimum inwards.

A trace serves all rims: loading is walked once; what unloading loses from the start of a branch is computed once a
branch. Energies are in 2 pi l^2 dgamma, depths and loads in the units of the curve.
"""

import math
from typing import NamedTuple

import numpy as np

from gradhesion.core.curve import trace as at
from gradhesion.core.curve.energy import jump_energy
from gradhesion.core.curve.levels import BEYOND, at_level
from gradhesion.core.curve.levels import LANDING as ACCURACY
from gradhesion.core.curve.values import Curve, coordinate_of, softness, state_in
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import end_of
from gradhesion.core.types import Floats, Integers


class State(NamedTuple):
    """Where a path stands on a curve."""

    y: float
    depth: float
    load: float


class Loaded(NamedTuple):
    """What loading up to a rim has done."""

    lost: float  # in 2 pi l^2 dgamma
    jumps: float
    deepest: float  # the depth at its end, where the edge stands at the rim
    in_to_rim: bool  # whether the jump-in met no branch within the rim
    known: bool  # False: the table is too short


class Unloaded(NamedTuple):
    """What unloading from a rim does."""

    lost: float
    jumps: float
    last: float  # the depth at which contact ends


class Cycle(NamedTuple):
    """What a cycle has lost, in the units of its curves."""

    loaded: Loaded
    unloaded: Unloaded
    turn: float  # the radius at which it turns
    reach: float  # of the last landing of loading
    snap: float  # the pull after the jump-in
    one_disc: bool  # whether loading keeps the contact one disc
    tied: bool  # whether a decision is close


@leaf
def end_state(trace: Floats, j: int) -> State:
    """Return where branch j ends."""
    return State(trace[at.END, j], trace[at.END_DEPTH, j], trace[at.END_LOAD, j])


@leaf
def start_state(trace: Floats, j: int) -> State:
    """Return where branch j starts."""
    return State(trace[at.START, j], trace[at.START_DEPTH, j], trace[at.START_LOAD, j])


@kernel
def walk_on(curve: Curve, trace: Floats, first: int, count: int, visited: Integers, visits: int, state: State) -> int:
    """Let loading go on from a state over the branches `first` to `count` - 1; return how many are visited in all.

    `visited`, as long as a row of `trace`, has their columns in order: `visits` of them at first, the last of which
    has what was lost by then; new ones are appended. Their rows LANDING, LOADED and LOADING_JUMPS are filled. A
    landing beyond the table ends the walk.
    """
    lost = jumps = 0.0
    if visits > 0:
        lost, jumps = trace[at.LOADED, visited[visits - 1]], trace[at.LOADING_JUMPS, visited[visits - 1]]
    level = coordinate_of(curve, state.depth, state.load)
    for j in range(first, count):
        if trace[at.END_LEVEL, j] <= level:
            continue
        landing = at_level(curve, level, trace[at.START, j], trace[at.END, j], ACCURACY)
        if landing == BEYOND:
            return visits
        lost += jump_energy(curve, state.y, state.depth, state.load, landing)
        jumps += 1.0
        visited[visits] = j
        visits += 1
        trace[at.LANDING, j], trace[at.LOADED, j], trace[at.LOADING_JUMPS, j] = landing, lost, jumps
        state, level = end_state(trace, j), trace[at.END_LEVEL, j]
    return visits


@kernel
def walk_loading(curve: Curve, trace: Floats, count: int, visited: Integers) -> int:
    """Let loading go from no contact over all branches; return how many it visits, whose columns are `visited`."""
    none = int(np.int64(0))  # a plain 0 would be a type of its own, for which callees are compiled once more
    return walk_on(curve, trace, none, count, visited, none, State(0.0, 0.0, 0.0))


@kernel
def snap_in(closing: Curve, landing: float) -> float:
    """Return the pull after the jump from zero contact to a radius, at the coordinate 0, in loads of closing."""
    if landing > end_of(closing.table):
        return math.nan
    depth, load = state_in(closing, landing)
    stiffness = landing ** (1.0 + closing.table.k)
    return stiffness * coordinate_of(closing, depth, load) / softness(closing, stiffness) - load


@leaf
def inner_branch(trace: Floats, j: int, level: float) -> int:
    """Return the nearest branch up to j that starts below a level, -1 if there is none."""
    while j >= 0 and trace[at.START_LEVEL, j] >= level:
        j -= 1
    return j


@leaf
def _leave(curve: Curve, state: State, low: float, high: float) -> float:
    """Return what the jump inwards from a state to the branch between two radii loses; both 0: out of contact."""
    landing = 0.0
    if high > 0.0:
        landing = at_level(curve, coordinate_of(curve, state.depth, state.load), low, high, ACCURACY)
    lost = 0.0
    if high > 0.0 or curve.by_depth > 0.0:  # a dead load falls without end: its jump-out is left out
        lost = jump_energy(curve, state.y, state.depth, state.load, landing)
    return lost


@leaf
def fill_unloading(curve: Curve, trace: Floats, j: int, stack: Integers) -> None:
    """Fill what unloading loses from the start of branch j on, and of all branches on its way.

    `stack` is room as long as a row of the trace.
    """
    n = 0
    while j >= 0 and math.isnan(trace[at.UNLOADED, j]):
        stack[n] = j
        n += 1
        j = inner_branch(trace, j - 1, trace[at.START_LEVEL, j])
    while n > 0:
        n -= 1
        i = stack[n]
        state, lost, jumps, last = start_state(trace, i), 0.0, 0.0, i
        low = high = 0.0
        if j >= 0:
            low, high = trace[at.START, j], trace[at.END, j]
            lost, jumps, last = trace[at.UNLOADED, j], trace[at.UNLOADING_JUMPS, j], int(trace[at.LAST, j])
        if state.y > 0.0:  # else the contact shrinks to a point, without a jump
            lost += _leave(curve, state, low, high)
            jumps += 1.0
        trace[at.UNLOADED, i], trace[at.UNLOADING_JUMPS, i], trace[at.LAST, i] = lost, jumps, last
        j = i


@leaf
def visited_within(trace: Floats, visited: Integers, visits: int, rim: float) -> int:
    """Return how many of the branches that loading visits it reaches within a rim."""
    low, high = 0, visits
    while low < high:
        i = (low + high) // 2
        if trace[at.LANDING, visited[i]] <= rim:
            low = i + 1
        else:
            high = i
    return low


@leaf
def started_within(trace: Floats, count: int, rim: float) -> int:
    """Return how many branches start within a rim."""
    low, high = 0, count
    while low < high:
        i = (low + high) // 2
        if trace[at.START, i] <= rim:
            low = i + 1
        else:
            high = i
    return low


@leaf
def load_to(curve: Curve, rim: float, trace: Floats, visited: Integers, visits: int) -> Loaded:
    """Return what loading up to a rim loses, and how deep it gets: inf if the rim is beyond the table."""
    depth = load = level = math.inf
    inside = rim <= end_of(curve.table)  # else the rim is on the endless branch
    if inside:
        depth, load = state_in(curve, rim)
        level = coordinate_of(curve, depth, load)
    n = visited_within(trace, visited, visits, rim)
    if not inside and (n == 0 or trace[at.END, visited[n - 1]] < rim):
        return Loaded(0.0, 0.0, 0.0, False, False)
    if n == 0:
        lost, jumps, top = jump_energy(curve, 0.0, 0.0, 0.0, rim), 1.0, 0.0
    else:
        j = visited[n - 1]
        lost, jumps, top = trace[at.LOADED, j], trace[at.LOADING_JUMPS, j], level
        if trace[at.END, j] < rim:
            state = end_state(trace, j)
            lost += jump_energy(curve, state.y, state.depth, state.load, rim)
            jumps, top = jumps + 1.0, trace[at.END_LEVEL, j]
    deepest = math.inf
    if depth < math.inf:
        deepest = depth + (top - level) / softness(curve, rim ** (1.0 + curve.table.k))
    return Loaded(lost, jumps, deepest, n == 0, True)


@leaf
def unload_from(curve: Curve, rim: float, trace: Floats, count: int, stack: Integers) -> Unloaded:
    """Return what unloading from a rim loses, and where it ends."""
    j = started_within(trace, count, rim) - 1
    lost, jumps, last = 0.0, 0.0, 0.0
    if j < 0 or trace[at.END, j] < rim:
        depth, load = state_in(curve, rim)
        j = inner_branch(trace, j, coordinate_of(curve, depth, load))
        low = high = 0.0
        if j >= 0:
            low, high = trace[at.START, j], trace[at.END, j]
        lost, jumps, last = _leave(curve, State(rim, depth, load), low, high), 1.0, depth
    if j >= 0:
        fill_unloading(curve, trace, j, stack)
        lost, jumps = lost + trace[at.UNLOADED, j], jumps + trace[at.UNLOADING_JUMPS, j]
        last = trace[at.START_DEPTH, int(trace[at.LAST, j])]
    return Unloaded(lost, jumps, last)
