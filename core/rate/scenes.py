"""Arrays of scenes whose edge moves at a speed: one scene at a time, those of one exponent on one table."""

import math
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.jit import kernel
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import SPEED, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.rate import MOST_WAVES, Rate
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET, TOO_MANY_WAVES
from gradhesion.core.processors import processors
from gradhesion.core.rate.edge import Edge, place_at
from gradhesion.core.rate.step import STAGES, Room
from gradhesion.core.rate.ways import close_edge, open_edge
from gradhesion.core.scenes.reduced import (
    AT_RIM,
    BY_LOAD,
    BY_POWER,
    BY_WAVES,
    DEPTH,
    LENGTH,
    LOAD,
    NEED,
    RATIO,
    RIM,
    RIM_Y,
    TARGET_VALUE,
    UNIT_OF_FORCE,
    K,
    Punch,
    is_valid,
    reduced_of,
)
from gradhesion.core.scenes.tasks import columns_of, long_table, punch_of, scenes_of
from gradhesion.core.sweep import request_of
from gradhesion.core.table.basis import basis_of
from gradhesion.core.table.layout import EXACT, Table
from gradhesion.core.types import Floats, Integers

OPENED: Final = ("pull_off_force", "pull_off_radius", "opening_energy", "delta_jump_out", "edge_speed_at_pull_off")
"""The results of opening, in the order of the rows."""
CLOSED: Final = ("turning_radius", "delta_max", "closing_energy", "pinned_depth")
"""The results of closing, in the order of the rows."""
_SLOWEST: Final = 1e-15
"""(V/v*)^n below which a step may pass the end of a branch unseen: the lag there is below rounding."""
_AT_RIM: Final = 1e-9
"""Relative distance, over where it started, below which an edge has not moved."""
_PART: Final = 16
"""Scenes that a thread takes at a time: some milliseconds."""
_MOST_POINTS: Final = 2**18
"""Points of a track, at most."""


@kernel
def _open(edge: Edge, start: float, units: Floats, room: Room, out: Floats) -> int:
    """Put the results of opening from a radius into `out`, and return their status."""
    if not start < math.inf:
        return NO_VALUE
    if start > MOST_WAVES * edge.shortest:
        return NO_VALUE | TOO_MANY_WAVES
    opened = open_edge(edge, start, room)
    if not abs(opened.load) + opened.work < math.inf:
        return NO_VALUE
    out[0], out[1] = -opened.load * units[LOAD] * UNIT_OF_FORCE, opened.radius * units[LENGTH]
    out[2], out[3] = 2.0 * math.pi * units[LENGTH] ** 2 * opened.work, opened.depth * units[DEPTH]
    out[4] = opened.speed
    return PULL_OFF_AT_RIM if opened.radius >= (1.0 - _AT_RIM) * start else 0


@kernel
def _close(edge: Edge, rim: float, target: float, units: Floats, room: Room, out: Floats) -> int:
    """Put the results of closing, to the rim or until the machine turns at a depth, into `out`; return their status."""
    furthest = MOST_WAVES * edge.shortest
    if not edge.root > 0.0 or not (rim < math.inf or target < math.inf):
        return NO_VALUE
    if target < 0.0:
        out[0], out[1], out[2], out[3] = 0.0, target * units[DEPTH], 0.0, 0.0
        return NO_CONTACT
    if furthest < rim < math.inf and target == math.inf:
        return NO_VALUE | TOO_MANY_WAVES
    closed = close_edge(edge, rim, target, furthest, room)
    if not closed.work < math.inf:
        return NO_VALUE | (TOO_MANY_WAVES if closed.radius > furthest else 0)
    place = place_at(edge, closed.radius)
    out[0], out[1] = closed.radius * units[LENGTH], closed.depth * units[DEPTH]
    out[2] = 2.0 * math.pi * units[LENGTH] ** 2 * closed.work
    softness = 1.0 + edge.by_load * place.front
    out[3] = (1.0 - edge.root + closed.lag) * place.adhesion * softness * units[DEPTH]
    return 0


