"""Cycles that open at a larger work of adhesion than they close at: loading on one curve, unloading on another one.

dgamma is the work of opening w_o; w_c = Gamma w_o that of closing. Loading is that of a punch whose work is w_c, for
which modulus is modulus/Gamma and a load in units of w_o is load/Gamma; it turns at a radius a_t, and unloading is that
of the given punch with its rim there. With energies in R^2 w_o

    dissipated = Gamma loading_energy(modulus/Gamma) + unloading_energy(modulus; rim a_t) + front_energy

and the pull-off force is that of the opening curve up to a_t. At ratio 1 both are one curve.

Without adhesion on approach (ratio 0) the edge closes along the contact without adhesion. sqrt(Gamma) is what enters
its depth and load, and at Gamma = 2^-120 it is 1e-18, below rounding; the remainder of the jump-in, to a
radius at which neither depth nor load is more than that, is no jump. Smaller ratios than that have the same curve.
"""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.turned import Results
from gradhesion.core.problem.names import CLOSING, EDGE, REACH, SENSITIVITIES, TURNS
from gradhesion.core.problem.status import (
    CLOSE_TO_A_JUMP,
    JUMP_IN_TO_RIM,
    LOADING_NOT_ONE_DISC,
    NO_CONTACT,
    NO_VALUE,
    PULL_OFF_AT_RIM,
    TOLERANCE_NOT_MET,
    TOO_MANY_WAVES,
)
from gradhesion.core.sweep import How, solve, up_to_rims
from gradhesion.core.works.front import edge_area, front_energy, pinned_depth

LEAST: Final = 2.0**-120
"""The ratio below which closing is that without adhesion."""
_OF_LOADING: Final = ("loading_energy", "loading_jumps", "delta_max", REACH)
_OF_BOTH: Final = ("dissipated_energy", "dissipated_energy_error", "energy_residual")
"""Results that are sums over both curves."""
_PARTS: Final = ("loading_energy", "unloading_energy")
_FROM_BOTH: Final = (*_OF_BOTH, "loading_energy")
_RADII: Final = ("pull_off_radius", "delta_jump_out")
"""Results without a value where there is no contact; all others are 0 then."""
_GAINS: Final = {"adhesion_gain": "pull_off_force", "energy_gain": "dissipated_energy"}
_OF_THE_PUNCH: Final = ("roughness_parameter", "saturation_radius")
"""Results of the opening curve, whether or not contact is made."""
_LOADING_BITS: Final = (
    LOADING_NOT_ONE_DISC | JUMP_IN_TO_RIM | CLOSE_TO_A_JUMP | TOLERANCE_NOT_MET | NO_CONTACT | TOO_MANY_WAVES
)
_UNLOADING_BITS: Final = PULL_OFF_AT_RIM | CLOSE_TO_A_JUMP | TOLERANCE_NOT_MET | TOO_MANY_WAVES
_ROUNDING: Final = 16.0 * 2.0**-52
"""Error of the energy of the edge over its value, that of the radius at which it turns among it."""


def closing_parameters(parameters: Mapping[str, ArrayLike], ratio: NDArray[np.float64]) -> dict[str, ArrayLike]:
    """Return the scenes whose work of adhesion is that of closing; they broadcast as those given."""
    scenes = {name: value for name, value in parameters.items() if name != CLOSING}
    held = np.where((ratio >= 0.0) & (ratio <= 1.0), np.maximum(ratio, LEAST), np.nan)
    scenes["modulus"] = np.asarray(parameters["modulus"], dtype=float) / held
    if "load_max" in parameters:
        scenes["load_max"] = np.asarray(parameters["load_max"], dtype=float) / held
    return scenes


def _solve_in_front(
    scenes: Mapping[str, ArrayLike], ratio: NDArray[np.float64], wanted: Sequence[str], known: Mapping[str, Any]
) -> Results:
    """Solve scenes with the axes of the ratio first: scenes that differ in a_max alone stay together on one trace."""
    arrays = {name: np.asarray(value, dtype=float) for name, value in scenes.items()}
    dimensions = max(array.ndim for array in arrays.values())
    axes = [axis - ratio.ndim for axis in range(ratio.ndim) if ratio.shape[axis] > 1]
    first = list(range(len(axes)))
    arrays = {name: array.reshape((1,) * (dimensions - array.ndim) + array.shape) for name, array in arrays.items()}
    moved = {name: np.moveaxis(array, axes, first) for name, array in arrays.items()}
    found = solve(moved, wanted, **known)
    return {name: np.moveaxis(values, first, [axis + dimensions for axis in axes]) for name, values in found.items()}


