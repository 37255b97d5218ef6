"""Arrays of scenes whose edge moves at a speed, in tasks of one gradient exponent."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.prepared import Scenes, compliance_of, curves_of, run_by_exponent
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS, PULL_OFF
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.rate.scenes import CLOSED, OPENED, Edges, close_scenes, open_scenes, track_edge

SPEED: Final = "speed_over_reference"
"""The parameter V/v*: the speed of the depth, or of the far end of the spring, over the speed of the law."""
OPENING: Final = (*OPENED, "unloading_energy", "rate_coefficient")
"""The results of `open_at_speed`."""
_MORE: Final = {"displacement": (), "machine": ("machine_stiffness",)}
_OF_CLOSING: Final = {"closing_ratio": 1.0, "delta_max": math.inf}
MOST_POINTS: Final = 2**18
"""Points of a track at most."""
Results: TypeAlias = dict[str, NDArray[Any]]


def _solved(
    parameters: Mapping[str, ArrayLike],
    rate: Rate,
    profile: Profile,
    loading: Loading,
    threads: int | None,
    rows: tuple[str, ...],
    solve: Callable[..., None],
) -> Results:
    """Solve all scenes by a loop over scenes of one exponent of the gradient, which has `rows` of results."""
    if loading.control not in _MORE:
        raise ValueError(f"control {loading.control!r}: under a falling load the energy of a moving edge has no bound")
    names = (*PARAMETERS, SPEED, *_MORE[loading.control], *(name for name in _OF_CLOSING if name in parameters))
    arrays = np.broadcast_arrays(*(np.asarray(parameters[name], dtype=float) for name in names))
    shape = arrays[0].shape
    flat = dict(zip(names, (np.array(array).ravel() for array in arrays), strict=True))
    k, modulus = flat["k"], flat["modulus"]
    material = stiffness(k, flat["nu"], modulus, flat["c0_over_R"])
    with np.errstate(all="ignore"):
        stretch = np.sqrt(2.0 ** (1.0 + k) * math.pi / material)
    compliance = compliance_of(loading, k, modulus, material, *(flat[name] for name in _MORE[loading.control]))
    count = k.size
    own = k, stretch, flat["lambda_over_R"], flat["A"], compliance, flat["a_max_over_R"].reshape(-1, 1)
    series, curves_at = curves_of(Scenes(shape, *own), profile)
    ratios, turns = (flat.get(name, np.full(count, value)) for name, value in _OF_CLOSING.items())
    out, status = np.full((len(rows), count), np.nan), np.zeros(count, dtype=np.int64)

    def work(exponent: float, index: NDArray[np.int64], _interpolated: bool) -> None:
        basis = Basis(*tables_of(exponent, series), series)
        solve(basis, Edges(curves_at(exponent, index), flat[SPEED], rate.exponent, ratios, turns), out, status)

    run_by_exponent(k, work, threads)
    found: Results = {name: out[i].reshape(shape) for i, name in enumerate(rows)}
    return found | {"status": status.astype(np.int16).reshape(shape)}


def open_at_speed(
    parameters: Mapping[str, ArrayLike],
    rate: Rate,
    profile: Profile,
    loading: Loading,
    threads: int | None,
    *,
    outputs: Sequence[str] = OPENING,
) -> Results:
    """Open contacts at a speed, from the radius a_t at which rho = 1 to separation.

    Parameters
    ----------
    parameters
        An array for each name of `PARAMETERS`, with a_max_over_R the radius a_t > 0, finite; speed_over_reference
        V/v* > 0, finite; and machine_stiffness where the control is "machine": all broadcastable. modulus is
        E* R/w_o: w_o = dgamma is the work of opening of an edge at rest.
    rate, profile, loading, threads
        The law, and the rest as of `solve` of core/sweep.py. The law under a load is refused.
    outputs
        Names out of `OPENING`.

    Returns
    -------
    Arrays of the broadcast shape: pull_off_force in 1.5 pi R dgamma and pull_off_radius in R; opening_energy,
    int 2 pi a G da, and unloading_energy, that less pi a_t^2, in R^2 dgamma; delta_jump_out in R, the depth at
    separation, where there is no load and the far end of the spring is as deep; edge_speed_at_pull_off in v*;
    rate_coefficient, the factor of (V/v*)^n in F/F_0 - 1 of a slow edge (NaN where the pull-off at rest is at a_t);
    pull_off_force_error and opening_energy_error, estimates in the unit of the value, mostly above the true error.
    `status` (int16) has pull_off_at_rim (the edge has moved by less than 1e-9 of a_t), tolerance_not_met (an estimate
    above 1e-9 of its value, or (V/v*)^n below 1e-15), no_value (all values are NaN), and too_many_waves with it.

    Raises
    ------
    ValueError
        Under load control: the energy of this law has no bound there.

    Notes
    -----
    In 500 random scenes (V/v* from 1e-6 to 100, n from 0.1 to 2) F is right to 1e-13 and the energy to 3e-12.
    """
    own = _solved(parameters, rate, profile, loading, threads, OPENED, open_scenes)
    if "unloading_energy" in outputs:
        own["unloading_energy"] = own["opening_energy"] - math.pi * np.square(np.asarray(parameters["a_max_over_R"]))
    if "rate_coefficient" in outputs:
        coefficient = rate_coefficient(parameters, rate, profile, loading, threads)
        own["rate_coefficient"] = np.where(own["status"] & NO_VALUE, np.nan, coefficient)
    return {name: own[name] for name in (*outputs, "status")}


def rate_coefficient(
    parameters: Mapping[str, ArrayLike], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> NDArray[np.float64]:
    """Return the factor of (V/v*)^n in F/F_0 - 1 of a slow edge, whatever the speed; arguments as of `open_at_speed`.

    K a^(1+k) Delta/(2 F_0) (a/((1+k) Delta))^n with a the radius of the pull-off F_0 at rest; NaN where that is a_t.
    """
    names = (*PARAMETERS, *_MORE[loading.control])
    slow = solve_general(
        {name: parameters[name] for name in names}, PULL_OFF, profile, loading, threads, check_contact=False
    )
    k, nu, modulus, c0 = (np.asarray(parameters[name], dtype=float) for name in PARAMETERS[:4])
    material, n = stiffness(k, nu, modulus, c0), rate.exponent
    force, a = 1.5 * math.pi * slow["pull_off_force"], slow["pull_off_radius"]
    with np.errstate(all="ignore"):
        adhesion = np.sqrt(2.0 ** (1.0 + k) * math.pi * a ** (1.0 - k) / material)
        pull = 2.0 ** (1.0 - k) * material / (1.0 + k) * a ** (1.0 + k) * adhesion
        found = pull / (2.0 * force) * (a / ((1.0 + k) * adhesion)) ** n
    return np.where(slow["status"] & (PULL_OFF_AT_RIM | NO_VALUE), np.nan, found)


def close_at_speed(
    parameters: Mapping[str, ArrayLike], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> Results:
    """Close contacts at a speed by the same law, G = w_c/[1 + (v/v*)^n], from zero contact at Y = 0.

    Y is what moves at the speed V: the depth, or the far end of the spring. Where the machine turns, at Y = delta_max,
    the edge goes on closing until G = w_c or the rim is met; a punch whose rim is met first stays there, while the
    machine goes on. At rho <= 0 the edge follows at once.

    Parameters
    ----------
    parameters
        As of `open_at_speed`, with a_max_over_R the rim (may be inf), closing_ratio w_c/w_o in (0, 1], and delta_max in
        R (inf: the machine turns when the rim is met). One of rim and delta_max is finite.
    rate, profile, loading, threads
        As of `open_at_speed`.

    Returns
    -------
    Arrays of the broadcast shape, lengths in R, energies in R^2 dgamma, loads in 1.5 pi R dgamma: turning_radius, where
    opening will start; closing_energy, int 2 pi a G da; radius_at_turn, depth_at_turn, coordinate_at_turn and
    load_at_turn, when the machine turns or the rim is met before; depth_edge_stops, coordinate_edge_stops,
    load_edge_stops and rho_edge_stops, where the edge comes to rest: rho is sqrt(closing_ratio), or less at the rim;
    closing_energy_error, an estimate. `status` (int16) as of `open_at_speed`, and no_contact where delta_max < 0: the
    energy is 0 and all else NaN.

    Raises
    ------
    ValueError
        Under load control.
    """
    return _solved(parameters, rate, profile, loading, threads, CLOSED, close_scenes)


def tracked(
    parameters: Mapping[str, ArrayLike], rate: Rate, profile: Profile, loading: Loading, *, inwards: bool
) -> NDArray[np.float64]:
    """Return where the edge of one scene is as it opens (inwards) or closes, step by step.

    The parameters are numbers, those of `open_at_speed` or `close_at_speed`. The array has the shape (3, points): radii
    and depths in R, loads in 1.5 pi R dgamma; without points where there is no value.
    """
    found = [np.empty((3, 0))]

    def follow(basis: Basis, edges: Edges, _out: NDArray[np.float64], status: NDArray[np.int64]) -> None:
        status[0], states = track_edge(basis, edges, inwards, MOST_POINTS)
        if not status[0] & NO_VALUE:
            found[0] = states

    one = {name: np.full(1, value, dtype=float) for name, value in parameters.items()}
    _solved(one, rate, profile, loading, 1, (), follow)
    return found[0]
