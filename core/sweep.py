"""Arrays of scenes, solved in groups that share what they can.

Scenes of one gradient exponent share its table; all a_max of one curve share its trace. What is asked for decides
what is computed. The work is cut into tasks of a fixed size, so that results do not depend on the number of threads.
"""

import math
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.branches import ROWS
from gradhesion.core.cache import note_compiled
from gradhesion.core.general.envelope import solve_envelope
from gradhesion.core.general.report import report_general
from gradhesion.core.general.sweep import equivalent_wave, solve_general
from gradhesion.core.kinds import kind_of_map
from gradhesion.core.loading_control import Loading
from gradhesion.core.material import fill_stiffness
from gradhesion.core.names import OUTPUTS, PARAMETERS, REPORTS, SOLVERS
from gradhesion.core.processors import processors
from gradhesion.core.profile import Profile
from gradhesion.core.report import NEEDED, report_curves
from gradhesion.core.results import typed
from gradhesion.core.solvers import LOOPS, PULL_OFF_LOOP
from gradhesion.core.status import NO_VALUE
from gradhesion.core.struve.table import build_table

_TASK: Final = 2048
"""Scenes a task: some milliseconds, a thousand times the cost of handing it to a thread."""
_BRANCHES: Final = 192
"""Branches of a curve that a task has room for."""

table_of = lru_cache(maxsize=128)(build_table)
"""The table of an exponent, kept for the next call (56 kB each)."""


def _shared_axes(shapes: Sequence[tuple[int, ...]], dimensions: int) -> int:
    """Return how many of the last axes only a_max varies along."""
    for axis in range(dimensions):
        if any(shape[dimensions - 1 - axis] > 1 for shape in shapes):
            return axis
    return dimensions