def starts_downwards(parameters: Mapping[str, ArrayLike], how: How) -> NDArray[np.bool_]:
    """Report which punches are lower beside their tip than at it, so that contact without adhesion starts by a jump."""
    wavelength, amplitude = (np.asarray(parameters[name], dtype=float) for name in ("lambda_over_R", "A"))
    waves = how.profile.harmonics
    tip = 2.0 * np.pi * amplitude * sum(wave.n * wave.sin for wave in waves)
    bow = 2.0 * np.pi**2 * amplitude / wavelength * sum(wave.n**2 * wave.cos for wave in waves)
    m = how.profile.exponent
    tip, bow = tip + (m == 1.0), bow + (0.5 if m == 2.0 else np.inf if 1.0 < m < 2.0 else 0.0)
    return (tip < 0.0) | ((tip == 0.0) & (bow < 0.0))


def _without_adhesion(found: Results, ratio: NDArray[np.float64], jumps: NDArray[np.bool_]) -> None:
    """Remove the jump of a point from the loading of scenes that close without adhesion."""
    bare = (ratio == 0.0) & ~jumps
    if "loading_jumps" in found:
        found["loading_jumps"] = np.where(
            bare & (found["loading_jumps"] > 0), found["loading_jumps"] - 1, found["loading_jumps"]
        )
        if "loading_energy" in found:
            none = bare & (found["loading_jumps"] == 0)
            found["loading_energy"] = np.where(none, 0.0, found["loading_energy"])


def _opened(
    scenes: Mapping[str, ArrayLike], radius: NDArray[np.float64], wanted: Sequence[str], how: How, turn: str | None
) -> Results:
    """Return the results of opening from radii a_t/R; without contact forces, energies, counts and flags are 0."""
    limits = np.asarray(scenes["a_max_over_R"], dtype=float)
    if turn is None:
        return solve(scenes, wanted, **_known(how))
    away = radius == 0.0
    rims = {name: value for name, value in scenes.items() if name != turn}
    found = up_to_rims(rims | {"a_max_over_R": np.where(away, limits, radius)}, wanted, how, turned=True)
    for name in (name for name in wanted if away.any() and name not in _OF_THE_PUNCH):
        empty = np.nan if name in _RADII else 0
        found[name] = np.where(away, empty, found[name]).astype(found[name].dtype)
    found["status"] = np.where(away, 0, found["status"]).astype(found["status"].dtype)
    return found


def _known(how: How) -> dict[str, Any]:
    """Return how scenes are solved as arguments of `solve`."""
    return {name: value for name, value in how._asdict().items() if name != "is_one_wave"}


def _of_two_curves(
    scenes: Mapping[str, ArrayLike],
    ratio: NDArray[np.float64],
    names: Sequence[str],
    how: How,
    turn: str | None,
) -> Results:
    """Return the cycles that load on one curve and unload on the other; values at ratio 1 are those to rounding."""
    loading = [name for name in (*_OF_LOADING, *_OF_BOTH[1:]) if name in names]
    opening = [name for name in names if name not in (*_OF_LOADING, *_FROM_BOTH, "turning_radius")] + [
        name for name in _OF_BOTH[1:] if name in names
    ]
    shape = np.broadcast_shapes(ratio.shape, *(np.shape(value) for value in scenes.values()))
    closed: Results = {"status": np.zeros((), dtype=np.int16)}
    if loading or turn:
        closed = _solve_in_front(closing_parameters(scenes, ratio), ratio, [*loading, "turning_radius"], _known(how))
        _without_adhesion(closed, ratio, starts_downwards(scenes, how))
    radius = closed.get("turning_radius", np.asarray(scenes["a_max_over_R"], dtype=float))
    opened = _opened(scenes, radius, opening, how, turn)
    held = np.maximum(ratio, LEAST)
    found = {name: values for name, values in (closed | opened).items() if name not in _OF_BOTH}
    found["turning_radius"] = radius
    front = front_energy(ratio, edge_area(scenes, how, radius))
    with np.errstate(all="ignore"):
        if "loading_energy" in closed:
            found["loading_energy"] = held * closed["loading_energy"]
        if "dissipated_energy" in names:
            found["dissipated_energy"] = found["loading_energy"] + opened["unloading_energy"] + front
        for name in (name for name in _OF_BOTH[1:] if name in names):
            found[name] = held * closed[name] + opened[name]
        if "dissipated_energy_error" in names:
            found["dissipated_energy_error"] += _ROUNDING * front
    bits = closed["status"].astype(np.int16), opened["status"].astype(np.int16)
    none = ((bits[0] | bits[1]) & NO_VALUE) != 0 | ~((ratio >= 0.0) & (ratio <= 1.0))
    waves = (bits[0] | bits[1]) & TOO_MANY_WAVES
    status = np.where(none, NO_VALUE | waves, (bits[0] & _LOADING_BITS) | (bits[1] & _UNLOADING_BITS))
    wide = turn == TURNS[0] or how.toughness is not None
    found["status"] = status.astype(np.int16 if wide else np.int8)
    for name in names:
        empty = -1 if found[name].dtype.kind == "i" else np.nan
        found[name] = np.where(none, empty, found[name]).astype(found[name].dtype)
    return {name: np.broadcast_to(found[name], shape) for name in (*names, "status")}


