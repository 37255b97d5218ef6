"""Whether a dataset has the form of ours, before anything of it is used: a file may have been changed, or damaged."""

from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, RAGGED, STATE, STATE_CURVES, variables_of_curves
from gradhesion.cli.names.fits import FIT, FIT_MORE, FIT_POINTS, FIT_WORDS, LOOP, OTHER_PARAMETER, PARAMETER_UNITS
from gradhesion.cli.names.outputs import BEST, OUTPUTS, PARAMETER, PARETO_POINT, PHYSICAL_PARAMETER, SI, labels_of
from gradhesion.cli.names.scenes import REALISATION, SCENE, SOLVER
from gradhesion.core.problem.control import CONTROLS
from gradhesion.core.problem.inputs import INPUTS

if TYPE_CHECKING:
    import netCDF4
    import xarray

PACKED: Final = 2**14
"""Bytes of values for each byte of a file, at most: deflate packs 1,032 into one, and others hardly more."""

_WORDS: Final = (SOLVER, PARAMETER, PHYSICAL_PARAMETER, OTHER_PARAMETER, PARAMETER_UNITS, *FIT_WORDS)
"""The variables that hold words."""

_TEXTS: Final = ("title", "source", "history", "profile", "control", "toughness", "rate", "study", "study_sha256")


def check_size(file: "netCDF4.Dataset", path: Path) -> None:
    """
    Refuse a file that claims more values than it can hold, before any of them is read.

    Raises
    ------
    DatasetError
        It does, or a variable has a dimension twice.
    """
    most = PACKED * path.stat().st_size
    for name, variable in file.variables.items():
        if variable.size > most:
            raise _damaged(path, f"{name} cannot have {variable.size:,} values in so small a file")
        if len({*variable.dimensions}) < len(variable.dimensions):
            raise _damaged(path, f"{name} has a dimension twice")
        for attribute in {"scale_factor", "add_offset"} & {*variable.ncattrs()}:
            if not isinstance(variable.getncattr(attribute), float | np.floating) or not np.isfinite(
                variable.getncattr(attribute)
            ):
                raise _damaged(path, f"the attribute {attribute} of {name} is no floating-point number")


def check_form(dataset: "xarray.Dataset", path: Path | str) -> None:
    """
    Check the attributes, types and dimensions that all else relies on.

    Raises
    ------
    DatasetError
        One is not as we write it; the message says which.
    """
    for fault in chain(  # one after the other: each relies on what those before it check
        _of_attributes(dataset), _of_variables(dataset), _of_axes(dataset), _of_curves(dataset), _of_fit(dataset)
    ):
        raise _damaged(path, fault)


def _damaged(path: Path | str, fault: str) -> DatasetError:
    return DatasetError(f"{path}: was changed or is damaged ({fault}); write it again with `gradhesion run`")


