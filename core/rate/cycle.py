"""Cycles whose edge opens at a work that grows with its speed, and closes at rest or by the same law.

Each radius is passed once, so that there are no jumps. With area the integral of 2 pi a up to the turning radius a_t,
H_open and H_close those of 2 pi a G,

    dissipated_energy = H_open - H_close = loading_energy + unloading_energy + front_energy
    unloading_energy = H_open - area,   front_energy = (1 - Gamma) area,   loading_energy = Gamma area - H_close

in R^2 w_o; where the contact closes at rest loading_energy is lost in its jumps (works/cycle.py). At speed 0 a cycle
is that of an edge at rest, to the bit.
"""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.rate import close_at_speed, open_at_speed, rate_coefficient
from gradhesion.core.arrays.turned import Results
from gradhesion.core.compiler.marks import note_compiled
from gradhesion.core.problem.names import CLOSING, EDGE, OUTPUTS, PARAMETERS, RATE, SPEED, TURNS
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_CONTACT, NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.sweep import How, solve
from gradhesion.core.works.front import adhesive_depth, front_energy

KNOWN: Final = (*(name for name in OUTPUTS if not name.endswith("_jumps")), *EDGE, *RATE)
"""Results of such a cycle."""
_OF_OPENING: Final = ("pull_off_force", "pull_off_radius", "unloading_energy", "delta_jump_out", *RATE)
_OF_CLOSING: Final = ("loading_energy", "front_energy", "snap_in_force", "pinned_depth", "delta_max", "turning_radius")
_WITHOUT_CONTACT: Final = dict.fromkeys(("pull_off_radius", "delta_jump_out", "snap_in_force", RATE[0]), math.nan)
"""Results without a value where there is no contact; all others are 0 then."""
_STEPS: Final = 60
_SURE: Final = 4.0 * 2.0**-52
Array = NDArray[np.float64]


def _turned_at_a_depth(scenes: dict[str, Array], target: Array, how: How, rate: Rate) -> Results:
    """Close contacts by a machine until the depth reaches a target: where its far end has to be is searched (secants).

    The depth grows with it as long as the machine goes on.
    """

    def closed(end: Array) -> Results:
        return close_at_speed({**scenes, "delta_max": end}, rate, how.profile, how.loading, how.threads)

    low, high = np.zeros(target.shape), np.maximum(target, 1e-12)
    found = closed(high)
    for _ in range(_STEPS):
        short = found["depth_at_turn"] < target
        short &= found["coordinate_at_turn"] >= high * (1.0 - 1e-12)  # else the rim is reached first
        if not short.any():
            break
        low, high = np.where(short, high, low), np.where(short, 2.0 * high, high)
        found = closed(high)
    reached = found["depth_at_turn"] >= target
    for _ in range(_STEPS):
        middle = 0.5 * (low + high)
        if not (reached & (high - low > _SURE * high)).any():
            break
        here = closed(middle)["depth_at_turn"]
        low, high = np.where(here < target, middle, low), np.where(here < target, high, middle)
    return closed(high)


def _closed(parameters: dict[str, Array], ratio: Array, how: How, rate: Rate) -> Results:
    """Return the results of contacts that close by the same law, by the names of `_OF_CLOSING`, and `status`."""
    depth = parameters.get(TURNS[0], np.asarray(math.inf))
    scenes = {name: value for name, value in parameters.items() if name != TURNS[0]} | {CLOSING: ratio}
    if how.loading.control == "machine" and np.isfinite(depth).any():
        made = _turned_at_a_depth(scenes, np.asarray(depth), how, rate)
    else:
        made = close_at_speed({**scenes, "delta_max": depth}, rate, how.profile, how.loading, how.threads)
    radius = made["turning_radius"]
    adhesion, spring = adhesive_depth(scenes, how, radius)
    area = math.pi * radius * radius
    return {
        "turning_radius": radius,
        "delta_max": made["depth_at_turn"],
        "loading_energy": ratio * area - made["closing_energy"],
        "front_energy": front_energy(ratio, area),
        "snap_in_force": np.full(radius.shape, math.nan),
        "pinned_depth": (1.0 - made["rho_edge_stops"]) * adhesion * (1.0 + spring),
        "status": made["status"],
    }


def far_end_at_depth(scene: Mapping[str, float], how: How, rate: Rate) -> float:
    """Return where the far end of a machine is, in R, when the depth of one scene reaches that at which it turns."""
    arrays = {name: np.full(1, value, dtype=float) for name, value in scene.items() if name != TURNS[0]}
    return float(
        _turned_at_a_depth({CLOSING: np.ones(1), **arrays}, np.full(1, scene[TURNS[0]]), how, rate)[
            "coordinate_at_turn"
        ][0]
    )


