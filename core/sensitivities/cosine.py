"""Sensitivities of arrays of scenes of one cosine wave under displacement control, from what is solved already."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.cosine import BRANCHES, run_tasks
from gradhesion.core.arrays.grouping import Task, grouped
from gradhesion.core.arrays.tables import interpolated_table, table_of
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.sensitivities.cosine_slopes import COUNT, sense_curves
from gradhesion.core.sensitivities.neighbours import neighbours_of


def sense_cosine(
    parameters: Mapping[str, ArrayLike],
    solved: Mapping[str, NDArray[Any]],
    workers: int,
    *,
    force: bool,
    energy: bool,
    turned: bool = False,
) -> NDArray[np.float64]:
    """Find d ln(value)/d ln of M, lambda, A, a_max, and d ln(value)/dk at fixed M.

    Parameters
    ----------
    parameters, workers
        As those of `solve`.
    solved
        pull_off_force, pull_off_radius, dissipated_energy and status of the scenes, those that are asked for.
    force, energy
        What is asked for.
    turned
        Whether the rims are places where cycles turn at a depth.

    Returns
    -------
    Array of shape (3, 5, *scenes), of the force, of the energy, and, where the force is met at a place where cycles
    turn, the derivatives of the depth there, in R; NaN where there is no positive value.
    """
    curves = grouped(parameters)
    (rims,) = curves.rims
    status = np.ascontiguousarray(solved["status"].reshape(curves.size))
    energies = solved["dissipated_energy"] if energy else np.zeros(status.shape)
    radii = solved["pull_off_radius"] if force else np.zeros(status.shape)
    energies, radii = (np.ascontiguousarray(array.reshape(curves.size)) for array in (energies, radii))
    found = np.full((3, COUNT, *curves.size), math.nan)

    def work(tables: NDArray[Any], task: Task, stiffness: NDArray[np.float64]) -> None:
        scratch = np.empty((ROWS, BRANCHES))
        source = interpolated_table if task.interpolated else table_of
        for number, table in enumerate(tables):
            near = neighbours_of(float(table["k"]), source)
            curves_of = (task.index[task.which == number], stiffness, curves.lambda_over_R, curves.A, rims)
            sense_curves(table, *near, *curves_of, force, energy, energies, radii, turned, found, status, scratch)

    run_tasks(curves, workers, work)
    return found.reshape((3, COUNT, *curves.shape))
