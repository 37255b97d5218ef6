"""Cycles whose edge opens at a work that grows with its speed, and closes at rest or by the same law; and their paths.

Each radius is passed once, so that there are no jumps. With area the integral of 2 pi a up to the turning radius a_t,
H_open and H_close those of 2 pi a G,

    dissipated_energy = H_open - H_close = loading_energy + unloading_energy + front_energy
    unloading_energy = H_open - area,   front_energy = (1 - Gamma) area,   loading_energy = Gamma area - H_close

in R^2 w_o; where the contact closes at rest loading_energy is lost in its jumps. At speed 0 a cycle is that of an edge
at rest, to the bit.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem import status as flags
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import (
    CLOSING,
    CURVES,
    EDGE,
    EXACT_ALONE,
    INTEGERS,
    OUTPUTS,
    PULL_OFF,
    RATE,
    SPEED,
    TURNS,
)
from gradhesion.core.problem.outputs import VARIABLES
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.problem.toughness import Rate
from gradhesion.core.rate.scenes import move
from gradhesion.core.sweep import solve

KNOWN: Final = (*(name for name in OUTPUTS if name not in (*INTEGERS, *EXACT_ALONE)), *EDGE, *RATE)
"""Results of such a cycle."""
_OF_CLOSING: Final = {"loading_energy", "front_energy", "snap_in_force", "pinned_depth", "delta_max", "turning_radius"}
_WITHOUT_CONTACT: Final = dict.fromkeys(("pull_off_radius", "delta_jump_out", "snap_in_force", RATE[0]), math.nan)
"""Results without a value where there is no contact; all others but delta_max are 0 then."""
_KEPT: Final = NO_VALUE | flags.TOO_MANY_WAVES | NO_CONTACT | flags.LOADING_NOT_ONE_DISC | flags.CLOSE_TO_A_JUMP
"""Bits of closing that are those of the cycle."""
_TYPES: Final = {name: VARIABLES[name].dtype for name in CURVES["path"]}
_MOST_POINTS: Final = 2**18
Results: TypeAlias = dict[str, NDArray[Any]]


def solve_at_speed(
    parameters: Mapping[str, ArrayLike], outputs: Sequence[str], rate: Rate, known: Mapping[str, Any]
) -> Results:
    """Solve scenes whose edge moves at a speed; arguments are those of `solve` of core/sweep.py.

    `outputs` are out of `KNOWN`: edge_speed_at_pull_off in v*, rate_coefficient the factor of (V/v*)^n in F/F_0 - 1
    of a slow edge (NaN where the pull-off at rest is at the turning radius), and those of edges at rest. A finite
    radius of the punch or a turn is needed: without either there is no value. snap_in_force is NaN where the contact
    closes by the same law, which has no jump; a turn at a load is refused there (ValueError).
    """
    given: dict[str, Any] = {CLOSING: 1.0} | {name: np.asarray(value, float) for name, value in parameters.items()}
    if rate.closing != "quasi-static" and TURNS[1] in given:
        raise ValueError(f"a contact that closes at a speed turns at a depth: give {TURNS[0]}, not {TURNS[1]}")
    shape = np.broadcast_shapes(*(np.shape(value) for value in given.values()))
    scenes = {name: np.broadcast_to(value, shape) for name, value in given.items()}
    at_rest, moves = {name: value for name, value in given.items() if name != SPEED}, scenes[SPEED] != 0.0
    wanted = {*outputs, *_OF_CLOSING, *PULL_OFF} - {*RATE}
    quiet = solve(at_rest, sorted(wanted), **{**known, "rate": None})
    quiet = {name: np.broadcast_to(values, shape) for name, values in quiet.items()}
    found: Results = {name: np.array(quiet.get(name, np.full(shape, math.nan))) for name in outputs}
    found["status"] = quiet["status"].astype(np.int16)
    if RATE[0] in outputs:
        found[RATE[0]] = np.where(found["status"] & (NO_VALUE | NO_CONTACT), math.nan, 0.0)
    if moves.any():
        moving, closed = ({name: values[moves] for name, values in of.items()} for of in (scenes, quiet))
        for name, values in _cycles(moving, closed, rate, known).items():
            if name in found:
                found[name][moves] = values
    if RATE[1] in outputs:
        found[RATE[1]] = np.broadcast_to(_rate_coefficient(at_rest, rate, quiet), shape)
    if not {*outputs} & {*PULL_OFF, RATE[0]}:
        found["status"] &= ~PULL_OFF_AT_RIM
    return found


def _cycles(scenes: Results, quiet: Results, rate: Rate, known: Mapping[str, Any]) -> Results:
    """Return all results of the cycles of moving edges, and `status`; `quiet` are results of closing at rest."""
    ratio, found = scenes[CLOSING], dict(quiet)
    if rate.closing == "same":
        found = move(scenes, rate, known, opens=False)
        area = math.pi * found["turning_radius"] ** 2
        found |= {"loading_energy": ratio * area - found["closing_energy"], "front_energy": (1.0 - ratio) * area}
        found["snap_in_force"] = np.full_like(area, math.nan)
    radius, bits = found["turning_radius"], found["status"].astype(np.int16) & _KEPT
    away = (bits & NO_CONTACT) != 0
    opened = move(scenes | {"a_max_over_R": np.where(away, 1.0, radius)}, rate, known, opens=True)
    found |= opened | {"unloading_energy": opened["opening_energy"] - math.pi * radius * radius}
    found["dissipated_energy"] = found["loading_energy"] + found["unloading_energy"] + found["front_energy"]
    status = bits | np.where(away, 0, opened["status"])
    for name in {*found} - {"delta_max"}:
        found[name] = np.where(away, _WITHOUT_CONTACT.get(name, 0.0), found[name])
    return {name: np.where(status & NO_VALUE, math.nan, found[name]) for name in found} | {"status": status}


def _rate_coefficient(parameters: Mapping[str, Any], rate: Rate, slow: Results) -> NDArray[np.float64]:
    """Return the factor of (V/v*)^n in F/F_0 - 1 of a slow edge, from the pull-off of one at rest.

    K a^(1+k) Delta/(2 F_0) (a/((1+k) Delta))^n, a being the radius of the pull-off F_0; NaN at the turning radius.
    """
    k, M = parameters["k"], stiffness(*(parameters[name] for name in ("k", "nu", "modulus", "c0_over_R")))
    force, a = 1.5 * math.pi * slow["pull_off_force"], slow["pull_off_radius"]
    with np.errstate(all="ignore"):
        adhesion = np.sqrt(2.0 ** (1.0 + k) * math.pi * a ** (1.0 - k) / M)
        pull = 2.0 ** (1.0 - k) * M / (1.0 + k) * a ** (1.0 + k) * adhesion
        found = pull / (2.0 * force) * (a / ((1.0 + k) * adhesion)) ** rate.exponent
    return np.where(slow["status"] & (PULL_OFF_AT_RIM | NO_VALUE), math.nan, found)


def draw_at_speed(
    scene: Mapping[str, float],
    curves: Sequence[str],
    rate: Rate,
    known: Mapping[str, Any],
    draw_at_rest: Callable[[Mapping[str, float], Sequence[str]], tuple[Results, int]],
) -> tuple[Results, int]:
    """Return curves of one scene with a speed: variables and status, as those of other scenes.

    The path is that of the moving edge, `path_branch` being 1 in contact: its points are the nodes of the steps, as
    many as its course needs, and a contact that is pinned is a straight line. The other curves are those of an edge at
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
        return found | {name: np.full(1, np.nan if t == "f8" else -1, t) for name, t in _TYPES.items()}, status
    if status & NO_CONTACT:
        return found | _path_of([[0.0], [scene[TURNS[0]]], [0.0]], unloading=False), status
    if rate.closing == "quasi-static":
        path, _ = draw_at_rest({CLOSING: 1.0, **rest}, ["path"])
        up = {name: path[name][path["path_unloading"] == 0] for name in _TYPES}
    else:
        closed = move(one, rate, how, opens=False, points=_MOST_POINTS)
        up = _path_of(np.insert(closed["track"], 0, 0.0, axis=1), unloading=False)
    opened = move(one | {"a_max_over_R": solved["turning_radius"]}, rate, how, opens=True, points=_MOST_POINTS)
    down = _path_of(np.append(opened["track"], [[0.0], solved["delta_jump_out"], [0.0]], axis=1), unloading=True)
    return found | {name: np.concatenate([up[name], down[name]]) for name in _TYPES}, status


def _path_of(states: ArrayLike, *, unloading: bool) -> Results:
    """Return the variables of a path from states, (3, points): contact is one branch, and nothing jumps."""
    radius, depth, load = np.asarray(states, dtype=float)
    columns = (radius, depth, load, radius > 0.0, 0.0 * radius, np.full(radius.size, unloading))
    return {name: column.astype(_TYPES[name]) for name, column in zip(CURVES["path"], columns, strict=True)}
