"""Curves of one scene whose edge moves at a speed: the path by time, and the curves of the edge at rest.

The points of the path are the nodes of the steps by which the edge is followed: as many as its course needs. Between
loading and opening the contact is pinned, a straight line at the turning radius.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.names import CLOSING, CURVES, SPEED, TURNS
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE
from gradhesion.core.rate.scenes import move
from gradhesion.core.sweep import solve

_TYPES: Final = dict(zip(CURVES["path"], "dddibb", strict=True))
_MOST_POINTS: Final = 2**18
Curves: TypeAlias = dict[str, NDArray[Any]]


def _path_of(states: ArrayLike, *, unloading: bool) -> Curves:
    """Return the variables of a path from states, (3, points): contact is one branch, and nothing jumps."""
    radius, depth, load = np.asarray(states, dtype=float)
    columns = (radius, depth, load, radius > 0.0, 0.0 * radius, np.full(radius.size, unloading))
    return {name: column.astype(_TYPES[name]) for name, column in zip(CURVES["path"], columns, strict=True)}


def draw_at_speed(
    scene: Mapping[str, float],
    curves: Sequence[str],
    rate: Rate,
    known: Mapping[str, Any],
    draw_at_rest: Callable[[Mapping[str, float], Sequence[str]], tuple[Curves, int]],
) -> tuple[Curves, int]:
    """Return curves of one scene with a speed: variables and status, as those of other scenes.

    The path is that of the moving edge, `path_branch` being 1 in contact; the other curves are those of an edge at
    rest. At speed 0 all are. There are no jumps, and the curve "jumps" is refused. `known` has profile and loading;
    `draw_at_rest` draws curves of a scene without a speed, of the same.
    """
    rest = {name: value for name, value in scene.items() if name != SPEED}
    if scene[SPEED] == 0.0 or "path" not in curves:
        return draw_at_rest(rest, curves)
    if "jumps" in curves:
        raise ValueError("an edge with a speed has no jumps: each radius is passed once")
    found, status = draw_at_rest(rest, [curve for curve in curves if curve != "path"])
    one, how = {name: np.full(1, value) for name, value in {CLOSING: 1.0, **scene}.items()}, {**known, "threads": 1}
    solved = solve(one, ["turning_radius", "delta_jump_out", "pull_off_force"], rate=rate, **how)
    status |= int(solved["status"][0])
    if status & NO_VALUE:
        return found | {name: np.full(1, np.nan if t == "d" else -1, t) for name, t in _TYPES.items()}, status
    if status & NO_CONTACT:
        return found | _path_of([[0.0], [scene[TURNS[0]]], [0.0]], unloading=False), status
    if rate.closing == "quasi-static":
        path, _ = draw_at_rest({CLOSING: 1.0, **rest}, ["path"])
        up = {name: path[name][path["path_unloading"] == 0] for name in _TYPES}
    else:
        up = _path_of(
            np.insert(move(one, rate, how, opens=False, points=_MOST_POINTS)["track"], 0, 0.0, axis=1), unloading=False
        )
    opened = move(one | {"a_max_over_R": solved["turning_radius"]}, rate, how, opens=True, points=_MOST_POINTS)
    down = _path_of(np.append(opened["track"], [[0.0], solved["delta_jump_out"], [0.0]], axis=1), unloading=True)
    return found | {name: np.concatenate([up[name], down[name]]) for name in _TYPES}, status
