"""What a study's dataset holds: names, dimensions and attributes by CF-1.11, the same in a file and in xarray."""

import platform
from dataclasses import dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli import names
from gradhesion.cli.blocks import solved
from gradhesion.cli.study import Study
from gradhesion.core import FLAGS

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, kw_only=True)
class Variable:
    """A variable of a dataset; a coordinate has its `values`, an output gets them block by block."""

    dimensions: tuple[str, ...]
    dtype: str
    attributes: dict[str, Any]
    values: NDArray[np.float64] | None = None


def variables(study: Study) -> dict[str, Variable]:
    """Describe the variables of a study's dataset, coordinates first."""
    dimensions = tuple(study.sizes)
    described = {}
    for name, long_name in names.PARAMETERS.items():
        values = np.asarray(study.parameters[name])
        if study.layout == "points":
            own, values = dimensions, np.broadcast_to(values, study.shape)
        else:
            own = (name,) if name in dimensions else ()
        described[name] = Variable(
            dimensions=own, dtype="f8", attributes={"units": "1", "long_name": long_name}, values=values
        )
    beside = " ".join(name for name in names.PARAMETERS if name not in dimensions)
    for name in study.outputs:
        attributes = {"units": "1", "long_name": names.OUTPUTS[name], "ancillary_variables": "status"}
        dtype = "i4" if name.endswith("_jumps") else "f8"
        described[name] = Variable(dimensions=dimensions, dtype=dtype, attributes=attributes)
    flags = {
        "units": "1",
        "long_name": names.STATUS,
        "flag_masks": np.array(list(FLAGS.values()), dtype=np.int8),
        "flag_meanings": " ".join(FLAGS),
    }
    described["status"] = Variable(dimensions=dimensions, dtype="i1", attributes=flags)
    if beside:
        for name in (*study.outputs, "status"):
            described[name].attributes["coordinates"] = beside
    return described


def attributes(study: Study, history: str) -> dict[str, str]:
    """List the global attributes of a study's dataset: what it is, where it comes from, how to make it again."""
    return {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": f"gradhesion {version('gradhesion')}",
        "history": history,
        "references": names.REFERENCES,
        "study": study.text,
        "study_sha256": study.sha256,
        "python_version": platform.python_version(),
        **{f"{package}_version": version(package) for package in ("numpy", "numba", "scipy")},
    }


def compute(study: Study, *, threads: int | None = None) -> "xarray.Dataset":
    """
    Compute a study in memory.

    Parameters
    ----------
    study
        From `load_study` or `study_from`.
    threads
        Threads to use, all cores if None; the values do not depend on it.

    Returns
    -------
    The dataset that `gradhesion run` writes to a file, as xarray reads it.
    """
    import xarray  # noqa: PLC0415 (450 ms that `run` does not need)

    described = variables(study)
    filled = {
        name: np.empty(study.shape, variable.dtype) if variable.values is None else variable.values
        for name, variable in described.items()
    }
    for block, values in solved(study, threads):
        for name, part in values.items():
            filled[name][block] = part
    made = {
        name: xarray.Variable(
            variable.dimensions,
            filled[name],
            {key: value for key, value in variable.attributes.items() if key != "coordinates"},
        )
        for name, variable in described.items()
    }
    coordinates = {name: made.pop(name) for name in names.PARAMETERS}
    return xarray.Dataset(made, coordinates, attributes(study, "computed in memory"))
