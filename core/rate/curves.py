"""Curves of one scene whose edge moves at a speed: the path by time, and the curves of the edge at rest.

The points of the path are the nodes of the steps by which the edge is followed: as many as its course needs. Between
loading and opening the contact is pinned, a straight line at the turning radius.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.arrays.rate import tracked
from gradhesion.core.curves.draw import draw_curves
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import CLOSING, CURVES, PARAMETERS, SPEED, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE
from gradhesion.core.rate.cycle import far_end_at_depth
from gradhesion.core.sweep import How, solve

_TYPES: Final = {"path_branch": np.int32, "path_jump": np.int8, "path_unloading": np.int8}
Curves = dict[str, NDArray[Any]]


def _path_of(states: NDArray[np.float64], *, unloading: bool) -> Curves:
    """Return the variables of a path from states, of shape (3, points): contact is one branch, and nothing jumps."""
    names, size = CURVES["path"], states.shape[1]
    inside = (states[0] > 0.0).astype(np.int32)
    columns = (*states, inside, np.zeros(size, np.int8), np.full(size, unloading, np.int8))
    return dict(zip(names, columns, strict=True))


def _joined(parts: Sequence[Curves]) -> Curves:
    """Return the parts of a path one after the other."""
    return {name: np.concatenate([part[name] for part in parts]) for name in CURVES["path"]}


def _nothing(depth: float, value: float) -> Curves:
    """Return a path of one point without contact."""
    path = _path_of(np.array([[value], [depth], [value]]), unloading=False)
    return (
        path
        if value == 0.0
        else {name: values if name not in _TYPES else -1 + 0 * values for name, values in path.items()}
    )


def _loading_of(scene: Mapping[str, float], rate: Rate, profile: Profile, loading: Loading, end: float) -> Curves:
    """Return loading: of an edge that closes at rest with its pinned stretch, or by the same law up to a depth."""
    if rate.closing == "quasi-static":
        rest = {name: value for name, value in scene.items() if name != SPEED}
        path, _ = draw_curves({CLOSING: 1.0, **rest}, ["path"], profile, loading)
        own = path["path_unloading"] == 0
        return {name: values[own] for name, values in path.items()}
    plain = {name: value for name, value in scene.items() if name not in TURNS}
    states = tracked({CLOSING: 1.0, **plain, "delta_max": end}, rate, profile, loading, inwards=False)
    return _path_of(np.concatenate([np.zeros((3, 1)), states], axis=1), unloading=False)


def draw_at_speed(
    scene: Mapping[str, float], curves: Sequence[str], profile: Profile, loading: Loading, rate: Rate
) -> tuple[Curves, int]:
    """Return curves of one scene with a speed, as `draw_curves` (curves/draw.py) those of other scenes.

    The path is that of the moving edge, `path_branch` being 1 in contact; the other curves are those of an edge at
    rest. At speed 0 all are. There are no jumps, and the curve "jumps" is refused.
    """
    rest = {name: value for name, value in scene.items() if name != SPEED}
    if scene[SPEED] == 0.0 or "path" not in curves:
        return draw_curves(rest, curves, profile, loading)
    if "jumps" in curves:
        raise ValueError("an edge with a speed has no jumps: each radius is passed once")
    found, status = draw_curves(rest, [curve for curve in curves if curve != "path"], profile, loading)
    how: dict[str, Any] = {"profile": profile, "loading": loading, "rate": rate, "threads": 1}
    solved = solve(scene, ["turning_radius", "delta_jump_out", "delta_max", "pull_off_force"], **how)
    status |= int(solved["status"])
    if status & (NO_VALUE | NO_CONTACT):
        value = np.nan if status & NO_VALUE else 0.0
        return found | _nothing(float(scene.get(TURNS[0], np.nan)), value), status
    radius = float(solved["turning_radius"])
    end = float(scene.get(TURNS[0], np.inf))
    if rate.closing == "same" and loading.control == "machine" and end < np.inf:
        end = far_end_at_depth(scene, How("exact", False, 1, profile, loading, is_one_wave=False), rate)
    up = _loading_of(scene, rate, profile, loading, end)
    names = (*PARAMETERS, SPEED, "machine_stiffness")
    edge = {name: scene[name] for name in names if name in scene} | {"a_max_over_R": radius}
    down = tracked(edge, rate, profile, loading, inwards=True)
    start = draw_curves({name: edge[name] for name in edge if name != SPEED}, ["equilibrium"], profile, loading)[0]
    first = np.array([[start[name][-1]] for name in ("contact_radius", "indentation", "load")])
    last = np.array([[0.0], [float(solved["delta_jump_out"])], [0.0]])
    path = _joined([up, _path_of(np.concatenate([first, down, last], axis=1), unloading=True)])
    return found | {name: values.astype(_TYPES.get(name, np.float64)) for name, values in path.items()}, status
