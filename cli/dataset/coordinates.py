"""The coordinates of a study's dataset: its solvers, if there are several, and the parameters of its scenes."""

from functools import partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.variable import Variable
from gradhesion.cli.names.curves import NAMED_STATES, STATE, is_of_a_state
from gradhesion.cli.names.scenes import IDLE, REALISATION, REALISATIONS, SOLVER, SOLVERS
from gradhesion.cli.study.files import COMMENT
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, shape_of
from gradhesion.cli.work.solve.given import scenes_from
from gradhesion.core.problem.inputs import INPUTS, REDUCED

RMS: Final = {
    "A": "rms height over wavelength of the random waviness",
    "amplitude": "rms height A lambda of the random waviness",
    "chi": "roughness parameter chi = r/s of one cosine as high as the rms height of the random waviness",
}
"""What the amplitude is of random roughness."""


def coordinates(study: Study) -> dict[str, Variable]:
    """Describe the coordinates of a study's dataset."""
    axes = tuple(study.axes)
    described = {}
    if SOLVER in study.sizes:
        solvers = np.array(study.method.solver, dtype=object)
        described[SOLVER] = Variable(
            dimensions=(SOLVER,), dtype="str", attributes={"long_name": SOLVERS}, values=solvers
        )
    if study.spectrum is not None:
        described[REALISATION] = Variable(
            dimensions=(REALISATION,),
            dtype="i4",
            attributes={"units": "1", "long_name": REALISATIONS},
            values=np.arange(study.spectrum.realisations, dtype=np.int32),
        )
    if any(is_of_a_state(name) for name in study.outputs):
        described[STATE] = _states(study)
    for name, own_labels in study.labels.items():
        values = np.array(own_labels, dtype=object)
        attributes = {"long_name": "parameter of the sensitivity"}
        described[name] = Variable(dimensions=(name,), dtype="str", attributes=attributes, values=values)
    made_ones = study.made
    for name, key in INPUTS.items():
        if name not in study.parameters and name not in made_ones:
            continue
        attributes = {"units": key.unit, "long_name": key.about}
        if name in study.left_out:
            attributes["comment"] = f"{IDLE} where {key.idle_without} = 0; the study leaves it out"
        if study.spectrum is not None:
            attributes["long_name"] = RMS.get(name, key.about)
        if name in study.points.inputs:
            attributes["comment"] = COMMENT + study.points.file
        if name in study.parameters:
            values = np.asarray(study.parameters[name])
            if study.layout == "points":
                own, values = axes, np.broadcast_to(values, tuple(study.axes.values()))
            else:
                own = (name,) if name in axes else ()
            described[name] = Variable(dimensions=own, dtype="f8", attributes=attributes, values=values)
        else:
            own = following(study, name)
            made = partial(_made, study, name, own)
            blank = np.nan if REDUCED.keys() & study.parameters.keys() else None  # where there is no a_2
            described[name] = Variable(dimensions=own, dtype="f8", attributes=attributes, made=made, blank=blank)
    return described


def _states(study: Study) -> Variable:
    """Describe the states whose curves are drawn: their contact radii, or their names."""
    if study.states:
        attributes = {"units": "1", "long_name": "contact radius a/R of a state of equilibrium"}
        return Variable(dimensions=(STATE,), dtype="f8", attributes=attributes, values=np.array(study.states))
    attributes = {"long_name": "state of a loading cycle"}
    values = np.array(NAMED_STATES)
    return Variable(dimensions=(STATE,), dtype="str", attributes=attributes, values=values)


def following(study: Study, name: str) -> tuple[str, ...]:
    """Name the axes along which a parameter varies that is not given but made from others."""
    from gradhesion.core.closed.reduced import sources_of  # noqa: PLC0415 (300 ms for SciPy)

    sources = sources_of(name, dict.fromkeys(study.given))
    return tuple(axis for axis in study.axes if axis in sources or study.layout == "points")


def _made(study: Study, name: str, own: tuple[str, ...], block: Block) -> NDArray[Any]:
    """Compute a block, of its own axes, of a parameter that is made from others."""
    cuts = dict(zip(own, block, strict=True))
    whole = tuple(cuts.get(axis, slice(0, 1)) for axis in study.axes)
    given = study.parameters_of(whole) | {one.name: np.asarray(one.low) for one in study.search.inputs}
    return np.broadcast_to(scenes_from(given)[name], shape_of(whole)).reshape(shape_of(block))