def _of_attributes(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say which attributes are of another type."""
    texts = (*_TEXTS, *(name for name in dataset.attrs if str(name).endswith("_version")))
    for name in texts:
        if not isinstance(dataset.attrs.get(name, ""), str):
            yield f"its attribute {name} is not text"
    if str(dataset.attrs.get("control", CONTROLS[0])) not in CONTROLS:
        yield "its attribute control is not a known control"


def _of_variables(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say which variables have another type, or attributes of another."""
    for name, variable in dataset.variables.items():
        words = "OU" if name in _WORDS else "OUf" if name == STATE else "fiu"
        if variable.dtype.kind not in words:
            yield f"the type of {name} is {variable.dtype}"
        for attribute in ("units", "long_name"):
            if not isinstance(variable.attrs.get(attribute, ""), str):
                yield f"the attribute {attribute} of {name} is not text"
    if dataset["status"].dtype.kind not in "iu":
        yield "status does not consist of integers"
    if dataset["status"].size == 0:
        yield "it has no scene"


def _of_axes(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say which parameters or outputs have other axes than the scenes."""
    axes = dataset["status"].dims
    for axis in axes:
        if axis in (*INPUTS, SOLVER, REALISATION) and (axis not in dataset.coords or dataset[axis].dims != (axis,)):
            yield f"the axis {axis} has no values of its own"
    for name, key in INPUTS.items():
        if name not in dataset.variables:
            continue
        own = dataset[name].dims
        if not {*own} <= {*axes} or (name in dataset.coords and SCENE in axes and own != (SCENE,)):
            yield f"the axes of {name} are not those of status"
        elif own == (name,) and not _is_axis(dataset[name].values, infinite=bool(key.infinite)):
            yield f"the values of {name} are not those of an axis"
    for name in map(str, dataset.data_vars):
        labels = (labels_of(name),) if labels_of(name) else ()
        if name.startswith(BEST) and PARETO_POINT in dataset.dims:
            labels = (*labels, PARETO_POINT)
        known = name.removesuffix(SI).removeprefix(BEST) in (OUTPUTS | INPUTS) or labels
        if known and (dataset[name].dims != (*axes, *labels) or not {*labels} <= {PARETO_POINT, *dataset.coords}):
            yield f"the axes of {name} are not those of status"


def _of_fit(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say what a fit lacks."""
    if not is_fit(dataset):
        return
    loop = (LOOP,) if LOOP in dataset.dims else ()
    needed = {name: (*loop, *dims) for name, (dims, _) in FIT.items()}
    needed |= {name: (*loop, along) for along, own in FIT_POINTS.items() for name in own}
    needed |= dict.fromkeys((PARAMETER_UNITS, PARAMETER), (PARAMETER,)) | {"status": loop}
    needed |= dict.fromkeys(FIT_WORDS if loop else (), loop)
    others = {name: (*loop, *dims) for name, (dims, _) in FIT_MORE.items() if name in dataset.variables}
    for name, own in (needed | others).items():
        if name not in dataset.variables:
            yield f"it has no {name}"
        elif dataset[name].dims != own:
            yield f"the dimensions of {name} are not those of a fit"


def is_fit(dataset: "xarray.Dataset") -> bool:
    """Report whether a dataset is that of a fit."""
    return "chi_square" in dataset.variables


def refuse_fit(dataset: "xarray.Dataset", what: str, path: Path | str = "the dataset") -> None:
    """
    Refuse a fit where scenes are wanted.

    Raises
    ------
    DatasetError
        It is one.
    """
    if is_fit(dataset):
        raise DatasetError(f"{path}: contains a fit, and {what} needs scenes; `gradhesion plot` draws it")


def _is_axis(values: NDArray[Any], *, infinite: bool) -> bool:
    """Check that the values of an axis are all there, and each of them once."""
    return np.unique(values).size == values.size and not np.any(np.isnan(values) if infinite else ~np.isfinite(values))


def _of_curves(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say which variables of curves have other dimensions."""
    axes = dataset["status"].dims
    for curve, names in variables_of_curves(dataset.data_vars).items():
        along: tuple[Any, ...] = (*axes, *((STATE,) if curve in STATE_CURVES else ()), EXTENTS[curve])
        count = RAGGED.get(curve)
        if count is not None:
            along = (EXTENTS[curve],)
            yield from _of_counts(dataset, count, EXTENTS[curve])
        for name in names:
            if name != count and dataset[name].dims != along:
                yield f"the dimensions of {name} are not {', '.join(map(str, along))}"
        if curve in STATE_CURVES and STATE not in dataset.coords:
            yield "its states have no names"


def _of_counts(dataset: "xarray.Dataset", count: str, extent: str) -> Iterator[str]:
    """Say whether the numbers of items of all scenes do not add up."""
    if count not in dataset.data_vars or dataset[count].dims != dataset["status"].dims:
        yield f"{count} is missing for some scenes"
        return
    counts = dataset[count].values
    sound = counts.dtype.kind in "iu" and counts.min() >= 0
    if not sound or (extent in dataset.sizes and int(counts.sum()) != dataset.sizes[extent]):  # it may stand alone
        yield f"the numbers of {count} do not add up to those of {extent}"
