"""Curves of one scene whose edge moves at a speed: the path by time, and the curves of the edge at rest.

The points of the path are the nodes of the steps by which the edge is followed: as many as its course needs. Between
loading and opening the contact is pinned, a straight line at the turning radius.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import CLOSING, CURVES, SPEED, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE
from gradhesion.core.rate.scenes import move
from gradhesion.core.sweep import solve

_TYPES: Final = (np.float64, np.float64, np.float64, np.int32, np.int8, np.int8)
"""Those of the variables of a path."""
_MOST_POINTS: Final = 2**18
Curves: TypeAlias = dict[str, NDArray[Any]]


def _path_of(states: NDArray[np.float64], *, unloading: bool) -> Curves:
    """Return the variables of a path from states, of shape (3, points): contact is one branch, and nothing jumps."""
    columns = (*states, states[0] > 0.0, np.zeros(states.shape[1]), np.full(states.shape[1], unloading))
    return {name: column.astype(t) for name, column, t in zip(CURVES["path"], columns, _TYPES, strict=True)}


def _without_contact(depth: float, *, known: bool) -> Curves:
    """Return a path of one point without contact, or without a value (NaN, -1)."""
    if known:
        return _path_of(np.array([[0.0], [depth], [0.0]]), unloading=False)
    return {
        name: np.full(1, np.nan if t is np.float64 else -1, t) for name, t in zip(CURVES["path"], _TYPES, strict=True)
    }


def draw_at_speed(
    scene: Mapping[str, float],
    curves: Sequence[str],
    profile: Profile,
    loading: Loading,
    rate: Rate,
    draw_at_rest: Callable[[Mapping[str, float], Sequence[str]], tuple[Curves, int]],
) -> tuple[Curves, int]:
    """Return curves of one scene with a speed: variables and status, as those of other scenes.

    The path is that of the moving edge, `path_branch` being 1 in contact; the other curves are those of an edge at
    rest. At speed 0 all are. There are no jumps, and the curve "jumps" is refused. `draw_at_rest` draws curves of a
    scene without a speed, of the same profile and loading.
    """
    rest = {name: value for name, value in scene.items() if name != SPEED}
    if scene[SPEED] == 0.0 or "path" not in curves:
        return draw_at_rest(rest, curves)
    if "jumps" in curves:
        raise ValueError("an edge with a speed has no jumps: each radius is passed once")
    found, status = draw_at_rest(rest, [curve for curve in curves if curve != "path"])
    names = ["turning_radius", "delta_jump_out", "pull_off_force"]
    solved = solve(scene, names, profile=profile, loading=loading, rate=rate, threads=1)
    status |= int(solved["status"])
    if status & (NO_VALUE | NO_CONTACT):
        return found | _without_contact(scene.get(TURNS[0], math.nan), known=not status & NO_VALUE), status
    how, one = (
        (rate, profile, loading, 1),
        {name: np.full(1, value) for name, value in ({CLOSING: 1.0} | scene).items()},
    )
    if rate.closing == "quasi-static":
        path, _ = draw_at_rest({CLOSING: 1.0, **rest}, ["path"])
        up = {name: path[name][path["path_unloading"] == 0] for name in CURVES["path"]}
    else:
        track = move(one, *how, opens=False, points=_MOST_POINTS)["track"]
        up = _path_of(np.insert(track, 0, 0.0, axis=1), unloading=False)
    track = move(one | {"a_max_over_R": solved["turning_radius"].reshape(1)}, *how, opens=True, points=_MOST_POINTS)[
        "track"
    ]
    last = [[0.0], [float(solved["delta_jump_out"])], [0.0]]
    down = _path_of(np.append(track, last, axis=1), unloading=True)
    return found | {name: np.concatenate([up[name], down[name]]) for name in up}, status
