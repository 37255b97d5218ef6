"""Arrays of scenes whose edge moves at a speed, one scene at a time, on threads."""

import math
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.jit import kernel
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import CLOSING, SPEED, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.rate import MOST_WAVES, Rate
from gradhesion.core.problem.shape import rows_of
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET, TOO_MANY_WAVES
from gradhesion.core.processors import processors
from gradhesion.core.rate.edge import Edge, place_at
from gradhesion.core.rate.step import STAGES, Room
from gradhesion.core.rate.ways import close_edge, open_edge
from gradhesion.core.scenes.reduced import depth_factor_of
from gradhesion.core.table.functions import functions_of
from gradhesion.core.types import Floats, Integers

K, MATERIAL, WAVELENGTH, AMPLITUDE, RIM, SPRING, SPEEDS, RATIO, TARGET = range(9)
"""Rows of scenes: k; M; lambda and A; where the edge starts (opening) or the rim; 1/S; V/v*; w_c/w_o; the depth at which
the cycle turns, inf at the rim."""
OPENED: Final = ("pull_off_force", "pull_off_radius", "opening_energy", "delta_jump_out", "edge_speed_at_pull_off")
"""The results of opening, in the order of the rows."""
CLOSED: Final = ("turning_radius", "delta_max", "closing_energy", "pinned_depth")
"""The results of closing, in the order of the rows."""
_SLOWEST: Final = 1e-15
"""(V/v*)^n below which a step may pass the end of a branch unseen: the lag there is below rounding."""
_AT_RIM: Final = 1e-9
"""Relative distance, over where it started, below which an edge has not moved."""
_UNIT_OF_FORCE: Final = 1.5 * math.pi
_PART: Final = 16
"""Scenes that a thread takes at a time: some milliseconds."""
MOST_POINTS: Final = 2**18
"""Points of a track, at most."""
Array: TypeAlias = NDArray[np.float64]


@kernel
def _is_valid(scenes: Floats, i: int) -> bool:
    """Return whether all parameters of scene i are in their ranges."""
    valid = 0.0 <= scenes[K, i] <= 1.0 and 0.0 < scenes[MATERIAL, i] < math.inf and scenes[RIM, i] > 0.0
    valid = valid and 0.0 < scenes[WAVELENGTH, i] < math.inf and 0.0 <= scenes[AMPLITUDE, i] < math.inf
    return valid and 0.0 <= scenes[SPRING, i] < math.inf and 0.0 < scenes[SPEEDS, i] < math.inf


@kernel
def _open(edge: Edge, start: float, room: Room, out: Floats) -> int:
    """Put the results of opening into `out`, and return their status."""
    if not start < math.inf:
        return NO_VALUE
    if start > MOST_WAVES * edge.shortest:
        return NO_VALUE | TOO_MANY_WAVES
    opened = open_edge(edge, start, room)
    if not abs(opened.load) + opened.work < math.inf:
        return NO_VALUE
    out[0], out[1], out[2] = -opened.load / _UNIT_OF_FORCE, opened.radius, opened.work
    out[3], out[4] = opened.depth, opened.speed
    return PULL_OFF_AT_RIM if opened.radius >= (1.0 - _AT_RIM) * start else 0


@kernel
def _close(edge: Edge, rim: float, target: float, room: Room, out: Floats) -> int:
    """Put the results of closing into `out`, and return their status."""
    furthest = MOST_WAVES * edge.shortest
    if not 0.0 < edge.root <= 1.0 or not (rim < math.inf or target < math.inf):
        return NO_VALUE
    if target < 0.0:
        out[0], out[1], out[2], out[3] = 0.0, target, 0.0, 0.0
        return NO_CONTACT
    if furthest < rim < math.inf and target == math.inf:
        return NO_VALUE | TOO_MANY_WAVES
    closed = close_edge(edge, rim, target, furthest, room)
    if not closed.work < math.inf:
        return NO_VALUE | (TOO_MANY_WAVES if closed.radius > furthest else 0)
    place = place_at(edge, closed.radius)
    out[0], out[1], out[2] = closed.radius, closed.depth, closed.work
    out[3] = (1.0 - edge.root + closed.lag) * place.adhesion * (1.0 + edge.spring * place.front)
    return 0