def solve_two_works(parameters: Mapping[str, ArrayLike], outputs: Sequence[str], how: How) -> Results:
    """Solve scenes that have a `closing_ratio`, or of which outputs of `EDGE` are wanted.

    Parameters
    ----------
    parameters
        As those of `solve` of core/sweep.py, and closing_ratio in [0, 1], which broadcasts with them (1 if it is not
        given). `modulus` is E* R/w_o, loads are in 1.5 pi R w_o.
    outputs
        Those of `solve` but `contact_slope`, and those of `EDGE`: front_energy in R^2 w_o, pinned_depth in R, and
        snap_in_force in 1.5 pi R w_o (0 under load control, NaN at ratio 0 and without contact; negative where waves
        press at the depth 0).
    how
        How the scenes are solved.

    Returns
    -------
    The outputs and `status`, of the broadcast shape. Energy, front_energy and pinned_depth of an unbounded punch that
    does not turn are inf at ratios below 1. The bit close_to_a_jump also applies to unloading on the closing curve and
    loading on the opening one; the other bits are those of the parts that the cycle has. energy_residual is the sum of
    those of a whole cycle on each curve, in the unit of the energy.
    """
    ratio = np.asarray(parameters.get(CLOSING, 1.0), dtype=float)
    scenes = {name: value for name, value in parameters.items() if name != CLOSING}
    shape = np.broadcast_shapes(ratio.shape, *(np.shape(value) for value in scenes.values()))
    turn = next((name for name in TURNS if name in scenes), None)
    gains = [name for name in outputs if name in _GAINS]
    slopes = [name for name in outputs if name in SENSITIVITIES]
    others = [name for name in outputs if name not in (*EDGE, *gains, *slopes)]
    wanted = list(dict.fromkeys([*others, *(_GAINS[name] for name in gains)]))
    even = ratio == 1.0
    names = list(dict.fromkeys([*wanted, "turning_radius", *(_PARTS if "dissipated_energy" in wanted else ())]))
    one = solve(scenes, names, **_known(how)) if even.any() else None
    found: Results = one or {}
    if not even.all():
        found = _of_two_curves(scenes, ratio, names, how, turn)
    if one is not None and not even.all():
        found = {name: np.where(even, values, found[name]).astype(values.dtype) for name, values in one.items()}
    found = {name: np.broadcast_to(values, shape) for name, values in found.items()}
    if "front_energy" in outputs:
        found["front_energy"] = front_energy(ratio, edge_area(scenes, how, found["turning_radius"]))
    if "pinned_depth" in outputs:
        found["pinned_depth"] = pinned_depth(scenes, how, ratio, found["turning_radius"])
    if "snap_in_force" in outputs:
        from gradhesion.core.works.snap_in import snap_in_force  # noqa: PLC0415 (kernels of its own)

        away = (found["status"].astype(np.int16) & (NO_VALUE | NO_CONTACT)) != 0
        found["snap_in_force"] = np.where(away, np.nan, snap_in_force(scenes, ratio, how))
    if gains:
        smooth = {**parameters, "A": 0.0 * np.asarray(parameters["A"], dtype=float)}
        plain = solve_two_works(smooth, [_GAINS[name] for name in gains], how)
        with np.errstate(all="ignore"):
            found |= {name: found[_GAINS[name]] / plain[_GAINS[name]] for name in gains}
    if slopes:
        from gradhesion.core.works.slopes import two_work_sensitivities  # noqa: PLC0415 (kernels of their own)

        found = two_work_sensitivities({CLOSING: 1.0, **parameters}, slopes, how) | found
    return found
