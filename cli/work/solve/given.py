"""Scenes from what a study gives, solved for its outputs, in SI units as well."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import OF_PHYSICAL, PARAMETER, PHYSICAL_PARAMETER, SI
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.work.solve.scenes import solve
from gradhesion.core import PARAMETERS, RANGE, SENSITIVITIES
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.profile import Profile

Arrays = dict[str, NDArray[Any]]


def scenes_from(given: dict[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """Give the parameters of scenes as the core knows them, from what a study gives; NaN is one that does not exist."""
    if given.keys() >= {*PARAMETERS}:
        return given
    from gradhesion.core.closed.reduced import parameters_from  # noqa: PLC0415 (300 ms for SciPy)

    return parameters_from(given)


def solve_given(
    study: Study,
    given: dict[str, NDArray[np.float64]],
    several: Block,
    block: Block,
    threads: int | None,
    *,
    outputs: tuple[str, ...] | None = None,
    watch: bool = False,
) -> Arrays:
    """
    Solve scenes that are given as those of a study are.

    Parameters
    ----------
    given
        What the study gives; the arrays broadcast to the scenes.
    several, block
        Which of its solvers, and the block whose punches these are.
    outputs
        What is solved for; by default the outputs of the study.
    watch
        Whether the slopes that contacts reach are looked at (scenes.py).

    Returns
    -------
    The outputs, those in SI units and by quantities with units, and `status`: along the solvers, if there are several,
    the scenes, and random punches.
    """
    study = study if outputs is None else replace(study, outputs=outputs)
    solvers, (*_, profiles) = study.method.solver, study.apart(block)
    requested = (solvers,) if isinstance(solvers, str) else solvers[several[0]]
    settings = {"check_contact": study.method.check_contact, **driven_by(study), "threads": threads, "watch": watch}
    found = solved_by(scenes_from(given), study, requested, profiles, **settings)
    scales = scales_of(study, given)
    if study.spectrum is not None:
        scales = {unit: scale[..., None] for unit, scale in scales.items()}
    found |= {name + SI: found[name] * scales[UNITS[name]] for name in study.in_si}
    if PHYSICAL_PARAMETER in study.labels:
        found |= physical_of(study, given, found)
    return found


def physical_of(
    study: Study, given: Mapping[str, NDArray[np.float64]], found: Mapping[str, NDArray[Any]]
) -> dict[str, NDArray[np.float64]]:
    """Give the sensitivities to quantities with units, from those that are found."""
    from gradhesion.core.answers.slopes_to_keys import POWERS, relative_slopes  # noqa: PLC0415 (300 ms for SciPy)

    plain = {name: values for name, values in given.items() if name != RANGE and INPUTS[name].gives != RANGE}
    if study.spectrum is not None:  # the last dimension of the scenes
        plain = {name: np.asarray(values)[..., None] for name, values in plain.items()}
    quantities, parameters, more = study.labels[PHYSICAL_PARAMETER], study.labels[PARAMETER], {}
    for name in (one for one in study.outputs if one in SENSITIVITIES):
        slopes = relative_slopes(plain, quantities, parameters, found[name], POWERS[name])
        more[name + OF_PHYSICAL] = np.stack([*slopes.values()], axis=-1)
    return more


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


def driven_by(study: Study) -> dict[str, Any]:
    """Give the arguments of the core that say how the punch is driven, and what its edge meets."""
    more = {"toughness": study.toughness, "rate": study.rate}
    return {"loading": study.loading} | {name: one for name, one in more.items() if one is not None}


def solved_by(
    scenes: Mapping[str, NDArray[np.float64]],
    study: Study,
    solvers: Sequence[str],
    profiles: Sequence[Profile],
    **settings: Any,
) -> Arrays:
    """Solve scenes by each solver, the first dimension if the study has several, and of each punch, the last one."""
    found = []
    for solver in solvers:
        each = [solve(scenes, study.outputs, solver=solver, profile=one, **settings) for one in profiles]
        found.append(each[0] if study.spectrum is None else _over(each[0]["status"].ndim, each))
    return found[0] if isinstance(study.method.solver, str) else _over(0, found)


def _over(axis: int, found: Sequence[Mapping[str, NDArray[Any]]]) -> Arrays:
    """Put results beside each other along a new axis."""
    return {name: np.stack([values[name] for values in found], axis) for name in found[0]}
