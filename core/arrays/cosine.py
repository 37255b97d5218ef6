"""Arrays of scenes of one cosine wave under displacement control, in tasks of one gradient exponent.

The work is cut into tasks of a fixed size, so that results do not depend on the number of threads.
"""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

import math
from collections.abc import Callable, Mapping, Sequence
from inspect import unwrap
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.grouping import Grouped, Task, grouped
from gradhesion.core.arrays.tables import neighbours_for, tables_for
from gradhesion.core.arrays.tasks import run_one_by_one
from gradhesion.core.compiler.marks import note_compiled
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.kinds import MANY_SMOOTH
from gradhesion.core.path.cosine import is_endless_wave
from gradhesion.core.problem.curves import Curves
from gradhesion.core.problem.material import fill_stiffness
from gradhesion.core.problem.names import PARAMETERS, PULL_OFF, REPORTS
from gradhesion.core.problem.results import Results, slots_of, typed
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scene.cosine_report import NEEDED, report_curves
from gradhesion.core.scene.smooth import ROWS as SMOOTH_ROWS
from gradhesion.core.scene.smooth import SCENES as SMOOTH_SCENES
from gradhesion.core.scene.smooth import solve_smooth
from gradhesion.core.scene.solvers import LONG_LOOP, LOOPS, PULL_OFF_LOOP
from gradhesion.core.sensitivities.cosine_slopes import COUNT, Sense
from gradhesion.core.sensitivities.wanted import NoSense
from gradhesion.core.turning.cosine import turn_curves
from gradhesion.core.turning.turns import Turns

SLOPES: Final = "slopes"
"""The name of the sensitivities to the numbers of a scene, from which those to its parameters are computed."""
BRANCHES: Final = 192
"""Branches of a curve that a task has room for."""
_SENSED: Final = 64
"""Exponents of a task whose neighbours have tables too, four each."""
_SMOOTH: Final = 16384
"""Smooth scenes of a task, solved in half a millisecond."""
_are_endless: Final[Any] = unwrap(is_endless_wave)
"""The same of arrays, without numba."""
_NO_CURVES: Final = np.empty(0, dtype=np.int64)


def run_tasks(
    curves: Grouped,
    threads: int | None,
    work: Callable[[NDArray[Any], Task, NDArray[np.float64]], None],
    *,
    forces: bool = False,
    **how: Any,
) -> None:
    """Do the work on every task: with the tables of its exponents, the task itself, and the stiffness of all curves.

    With `forces` the tables are for pull-off forces only; `how` to cut curves into tasks is as in `Grouped.tasks`.
    """
    stiffness = np.empty(curves.k.size)

    def one(task: Task) -> None:
        tables = tables_for(task, forces=forces)
        fill_stiffness(tables, task.which, task.index, curves.k, curves.nu, curves.modulus, curves.c0_over_R, stiffness)
        work(tables, task, stiffness)

    run_one_by_one(curves.tasks(**how), one, threads)


def curves_of(curves: Grouped, task: Task, tables: NDArray[Any], stiffness: NDArray[np.float64]) -> Curves:
    """Return the curves of a task as kernels read them; `stiffness` is that of all curves, of shape (curves,)."""
    return Curves(tables, task.which, task.index, stiffness, curves.lambda_over_R, curves.A, curves.rims[0])


def _smooth_and_others(curves: Grouped) -> tuple[NDArray[np.int64] | None, NDArray[np.int64] | None]:
    """Return the numbers (n,) of the curves that are solved as smooth ones, and of the others; None for all of them.

    They are those whose waves have no effect, if they have many scenes: the values are the same either way.
    """
    count, rims = curves.size
    if count * rims < MANY_SMOOTH:
        return _NO_CURVES, None
    with np.errstate(all="ignore"):  # a scene that overflows has no value
        smooth = _are_endless(curves.lambda_over_R, curves.A)
    if np.count_nonzero(smooth) * rims < MANY_SMOOTH:
        return _NO_CURVES, None
    return (None, _NO_CURVES) if smooth.all() else (np.flatnonzero(smooth), np.flatnonzero(~smooth))