@kernel
def move_edges(
    punch: Punch,
    table: Table,
    scenes: Floats,
    reduced: Floats,
    speeds: Floats,
    power: float,
    opens: bool,
    out: Floats,
    status: Integers,
    track: Floats,
) -> None:
    """Open or close the contacts of scenes of one exponent; `out` has a row a result, NaN where nothing is stored.

    `speeds` are V/v*, (scenes,), and `power` n of the law; `scenes` and `reduced` those of scenes/reduced.py. `track`
    takes where the edge of the last scene has been, as that of `Room`.
    """
    for i in range(scenes.shape[1]):
        status[i] = NO_VALUE
        if not is_valid(punch, scenes, reduced, i) or not 0.0 < speeds[i] < math.inf:
            continue
        units = reduced[:, i].copy()
        g = units[BY_WAVES]
        edge = Edge(
            table=table,
            B=units[BY_POWER],
            g=g,
            by_load=units[BY_LOAD],
            shortest=2.0 * math.pi / np.max(punch.waves[:, 0]) if g > 0.0 else math.inf,
            speed=speeds[i] * units[LENGTH] / units[DEPTH],
            power=power,
            root=1.0 if opens else math.sqrt(scenes[RATIO, i]),
            sense=1.0 if opens else -1.0,
        )
        room = Room(np.empty((6, STAGES)), np.empty((2 * STAGES, 2 * STAGES + 1)), track)
        if opens:
            status[i] = _open(edge, units[RIM_Y], units, room, out[:, i])
        else:
            target = math.inf if punch.turn == AT_RIM else units[TARGET_VALUE]
            status[i] = _close(edge, units[RIM_Y], target, units, room, out[:, i])
            if out[0, i] > scenes[RIM, i] * (1.0 - 1e-15):
                out[0, i] = scenes[RIM, i]
        for j in range(1, int(track[0, 0]) + 1 if track.shape[1] > 0 else 0):
            track[0, j], track[1, j] = track[0, j] * units[LENGTH], track[1, j] * units[DEPTH]
            track[2, j] *= units[LOAD] * UNIT_OF_FORCE
        if speeds[i] ** power < _SLOWEST and not status[i] & (NO_VALUE | NO_CONTACT):
            status[i] |= TOLERANCE_NOT_MET


def _moved(
    parameters: Mapping[str, ArrayLike],
    rate: Rate,
    profile: Profile,
    loading: Loading,
    threads: int | None,
    track: NDArray[np.float64],
    *,
    opens: bool,
) -> dict[str, NDArray[Any]]:
    """Return the results of opening or closing by name, and `status`, (scenes,)."""
    turn = TURNS[0] if TURNS[0] in parameters and not opens else None
    request, shape = request_of(parameters, turn, profile, loading, None)
    punch, names = punch_of(request), OPENED if opens else CLOSED
    columns, count = columns_of(request)
    scenes, speeds = scenes_of(columns, 0, count), np.broadcast_to(np.asarray(parameters[SPEED], dtype=float), shape)
    reduced = reduced_of(punch, basis_of(punch.exponent, punch.waves), scenes, np.ones(count), np.zeros(count))
    out, status = np.full((len(names), count), np.nan), np.full(count, NO_VALUE, dtype=np.int64)
    most = 2.0 * math.pi * MOST_WAVES / float(punch.waves[:, 0].max())
    far = np.where(reduced[BY_WAVES] > 0.0, reduced[RIM_Y] if turn is None else reduced[NEED], 0.0)
    far = np.where(far < np.inf, np.minimum(far, most), 0.0)

    def work(k: float, y_end: float, index: NDArray[np.int64]) -> None:
        """Solve some scenes of one exponent, on a table to y_end."""
        own, bits = np.full((len(names), index.size), np.nan), np.empty(index.size, dtype=np.int64)
        table = long_table(punch, k, EXACT, 1, y_end)[0]
        move_edges(
            punch, table, scenes[:, index], reduced[:, index], speeds[index], rate.exponent, opens, own, bits, track
        )
        out[:, index], status[index] = own, bits

    tasks = []
    for k in np.unique(scenes[K][(scenes[K] >= 0.0) & (scenes[K] <= 1.0)]).tolist():
        index = np.flatnonzero(scenes[K] == k)
        y_end = float(far[index].max())
        tasks += [(k, y_end, index[first : first + _PART]) for first in range(0, index.size, _PART)]
    if len(tasks) == 1:
        work(*tasks[0])
    else:
        with ThreadPoolExecutor(threads or processors()) as pool:
            list(pool.map(lambda task: work(*task), tasks))
    return {**dict(zip(names, out, strict=True)), "status": status.astype(np.int16)}


