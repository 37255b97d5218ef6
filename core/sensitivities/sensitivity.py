"""Sensitivities: how strongly the pull-off force and the dissipated energy depend on each parameter of a scene.

    d ln(value)/d ln p,    for k and nu, which may be 0, d ln(value)/dp

at fixed other parameters. The material enters through M = theta(k, nu) modulus c0^-k alone, so that with m the
sensitivity to M those to modulus, c0 and nu are m, -k m and m d ln theta/d nu, and that to k is the one at fixed M with
m (d ln theta/dk - ln c0) more.

Of a cycle that turns at a depth or a load the energy depends on the turn only by steps, and the force only where it is
met there: at a depth d(a_t) the place a_t moves by -(dd/dp)/(dd/da).
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.material import theta_slopes
from gradhesion.core.problem.names import PARAMETERS, PATTERN, SENSITIVITIES, TURNS
from gradhesion.core.problem.status import PULL_OFF_AT_RIM
from gradhesion.core.sensitivities.cosine_slopes import BY_RIM, COUNT

NEEDED: Final = {
    "pull_off_force_sensitivity": ("pull_off_force", "pull_off_radius"),
    "dissipated_energy_sensitivity": ("dissipated_energy",),
}
"""The results that a sensitivity starts from; the first is the value itself."""
MACHINE: Final = "machine_stiffness"
_STEP: Final = 2e-3
_FORWARD: Final = (-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25)
"""For a force that occurs where a jump lands beyond the turn: the one case by differences, accurate to 1e-9."""


def by_parameters(
    parameters: Mapping[str, ArrayLike],
    slopes: tuple[NDArray[np.float64], NDArray[np.float64]],
    reduced: NDArray[np.float64],
    values: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return the sensitivities to the seven parameters of a scene along a last axis, and to that of a machine.

    Parameters
    ----------
    parameters
        Those of the scenes.
    slopes
        What `theta_slopes` gives of their k and nu.
    reduced
        The sensitivities to M, lambda, A, a_max, that to k at fixed M, and that to the machine; shape (6 or more,
        *scenes).
    values
        Those whose sensitivities they are; shape `scenes`.
    """
    k, _, _, c0_over_R, _, amplitude, rim = (np.asarray(parameters[name], dtype=float) for name in PARAMETERS)
    stiffness, wavelength, height, radius, exponent, machine = reduced[:COUNT]
    by_k, by_nu = slopes
    driven = MACHINE in parameters
    found = np.empty((*values.shape, len(PARAMETERS) + driven))
    with np.errstate(all="ignore"):  # what is out of range has no value
        found[..., 0] = exponent + stiffness * (by_k - np.log(c0_over_R))
        found[..., 1] = stiffness * by_nu
        found[..., 2] = stiffness + machine if driven else stiffness  # the machine's is over that of the half-space
        found[..., 3] = np.where(k == 0.0, 0.0, -k * stiffness)
        found[..., 4] = np.where(amplitude == 0.0, 0.0, wavelength)
        found[..., 5] = np.where(amplitude == 0.0, 0.0, height)
        found[..., 6] = np.where(np.isinf(rim), 0.0, radius)
        if driven:
            found[..., 7] = machine
        found[~(values > 0.0)] = np.nan
    return found


def wanted_for(outputs: Sequence[str], *, turned: bool = False) -> list[str]:
    """Return the results that are solved for outputs: sensitivities start from values, and from where cycles turn.

    Examples
    --------
    >>> wanted_for(["dissipated_energy_sensitivity"])
    ['dissipated_energy']
    """
    requested = [name for name in outputs if name in SENSITIVITIES]
    more = [one for name in requested for one in NEEDED[name]]
    if turned and "pull_off_force_sensitivity" in requested:
        more.append("delta_max")
    if turned and requested:
        more.append("turning_radius")
    return list(dict.fromkeys([*(name for name in outputs if name not in requested), *more]))


