"""The dataset of scenes whose parameters are arrays over named dimensions: as that of a study, over any dimensions."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.dataset import attributes, variables, with_steep_contact
from gradhesion.cli.dataset.model_range import slope_told
from gradhesion.cli.keys import INPUTS
from gradhesion.cli.names import PHYSICAL_PARAMETER, REALISATION, SI, SOLVER, STEEP, UNITS, labels_of
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import messages
from gradhesion.cli.work.given import physical_of, solved_by
from gradhesion.core import PARAMETERS
from gradhesion.core.variables.reduced import parameters_from, scales_in_si, sources_of

Arrays = Mapping[str, xarray.DataArray]


def solved(study: Study, parameters: Arrays, threads: int | None = None) -> xarray.Dataset:
    """
    Solve the scenes of a study whose parameters stand over dimensions of any names.

    Parameters
    ----------
    study
        What is asked for; its own parameters count by their names only. Without a text the dataset has no study.
    parameters
        The parameters of the study, in plain numbers (those with a unit in SI).
    threads
        Threads to use, all processors if None.

    Returns
    -------
    The dataset that `gradhesion.cli.dataset.compute` gives of a grid or of points, if the dimensions are theirs.
    """
    dims = dims_of(parameters)
    arrays = {name: _along(dims, array) for name, array in parameters.items()}
    scenes = arrays if arrays.keys() >= {*PARAMETERS} else parameters_from(arrays)
    found = _outputs(study, scenes, threads)
    steep = found.pop(STEEP, np.zeros(1, np.int8))
    if study.in_si:
        scales = scales_in_si(arrays["R"], arrays["work_of_adhesion"])
        if study.spectrum is not None:
            scales = {unit: scale[..., None] for unit, scale in scales.items()}
        found |= {name + SI: found[name] * scales[UNITS[name]] for name in study.in_si}
    if PHYSICAL_PARAMETER in study.labels:
        found |= physical_of(study, arrays, found)
    described = variables(study)
    apart = (*dims, *study.labels, SOLVER, REALISATION)
    beside = " ".join(name for name in described if name not in found and name not in apart)
    made = {}
    for name, variable in described.items():
        own, values = dims, found.get(name)
        given = {**variable.attributes}
        given.pop("coordinates", None)
        if values is not None:
            own = (
                *(one for one in (SOLVER,) if one in described),
                *dims,
                *(one for one in (REALISATION,) if one in described),
                *(one for one in (labels_of(name),) if one),
            )
            given |= {"coordinates": beside} if beside else {}
        elif name in parameters:
            own = tuple(dim for dim in dims if dim in parameters[name].dims)
            values = parameters[name].transpose(*own).values
        elif name in scenes:
            sources = [parameters[source] for source in sources_of(name, parameters)]
            own = tuple(dim for dim in dims if any(dim in source.dims for source in sources))
            values = scenes[name].reshape([size for dim, size in _sizes(parameters, dims).items() if dim in own])
        else:
            own, values = variable.dimensions, variable.values
        blank = {} if variable.blank is None else {"_FillValue": np.asarray(values).dtype.type(variable.blank)}
        made[name] = xarray.Variable(own, values, given | blank)
    about = attributes(study, "computed in memory")
    if not study.text:
        del about["study"], about["study_sha256"]
    dataset = with_steep_contact(xarray.decode_cf(xarray.Dataset(made, attrs=about)), study, steep)
    _say_once(tuple(slope_told(dataset)))
    return dataset.assign_coords(_other_coordinates(parameters, dataset))


@cache
def _say_once(sentences: tuple[str, ...]) -> None:
    """Say what a call has to report; in a loop that is the same many times, and is said once."""
    for sentence in sentences:
        messages.say("caution", f"gr.solve: {sentence}")


def dims_of(parameters: Arrays) -> tuple[str, ...]:
    """
    Name the dimensions of parameters: those of other names as they are met, then the axes as a study orders them.

    >>> A, k = xarray.DataArray([[0.1], [0.2]], dims=["nu", "x"]), xarray.DataArray([0.0, 0.5], dims="k")
    >>> dims_of({"A": A, "k": k})
    ('x', 'k', 'nu')
    """
    met = dict.fromkeys(str(dim) for array in parameters.values() for dim in array.dims)
    return (*(dim for dim in met if dim not in INPUTS), *(key for key in INPUTS if key in met))


def _along(dims: tuple[str, ...], array: xarray.DataArray) -> NDArray[np.float64]:
    """Give the values of an array with an axis for every dimension, of length 1 where it does not vary."""
    values = array.transpose(*(dim for dim in dims if dim in array.dims)).values
    return np.asarray(values).reshape([array.sizes.get(dim, 1) for dim in dims])


def _sizes(parameters: Arrays, dims: tuple[str, ...]) -> dict[str, int]:
    """Give the length of every dimension."""
    return {dim: next(array.sizes[dim] for array in parameters.values() if dim in array.dims) for dim in dims}


def _outputs(study: Study, scenes: Mapping[str, NDArray[np.float64]], threads: int | None) -> dict[str, NDArray[Any]]:
    """Solve the scenes, by one solver or by each of several."""
    settings: dict[str, Any] = {"check_contact": study.method.check_contact, "threads": threads}
    settings |= {"loading": study.loading, "watch": study.may_reach(scenes["a_max_over_R"])}
    solvers = study.method.solver
    asked = (solvers,) if isinstance(solvers, str) else solvers
    *_, profiles = study.apart(tuple(slice(0, size) for size in study.shape))
    return solved_by(scenes, study, asked, profiles, **settings)


def _other_coordinates(parameters: Arrays, dataset: xarray.Dataset) -> dict[str, xarray.DataArray]:
    """Find the coordinates that came with the parameters and are not theirs."""
    found: dict[str, xarray.DataArray] = {}
    for array in parameters.values():
        for name, coordinate in array.coords.items():
            if name not in dataset.variables:
                found.setdefault(str(name), coordinate.reset_coords(drop=True))
    return found
