"""Sensitivities of cycles that open at a larger work of adhesion than they close at.

    H = Gamma L(modulus/Gamma) + U(modulus) + pi a_t^2 (1 - Gamma)

L is what loading loses and U what unloading from a_t does. So that to modulus holds w_c/w_o, and that to Gamma is

    dH/d ln Gamma = Gamma (L - dL/d ln modulus) - Gamma pi a_t^2

and where a cycle turns at a depth or a load a_t moves (works/turn_slopes.py), which changes the energy of the edge, and
the other two where unloading jumps from a_t at once.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.cosine import SLOPES
from gradhesion.core.problem.names import CLOSING, PARAMETERS, SENSITIVITIES, TURNS
from gradhesion.core.problem.results import LOADING_PART, UNLOADING_PART
from gradhesion.core.problem.status import PULL_OFF_AT_RIM
from gradhesion.core.sensitivities.cosine_slopes import ENERGY, FORCE
from gradhesion.core.sensitivities.material_slopes import theta_slopes
from gradhesion.core.sensitivities.sensitivity import MACHINE, by_parameters
from gradhesion.core.sweep import How, solve, up_to_rims
from gradhesion.core.works.cycle import LEAST, closing_parameters
from gradhesion.core.works.front import front_energy
from gradhesion.core.works.turn_slopes import turn_slopes

_RIM: Final = PARAMETERS.index("a_max_over_R")
_MODULUS: Final = PARAMETERS.index("modulus")
_STEP: Final = 2e-3
_CENTRAL: Final = {-2: 1.0 / 12.0, -1: -2.0 / 3.0, 1: 2.0 / 3.0, 2: -1.0 / 12.0}
_PASSED: Final = 1e-9
"""Distance of a depth or load from that at which a cycle turns, over its size, from which on a jump has passed it."""
Array = NDArray[np.float64]


def _radius_by_differences(
    closing: Mapping[str, ArrayLike], where: NDArray[np.bool_], names: Sequence[str], how: How
) -> Array:
    """Return d ln a_t/d ln p (k, nu: /dp) of some scenes that turn where a jump lands, good to 1e-9; the last is Gamma.

    Of what `closing_parameters` makes of the ratio, modulus and load_max, each goes as 1/Gamma.
    """
    scenes = {name: np.broadcast_to(np.asarray(value, float), where.shape)[where] for name, value in closing.items()}

    def change(names: Sequence[str], down: float) -> Array:
        total = np.zeros(int(where.sum()))
        for step, weight in _CENTRAL.items():
            moved = dict(scenes)
            for name in names:
                size = _STEP * step * down
                moved[name] = scenes[name] + size if name in PARAMETERS[:2] else scenes[name] * np.exp(size)
            radius = solve(moved, ["turning_radius"], threads=how.threads, profile=how.profile, loading=how.loading)
            total += weight * np.log(radius["turning_radius"]) / _STEP
        return total

    made = [name for name in ("modulus", "load_max") if name in scenes]
    return np.stack([*(change([name], 1.0) for name in names), change(made, -1.0)], axis=-1)


def _radius_slopes(
    closing: Mapping[str, ArrayLike], radius: Array, turn: str, material: tuple[Array, Array], how: How
) -> Array:
    """Return d ln a_t/d ln p (k, nu: /dp) along a last axis: parameters, a machine, the turn, and Gamma; 0 at a rim."""
    limits = np.broadcast_to(np.asarray(closing["a_max_over_R"], dtype=float), radius.shape)
    moves = (radius > 0.0) & (radius < limits)
    target = np.broadcast_to(np.asarray(closing[turn], dtype=float), radius.shape)
    rims = {name: value for name, value in closing.items() if name != turn} | {"a_max_over_R": radius}
    by_load = turn == "load_max"
    values, slopes = turn_slopes(rims, by_load, how)
    by = by_parameters(rims, material, slopes, np.ones(radius.shape))
    with np.errstate(all="ignore"):
        steepness = by[..., _RIM]
        found = -by / steepness[..., None]
        own = target / steepness
        ratio = by[..., _MODULUS] / steepness - (own if by_load else 0.0)
        found[..., _RIM] = 0.0
        found = np.concatenate([found, own[..., None], ratio[..., None]], axis=-1)
        passed = moves & (abs(values - target) > _PASSED * (abs(values) + abs(steepness)))
    names = [name for name in (*PARAMETERS, MACHINE, *TURNS) if name in closing]
    if passed.any():
        found[passed] = _radius_by_differences(closing, passed, names, how)
    found[~moves] = 0.0
    found[~moves, _RIM] = 1.0
    return found


def two_work_sensitivities(
    parameters: Mapping[str, ArrayLike], outputs: Sequence[str], how: How
) -> dict[str, NDArray[Any]]:
    """Return the sensitivities among `outputs`, and `status`.

    Parameters
    ----------
    parameters, outputs, how
        As those of `solve_two_works` (works/cycle.py).

    Returns
    -------
    Arrays of shape (*scenes, n): to the seven parameters, and to machine_stiffness and the one of `TURNS` if there are
    such; that to closing_ratio, if it is given, is the last one: one-sided at 1, and 0 at 0. NaN where the value is not
    positive and finite, and to the closing ratio of the energy of an unbounded punch that does not turn.
    """
    asked = [name for name in SENSITIVITIES if name in outputs]
    ratio = np.asarray(parameters[CLOSING], dtype=float)
    scenes = {name: value for name, value in parameters.items() if name != CLOSING}
    known: dict[str, Any] = {"threads": how.threads, "profile": how.profile, "loading": how.loading}
    turn = next((name for name in TURNS if name in scenes), None)
    shape = np.broadcast_shapes(ratio.shape, *(np.shape(value) for value in scenes.values()))
    ratio = np.broadcast_to(ratio, shape)
    closing = closing_parameters(scenes, ratio)
    cycle = solve(parameters, ["turning_radius"], check_contact=False, **known)
    radius = cycle["turning_radius"]
    limits = np.broadcast_to(np.asarray(scenes["a_max_over_R"], dtype=float), shape)
    rims = {"a_max_over_R": np.where(radius > 0.0, radius, limits)}
    turned = turn is not None
    bare = how._replace(check_contact=False)
    up = {name: value for name, value in closing.items() if name != turn} | rims
    down = {name: value for name, value in scenes.items() if name != turn} | rims
    loaded = up_to_rims(up, ["loading_energy"], bare, (False, LOADING_PART), turned=turned)
    wanted = ["pull_off_force", "pull_off_radius", "unloading_energy"]
    opened = up_to_rims(down, wanted, bare, (True, UNLOADING_PART), turned=turned)
    material = theta_slopes(parameters["k"], parameters["nu"])
    by_radius = _radius_slopes(closing, radius, turn, material, how) if turn else None
    found: dict[str, NDArray[Any]] = {"status": cycle["status"]}
    for name in asked:
        if name == SENSITIVITIES[0]:
            value = opened["pull_off_force"]
            at_rim = (opened["status"] & PULL_OFF_AT_RIM) != 0
            by = by_parameters(down, material, opened[SLOPES][FORCE], value) * value[..., None]
            by[~at_rim, _RIM] = 0.0
            by_ratio = np.zeros(shape)
        else:
            loss, gain = np.maximum(ratio, LEAST) * loaded["loading_energy"], opened["unloading_energy"]
            front, signs = front_energy(ratio, radius), np.ones(shape)  # either part may gain energy
            value = loss + gain + front
            by_loss = _times(by_parameters(up, material, loaded[SLOPES][ENERGY], signs), loss)
            by = by_loss + _times(by_parameters(down, material, opened[SLOPES][ENERGY], signs), gain)
            with np.errstate(invalid="ignore"):
                by_ratio = loss - by_loss[..., _MODULUS] - np.pi * ratio * radius * radius
            by[..., _RIM] += 2.0 * front
        with np.errstate(all="ignore"):
            columns = [by, np.zeros((*shape, 1)), by_ratio[..., None]] if turn else [by, by_ratio[..., None]]
            total = np.concatenate(columns, axis=-1)
            if by_radius is not None:
                moved = by[..., _RIM, None].copy()
                total[..., _RIM] = 0.0
                total += moved * by_radius
            total[..., -1] = np.where(ratio == 0.0, 0.0, total[..., -1])
            total = total / value[..., None]
        total[~((value > 0.0) & np.isfinite(value))] = np.nan
        total[~np.isfinite(total)] = np.nan
        found[name] = total
    even = ratio == 1.0
    if even.any():
        plain = solve(scenes, asked, **known)
        for name in asked:
            found[name][..., :-1] = np.where(even[..., None], plain[name], found[name][..., :-1])
    return found


def _times(slopes: Array, value: Array) -> Array:
    """Return logarithmic slopes times their value: 0 where there is nothing that changes."""
    return np.where((value == 0.0)[..., None], 0.0, slopes * value[..., None])