def _move_with_turn(
    turn: str,
    target: NDArray[np.float64],
    moves: NDArray[np.bool_],
    passed: NDArray[np.bool_],
    reduced: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Let the place where a cycle turns move with the parameters, for forces that are met there.

    Returns
    -------
    The sensitivity of the force to where the cycle turns, and where nothing is known yet: where a jump has passed what
    the cycle turns at. `reduced` is changed in place.
    """
    held = moves & ~passed if turn == "indentation_max_over_R" else np.full(moves.shape, False)
    force, depth = reduced[0], reduced[2]
    with np.errstate(all="ignore"):
        by_place = np.where(held, force[BY_RIM], 0.0)
        shift = by_place / depth[BY_RIM]
        by_turn = np.where(held, shift * target, 0.0)
        for row in (row for row in range(len(force)) if row != BY_RIM):
            force[row] = np.where(held, force[row] - shift * depth[row], force[row])
    force[BY_RIM] = np.where(moves, 0.0, force[BY_RIM])
    return by_turn, moves & ~held


def _by_differences(
    parameters: Mapping[str, ArrayLike],
    where: NDArray[np.bool_],
    force_of: Callable[[Mapping[str, ArrayLike]], NDArray[np.float64]],
) -> NDArray[np.float64]:
    """Return the sensitivities of the force of some scenes to all parameters by differences of fourth order."""
    given = {name: np.asarray(value, dtype=float) for name, value in parameters.items()}
    scenes = {name: np.broadcast_to(value, where.shape)[where] for name, value in given.items()}
    found = np.zeros((int(where.sum()), len(scenes)))
    names = [name for name in (*PARAMETERS, MACHINE, *TURNS, *PATTERN) if name in scenes]
    for i, name in enumerate(names):
        if name == "a_max_over_R":  # beyond where the cycle turns
            continue
        centre = scenes[name]
        step = np.full(centre.shape, _STEP) if name in PARAMETERS[:2] else _STEP * centre
        inside = step if name not in PARAMETERS[:2] else np.where(centre < 0.25, step, -step)
        values = [force_of(scenes | {name: centre + j * inside}) for j in range(5)]
        change = sum(weight * value for weight, value in zip(_FORWARD, values, strict=True)) / _STEP
        found[:, i] = change / values[0] * np.sign(inside / step)
    return found


def sensitivities(
    parameters: Mapping[str, ArrayLike],
    outputs: Sequence[str],
    solved: Mapping[str, NDArray[Any]],
    reduced: NDArray[np.float64],
    turn: str | None,
    passed: NDArray[np.bool_],
    force_of: Callable[[Mapping[str, ArrayLike]], NDArray[np.float64]],
) -> dict[str, NDArray[np.float64]]:
    """Return the requested sensitivities.

    Parameters
    ----------
    parameters, outputs
        As those of `solve`.
    solved
        What `wanted_for` names, and `status`.
    reduced
        The sensitivities to the numbers of a scene (`solve_general` of arrays/general.py).
    turn
        The one of `TURNS` that the cycles turn at, None for the rim.
    passed
        Whether a jump has passed what they turn at, so that they turn where it ends.
    force_of
        What gives the pull-off force of other scenes that turn as these do.

    Returns
    -------
    Arrays of shape (*scenes, 7), and one item more for the stiffness of a machine, for the turn, and for each of
    `PATTERN`, if there are such: they are the last ones. NaN where the value is not positive, and at k = 1 that to nu.
    """
    requested = [name for name in SENSITIVITIES if name in outputs]
    given = [name for name in (*PARAMETERS, MACHINE) if name in parameters]
    scenes: dict[str, ArrayLike] = {name: parameters[name] for name in given}
    shape = solved["status"].shape
    moves = np.full(shape, False)
    if turn is not None:
        limits = np.broadcast_to(np.asarray(parameters["a_max_over_R"], dtype=float), shape)
        radii = solved["turning_radius"]
        moves = radii < limits
        scenes["a_max_over_R"] = np.where(radii > 0.0, radii, limits)
    found, slopes = {}, theta_slopes(parameters["k"], parameters["nu"])
    for name in requested:
        part, values = SENSITIVITIES.index(name), solved[NEEDED[name][0]]
        to_turn, unknown = np.zeros(shape), np.full(shape, False)
        if turn is not None and part == 0:
            target = np.broadcast_to(np.asarray(parameters[turn], dtype=float), shape)
            met = moves & (radii > 0.0) & ((solved["status"] & PULL_OFF_AT_RIM) != 0)
            to_turn, unknown = _move_with_turn(turn, target, met, passed, reduced)
        one = by_parameters(scenes, slopes, reduced[part], values)
        if turn is not None:
            to_turn = np.where(values > 0.0, to_turn, np.nan)
            one = np.concatenate([one, to_turn[..., None]], axis=-1)
        for row in (row for row, key in enumerate(PATTERN, COUNT) if key in parameters):
            own = np.where(values > 0.0, reduced[part, row], np.nan)
            one = np.concatenate([one, own[..., None]], axis=-1)
        if unknown.any():
            one[unknown] = _by_differences(parameters, unknown, force_of)
        found[name] = one
    return found
