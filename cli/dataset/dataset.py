"""What a study's dataset holds: names, dimensions and attributes by CF-1.11, the same in a file and in xarray."""

import platform
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli import names
from gradhesion.cli.study.shape_words import shape_told
from gradhesion.cli.study.study import Study
from gradhesion.cli.work import curves
from gradhesion.cli.work.blocks import Block, scenes_of, size_of, solved
from gradhesion.core import FLAGS, PARAMETERS

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, kw_only=True)
class Variable:
    """A variable of a dataset; a coordinate knows its values, an output gets them block by block."""

    dimensions: tuple[str, ...]
    dtype: str
    attributes: dict[str, Any]
    values: NDArray[Any] | None = None
    made: Callable[[Block], NDArray[np.float64]] | None = None
    """Makes the values of a block of a coordinate that may be as large as an output."""
    blank: float | None = None
    """What stands where there is no value, if that is told by `_FillValue`."""


def variables(study: Study) -> dict[str, Variable]:
    """Describe the variables of a study's dataset, coordinates first."""
    described = _coordinates(study)
    beside = " ".join(name for name in described if name not in study.sizes)
    outputs = {name: _output(study, name) for name in study.variables}
    outputs["status"] = _status(study)
    if beside:
        for name, variable in outputs.items():
            if not curves.is_ragged(name):
                variable.attributes["coordinates"] = beside
    return described | outputs


def _coordinates(study: Study) -> dict[str, Variable]:
    """Describe the solvers, if there are several, and the parameters of the scenes."""
    axes = tuple(study.axes)
    described = {}
    if names.SOLVER in study.sizes:
        solvers = np.array(study.method.solver, dtype=object)
        attributes = {"long_name": names.SOLVERS}
        described[names.SOLVER] = Variable(
            dimensions=(names.SOLVER,), dtype="str", attributes=attributes, values=solvers
        )
    for name, long_name in names.KEYS.items():
        attributes = {"units": names.unit_of(name), "long_name": long_name}
        if name in study.parameters:
            values = np.asarray(study.parameters[name])
            if study.layout == "points":
                own, values = axes, np.broadcast_to(values, tuple(study.axes.values()))
            else:
                own = (name,) if name in axes else ()
            described[name] = Variable(dimensions=own, dtype="f8", attributes=attributes, values=values)
        elif name in PARAMETERS or (name == names.MACHINE and names.SPRING in study.parameters):
            own = following(study, name)
            made = partial(_made, study, name, own)
            blank = np.nan if names.TIED.keys() & study.parameters.keys() else None  # where there is no a_2
            described[name] = Variable(dimensions=own, dtype="f8", attributes=attributes, made=made, blank=blank)
    return described


def following(study: Study, name: str) -> tuple[str, ...]:
    """Name the axes along which a parameter varies that is not given but made from others."""
    from gradhesion.core.reduced import sources_of  # noqa: PLC0415 (300 ms for SciPy)

    sources = sources_of(name, study.parameters)
    return tuple(axis for axis in study.axes if axis in sources or study.layout == "points")


def _made(study: Study, name: str, own: tuple[str, ...], block: Block) -> NDArray[np.float64]:
    """Compute a block, of its own axes, of a parameter that is made from others."""
    cuts = dict(zip(own, block, strict=True))
    whole = tuple(cuts.get(axis, slice(0, 1)) for axis in study.axes)
    values = np.broadcast_to(scenes_of(study, whole)[name], [size_of((cut,)) for cut in whole])
    return values.reshape([size_of((cut,)) for cut in block])


def _output(study: Study, name: str) -> Variable:
    """Describe a result: one value a scene, or one curve; perhaps in SI units."""
    if name.endswith(names.SI):
        plain = _output(study, name.removesuffix(names.SI))
        long_name = names.long_name_in_si(plain.attributes["long_name"])
        return replace(plain, attributes=plain.attributes | {"units": names.unit_of(name), "long_name": long_name})
    dimensions = tuple(study.sizes)
    attributes: dict[str, Any] = {"units": "1", "ancillary_variables": "status"}
    if study.kind == "curve":
        dtype = names.INTEGERS.get(name, "f8")
        attributes["long_name"] = next(own[name] for own in names.CURVES.values() if name in own)
        if name in names.MEANINGS:
            attributes |= {"flag_values": np.array([0, 1], dtype=dtype), "flag_meanings": names.MEANINGS[name]}
        if name in names.RAGGED.values():
            attributes["sample_dimension"] = next(
                names.EXTENTS[one] for one in names.RAGGED if name in names.CURVES[one]
            )
            return Variable(dimensions=dimensions, dtype=dtype, attributes=attributes)
        if curves.is_ragged(name):
            del attributes["ancillary_variables"]  # `status` has other dimensions
            return Variable(dimensions=(curves.extent_of(name),), dtype=dtype, attributes=attributes)
        dimensions = (*dimensions, curves.extent_of(name))
        return Variable(dimensions=dimensions, dtype=dtype, attributes=attributes, blank=curves.blank_of(name))
    attributes["long_name"] = names.OUTPUTS[name]
    if name == "dissipated_energy" and study.loading.control == "load":
        attributes["long_name"] = names.OUTPUTS[name].replace(",", " without its jump-out, which has no bound,")
    if name.endswith("_jumps"):
        return Variable(dimensions=dimensions, dtype="i4", attributes=attributes)
    return Variable(dimensions=dimensions, dtype="f8", attributes=attributes, blank=np.nan)


def _status(study: Study) -> Variable:
    """Describe the status of the scenes."""
    attributes = {
        "units": "1",
        "long_name": names.STATUS,
        "flag_masks": np.array(list(FLAGS.values()), dtype=np.int8),
        "flag_meanings": " ".join(FLAGS),
    }
    return Variable(dimensions=tuple(study.sizes), dtype="i1", attributes=attributes)


def parts(study: Study, threads: int | None = None) -> Iterator[tuple[Block, dict[str, NDArray[Any]]]]:
    """Compute the results of a study and their `status`, part by part."""
    return curves.drawn(study, threads) if study.kind == "curve" else solved(study, threads)


def attributes(study: Study, history: str) -> dict[str, str]:
    """List the global attributes of a study's dataset: what it is, where it comes from, how to make it again."""
    return {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": f"gradhesion {version('gradhesion')}",
        "history": history,
        "references": names.REFERENCES,
        "profile": shape_told(study.profile),
        "control": study.loading.control,
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
    found = curves.gathered(study, threads) if study.kind == "curve" else _joined(study, described, threads)
    made = {}
    for name, variable in described.items():
        if variable.made:
            values = variable.made(tuple(slice(0, study.axes[axis]) for axis in variable.dimensions))
        else:
            values = found[name] if variable.values is None else variable.values
        blank = {} if variable.blank is None else {"_FillValue": values.dtype.type(variable.blank)}
        made[name] = xarray.Variable(variable.dimensions, values, variable.attributes | blank)
    coded = xarray.Dataset(made, attrs=attributes(study, "computed in memory"))
    return xarray.decode_cf(coded)


def _joined(study: Study, described: Mapping[str, Variable], threads: int | None) -> dict[str, NDArray[Any]]:
    """Solve a study in memory."""
    filled = {name: np.empty(study.shape, described[name].dtype) for name in (*study.variables, "status")}
    for block, values in parts(study, threads):
        for name, part in values.items():
            filled[name][block] = part
    return filled