def solve_at_speed(parameters: Mapping[str, ArrayLike], outputs: Sequence[str], how: How, rate: Rate) -> Results:
    """Solve scenes whose edge moves at a speed.

    Parameters
    ----------
    parameters
        As those of `solve` of core/sweep.py, and speed_over_reference V/v* >= 0, which broadcasts with them.
    outputs
        Names out of `KNOWN`: edge_speed_at_pull_off in v*, rate_coefficient the factor of (V/v*)^n in F/F_0 - 1 of a
        slow edge (NaN where the pull-off at rest is at the turning radius), and those of edges at rest.
    how, rate
        How the scenes are solved, and the law.

    Returns
    -------
    The outputs and `status` (int16), of the broadcast shape. A finite radius of the punch or a turn is needed: without
    either there is no value. snap_in_force is NaN where the contact closes by the same law, which has no jump.
    """
    given = {name: np.asarray(value, dtype=float) for name, value in parameters.items()}
    speed = given.pop(SPEED)
    shape = np.broadcast_shapes(speed.shape, *(value.shape for value in given.values()))
    rest = np.broadcast_to(speed == 0.0, shape)
    ratio = given.pop(CLOSING, np.asarray(1.0))
    known: dict[str, Any] = {"threads": how.threads, "profile": how.profile, "loading": how.loading}
    known["check_contact"] = how.check_contact
    found: Results = {"status": np.zeros(shape, dtype=np.int16)}
    found |= {name: np.full(shape, math.nan) for name in outputs}
    at_rest = {**given, CLOSING: ratio}
    still = [name for name in outputs if name not in RATE]
    held = rate.closing == "quasi-static"
    wanted = [name for name in _OF_CLOSING if name in {*outputs, "turning_radius"} or "dissipated_energy" in outputs]
    if held or rest.any():
        quiet = solve(at_rest, [*dict.fromkeys([*(still if rest.any() else ()), *wanted])], **known)
        for name in (*(name for name in still if rest.any()), "status"):
            found[name] = np.where(rest, quiet[name], found[name]).astype(found[name].dtype)
    if RATE[0] in outputs:
        found[RATE[0]] = np.where(rest & ((found["status"] & (NO_VALUE | NO_CONTACT)) == 0), 0.0, math.nan)
    moves = ~rest
    if moves.any():
        every = {name: np.broadcast_to(value, shape)[moves] for name, value in (given | {SPEED: speed}).items()}
        own = np.broadcast_to(ratio, shape)[moves]
        if held:
            closed = {name: np.broadcast_to(quiet[name], shape)[moves] for name in (*wanted, "status")}
        else:
            closed = _closed(every, own, how, rate)
        _put_moving(found, moves, every, closed, outputs, how, rate)
    if RATE[1] in outputs:
        slow: dict[str, Any] = {name: given[name] for name in (*PARAMETERS, "machine_stiffness") if name in given}
        turned = found if "turning_radius" in found else solve(at_rest, ["turning_radius"], **known)
        radius = turned["turning_radius"]
        slow["a_max_over_R"] = np.where(radius > 0.0, radius, math.nan)
        found[RATE[1]] = np.broadcast_to(rate_coefficient(slow, rate, how.profile, how.loading, how.threads), shape)
    note_compiled("rate")
    return {name: found[name] for name in (*outputs, "status")}


def _put_moving(
    found: Results,
    moves: NDArray[np.bool_],
    scenes: Mapping[str, Array],
    closed: Results,
    outputs: Sequence[str],
    how: How,
    rate: Rate,
) -> None:
    """Open the scenes that move, and put their values into `found`."""
    radius, bits = closed["turning_radius"], closed["status"].astype(np.int16)
    away = (bits & NO_CONTACT) != 0
    names = (*PARAMETERS, SPEED, "machine_stiffness")
    edge = {name: scenes[name] for name in names if name in scenes} | {"a_max_over_R": np.where(away, 1.0, radius)}
    requested = [
        name
        for name in _OF_OPENING
        if name in outputs or (name == "unloading_energy" and "dissipated_energy" in outputs)
    ]
    requested = [name for name in requested if name != RATE[1]]
    opened = open_at_speed(edge, rate, how.profile, how.loading, how.threads, outputs=requested)
    values = {
        **{name: closed[name] for name in closed if name != "status"},
        **{name: opened[name] for name in requested},
    }
    if "dissipated_energy" in outputs:
        values["dissipated_energy"] = values["loading_energy"] + values["unloading_energy"] + values["front_energy"]
    kept = NO_VALUE | NO_CONTACT | LOADING_NOT_ONE_DISC | CLOSE_TO_A_JUMP
    status = (bits & kept) | np.where(away, 0, opened["status"])
    if not {*outputs} & {"pull_off_force", "pull_off_radius", RATE[0]}:
        status &= ~PULL_OFF_AT_RIM
    none = (status & NO_VALUE) != 0
    for name in (name for name in outputs if name in values):
        own = np.where(away & (name != "delta_max"), _WITHOUT_CONTACT.get(name, 0.0), values[name])
        found[name][moves] = np.where(none, math.nan, own)
    found["status"][moves] = status