def solve_cosine(
    parameters: Mapping[str, ArrayLike],
    outputs: Sequence[str],
    solver: str,
    threads: int | None,
    *,
    check_contact: bool = True,
    turned: bool = False,
    slopes: tuple[bool, int] | None = None,
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of the broadcast parameters, as `solve` of core/sweep.py: results of their shape.

    `turned` and `slopes` are as those of `solve_general` (arrays/general.py).
    """
    reports = [name for name in outputs if name in REPORTS]
    rows = list(dict.fromkeys([*outputs, *(NEEDED[name] for name in reports if name in NEEDED)]))
    curves = grouped(parameters)
    (rims,) = curves.rims
    without_rim = ~(rims > 0.0)
    some_without = bool(without_rim.any())
    if some_without:
        rims[without_rim] = math.inf
    slots = slots_of(rows, check_contact=check_contact, turned=turned)
    slots_of_reports = np.array([rows.index(name) if name in reports else -1 for name in REPORTS])
    out = np.empty((len(rows), *curves.size))
    status = np.zeros(curves.size, dtype=np.int8)
    results, of_reports = Results(slots, out, status), Results(slots_of_reports, out, status)
    only_force = solver == "exact" and slopes is None and set(outputs) <= set(PULL_OFF)
    solve_curves = PULL_OFF_LOOP if only_force else LOOPS[solver]
    sensed = np.full((3, COUNT, *curves.size), math.nan) if slopes else None
    of_force, of_energy = slopes or (False, 0)

    def work(tables: NDArray[Any], task: Task, stiffness: NDArray[np.float64]) -> None:
        scratch = np.empty((ROWS, BRANCHES))
        own = curves_of(curves, task, tables, stiffness)
        sense = NoSense() if sensed is None else Sense(*neighbours_for(task), sensed, of_force, of_energy, turned)
        if solve_curves(own, results, scratch, sense):
            LONG_LOOP(own, results, scratch, sense)
            note_compiled("long" if slopes is None else "long_sensitivities")
        if reports:
            report_curves(own, slots, of_reports, scratch)

    def work_on_smooth(tables: NDArray[Any], task: Task, stiffness: NDArray[np.float64]) -> None:
        own = curves_of(curves, task, tables, stiffness)
        solve_smooth(curves.k, own, results, np.empty((2, SMOOTH_ROWS, SMOOTH_SCENES)))
        if reports:
            report_curves(own, slots, of_reports, np.empty((ROWS, BRANCHES)))

    if slopes is not None:
        run_tasks(curves, threads, work, together=_SENSED)
    else:
        smooth, others = _smooth_and_others(curves) if solver == "exact" else (_NO_CURVES, None)
        if smooth is None or smooth.size > 0:
            many = {"some": smooth, "scenes": _SMOOTH, "together": _SMOOTH, "as_they_stand": not reports}
            run_tasks(curves, threads, work_on_smooth, forces=not reports, **many)
            note_compiled("smooth")
        run_tasks(curves, threads, work, forces=solve_curves is PULL_OFF_LOOP, some=others)
    if some_without:
        out[:, np.broadcast_to(without_rim, status.shape)] = math.nan
        status[np.broadcast_to(without_rim, status.shape)] = NO_VALUE
    found = {name: typed(name, out[rows.index(name)]).reshape(curves.shape) for name in outputs}
    if sensed is not None:
        found[SLOPES] = sensed.reshape((3, COUNT, *curves.shape))
    return found | {"status": status.reshape(curves.shape)}


def turning_cosine(
    parameters: Mapping[str, ArrayLike], turn: str, threads: int | None, *, check_contact: bool = True
) -> tuple[NDArray[np.float64], NDArray[np.int8]]:
    """Return where the cycles turn, and the bits of `status` for the turn.

    Parameters
    ----------
    parameters, turn, threads, check_contact
        As those of `solve`; `turn` is the one of `TURNS` that `parameters` has.

    Returns
    -------
    The radius a/R at which unloading starts, 0 where no contact is made, NaN where there is no value; and the bits
    close_to_a_jump (a step is within 4e-12 of the target's terms), loading_contact_not_one_disc (of the contact that
    turns) and no_value. Both have the broadcast shape.
    """
    curves = grouped(parameters, (*PARAMETERS[-1:], turn))
    rims, targets = curves.rims
    radii = np.empty(curves.size)
    flags = np.zeros(curves.size, dtype=np.int8)
    turns = Turns(rims, targets, turn == "load_max", check_contact, radii, flags)

    def work(tables: NDArray[Any], task: Task, stiffness: NDArray[np.float64]) -> None:
        turn_curves(curves_of(curves, task, tables, stiffness), turns, np.empty((ROWS, BRANCHES)))

    run_tasks(curves, threads, work)
    return radii.reshape(curves.shape), flags.reshape(curves.shape)
