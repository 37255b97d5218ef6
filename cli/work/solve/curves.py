"""The curves of a scene, each as long as it needs to be."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from gradhesion import core
from gradhesion.cli.names.curves import CURVES, INTEGERS, RAGGED, STATE_CURVES, is_ragged
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.work.solve.scenes import Arrays, driven_by, scales_of, scenes_from
from gradhesion.core.closed.reach import is_steep, slopes_of
from gradhesion.core.problem.status import NO_VALUE

_CONTACT_RADII: Final = tuple(
    name for own in CURVES.values() for name, about in own.items() if about.startswith("contact radius")
)
"""The variables with the radii of contact that are drawn."""


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