@kernel
def move_edges(
    scenes: Floats,
    waves: Floats,
    exponent: float,
    power: float,
    opens: bool,
    out: Floats,
    status: Integers,
    track: Floats,
) -> None:
    """Open or close the contacts of scenes, (9, scenes); `out` has a row a result, NaN where nothing is stored.

    `waves` are the harmonics of the punch, (., 3), and `exponent` its power; `power` is n of the law. `track` (3, .)
    takes where the edge of the last scene has been, as that of `Room`.
    """
    functions, size = functions_of(0.5), 0.0
    for i in range(scenes.shape[1]):
        if not _is_valid(scenes, i):
            status[i] = NO_VALUE
            continue
        k, M, wavelength = scenes[K, i], scenes[MATERIAL, i], scenes[WAVELENGTH, i]
        if functions.k != k or size == 0.0:
            functions, size = functions_of(k), depth_factor_of(k, exponent)
        height = scenes[AMPLITUDE, i] * wavelength if len(waves) else 0.0
        edge = Edge(
            functions=functions,
            waves=waves,
            exponent=exponent,
            size=size,
            height=height,
            number=2.0 * math.pi / wavelength,
            shortest=wavelength / np.max(waves[:, 0]) if height > 0.0 else math.inf,
            stretch=math.sqrt(2.0 ** (1.0 + k) * math.pi / M),
            stiffness=2.0 ** (1.0 - k) * M / (1.0 + k),
            spring=scenes[SPRING, i],
            speed=scenes[SPEEDS, i],
            power=power,
            root=1.0 if opens else math.sqrt(scenes[RATIO, i]),
            sense=1.0 if opens else -1.0,
        )
        room = Room(np.empty((6, STAGES)), np.empty((2 * STAGES, 2 * STAGES + 1)), track)
        if opens:
            status[i] = _open(edge, scenes[RIM, i], room, out[:, i])
        else:
            status[i] = _close(edge, scenes[RIM, i], scenes[TARGET, i], room, out[:, i])
        if edge.speed**power < _SLOWEST and not status[i] & (NO_VALUE | NO_CONTACT):
            status[i] |= TOLERANCE_NOT_MET


def _rows_of(parameters: Mapping[str, Array], loading: Loading) -> Array:
    """Return the rows of scenes, (9, scenes), of parameters that have a value a scene each."""
    p = parameters
    material = stiffness(p["k"], p["nu"], p["modulus"], p["c0_over_R"])
    spring = np.zeros_like(material)
    if loading.control == "machine":
        with np.errstate(all="ignore"):
            spring = 1.0 / (p["machine_stiffness"] * p["modulus"])
    more = [p.get(name, np.full_like(material, value)) for name, value in ((CLOSING, 1.0), (TURNS[0], math.inf))]
    return np.array([p["k"], material, p["lambda_over_R"], p["A"], p["a_max_over_R"], spring, p[SPEED], *more])


def _moved(
    parameters: Mapping[str, Array], rate: Rate, profile: Profile, loading: Loading, threads: int | None, *, opens: bool
) -> dict[str, NDArray[np.float64]]:
    """Return the results of opening or closing by name, and `status`, of parameters that have a value a scene each."""
    rows, names = _rows_of(parameters, loading), OPENED if opens else CLOSED
    waves, count = rows_of(profile), rows.shape[1]
    out, status = np.full((len(names), count), np.nan), np.zeros(count, dtype=np.int64)

    def work(first: int) -> None:
        """Solve the next scenes."""
        part = slice(first, first + _PART)
        own = np.full((len(names), status[part].size), np.nan)
        track = np.zeros((3, 0))
        move_edges(
            np.ascontiguousarray(rows[:, part]), waves, profile.exponent, rate.exponent, opens, own, status[part], track
        )
        out[:, part] = own

    firsts = range(0, count, _PART)
    with ThreadPoolExecutor(threads or processors()) as pool:
        list(pool.map(work, firsts))
    return {**dict(zip(names, out, strict=True)), "status": status.astype(np.int16)}


