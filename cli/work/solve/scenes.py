"""Scenes solved for outputs of every sort: those of the solvers, and those that are known without solving."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion import core
from gradhesion.cli.names.scenes import STEEP
from gradhesion.core import SENSITIVITIES, VALIDITY
from gradhesion.core.closed.reach import is_steep
from gradhesion.core.problem.names import CONTACT_SLOPE
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import NO_VALUE


def solve(
    scenes: Mapping[str, NDArray[np.float64]],
    outputs: Sequence[str],
    *,
    profile: Profile,
    watch: bool = False,
    **settings: Any,
) -> dict[str, NDArray[Any]]:
    """
    Solve scenes as `gradhesion.core.solve` does, for the outputs of `gradhesion.core.validity` as well.

    All have the shape of all parameters together; where a scene has no value, none has. With `watch` comes `STEEP`:
    1 where the contact reaches a slope of the punch that is not small.

    >>> ball = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=1.0, lambda_over_R=0.1, A=0.01, a_max_over_R=1.0)
    >>> found = solve(ball, ["wave_slope", "pull_off_force"], profile=Profile())
    >>> list(found), round(float(found["wave_slope"]), 4)
    (['wave_slope', 'pull_off_force', 'status'], 0.0628)
    """
    known = [name for name in outputs if name in VALIDITY]
    requested = [name for name in outputs if name not in known]
    more = [CONTACT_SLOPE] if watch and CONTACT_SLOPE not in requested else []
    solved = core.solve(scenes, [*requested, *more], profile=profile, **settings)
    if watch:
        solved[STEEP] = is_steep(solved[CONTACT_SLOPE]).astype(np.int8)
    if more:
        del solved[CONTACT_SLOPE]
    if not known:
        return solved
    from gradhesion.core.closed.applicability import validity  # noqa: PLC0415 (300 ms for SciPy)

    found: dict[str, NDArray[Any]] = {**validity(scenes, known, profile)}
    shape = np.broadcast_shapes(solved["status"].shape, *(values.shape for values in found.values()))
    whole = {
        name: np.broadcast_to(values, (*shape, *values.shape[len(shape) :]) if name in SENSITIVITIES else shape)
        for name, values in (solved | found).items()
    }
    failed = (whole["status"] & NO_VALUE) != 0
    whole |= {name: np.where(failed, np.nan, whole[name]) for name in known}
    return {name: whole[name] for name in (*outputs, *((STEEP,) if watch else ()), "status")}
