"""Sensitivities of cycles that open at a larger work of adhesion than they close at.

    H = Gamma L(modulus/Gamma) + U(modulus) + (1 - Gamma) area(a_t)

L is lost on loading and U on unloading from a_t. The sensitivity to modulus is at constant w_c/w_o, that to Gamma is

    dH/d ln Gamma = Gamma (L - dL/d ln modulus) - Gamma area(a_t)

and where a cycle turns at a depth or a load a_t moves (works/turn_slopes.py), which changes the energy of the edge, and
the other two where unloading jumps from a_t at once.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.cosine import SLOPES
from gradhesion.core.arrays.prepared import prepared
from gradhesion.core.closed.pattern import pattern_area, toughness_at
from gradhesion.core.problem.material import theta_slopes
from gradhesion.core.problem.names import CLOSING, PARAMETERS, PATTERN, SENSITIVITIES, TURNS
from gradhesion.core.problem.results import LOADING_PART, UNLOADING_PART
from gradhesion.core.problem.status import PULL_OFF_AT_RIM
from gradhesion.core.sensitivities.cosine_slopes import BY_EXPONENT, BY_RIM, BY_STIFFNESS, COUNT, ENERGY, FORCE
from gradhesion.core.sensitivities.sensitivity import MACHINE, by_parameters
from gradhesion.core.sweep import How, solve, up_to_rims
from gradhesion.core.works.cycle import LEAST, closing_parameters
from gradhesion.core.works.front import edge_area, front_energy, pattern_of
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
    known: dict[str, Any] = {"threads": how.threads, "profile": how.profile, "loading": how.loading}
    known |= {"toughness": how.toughness, "check_contact": False}

    def change(names: Sequence[str], down: float) -> Array:
        total = np.zeros(int(where.sum()))
        for step, weight in _CENTRAL.items():
            moved = dict(scenes)
            for name in names:
                size = _STEP * step * down
                moved[name] = scenes[name] + size if name in PARAMETERS[:2] else scenes[name] * np.exp(size)
            total += weight * np.log(solve(moved, ["turning_radius"], **known)["turning_radius"]) / _STEP
        return total

    made = [name for name in ("modulus", "load_max") if name in scenes]
    return np.stack([*(change([name], 1.0) for name in names), change(made, -1.0)], axis=-1)


def _add_pattern(
    rims: Mapping[str, ArrayLike], by_load: bool, how: How, values: Array, reduced: Array
) -> tuple[Array, Array]:
    """Add what a pattern of toughness adds to the depths or loads at radii, and to their slopes `reduced`, in place.

    It is -(kappa - 1) Delta, of a load K a^(1+k) times that. Returns the sums, and their slopes by ln of wavelength and
    amplitude of the pattern.
    """
    assert how.toughness is not None  # noqa: S101
    plain = {name: value for name, value in rims.items() if name not in PATTERN}
    scenes = prepared(plain, how.loading)
    k, stretch = (scenes.of_each(one).reshape(scenes.shape) for one in (scenes.k, scenes.stretch))
    radius = np.asarray(rims["a_max_over_R"], dtype=float)
    kappa, outwards, upwards = toughness_at(how.toughness, *pattern_of(rims), radius)
    size = stretch * radius ** (0.5 * (1.0 - k))
    by_radius, by_stiffness, by_k = 0.5 * (1.0 - k), -0.5, 0.5 * (np.log(2.0) - np.log(radius))
    if by_load:  # M = 2^(1+k) pi/s^2 and K = 2^(1-k) M/(1+k), in units of 1.5 pi
        size = size * 4.0 * np.pi / ((1.0 + k) * stretch**2) * radius ** (1.0 + k) / (1.5 * np.pi)
        by_radius, by_stiffness = by_radius + 1.0 + k, 0.5
        by_k = by_k - np.log(2.0) - 1.0 / (1.0 + k) + np.log(radius)
    own = (1.0 - kappa) * size
    reduced[BY_STIFFNESS] += by_stiffness * own
    reduced[BY_RIM] += by_radius * own - outwards * size
    reduced[BY_EXPONENT] += by_k * own
    return values + own, np.stack([outwards * size, -upwards * size], axis=-1)


def _radius_slopes(
    closing: Mapping[str, ArrayLike], radius: Array, turn: str, material: tuple[Array, Array], how: How
) -> Array:
    """Return d ln a_t/d ln p (k, nu: /dp) along a last axis; 0 at a rim but to the rim itself.

    It is to the parameters, a machine, the turn, Gamma, and those of `PATTERN` that are given.
    """
    limits = np.broadcast_to(np.asarray(closing["a_max_over_R"], dtype=float), radius.shape)
    moves = (radius > 0.0) & (radius < limits)
    target = np.broadcast_to(np.asarray(closing[turn], dtype=float), radius.shape)
    rims = {name: value for name, value in closing.items() if name != turn} | {"a_max_over_R": radius}
    by_load = turn == "load_max"
    patterns = [name for name in PATTERN if name in closing]
    of_patterns = np.zeros((*radius.shape, 0))
    with np.errstate(all="ignore"):
        values, slopes = turn_slopes({name: rims[name] for name in rims if name not in PATTERN}, by_load, how)
        if how.toughness is not None:
            slopes = np.array(np.broadcast_to(slopes, (len(slopes), *radius.shape)))
            values, of_patterns = _add_pattern(rims, by_load, how, values, slopes)
            of_patterns = of_patterns[..., [PATTERN.index(name) for name in patterns]]
        by = by_parameters(rims, material, slopes, np.ones(radius.shape))
        steepness = by[..., _RIM]
        own = target / steepness
        ratio = by[..., _MODULUS] / steepness - (own if by_load else 0.0)
        found = -by / steepness[..., None]
        found[..., _RIM] = 0.0
        last = -of_patterns / steepness[..., None]
        found = np.concatenate([found, own[..., None], ratio[..., None], last], axis=-1)
        passed = moves & (abs(values - target) > _PASSED * (abs(values) + abs(steepness)))
    if passed.any():
        names = [name for name in (*PARAMETERS, MACHINE, *TURNS) if name in closing]
        each = _radius_by_differences(closing, passed, [*names, *patterns], how)
        count = len(names)
        found[passed] = np.concatenate([each[:, :count], each[:, -1:], each[:, count:-1]], axis=-1)
    found[~moves] = 0.0
    found[~moves, _RIM] = 1.0
    return found


class _Edge(NamedTuple):
    """The energy of the edge, and its slopes by the logarithms of a_t, Gamma, and those of `PATTERN` that are given."""

    energy: Array
    by_radius: Array
    by_ratio: Array
    by_pattern: Array


def _edge_of(parameters: Mapping[str, ArrayLike], how: How, ratio: Array, radius: Array) -> _Edge:
    """Return the energy of edges that turn at radii a_t/R, with its slopes."""
    area = edge_area(parameters, how, radius)
    by_pattern = np.zeros((*radius.shape, 0))
    with np.errstate(all="ignore"):
        outwards = 2.0 * np.pi * radius * radius
        if how.toughness is not None:
            size, length = pattern_of(parameters)
            outwards = outwards * toughness_at(how.toughness, size, length, radius)[0] ** 2
            other = pattern_area(how.toughness, -size, length, radius)  # a polynomial of degree 2 in the amplitude
            upwards = 0.5 * (area - other) + (area + other) - 2.0 * np.pi * radius * radius
            each = {PATTERN[0]: 2.0 * area - outwards, PATTERN[1]: upwards}
            given = [each[name] for name in PATTERN if name in parameters]
            by_pattern = (1.0 - ratio)[..., None] * np.stack(given, axis=-1)
        return _Edge(front_energy(ratio, area), (1.0 - ratio) * outwards, -ratio * area, by_pattern)


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
    Arrays of shape (*scenes, n): to the seven parameters, to machine_stiffness and the one of `TURNS` if there are
    such, to closing_ratio, one-sided at 1 and 0 at 0, and to those of `PATTERN` that are given. NaN where the value is
    not positive and finite, and to the closing ratio of the energy of an unbounded punch that does not turn.
    """
    requested = [name for name in SENSITIVITIES if name in outputs]
    scenes = {name: value for name, value in parameters.items() if name != CLOSING}
    known: dict[str, Any] = {"threads": how.threads, "profile": how.profile, "loading": how.loading}
    known |= {"toughness": how.toughness}
    turn = next((name for name in TURNS if name in scenes), None)
    cycle = solve(parameters, ["turning_radius"], check_contact=False, **known)
    radius = cycle["turning_radius"]
    shape = radius.shape
    ratio = np.broadcast_to(np.asarray(parameters[CLOSING], dtype=float), shape)
    closing = closing_parameters(scenes, ratio)
    limits = np.broadcast_to(np.asarray(scenes["a_max_over_R"], dtype=float), shape)
    rims = {"a_max_over_R": np.where(radius > 0.0, radius, limits)}
    turned, bare = turn is not None, how._replace(check_contact=False)
    up = {name: value for name, value in closing.items() if name != turn} | rims
    down = {name: value for name, value in scenes.items() if name != turn} | rims
    loaded = up_to_rims(up, ["loading_energy"], bare, (False, LOADING_PART), turned=turned)
    wanted = ["pull_off_force", "pull_off_radius", "unloading_energy"]
    opened = up_to_rims(down, wanted, bare, (True, UNLOADING_PART), turned=turned)
    material = theta_slopes(parameters["k"], parameters["nu"])
    by_turn = _radius_slopes(closing, radius, turn, material, how) if turn else None
    rows = [row for row, name in enumerate(PATTERN, COUNT) if name in scenes]

    def part(where: Mapping[str, ArrayLike], found: Mapping[str, NDArray[Any]], row: int, value: Array) -> Array:
        """Return the slopes of a part of a value, which may be negative: parameters, a machine, and the pattern."""
        own = by_parameters(where, material, found[SLOPES][row], np.ones(shape))
        more = np.moveaxis(found[SLOPES][row][rows], 0, -1)
        slopes = np.concatenate([own, more], axis=-1) * value[..., None]
        return np.where((value == 0.0)[..., None], 0.0, slopes)

    found: dict[str, NDArray[Any]] = {"status": cycle["status"]}
    last = len(rows)
    for name in requested:
        with np.errstate(all="ignore"):
            if name == SENSITIVITIES[0]:
                value = opened["pull_off_force"]
                by = part(down, opened, FORCE, value)
                by[(opened["status"] & PULL_OFF_AT_RIM) == 0, _RIM] = 0.0
                by_ratio = np.zeros(shape)
            else:
                edge = _edge_of(scenes, how, ratio, radius)
                loss, gain = np.maximum(ratio, LEAST) * loaded["loading_energy"], opened["unloading_energy"]
                value = loss + gain + edge.energy
                by_loss = part(up, loaded, ENERGY, loss)
                by = by_loss + part(down, opened, ENERGY, gain)
                by_ratio = loss - by_loss[..., _MODULUS] + edge.by_ratio
                by[..., _RIM] += edge.by_radius
                by[..., by.shape[-1] - last :] += edge.by_pattern
            plain, pattern = by[..., : by.shape[-1] - last], by[..., by.shape[-1] - last :]
            middle = [np.zeros((*shape, 1))] if turn else []
            total = np.concatenate([plain, *middle, by_ratio[..., None], pattern], axis=-1)
            if by_turn is not None:
                moved = by[..., _RIM, None].copy()
                total[..., _RIM] = 0.0
                total += moved * by_turn
            to_ratio = total.shape[-1] - 1 - last
            total[..., to_ratio] = np.where(ratio == 0.0, 0.0, total[..., to_ratio])
            total = total / value[..., None]
        total[~((value > 0.0) & np.isfinite(value))] = np.nan
        total[~np.isfinite(total)] = np.nan
        found[name] = total
    even = ratio == 1.0
    if even.any():
        own = [item for item in range(found[requested[0]].shape[-1]) if item != to_ratio]
        alike = solve(scenes, requested, **known)
        for name in requested:
            found[name][..., own] = np.where(even[..., None], alike[name], found[name][..., own])
    return found
