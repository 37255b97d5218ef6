"""The dataset of scenes whose parameters are arrays over named dimensions: like that of a study, any dimensions."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.dataset import attributes, with_steep_contact
from gradhesion.cli.dataset.describe import Variable, variables
from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.names.outputs import labels_of
from gradhesion.cli.names.scenes import REALISATION, SOLVER, STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import messages
from gradhesion.cli.work.solve.scenes import scenes_from, solve_given
from gradhesion.core.closed.reduced import sources_of
from gradhesion.core.problem.inputs import INPUTS

Arrays = Mapping[str, float | xarray.DataArray]
"""By name; a number is the same in all scenes."""


def solved(study: Study, parameters: Arrays, threads: int | None = None) -> xarray.Dataset:
    """Solve the scenes of a study whose parameters, in plain numbers (SI), stand over dimensions of any names.

    The study says what is asked for; its own parameters count by their names only, and without a text the dataset has
    no study. Of a grid or of points the dataset is that which `gradhesion.cli.dataset.compute` gives.
    """
    sizes = sizes_of(parameters)
    arrays = {name: _along(sizes, value) for name, value in parameters.items()}
    scenes = scenes_from(arrays)
    whole = tuple(slice(0, size) for size in study.shape)
    watch = study.may_reach(scenes["a_max_over_R"])
    found = solve_given(study, arrays, whole, threads, watch=watch, scenes=scenes)
    steep = found.pop(STEEP, np.zeros(1, np.int8))
    described = variables(study)
    apart = {*sizes, *study.labels, SOLVER, REALISATION}
    beside = [name for name in described if name not in found and name not in apart]
    front, last = ([one] if one in described else [] for one in (SOLVER, REALISATION))
    made = {}
    for name, variable in described.items():
        own, values = [*variable.dimensions], variable.values
        if name in found:
            own, values = [*front, *sizes, *last, *filter(None, [labels_of(name)])], found[name]
        elif name in scenes or name in arrays:
            sources = [name] if name in arrays else sources_of(name, parameters)
            varying = {dim for source in sources for dim in _dims(parameters[source])}
            own = [dim for dim in sizes if dim in varying]
            values = (arrays if name in arrays else scenes)[name].reshape([sizes[dim] for dim in own])
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


def _as_read(variable: Variable, dims: list[str], values: NDArray[Any], beside: list[str]) -> xarray.Variable:
    """Give a variable as xarray reads it from a file, by CF: what is said of its cells stands in `encoding`."""
    plain = {key: value for key, value in variable.attributes.items() if key != "coordinates"}
    encoding: dict[str, Any] = {} if variable.blank is None else {"_FillValue": values.dtype.type(variable.blank)}
    encoding |= {"coordinates": " ".join(beside)} if beside else {}
    return xarray.Variable(dims, values, plain, encoding | {"dtype": values.dtype})


def sizes_of(parameters: Arrays) -> dict[str, int]:
    """List the dimensions of parameters: those of other names as they are met, then the axes as a study orders them.

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
    return np.asarray(value.expand_dims([dim for dim in sizes if dim not in value.dims]).transpose(*sizes).values)


def _other_coordinates(parameters: Arrays, dataset: xarray.Dataset) -> dict[str, xarray.DataArray]:
    """Find the coordinates that came with the parameters and are not theirs."""
    found: dict[str, xarray.DataArray] = {}
    for array in (array for array in parameters.values() if isinstance(array, xarray.DataArray)):
        for name, coordinate in array.coords.items():
            if name not in dataset.variables:
                found.setdefault(str(name), coordinate.reset_coords(drop=True))
    return found