def open_at_speed(
    parameters: Mapping[str, ArrayLike], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> dict[str, NDArray[Any]]:
    """Return the results of contacts that open at a speed, from the radius a_t at which rho = 1 to separation.

    Parameters
    ----------
    parameters
        Those of `solve` of core/sweep.py, arrays (scenes,), with a_max_over_R the radius a_t, and speed_over_reference
        V/v* > 0.
    rate, profile, loading, threads
        As of `solve`.

    Returns
    -------
    Arrays (scenes,): pull_off_force in 1.5 pi R dgamma and pull_off_radius in R; opening_energy, int 2 pi a G da, in
    R^2 dgamma; delta_jump_out in R, the depth at separation, where there is no load and the far end of the spring is
    as deep; edge_speed_at_pull_off in v*. `status` (int16) has pull_off_at_rim (the edge has moved by less than 1e-9 of
    a_t), tolerance_not_met ((V/v*)^n below 1e-15), no_value (all values are NaN), and too_many_waves with it.
    """
    return _moved(parameters, rate, profile, loading, threads, np.zeros((3, 0)), opens=True)


def close_at_speed(
    parameters: Mapping[str, ArrayLike], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> dict[str, NDArray[Any]]:
    """Return the results of contacts that close by the same law, G = w_c/[1 + (v/v*)^n], from zero contact at Y = 0.

    Y is what moves at the speed V: the depth, or the far end of the spring. Where the machine turns, at the depth
    indentation_max_over_R, the edge goes on closing until G = w_c or the rim is met; a punch whose rim is met first
    stays there. At rho <= 0 the edge follows at once. Arguments are those of `open_at_speed`, with closing_ratio > 0.

    Returns
    -------
    Arrays (scenes,), lengths in R: turning_radius, where opening will start; delta_max, the depth when the machine
    turns or the rim is met before; closing_energy, int 2 pi a G da, in R^2 dgamma; pinned_depth, how far the far end
    moves from where the edge rests to where it opens. `status` as of `open_at_speed`, and no_contact where the depth is
    negative.
    """
    return _moved(parameters, rate, profile, loading, threads, np.zeros((3, 0)), opens=False)


def track_of(
    parameters: Mapping[str, float], rate: Rate, profile: Profile, loading: Loading, *, opens: bool
) -> NDArray[np.float64]:
    """Return where the edge of one scene is as it opens or closes, step by step.

    The parameters are numbers, those of `open_at_speed` or `close_at_speed`. The array has the shape (3, points): radii
    and depths in R, loads in 1.5 pi R dgamma; without points where there is no value.
    """
    track = np.zeros((3, _MOST_POINTS))
    own = {name: np.full(1, value, dtype=float) for name, value in parameters.items()}
    found = _moved(own, rate, profile, loading, 1, track, opens=opens)
    number = 0 if found["status"][0] & NO_VALUE else int(track[0, 0])
    return track[:, 1 : number + 1]
