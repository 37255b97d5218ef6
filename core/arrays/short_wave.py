"""Arrays of scenes by the leading form of short waves, in tasks of one gradient exponent or many of few curves each."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.cosine import run_tasks
from gradhesion.core.arrays.grouping import Task, grouped
from gradhesion.core.problem.curves import Curves
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.results import Results, slots_of, typed
from gradhesion.core.problem.shape import depth_factor_of, in_own_wavelength
from gradhesion.core.scene.short_wave import solve_curves


def solve_short_waves(
    parameters: Mapping[str, ArrayLike], outputs: Sequence[str], profile: Profile, threads: int | None
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of the broadcast parameters under displacement control, as `solve` of core/sweep.py."""
    rows = list(dict.fromkeys(outputs))
    curves = grouped(parameters)
    slots = slots_of(rows, check_contact=False, turned=False)
    out = np.full((len(rows), *curves.size), np.nan)
    status = np.zeros(curves.size, dtype=np.int8)
    results = Results(slots, out, status)
    n, series = in_own_wavelength(profile)
    wavelength, amplitude = curves.lambda_over_R / n, n * curves.A

    def work(tables: NDArray[Any], task: Task, stiffness: NDArray[np.float64]) -> None:
        factors = np.array([depth_factor_of(k, profile.exponent) for k in np.clip(task.exponents, 0.0, 1.0).tolist()])
        own = Curves(tables, task.which, task.index, stiffness, wavelength, amplitude, curves.rims[0])
        solve_curves(own, series, profile.exponent, factors, results)

    run_tasks(curves, threads, work, forces=True)
    found = {name: typed(name, out[rows.index(name)]).reshape(curves.shape) for name in outputs}
    return found | {"status": status.reshape(curves.shape)}
