"""Scenes as a study gives them, solved by the core for outputs of every sort, in SI units as well, or as curves."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion import core
from gradhesion.cli.names.curves import CURVES, INTEGERS, RAGGED, STATE_CURVES, is_ragged
from gradhesion.cli.names.outputs import OF_PHYSICAL, PARAMETER, PHYSICAL_PARAMETER, SI, UNITS
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.core import PARAMETERS, RANGE, SENSITIVITIES, VALIDITY
from gradhesion.core.closed.reach import is_steep, slopes_of
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import CONTACT_SLOPE
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import NO_VALUE

Arrays = dict[str, NDArray[Any]]

_CONTACT_RADII: Final = tuple(
    name for own in CURVES.values() for name, about in own.items() if about.startswith("contact radius")
)
"""The variables with the radii of contact that are drawn."""


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
    """Solve scenes that are given as those of a study are, by the solvers and for the random punches of a block.

    Gives the outputs (by default those of the study), in SI units and by quantities with units as well, and `status`:
    along several solvers, the scenes, and random punches. `watch` is that of `solve`, `scenes` saves their making.
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


def value_slopes(study: Study, given: Arrays, keys: Sequence[str], name: str, found: Arrays) -> Arrays:
    """Give the slopes of a value, in SI units or not, to keys of a study, by the sensitivities that were found."""
    from gradhesion.core.answers.slopes_to_keys import POWERS, slopes_to_keys  # noqa: PLC0415 (300 ms for SciPy)

    sensitivity = f"{name.removesuffix(SI)}_sensitivity"
    labels = replace(study, outputs=(sensitivity,)).labels[PARAMETER]
    powers = POWERS[sensitivity] if name.endswith(SI) else {}
    return slopes_to_keys(given, keys, labels, found[name], found[sensitivity], powers)


def _stacked(found: Sequence[Arrays], axis: int) -> Arrays:
    """Put results beside each other along a new axis."""
    return {name: np.stack([values[name] for values in found], axis) for name in found[0]}


def blank_of(variable: str) -> float:
    """Give what stands where a curve has no point."""
    return -1 if variable in INTEGERS else np.nan


def draw(study: Study, block: Block) -> Arrays:
    """Draw the curves of one scene, along one more dimension than its block; without any, a point of no value.

    Ragged curves have their own dimension alone.
    """
    given = study.parameters_of(block)
    scene = {name: float(values.item()) for name, values in scenes_from(given).items()}
    requested = [curve for curve, own in CURVES.items() if any(name in own for name in study.outputs)]
    of_states = [curve for curve in requested if curve in STATE_CURVES]
    curves = [curve for curve in requested if curve not in STATE_CURVES]
    found, status = core.draw_curves(scene, curves, study.profile, **driven_by(study))
    if of_states:
        more, flags = _of_states(study, scene, of_states)
        found, status = found | more, status | flags
    for curve, count in RAGGED.items():
        if curve in curves:
            found[count] = np.array(np.size(found[next(name for name in CURVES[curve] if name in found)]))
    front, parts = (1,) * len(block), {}
    for name in study.outputs:
        values = np.asarray(found[name])
        if not is_ragged(name):
            values = values if values.size else np.array([blank_of(name)])
            values = values.reshape((*front, *values.shape)).astype(INTEGERS.get(name, values.dtype), copy=False)
        parts[name] = values
    scales = scales_of(study, given)
    parts |= {name + SI: parts[name] * scales[UNITS[name]].item() for name in study.in_si}
    parts["status"] = np.full(front, status, dtype=study.status_type)
    radii = [np.ravel(found[name]) for name in _CONTACT_RADII if name in found] + [np.array(study.states)]
    steep = not study.is_cone and bool(is_steep(slopes_of(np.concatenate(radii), study.profile)).any())
    return parts | {STEEP: np.full(front, steep, dtype=np.int8)}


def _of_states(study: Study, scene: Mapping[str, float], curves: Sequence[str]) -> tuple[Arrays, int]:
    """Draw the curves of the states of one scene: those of given radii, or the named ones of its cycle."""
    from gradhesion.core.draw import states  # noqa: PLC0415 (300 ms for SciPy)

    if study.states:
        chosen = states.equilibrium_states(scene, study.states, study.profile)
        status = NO_VALUE if np.isnan(chosen).all() else 0
    else:
        chosen, status = states.named_states(scene, study.profile, study.loading)
    return states.draw_states(scene, chosen, curves, study.profile), status
