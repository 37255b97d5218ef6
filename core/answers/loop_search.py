"""Where to start a fit of a loop: combinations over the searched ranges whose loops are like the measured one.

There are many local minima, each with another number of waves in the contact. A Sobol set over the ranges is ranked by
the force and the depth of the last contact, which cost microseconds; the best have their paths drawn and compared with
some of the points.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from gradhesion.core.answers.loop_misfit import Misfit
from gradhesion.core.answers.loop_points import OFFSETS
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.sweep import solve
from gradhesion.core.variables.reduced import parameters_from

_Array = NDArray[np.float64]

_MANY: Final = 32
"""Combinations whose force and last depth are found for one whose path is drawn."""
_COARSE: Final = 60
"""Points that candidates are compared with."""


def starts_of(misfit: Misfit, candidates: int, seed: int) -> _Array:
    """Draw candidates and compare their paths with the points.

    Parameters
    ----------
    misfit
        The loop.
    candidates
        How many have their paths drawn, of 32 times as many.
    seed
        Of the Sobol set.

    Returns
    -------
    The candidates that have a path, shape (n, unknown), the best first.

    Raises
    ------
    ValueError
        None has one.
    """
    count = 2 ** math.ceil(math.log2(_MANY * candidates))
    drawn = qmc.Sobol(misfit.low.size, seed=seed).random(count)
    drawn[:, misfit.physical :] = 0.5  # offsets are searched later
    vectors = misfit.low + drawn * (misfit.high - misfit.low)
    vectors = vectors[np.argsort(_apart(misfit, vectors), kind="stable")[:candidates]]
    coarse = slice(None, None, max(1, misfit.back.size // _COARSE))
    sizes = np.array([misfit.size(vector, coarse) for vector in vectors])
    with_path = sizes < misfit.nothing * misfit.back[coarse].size
    if not with_path.any():
        raise ValueError("no combination within the ranges has a path; widen them")
    order = np.argsort(sizes, kind="stable")
    return np.asarray(vectors[order][: np.count_nonzero(with_path)])


def _apart(misfit: Misfit, vectors: _Array) -> _Array:
    """Return how far vectors (n, unknown) have force and depth of the last contact from the data's, in spans: (n,)."""
    own = misfit.model.values(vectors)
    given = misfit.model.given({name: values for name, values in own.items() if name not in OFFSETS})
    made = parameters_from(given)
    R, work = given["R"], given["work_of_adhesion"]
    scenes = {name: made[name] for name in PARAMETERS}
    if "machine_stiffness" in made:
        scenes["machine_stiffness"] = made["machine_stiffness"]
    wanted = ("pull_off_force", "delta_jump_out")
    model = misfit.model
    found = solve(scenes, wanted, check_contact=False, profile=model.profile, loading=model.loading)
    depth, load = (misfit.points * misfit.scale).T
    pulled = misfit.back & (load < 0.1 * load.min())
    last = float(depth[pulled].min()) if pulled.any() else float(depth.min())
    force, out = 1.5 * math.pi * R * work * found["pull_off_force"], R * found["delta_jump_out"]
    size = ((force + load.min()) / misfit.span[1]) ** 2 + ((out - last) / misfit.span[0]) ** 2
    return np.broadcast_to(np.where(np.isfinite(size), size, np.inf), vectors.shape[:1])