def _flat(array: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    return np.array(np.broadcast_to(array, shape), order="C").reshape(math.prod(shape))


def solve(
    parameters: Mapping[str, ArrayLike],
    outputs: Sequence[str] = ("pull_off_force", "dissipated_energy"),
    *,
    solver: str = "exact",
    check_contact: bool = True,
    threads: int | None = None,
    profile: Profile | None = None,
    loading: Loading | None = None,
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of the broadcast parameters.

    Parameters
    ----------
    parameters
        An array for each name of `PARAMETERS`, all broadcastable: k in [0, 1], nu in (-1, 0.5] (0.5 where k = 1),
        modulus E* R/dgamma > 0, c0/R > 0, lambda/R > 0, A = amplitude/lambda >= 0, a_max/R > 0 or inf. Scenes that
        differ along the last axes in a_max alone are solved on one trace.
    outputs
        Names out of `OUTPUTS`: pull_off_force in 1.5 pi R dgamma, pull_off_radius in R, dissipated_energy of one
        cycle of displacement-controlled loading to full contact and unloading in R^2 dgamma, loading_jumps and
        unloading_jumps (jump-in and jump-out counted), delta_max and delta_jump_out in R: the
        depths at which full contact is reached, and from which contact ends, also where the displacement is not what is
        controlled; loading_energy and unloading_energy in R^2 dgamma, the two parts of dissipated_energy. With the
        exact solver also those of `REPORTS`: pull_off_force_error and dissipated_energy_error, estimates in the unit of
        the value (of rounding, and of the sum over waves); energy_residual, the energy less the loop integral of the
        load, whose own rounding is that of the load (NaN beyond 2,000 waves); roughness_parameter chi = r/s;
        saturation_radius in R, beyond which there is no fold; adhesion_gain and energy_gain over the smooth punch of
        the same material and rim.
    solver
        One of `SOLVERS`.
    check_contact
        Tell in `status` where loading does not keep the contact one disc (a tenth of the time of a cycle). It needs the
        loading path: it is told where any output but the two of the pull-off is asked for, by the exact solver only.
    threads
        Number of threads; all processors if not given. Results do not depend on it.
    profile
        The shape of the punch, a paraboloid with one cosine wave if not given. Another control needs the exact solver,
        another shape that or the envelopes; under load control there is no energy_residual.
    loading
        What is prescribed, the displacement if not given. With control "machine" `parameters` also has
        machine_stiffness, S/(E* R) > 0, which broadcasts with the others. Under load control dissipated_energy leaves
        the jump-out out: under a dead load it has no bound.

    Returns
    -------
    An array of the broadcast shape for each output (float64; int32 for jumps, 2^31 - 1 for more) and `status` (int8,
    bits of status.FLAGS). A scene outside the ranges has NaN (-1 jumps) and the bit no_value; delta_max of an
    unbounded punch is inf.

    Raises
    ------
    ValueError
        For an unknown output or solver, or parameters that are missing or do not broadcast; for a solver or an output
        that another profile or control does not have.

    Notes
    -----
    Sections 2-5 of Jin, Guo & Wan (2013) as corrected in docs/theory.md. On 2,184 scenes solved to 30 digits by another
    method (tests/twin) the force is right to 2e-15, the energy to 4e-15 where every wave is walked and to 2e-13 where
    waves are summed (on longer curves 1e-12, up to 4 10^15 waves), and all jumps are counted right.

    Examples
    --------
    The smooth punch on a homogeneous half-space (Johnson, Kendall & Roberts 1971), and one with waviness:

    >>> scene = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, a_max_over_R=np.inf)
    >>> solve(scene | {"A": [0.0, 0.02]})["pull_off_force"].round(6).tolist()
    [1.0, 1.342098]
    """
    reports = [name for name in outputs if name in REPORTS]
    unknown = [name for name in outputs if name not in OUTPUTS and name not in reports]
    missing = [name for name in PARAMETERS if name not in parameters]
    if unknown or missing or solver not in SOLVERS:
        raise ValueError(f"unknown outputs {unknown}, missing parameters {missing}, solver {solver!r}")
    if reports and solver != "exact":
        raise ValueError(f"outputs {reports} are known of the exact solver only, not of {solver!r}")
    profile, loading = profile or Profile(), loading or Loading()
    kind = kind_of_map(outputs, solver, profile, loading)
    if ("machine_stiffness" in parameters) != (loading.control == "machine"):
        raise ValueError(f"machine_stiffness belongs to control 'machine' and to no other; control {loading.control!r}")
    if profile != Profile() or loading != Loading():
        if loading.control == "load" and "energy_residual" in reports:
            raise ValueError("energy_residual: a dead load closes no loop; ask for it under another control")
        if solver == "asymptotic" or (solver != "exact" and loading != Loading()):
            raise ValueError(
                f"solver {solver!r} is known of the paraboloid with one cosine wave under displacement control only; "
                "another profile has the exact solver and the envelopes, another control the exact solver"
            )
        alike = equivalent_wave(profile) if loading == Loading() else None
        if alike is None and solver == "envelope":
            results = solve_envelope(parameters, PARAMETERS, outputs, profile)
            note_compiled(kind)
            return results
        if alike is None:
            workers = threads or processors()
            wanted = [name for name in outputs if name in OUTPUTS]
            wanted += [NEEDED[name] for name in reports if name in NEEDED]
            found = solve_general(
                parameters, PARAMETERS, wanted, profile, loading, workers, check_contact=check_contact
            )
            if reports:
                found |= report_general(parameters, PARAMETERS, reports, found, profile, loading, workers)
            note_compiled(kind)
            return {name: found[name] for name in (*outputs, "status")}
        wavelengths_a_wave, amplitude_factor = alike
        parameters = {
            **parameters,
            "lambda_over_R": np.asarray(parameters["lambda_over_R"], dtype=float) / wavelengths_a_wave,
            "A": np.asarray(parameters["A"], dtype=float) * amplitude_factor,
        }
    rows = list(dict.fromkeys([*outputs, *(NEEDED[name] for name in reports if name in NEEDED)]))
    arrays = [np.asarray(parameters[name], dtype=float) for name in PARAMETERS]
    shape = np.broadcast_shapes(*(array.shape for array in arrays))
    arrays = [array.reshape((1,) * (len(shape) - array.ndim) + array.shape) for array in arrays]
    shared = _shared_axes([array.shape for array in arrays[:-1]], len(shape))
    curve_shape, rim_shape = shape[: len(shape) - shared], shape[len(shape) - shared :]
    lead = (slice(None),) * len(curve_shape) + (0,) * shared
    k, nu, modulus, c0, wavelength, amplitude = (array[lead] for array in arrays[:-1])
    a_max = arrays[-1]
    own_rims = any(length > 1 for length in a_max.shape[: len(curve_shape)])
    rims = _flat(a_max, (curve_shape if own_rims else (1,) * len(curve_shape)) + rim_shape).reshape(
        -1, math.prod(rim_shape)
    )

    without_rim = ~(rims > 0.0)
    rims[without_rim] = math.inf

    curves = math.prod(curve_shape)
    slots = np.array([*(rows.index(name) if name in rows else -1 for name in RESULTS), int(check_contact) - 1, int(turned)])
    slots_of_reports = np.array([rows.index(name) if name in reports else -1 for name in REPORTS])
    out = np.empty((len(rows), curves, rims.shape[1]))
    status = np.zeros((curves, rims.shape[1]), dtype=np.int8)
    exponents = _flat(k, curve_shape)
    nus, moduli, depths, wavelengths, amplitudes = (
        _flat(each, curve_shape) for each in (nu, modulus, c0, wavelength, amplitude)
    )
    stiffnesses = np.empty(curves)
    solve_curves = PULL_OFF_LOOP if kind == "force" else LOOPS[solver]

    def work(task: tuple[float, NDArray[np.int64]]) -> None:
        exponent, index = task
        fill_stiffness(exponent, index, nus, moduli, depths, stiffnesses)
        table = table_of(exponent if 0.0 <= exponent <= 1.0 else 0.0)  # beyond, the stiffness has no value
        scratch = np.empty((ROWS, _BRANCHES))
        curves_of = (table, index, stiffnesses, wavelengths, amplitudes, rims)
        solve_curves(*curves_of, slots, out, status, scratch)
        if reports:
            report_curves(*curves_of, slots, slots_of_reports, out, status, scratch)

    tasks = list(_tasks(exponents, max(1, _TASK // max(1, rims.shape[1]))))
    workers = min(threads or processors(), len(tasks))
    if workers > 1:
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(work, tasks))
    else:
        for task in tasks:
            work(task)

    note_compiled(kind)
    if without_rim.any():
        out[:, np.broadcast_to(without_rim, status.shape)] = math.nan
        status[np.broadcast_to(without_rim, status.shape)] = NO_VALUE
    result: dict[str, NDArray[Any]] = {}
    for name in outputs:
        result[name] = typed(name, out[rows.index(name)]).reshape(shape)
    result["status"] = status.reshape(shape)
    return result


def _tasks(k: NDArray[np.float64], size: int) -> list[tuple[float, NDArray[np.int64]]]:
    """Cut the curves into tasks of one exponent each."""
    if k.size == 0:
        return []
    order = np.arange(k.size) if np.all(k[1:] >= k[:-1]) else np.argsort(k, kind="stable")
    ordered = k[order]
    first = np.flatnonzero(np.concatenate([[True], ordered[1:] != ordered[:-1]]))
    tasks = []
    for exponent, group in zip(ordered[first].tolist(), np.split(order, first[1:]), strict=True):
        tasks += [(exponent, group[i : i + size]) for i in range(0, group.size, size)]
    return tasks
