"""Arrays of scenes: requests are checked, passed to the solver concerned, and their results named.

Solvers of other profiles and controls are imported on request: that takes half as long as a small map.
"""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.cosine import SLOPES, solve_cosine, turning_cosine
from gradhesion.core.arrays.turned import Results, turned_results
from gradhesion.core.compiler.marks import note_compiled
from gradhesion.core.kinds import kind_of_map, kind_of_sensitivities, kind_of_turning
from gradhesion.core.problem.control import BY_DISPLACEMENT, Loading
from gradhesion.core.problem.names import (
    CLOSING,
    CONTACT_SLOPE,
    EDGE,
    OUTPUTS,
    PARAMETERS,
    PATTERN,
    PULL_OFF,
    RATE,
    REACH,
    REPORTS,
    RESULTS,
    SENSITIVITIES,
    SOLVERS,
    SPEED,
    TURNS,
    WITHOUT_LOAD,
)
from gradhesion.core.problem.profile import WAVY, Profile
from gradhesion.core.problem.reach import radius_of, slope_at
from gradhesion.core.problem.results import WHOLE_CYCLE
from gradhesion.core.problem.shape import equivalent_wave
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scene.cosine_report import NEEDED

if TYPE_CHECKING:
    from gradhesion.core.problem.rate import Rate
    from gradhesion.core.problem.toughness import Toughness


def _checked(
    parameters: Mapping[str, ArrayLike], outputs: Sequence[str], solver: str, loading: Loading, toughness: Any
) -> str | None:
    """Refuse what cannot be solved; return the name of the target at which cycles turn, None if that is the rim."""
    reports = [name for name in outputs if name in REPORTS]
    slopes = [name for name in outputs if name in SENSITIVITIES]
    unknown = [name for name in outputs if name not in (*OUTPUTS, *EDGE, *RATE, REACH, *reports, *slopes)]
    missing = [name for name in PARAMETERS if name not in parameters]
    if unknown or missing or solver not in SOLVERS:
        raise ValueError(f"unknown outputs {unknown}, missing parameters {missing}, solver {solver!r}")
    turns = [name for name in TURNS if name in parameters]
    if len(turns) > 1:
        raise ValueError(f"{' and '.join(turns)} are given: a cycle turns at one of them")
    if solver != "exact" and (reports or turns or slopes):
        raise ValueError(f"{[*reports, *slopes, *turns]} are known of the exact solver only, not of {solver!r}")
    if ("machine_stiffness" in parameters) != (loading.control == "machine"):
        raise ValueError(f"machine_stiffness belongs to control 'machine' and to no other; control {loading.control!r}")
    if loading.control == "load" and "energy_residual" in reports:
        raise ValueError("energy_residual: under dead load the cycle is not closed; request it under another control")
    if solver != "exact" and loading != BY_DISPLACEMENT:
        raise ValueError(f"solver {solver!r} is known under displacement control only: {WITHOUT_LOAD[solver]}")
    if (PATTERN[0] in parameters) != (toughness is not None) or (toughness is None and PATTERN[1] in parameters):
        raise ValueError(f"{' and '.join(PATTERN)} belong to a pattern of toughness, which needs the first of them")
    if toughness is not None and solver != "exact":
        raise ValueError(f"solver {solver!r} knows no pattern of toughness: use the exact one")
    return turns[0] if turns else None


def _as_one_wave(
    parameters: Mapping[str, ArrayLike], wavelengths_a_wave: int, amplitude_factor: float
) -> dict[str, ArrayLike]:
    """Return the parameters of the paraboloid with one cosine wave that a profile is (equivalent_wave)."""
    return {
        **parameters,
        "lambda_over_R": np.asarray(parameters["lambda_over_R"], dtype=float) / wavelengths_a_wave,
        "A": np.asarray(parameters["A"], dtype=float) * amplitude_factor,
    }


def wanted_for(outputs: Sequence[str], *, turned: bool) -> Sequence[str]:
    """Return the results to solve for: sensitivities start from values."""
    if not set(outputs) & {*SENSITIVITIES}:
        return outputs
    from gradhesion.core.sensitivities.sensitivity import wanted_for as all_wanted  # noqa: PLC0415 (kernels of their own)

    return all_wanted(outputs, turned=turned)


class How(NamedTuple):
    """How scenes are solved, beside their parameters: `solver` to `loading` are arguments of `solve`."""

    solver: str
    check_contact: bool
    threads: int | None
    profile: Profile
    loading: Loading
    is_one_wave: bool  # whether the parameters are those of a paraboloid with one cosine under displacement control
    toughness: Toughness | None = None