def open_at_speed(
    parameters: Mapping[str, Array], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> dict[str, NDArray[np.float64]]:
    """Return the results of contacts that open at a speed, from the radius a_t at which rho = 1 to separation.

    Parameters
    ----------
    parameters
        Arrays (scenes,) for each name of `PARAMETERS`, with a_max_over_R the radius a_t; speed_over_reference V/v* > 0;
        and machine_stiffness where the control is "machine".
    rate, profile, loading, threads
        As of `solve` of core/sweep.py.

    Returns
    -------
    Arrays (scenes,): pull_off_force in 1.5 pi R dgamma and pull_off_radius in R; opening_energy, int 2 pi a G da, in
    R^2 dgamma; delta_jump_out in R, the depth at separation, where there is no load and the far end of the spring is
    as deep; edge_speed_at_pull_off in v*. `status` (int16) has pull_off_at_rim (the edge has moved by less than 1e-9 of
    a_t), tolerance_not_met ((V/v*)^n below 1e-15), no_value (all values are NaN), and too_many_waves with it.
    """
    return _moved(parameters, rate, profile, loading, threads, opens=True)


def close_at_speed(
    parameters: Mapping[str, Array], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> dict[str, NDArray[np.float64]]:
    """Return the results of contacts that close by the same law, G = w_c/[1 + (v/v*)^n], from zero contact at Y = 0.

    Y is what moves at the speed V: the depth, or the far end of the spring. Where the machine turns, at the depth
    indentation_max_over_R, the edge goes on closing until G = w_c or the rim is met; a punch whose rim is met first
    stays there. At rho <= 0 the edge follows at once.

    Parameters
    ----------
    parameters
        As of `open_at_speed`, with a_max_over_R the rim (may be inf), closing_ratio in (0, 1], and
        indentation_max_over_R (inf, or none: the machine turns when the rim is met). One of rim and depth is finite.
    rate, profile, loading, threads
        As of `open_at_speed`.

    Returns
    -------
    Arrays (scenes,), lengths in R: turning_radius, where opening will start; delta_max, the depth when the machine turns
    or the rim is met before; closing_energy, int 2 pi a G da, in R^2 dgamma; pinned_depth, how far the far end moves
    from where the edge stops to where it opens. `status` as of `open_at_speed`, and no_contact where the depth is
    negative.
    """
    return _moved(parameters, rate, profile, loading, threads, opens=False)


def track_of(
    parameters: Mapping[str, float], rate: Rate, profile: Profile, loading: Loading, *, opens: bool
) -> NDArray[np.float64]:
    """Return where the edge of one scene is as it opens or closes, step by step.

    The parameters are numbers, those of `open_at_speed` or `close_at_speed`. The array has the shape (3, points): radii
    and depths in R, loads in 1.5 pi R dgamma; without points where there is no value.
    """
    rows = _rows_of({name: np.full(1, value, dtype=float) for name, value in parameters.items()}, loading)
    out, status, track = np.full((len(OPENED), 1), np.nan), np.zeros(1, dtype=np.int64), np.zeros((3, MOST_POINTS))
    move_edges(rows, rows_of(profile), profile.exponent, rate.exponent, opens, out, status, track)
    number = 0 if status[0] & NO_VALUE else int(track[0, 0])
    return track[:, 1 : number + 1] / np.array([[1.0], [1.0], [_UNIT_OF_FORCE]])
