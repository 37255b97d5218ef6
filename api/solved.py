"""The dataset of scenes whose parameters are arrays over named dimensions: like that of a study, any dimensions."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.dataset import attributes, variables, with_steep_contact
from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.variable import Variable
from gradhesion.cli.names.outputs import PHYSICAL_PARAMETER, SI, labels_of
from gradhesion.cli.names.scenes import REALISATION, SOLVER, STEEP
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import messages
from gradhesion.cli.work.solve.given import driven_by, physical_of, solved_by
from gradhesion.core import PARAMETERS
from gradhesion.core.closed.reduced import parameters_from, scales_in_si, sources_of
from gradhesion.core.problem.inputs import INPUTS

Arrays = Mapping[str, float | xarray.DataArray]
"""By name; a number is the same in all scenes."""


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
    sizes = sizes_of(parameters)
    arrays = {name: _along(sizes, value) for name, value in parameters.items()}
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
    apart = {*sizes, *study.labels, SOLVER, REALISATION}
    beside = [name for name in described if name not in found and name not in apart]
    made = {}
    for name, variable in described.items():
        own, values = variable.dimensions, found.get(name)
        if values is not None:
            own = (
                *(one for one in (SOLVER,) if one in described),
                *sizes,
                *(one for one in (REALISATION,) if one in described),
                *(one for one in (labels_of(name),) if one),
            )
        elif name in arrays:
            own = tuple(dim for dim in sizes if dim in _dims(parameters[name]))
            values = arrays[name].reshape([sizes[dim] for dim in own])
        elif name in scenes:
            sources = [parameters[source] for source in sources_of(name, parameters)]
            own = tuple(dim for dim in sizes if any(dim in _dims(source) for source in sources))
            values = scenes[name].reshape([sizes[dim] for dim in own])
        else:
            values = variable.values
        made[name] = _as_read(variable, own, np.asarray(values), beside if name in found else [])
    about = attributes(study, "computed in memory")
    if not study.text:
        del about["study"], about["study_sha256"]
    # Twice as fast as xarray.Dataset(made).set_coords(beside), and the same.
    dataset = xarray.Coordinates(made).to_dataset().reset_coords([name for name in described if name in found])
    dataset.attrs = about
    dataset = with_steep_contact(dataset, study, steep)
    _say_once(tuple(slope_warnings(dataset)))
    others = _other_coordinates(parameters, dataset)
    return dataset.assign_coords(others) if others else dataset


@cache
def _say_once(sentences: tuple[str, ...]) -> None:
    """Say what a call has to report; in a loop that is the same many times, and is said once."""
    for sentence in sentences:
        messages.say(f"gr.solve: {sentence}")


def _as_read(variable: Variable, dims: tuple[str, ...], values: NDArray[Any], beside: list[str]) -> xarray.Variable:
    """Give a variable as xarray reads it from a file, by CF: what is said of its cells stands in `encoding`."""
    plain = {key: value for key, value in variable.attributes.items() if key != "coordinates"}
    encoding: dict[str, Any] = {} if variable.blank is None else {"_FillValue": values.dtype.type(variable.blank)}
    encoding |= {"coordinates": " ".join(beside)} if beside else {}
    return xarray.Variable(dims, values, plain, encoding | {"dtype": values.dtype})


def sizes_of(parameters: Arrays) -> dict[str, int]:
    """
    List the dimensions of parameters: those of other names as they are met, then the axes as a study orders them.

    >>> A, k = xarray.DataArray([[0.1], [0.2]], dims=["nu", "x"]), xarray.DataArray([0.0, 0.5], dims="k")
    >>> sizes_of({"A": A, "k": k, "modulus": 500.0})
    {'x': 1, 'k': 2, 'nu': 2}
    """
    arrays = (array for array in parameters.values() if isinstance(array, xarray.DataArray))
    met = {str(dim): size for array in arrays for dim, size in array.sizes.items()}
    others = {dim: size for dim, size in met.items() if dim not in INPUTS}
    return others | {key: met[key] for key in INPUTS if key in met}


def _dims(value: float | xarray.DataArray) -> tuple[Any, ...]:
    """Name the dimensions of a parameter."""
    return () if isinstance(value, float) else value.dims


def _along(sizes: Mapping[str, int], value: float | xarray.DataArray) -> NDArray[np.float64]:
    """Give a parameter with an axis for every dimension, of length 1 where it does not vary."""
    if isinstance(value, float):
        return np.full((1,) * len(sizes), value)
    values = value.transpose(*(dim for dim in sizes if dim in value.dims)).values
    return np.asarray(values).reshape([value.sizes.get(dim, 1) for dim in sizes])


def _outputs(study: Study, scenes: Mapping[str, NDArray[np.float64]], threads: int | None) -> dict[str, NDArray[Any]]:
    """Solve the scenes, by one solver or by each of several."""
    settings: dict[str, Any] = {"check_contact": study.method.check_contact, "threads": threads}
    settings |= {**driven_by(study), "watch": study.may_reach(scenes["a_max_over_R"])}
    solvers = study.method.solver
    requested = (solvers,) if isinstance(solvers, str) else solvers
    *_, profiles = study.apart(tuple(slice(0, size) for size in study.shape))
    return solved_by(scenes, study, requested, profiles, **settings)


def _other_coordinates(parameters: Arrays, dataset: xarray.Dataset) -> dict[str, xarray.DataArray]:
    """Find the coordinates that came with the parameters and are not theirs."""
    found: dict[str, xarray.DataArray] = {}
    for array in (array for array in parameters.values() if isinstance(array, xarray.DataArray)):
        for name, coordinate in array.coords.items():
            if name not in dataset.variables:
                found.setdefault(str(name), coordinate.reset_coords(drop=True))
    return found