def up_to_rims(
    scenes: Mapping[str, ArrayLike],
    wanted: Sequence[str],
    how: How,
    slopes: tuple[bool, int] | None = None,
    *,
    turned: bool = False,
) -> Results:
    """Solve scenes up to a_max: results by name and `status`, of the broadcast shape.

    `slopes` and `turned` are as those of `solve_general` (arrays/general.py).
    """
    solver, check_contact, threads, profile, loading, is_one_wave, toughness = how
    wanted = [name for name in wanted if name != "turning_radius"]
    if solver == "asymptotic":
        from gradhesion.core.arrays.short_wave import solve_short_waves  # noqa: PLC0415 (kernels of their own)

        return solve_short_waves(scenes, wanted, profile, threads)
    if solver == "envelope" and not is_one_wave:
        from gradhesion.core.closed.envelope import solve_envelope  # noqa: PLC0415 (SciPy)

        return solve_envelope(scenes, PARAMETERS, wanted, profile)
    checks: Any = {"check_contact": check_contact, "turned": turned, "slopes": slopes}
    if is_one_wave:
        return solve_cosine(scenes, wanted, solver, threads, **checks)
    from gradhesion.core.arrays.general import solve_general  # noqa: PLC0415 (kernels of their own)

    results = [name for name in wanted if name in (*RESULTS, REACH)]
    reports = [name for name in wanted if name in REPORTS]
    results += [NEEDED[name] for name in reports if name in NEEDED]
    found = solve_general(scenes, results, profile, loading, threads, toughness=toughness, **checks)
    if not reports:
        return found
    from gradhesion.core.arrays.general_report import report_general  # noqa: PLC0415 (kernels of their own)

    known: Any = {"turned": turned, "toughness": toughness}
    return found | report_general(scenes, reports, found, profile, loading, threads, **known)


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
        of dissipated_energy. With the exact solver also those of `REPORTS`: pull_off_force_error and
        dissipated_energy_error, estimates in the unit of the value (of rounding, and of the sum over waves);
        energy_residual, the energy less the loop integral of the load, whose own rounding is that of the load (NaN
        beyond 2,000 waves); roughness_parameter chi = r/s; saturation_radius in R, beyond which there is no fold;
        adhesion_gain and energy_gain over the smooth punch of the same material and rim; and pull_off_force_sensitivity
        and dissipated_energy_sensitivity, d ln(value)/d ln p of every parameter, for k and nu d ln(value)/dp. And
        contact_slope, (a/R)^(m-1) at the largest radius on which the other outputs depend (problem/reach.py); of an
        unbounded punch to about 1e-12, by the asymptotic solver 1e-6.
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
    int16 where cycles turn at a depth; bits of status.FLAGS). Sensitivities have an additional last axis: the
    parameters in the order of `PARAMETERS`, machine_stiffness and the one of `TURNS` if they are given. A scene outside
    the ranges has NaN (-1 jumps) and the bit no_value; delta_max of an unbounded punch is inf.

    Raises
    ------
    ValueError
        For an unknown output or solver, or parameters that are missing or do not broadcast; for an output that another
        solver or control does not have, or a solver that another control does not have.

    Notes
    -----
    Sections 2-5 of Jin, Guo & Wan (2013) as corrected in docs/theory.md. On 2,184 scenes solved to 30 digits by another
    method (tests/twin) the force is accurate to 2e-15, the energy to 4e-15 where every wave is traced and to 2e-13
    where waves are summed (on longer curves 1e-12, up to 4 10^15 waves), and all counts of jumps are correct.

    Examples
    --------
    The smooth punch on a homogeneous half-space (Johnson, Kendall & Roberts 1971), and one with waviness:

    >>> scene = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, a_max_over_R=np.inf)
    >>> solve(scene | {"A": [0.0, 0.02]})["pull_off_force"].round(6).tolist()
    [1.0, 1.342098]
    """
    profile = WAVY if profile is None else profile
    loading = BY_DISPLACEMENT if loading is None else loading
    if CONTACT_SLOPE in outputs:
        known: Any = {"solver": solver, "check_contact": check_contact, "threads": threads}
        known |= {"profile": profile, "loading": loading, "toughness": toughness, "rate": rate}
        others = [name for name in outputs if name != CONTACT_SLOPE]
        radius = radius_of(others, parameters)
        found = solve(parameters, [*others, radius], **known)
        slope = {CONTACT_SLOPE: slope_at(found, radius, parameters, profile)}
        return {name: (found | slope)[name] for name in (*outputs, "status")}
    turn = _checked(parameters, outputs, solver, loading, toughness)
    if rate is not None:
        from gradhesion.core.rate.cycle import KNOWN, solve_at_speed  # noqa: PLC0415 (seldom wanted)

        absent = [name for name in outputs if name not in KNOWN]
        if absent or SPEED not in parameters or loading.control == "load" or toughness is not None:
            raise ValueError(
                f"an edge with a speed needs {SPEED}, control 'displacement' or 'machine' and no pattern of toughness, "
                f"and {absent} are not known of it"
            )
        how = How(solver, check_contact, threads, profile, loading, is_one_wave=False)
        return solve_at_speed(parameters, outputs, how, rate)
    plain = solver != "asymptotic" and loading == BY_DISPLACEMENT and toughness is None
    alike = equivalent_wave(profile) if plain else None
    if alike is not None and profile != WAVY:
        parameters = _as_one_wave(parameters, *alike)
    how = How(solver, check_contact, threads, profile if alike is None else WAVY, loading, alike is not None, toughness)
    if CLOSING in parameters or {*outputs} & {*EDGE}:
        from gradhesion.core.works.cycle import solve_two_works  # noqa: PLC0415 (seldom wanted)

        found = solve_two_works(parameters, outputs, how)
        return {name: found[name] for name in (*outputs, "status")}
    requested = outputs
    outputs = wanted_for(outputs, turned=turn is not None)
    senses = tuple(name in requested for name in SENSITIVITIES)
    slopes = (senses[0], WHOLE_CYCLE if senses[1] else 0) if any(senses) else None

    def solved(scenes: Mapping[str, ArrayLike], wanted: Sequence[str], *, turned: bool = False) -> Results:
        """Solve scenes up to their rims."""
        return up_to_rims(scenes, wanted, how, slopes, turned=turned)

    def again(scenes: Mapping[str, ArrayLike], wanted: Sequence[str]) -> Results:
        """Solve other scenes that turn as these do."""
        requested: Any = {"threads": threads, "profile": profile, "loading": loading, "toughness": toughness}
        return solve(scenes, wanted, check_contact=False, **requested)

    passed: NDArray[np.bool_] = np.array(False)
    if turn is None:
        found = solved(parameters, outputs)
        if "turning_radius" in outputs:
            shape = found["status"].shape
            rim = np.broadcast_to(np.asarray(parameters["a_max_over_R"], dtype=float), shape)
            found["turning_radius"] = np.where(found["status"] & NO_VALUE, np.nan, rim)
    else:
        arguments: dict[str, Any] = {"check_contact": check_contact and not set(outputs) <= set(PULL_OFF)}
        flags: NDArray[Any]
        if alike is not None:
            radii, flags = turning_cosine(parameters, turn, threads, **arguments)
            passed = np.full(radii.shape, False)  # displacement is prescribed: jumps leave it as it is
        else:
            from gradhesion.core.arrays.general_turning import turning_general  # noqa: PLC0415 (kernels of their own)

            arguments["toughness"] = toughness
            radii, flags, passed = turning_general(parameters, turn, profile, loading, threads, **arguments)
            passed &= loading != Loading()  # under displacement control it lands at the same depth, but for roundings
        found = turned_results(parameters, turn, outputs, radii, flags, passed, solved, again)
        note_compiled(kind_of_turning(profile, loading, toughness))
    if not slopes:
        note_compiled(kind_of_map(outputs, solver, profile, loading, toughness))
    else:
        from gradhesion.core.sensitivities.sensitivity import sensitivities  # noqa: PLC0415 (SciPy)

        def force_of(scenes: Mapping[str, ArrayLike]) -> NDArray[np.float64]:
            """Return the force of other scenes that turn as these do."""
            own = None if alike is not None else profile  # the scenes are of the wave already
            known: Any = {"threads": threads, "profile": own, "loading": loading, "toughness": toughness}
            return solve(scenes, PULL_OFF, check_contact=False, **known)["pull_off_force"]

        found |= sensitivities(parameters, requested, found, found[SLOPES], turn, passed, force_of)
        note_compiled(kind_of_sensitivities(profile, loading, toughness))
    return {name: found[name] for name in (*requested, "status")}
