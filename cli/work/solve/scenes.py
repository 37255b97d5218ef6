"""Scenes as a study gives them, solved by the core for outputs of every sort, in SI units as well."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion import core
from gradhesion.cli.names.outputs import OF_PHYSICAL, PARAMETER, PHYSICAL_PARAMETER, SI
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.core import PARAMETERS, RANGE, SENSITIVITIES, VALIDITY
from gradhesion.core.closed.reach import is_steep
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import CONTACT_SLOPE
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import NO_VALUE

Arrays = dict[str, NDArray[Any]]


def solve_given(
    study: Study,
    given: Arrays,
    block: Block,
    threads: int | None,
    *,
    outputs: tuple[str, ...] | None = None,
    watch: bool = False,
    scenes: Arrays | None = None,
) -> Arrays:
    """Solve scenes that are given as those of a study are.

    Parameters
    ----------
    given
        What the study gives; the arrays broadcast to the scenes.
    block
        Which of its solvers, and which random punches.
    outputs
        What is solved for; by default the outputs of the study.
    watch
        Whether the slopes that contacts reach are looked at: see `solve`.
    scenes
        The parameters of the scenes, if they are known.

    Returns
    -------
    The outputs, those in SI units and by quantities with units, and `status`: along the solvers, if there are several,
    the scenes, and random punches.
    """
    study = study if outputs is None else replace(study, outputs=outputs)
    several, _, profiles = study.apart(block)
    solvers = study.method.solver
    scenes = scenes_from(given) if scenes is None else scenes
    settings: dict[str, Any] = {"check_contact": study.method.check_contact, "threads": threads, "watch": watch}
    settings |= driven_by(study)
    by_solver = []
    for solver in (solvers,) if isinstance(solvers, str) else solvers[several[0]]:
        each = [solve(scenes, study.outputs, solver=solver, profile=one, **settings) for one in profiles]
        by_solver.append(each[0] if study.spectrum is None else _stacked(each, each[0]["status"].ndim))
    found = by_solver[0] if isinstance(solvers, str) else _stacked(by_solver, 0)
    return found | _with_units(study, given, found)


def solve(
    scenes: Mapping[str, NDArray[np.float64]],
    outputs: Sequence[str],
    *,
    profile: Profile,
    watch: bool = False,
    **settings: Any,
) -> Arrays:
    """Solve scenes as `gradhesion.core.solve` does, for the outputs of `gradhesion.core.validity` as well.

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
    found: Arrays = core.solve(scenes, [*requested, *more], profile=profile, **settings)
    if watch:
        found[STEEP] = is_steep(found[CONTACT_SLOPE]).astype(np.int8)
    if known:
        from gradhesion.core.closed.applicability import validity  # noqa: PLC0415 (300 ms for SciPy)

        beside = validity(scenes, known, profile)
        shape = np.broadcast_shapes(found["status"].shape, *(values.shape for values in beside.values()))
        found = {
            name: np.broadcast_to(values, (*shape, *values.shape[len(shape) :]) if name in SENSITIVITIES else shape)
            for name, values in (found | beside).items()
        }
        failed = (found["status"] & NO_VALUE) != 0
        found |= {name: np.where(failed, np.nan, found[name]) for name in known}
    return {name: found[name] for name in (*outputs, *((STEEP,) if watch else ()), "status")}


def scenes_from(given: Arrays) -> Arrays:
    """Give the parameters of scenes as the core knows them, from what a study gives; NaN is one that does not exist."""
    if given.keys() >= {*PARAMETERS}:
        return given
    from gradhesion.core.closed.reduced import parameters_from  # noqa: PLC0415 (300 ms for SciPy)

    return parameters_from(given)


def driven_by(study: Study) -> dict[str, Any]:
    """Give the arguments of the core that say how the punch is driven, and what its edge meets."""
    return {"loading": study.loading, "toughness": study.toughness, "rate": study.rate}


def scales_of(study: Study, given: Mapping[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """Give what results of scenes are multiplied by for SI units, by the unit; nothing if the study has none."""
    if not study.in_si:
        return {}
    from gradhesion.core.closed.reduced import scales_in_si  # noqa: PLC0415 (300 ms for SciPy)

    scales = scales_in_si(given["R"], given["work_of_adhesion"])
    if any(UNITS[name] == "Pa" for name in study.in_si):
        from gradhesion.core.equations.quadrature import pressure_unit  # noqa: PLC0415 (300 ms for SciPy)

        scales["Pa"] = pressure_unit(given["R"], given["work_of_adhesion"])
    return scales


def _with_units(study: Study, given: Arrays, found: Arrays) -> Arrays:
    """Give results in SI units, and the sensitivities to quantities with units, where the study has them."""
    if study.spectrum is not None:  # whose punches are the last dimension
        given = {name: np.asarray(values)[..., None] for name, values in given.items()}
    scales = scales_of(study, given)
    more = {name + SI: found[name] * scales[UNITS[name]] for name in study.in_si}
    if PHYSICAL_PARAMETER not in study.labels:
        return more
    from gradhesion.core.answers.slopes_to_keys import POWERS, relative_slopes  # noqa: PLC0415 (300 ms for SciPy)

    plain = {name: values for name, values in given.items() if name != RANGE and INPUTS[name].gives != RANGE}
    quantities, parameters = study.labels[PHYSICAL_PARAMETER], study.labels[PARAMETER]
    for name in (one for one in study.outputs if one in SENSITIVITIES):
        slopes = relative_slopes(plain, quantities, parameters, found[name], POWERS[name])
        more[name + OF_PHYSICAL] = np.stack([*slopes.values()], axis=-1)
    return more


def _stacked(found: Sequence[Arrays], axis: int) -> Arrays:
    """Put results beside each other along a new axis."""
    return {name: np.stack([values[name] for values in found], axis) for name in found[0]}
