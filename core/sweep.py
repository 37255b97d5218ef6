"""Arrays of scenes: requests are checked, passed to the solver concerned, and their results named."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.closed.reach import radius_of, slope_at
from gradhesion.core.cycle.disc import profile_of
from gradhesion.core.edge.pattern import rows_by_number
from gradhesion.core.problem.control import BY_DISPLACEMENT, CONTROLS, Loading
from gradhesion.core.problem.names import (
    CLOSING,
    CONTACT_SLOPE,
    EDGE,
    EXACT_ALONE,
    GIVEN_UP,
    INTEGERS,
    MACHINE,
    OUTPUTS,
    PARAMETERS,
    PATTERN,
    PULL_OFF,
    RATE,
    REACH,
    REPORTS,
    SENSITIVITIES,
    SOLVERS,
    SPEED,
    TURNS,
    WITHOUT_LOAD,
)
from gradhesion.core.problem.profile import WAVY, Profile, in_own_wavelength, starts_downwards
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE
from gradhesion.core.problem.toughness import rows_of_pattern
from gradhesion.core.scenes import results
from gradhesion.core.scenes.reduced import Punch
from gradhesion.core.scenes.requests import Request, Wanted
from gradhesion.core.scenes.tasks import solve_all
from gradhesion.core.table.layout import BY_DEPTH, EXACT

if TYPE_CHECKING:
    from gradhesion.core.problem.toughness import Rate, Toughness

_MOST_NARROW: Final = np.iinfo(np.int8).max
Results: TypeAlias = dict[str, NDArray[Any]]
_GAINS: Final = {"adhesion_gain": "pull_off_force", "energy_gain": "dissipated_energy"}
"""Results compared with those of the smooth punch on the same interface."""
_COLUMNS: Final = (*PARAMETERS, MACHINE, "target", CLOSING, *PATTERN)
"""The rows of parameters in the order of scenes/rows.py; `target` is the one of `TURNS` that is given."""
_DEFAULTS: Final = {MACHINE: np.inf, "target": 0.0, CLOSING: 1.0, PATTERN[0]: 1.0, PATTERN[1]: 1.0}


def turn_of(parameters: Mapping[str, Any], loading: Loading, toughness: Any) -> str | None:
    """Refuse parameters that do not belong together; return the one at which cycles turn, None if that is the rim."""
    if missing := [name for name in PARAMETERS if name not in parameters]:
        raise ValueError(f"missing parameters {missing}")
    if (MACHINE in parameters) != (loading.control == "machine"):
        raise ValueError(f"{MACHINE} belongs to control 'machine' and to no other; control {loading.control!r}")
    if (PATTERN[0] in parameters) != (toughness is not None) or (toughness is None and PATTERN[1] in parameters):
        raise ValueError(f"{' and '.join(PATTERN)} belong to a pattern of toughness, which needs the first of them")
    turns = [name for name in TURNS if name in parameters]
    if len(turns) > 1:
        raise ValueError(f"{' and '.join(turns)} are given: a cycle turns at one of them")
    return turns[0] if turns else None


def _checked(
    parameters: Mapping[str, ArrayLike], outputs: Sequence[str], solver: str, loading: Loading, toughness: Any
) -> str | None:
    """Refuse what cannot be solved; return the name of the target at which cycles turn, None if that is the rim."""
    reports = [name for name in outputs if name in REPORTS]
    slopes = [name for name in outputs if name in SENSITIVITIES]
    unknown = [name for name in outputs if name not in (*OUTPUTS, *EDGE, *RATE, REACH, *reports, *slopes)]
    lost = [name for name in outputs if name in GIVEN_UP]
    if lost:
        raise ValueError(f"{lost[0]} is given up: {GIVEN_UP[lost[0]]}")
    if unknown or solver not in SOLVERS:
        raise ValueError(f"unknown outputs {unknown}, solver {solver!r}")
    turn = turn_of(parameters, loading, toughness)
    exact = [name for name in outputs if name in (*EXACT_ALONE, *slopes)] + [turn] * (turn is not None)
    if solver != "exact" and exact:
        raise ValueError(f"{exact} are known of the exact solver only, not of {solver!r}")
    if loading.control == "load" and "energy_residual" in reports:
        raise ValueError("energy_residual: under dead load the cycle is not closed; request it under another control")
    if solver != "exact" and loading != BY_DISPLACEMENT:
        raise ValueError(f"solver {solver!r} is known under displacement control only: {WITHOUT_LOAD[solver]}")
    if toughness is not None and solver != "exact":
        raise ValueError(f"solver {solver!r} knows no pattern of toughness: use the exact one")
    return turn


def request_of(
    parameters: Mapping[str, ArrayLike],
    turn: str | None,
    profile: Profile,
    loading: Loading,
    toughness: Toughness | None,
) -> Request:
    """Return what is to be solved."""
    factor, waves = in_own_wavelength(profile)
    given = {**_DEFAULTS, **parameters}
    if turn is not None:
        given["target"] = parameters[turn]
    arrays = [np.asarray(given[name], dtype=float) for name in _COLUMNS]
    wavelength, amplitude = PARAMETERS.index("lambda_over_R"), PARAMETERS.index("A")
    arrays[wavelength] = arrays[wavelength] / factor
    arrays[amplitude] = arrays[amplitude] * (factor if len(waves) else 0.0)
    if not len(waves):
        waves = np.array([[1.0, 1.0, 0.0]])
    punch = Punch(
        exponent=profile.exponent,
        waves=waves,
        control=CONTROLS.index(loading.control),
        turn=0 if turn is None else 1 + TURNS.index(turn),
        rows=rows_by_number(np.zeros((0, 3)) if toughness is None else rows_of_pattern(toughness)),
        of_work=toughness is not None and toughness.of == "work",
        profile=profile_of(waves),
    )
    return Request(arrays, np.broadcast_shapes(*(array.shape for array in arrays)), punch)


def _without_adhesion(found: Results, ratio: NDArray[np.float64], downwards: NDArray[np.bool_]) -> None:
    """Remove the jump of a point from the loading of scenes that close without adhesion."""
    bare = (ratio == 0.0) & ~downwards
    jumps = found["loading_jumps"]
    found["loading_jumps"] = np.where(bare & (jumps > 0.0), jumps - 1.0, jumps)
    none = bare & (jumps == 1.0)
    lost = np.where(none, found["loading_energy"], 0.0)
    found["loading_energy"] = found["loading_energy"] - lost
    found["dissipated_energy"] = found["dissipated_energy"] - lost


def _solved(
    request: Request,
    parameters: Mapping[str, ArrayLike],
    outputs: Sequence[str],
    profile: Profile,
    loading: Loading,
    solver: str,
    threads: int | None,
    *,
    check_contact: bool,
) -> Results:
    """Return results of cycles by name, all as floats, and `status`, of the broadcast shape."""
    cycle = bool({*outputs} - {*PULL_OFF, "turning_radius"})
    wanted = Wanted(
        cycle=cycle,
        contact=cycle and check_contact,
        residual="energy_residual" in outputs,
        saturation="saturation_radius" in outputs,
    )
    needed = {*outputs}
    if cycle and CLOSING in parameters:
        needed |= {"loading_energy", "loading_jumps", "dissipated_energy"}
    if cycle and solver == "asymptotic":
        needed |= {"dissipated_energy"}
    names = [name for name in results.NAMES if name in needed]
    form = BY_DEPTH if solver == "asymptotic" else EXACT
    rows, status = solve_all(request, wanted, form, [results.NAMES.index(name) for name in names], threads)
    found: Results = {name: row.reshape(request.shape) for name, row in zip(names, rows, strict=True)}
    status = status.reshape(request.shape)
    if "dissipated_energy" in found:  # NaN is beyond all numbers, and a gain a contact that is no larger than a wave
        lost = found["dissipated_energy"]
        none = (np.isnan(lost) | ((form != EXACT) & (lost < 0.0))) & ((status & NO_VALUE) == 0)
        if none.any():
            status = np.where(none, NO_VALUE, status)
            found = {name: np.where(none, np.nan, values) for name, values in found.items()}
    ratio = np.asarray(parameters.get(CLOSING, 1.0), dtype=float)
    if cycle and CLOSING in parameters and (ratio == 0.0).any():
        _without_adhesion(found, ratio, starts_downwards(parameters, profile))
    if "snap_in_force" in found:
        none = (ratio == 0.0) | ((found["snap_in_force"] < 0.0) & (loading.control == "machine"))
        found["snap_in_force"] = np.where(none, np.nan, found["snap_in_force"])
    return found | {"status": status}


def _typed(name: str, values: NDArray[np.float64]) -> NDArray[Any]:
    """Return values as the type of their result: counts as int32, -1 for NaN, 2^31 - 1 for more."""
    if name not in INTEGERS:
        return values
    return np.where(np.isnan(values), -1.0, np.minimum(values, np.iinfo(np.int32).max)).astype(np.int32)


def _roughness(parameters: Mapping[str, ArrayLike], profile: Profile, status: NDArray[Any]) -> NDArray[np.float64]:
    """Return chi of scenes, of the shape of `status`: how far unloading swings below the mean of the waves, over s."""
    from gradhesion.core.closed.envelope import chis  # noqa: PLC0415 (SciPy)
    from gradhesion.core.problem.material import stiffness  # noqa: PLC0415

    given = (np.asarray(parameters[name], dtype=float) for name in PARAMETERS[:-1])
    k, nu, modulus, c0, wavelength, amplitude = (np.broadcast_to(one, status.shape).ravel() for one in given)
    with np.errstate(all="ignore"):
        _, down = chis(k, stiffness(k, nu, modulus, c0), wavelength, amplitude, profile)
    return np.where(status & NO_VALUE, np.nan, down.reshape(status.shape))


def solve(
    parameters: Mapping[str, ArrayLike],
    outputs: Sequence[str] = ("pull_off_force", "dissipated_energy"),
    *,
    solver: str = "exact",
    check_contact: bool = True,
    threads: int | None = None,
    profile: Profile | None = None,
    loading: Loading | None = None,
    toughness: Toughness | None = None,
    rate: Rate | None = None,
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of the broadcast parameters.

    Parameters
    ----------
    parameters
        An array for each name of `PARAMETERS`, all broadcastable: k in [0, 1], nu in (-1, 0.5] (0.5 where k = 1),
        modulus E* R/dgamma > 0, c0/R > 0, lambda/R > 0, A = amplitude/lambda >= 0, a_max/R > 0 or inf. Scenes that
        differ along the last axes in a_max alone are solved on one trace.
    outputs
        Names from `OUTPUTS`: pull_off_force in 1.5 pi R dgamma, pull_off_radius in R, dissipated_energy of one cycle of
        displacement-controlled loading to full contact and unloading in R^2 dgamma, loading_jumps and unloading_jumps
        (including jump-in and jump-out), delta_max and delta_jump_out in R: the depths at which full contact is reached
        and from which contact ends, under any control; loading_energy and unloading_energy in R^2 dgamma, the two parts
        of dissipated_energy. With the exact solver also those of `REPORTS`: energy_residual, the energy less the loop
        integral of the load, whose own rounding is that of the load (NaN beyond 2,000 waves); roughness_parameter
        chi = r/s; saturation_radius in R, beyond which there is no fold; adhesion_gain and energy_gain over the smooth
        punch of the same material and rim; and pull_off_force_sensitivity and dissipated_energy_sensitivity,
        d ln(value)/d ln p of every parameter, for k and nu d ln(value)/dp. And contact_slope, (a/R)^(m-1) at the
        largest radius on which the other outputs depend (closed/reach.py); of an unbounded punch to about 1e-12, by
        the asymptotic solver 1e-6.
    solver
        One of `SOLVERS`.
    check_contact
        Report in `status` that the contact on loading is not one disc (a tenth of the time of a cycle). The test needs
        the loading path: only the exact solver makes it, if an output other than the two of the pull-off is requested.
    threads
        Number of threads; all processors if not given. Results do not depend on it.
    profile
        The shape of the punch, a paraboloid with one cosine wave if not given.
    loading
        The control, displacement if not given; another control needs the exact solver. With control "machine"
        `parameters` also has machine_stiffness, S/(E* R) > 0, which broadcasts with the others. Under load control
        dissipated_energy excludes the jump-out, whose energy is unbounded, and energy_residual is not available.

    Returns
    -------
    An array of the broadcast shape for each output (float64; int32 for jumps, 2^31 - 1 for more) and `status` (int8,
    int16 where cycles turn at a depth and where there is a pattern or a scene with too many waves; bits of
    status.FLAGS). Sensitivities have an additional last axis: the parameters in the order of `PARAMETERS`,
    machine_stiffness and the one of `TURNS` if they are given. A scene outside the ranges has NaN (-1 jumps) and the
    bit no_value; delta_max of an unbounded punch is inf.

    Raises
    ------
    ValueError
        For an unknown output or solver, or parameters that are missing or do not broadcast; for an output that another
        solver or control does not have, or a solver that another control does not have.

    Notes
    -----
    Sections 2-5 of Jin, Guo & Wan (2013) as corrected in docs/theory.md. Values are exact to 1e-12 of the sizes of
    their terms up to 1,000 waves within the contact, a digit less for each decade more, up to a million
    (docs/accuracy.md).

    Examples
    --------
    The smooth punch on a homogeneous half-space (Johnson, Kendall & Roberts 1971), and one with waviness:

    >>> scene = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, a_max_over_R=np.inf)
    >>> solve(scene | {"A": [0.0, 0.02]})["pull_off_force"].round(6).tolist()
    [1.0, 1.342098]
    """
    profile = WAVY if profile is None else profile
    loading = BY_DISPLACEMENT if loading is None else loading
    known: dict[str, Any] = {"solver": solver, "check_contact": check_contact, "threads": threads}
    known |= {"profile": profile, "loading": loading, "toughness": toughness, "rate": rate}
    if CONTACT_SLOPE in outputs:
        others = [name for name in outputs if name != CONTACT_SLOPE]
        radius = radius_of(others, parameters)
        found = solve(parameters, [*others, radius], **known)
        found |= {CONTACT_SLOPE: slope_at(found, radius, parameters, profile)}
        return {name: found[name] for name in (*outputs, "status")}
    turn = _checked(parameters, outputs, solver, loading, toughness)
    if rate is not None:
        from gradhesion.core.rate.cycle import KNOWN, solve_at_speed  # noqa: PLC0415 (seldom wanted)

        absent = [name for name in outputs if name not in KNOWN]
        if absent or SPEED not in parameters or loading.control == "load" or toughness is not None:
            raise ValueError(
                f"an edge with a speed needs {SPEED}, control 'displacement' or 'machine' and no pattern of toughness, "
                f"and {absent} are not known of it"
            )
        return solve_at_speed(parameters, outputs, rate, known)
    slopes = [name for name in outputs if name in SENSITIVITIES]
    gains = [name for name in outputs if name in _GAINS]
    values = [name for name in outputs if name not in (*slopes, *gains, "roughness_parameter")]
    values = list(dict.fromkeys([*values, *(_GAINS[name] for name in gains)]))
    if solver == "envelope":
        from gradhesion.core.closed.envelope import solve_envelope  # noqa: PLC0415 (SciPy)

        found = _of_envelopes(parameters, values, profile, solve_envelope)
    else:
        request = request_of(parameters, turn, profile, loading, toughness)
        found = _solved(request, parameters, values, profile, loading, solver, threads, check_contact=check_contact)
    status = found["status"]
    if turn is not None:
        away = (status & NO_CONTACT) != 0
        found |= {name: np.where(away, 0.0, found[name]) for name in ("turning_radius",) if name in found}
    if "roughness_parameter" in outputs:
        found["roughness_parameter"] = _roughness(parameters, profile, status)
    if gains:
        smooth = solve(
            {**parameters, "A": 0.0 * np.asarray(parameters["A"], dtype=float)}, [_GAINS[n] for n in gains], **known
        )
        with np.errstate(all="ignore"):
            found |= {name: found[_GAINS[name]] / smooth[_GAINS[name]] for name in gains}
    if slopes:
        from gradhesion.core.slopes.sensitivities import sensitivities  # noqa: PLC0415 (kernels of their own)

        given = [name for name in (*_COLUMNS, *TURNS) if name in parameters]
        found |= sensitivities(request, slopes, given, threads)
    wide = turn == TURNS[0] or toughness is not None or (status > _MOST_NARROW).any()
    found["status"] = status.astype(np.int16 if wide else np.int8)
    return {name: _typed(name, found[name]) for name in (*outputs, "status")}


def _of_envelopes(
    parameters: Mapping[str, ArrayLike], outputs: Sequence[str], profile: Profile, solve_envelope: Any
) -> Results:
    """Return the results of envelopes, at ratios of closing below 1 those of two works (physics 16)."""
    found: Results = solve_envelope(
        parameters, PARAMETERS, [name for name in outputs if name != "turning_radius"], profile
    )
    if "turning_radius" in outputs:
        rim = np.broadcast_to(np.asarray(parameters["a_max_over_R"], dtype=float), found["status"].shape)
        found["turning_radius"] = np.where(found["status"] & NO_VALUE, np.nan, rim)
    return found
